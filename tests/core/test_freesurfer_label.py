"""FreeSurfer's labels, the vertices of which stand in lines of text."""

import random

import numpy as np
import pytest

from bihdist_core.errors import MeshError
from bihdist_core.formats.freesurfer import label_name, read_label
from tests.core.damage import damaged
from tests.core.mesh_samples import message_of


def label(ids, count=None, first="#!ascii label  , from subject  vox2ras=TkReg"):
    lines = [first, str(len(ids) if count is None else count)]
    lines += [f"{vertex}  {vertex / 7:.3f}  -1.5  2.25e1 0.0000000000" for vertex in ids]
    return ("\n".join(lines) + "\n").encode()


@pytest.mark.parametrize("ids", [[3, 0, 77, 12], [5], []])
def test_the_vertices_are_those_of_the_lines(ids):
    assert read_label(label(ids), "lh.a.label", 78).tolist() == ids
    assert read_label(label(ids).replace(b"\n", b"\r\n") + b"# the end\n", "lh.a.label").tolist() == ids


def test_labels_are_read_as_by_nibabel(tmp_path):
    nibabel = pytest.importorskip("nibabel.freesurfer")
    (tmp_path / "lh.a.label").write_bytes(label([9, 4, 6]))
    expected = nibabel.read_label(str(tmp_path / "lh.a.label"))
    np.testing.assert_array_equal(read_label((tmp_path / "lh.a.label").read_bytes(), "lh.a.label"), expected)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"3\n", "is not a FreeSurfer label: its first line"),
        (b"", "is not a FreeSurfer label"),
        (b"#!ascii label\n", "is cut off: the number of its vertices"),
        (label([1], count="1 2"), "line 2: '1 2' is not the number of its vertices"),
        (label([1], count="1.5"), "line 2: '1.5' is not the number of its vertices"),
        (label([1], count="-1"), "line 2: '-1' is not the number"),
        (label([1], count="nan"), "line 2: 'nan' is not the number"),
        (label([1, 2], count=3), "announces 3 vertices and lists 2; it is cut off"),
        (label([1, 2], count=1), "announces 1 vertex and lists 2; it continues"),
        (label([1, 2])[:-14] + b"\n", "line 4: '2  0.286  -1.5  2.25e1' is not a vertex, x, y, z and a value"),
        (label([1]).replace(b"\n1  ", b"\none  "), "line 3: 'one' is not a number"),
        (label([1, -1]), "line 4: vertex -1 is a place that belongs to no vertex; map the label onto the surface"),
        (label([1, -2]), "line 4: vertex -2 is not one of the 9 of the surface"),
        (label([9]), "line 3: vertex 9 is not one of the 9 of the surface"),
        (label([2.5]), "line 3: vertex 2.5 is not one of the 9"),
    ],
)
def test_what_is_refused(content, said):
    with pytest.raises(MeshError) as caught:
        read_label(content, "lh.a.label", 9)
    assert str(caught.value).startswith("lh.a.label")
    assert said in str(caught.value)


def test_without_a_surface_ids_are_whole_numbers():
    assert read_label(label([10**6]), "a.label").tolist() == [10**6]
    for wrong in (2.5, -3, 1e30):
        with pytest.raises(MeshError, match="is not a whole number from 0"):
            read_label(label([1]).replace(b"\n1  ", f"\n{wrong}  ".encode()), "a.label")


def test_damaged_files_give_ids_or_one_sentence():
    rng, content = random.Random(0), label(range(0, 90, 3))
    messages = [
        message_of(lambda raw, name: read_label(raw, name, 90), damaged(content, rng), "lh.a.label") for _ in range(800)
    ]
    assert sum(map(bool, messages)) > 400
    assert all("lh.a.label" in message and "\n" not in message for message in messages if message)


@pytest.mark.parametrize(
    ("path", "name"),
    [("x/lh.cortex.label", "cortex"), ("rh.BA1_exvivo.thresh.label.gz", "BA1_exvivo.thresh"), ("V1.label", "V1")],
)
def test_what_a_label_is_called(path, name):
    assert label_name(path) == name
