"""Files of pins: what is written is read, and what is wrong is named."""

import json

import numpy as np
import pytest

from bihdist_core import OutputError, ParameterError, VertexError
from bihdist_core.formats.landmarks import LANDMARKS
from bihdist_core.formats.pins import PIN_FORMATS, Pins, read_pins, write_pins
from tests.shapes import bumpy, two_pieces


@pytest.fixture(scope="module")
def rough():
    return bumpy(200)


@pytest.fixture(scope="module")
def pins(rough):
    return Pins.of(rough, [5, 17, 5, 120], ['left "ear"', "", "ünder, <b> & c", " tail"], [3, 1, 7, 2])


@pytest.mark.parametrize("extension", PIN_FORMATS)
def test_what_is_written_is_read(rough, pins, tmp_path, extension):
    path = tmp_path / f"pins{extension}"
    write_pins(path, rough, pins)
    again = read_pins(path, rough)
    assert again.vertices.tolist() == pins.vertices.tolist()
    assert again.moved.tolist() == [0] * 4
    if extension in LANDMARKS:
        # Without ids, a pin of no name has its id for one.
        assert again.ids.tolist() == [1, 2, 3, 4]
        names = (pins.names[0], "1", *pins.names[2:]) if LANDMARKS[extension].has_names else ("",) * 4
        assert again.names == (tuple(map(str.strip, names)) if extension == ".pts" else names)
    else:
        assert again.ids.tolist() == pins.ids.tolist()
        assert again.names == pins.names


def put(folder, name, text):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_columns_in_any_order_and_some_left_out(rough, tmp_path):
    for text in ("vertex\n5\n17\n", "name;Vertex\nnose;5\n;17\n", "\ufeffvertex,name\r\n5,nose\r\n\r\n17,\r\n"):
        assert read_pins(put(tmp_path, "a.csv", text), rough).vertices.tolist() == [5, 17]
    x, y, z = rough.vertices[9]
    found = read_pins(put(tmp_path, "a.csv", f"id,vertex,x,y,z,name\n8,,{x},{y},{z},\n9,3,,,,b\n"), rough)
    assert (found.ids.tolist(), found.vertices.tolist(), found.names) == ([8, 9], [9, 3], ("", "b"))


def test_positions_go_to_the_nearest_vertex_and_how_far_is_told(rough, tmp_path):
    at = rough.vertices[[9, 50]] + [[0.01, 0, 0], [0, 0, -0.02]]
    nearest = np.linalg.norm(rough.vertices[:, None] - at, axis=2)
    text = (
        "<PickedPoints>" + "".join(f'<point x="{x}" y="{y}" z="{z}" name="p"/>' for x, y, z in at) + "</PickedPoints>"
    )
    found = read_pins(put(tmp_path, "a.pp", text), rough)
    assert found.vertices.tolist() == nearest.argmin(axis=0).tolist()
    assert found.moved == pytest.approx(nearest.min(axis=0), rel=1e-12)
    # The vertex leads where both are there.
    both = read_pins(put(tmp_path, "a.json", '{"pins": [{"vertex": 3, "position": [9, 9, 9]}]}'), rough)
    assert both.vertices.tolist() == [3]
    assert both.moved[0] == pytest.approx(np.linalg.norm(rough.vertices[3] - 9), rel=1e-12)
    # No vertex without a face is the nearest.
    apart = two_pieces()
    lost = read_pins(put(tmp_path, "a.csv", "x,y,z\n9,9,9\n"), apart)
    assert apart.component_of_vertex[lost.vertices[0]] == 1


