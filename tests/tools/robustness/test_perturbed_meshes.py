"""What distances withstand, as documents: a surface made from another, points carried onto it, and the difference."""

import argparse
import shlex
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import app as bihdist
from app.commands.figure import add_figure_options, chosen_recipe
from app.document.derived_surfaces import without_changed
from app.document.document import Document, comparison
from app.document.edits import open_mesh as with_mesh
from app.document.file import checksum, read_recipe, recipe_text
from app.document.form import document_data, document_from
from app.document.page import Page, Recipe
from app.document.quantities import quantity
from app.document.second_mesh_edits import set_view
from app.figures import one_line
from app.figures.export import compute, figure_of, open_document
from app.main import main
from app.session.array_store import ArrayStore
from app.session.surfaces import SPARED_MADE
from app.tools.robustness.perturbed_documents import cut_by, perturb_mesh, split_perturbed, with_perturbed
from app.tools.robustness.quantity import DistanceChange
from app.tools.scatter.part import Scatter
from bihdist_core import BiharmonicDistance, ParameterError, Surface, SurfacePoint, VertexError, write_mesh
from bihdist_core.applications.changes import Perturbation, change_from_words, words_of_change
from bihdist_core.applications.perturbation import image_of, perturbed
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy

BIHARMONIC, EDGES = Spec.of("biharmonic"), Spec.of("geodesic", method="dijkstra")
CHANGES = (
    Perturbation(noise=0.3, along="normals", seed=4),
    Perturbation(holes=2, radius=0.2, seed=1),
    Perturbation(simplify=150, noise=0.1),
    Perturbation(handle=(3, 200)),
    Perturbation(cut=((0, 6), (40, 40)), noise=0.1),
)


@pytest.fixture(scope="module")
def mesh(tmp_path_factory):
    path = tmp_path_factory.mktemp("meshes") / "bumpy.off"
    write_mesh(path, bumpy(300))
    return str(path)


def changed(mesh, change, sources=(5,)):
    return with_perturbed(comparison(mesh, (BIHARMONIC, EDGES), sources), change)


def loaded(document):
    document, surfaces = open_document(Recipe(document, Page()), ArrayStore())
    return document, surfaces, compute(document, surfaces)


@pytest.mark.parametrize("change", CHANGES, ids=words_of_change)
def test_the_three_panels_are_before_after_and_the_difference_in_percentage_points(mesh, change):
    document, surfaces, answers = loaded(changed(mesh, change))
    before = surfaces["A"].surface
    after, ids = perturbed(before, change)
    assert np.array_equal(surfaces["B"].surface.vertices, after.vertices)
    assert np.array_equal(surfaces["B"].surface.faces, after.faces)
    there = image_of(before, ids, 5, after)
    assert document.point("source after").at == there
    old = BiharmonicDistance(before).from_source(5)
    new = BiharmonicDistance(after).from_source(there)
    assert answers[0].field == pytest.approx(old, rel=1e-9)
    assert answers[1].field == pytest.approx(new, rel=1e-9, nan_ok=True)
    seen = BiharmonicDistance(before).from_source(int(ids[there]))
    both = [v for v in range(len(ids)) if ids[v] >= 0 and np.isfinite(new[v])]
    top, was = max(new[v] for v in both), max(seen[ids[v]] for v in both)
    expected = np.full(len(ids), np.nan)
    for v in both:
        expected[v] = 100 * (new[v] / top - seen[ids[v]] / was)
    assert answers[2].is_signed
    assert answers[2].field == pytest.approx(expected, abs=1e-9, nan_ok=True)
    mean, largest = np.nanmean(np.abs(expected)), np.nanmax(np.abs(expected))
    assert f"mean {mean:.3g} %, largest {largest:.3g} %, each" in answers[2].remark
    sign, way = ("+", "farther") if expected[answers[2].largest] > 0 else ("−", "nearer")
    said = f"largest {sign}{largest:.3g} % at vertex {answers[2].largest}: biharmonic is {way} after"
    assert answers[2].largest_words == said


