"""`--cut`, `--merge` and `--largest-component`, of commands and in documents: repairs before anything is measured."""

import json

import numpy as np
import pytest

from app.document.document import comparison
from app.document.file import read_recipe, recipe_text
from app.document.page import Recipe
from app.document.repairs import Repairs, with_repairs
from app.main import main
from app.session.array_store import ArrayStore
from app.session.loaded_mesh import open_mesh
from app.session.recipe_file import recipe_written
from bihdist_core import BiharmonicDistance, ParameterError, Surface, VertexError, farthest_points, voronoi_regions
from bihdist_core.formats.surface_output import write_mesh
from tests.core.mesh_samples import gifti, gifti_array
from tests.core.test_cutting import by_hand
from tests.core.test_merging import torn
from tests.shapes import bumpy

N = 200


@pytest.fixture
def mesh(tmp_path):
    """A mesh, and a mask that cuts its top off, in four kinds of files."""
    surface = bumpy(N)
    keeps = surface.vertices[:, 2] < 0.5
    write_mesh(tmp_path / "mesh.ply", surface)
    np.save(tmp_path / "mesh.mask.npy", keeps)
    (tmp_path / "mask.txt").write_text("".join(f"{int(each)}\n" for each in keeps))
    (tmp_path / "mask.shape.gii").write_bytes(gifti(gifti_array("SHAPE", keeps.astype("f4"))))
    return tmp_path, surface, keeps


def run(*words):
    return main([*map(str, words)])


@pytest.mark.parametrize("mask", ["{name}.mask.npy", "mask.txt", "mask.shape.gii"])
def test_fields_are_those_of_a_mesh_cut_by_hand(mesh, mask):
    folder, surface, keeps = mesh
    alone, ids = by_hand(surface, np.flatnonzero(~keeps).tolist())
    assert run("field", folder / "mesh.ply", "--sources", ids[3], "--cut", folder / mask, "-o", folder / "f.npy") == 0
    found = np.load(folder / "f.npy").ravel()
    np.testing.assert_allclose(found[ids], BiharmonicDistance(alone).from_source(3), rtol=1e-9, atol=1e-12)
    assert np.isnan(np.delete(found, ids)).all()


def test_pairs_samples_and_regions_are_on_the_cut_surface(mesh):
    folder, surface, keeps = mesh
    cut = surface.without(~keeps)
    distance = BiharmonicDistance(cut)
    options = (folder / "mesh.ply", "--cut", folder / "mask.txt")
    (first, *_) = ids = np.flatnonzero(cut.component_of_vertex == 0)[[0, 9, 30]].tolist()
    listed = ",".join(map(str, ids))
    assert run("pairs", *options, "--sources", listed, "-o", folder / "p.npy") == 0
    np.testing.assert_allclose(np.load(folder / "p.npy"), distance.pairwise(ids), rtol=1e-9)
    assert run("samples", *options, "--sources", f"farthest:9:{first}", "-o", folder / "s.npy") == 0
    assert np.load(folder / "s.npy").tolist() == farthest_points(distance, first, 9).tolist()
    assert run("regions", *options, "--sources", listed, "-o", folder / "r.npy") == 0
    # Pins are numbered from 1.
    labels = voronoi_regions(cut, distance.from_sources(ids)).labels
    assert (labels[~keeps] < 0).all()
    np.testing.assert_array_equal(np.load(folder / "r.npy"), np.where(labels < 0, np.nan, labels + 1))


def test_what_is_cut_is_said_and_stands_in_json(mesh, capsys):
    folder, surface, keeps = mesh
    gone = int((~keeps).sum())
    assert run("info", folder / "mesh.ply", "--cut", folder / "mask.txt", "--json") == 0
    (about,) = json.loads(capsys.readouterr().out)["meshes"]
    assert about["n_faces"] == surface.without(~keeps).n_faces
    assert about["repairs"][0].startswith(f"{gone} vertices cut out, with ")
    words = ("field", folder / "mesh.ply", "--sources", int(keeps.argmax()), "--cut", folder / "mask.txt")
    assert run(*words, "-o", folder / "f.npy") == 0
    assert f"mesh.ply: {gone} vertices cut out, with " in capsys.readouterr().err


