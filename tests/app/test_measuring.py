"""Edits of pins, selections, regions and docks."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.document import DockPlaces, FieldArray, Panel, comparison
from app.document.edits import open_mesh, remove_panel, show_dock
from app.document.quantities import OwnField
from app.document.runs import ids_of, runs_from_words, runs_of
from app.document.shared_parts.pins import MOST_PINS, Pin, Pins, add_pins, change_pin, move_pin, remove_pins
from app.document.shared_parts.selections import Selection, Selections, select, select_instead
from app.tools.interpolation.part import Anchor, Anchors
from app.tools.pins.locations import located_pins
from app.tools.profile.part import Profile
from app.tools.regions.part import DividedPanels, divide, divided_panels, show_regions
from app.tools.scatter.part import Scatter
from bihdist_core import BoundaryLoop, ParameterError, SurfacePoint
from bihdist_core.applications.changes import words_of_runs
from bihdist_core.distances.distance_types import Spec
from tests.shapes import grid

DOCUMENT = comparison("mesh.off", sources=(5,))


def test_pins_are_points_with_a_colour_each_once():
    pinned = add_pins(DOCUMENT, [7, 9, 7, 3])
    assert [pinned.point(pin.point).at for pin in pinned[Pins].pins] == [7, 9, 3]
    assert [pin.colour for pin in pinned[Pins].pins] == [0, 1, 2]
    assert add_pins(pinned, [9]) == pinned
    fewer = remove_pins(pinned, [pinned[Pins].pins[0].point])
    again = add_pins(fewer, [11])
    assert [again.point(pin.point).at for pin in again[Pins].pins] == [9, 3, 11]
    assert again[Pins].pins[-1].colour == 0


def test_a_pin_that_goes_leaves_nothing_behind_but_what_others_need():
    pinned = add_pins(DOCUMENT, [7, 9])
    one, other = (pin.point for pin in pinned[Pins].pins)
    pinned = pinned.with_part(Profile((one, other))).with_part(Anchors(anchors=(Anchor(other),)))
    left = remove_pins(pinned, [one, other])
    assert left[Pins].pins == ()
    assert left[Profile] == Profile()
    assert {point.name for point in left.points} == {"source", other}


def test_names_colours_and_order_of_pins_change():
    pinned = add_pins(DOCUMENT, [7, 9, 3])
    first = pinned[Pins].pins[0].point
    changed = move_pin(change_pin(pinned, Pin(first, "nose", 8)), first, 2)
    assert changed[Pins].pins[2] == Pin(first, "nose", 8)
    assert [changed.point(pin.point).at for pin in changed[Pins].pins] == [9, 3, 7]


def test_pins_are_points():
    with pytest.raises(ParameterError, match="a vertex or a place in a face, not at loop:0"):
        add_pins(DOCUMENT, [BoundaryLoop(0)])


def test_too_many_pins_are_refused():
    with pytest.raises(ParameterError, match=f"at most {MOST_PINS} pins, not {MOST_PINS + 1}"):
        add_pins(DOCUMENT, range(MOST_PINS + 1))


def test_selections_are_runs_of_vertices():
    ids = np.array([9, 3, 4, 5, 9, 20])
    assert runs_of(ids) == ((3, 5), (9, 9), (20, 20))
    assert ids_of(runs_of(ids)).tolist() == [3, 4, 5, 9, 20]
    assert runs_of(np.empty(0, int)) == ()
    assert len(ids_of(())) == 0
    document = select(select(DOCUMENT, "ear", ids), "tail", np.arange(4))
    assert [each.colour for each in document[Selections].selections] == [0, 1]
    again = select(document, "ear", np.array([1]))
    assert next(each for each in again[Selections].selections if each.name == "ear") == Selection("ear", ((1, 1),), 0)
    assert [each.name for each in select(again, "ear", np.empty(0, int))[Selections].selections] == ["tail"]


def test_what_belongs_to_a_panel_goes_with_it():
    document = show_regions(DOCUMENT.with_part(replace(DOCUMENT[Scatter], across=1, up=2)), 1)
    left = remove_panel(document, 1)
    assert left[DividedPanels].regions == ()
    assert (left[Scatter].across, left[Scatter].up) == (None, 2)
    assert show_regions(document, 1, False)[DividedPanels].regions == ()


def test_another_mesh_has_no_pins_of_the_old_one():
    document = show_dock(add_pins(select(DOCUMENT, "ear", np.arange(3)), [7]), "pins")
    other = open_mesh(document, replace(document.surfaces[0], path="other.off"))
    assert other[Pins].pins == ()
    assert other[Selections].selections == ()
    assert other.docks == ("pins",)
    assert [point.name for point in other.points] == ["source"]


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: DOCUMENT.with_part(Pins(pins=(Pin("nowhere"),))), "no point 'nowhere'"),
        (lambda: replace(DOCUMENT, docks=("pins", "kitchen")), "no dock 'kitchen'"),
        (lambda: DOCUMENT.with_part(Profile(("source", "tip"))), "no point 'tip'"),
        (lambda: Pin("a", "x" * 61), "up to 60 printable characters"),
        (lambda: Pin("a", colour=10), "not 10"),
        (lambda: Selection("a", ((3, 5), (6, 7))), "increasing, separate"),
        (lambda: Selection("a", ((3, 2),)), "increasing, separate"),
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
        assert divided[DividedPanels].regions == ids
        assert divided_panels(divided) == said
    for which, words in (
        ((3,), "Panel 3 shows no distance"),
        ((4,), "no panel 4; they are numbered from 1 to 3"),
        ((0,), "no panel 0"),
        ("every", "not on 'every'"),
    ):
        with pytest.raises(ParameterError, match=words):
            divide(document, which)
    with pytest.raises(ParameterError, match="no regions without pins"):
        divide(document.with_part(Pins(pins=())), "all")


def test_selected_vertices_in_words():
    runs = runs_of(np.array([3, 5, 6, 7, 12]))
    assert words_of_runs(runs) == "3+5-7+12"
    assert runs_from_words("3+5-7+12") == runs
    assert runs_from_words(" 12+ 6-7+3 +5-6") == runs
    for words in ("", "ear", "3-", "-3", "1-2-3", "7-5"):
        with pytest.raises(ParameterError):
            runs_from_words(words)
    document = select_instead(comparison("hand"), [runs, ((0, 0),)])
    assert [each.name for each in document[Selections].selections] == ["selection", "selection 2"]
    assert [each.colour for each in document[Selections].selections] == [0, 1]
    assert select_instead(document, [])[Selections].selections == ()


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
