"""Both hemispheres in one command: two files are one mesh, whose table has NaN between them."""

import numpy as np
import pytest

from app.batch.mesh_files import find_mesh_files
from app.document.file import checksum
from bihdist_core import BiharmonicDistance, ParameterError, read_surface, write_mesh
from bihdist_core.formats.mesh_names import files_of, mesh_name
from tests.batch.runs import batch, rows
from tests.commands import ran, refused
from tests.core.mesh_samples import freesurfer
from tests.shapes import bumpy

LEFT, RIGHT = bumpy(80), bumpy(100, 1)


@pytest.fixture
def subjects(tmp_path, monkeypatch):
    """Two subjects with two surfaces of each hemisphere, as FreeSurfer names them, and files that are no surfaces."""
    monkeypatch.chdir(tmp_path)
    for subject in ("sub-1", "sub-2"):
        folder = tmp_path / subject / "surf"
        folder.mkdir(parents=True)
        for kind in ("pial", "white"):
            for side, surface in (("lh", LEFT), ("rh", RIGHT)):
                (folder / f"{side}.{kind}").write_bytes(freesurfer(surface.vertices, surface.faces))
        (folder / "lh.thickness").write_bytes(b"\xff\xff\xff" + bytes(30))
    return tmp_path


def alone(side, sources):
    surface = read_surface(f"sub-1/surf/{side}.pial")
    return BiharmonicDistance(surface).from_sources(sources)


def test_two_files_are_one_mesh_with_nan_between_them(subjects, capsys):
    mesh = "sub-1/surf/lh.pial+rh.pial"
    assert (files_of(mesh)[1], mesh_name(mesh)) == ("sub-1/surf/rh.pial", "lh.pial+rh.pial")
    surface = read_surface(mesh)
    assert surface.facts[0] == "vertices 0 to 79 are of lh.pial"
    assert surface.facts[1] == "vertices 80 to 179 are of rh.pial"
    ran(capsys, "field", mesh, "--sources", "3,85,7+90", "-o", "field.npy")
    field = np.load("field.npy")
    assert field.shape == (180, 3)
    assert np.isnan(field[80:, 0]).all()
    assert np.isnan(field[:80, 1]).all()
    # Each hemisphere is measured as if it were alone.
    assert field[:80, 0] == pytest.approx(alone("lh", [3])[:, 0], abs=1e-12)
    assert field[80:, 1] == pytest.approx(alone("rh", [5])[:, 0], abs=1e-12)
    assert field[:80, 2] == pytest.approx(alone("lh", [7])[:, 0], abs=1e-12)
    assert field[80:, 2] == pytest.approx(alone("rh", [10])[:, 0], abs=1e-12)
    ran(capsys, "pairs", mesh, "--sources", "all")
    table = np.load("lh.pial+rh.pial-pairs.npy")
    assert np.isnan(table[:80, 80:]).all()
    assert np.isnan(table[80:, :80]).all()
    assert np.isfinite(table[:80, :80]).all()
    assert np.isfinite(table[80:, 80:]).all()


def test_a_batch_joins_the_hemispheres_of_all_subjects_by_a_pattern(subjects):
    assert batch("sub-*/surf/lh.*+rh.*", "out", "--do", "fields,pairs", "--sources", "3,85") == 0
    names = {row["mesh"] for row in rows("out")}
    assert names == {f"sub-{k}_surf_lh.{kind}+rh.{kind}" for k in (1, 2) for kind in ("pial", "white")}
    pairs = np.load("out/sub-2_surf_lh.white+rh.white.pairs.biharmonic.npy")
    assert np.isnan(pairs).tolist() == [[False, True], [True, False]]
    fields = np.load("out/sub-1_surf_lh.pial+rh.pial.fields.biharmonic.npy")
    assert fields.shape == (180, 2)
    # Either file counts for whether a result is still good.
    before = checksum("sub-1/surf/lh.pial+rh.pial")
    (subjects / "sub-1/surf/rh.pial").write_bytes(freesurfer(RIGHT.vertices * 2, RIGHT.faces))
    assert checksum("sub-1/surf/lh.pial+rh.pial") != before
    assert batch("sub-*/surf/lh.pial+rh.pial", "out", "--do", "fields", "--sources", "3,85") == 0
    again = np.load("out/sub-1_surf_lh.pial+rh.pial.fields.biharmonic.npy")
    assert again[80:, 1] == pytest.approx(2 * fields[80:, 1], rel=1e-6)


def test_a_list_may_join_files_and_name_patterns(subjects):
    (subjects / "more").mkdir()
    (subjects / "more/list.txt").write_text("../sub-2/surf/lh.pial+rh.pial\n../sub-1/surf/lh.w*+rh.w*\n")
    found = find_mesh_files([], "more/list.txt")
    assert list(found.paths) == ["lh.pial+rh.pial", "lh.white+rh.white"]


def test_figures_and_recipes_take_both(subjects, capsys):
    ran(capsys, "figure", "sub-1/surf/lh.pial+rh.pial", "--sources", "3+90", "--distance", "biharmonic", "-o", "a.png")
    ran(capsys, "figure", "--recipe", "a.json", "-o", "b.png")
    assert (subjects / "a.png").read_bytes() == (subjects / "b.png").read_bytes()
    (subjects / "sub-1/surf/rh.pial").write_bytes(freesurfer(RIGHT.vertices * 2, RIGHT.faces))
    assert "has changed" in refused(capsys, "figure", "--recipe", "a.json", "-o", "b.png")


def test_a_file_that_is_not_there_is_named(subjects, capsys):
    assert "There is no file sub-1/surf/lh.pial+rh.none" in refused(
        capsys, "field", "sub-1/surf/lh.pial+rh.none", "-o", "a.npy"
    )
    (subjects / "sub-2/surf/rh.pial").unlink()
    found = find_mesh_files(["sub-*/surf/lh.pial+rh.pial"])
    assert list(found.paths) == ["sub-1_surf_lh.pial+rh.pial"]
    assert list(found.missing.values()) == ["There is no file rh.pial beside sub-2/surf/lh.pial."]
    with pytest.raises(ParameterError, match=r"There is no mesh sub-\*/surf/lh.none"):
        find_mesh_files(["sub-*/surf/lh.none+rh.none"])


def test_a_file_may_have_a_plus_in_its_name(subjects):
    write_mesh("a+b.off", LEFT)
    assert (len(read_surface("a+b.off").vertices), mesh_name("a+b.off")) == (80, "a+b")
