"""Every public name has an example in its docstring that can be copied, and it is run (see `test_examples`)."""

import doctest
import inspect

import pytest

import bihdist_core
from app.figures.picture import figure, figure_again
from app.qt.show import show
from app.web.page import page
from app.web.widget import widget

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
            if not name.startswith("_") and (
                callable(found) or isinstance(found, classmethod) or hasattr(found, "__get__")
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
