"""Files of all formats through the commands and the session: names, which way is up, and what writes them."""

import doctest
import gzip
import re

import numpy as np
import pytest

from app.document.document import MeshFile
from app.document.file_names import file_name
from app.main import main
from app.samples import sample, sample_names
from app.session.loaded_mesh import open_mesh
from bihdist_core import MissingFileError
from bihdist_core.formats.mesh_names import MESH_FORMATS
from tests.commands import refused
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


# ---------------------------------------------------------------------- file names
@pytest.mark.parametrize(
    ("meshes", "what", "of", "name"),
    [
        (["/home/a/spot.obj"], "figure", (), "spot-figure"),
        (["spot.obj"], "field", ("biharmonic_from_12",), "spot-field-biharmonic-from-12"),
        (["cat.off", "dog.off"], "pairs", (), "cat-dog-pairs"),
        (["cat.off", "cat.off"], "map", ("diffusion(t=1/4)",), "cat-map-diffusion-t-1-4"),
        (["hand, noise 0.3"], "regions", ("labels",), "hand-noise-0.3-regions-labels"),
        (["scan.v2.ply"], "selection", ("left / right: ß",), "scan.v2-selection-left-right-ß"),
        ([""], "session", (), "session"),
        ([], "curve", (), "curve"),
    ],
)
def test_a_name_says_the_mesh_what_it_is_and_of_what(meshes, what, of, name):
    assert file_name(meshes, what, *of) == name


# ---------------------------------------------------------------------- array output
@pytest.mark.parametrize(
    ("command", "extension"),
    [
        (["field", "--sources", "3"], "mat"),
        (["field", "--sources", "3"], "npz"),
        (["pairs", "--sources", "3,7"], "MAT"),
        (["pairs", "--sources", "all"], "npz"),
        (["pairs", "--nearest", "--k", "3"], "mat"),
    ],
)
def test_the_batch_that_writes_a_format_is_named_and_does(mesh_file, tmp_path, capsys, command, extension):
    mesh, (word, *options) = mesh_file(bumpy(60)), command
    said = refused(capsys, word, mesh, *options, "-o", tmp_path / f"x.{extension}")
    found = re.search(r"by `bihdist (batch --do \w+ --format \w+) -o FOLDER`; here the formats are .*\.npy", said)
    assert found, said
    words = [*found[1].split(), *options, "--workers", "1", "-o", str(tmp_path / "results")]
    if "--nearest" in words:
        words.remove("--nearest")
    assert main([words[0], mesh, *words[1:]]) == 0
    assert list((tmp_path / "results").glob(f"*.{extension.lower()}"))


@pytest.mark.parametrize("word", ["field", "pairs"])
def test_formats_that_nothing_writes_are_refused_as_ever(mesh_file, tmp_path, capsys, word):
    assert main([word, mesh_file(bumpy(60)), "--sources", "3,7", "-o", str(tmp_path / "x.foo")]) == 2
    assert "has the extension '.foo'; this can be written as .npy, .csv" in capsys.readouterr().err


# ---------------------------------------------------------------------- samples
def test_a_sample_is_a_surface():
    assert {name: sample(name).name for name in sample_names()} == {name: f"{name}.ply" for name in sample_names()}


@pytest.mark.parametrize("name", ["hans", "hand.ply", "../hand", ""])
def test_what_is_none_is_refused_with_all_names(name):
    with pytest.raises(MissingFileError) as error:
        sample(name)
    assert f"{name!r}; choose from {', '.join(sample_names())}" in str(error.value)


def test_its_example():
    (example,) = doctest.DocTestFinder(recurse=False).find(sample, "sample", globs={"sample": sample})
    assert doctest.DocTestRunner().run(example).failed == 0