@pytest.mark.parametrize(
    ("mask", "said"),
    [
        (
            "1\n" * (N - 1),
            "mask.txt: A mask has 0 or 1 for each of the 200 vertices of mesh.ply; this one has",
        ),
        ("2\n" * N, "vertex 0 has 2"),
        ("0\n" * N, "mask.txt: mesh.ply: no face is left without 200 vertices."),
        ("one\n", "mask.txt, line 1: 'one' is not a whole number."),
        (None, "The mask in"),
    ],
)
def test_masks_that_cut_nothing_sensible(mesh, capsys, mask, said):
    folder, *_ = mesh
    path = folder / "mask.txt"
    path.unlink()
    if mask:
        path.write_text(mask)
    assert run("field", folder / "mesh.ply", "--cut", path, "-o", folder / "f.npy") == 2
    told = capsys.readouterr().err
    assert said in told
    assert str(path) in told
    assert len(told.splitlines()) == 1


# ---------------------------------------------------------------------- merging
def test_merged_vertices_are_numbered_anew_by_a_table(tmp_path, capsys):
    surface = torn(bumpy(60))
    write_mesh(tmp_path / "torn.ply", surface)
    whole, ids = surface.merged(1e-6)
    assert run("field", tmp_path / "torn.ply", "--merge", "1e-6", "--json", "-o", tmp_path / "{name}.f.npy") == 0
    about = json.loads(capsys.readouterr().out)
    table = tmp_path / "torn.f.ids.csv"
    assert about["meshes"][0]["outputs"] == [str(tmp_path / "torn.f.npy"), str(table)]
    found = np.loadtxt(table, int, delimiter=",", skiprows=1)
    assert table.read_text().startswith("old,new\n0,0\n")
    np.testing.assert_array_equal(found, np.stack([np.arange(len(ids)), ids], 1))
    assert len(np.load(tmp_path / "torn.f.npy")) == whole.n_vertices == 60


def read_table(path):
    return np.loadtxt(path, int, delimiter=",", skiprows=1)[:, 1]


def test_every_command_with_an_output_writes_the_table(tmp_path, capsys):
    surface, other = torn(bumpy(60)), torn(bumpy(40, seed=1))
    ids, other_ids = surface.merged()[1], other.merged()[1]
    for name, each in (("torn", surface), ("other", other)):
        write_mesh(tmp_path / f"{name}.ply", each)
    mesh, one = tmp_path / "torn.ply", ("--distance", "biharmonic")
    small = ("--size", "200x200")
    commands = (
        ("figure", mesh, *one, *small, "-o", tmp_path / "f.png"),
        ("movie", mesh, *one, *small, "--frames", "2", "--workers", "1", "-o", tmp_path / "f.gif"),
        ("profile", mesh, *one, "--through", "0,9", "-o", tmp_path / "f.csv"),
        ("profile", mesh, *one, "--through", "0,9", "--chart", tmp_path / "f.png"),
        ("regions", mesh, "--sources", "0,9", "-o", tmp_path / "f.npy"),
    )
    table = tmp_path / "f.ids.csv"
    for words in commands:
        assert run(*words, "--merge", "0", "--json") == 0
        assert str(table) in json.loads(capsys.readouterr().out)["outputs"], words[0]
        np.testing.assert_array_equal(read_table(table), ids)
        table.unlink()
    assert run(*commands[0], "--json") == 0
    assert str(table) not in json.loads(capsys.readouterr().out)["outputs"]
    assert not table.exists()
    # Of two meshes there are two.
    beside = ("figure", mesh, tmp_path / "other.ply", *one, *small, "-o", tmp_path / "g.png")
    mapped = ("correspond", mesh, tmp_path / "other.ply", "--pairs", "0:0,5:5", "-o", tmp_path / "g.npy")
    for words in (beside, mapped):
        assert run(*words, "--merge", "0", "--json") == 0
        assert {str(tmp_path / f"g.{k}.ids.csv") for k in "AB"} <= {*json.loads(capsys.readouterr().out)["outputs"]}
        for letter, expected in (("A", ids), ("B", other_ids)):
            np.testing.assert_array_equal(read_table(tmp_path / f"g.{letter}.ids.csv"), expected)
            (tmp_path / f"g.{letter}.ids.csv").unlink()