def test_a_file_of_meshlab(rough, tmp_path):
    text = """<!DOCTYPE PickedPoints>
<PickedPoints>
 <DocumentData>
  <DateTime date="2020-01-02" time="10:11:12"/><User name="me"/><DataFileName name="a.ply"/>
  <templateName name="new Template"/>
 </DocumentData>
 <point x="1" y="0" z="0" active="1" name="0"/>
 <point x="0" y="0" z="0" active="0" name="not picked"/>
 <point active="1" y="1" x="0" name="second" z="0"/>
</PickedPoints>
"""
    found = read_pins(put(tmp_path, "a.pp", text), rough)
    assert found.names == ("0", "second")


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.csv", "", "a.csv holds no pins"),
        ("a.csv", "vertex\n", "a.csv holds no pins"),
        ("a.csv", "id,name\n1,a\n", "line 1: pins need the column vertex, or x, y and z"),
        ("a.csv", "vertex,colour\n1,red\n", "line 1: 'colour' is not a column of pins"),
        ("a.csv", "vertex,vertex\n1,2\n", "line 1: the column vertex is given twice"),
        ("a.csv", "vertex\n1\n2.5\n", "line 3: the vertex '2.5' is not a whole number"),
        ("a.csv", "vertex\n1\n\n999\n", "line 4: bumpy has no vertex 999"),
        ("a.csv", "vertex,name\n1\n", "line 2 has 1 values under 2 columns"),
        ("a.csv", "id,vertex\n4,1\n4,2\n", "line 3: the id 4 is that of line 2 already"),
        ("a.csv", "x,y,z\n1,2,nan\n", r"line 2: the position \(1, 2, nan\)"),
        ("a.csv", "vertex,x,y,z\n,1,2,\n", r"line 2: the position \(1, 2, nothing\)"),
        ("a.csv", 'vertex,name\n1,"a\n', "line 2: unexpected end of data"),
        ("a.json", "{", "a.json: it is not JSON .line 1"),
        ("a.json", "[]", "holds no list of pins"),
        ("a.json", '{"pins": []}', "holds no pins"),
        ("a.json", '{"pins": [{"vertex": 1}, {"vertex": true}]}', "pin 2: the vertex True is not a whole number"),
        ("a.json", '{"pins": [{"vertex": 1, "at": 2}]}', "pin 1: {'vertex': 1, 'at': 2} is not a pin"),
        ("a.json", '{"pins": [{"id": 1}]}', "pin 1 has neither a vertex nor a position"),
        ("a.json", '{"pins": [{"position": [1, 2]}]}', r"pin 1: the position \(1, 2\)"),
        ("a.json", '{"pins": [{"position": [1, 2, "3"]}]}', "pin 1: the position"),
        ("a.json", '{"pins": [{"vertex": 1, "name": 2}]}', "pin 1: the name 2 is not a text"),
        ("a.pp", "<PickedPoints>", "a.pp, line 1: this is not XML"),
        ("a.pp", "<other/>", "holds 'other'"),
        ("a.pp", '<PickedPoints><point x="1" y="2"/></PickedPoints>', r"point 1: the position \(1, 2, nothing\)"),
        ("a.pp", '<!DOCTYPE a [<!ENTITY b "c">]><PickedPoints/>', "defines XML entities"),
        ("a.txt", "1", "not a file of pins"),
    ],
)
def test_what_is_wrong_is_named(rough, tmp_path, name, text, said):
    with pytest.raises(ParameterError, match=said):
        read_pins(put(tmp_path, name, text), rough)


def test_files_that_cannot_be_read_or_written(rough, pins, tmp_path):
    with pytest.raises(ParameterError, match=r"none\.csv cannot be read: No such file"):
        read_pins(tmp_path / "none.csv", rough)
    (tmp_path / "b.csv").write_bytes(b"vertex\n\xff\n")
    with pytest.raises(ParameterError, match="not a text file"):
        read_pins(tmp_path / "b.csv", rough)
    with pytest.raises(OutputError, match=r"written as \.csv, \.pp, \.fcsv"):
        write_pins(tmp_path / "a.txt", rough, pins)


def test_pins_are_checked(rough):
    with pytest.raises(VertexError, match="no vertex 200"):
        Pins.of(rough, [200])
    for arguments, said in [
        (([],), "no pins"),
        (([1, 2], ["a"]), "as many names"),
        (([1, 2], (), [3, 3]), "different"),
    ]:
        with pytest.raises(ParameterError, match=said):
            Pins.of(rough, *arguments)
    assert Pins.of(rough, [4, 5]).ids.tolist() == [1, 2]


HUGE = [10**30, 10**400, -(10**30), 2**63, "9" * 400, "x" * 3000, [[[]]], {}]


@pytest.mark.parametrize("key", ["id", "vertex", "position", "name", "value"])
@pytest.mark.parametrize("value", HUGE, ids=range(len(HUGE)))
def test_numbers_of_many_digits_and_other_values_are_a_short_sentence(rough, tmp_path, key, value):
    entry = {"vertex": 1, key: value} if key != "position" else {"position": [value, 0, 0]}
    (tmp_path / "a.json").write_text(json.dumps({"pins": [entry]}))
    is_name = key == "name" and isinstance(value, str)
    if is_name or (key in ("position", "value") and isinstance(value, int) and abs(value) < 1e100):
        assert read_pins(tmp_path / "a.json", rough).names == (value if is_name else "",)
        return
    with pytest.raises(ParameterError, match=r"a\.json, pin 1") as error:
        read_pins(tmp_path / "a.json", rough)
    assert len(str(error.value)) < 250


@pytest.mark.parametrize("number", ["1e300", "1e999", "9" * 400])
def test_a_position_beyond_all_meshes_is_none(rough, tmp_path, number):
    """The nearest vertex to it was the one after the last."""
    (tmp_path / "a.csv").write_text(f"x,y,z\n{number},0,0\n")
    with pytest.raises(ParameterError, match=r"line 2: the position \(.*\) is not three finite numbers"):
        read_pins(tmp_path / "a.csv", rough)


def test_a_document_nested_a_thousand_deep_is_a_sentence(rough, tmp_path):
    (tmp_path / "a.json").write_text('{"pins": ' + "[" * 1000 + "]" * 1000 + "}")
    with pytest.raises(ParameterError, match=r"a\.json: its lists and objects are nested more than 64 deep"):
        read_pins(tmp_path / "a.json", rough)
