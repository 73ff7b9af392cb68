"""What names of mesh files say."""

import gzip

import pytest

from bihdist_core.formats import mesh_io
from bihdist_core.formats.mesh_names import FREESURFER, MESH_FORMATS, is_mesh_file, mesh_format, mesh_name
from tests.core.mesh_samples import VERTICES, freesurfer, gifti, gifti_array, gifti_surface, off
from tests.core.test_freesurfer import values


@pytest.mark.parametrize(
    ("path", "form", "name"),
    [
        ("a.off", ".off", "a"),
        ("dir.x/A.B.OFF.GZ", ".off", "A.B"),
        ("lh.pial.surf.gii.gz", ".gii", "lh.pial"),
        ("pial_left.gii.gz", ".gii", "pial_left"),
        ("lh.pial", FREESURFER, "lh.pial"),
        ("sub-01_rh.sphere.reg.gz", FREESURFER, "sub-01_rh.sphere.reg"),
        ("lh.stl", ".stl", "lh"),
        ("a.step", "", "a"),
        ("mesh", "", "mesh"),
        (".gz", "", ""),
        ("shlh.pial", "", "shlh"),
    ],
)
def test_format_and_name(path, form, name):
    assert (mesh_format(path), mesh_name(path)) == (form, name)


def test_each_format_has_a_reader():
    assert {*mesh_io._READERS} == {*MESH_FORMATS, FREESURFER}


def test_meshes_of_a_folder_are_told_from_values_beside_them(put, tmp_path):
    shape = gifti(gifti_array("SHAPE", VERTICES[:, 0]))
    meshes = {
        "a.off": off(),
        "b.off.gz": gzip.compress(off().encode()),
        "lh.pial": freesurfer(),
        "rh.white.gz": gzip.compress(freesurfer()),
        "a.surf.gii": gifti_surface(),
        "left.gii.gz": gzip.compress(gifti_surface()),
        "cut.gii.gz": gzip.compress(gifti_surface())[:-20],  # reading says what is wrong
    }
    others = {"lh.curv": values(), "a.shape.gii": shape, "sulc.gii": shape, "a.func.gii": gifti_surface(), "a.txt": "1"}
    others |= {"lh.aparc.annot": b"\0\0\0\5", "rh.thickness.gz": b"no gzip"}
    for name, content in (meshes | others).items():
        put(name, content)
    (tmp_path / "folder.gii").mkdir()
    found = {path.name for path in tmp_path.iterdir() if is_mesh_file(path) and path.is_file()}
    assert found == meshes.keys()
