"""Anchors in files: read as they were written, and what is wrong is named."""

import numpy as np
import pytest

from bihdist_core import ParameterError, read_pins
from bihdist_core.formats.anchors import read_anchors, write_anchors
from tests.shapes import bumpy


@pytest.fixture
def surface():
    return bumpy(150)


@pytest.mark.parametrize("name", ["a.csv", "a.json", "a.pp"])
def test_anchors_are_read_as_they_were_written(surface, tmp_path, name):
    vertices, values = [3, 77, 140], [0.1, -1 / 3, 2e7]
    write_anchors(tmp_path / name, surface, vertices, values, ("left", "", "a, b"))
    found = read_anchors(tmp_path / name, surface)
    assert found.vertices.tolist() == vertices
    assert found.values.tolist() == values
    assert (found.moved == 0).all()
    if name != "a.pp":
        assert found.names == ("left", "", "a, b")
    assert read_pins(tmp_path / name, surface).vertices.tolist() == vertices


def test_positions_are_snapped_and_how_far_is_told(surface, tmp_path):
    path = tmp_path / "a.csv"
    x, y, z = (surface.vertices[9] + [0.01, 0, 0]).tolist()
    path.write_text(f"value,x,y,z\n1.5,{x!r},{y!r},{z!r}\n")
    found = read_anchors(path, surface)
    assert (found.vertices.tolist(), found.values.tolist()) == ([9], [1.5])
    assert found.moved == pytest.approx([0.01])


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.csv", "vertex,value\n3,high\n", "a.csv, line 2: the value 'high' is not a finite number"),
        ("a.csv", "vertex,value\n3,\n", "a.csv, line 2: an anchor needs a value"),
        ("a.csv", "vertex\n3\n", "an anchor needs a value"),
        ("a.csv", "vertex,value\n3,1\n3,2\n", "line 3: vertex 3 is an anchor already, in a.csv, line 2"),
        ("a.csv", "vertex,value\n150,1\n", "no vertex 150"),
        ("a.json", '{"anchors": [{"vertex": 3, "value": "1"}]}', "pin 1: the value '1' is not a number"),
        ("a.pp", '<PickedPoints><point x="0" y="0" z="0" name="nose"/></PickedPoints>', "'nose' of an anchor must be"),
    ],
)
def test_what_is_wrong_is_named(surface, tmp_path, name, content, words):
    (tmp_path / name).write_text(content)
    with pytest.raises(ParameterError, match=words):
        read_anchors(tmp_path / name, surface)


def test_values_have_to_be_numbers(surface, tmp_path):
    with pytest.raises(ParameterError, match="finite"):
        write_anchors(tmp_path / "a.csv", surface, [3], [np.nan])
