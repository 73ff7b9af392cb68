"""Edits of pins, selections, regions and docks."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.document import Anchor, FieldArray, Panel, comparison
from app.document.edits import divide, divided_panels, open_mesh, remove_panel
from app.document.instruments import DockPlaces, Pin, Profile, Selection
from app.document.measuring import (
    MOST_PINS,
    add_pins,
    change_pin,
    move_pin,
    remove_pins,
    runs_from_words,
    runs_in_words,
    runs_of,
    select,
    select_instead,
    show_dock,
    show_regions,
    vertices_of,
)
from app.document.quantities import OwnField
from app.session.pin_locations import located_pins
from bihdist_core import BoundaryLoop, ParameterError, SurfacePoint
from bihdist_core.distances.kinds import Spec
from tests.shapes import grid

DOCUMENT = comparison("mesh.off", sources=(5,))


def test_pins_are_points_with_a_colour_each_once():
    pinned = add_pins(DOCUMENT, [7, 9, 7, 3])
    assert [pinned.point(pin.point).at for pin in pinned.pins] == [7, 9, 3]
    assert [pin.colour for pin in pinned.pins] == [0, 1, 2]
    assert add_pins(pinned, [9]) == pinned
    fewer = remove_pins(pinned, [pinned.pins[0].point])
    again = add_pins(fewer, [11])
    assert [again.point(pin.point).at for pin in again.pins] == [9, 3, 11]
    assert again.pins[-1].colour == 0


def test_a_pin_that_goes_leaves_nothing_behind_but_what_others_need():
    pinned = add_pins(DOCUMENT, [7, 9])
    one, other = (pin.point for pin in pinned.pins)
    pinned = replace(pinned, profile=Profile((one, other)), anchors=(Anchor(other),))
    left = remove_pins(pinned, [one, other])
    assert left.pins == ()
    assert left.profile == Profile()
    assert {point.name for point in left.points} == {"source", other}


def test_names_colours_and_order_of_pins_change():
    pinned = add_pins(DOCUMENT, [7, 9, 3])
    first = pinned.pins[0].point
    changed = move_pin(change_pin(pinned, Pin(first, "nose", 8)), first, 2)
    assert changed.pins[2] == Pin(first, "nose", 8)
    assert [changed.point(pin.point).at for pin in changed.pins] == [9, 3, 7]


def test_pins_are_points():
    with pytest.raises(ParameterError, match="a vertex or a place in a face, not at loop:0"):
        add_pins(DOCUMENT, [BoundaryLoop(0)])


def test_too_many_pins_are_refused():
    with pytest.raises(ParameterError, match=f"at most {MOST_PINS} pins, not {MOST_PINS + 1}"):
        add_pins(DOCUMENT, range(MOST_PINS + 1))


def test_selections_are_runs_of_vertices():
    ids = np.array([9, 3, 4, 5, 9, 20])
    assert runs_of(ids) == ((3, 5), (9, 9), (20, 20))
    assert vertices_of(runs_of(ids)).tolist() == [3, 4, 5, 9, 20]
    assert runs_of(np.empty(0, int)) == ()
    assert len(vertices_of(())) == 0
    document = select(select(DOCUMENT, "ear", ids), "tail", np.arange(4))
    assert [each.colour for each in document.selections] == [0, 1]
    again = select(document, "ear", np.array([1]))
    assert next(each for each in again.selections if each.name == "ear") == Selection("ear", ((1, 1),), 0)
    assert [each.name for each in select(again, "ear", np.empty(0, int)).selections] == ["tail"]


def test_what_belongs_to_a_panel_goes_with_it():
    document = show_regions(replace(DOCUMENT, scatter=replace(DOCUMENT.scatter, across=1, up=2)), 1)
    left = remove_panel(document, 1)
    assert left.regions == ()
    assert (left.scatter.across, left.scatter.up) == (None, 2)
    assert show_regions(document, 1, False).regions == ()


def test_another_mesh_has_no_pins_of_the_old_one():
    document = show_dock(add_pins(select(DOCUMENT, "ear", np.arange(3)), [7]), "pins")
    other = open_mesh(document, replace(document.surfaces[0], path="other.off"))
    assert other.pins == ()
    assert other.selections == ()
    assert other.docks == ("pins",)
    assert [point.name for point in other.points] == ["source"]


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: replace(DOCUMENT, pins=(Pin("nowhere"),)), "no point 'nowhere'"),
        (lambda: replace(DOCUMENT, docks=("pins", "kitchen")), "no dock 'kitchen'"),
        (lambda: replace(DOCUMENT, profile=Profile(("source", "tip"))), "no point 'tip'"),
        (lambda: Pin("a", "x" * 61), "up to 60 printable characters"),
        (lambda: Pin("a", colour=10), "none is 10"),
        (lambda: Selection("a", ((3, 5), (6, 7))), "do not touch"),
        (lambda: Selection("a", ((3, 2),)), "go up"),
        (lambda: Profile(("a",)), "two points or more"),
        (lambda: Profile(way="guess"), "no way 'guess'"),
        (lambda: DockPlaces(0, 600, ""), "not 0 x 600"),
        (lambda: DockPlaces(900, 600, "no/base*64"), "base64, not 'no/base"),
    ],
)
def test_what_makes_no_sense_is_refused(make, said):
    with pytest.raises(ParameterError, match=said):
        make()


def test_panels_show_regions_by_their_numbers():
    document = comparison("hand", (Spec.of("biharmonic"), Spec.of("geodesic")))
    panels = (*document.panels, Panel(7, OwnField("own")))
    document = add_pins(replace(document, panels=panels, next_id=8, fields=(FieldArray("own", ""),)), [3, 9])
    for which, ids, said in (("all", (0, 1), "all"), ((2,), (1,), (2,)), ((), (), ()), ((2, 1, 2), (1, 0), "all")):
        divided = divide(document, which)
        assert divided.regions == ids
        assert divided_panels(divided) == said
    for which, words in (
        ((3,), "Panel 3 shows no distance"),
        ((4,), "no panel 4; they are numbered from 1 to 3"),
        ((0,), "no panel 0"),
        ("every", "not by 'every'"),
    ):
        with pytest.raises(ParameterError, match=words):
            divide(document, which)
    with pytest.raises(ParameterError, match="no regions without pins"):
        divide(replace(document, pins=()), "all")


def test_selected_vertices_in_words():
    runs = runs_of(np.array([3, 5, 6, 7, 12]))
    assert runs_in_words(runs) == "3,5-7,12"
    assert runs_from_words("3,5-7,12") == runs
    assert runs_from_words(" 12, 6-7,3 ,5-6") == runs
    for words in ("", "ear", "3-", "-3", "1-2-3", "7-5"):
        with pytest.raises(ParameterError):
            runs_from_words(words)
    document = select_instead(comparison("hand"), [runs, ((0, 0),)])
    assert [each.name for each in document.selections] == ["selection", "selection 2"]
    assert [each.colour for each in document.selections] == [0, 1]
    assert select_instead(document, []).selections == ()


def test_a_pin_on_a_side_has_its_value_whatever_the_third_corner_has():
    surface = grid(3, 3)
    document = add_pins(comparison("mesh.off", ()), [4, SurfacePoint.of(2, 0.25, 0.75)])
    vertex, place = located_pins(document, "A", surface)
    i, j, k = surface.faces[2]
    field = np.arange(16.0)
    field[k] = np.nan
    assert vertex.value(field) == 4
    assert place.value(field) == 0.25 * field[i] + 0.75 * field[j]
    field[i] = np.nan
    assert np.isnan(place.value(field))
