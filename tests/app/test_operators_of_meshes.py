"""`--operator` of commands, in documents, batches, recipes and the notes on a mesh."""

import json
from dataclasses import replace

import numpy as np
import pytest

from app.document.document import MeshFile, comparison
from app.document.form import document_data, document_from
from app.document.repairs import NO_REPAIRS, OPERATORS, Repairs, with_repairs, without_repairs
from bihdist_core import BiharmonicDistance, Laplacian, ParameterError, write_mesh
from bihdist_core.analysis.surface_notes import surface_notes
from bihdist_core.intrinsic import INTRINSIC, OPERATORS as OF_CORE
from tests.batch.runs import batch
from tests.commands import ran
from tests.shapes import bumpy, caps, fin

THIN = caps(bumpy(100), 5e-3, 3)
LABEL = "biharmonic, exact, intrinsic-delaunay"


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    path = tmp_path_factory.mktemp("mesh") / "thin.ply"
    write_mesh(path, THIN)
    return path


@pytest.fixture(scope="module")
def field():
    return BiharmonicDistance(Laplacian(THIN, operator=INTRINSIC)).from_source(3)


def test_the_words_of_documents_are_those_of_the_core():
    assert tuple(OPERATORS) == OF_CORE


def test_commands_compute_by_it_and_name_it(mesh, field, tmp_path, capsys):
    out = tmp_path / "field.npy"
    words = ("field", mesh, "--sources", "3", "--operator", INTRINSIC, "-o", out)
    (about,) = json.loads(ran(capsys, *words, "--json").out)["meshes"]
    assert about["label"] == LABEL
    assert np.array_equal(np.load(out), field)
    assert f"{LABEL} " in ran(capsys, "info", mesh, "--accuracy", "--operator", INTRINSIC).out


def test_recipes_hold_it(mesh, field, tmp_path, capsys):
    picture, again = tmp_path / "one.png", tmp_path / "again.png"
    words = ("--distance", "biharmonic", "--size", "200x150")
    ran(capsys, "figure", mesh, "--sources", "3", "--operator", INTRINSIC, *words, "-o", picture)
    recipe = picture.with_suffix(".json")
    assert json.loads(recipe.read_text())["document"]["surfaces"][0]["repairs"] == {"operator": INTRINSIC}
    ran(capsys, "figure", "--recipe", recipe, "-o", again)
    assert picture.read_bytes() == again.read_bytes()


def test_a_batch_computes_by_it_and_says_so(mesh, field, tmp_path):
    words = ("--do", "fields", "--sources", "3", "--workers", "1")
    assert batch(mesh.parent, tmp_path, *words, "--operator", INTRINSIC) == 0
    assert np.array_equal(np.load(tmp_path / "thin.fields.biharmonic.npy")[:, 0], field)
    about = json.loads((tmp_path / "thin.fields.biharmonic.json").read_text())
    assert (about["operator"], about["label"]) == (INTRINSIC, LABEL)
    # By another operator it is another result.
    assert batch(mesh.parent, tmp_path, *words) == 0
    assert json.loads((tmp_path / "thin.fields.biharmonic.json").read_text())["operator"] == "cotan"


def test_of_one_file_opened_twice_each_has_its_own():
    document = comparison("thin.ply")
    document = replace(document, surfaces=(MeshFile("A", "thin.ply"), MeshFile("B", "thin.ply")))
    changed = with_repairs(document, "B", operator="tufted")
    assert [each.repairs.operator for each in changed.surfaces] == ["cotan", "tufted"]
    assert document_from(document_data(changed)) == changed
    assert without_repairs(changed, "B").surfaces[1].repairs == NO_REPAIRS
    with pytest.raises(ParameterError, match="no operator 'cot'; choose one of cotan, intrinsic-delaunay, tufted"):
        Repairs(operator="cot")


def test_where_it_matters_it_is_proposed(mesh):
    (note,) = (each for each in surface_notes(fin()).warnings if "more than two" in each)
    assert note.endswith("for which there is the operator tufted")
    (note,) = surface_notes(THIN).warnings
    assert note.endswith("thin faces, for which there is the operator intrinsic-delaunay")
    assert not surface_notes(bumpy(100)).warnings
