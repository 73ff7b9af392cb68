"""Examples in docstrings and in the guide do what they say, and every public name has one."""

import doctest
import importlib
import inspect
import re
import sys
from pathlib import Path

import pytest

import app
import bihdist_core
from app.figures.picture import figure, figure_again
from app.qt.show import show
from app.web.page import page
from app.web.widget import widget
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


# ---------------------------------------------------------------------- public examples
OF_METHODS = [
    "BiharmonicDistance",
    "Correspondence",
    "DiffusionDistance",
    "Distance",
    "Embedding",
    "FieldScatter",
    "GeodesicDistance",
    "GeodesicPaths",
    "Isoline",
    "Laplacian",
    "Pins",
    "Places",
    "PowerDistance",
    "ShepardInterpolant",
    "Surface",
    "SurfacePath",
]
"""Classes whose methods and properties have examples, too."""
INHERITED = ["from_source", "from_sources", "between", "pairwise", "of_pairs"]
"""What every distance answers."""

OWN = {"figure": figure, "figure_again": figure_again, "page": page, "show": show, "widget": widget}
PUBLIC = OWN | {
    name: found
    for name, found in ((name, getattr(bihdist_core, name)) for name in bihdist_core.__all__)
    if (inspect.isclass(found) or inspect.isfunction(found))
    and not (inspect.isclass(found) and issubclass(found, bihdist_core.BihdistError))
}


def members():
    """The public methods and properties of some classes, each with its name."""
    for owner in OF_METHODS:
        for name, found in vars(getattr(bihdist_core, owner)).items():
            # An override without a docstring has that of the base class.
            if (
                not name.startswith("_")
                and found.__doc__
                and (callable(found) or isinstance(found, classmethod) or hasattr(found, "__get__"))
            ):
                yield f"{owner}.{name}", found
    for name in INHERITED:
        yield f"Distance.{name}", getattr(bihdist_core.Distance, name)


EXAMPLES = {
    name: doctest.DocTestParser().get_examples(inspect.getdoc(found) or "")
    for name, found in [*PUBLIC.items(), *members()]
}


def test_there_are_many():
    assert len(EXAMPLES) > 180


@pytest.mark.parametrize("name", EXAMPLES)
def test_has_an_example_that_can_be_copied(name):
    examples = EXAMPLES[name]
    assert examples, f"{name} has none"
    assert "import bihdist" in examples[0].source
    assert any(example.want for example in examples), "it shows nothing"
    assert not any(example.options for example in examples), "all of it is run"
