"""Values at vertices in GIFTI and FreeSurfer files, wherever labels and masks are read."""

import gzip

import numpy as np
import pytest

from bihdist_core import read_vertex_values
from bihdist_core.errors import ParameterError
from bihdist_core.formats.vertex_values import is_vertex_values, read_label_vertices
from bihdist_core.formats.whole_numbers import read_whole_numbers
from tests.core.mesh_samples import gifti, gifti_array, gifti_surface
from tests.core.test_freesurfer import VALUES, annotation, values
from tests.core.test_freesurfer_label import label

LABELS = np.array([3, 0, 3, 1, -1], "i4")
FILES = {
    "lh.thickness": (values(), VALUES),
    "sub-1_rh.curv.gz": (gzip.compress(values()), VALUES),
    "a.shape.gii": (gifti(gifti_array("SHAPE", VALUES)), VALUES),
    "a.func.gii.gz": (gzip.compress(gifti(gifti_array("NONE", VALUES[:, None]))), VALUES),
    "lh.label.gii": (gifti(gifti_array("LABEL", LABELS)), LABELS),
    "with_surface.gii": (gifti_surface().replace(b'Arrays="2"', b'Arrays="3"')[:-9], LABELS),
    "any.annot": (annotation(), np.array([1, 2, 0, 2, -1])),
}
FILES["with_surface.gii"] = (
    FILES["with_surface.gii"][0] + gifti_array("LABEL", LABELS).encode() + b"</GIFTI>\n",
    LABELS,
)


@pytest.mark.parametrize("name", FILES)
def test_values_are_the_files(put, name):
    content, expected = FILES[name]
    found = read_vertex_values(put(name, content))
    np.testing.assert_array_equal(found, expected)
    assert found.dtype.kind == expected.dtype.kind


@pytest.mark.parametrize("name", ["lh.label.gii", "any.annot"])
def test_labels_and_masks_are_read_from_them(put, name):
    content, expected = FILES[name]
    found = read_whole_numbers(put(name, content), "labels")
    np.testing.assert_array_equal(found, expected)
    assert found.dtype == np.int64


def test_a_mask_of_floats(put):
    mask = np.array([0, 1, 1, 0, 1], np.float32)
    assert read_whole_numbers(put("lh.cortex", values(mask)), "mask").tolist() == [0, 1, 1, 0, 1]
    assert read_whole_numbers(put("a.func.gii", gifti(gifti_array("NONE", mask))), "mask").tolist() == [0, 1, 1, 0, 1]
    path = put("lh.thickness", values())
    with pytest.raises(ParameterError, match=r"The mask in .*lh.thickness: float32 values that are not whole numbers"):
        read_whole_numbers(path, "mask")


def test_names_say_whether_a_file_is_one_of_values():
    named = (
        "lh.thickness",
        "a.GII",
        "a.label.gii.gz",
        "x.annot",
        "V1.label",
        "V1.label.gz",
        "sub-01_rh.sulc",
        "dir/lh.curv",
    )
    others = ("lh.txt", "a.npy", "lh.labels.npy", "mesh.off", "shlh.x", "lh")
    assert [name for name in named if not is_vertex_values(name)] == []
    assert [name for name in others if is_vertex_values(name)] == []


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("a.shape.gii", gifti(gifti_array("SHAPE", VALUES), gifti_array("SHAPE", VALUES)), "has 2 arrays of values"),
        ("a.surf.gii", gifti_surface(), "has 0 arrays of values; one is needed"),
        ("a.func.gii", gifti(gifti_array("NONE", np.ones((5, 2)))), r"values of the shape \(5, 2\)"),
        ("a.func.gii", b"<GIFTI>", "is not a GIFTI file"),
        ("lh.thickness", values()[:-1], "announces 5 values and holds 4"),
        ("lh.thickness.gz", b"x", "is not a gzip file"),
        ("a.annot", b"x", "announces 1 numbers and holds 0"),
    ],
)
def test_what_is_refused(put, name, content, expected):
    path = put(name, content)
    with pytest.raises(ParameterError, match=expected) as caught:
        read_vertex_values(path)
    assert name in str(caught.value)
    assert str(caught.value).endswith(".")


def test_a_label_is_a_mask_of_its_vertices(put):
    path = put("lh.cortex.label", label([4, 0, 2]))
    assert read_vertex_values(path, n_vertices=6).tolist() == [1, 0, 1, 0, 1, 0]
    assert read_whole_numbers(put("V1.label.gz", gzip.compress(label([1]))), "mask", 3).tolist() == [0, 1, 0]
    assert read_label_vertices(path, 6).tolist() == [4, 0, 2]
    with pytest.raises(ParameterError, match=r"^lh.cortex.label lists the vertices of a label; the map needs"):
        read_whole_numbers(path, "map")
    with pytest.raises(ParameterError, match="line 3: vertex 4 is not one of the 4 of the surface"):
        read_vertex_values(path, n_vertices=4)


def test_a_file_that_cannot_be_read(tmp_path, monkeypatch):
    with pytest.raises(ParameterError, match=r"The mask in .*lh.mask cannot be read: there is no such file"):
        read_whole_numbers(tmp_path / "lh.mask", "mask")
    (tmp_path / "lh.mask").write_bytes(values())

    def denied(_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.read_bytes", denied)
    with pytest.raises(ParameterError, match="cannot be read: Permission denied"):
        read_whole_numbers(tmp_path / "lh.mask", "mask")


def test_other_files_are_refused_with_all_that_is_read(tmp_path):
    with pytest.raises(
        ParameterError, match=r"file of the mask; such files are \.npy, \.txt, \.gii, \.annot, \.label, FreeSurfer's"
    ):
        read_whole_numbers(tmp_path / "a.csv", "mask")
