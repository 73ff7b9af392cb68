"""Pairs of corresponding points in documents, and what they predict."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.document import Document, MeshFile, Panel, Point, comparison
from app.document.edits import open_mesh
from app.document.file import read_recipe, recipe_text
from app.document.history import History
from app.document.page import Page, Recipe
from app.document.quantities import quantity
from app.document.second_mesh_edits import close_second_mesh, open_second_mesh
from app.document.shared_parts.pins import Pins, add_pins, remove_pins
from app.figures.export import compute, open_document
from app.session.array_store import ArrayStore
from app.tools.correspondence.answers import MAX_SPARE_COLUMNS, NO_OTHER, KnownColumns, candidate_of
from app.tools.correspondence.pairs import (
    MOST_PAIRS,
    Pair,
    Pairs,
    add_pairs,
    drop_half,
    half_pair,
    move_pair_point,
    number_of,
    pair_instead,
    pair_words,
    place_point,
    remove_pairs,
    waiting_point,
    whole_pairs,
)
from app.tools.correspondence.quantity import Prediction, predict, predicts, show_distances
from bihdist_core import BiharmonicDistance, Correspondence, ParameterError, write_mesh
from bihdist_core.distances.distance_types import Spec
from tests.shapes import bumpy, two_pieces

BIHARMONIC, EDGES = Spec.of("biharmonic"), Spec.of("geodesic", method="dijkstra")
PAIRS = [(3, 7), (20, 25), (60, 61), (130, 140)]


@pytest.fixture(scope="module")
def meshes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("meshes")
    for name, surface in (("one.off", bumpy(200)), ("two.off", bumpy(230, seed=1))):
        write_mesh(folder / name, surface)
    return str(folder / "one.off"), str(folder / "two.off")


def both(first="first.off", second="second.off", specs=(BIHARMONIC, EDGES)):
    return open_second_mesh(comparison(first, specs, (3,)), MeshFile("", second))


def places(document):
    return [tuple(document.point(name).at for name in pair.points) for pair in document[Pairs].pairs]


def test_a_click_on_each_surface_makes_a_pair():
    document = place_point(both(), "A", 5)
    assert half_pair(document) == Pair("pair")
    assert pair_words(document, "A")[0] == "Point 1, vertex 5, waits for its partner on B"
    assert pair_words(document, "B")[0] == "Click where point 1 of A is on B"
    assert pair_words(both(), "B")[0] == "Click a point, then its partner on A"
    assert pair_words(comparison("first.off"), "A")[0] == "Open a second mesh beside this one"
    moved = place_point(document, "A", 6)
    assert (len(moved[Pairs].pairs), waiting_point(moved).at) == (1, 6)
    whole = place_point(moved, "B", 9)
    assert (half_pair(whole), places(whole)) == (None, [(6, 9)])
    other_way = place_point(place_point(whole, "B", 11), "A", 12)
    assert places(other_way) == [(6, 9), (12, 11)]
    assert [pair.colour for pair in other_way[Pairs].pairs] == [0, 1]
    with pytest.raises(ParameterError, match="pair 1 already"):
        place_point(place_point(other_way, "A", 6), "B", 9)
    assert drop_half(document) == both().with_part(Pairs(pairs=()))


def test_pairs_are_moved_and_removed_with_their_points():
    document = add_pairs(both(), PAIRS)
    moved = move_pair_point(document, document[Pairs].pairs[1].second, 99)
    assert places(moved)[1] == (20, 99)
    fewer = remove_pairs(document, [document[Pairs].pairs[0]])
    assert places(fewer) == PAIRS[1:]
    assert len(fewer.points) == len(document.points) - 2
    assert number_of(fewer, document[Pairs].pairs[1]) == 1
    assert remove_pairs(document, document[Pairs].pairs) == both()
    assert places(pair_instead(document, PAIRS[:2])) == PAIRS[:2]


def test_what_is_read_goes_before_the_half_pair_and_none_is_there_twice():
    document = add_pairs(place_point(both(), "B", 8), [*PAIRS, PAIRS[0]])
    assert places(document) == [*PAIRS, (8,)]
    assert pair_words(document, "B")[0] == "Point 5, vertex 8, waits for its partner on A"
    assert add_pairs(document, PAIRS[1:]) == document
    with pytest.raises(ParameterError, match=f"at most {MOST_PAIRS:,} pairs"):
        add_pairs(document, [(k, k) for k in range(MOST_PAIRS)])
    full = add_pairs(both(), [(k, k) for k in range(MOST_PAIRS)])
    with pytest.raises(ParameterError, match=f"at most {MOST_PAIRS:,} pairs"):
        place_point(full, "A", 0)


def test_pairs_need_two_surfaces_and_points_on_them():
    alone = comparison("first.off", (BIHARMONIC,), (3,))
    for edit in (predict, lambda d: place_point(d, "A", 5)):
        with pytest.raises(ParameterError, match="open a second one"):
            edit(alone)
    with pytest.raises(ParameterError, match="not C"):
        place_point(both(), "C", 5)
    points = (Point("a", 1, "A"), Point("b", 2, "B"), Point("c", 3, "B"))
    surfaces = (MeshFile("A", "first.off"), MeshFile("B", "second.off"))
    for pairs, words in (
        ((Pair("a", "x"),), "no point 'x'"),
        ((Pair("a", "b"), Pair("", "b")), "a point in common"),
        ((Pair("b", "c"),), "not on the surface 'A'"),
        ((Pair("", "b"), Pair("a", "c")), "Only the last"),
    ):
        with pytest.raises(ParameterError, match=words):
            Document(surfaces, points, parts=(Pairs(pairs),))
    with pytest.raises(ParameterError, match="two surfaces"):
        Document(surfaces[:1], points[:1], parts=(Pairs((Pair("a"),)),))
    for pair in (("", ""), ("a", "a")):
        with pytest.raises(ParameterError, match="two different points"):
            Pair(*pair)


def test_pairs_and_predictions_are_read_back_and_taken_back(tmp_path):
    before = both()
    document = place_point(add_pairs(predict(before), PAIRS), "A", 44)
    path = tmp_path / "r.json"
    path.write_text(recipe_text(Recipe(document), "1"))
    assert read_recipe(path).document == document
    history = History(before)
    for step in (predict(before), add_pairs(predict(before), PAIRS), document):
        history.change(step)
    assert [len(history.undo()[Pairs].pairs) for _ in range(3)] == [4, 0, 0]
    assert history.present == before


def test_the_first_surface_gets_one_panel_and_the_second_one_for_each_distance():
    document = predict(both())
    shown = [(panel.surface, panel.shows) for panel in document.panels]
    assert shown == [("A", Prediction(BIHARMONIC)), ("B", Prediction(BIHARMONIC)), ("B", Prediction(EDGES))]
    assert predicts(document)
    assert not predicts(both())
    again = show_distances(document)
    assert [(p.surface, p.shows.spec, p.shows.points) for p in again.panels] == [
        ("A", BIHARMONIC, ("source",)),
        ("B", BIHARMONIC, ("source 2",)),
        ("B", EDGES, ("source 2",)),
    ]
    assert quantity("prediction by biharmonic") == Prediction(BIHARMONIC)


def test_pairs_go_with_either_surface():
    document = add_pins(add_pairs(predict(both()), PAIRS), [4])
    closed = close_second_mesh(document)
    assert (closed[Pairs].pairs, [str(panel.shows) for panel in closed.panels]) == ((), ["biharmonic"])
    for name in "AB":
        other = open_mesh(document, MeshFile(name, "third.off"))
        assert other[Pairs].pairs == ()
        assert not any(point.name.startswith("pair") for point in other.points)
    assert remove_pins(document, [pin.point for pin in document[Pins].pins])[Pairs].pairs == document[Pairs].pairs


@pytest.mark.parametrize("surface", "AB")
def test_a_point_that_waits_goes_with_the_surface_of_its_partner(surface):
    waiting = place_point(add_pairs(both(), PAIRS), surface, 44)
    for gone in (close_second_mesh(waiting), *(open_mesh(waiting, MeshFile(name, "third.off")) for name in "AB")):
        assert gone[Pairs].pairs == ()
        assert not any(point.name.startswith("pair") for point in gone.points)


def answered(document):
    return compute(*open_document(Recipe(document, Page()), ArrayStore()))


def test_panels_show_the_misfit_of_the_other_surface_to_the_point_that_waits(meshes):
    document = add_pairs(predict(both(*meshes)), PAIRS)
    one, two = bumpy(200), bumpy(230, seed=1)
    distances = BiharmonicDistance(one), BiharmonicDistance(two)
    plain, *fields = answered(place_point(document, "A", 44))
    assert (plain.field, plain.failure, plain.is_final) == (None, "", True)
    expected = Correspondence(*distances, PAIRS).misfit(44)
    assert fields[0].field == pytest.approx(expected, abs=1e-9)
    assert not np.allclose(fields[0].field, fields[1].field, atol=1e-3)
    best, share = candidate_of(fields[0].field)
    assert best == int(np.argmin(expected))
    assert share == pytest.approx(expected.min() / expected.max())
    assert f"vertex {best}, misfit {expected.min():.4g}, {100 * share:.1f} %" in fields[0].remark
    # The other way round it is the first surface that has a field.
    field, *plain = answered(place_point(document, "B", 50))
    turned = Correspondence(*distances[::-1], [(b, a) for a, b in PAIRS]).misfit(50)
    assert field.field == pytest.approx(turned, abs=1e-9)
    assert [answer.field for answer in plain] == [None, None]


def test_without_pairs_or_another_surface_it_is_said_why_there_is_none(meshes):
    document = predict(both(*meshes))
    answers = answered(place_point(document, "A", 44))
    assert [(answer.field, answer.failure) for answer in answers] == [(None, "")] * 3
    answers = answered(document)
    assert [answer.failure for answer in answers] == ["", "", ""]
    alone = comparison(meshes[0], (Prediction(BIHARMONIC), quantity("biharmonic")), (3,))
    answers = answered(alone)
    assert [answer.failure for answer in answers] == [NO_OTHER, ""]


def test_between_components_nothing_is_predicted(meshes, tmp_path):
    write_mesh(tmp_path / "apart.off", two_pieces())
    document = add_pairs(predict(both(str(tmp_path / "apart.off"), meshes[1], (BIHARMONIC,))), [(0, 3)])
    there = int(np.flatnonzero(two_pieces().component_of_vertex == 1)[0])
    answers = answered(place_point(document, "A", there))
    assert "different components" in answers[1].failure


def test_a_new_pair_costs_a_solve_and_another_point_none(desk, meshes):
    work = desk(specs=())
    session = work.session
    session.show(predict(both(*meshes)))
    work.until(lambda: session.loaded() is not None)

    def solved():
        return tuple(session.loaded(name).memory(KnownColumns).solved for name in "AB")

    session.show(place_point(add_pairs(session.document, PAIRS), "A", 44))
    work.complete()
    assert solved() == (8, 8)  # of two distances
    session.show(place_point(session.document, "A", 45))
    work.complete()
    assert solved() == (8, 8)
    session.show(place_point(place_point(session.document, "B", 50), "B", 70))
    work.complete()
    # The pair is new to both surfaces by the distance that is asked now, and the first surface is predicted by one.
    assert solved() == (9, 9)


def test_what_the_other_surface_alone_is_asked_is_kept(desk, meshes):
    work = desk(specs=(EDGES,))
    session = work.session
    work.loaded(meshes[0])
    session.open_second_mesh(meshes[1])
    work.until(lambda: len(session.document.surfaces) == 2)
    panels = [Panel(0, Prediction(EDGES), "A"), Panel(1, Prediction(BIHARMONIC), "B")]
    session.show(replace(session.document, panels=tuple(panels)))
    session.show(place_point(add_pairs(session.document, PAIRS), "B", 44))
    work.complete()
    before = [session.loaded(name).memory(KnownColumns).solved for name in "AB"]
    session.show(place_point(session.document, "B", 45))
    work.complete()
    assert [session.loaded(name).memory(KnownColumns).solved for name in "AB"] == before == [4, 4]


def test_columns_of_what_is_dragged_are_forgotten():
    known = KnownColumns()
    for k in range(MAX_SPARE_COLUMNS + 40):
        known.put("voronoi", BIHARMONIC, {k: np.zeros(3), 1000: np.zeros(3)}, {1000, k})
    kept = known.of("voronoi", BIHARMONIC)
    assert len(kept) == MAX_SPARE_COLUMNS + 2
    assert {1000, MAX_SPARE_COLUMNS + 39} <= kept.keys()
    assert known.solved == MAX_SPARE_COLUMNS + 41
    known.keep("barycentric", {BIHARMONIC})
    assert known.of("voronoi", BIHARMONIC) == {}


def test_of_a_slider_the_last_distance_is_kept_besides_those_that_are_shown():
    known, steps = KnownColumns(), [Spec.of("diffusion", t=0.1 * k) for k in (1, 2, 3, 4)]
    for spec in steps:
        known.put("voronoi", spec, {1: np.zeros(3)}, {1})
    known.keep("voronoi", {steps[0]})
    assert [len(known.of("voronoi", spec)) for spec in steps] == [1, 0, 0, 1]


def test_half_pairs_have_no_part_in_predictions(meshes):
    document = place_point(add_pairs(predict(both(*meshes)), PAIRS), "A", 44)
    assert len(whole_pairs(document)) == 4
    assert waiting_point(drop_half(document)) is None
