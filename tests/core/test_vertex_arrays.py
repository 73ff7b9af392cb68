"""Arrays of values at vertices in files of other programs: read as these wrote them, or refused in a sentence."""

import contextlib
import gzip
import random
import sys

import numpy as np
import pytest

from bihdist_core import Surface, read_surface
from bihdist_core.errors import ParameterError
from bihdist_core.formats.field_output import FIELD_FORMATS, write_fields
from bihdist_core.formats.surface_output import write_coloured
from bihdist_core.formats.vertex_arrays import (
    array_name,
    is_vertex_array_file,
    read_vertex_array,
    read_vertex_arrays,
    split_array,
)
from tests.core.damage import damaged
from tests.core.field_samples import MORE, RGBA, VALUES, WRITERS, field_files
from tests.core.mesh_samples import FACES, VERTICES, gifti, gifti_array, gifti_surface

pytest.importorskip("nibabel")


def as_written(array):
    """The values of an array; of labels their names, None for none."""
    if not array.names:
        return array.values
    return [None if np.isnan(place) else array.names[int(place)] for place in array.values]


@pytest.mark.parametrize("name", WRITERS)
def test_arrays_are_those_that_others_write(tmp_path, name):
    path = tmp_path / name
    expected = WRITERS[name](path)
    found = {each.name: as_written(each) for each in read_vertex_arrays(path)}
    assert list(found) == list(expected)
    for word, values in expected.items():
        if (isinstance(values, list) and None in values) or isinstance(values[0], str):
            assert found[word] == values
        else:
            np.testing.assert_array_equal(found[word], values)
    packed = tmp_path / f"{name}.gz"
    packed.write_bytes(gzip.compress(path.read_bytes()))
    assert len(read_vertex_arrays(packed)) == len(expected)


@pytest.mark.parametrize("name", [name for name in WRITERS if "label" in name or "annot" in name])
def test_colours_of_labels_are_the_files(tmp_path, name):
    WRITERS[name](tmp_path / name)
    first = read_vertex_arrays(tmp_path / name)[0]
    assert first.names[-2:] == ("front", "back")
    np.testing.assert_allclose(first.colours[-2:], np.array(RGBA)[1:, :3] / 255, atol=1e-6)


def test_labels_without_colours_get_some(put):
    table = b'<LabelTable><Label Key="3">a</Label><Label Key="7" Red="x">b</Label></LabelTable>'
    labels = gifti(gifti_array("LABEL", np.array([3, 7, 3, 0, 3], "i4"))).replace(b"<LabelTable/>", table)
    found = read_vertex_array(put("a.label.gii", labels))
    assert as_written(found) == ["a", "b", "a", None, "a"]
    assert len(np.unique(found.colours, axis=0)) == 2


@pytest.mark.parametrize("extension", [*FIELD_FORMATS, ".glb"])
def test_fields_that_this_program_writes_are_read_again(tmp_path, extension):
    path, surface = tmp_path / f"mine{extension}", Surface(VERTICES, FACES)
    fields = {"one": VALUES, "two": MORE}
    if extension == ".glb":
        write_coloured(path, surface, np.zeros((5, 3), np.uint8), fields)
    else:
        write_fields(path, surface, fields)
    for found, values in zip(read_vertex_arrays(path), fields.values(), strict=True):
        np.testing.assert_array_equal(found.values, values)


def test_values_of_a_mesh_are_those_of_its_vertices(tmp_path):
    for path in field_files(tmp_path):
        if path.suffix in (".vtp", ".vtu", ".ply", ".glb"):
            surface = read_surface(path)
            np.testing.assert_allclose(surface.vertices, VERTICES)
            assert len(read_vertex_array(path, read_vertex_arrays(path)[0].name).values) == len(surface.vertices)


