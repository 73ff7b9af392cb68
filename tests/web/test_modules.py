"""The page's modules are plain ones, and become one script."""

import re
import shutil
import subprocess

import pytest

from app.web.modules import VIEWER, joined, top_names, unpadded


def written(folder, **modules):
    for name, text in modules.items():
        (folder / f"{name}.js").write_text(text)
    return folder


def test_what_is_imported_comes_first_and_once(tmp_path):
    folder = written(
        tmp_path,
        main='import { a } from "./a.js";\nimport { b } from "./b.js";\n\na(b);\n',
        a='import { b, c } from "./b.js";\n\nexport function a() {\n  return b + c;\n}\n',
        b="export const b = 1;\nexport const c = 2;\n",
    )
    text = joined("main.js", folder)
    assert re.findall(r"const \w|function \w|a\(b\)", text) == ["const b", "const c", "function a", "a(b)"]
    assert "import" not in text
    assert "export" not in text


@pytest.mark.parametrize(
    ("modules", "reason"),
    [
        ({"main": 'import { a } from "./a.js";\n', "a": "const a = 1;\n"}, "main.js imports a of a.js"),
        (
            {"main": 'import { a } from "./a.js";\nconst b = 1;\n', "a": "export const a = 1;\nlet b = 2;\n"},
            "both define b",
        ),
        ({"main": "export default 1;\n"}, "'export default 1;' is neither"),
        ({"main": 'import a from "./a.js";\n'}, "is neither"),
        ({"main": 'import { a } from "./a.js";\n', "a": 'import { b } from "./main.js";\n'}, "imports itself"),
    ],
)
def test_what_cannot_be_joined_is_refused(tmp_path, modules, reason):
    with pytest.raises(ValueError, match=re.escape(reason)):
        joined("main.js", written(tmp_path, **modules))


def test_top_names_are_what_lines_begin_with():
    text = "export const a = 1;\nconst { b, c } = a;\nfunction* d() {\n  const inner = 1;\n}\n"
    text += "export async function e() {}\nclass F {}\n"
    assert top_names(text) == ["a", "b", "c", "d", "e", "F"]


def test_what_only_people_read_is_left_out():
    assert unpadded("a {\n  /* of a\n   b */\n  // c\n  d: /* e */ f;\n}\n") == "a {\nd: /* e */ f;\n}\n"


@pytest.mark.parametrize("entry", ["main.js", "widget.js"])
def test_the_joined_script_is_one_that_node_takes(entry):
    if not shutil.which("node"):
        pytest.skip("there is no node")
    said = subprocess.run(
        ["node", "--check", "--input-type=module", "-"], input=joined(entry), capture_output=True, text=True
    )
    assert said.returncode == 0, said.stderr


def test_every_module_is_in_a_page_or_in_the_widget():
    text = joined("main.js") + joined("widget.js")
    for module in VIEWER.glob("*.js"):
        assert set(top_names(module.read_text(encoding="utf-8"))) <= set(top_names(text)), module.name
