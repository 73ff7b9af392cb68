"""Each block of the guide's pages that runs at the build runs here, without Sphinx."""

import re
import sys
import tomllib
from pathlib import Path

import pytest

from assets.guide.building.blocks import blocks_of, imported_modules, run_page
from assets.guide.building.page_runs import run_pages

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "assets/guide"
WIDEST = 88
"""Columns of code that a page shows without scrolling."""
IMPORTED_AS = {"pillow": "PIL"}
"""Names of modules where they are not those of the distribution."""
PAGES = sorted(page for page in GUIDE.rglob("*.md") if blocks_of(page.read_text(encoding="utf-8")))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(GUIDE).with_suffix("").as_posix())
def test_blocks_run(page, tmp_path):
    outcomes = run_page(page, tmp_path)
    for outcome in outcomes:
        assert all((tmp_path / picture).stat().st_size for picture in outcome.pictures)


def test_the_extra_has_all_that_examples_and_the_build_import():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    rows = project["dependencies"] + project["optional-dependencies"]["guide"]
    names = [re.match(r"[\w-]+", row)[0].lower() for row in rows]
    installed = {IMPORTED_AS.get(name, name.replace("-", "_")) for name in names} | {"bihdist", "bihdist_core"}
    installed |= {"traitlets", "docutils", "pygments"}  # anywidget's and Sphinx's
    installed |= {"app", "assets", "tests"}
    for example in [*GUIDE.rglob("*.md"), *GUIDE.rglob("*.py")]:
        assert imported_modules(example) - sys.stdlib_module_names - installed == set(), example


def test_a_missing_module_is_named_before_anything_runs(tmp_path):
    (tmp_path / "page.md").write_text("```{python}\nimport no_such_module.part\nopen('it_ran', 'w')\n```\n")
    (said,) = run_pages(tmp_path)
    assert "no_such_module:" in said
    assert not list(tmp_path.rglob("it_ran"))


@pytest.mark.parametrize("page", sorted(GUIDE.rglob("*.md")), ids=lambda page: page.relative_to(GUIDE).as_posix())
def test_code_is_no_wider_than_its_column(page):
    text = page.read_text(encoding="utf-8")
    blocks = re.findall(
        r"^(`{3,})\{?(?:sh|shell|python|html|js|matlab|toml|json)\b.*\n((?s:.*?))^\1$", text, re.MULTILINE
    )
    lines = [line for _, code in blocks if ":hide-code:" not in code for line in code.splitlines()]
    assert [line for line in lines if len(line) > WIDEST and line[0] != ":"] == []


@pytest.mark.parametrize("example", sorted((GUIDE / "gallery").rglob("*.py")), ids=lambda path: path.stem)
def test_code_of_an_example_is_no_wider_than_its_column(example):
    lines = example.read_text(encoding="utf-8").splitlines()
    # Words that cannot be divided are left alone.
    code = [line for line in lines if (line[:1] != "#" or line.startswith("#    ")) and len(line.split()) > 2]
    after = lines.index('"""', 1)
    assert [line for line in code if line in lines[after:] and len(line.removeprefix("#    ")) > WIDEST] == []
