"""Examples in docstrings and in the guide's page on the library do what they say."""

import doctest
import importlib
import re
import sys
from pathlib import Path

import pytest

import app
from bihdist_core import write_mesh
from tests.shapes import bumpy, spike

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "assets/guide/reference/library.md"
WITH_EXAMPLES = sorted(path for path in (ROOT / "bihdist_core").rglob("*.py") if ">>> " in path.read_text("utf-8"))


def test_the_guide(tmp_path, monkeypatch):
    pytest.importorskip("joblib")
    pytest.importorskip("anywidget")
    monkeypatch.chdir(tmp_path)
    write_mesh("mesh.off", bumpy(1000))
    write_mesh("other.off", spike(1000, 2))
    names: dict[str, object] = {}
    blocks = re.findall(r"^```python\n(.*?)^```", PAGE.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    run = [block for block in blocks if "bihdist.show" not in block]  # see tests/qt/test_show_processes.py
    for block in run:
        exec(compile(block, PAGE.name, "exec"), names)
    assert len(run) == len(blocks) - 1 > 4
    assert {"profile.csv", "fields.npy", "figure.pdf", "again.pdf", "page.html", "mine.html"} <= {
        path.name for path in tmp_path.iterdir()
    }


@pytest.mark.parametrize("path", WITH_EXAMPLES, ids=lambda path: path.stem)
def test_docstrings(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # where examples write their files
    monkeypatch.setitem(sys.modules, "bihdist", app)  # in a checkout the package has another name
    name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
    failed, tried = doctest.testmod(importlib.import_module(name))
    assert tried
    assert not failed
