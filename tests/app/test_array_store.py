"""Surfaces and fields from Python: what is taken, how they are saved, and what is said where that fails."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.document.document import Document, FieldArray, Panel, comparison
from app.document.edits import move_source, open_mesh, show_in
from app.document.file import read_recipe, recipe_text
from app.document.page import Recipe
from app.document.quantities import Difference, OwnField, quantity
from app.session.array_store import ArrayStore, comparison_of_arrays, is_archive
from app.session.recipe_file import recipe_written
from bihdist_core import BiharmonicDistance, MeshError, OutputError, ParameterError, Surface
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, grid

SURFACE = bumpy(60)
N = len(SURFACE.vertices)
HEIGHT = SURFACE.vertices[:, 1] - SURFACE.vertices[:, 1].min()


def written(path, document, given):
    with recipe_written(Recipe(document), given, path, "9"):
        pass
    return read_recipe(path)


def archive_of(path):
    return Path(read_recipe(path).arrays)


# ---------------------------------------------------------------------- what is taken
def test_a_mesh_in_memory_and_fields_become_a_document():
    document, given = comparison_of_arrays(
        (SURFACE.vertices, SURFACE.faces), ["biharmonic", "biharmonic - mine"], {"mine": HEIGHT, "more": -HEIGHT}, (3,)
    )
    assert [str(panel.shows) for panel in document.panels] == ["biharmonic", "biharmonic - mine", "more"]
    (mesh,) = document.surfaces
    assert mesh.path == ""
    assert np.array_equal(given.surface(mesh).vertices, SURFACE.vertices)
    assert np.array_equal(given.field(document.field("more").sha256, "more"), -HEIGHT)


def test_fields_are_copies_that_nobody_changes():
    values, given = HEIGHT.copy(), ArrayStore()
    field = given.add_field("mine", values)
    values[:] = 7
    kept = given.field(field.sha256, "mine")
    assert np.array_equal(kept, HEIGHT)
    assert not kept.flags.writeable


def test_masked_values_are_undefined():
    given = ArrayStore()
    field = given.add_field("mine", np.ma.masked_greater([1.0, 2, 3], 2))
    assert np.array_equal(given.field(field.sha256, "mine"), [1, 2, np.nan], equal_nan=True)


def test_a_field_is_shown_once_whatever_the_number_of_sources():
    document, _ = comparison_of_arrays(SURFACE, ["biharmonic", "mine"], {"mine": HEIGHT}, (3, 5))
    assert [str(panel.shows) for panel in document.panels] == ["biharmonic", "mine", "biharmonic"]


@pytest.mark.parametrize(
    ("name", "values", "words"),
    [
        ("mine", np.ones((3, 2)), r"shape \(3, 2\)"),
        ("mine", ["a", "b"], "not an array of real numbers"),
        ("mine", ["1", "2"], "not an array of real numbers"),
        (1, [1.0], "is a string"),
        ("mine", np.ones(3) * 1j, "not an array of real numbers"),
        ("mine", [0, 1, np.inf], "is inf at vertex 2"),
        ("", [1.0], "not a name"),
        (" mine", [1.0], "not a name"),
        ("a - b", [1.0], "not a name"),
        ("raw mine", [1.0], "not a name"),
        ("mi\nne", [1.0], "printable"),
        ("m" * 61, [1.0], "up to 60 characters"),
        ("biharmonic", [1.0], "is a distance"),
        ("diffusion(t=1)", [1.0], "is a distance"),
    ],
)
def test_what_is_no_field_gets_a_sentence(name, values, words):
    with pytest.raises(ParameterError, match=words):
        ArrayStore().add_field(name, values)


@pytest.mark.parametrize(
    ("mesh", "error", "words"),
    [
        (7, ParameterError, "not int"),
        ((1, 2, 3), ParameterError, "not a tuple of 3"),
        (([], []), MeshError, "vertices"),
    ],
)
def test_what_is_no_mesh_gets_a_sentence(mesh, error, words):
    with pytest.raises(error, match=words):
        comparison_of_arrays(mesh, ["biharmonic"], {}, (None,))


# ---------------------------------------------------------------------- in a document
def test_a_document_knows_its_fields():
    field = FieldArray("mine", "0" * 64)
    document = replace(comparison("hand", (OwnField("mine"),), fields=(field,)), points=())
    assert document.field("mine") is field
    assert document.sources == ()
    with pytest.raises(ParameterError, match="no field 'mine'"):
        replace(document, fields=())
    with pytest.raises(ParameterError, match="two fields 'mine'"):
        replace(document, fields=(field, field))
    with pytest.raises(ParameterError, match="no surface 'B'"):
        replace(document, fields=(replace(field, surface="B"),))


def test_words_name_fields_where_there_are_any():
    assert quantity("mine", fields=["mine"]) == OwnField("mine")
    assert quantity("raw mine - biharmonic", fields=["mine"]).parts[0] == OwnField("mine")
    with pytest.raises(ParameterError, match="mine"):
        quantity("mine")


def test_another_mesh_leaves_the_fields_behind():
    document, _ = comparison_of_arrays(SURFACE, ["mine", "geodesic", "geodesic - mine"], {"mine": HEIGHT}, (3,))
    other = open_mesh(document, replace(document.surfaces[0], path="b.off", sha256=""))
    assert ([str(panel.shows) for panel in other.panels], other.fields) == (["geodesic"], ())
    only, _ = comparison_of_arrays(SURFACE, [], {"mine": HEIGHT}, (3,))
    other = open_mesh(only, replace(only.surfaces[0], path="b.off", sha256=""))
    assert ([str(panel.shows) for panel in other.panels], other.fields) == (["biharmonic"], ())


def test_a_click_on_a_field_moves_the_source_of_the_others():
    document, _ = comparison_of_arrays(SURFACE, ["mine", "geodesic"], {"mine": HEIGHT}, (3,))
    assert move_source(document, 0, 9).sources == (9,)
    only, _ = comparison_of_arrays(SURFACE, [], {"mine": HEIGHT}, (3,))
    assert move_source(only, 0, 9) == only


def test_a_distance_in_the_place_of_a_field_gets_a_point_to_start_from():
    only = Document(fields=(FieldArray("mine", ""),), surfaces=comparison("hand").surfaces)
    only = replace(only, panels=(Panel(0, OwnField("mine")),), next_id=1)
    assert show_in(only, 0, quantity("biharmonic")).sources == (None,)


# ---------------------------------------------------------------------- answers
def test_a_difference_is_taken_of_a_distance_and_a_field(desk):
    d = desk([])
    exact = BiharmonicDistance(SURFACE).from_source(4)
    fields = {"mine": 2 * exact, "signed": HEIGHT - 1}
    words = ["biharmonic - mine", "raw mine - biharmonic", "mine", "signed", "signed - mine"]
    document, given = comparison_of_arrays(SURFACE, words, fields, (4,))
    d.session.given.update(given)
    d.session.show(document)
    d.complete()
    shares, raw, mine, signed, other = d.answers
    assert np.abs(shares.field).max() < 1e-12
    assert np.allclose(raw.field, exact)
    assert (raw.unit, mine.unit, mine.label) == ("mesh units", "", "mine")
    assert [answer.is_signed for answer in d.answers] == [True, True, False, True, True]
    assert signed.maximum == np.abs(HEIGHT - 1).max()
    assert all(answer.is_final for answer in (mine, signed, other))


def test_a_field_of_another_length_is_refused_and_what_is_shown_stays(desk, mesh_file):
    d = desk([Spec.of("biharmonic")])
    d.loaded(mesh_file(SURFACE))
    before = d.session.document
    document, given = comparison_of_arrays(SURFACE, ["mine"], {"mine": np.ones(5)}, (4,))
    d.session.given.update(given)
    d.view.failures_are_expected = True
    d.session.show(document)
    d.until_told("has 5 values, and bumpy has 60 vertices")
    assert d.session.document == before


# ---------------------------------------------------------------------- files
def test_arrays_are_saved_beside_and_read_again(tmp_path):
    document, given = comparison_of_arrays(SURFACE, ["biharmonic - mine"], {"mine": HEIGHT, "b/c.npy": HEIGHT**2}, (3,))
    recipe = written(tmp_path / "s.json", document, given)
    assert recipe.document == document
    archive = archive_of(tmp_path / "s.json")
    assert sorted(tmp_path.iterdir()) == [archive, tmp_path / "s.json"]
    read = ArrayStore.read(recipe)
    assert np.array_equal(read.surface(document.surfaces[0]).faces, SURFACE.faces)
    for field in document.fields:
        assert np.array_equal(read.field(field.sha256, field.name), given.field(field.sha256, field.name))
    with np.load(archive) as arrays:
        assert np.array_equal(arrays["field/mine"], HEIGHT)
    # Moved together they stay together; and the same again is the same bytes.
    (tmp_path / "t").mkdir()
    again = written(tmp_path / "t" / "s.json", document, given)
    assert ArrayStore.read(again)
    for name in ("s.json", archive.name):
        assert (tmp_path / name).read_bytes() == (tmp_path / "t" / name).read_bytes()


def test_a_recipe_of_files_alone_has_no_archive_and_says_nothing_of_fields(tmp_path):
    recipe = written(tmp_path / "s.json", comparison("hand"), ArrayStore())
    assert [path.name for path in tmp_path.iterdir()] == ["s.json"]
    text = recipe_text(recipe, "9")
    assert "fields" not in text
    assert "arrays" not in text


def test_somebody_elses_archive_is_not_replaced(tmp_path):
    document, given = comparison_of_arrays(SURFACE, [], {"mine": HEIGHT}, (3,))
    written(tmp_path / "s.json", document, given)
    archive = archive_of(tmp_path / "s.json")
    (tmp_path / "s.json").unlink()
    np.savez(archive, results=np.ones(3))
    with pytest.raises(OutputError, match="is another file"):
        written(tmp_path / "s.json", document, given)
    assert list(tmp_path.iterdir()) == [archive]
    assert not is_archive(archive)
    written(tmp_path / "t.json", document, given)
    written(tmp_path / "t.json", document, given)  # our own is


def test_a_failure_after_the_recipe_leaves_neither(tmp_path):
    document, given = comparison_of_arrays(SURFACE, [], {"mine": HEIGHT}, (3,))
    with pytest.raises(ZeroDivisionError), recipe_written(Recipe(document), given, tmp_path / "s.json", "9"):
        raise ZeroDivisionError
    assert list(tmp_path.iterdir()) == []


def test_archives_go_once_no_recipe_names_them(tmp_path):
    documents = [comparison_of_arrays(SURFACE, [], {"mine": HEIGHT * k}, (3,)) for k in (1, 2)]
    written(tmp_path / "s.json", *documents[0])
    first = archive_of(tmp_path / "s.json")
    (tmp_path / "s.json").rename(tmp_path / "renamed.json")
    others = [
        tmp_path / "s.npz",
        tmp_path / "s.more.npz",
        tmp_path / f"t.{'0' * 16}.npz",
        tmp_path / f"s.{'0' * 16}.npz",
    ]
    for path in others[:3]:
        path.write_bytes(first.read_bytes())
    np.savez(others[3], results=np.ones(3))
    written(tmp_path / "s.json", *documents[1])
    second = archive_of(tmp_path / "s.json")
    assert {first, second, *others} < {*tmp_path.iterdir()}
    (tmp_path / "renamed.json").unlink()
    (tmp_path / "pipe.json").mkdir()
    written(tmp_path / "s.json", comparison("hand"), ArrayStore())
    assert {*tmp_path.iterdir()} == {tmp_path / "s.json", tmp_path / "pipe.json", *others}


def test_a_recipe_of_a_long_name_has_an_archive(tmp_path):
    document, given = comparison_of_arrays(SURFACE, [], {"mine": HEIGHT}, (3,))
    assert ArrayStore.read(written(tmp_path / f"{'é' * 100}.json", document, given))


def test_an_archive_beside_that_an_older_program_wrote_is_read(tmp_path):
    document, given = comparison_of_arrays(SURFACE, [], {"mine": HEIGHT}, (3,))
    written(tmp_path / "s.json", document, given)
    archive = archive_of(tmp_path / "s.json")
    text = (tmp_path / "s.json").read_text()
    (tmp_path / "s.json").write_text(text.replace(archive.name, "s.npz"))
    archive.rename(tmp_path / "s.npz")
    assert np.array_equal(
        ArrayStore.read(read_recipe(tmp_path / "s.json")).surface(document.surfaces[0]).faces, SURFACE.faces
    )


def _without(name):
    def damage(path: Path):
        with np.load(path) as archive:
            left = {key: archive[key] for key in archive.files if key != name}
        np.savez(path, **left)

    return damage


def _with_other_values(path: Path):
    with np.load(path) as archive:
        arrays = {**{key: archive[key] for key in archive.files}, "field/mine": np.ones(N)}
    np.savez(path, **arrays)


def _of_objects(path: Path):
    np.savez(path, **{"field/mine": np.array([{}, {}], dtype=object)}, allow_pickle=True)


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda path: path.unlink(), "are missing"),
        (lambda path: path.write_bytes(b"not an archive"), "not an archive"),
        (lambda path: path.write_bytes(path.read_bytes()[:500]), "not an archive"),
        (lambda path: path.write_bytes(path.read_bytes().replace(b"\x00\x00\xf0\x3f", b"\x01\x00\xf0\x3f")), "damaged"),
        (_without("field/mine"), "has no 'field/mine'"),
        (_without("surface/A/faces"), "has no 'surface/A/faces'"),
        (_with_other_values, "has changed since"),
        (_of_objects, "has no 'surface"),
    ],
)
def test_a_damaged_archive_gets_a_sentence(tmp_path, damage, words):
    surface = Surface(grid(4, 4).vertices, grid(4, 4).faces)
    document, given = comparison_of_arrays(surface, [], {"mine": np.ones(25)}, (3,))
    recipe = written(tmp_path / "s.json", document, given)
    damage(archive_of(tmp_path / "s.json"))
    with pytest.raises(ParameterError, match=words):
        ArrayStore.read(recipe)


def test_nothing_is_unpickled(tmp_path):
    document, given = comparison_of_arrays("hand", [], {"mine": HEIGHT}, (3,))
    recipe = written(tmp_path / "s.json", document, given)
    _of_objects(archive_of(tmp_path / "s.json"))
    with pytest.raises(ParameterError, match="does not hold plain numbers"):
        ArrayStore.read(recipe)


def test_what_was_never_given_is_missed():
    with pytest.raises(ParameterError, match="is no longer available"):
        ArrayStore().field("0" * 64, "mine")
    with pytest.raises(ParameterError, match="is no longer available"):
        ArrayStore().surface(replace(comparison("hand").surfaces[0], path=""))


def test_a_difference_of_fields_is_written_and_read():
    document, _ = comparison_of_arrays("hand", ["raw a - b"], {"a": HEIGHT, "b": HEIGHT}, (3,))
    assert document.panels[0].shows == Difference(OwnField("a"), OwnField("b"), raw=True)
