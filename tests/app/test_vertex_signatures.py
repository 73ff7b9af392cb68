"""Signatures of vertices in panels, commands, batches and movies."""

import json

import numpy as np
import pytest

from app.document.document import comparison
from app.document.page import Recipe
from app.document.quantities import VertexSignature, quantity, quantity_from
from app.figures.movie import Movie
from app.samples import mesh_path
from bihdist_core import ParameterError, heat_kernel_signature, write_mesh
from bihdist_core.analysis.signature_types import SIGNATURES
from tests.batch.runs import batch
from tests.commands import ran, refused
from tests.shapes import bumpy, two_pieces


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    path = tmp_path_factory.mktemp("mesh") / "bumpy.off"
    write_mesh(path, bumpy(150))
    return path


@pytest.mark.parametrize("words", [*SIGNATURES, "hks(t=1/10)", "wks(energy=30, sigma=1/5)", "bks - biharmonic"])
def test_words_and_records_mean_the_same(words):
    shows = quantity(words)
    assert str(shows) == words
    assert quantity_from(shows.to_json(), "shows") == shows


def test_wrong_words_and_records_say_what_there_is():
    with pytest.raises(ParameterError, match=r"hks has no parameter 'k'; it has t\."):
        quantity("hks(k=3)")
    with pytest.raises(ParameterError, match=r"shows\.signature: There is no signature 'gks'"):
        quantity_from({"signature": "gks"}, "shows")


def test_the_command_field_writes_what_the_library_computes(mesh, tmp_path, capsys):
    out = tmp_path / "field.npy"
    facts = json.loads(ran(capsys, "field", mesh, "--quantity", "hks", "--t", "0.5", "-o", out, "--json").out)
    wanted = heat_kernel_signature(bumpy(150), 0.5)
    assert np.array_equal(np.load(out), wanted.values)
    (about,) = facts["meshes"]
    assert (about["label"], about["unit"], about["columns"]) == (wanted.label, wanted.unit, ["hks"])
    assert about["accuracy"] == wanted.accuracy
    assert "--t 0.5 is not a parameter of bks" in refused(capsys, "field", mesh, "--quantity", "bks", "--t", "0.5")
    said = refused(capsys, "field", mesh, "--quantity", "hsk")
    assert "no distance 'hsk'" in said
    assert "Signatures are centrality, bks, hks, wks, and a difference is written 'a - b'." in said


def test_between_two_vertices_there_is_none(mesh, capsys):
    said = refused(capsys, "pairs", mesh, "--pairs", "1:2", "--distance", "bks")
    assert "'bks' is a field, and has no value between two vertices" in said
    assert "'hks' is a field" in refused(capsys, "batch", mesh, "--do", "fields,fps", "--distance", "hks", "-o", "x")


def test_a_batch_writes_them_for_each_mesh(mesh, tmp_path):
    write_mesh(mesh.parent / "pieces.off", two_pieces())
    assert batch(mesh.parent, tmp_path, "--do", "fields", "--distance", "hks(t=1/2),biharmonic", "--workers", "1") == 0
    found = np.load(tmp_path / "bumpy.fields.hks_t_1_2.npy")
    assert np.array_equal(found[:, 0], heat_kernel_signature(bumpy(150), 0.5).values)
    assert np.load(tmp_path / "pieces.fields.hks_t_1_2.npy").shape == (len(two_pieces().vertices), 1)
    about = json.loads((tmp_path / "bumpy.fields.hks_t_1_2.json").read_text())
    assert (about["distance"], about["unit"]) == ("hks(t=1/2)", "1 / mesh units^2")
    assert "sources" not in about


def test_a_movie_sweeps_their_parameters():
    document = comparison(mesh_path("hand"), (quantity("wks"), quantity("bks")))
    movie = Movie(Recipe(document), frames=3, sweep="energy=1..100")
    assert movie.values() == pytest.approx([1, 10, 100])


def test_an_answer_that_fails_says_why(mesh, tmp_path, capsys):
    said = ran(capsys, "field", mesh, "--quantity", "wks(energy=1e9)", "-o", tmp_path / "f.npy", status=2).err
    assert "may be off by more than 1e-03 of its maximum" in said


def test_other_parameters_make_another_quantity():
    shows = quantity("hks")
    assert isinstance(shows, VertexSignature)
    assert str(shows.with_spec(shows.spec.changed(t=2))) == "hks(t=2)"
    assert shows.points == shows.specs == ()
    assert shows.is_alike(quantity("hks(t=2)"))  # values that a slider passes are one step
    assert quantity("hks - biharmonic").is_alike(quantity("hks(t=2) - biharmonic"))
    assert not shows.is_alike(quantity("bks"))
