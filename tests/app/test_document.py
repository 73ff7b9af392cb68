"""Documents: parts that fit, edits that change what they say and nothing else, a history that comes back."""

import json
import pickle
from dataclasses import replace

import pytest

from app.document.camera import Camera
from app.document.document import COMPARISON, Document, Inset, MeshFile, Panel, Point, comparison
from app.document.edits import (
    add_another,
    add_panel,
    move_panel,
    move_source,
    open_mesh,
    put_point,
    remove_panel,
    show_in,
)
from app.document.form import document_data, document_from
from app.document.history import LONGEST, History
from app.document.looks import Clip, Colours, Isolines, Shading
from app.document.quantities import DistanceFrom, quantity
from app.tools.interpolation.part import Anchor, Anchors
from bihdist_core import ParameterError, SurfacePoint
from bihdist_core.distances.distance_types import Spec

FRONT = Camera((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.5, 0.5))


@pytest.fixture
def document():
    return comparison("a.off", sources=(5,))


def test_the_usual_document_compares_three_distances_from_one_source(document):
    assert [panel.shows for panel in document.panels] == [DistanceFrom(spec, "source") for spec in COMPARISON]
    assert document.sources == (5,)


def test_documents_hash_pickle_and_compare(document):
    again = pickle.loads(pickle.dumps(document))
    assert again == document
    assert hash(again) == hash(document)
    assert put_point(document, "source", 6) != document


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (lambda d: replace(d, points=(*d.points, *d.points)), "two points 'source'"),
        (lambda d: replace(d, surfaces=(*d.surfaces, *d.surfaces)), "two surfaces 'A'"),
        (lambda d: replace(d, panels=(*d.panels, d.panels[0])), "two panels 0"),
        (lambda d: replace(d, points=()), "no point 'source'"),
        (lambda d: replace(d, surfaces=()), "no surface 'A'"),
        (lambda d: d.with_part(Anchors((Anchor("tip"),))), "no point 'tip'"),
        (lambda d: replace(d, next_id=2), "next_id is 2"),
        (lambda d: replace(d, areas="round"), "no areas 'round'"),
        (lambda d: replace(d, camera="above"), "no view 'above'"),
        (lambda d: replace(d, isolines=-1), "isoline steps is from 0"),
        (lambda d: replace(d, warp_factor=float("nan")), "warp factor of a height field"),
        (lambda d: move_source(d, 9, 3), "no panel 9"),
        (lambda d: d.point("here"), "no point 'here'"),
        (lambda d: d.mesh("B"), "no surface 'B'"),
        (lambda d: Panel(0, d.panels[0].shows, maximum=float("inf")), "colour bar ends"),
        (lambda d: Anchor("source", float("nan")), "value of an anchor"),
        (lambda d: Inset(3, 1.0), "more than 1"),
        (lambda d: Inset(3, 2.0, "middle"), "no corner 'middle'"),
        (lambda d: SurfacePoint(0, (0.5, 0.6, 0.1)), "add up to 1"),
        (lambda d: Point("source", -1), "start at 0"),
    ],
)
def test_parts_that_do_not_fit_are_refused(document, wrong, words):
    with pytest.raises(ParameterError, match=words):
        wrong(document)


def test_a_click_in_a_panel_moves_the_point_that_its_field_starts_from():
    document = comparison("a.off", sources=(5, 7))
    moved = move_source(document, 4, 9)
    assert moved.sources == (5, 9)
    assert replace(moved, points=document.points) == document


def test_panels_are_added_removed_and_moved_and_ids_are_never_given_twice(document):
    more = add_panel(document, DistanceFrom(Spec.of("commute-time")))
    assert [panel.id for panel in more.panels] == [0, 1, 2, 3]
    again = add_panel(remove_panel(more, 3), DistanceFrom(Spec.of("power")))
    assert [panel.id for panel in again.panels] == [0, 1, 2, 4]
    assert [panel.id for panel in move_panel(again, 4, 1).panels] == [0, 4, 1, 2]
    with pytest.raises(ParameterError, match="no panel 3"):
        remove_panel(again, 3)


def test_the_panel_that_is_added_to_the_usual_three_is_the_difference_of_the_first_two(document):
    two = add_another(remove_panel(document, 2))
    assert str(two.panels[-1].shows) == "diffusion"
    four = add_another(two)
    assert [str(panel.shows) for panel in four.panels] == [
        "biharmonic",
        "geodesic",
        "diffusion",
        "biharmonic - geodesic",
    ]
    assert four.panels[-1].shows.points == ("source",)
    # Once: the next is a distance again, as it is where the two do not start from one point.
    assert add_another(four).panels[-1].shows.is_distance
    apart = comparison("a.off", sources=(5, 7))
    apart = replace(apart, panels=(apart.panels[0], apart.panels[4], apart.panels[2]))
    assert add_another(apart).panels[-1].shows.is_distance


def test_another_quantity_has_a_colour_bar_of_its_own(document):
    fixed = replace(document, panels=tuple(replace(panel, maximum=2.0) for panel in document.panels))
    shown = show_in(fixed, 1, DistanceFrom(Spec.of("commute-time")))
    assert [panel.maximum for panel in shown.panels] == [2.0, None, 2.0]
    assert show_in(fixed, 1, fixed.panel(1).shows) == fixed


