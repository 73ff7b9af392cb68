"""Types are part of the packages, and the stub of the library's names says what is imported."""

import inspect
from pathlib import Path

import pytest
from mypy import stubtest
from mypy.options import Options

import app as bihdist
import bihdist_core
from tests.packaging.typed_use import right
from tests.shapes import bumpy

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("package", ["app", "bihdist_core"])
def test_packages_are_marked_as_typed(package):
    assert (ROOT / package / "py.typed").exists()


def test_the_stub_is_what_is_imported():
    """All names in both, and each function of the signature, each class of the members that mypy reads of it."""
    options = Options()
    options.incremental, options.ignore_missing_imports, options.mypy_path = False, True, [str(ROOT)]
    stubtest.build_stubs(["bihdist_core"], options)
    assert [error.get_description(concise=True) for error in stubtest.test_module("bihdist_core")] == []


def test_what_users_write_runs_as_it_is_typed(tmp_path):
    surface = bumpy(60)
    right(surface.vertices, surface.faces, tmp_path / "a.off")


def test_what_is_shown_of_objects_is_words():
    """Also once they have been used, when results are kept beside their attributes."""
    surface = bumpy(60)
    distance = bihdist_core.BiharmonicDistance(surface)
    used = [surface, distance, distance.laplacian, distance.laplacian.components[0], distance.embedding(5)]
    for each in [*used, *(getattr(bihdist_core, name) for name in bihdist_core.__all__)]:
        assert [name for name in dir(each) if not name.isidentifier()] == []
    assert [name for name in vars(distance.laplacian) if not name.startswith("_")] == [
        "surface",
        "areas_kind",
        "operator",
        "components",
    ]


def test_signatures_are_short():
    """They are what editors and prompts show of a function."""
    lengths = {}
    for name in bihdist.__all__:
        found = getattr(bihdist, name)
        if callable(found) and not (inspect.isclass(found) and issubclass(found, Exception | dict)):
            lengths[name] = len(str(inspect.signature(found)))
    assert {name for name, length in lengths.items() if length > 500} == {"figure", "page", "widget"}
    assert max(lengths.values()) < 850