def test_both_sides_are_computed_by_one_method(mesh, monkeypatch):
    """Where one side is exact and the other too large for that, the difference is none of methods."""
    monkeypatch.setattr("bihdist_core.distances.geodesic_solvers.QUICK_WINDOWS", 299**1.5)
    document = with_perturbed(comparison(mesh, (Spec.of("geodesic"),), (5,)), Perturbation(simplify=250))
    _, surfaces, answers = loaded(document)
    before, after, change = answers
    assert before.label.startswith("geodesic, approximate")
    assert after.label == "geodesic, exact"
    same = surfaces["B"].distances("voronoi").get(Spec.of("geodesic", method="virtual-sources"))
    other = same.from_source(after.field.argmin())
    ids = surfaces["B"].ids
    kept = ids >= 0
    old, new = before.field[ids[kept]], other[kept]
    np.testing.assert_allclose(change.field[kept], 100 * (new / new.max() - old / old.max()), atol=1e-10)
    assert np.abs(after.field - other).max() > 1e-4 * other.max()


def test_noise_has_no_isolines(mesh_file):
    path = mesh_file(bumpy(4000))
    for noise, is_rough in ((0.01, True), (0.0, False)):
        change = Perturbation(noise=noise, holes=0 if noise else 2)
        document = with_perturbed(comparison(path, (BIHARMONIC,), (5,)), change)
        document, surfaces, answers = loaded(document)
        figure = figure_of(Recipe(document, Page()), surfaces, answers)
        assert answers[2].is_rough == is_rough
        assert [panel.isolines.count for panel in figure.panels] == [20, 20, 0 if is_rough else 20]


def test_a_source_that_moves_is_followed(mesh):
    document, surfaces, _ = loaded(changed(mesh, Perturbation(simplify=120)))
    first = document.points[0]
    for vertex in (17, 250):
        moved = replace(document, points=(replace(first, at=vertex), *document.points[1:]))
        again = surfaces["B"].resolve_points(surfaces["A"].resolve_points(moved))
        ids = surfaces["B"].ids
        away = np.linalg.norm(bumpy(300).vertices[ids] - bumpy(300).vertices[vertex], axis=1)
        assert again.point("source after").at == int(away.argmin())


def test_a_recipe_of_it_reads_back_and_makes_the_same(mesh, tmp_path):
    picture = bihdist.figure(mesh, ["biharmonic"], 5, perturb="noise=0.3,seed=2", layout={"size": "300x100"})
    picture.save(tmp_path / "changed.png")
    recipe = read_recipe(tmp_path / "changed.json")
    again = bihdist.figure_again(tmp_path / "changed.json")
    assert np.array_equal(again.pixels, picture.pixels)
    assert [str(panel.shows) for panel in recipe.document.panels] == [
        "biharmonic",
        "biharmonic",
        "change of biharmonic",
    ]
    assert recipe.document.surfaces[1].change == Perturbation(noise=0.3, seed=2)
    assert recipe.page.columns == 3
    line = one_line.command_line(recipe, "out.png")
    assert "--perturb noise=0.3,seed=2" in line


def test_arrays_are_changed_as_files_are(mesh, tmp_path):
    surface = bumpy(300)
    words = "holes=2,radius=0.2"
    picture = bihdist.figure(
        (surface.vertices, surface.faces), ["biharmonic"], 5, perturb=words, layout={"size": "300x100"}
    )
    picture.save(tmp_path / "changed.png")
    assert np.array_equal(bihdist.figure_again(tmp_path / "changed.json").pixels, picture.pixels)
    of_file = bihdist.figure(mesh, ["biharmonic"], 5, perturb=words)
    assert picture.answers[2].remark == of_file.answers[2].remark