def test_another_mesh_leaves_behind_what_was_tied_to_the_old_one(document):
    tied = put_point(document, "tip", 8)
    tied = replace(tied, insets=(Inset(3),), warp_factor=0.2, camera=FRONT, isolines=7).with_part(
        Anchors((Anchor("tip", 1.0),))
    )
    other = open_mesh(tied, MeshFile("A", "b.off"), 4)
    expected = replace(document, surfaces=(MeshFile("A", "b.off"),), points=(Point("source", 4),), isolines=7)
    assert other == expected


TASTE = (
    {"colours": Colours("ember", reversed=True, bands=True)},
    {"shading": Shading("flat", show_edges=True)},
    {"clip": Clip((0.0, -1.0, 0.5), 0.25)},
    {"opacity": 0.25},
    {"parallel_projection": True, "axes": True, "extrema": True, "areas": "barycentric", "snap": False},
)


@pytest.mark.parametrize(
    ("changed", "kept"),
    [
        ({"range": "shared"}, {}),
        ({"isolines": Isolines(spacing=0.1)}, {}),
        ({"isolines": Isolines(values=(0.1, 0.2))}, {}),
        ({"isolines": Isolines(7, bold=5, labels=True, through=("source",))}, {"isolines": Isolines(7)}),
        ({"isolines": Isolines(7, round=False)}, {"isolines": Isolines(7, round=False)}),
        *((taste, taste) for taste in TASTE),
    ],
)
def test_another_mesh_begins_with_the_users_taste_and_not_with_values_of_the_old_one(document, changed, kept):
    other = open_mesh(replace(document, **changed), MeshFile("A", "b.off"), 4)
    expected = replace(document, surfaces=(MeshFile("A", "b.off"),), points=(Point("source", 4),))
    assert other == replace(expected, **kept)


# ---------------------------------------------------------------------- the history
def test_undo_and_redo_walk_through_the_steps(document):
    history = History(document)
    others = [put_point(document, "source", vertex) for vertex in (1, 2, 3)]
    for other in others:
        history.change(other)
    assert [history.undo() for _ in range(4)] == [others[1], others[0], document, document]
    assert [history.redo() for _ in range(4)] == [*others, others[2]]


def test_a_new_step_forgets_what_was_undone(document):
    history = History(document)
    history.change(put_point(document, "source", 1))
    history.undo()
    history.change(put_point(document, "source", 2))
    assert not history.can_redo
    assert history.undo() == document


def test_equal_keys_in_a_row_are_one_step(document):
    history = History(document)
    for vertex in (1, 2, 3):
        history.change(put_point(document, "source", vertex), "drag")
    history.change(history.present)  # released
    for vertex in (4, 5):
        history.change(put_point(document, "source", vertex), "drag")
    assert history.undo().sources == (3,)
    assert history.undo() == document


def test_a_drag_that_comes_back_is_no_step(document):
    history = History(document)
    for vertex in (1, 2, 5):
        history.change(put_point(document, "source", vertex), "drag")
    assert not history.can_undo
    history.change(put_point(document, "source", 3), "drag")
    assert history.undo() == document


def test_the_camera_is_no_step_and_undo_leaves_it(document):
    history = History(document)
    history.change(put_point(document, "source", 1))
    history.change(replace(history.present, camera=FRONT))
    assert history.undo() == replace(document, camera=FRONT)
    assert not history.can_undo
    assert history.redo().camera == FRONT


def test_undo_to_another_mesh_sees_it_as_it_was_seen_last(document):
    history = History(replace(document, camera=FRONT))
    history.change(open_mesh(history.present, MeshFile("A", "b.off")))
    assert history.present.camera == "auto"
    assert history.undo().camera == FRONT
    assert history.redo().camera == "auto"


def test_only_so_many_steps_are_kept():
    history = History(Document())
    for count in range(LONGEST + 5):
        history.change(Document(isolines=count % 7, warp_factor=count / 1e5))
    steps = 0
    while history.can_undo:
        history.undo()
        steps += 1
    assert steps == LONGEST


# ---------------------------------------------------------------------- differences
@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("biharmonic - diffusion(t=1/4)", "biharmonic - diffusion(t=1/4)"),
        (" raw biharmonic  -  commute-time ", "raw biharmonic - commute-time"),
        ("truncated(k=50)", "truncated(k=50)"),
    ],
)
def test_quantities_are_read_as_they_are_written(text, written):
    assert str(quantity(text)) == written
    assert quantity(str(quantity(text))) == quantity(text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("biharmonic - geodesic - diffusion", "a difference has two"),
        ("raw biharmonic", "is not a difference"),
        ("biharmonic - euclidean", "no distance 'euclidean'"),
        ("- biharmonic", "no distance"),
    ],
)
def test_what_is_no_quantity_gets_a_sentence(text, words):
    with pytest.raises(ParameterError, match=words):
        quantity(text)


def test_a_difference_is_written_and_read():
    document = comparison("a.off", (quantity("raw biharmonic - diffusion(t=1/15)"),), (5,))
    assert document_from(json.loads(json.dumps(document_data(document)))) == document
    data = document_data(document)
    data["panels"][0]["shows"]["difference"].pop()
    with pytest.raises(ParameterError, match=r"panels\[0\].shows.difference must be two distances, not 1"):
        document_from(data)
