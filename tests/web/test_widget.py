"""The widget's side in Python."""

import doctest
import sys

import numpy as np
import pytest

import app
from app.web import widget as of_widget
from app.web.widget import widget
from bihdist_core import BihdistError, ParameterError
from tests.shapes import bumpy, two_pieces

pytest.importorskip("anywidget")
traitlets = pytest.importorskip("traitlets")


@pytest.fixture(scope="module")
def made():
    return widget(
        bumpy(200), ["biharmonic", "geodesic"], source=12, marks={"pins": [5, 7]}, isolines=0, look={"clim": "fraction"}
    )


def test_a_widget_holds_what_a_page_does(made):
    assert [panel["distance"] for panel in made.scene["panels"]] == ["biharmonic", "geodesic"]
    assert made.source == 12
    assert made.pins == [{"id": 5, "name": ""}, {"id": 7, "name": ""}]
    assert made.scene["isolines"]["count"] == 0
    assert made.scene["panels"][0]["shares"]
    assert {*made.contents} == {"kernel", "mesh", "given"}
    assert made._esm.endswith("export default { render };\n")


@pytest.mark.parametrize("source", [200, -1, "12", True, 1.5])
def test_a_source_is_a_vertex_of_a_face(made, source):
    with pytest.raises(traitlets.TraitError):
        made.source = source
    assert made.source == 12


def test_pins_are_vertices_of_faces(made):
    before = list(made.pins)
    for pins in ([200], [{"name": "without"}], [{"id": None}]):
        with pytest.raises(traitlets.TraitError, match="Pin 1 is"):
            made.pins = pins
    assert made.pins == before
    made.pins = [5, {"id": 7, "name": "tip"}]
    assert made.pins == [{"id": 5, "name": ""}, {"id": 7, "name": "tip"}]
    with pytest.raises(BihdistError, match="60"):
        widget(two_pieces(), ["biharmonic"], source=0, marks={"pins": [60]})


def test_linked_widgets_have_one_source():
    one, other = (widget(bumpy(200), [each], source=0) for each in ("biharmonic", "commute-time"))
    traitlets.link((one, "source"), (other, "source"))
    other.source = np.int64(7)
    assert one.source == 7


def test_a_click_in_a_panel_is_told_and_nothing_else():
    picked = []
    made = widget(bumpy(200), ["biharmonic"], source=0, on_pick=picked.append)
    made.source = 3
    made._handle_custom_msg({"picked": 9}, [])
    assert picked == [9]


def test_eigenpairs_go_along_where_they_are_allowed():
    with pytest.raises(ParameterError, match="eigenpairs=5"):
        widget(bumpy(200), ["truncated(k=5)"], source=0, eigenpairs=4)
    made = widget(bumpy(200), ["truncated(k=5)"], source=0, eigenpairs=5)
    assert "points-truncated" in made.contents


def test_fields_of_ones_own_go_along():
    values = np.linspace(-1, 1, 200)
    made = widget(bumpy(200), ["biharmonic - mine"], 0, fields={"mine": values, "other": values**2})
    assert made.scene["given"] == ["field mine", "field other"]
    assert [panel["label"] for panel in made.scene["panels"]] == ["biharmonic, exact − mine", "other"]


def test_an_option_that_means_nothing_here_is_refused():
    with pytest.raises(TypeError, match=r"widget\(\) got an unknown key 'size' in layout"):
        widget(bumpy(200), layout={"size": "85mm"})


def test_the_example_in_the_docstring_runs(monkeypatch):
    monkeypatch.setitem(sys.modules, "bihdist", app)  # in a checkout the package has another name
    (test,) = doctest.DocTestFinder(recurse=False).find(of_widget.widget, "widget")
    assert doctest.DocTestRunner().run(test) == (0, len(test.examples))


class RefusesPip:
    """Stands for setuptools' import hook, which warns on "pip" where distutils was imported before."""

    @staticmethod
    def find_spec(name, *rest):
        if name == "pip":
            raise AssertionError("an import hook was asked for pip")


def test_without_anywidget_there_is_a_sentence(monkeypatch):
    monkeypatch.setattr(sys, "meta_path", [RefusesPip(), *sys.meta_path])
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "app.web.distance_widget", raising=False)
    with pytest.raises(ParameterError, match="-m pip install anywidget"):
        app.widget("hand")