def test_one_of_several_is_named(tmp_path):
    path = tmp_path / "table.csv"
    WRITERS["table.csv"](path)
    np.testing.assert_array_equal(read_vertex_array(path, "curv").values, MORE)
    with pytest.raises(
        ParameterError, match=r"has 2 arrays, depth, mm, curv; name one behind a colon, .*csv:depth, mm"
    ):
        read_vertex_array(path)
    with pytest.raises(ParameterError, match=r"has no array 'sulc'; it has depth, mm, curv\."):
        read_vertex_array(path, "sulc")
    many = tmp_path / "many.npy"
    np.save(many, np.zeros((30, 20)))
    with pytest.raises(ParameterError, match="10, 11 and 8 more; name one"):
        read_vertex_array(many)


def test_an_array_is_named_behind_a_colon(tmp_path):
    path = tmp_path / "a:b.csv"
    assert split_array(f"{path}:c") == (f"{path}:c", "")
    path.write_text("1\n2\n")
    assert split_array(str(path)) == (str(path), "")
    assert split_array(f"{path}:c:d") == (str(path), "c:d")


def test_names_of_arrays():
    named = {
        "a/lh.thickness": "thickness",
        "rh.aparc.annot.gz": "aparc",
        "lh": "lh",
        "sub-1_hemi-L_sulc.shape.gii": "sub-1_hemi-L_sulc",
        "S1.MyelinMap.32k.dscalar.nii": "S1.MyelinMap.32k",
        "v0.5.npy": "v0.5",
    }
    assert {path: array_name(path) for path in named} == named
    assert array_name("table.csv", "curv") == "curv"
    assert array_name("table.npy", "3") == "table 3"


def test_files_of_fields_are_told_from_meshes(tmp_path, put):
    field_files(tmp_path)
    named = {path.name: is_vertex_array_file(path) for path in tmp_path.iterdir()}
    assert {name for name, is_field in named.items() if not is_field} == {"f.vtu", "f.ply", "f.vtp", "f.glb"}
    assert not is_vertex_array_file(put("a.gii", gifti_surface()))
    assert not is_vertex_array_file(put("lh.pial", b"\xff\xff\xfe"))
    assert not is_vertex_array_file(tmp_path / "none.off")


REFUSED = {
    "words.csv": ("a,b\n1,2\n3,x\n", r"line 2: 'x' is not a number"),
    "uneven.csv": ("a,b\n1,2\n3\n", r"line 3: there are 1 values where 2 belong"),
    "empty.txt": ("# nothing\n", "has no lines of numbers"),
    "none.npy": ("no array", "it is not a .npy file"),
    "none.npz": ("no archive", "is not an archive of arrays"),
    "none.mat": ("no matrices", "is not a MAT file of version 5"),
    "new.mat": ("MATLAB 7.3 MAT-file", "of version 7.3 .HDF5., which is not read; save it with -v7"),
    "none.nii": ("no image", "is not a CIFTI file, or is damaged"),
    "lh.cortex.label": ("#!ascii label\n0\n", "lists the vertices of a label"),
    "some.xyz": ("1 2 3", "is of no kind of which fields are read: .npy, .npz"),
    "surface.gii": (gifti_surface(), "has no array of real numbers with a value for each vertex"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_field_is_refused_in_a_sentence(put, name):
    content, message = REFUSED[name]
    with pytest.raises(ParameterError, match=message) as caught:
        read_vertex_arrays(put(name, content))
    assert "\n" not in str(caught.value)


def test_a_missing_file_and_missing_nibabel_are_named(tmp_path, monkeypatch):
    with pytest.raises(ParameterError, match="there is no such file"):
        read_vertex_arrays(tmp_path / "a.npy")
    path = tmp_path / "f.dscalar.nii"
    WRITERS[path.name](path)
    monkeypatch.setitem(sys.modules, "nibabel.cifti2", None)
    with pytest.raises(ParameterError, match="is a CIFTI file, which nibabel reads; install nibabel"):
        read_vertex_arrays(path)


@pytest.mark.parametrize("name", WRITERS)
def test_damaged_files_are_read_or_refused(tmp_path, name):
    rng = random.Random(f"fields {name}")
    path = tmp_path / name
    WRITERS[name](path)
    content = path.read_bytes()
    for _ in range(60):
        path.write_bytes(damaged(content, rng))
        with contextlib.suppress(ParameterError):
            assert all(each.values.ndim == 1 for each in read_vertex_arrays(path))