def test_what_is_cut_is_cut_by_the_ids_of_the_file(tmp_path):
    surface = torn(bumpy(60))
    keeps = surface.vertices[:, 2] < 0.4
    write_mesh(tmp_path / "torn.ply", surface)
    np.save(tmp_path / "keeps.npy", keeps)
    words = ("--cut", tmp_path / "keeps.npy", "--merge", "0", "--sources", "0,5")
    expected = BiharmonicDistance(surface.without(~keeps).merged()[0])
    assert run("field", tmp_path / "torn.ply", *words, "-o", tmp_path / "f.npy") == 0
    np.testing.assert_allclose(np.load(tmp_path / "f.npy"), expected.from_sources([0, 5]), rtol=1e-9)


def test_the_largest_component_is_that_of_the_merged_surface(tmp_path):
    whole = torn(bumpy(60))  # in pieces, until they are merged
    away = bumpy(20, seed=1)
    both = Surface(
        np.vstack([away.vertices + 9, whole.vertices]), np.vstack([away.faces, whole.faces + away.n_vertices])
    )
    write_mesh(tmp_path / "both.ply", both)
    words = ("field", tmp_path / "both.ply", "--merge", "0", "--largest-component", "-o", tmp_path / "f.npy")
    merged = both.merged()[0]
    first = int(np.flatnonzero(merged.component_of_vertex == 0)[0])
    assert run(*words, "--sources", first) == 0
    found = np.load(tmp_path / "f.npy").ravel()
    np.testing.assert_allclose(found, BiharmonicDistance(merged).from_source(first), rtol=1e-9, atol=1e-12)
    assert np.isnan(found).sum() == away.n_vertices
    with pytest.raises(VertexError):
        BiharmonicDistance(merged.without(merged.component_of_vertex > 0)).from_source(0)
    assert run(*words, "--sources", 0) == 2


def test_the_largest_component_is_drawn_alone(tmp_path, capsys):
    one, away = bumpy(60), bumpy(20, seed=1)
    both = Surface(np.vstack([one.vertices, away.vertices + 9]), np.vstack([one.faces, away.faces + 60]))
    write_mesh(tmp_path / "both.ply", both)
    words = ("figure", tmp_path / "both.ply", "--distance", "biharmonic", "--size", "200x200")
    assert run(*words, "--largest-component", "-o", tmp_path / "x.png") == 0
    recipe = read_recipe(tmp_path / "x.json")
    assert recipe.document.surfaces[0].repairs == Repairs(largest_component=True)
    np.testing.assert_array_equal(open_mesh(recipe.document.surfaces[0]).surface.faces, one.faces)
    assert run("figure", "--recipe", tmp_path / "x.json", "--no-largest-component", "-o", tmp_path / "y.png") == 0
    assert not read_recipe(tmp_path / "y.json").document.surfaces[0].repairs.is_any


@pytest.mark.parametrize("word", ["-1", "inf", "nan", "far"])
def test_a_tolerance_is_a_length(capsys, word):
    with pytest.raises(SystemExit):
        run("field", "hand", f"--merge={word}", "-o", "x.npy")
    assert f"{word!r} is not a length, a number from 0" in capsys.readouterr().err


def test_a_table_has_no_place_beside_standard_output(tmp_path, capsys):
    write_mesh(tmp_path / "torn.ply", torn(bumpy(60)))
    assert run("field", tmp_path / "torn.ply", "--merge", "0", "-o", "-") == 0
    assert "ids" not in capsys.readouterr().err