@pytest.mark.parametrize("change", CHANGES, ids=words_of_change)
def test_documents_and_words_of_changes_are_read_as_they_are_written(mesh, change):
    document = changed(mesh, change, (5, 9))
    assert document_from(document_data(document)) == document
    assert change_from_words(words_of_change(change)) == change
    base, found = split_perturbed(document)
    assert (base, found) == (comparison(mesh, (BIHARMONIC, EDGES), (5, 9)), change)
    assert quantity("change of biharmonic") == DistanceChange(BIHARMONIC)


def test_a_document_without_a_change_says_nothing_of_it(mesh):
    text = recipe_text(Recipe(comparison(mesh)), "1")
    assert "change" not in text
    assert "image_of" not in text


def test_another_mesh_takes_the_place_of_both(mesh):
    from app.document.document import MeshFile

    document = with_mesh(changed(mesh, CHANGES[0]), MeshFile("A", "hand"))
    assert document.surfaces == (MeshFile("A", "hand"),)
    assert len(document.panels) == 2
    assert isinstance(document, Document)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("twist=3", "not a change to a mesh"),
        ("noise=much", "noise is a number of mean edge lengths above 0, not 'much'"),
        ("noise=-1", "above 0"),
        ("holes=0", "a whole number from 1"),
        ("weld=3", "two vertices such as 12:40"),
        ("along=normals,seed=3", "changes nothing"),
        ("noise=1,noise=2", "each once"),
        ("along=z", "one of xyz, normals"),
    ],
)
def test_what_is_no_change_is_refused_in_words(words, said):
    with pytest.raises(ParameterError, match=said):
        change_from_words(words)


def test_places_and_fields_are_refused_where_they_cannot_be_followed(mesh):
    with pytest.raises(ParameterError, match="Only vertices carry over"):
        loaded(changed(mesh, CHANGES[1], (SurfacePoint.of(3, 0.2, 0.2),)))
    with pytest.raises(ParameterError, match="is not a distance"):
        bihdist.figure(mesh, ["biharmonic - geodesic"], 5, perturb="noise=1")
    with pytest.raises(VertexError):
        loaded(changed(mesh, CHANGES[0], (999,)))
    with pytest.raises(ParameterError, match="Only one mesh"):
        with_perturbed(changed(mesh, CHANGES[0]), CHANGES[1])


def test_the_change_of_a_mesh_that_is_made_from_no_other_is_refused(mesh):
    with pytest.raises(Exception, match="not made from another"):
        bihdist.figure(mesh, ["change of biharmonic"], 5)


def from_words(*words):
    parser = argparse.ArgumentParser()
    add_figure_options(parser, "")
    return chosen_recipe(parser.parse_args([*words, "-o", "out.png"]))


def test_a_line_of_it_means_the_same_and_options_change_what_it_is_made_from(mesh, tmp_path):
    words = [mesh, "--distance", "biharmonic,diffusion", "--sources", "5"]
    recipe = from_words(*words, "--perturb", "simplify=150,weld=3:200", "--size", "300x100")
    again = from_words(*shlex.split(one_line.command_line(recipe, "out.png"))[2:-2])
    assert (again.document, again.page) == (recipe.document, recipe.page)
    several = from_words(*words[:-1], "5,9", "--perturb", "noise=1")
    assert len(several.document.panels) == 12
    line = shlex.split(one_line.command_line(several, "out.png"))
    assert from_words(*line[2:-2]).document == several.document
    (tmp_path / "r.json").write_text(recipe_text(recipe, "1"))
    other = from_words("--recipe", str(tmp_path / "r.json"), "--sources", "17", "--perturb", "noise=2")
    assert other.document.surfaces[1].change == Perturbation(noise=2)
    assert (other.document.point("source").at, other.document.point("source after").at) == (17, None)
    plain = from_words("--recipe", str(tmp_path / "r.json"), "--viewup", "z")
    assert plain.document == replace(recipe.document, up="z")


