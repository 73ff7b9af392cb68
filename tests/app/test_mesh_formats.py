"""Mesh files of all formats through the commands and the session: what they are called, and which way is up."""

import gzip

import numpy as np
import pytest

from app.document.document import MeshFile
from app.document.file_names import file_name
from app.main import main
from app.session.loaded_mesh import open_mesh
from bihdist_core.formats.mesh_names import MESH_FORMATS
from tests.core.mesh_samples import freesurfer, gifti_surface, gltf, gltf_parts, off
from tests.shapes import bumpy

SHAPE = bumpy(60)


def test_the_help_names_all_formats(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    said = " ".join(capsys.readouterr().out.split())
    assert all(extension in said for extension in (*MESH_FORMATS, ".gz", "lh.pial"))


def test_outputs_are_called_as_the_meshes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lh.pial").write_bytes(freesurfer(SHAPE.vertices, SHAPE.faces))
    (tmp_path / "rh.pial.surf.gii.gz").write_bytes(gzip.compress(gifti_surface(SHAPE.vertices, SHAPE.faces)))
    (tmp_path / "a.off.gz").write_bytes(gzip.compress(off(SHAPE.vertices, SHAPE.faces).encode()))
    meshes = ["lh.pial", "rh.pial.surf.gii.gz", "a.off.gz"]
    assert main(["field", *meshes, "--sources", "3", "-o", "{name}.npy"]) == 0
    lefts, rights, packed = (np.load(f"{name}.npy") for name in ("lh.pial", "rh.pial", "a"))
    np.testing.assert_array_equal(rights, packed)
    np.testing.assert_allclose(lefts, rights, rtol=1e-4)  # single precision
    assert file_name(meshes, "field") == "lh.pial-rh.pial-a-field"


@pytest.mark.parametrize(
    ("name", "content", "up"),
    [
        ("lh.white", freesurfer(SHAPE.vertices, SHAPE.faces), "z"),
        ("rh.white.gii", gifti_surface(SHAPE.vertices, SHAPE.faces), "z"),
        ("a.gltf.gz", gzip.compress(gltf(*gltf_parts(SHAPE.vertices, SHAPE.faces))), "y"),
    ],
)
def test_which_way_is_up_in_their_formats(tmp_path, name, content, up):
    (tmp_path / name).write_bytes(content)
    loaded = open_mesh(MeshFile("A", str(tmp_path / name)))
    assert (loaded.surface.name, loaded.up) == (name, up)