# ---------------------------------------------------------------------- documents
def test_a_document_opens_its_mesh_cut_and_reopens_it(mesh, tmp_path):
    folder, surface, keeps = mesh
    document = with_repairs(comparison(str(folder / "mesh.ply")), cut=str(folder / "{name}.mask.npy"))
    loaded = open_mesh(document.surfaces[0])
    assert loaded.surface.n_faces == surface.without(~keeps).n_faces
    document = loaded.resolve_points(document)
    assert document.surfaces[0].repairs.cut_sha256
    assert loaded.is_of(document.surfaces[0])
    path = tmp_path / "a" / "recipe.json"
    path.parent.mkdir()
    with recipe_written(Recipe(document), ArrayStore(), path, "1"):
        pass
    assert json.loads(path.read_text())["document"]["surfaces"][0]["repairs"]["cut"] == "../mesh.mask.npy"
    again = read_recipe(path).document.surfaces[0]
    assert again.repairs.cut_sha256 == document.surfaces[0].repairs.cut_sha256
    assert open_mesh(again).surface.n_faces == loaded.surface.n_faces
    np.save(folder / "mesh.mask.npy", np.ones(N))
    with pytest.raises(ParameterError, match=r"has changed since .* Name another\."):
        open_mesh(again, remedy="Name another.")


def test_other_repairs_are_another_surface(mesh):
    folder, *_ = mesh
    plain = comparison(str(folder / "mesh.ply"))
    cut = with_repairs(plain, cut=str(folder / "mask.txt"))
    merged = with_repairs(cut, merge=0.5)
    assert merged.surfaces[0].repairs == Repairs(str(folder / "mask.txt"), merge=0.5)
    loaded = [open_mesh(document.surfaces[0]) for document in (plain, cut, merged)]
    for k, document in enumerate((plain, cut, merged)):
        assert [each.is_of(document.surfaces[0]) for each in loaded] == [j == k for j in range(3)]
    assert with_repairs(cut, cut="") == plain
    with pytest.raises(ParameterError, match="not -1"):
        Repairs(merge=-1.0)


def test_a_document_without_repairs_is_written_as_before(mesh):
    text = recipe_text(Recipe(comparison("mesh.ply")), "1")
    assert "repairs" not in text


def test_each_of_two_meshes_has_a_mask_of_its_own(mesh, capsys):
    folder, surface, keeps = mesh
    write_mesh(folder / "other.ply", surface)
    np.save(folder / "other.mask.npy", ~keeps)
    words = ("figure", folder / "mesh.ply", folder / "other.ply", "--distance", "biharmonic", "--size", "300x150")
    assert run(*words, "--cut", folder / "mask.txt", "-o", folder / "x.png") == 2
    assert "mask.txt would cut two meshes; write {name} in the path" in capsys.readouterr().err
    assert run(*words, "--cut", folder / "{name}.mask.npy", "-o", folder / "x.png") == 0
    first, second = read_recipe(folder / "x.json").document.surfaces
    assert (first.repairs.cut, second.repairs.cut) == tuple(
        str(folder / f"{name}.mask.npy") for name in ("mesh", "other")
    )
    # Again from the recipe, and the same of another mesh.
    assert run("figure", "--recipe", folder / "x.json", "-o", folder / "y.png") == 0
    assert (folder / "y.png").read_bytes() == (folder / "x.png").read_bytes()


def test_farthest_sources_of_a_figure_are_on_what_is_left(mesh):
    folder, surface, keeps = mesh
    words = ("figure", folder / "mesh.ply", "--cut", folder / "mask.txt", "--sources", "farthest:4:0")
    if not keeps[0]:
        pytest.skip("the first vertex is cut out")
    assert run(*words, "--distance", "biharmonic", "--size", "300x300", "-o", folder / "x.png") == 0
    found = list(read_recipe(folder / "x.json").document.sources)
    assert found == farthest_points(BiharmonicDistance(surface.without(~keeps)), 0, 4).tolist()