def test_the_session_shows_it_and_a_source_moves_on_both(mesh, desk):
    desk = desk()
    desk.session.show(changed(mesh, CHANGES[2]))
    session = desk.complete()
    assert session.loaded("B").origin is session.loaded("A")
    assert session.loaded("B").up == session.loaded("A").up
    before = session.document
    desk.click(70)
    desk.complete()
    ids = session.loaded("B").ids
    there = session.document.point("source after").at
    assert there == image_of(bumpy(300), ids, 70, session.loaded("B").surface)
    expected = BiharmonicDistance(session.loaded("B").surface).from_source(there)
    assert session.shown[1].answer.field == pytest.approx(expected, rel=1e-9, nan_ok=True)
    assert session.shown[2].answer.field[there] == 0
    session.undo()
    desk.complete()
    assert session.document == before
    desk.click(90, panel=1)  # there, it moves on both as well
    desk.complete()
    assert session.document.point("source").at == ids[90]
    assert session.document.point("source after").at == 90
    assert session.document.point("source after").image_of == "source"


def test_a_source_is_not_moved_onto_what_is_new(mesh, desk):
    desk = desk()
    desk.session.show(changed(mesh, CHANGES[3]))
    session = desk.complete()
    new = int(np.flatnonzero(session.loaded("B").ids < 0)[0])
    before = session.document
    desk.click(new, panel=1)
    desk.complete()
    assert session.document == before


def test_the_command_says_the_numbers(mesh, tmp_path, capsys):
    words = ["figure", mesh, "--distance", "biharmonic", "--sources", "5", "--size", "300x100"]
    assert main([*words, "--perturb", "noise=0.3,seed=2", "-o", str(tmp_path / "f.png")]) == 0
    said = capsys.readouterr().out
    (answer,) = bihdist.figure(mesh, ["biharmonic"], 5, perturb="noise=0.3,seed=2").answers[2:]
    assert f"change of biharmonic, exact: {answer.remark}" in said
    assert "source vertex 5" in said
    noise = ["--noise", "0.3", "--seed", "2", "--distance", "biharmonic", "--sources", "5"]
    main(["perturb", mesh, *noise, "-o", str(tmp_path / "m.off")])
    mean = answer.remark.removeprefix("mean ").split(", largest ")[0]
    assert f"changes by {mean} of its maximum" in capsys.readouterr().out


@pytest.fixture
def pose(tmp_path):
    ball = bumpy(300)
    path = tmp_path / "elsewhere" / "pose.off"
    path.parent.mkdir()
    write_mesh(path, Surface(ball.vertices * (1, 1.5, 0.8), ball.faces))
    return path


def test_a_pose_is_named_from_the_recipe_and_held_to_its_checksum(mesh, pose, tmp_path):
    picture = bihdist.figure(mesh, ["biharmonic"], 5, perturb=f"pose={pose},noise=0.1", layout={"size": "300x100"})
    picture.save(tmp_path / "posed.png")
    written = (tmp_path / "posed.json").read_text()
    assert "pose=elsewhere/pose.off,noise=0.1" in written
    recipe = read_recipe(tmp_path / "posed.json")
    change = recipe.document.surfaces[1].change
    assert Path(change.pose) == pose
    assert change.pose_sha256 == checksum(pose)
    assert document_from(document_data(recipe.document)) == recipe.document
    assert np.array_equal(bihdist.figure_again(tmp_path / "posed.json").pixels, picture.pixels)
    line = shlex.split(one_line.command_line(recipe, "out.png"))
    again = from_words(*line[2:-2])
    assert again.document.surfaces[1].change == replace(change, pose_sha256="")
    write_mesh(pose, bumpy(300))
    with pytest.raises(ParameterError, match="has changed since"):
        bihdist.figure_again(tmp_path / "posed.json")
    pose.unlink()
    with pytest.raises(ParameterError, match="is not there"):
        bihdist.figure_again(tmp_path / "posed.json")


def test_a_place_is_followed_where_the_faces_are_the_same(mesh):
    place = SurfacePoint.of(3, 0.2, 0.3)
    document, surfaces, answers = loaded(changed(mesh, CHANGES[0], (place,)))
    assert document.point("source after").at == place
    after = surfaces["B"].surface
    assert answers[1].field == pytest.approx(BiharmonicDistance(after).from_source(place), rel=1e-9)


def test_a_distance_before_and_after_ends_alike_in_figures_and_elsewhere_a_typed_end_holds(mesh):
    document, surfaces, answers = loaded(changed(mesh, Perturbation(handle=(3, 200))))
    panels = figure_of(Recipe(document, Page()), surfaces, answers).panels
    ids = surfaces["B"].ids
    for row in (0, 3):
        old = max(answers[row].maximum, float(np.nanmax(answers[row + 1].field[ids >= 0])))
        assert panels[row].maximum == panels[row + 1].maximum == pytest.approx(old)
        assert panels[row + 2].maximum is None
    typed = replace(document, panels=(replace(document.panels[0], maximum=9.0), *document.panels[1:]))
    panels = figure_of(Recipe(typed, Page()), surfaces, answers).panels
    assert (panels[0].maximum, panels[1].maximum) == (9.0, None)


def test_without_the_change_nothing_is_left_of_it(mesh):
    base = comparison(mesh, (BIHARMONIC, EDGES), (5,))
    base = base.with_part(Scatter(across=1, up=0))
    document = set_view(with_perturbed(base, CHANGES[0]), "back", "B")
    document = replace(document, isolines=replace(document.isolines, through=("source after",)))
    assert document[Scatter].across == 3
    assert without_changed(document) == replace(base, second_views=())
    first = replace(document, panels=document.panels[2:3])  # the user has removed the others
    assert [str(panel.shows) for panel in without_changed(first).panels] == ["biharmonic"]
    assert without_changed(first).panels[0].surface == "A"


def test_a_mesh_is_changed_again_from_what_it_was(mesh):
    base = comparison(mesh, (BIHARMONIC,), (5,))
    once = perturb_mesh(base, Perturbation(noise=0.2))
    moved = replace(once, panels=once.panels[::-1])
    twice = perturb_mesh(moved, Perturbation(holes=2))
    assert twice.surfaces[1].change == Perturbation(holes=2)
    assert twice.panels == moved.panels
    assert perturb_mesh(once, Perturbation(seed=4)) == base
    assert cut_by(cut_by((), np.array([5, 3, 4])), np.array([4]), is_restored=True) == ((3, 3), (5, 5))


def test_a_session_changes_the_mesh_from_where_it_is_by_then(mesh, desk):
    desk = desk()
    desk.session.show(comparison(mesh, (BIHARMONIC,), (5,)))
    session = desk.complete()
    session.apply(partial(perturb_mesh, change=Perturbation(noise=0.2)), "noise")
    desk.click(70)  # while it is made
    desk.until(lambda: len(session.document.surfaces) == 2)
    desk.complete()
    assert session.document.point("source").at == 70
    assert session.document.point("source after").at == 70
    for amount in (0.3, 0.4):
        session.apply(partial(perturb_mesh, change=Perturbation(noise=amount)), "noise")
        desk.until(lambda: not session.is_opening)
        desk.complete()
    assert session.document.surfaces[1].change == Perturbation(noise=0.4)
    expected = BiharmonicDistance(session.loaded("B").surface).from_source(70)
    assert session.shown[1].answer.field == pytest.approx(expected, rel=1e-9)
    for step in range(5):
        session.apply(partial(perturb_mesh, change=Perturbation(noise=0.5 + step)), "noise")
        desk.until(lambda: not session.is_opening)
    assert len(list(session._surfaces)) <= 2 + SPARED_MADE
    session.undo()
    desk.complete()
    assert len(session.document.surfaces) == 1
