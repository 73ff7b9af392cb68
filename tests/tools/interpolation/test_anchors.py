"""Interpolation in the window: anchors clicked, dragged, valued and left out, by mouse and keyboard."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.edits import show_in
from app.document.quantities import quantity
from app.tools.interpolation.answers import InterpolantMemory
from app.tools.interpolation.part import add_anchor
from app.tools.interpolation.quantity import Interpolant
from bihdist_core import BiharmonicDistance, GeodesicDistance, ShepardInterpolant, farthest_points, other_extrema
from bihdist_core.applications.weights import Weights
from bihdist_core.distances.distance_types import Spec
from bihdist_core.sources.source import SourceSet
from tests.qt.events import send_mouse
from tests.shapes import bumpy

pytest.importorskip("qtpy")
from qtpy import QtCore, QtTest

from app.drawing.glyphs import label_boxes
from app.drawing.shapes import Box
from app.tools.interpolation.part import Anchors
from tests.qt.parts import parts

LEFT = QtCore.Qt.MouseButton.LeftButton
BIHARMONIC, GEODESIC = Spec.of("biharmonic"), Spec.of("geodesic")


@pytest.fixture
def loaded(screen, mesh_file):
    s = screen((BIHARMONIC, GEODESIC))
    s.open(mesh_file(bumpy(700)))
    s.settle()
    s.window.actions_by_word["dock anchors"].trigger()
    s.settle()
    QtTest.QTest.mouseClick(dock_of(s).start, LEFT)
    complete(s)
    return s


def dock_of(s):
    return parts(s.window).docks._instrument("anchors")


def click(s, panel, vertex):
    QtTest.QTest.mouseClick(s.panels[panel].view, LEFT, pos=s.point_of(s.panels[panel], vertex))
    complete(s)


def complete(s):
    s.until(lambda: s.session.is_complete)
    s.settle(0.05)


def expected(s, panel, kind):
    anchors = [a for a in s.document[Anchors].anchors if not a.left_out]
    vertices = [s.document.point(a.point).at for a in anchors]
    weights = s.document[Anchors].weights
    distance = kind(s.session.mesh().surface)
    return ShepardInterpolant(
        distance, vertices, [a.value for a in anchors], weights.exponent, weights.smoothness
    ).evaluate()


def check(s):
    for panel, kind in enumerate((BiharmonicDistance, GeodesicDistance)):
        assert s.answers[panel].field == pytest.approx(expected(s, panel, kind), abs=1e-9)


@pytest.mark.parametrize("way", ["button", "closing"])
def test_the_button_and_closing_the_dock_bring_the_distances_back(loaded, way):
    s = loaded
    click(s, 0, s.seen(1)[0])
    assert s.document.range == "shared"
    if way == "button":
        dock_of(s).back.click()
    else:
        s.window.actions_by_word["dock anchors"].trigger()
    complete(s)
    assert [panel.shows.specs for panel in s.document.panels] == [(BIHARMONIC,), (GEODESIC,)]
    assert all(panel.shows.is_distance for panel in s.document.panels)
    assert s.document.range == "own"
    assert parts(s.window).typed_source.box.isEnabled()
    assert len(s.document[Anchors].anchors) == 1
    s.session.undo()
    assert all(isinstance(panel.shows, Interpolant) for panel in s.document.panels)


def test_closing_the_dock_without_interpolants_changes_nothing(loaded):
    s = loaded
    dock_of(s).back.click()
    s.session.show(replace(s.document, range="shared"))
    complete(s)
    before = replace(s.document, docks=())
    s.window.actions_by_word["dock anchors"].trigger()
    assert s.document == before


def test_clicks_put_anchors_and_every_panel_interpolates_by_its_distance(loaded):
    s = loaded
    assert all(isinstance(panel.shows, Interpolant) for panel in s.document.panels)
    assert "no anchor" in s.answers[0].failure
    vertices = s.seen(3)
    for vertex in vertices:
        click(s, 0, vertex)
    assert [s.document.point(a.point).at for a in s.document[Anchors].anchors] == vertices
    assert [a.value for a in s.document[Anchors].anchors][:2] == [0, 1]
    check(s)
    before = s.answers[0].field
    click(s, 1, s.seen(5)[-1])  # its value is what the panel has there
    assert np.abs(s.answers[1].field - expected(s, 1, GeodesicDistance)).max() < 1e-9
    assert len(s.document[Anchors].anchors) == 4
    s.window.session.undo()
    complete(s)
    assert np.array_equal(s.answers[0].field, before)


def test_values_are_typed_slid_and_left_out_and_undone(loaded):
    s = loaded
    for vertex in s.seen(3):
        click(s, 0, vertex)
    rows = list(dock_of(s).rows.values())
    rows[1].box.setFocus()
    rows[1].box.selectAll()
    QtTest.QTest.keyClicks(rows[1].box, "-2.5")
    QtTest.QTest.keyClick(rows[1].box, QtCore.Qt.Key.Key_Return)
    complete(s)
    assert s.document[Anchors].anchors[1].value == -2.5
    assert s.answers[0].is_signed
    check(s)
    place = QtCore.QPoint(3 * rows[2].slider.width() // 4, rows[2].slider.height() // 2)
    QtTest.QTest.mouseClick(rows[2].slider, LEFT, pos=place)
    complete(s)
    assert s.document[Anchors].anchors[2].value != s.document[Anchors].anchors[1].value
    check(s)
    QtTest.QTest.mouseClick(rows[0].eye, LEFT)
    complete(s)
    assert s.document[Anchors].anchors[0].left_out
    check(s)
    s.window.session.undo()
    complete(s)
    assert not s.document[Anchors].anchors[0].left_out
    rows[0].name.setFocus()
    QtTest.QTest.mouseClick(rows[0].cross, LEFT)
    complete(s)
    assert len(s.document[Anchors].anchors) == 2
    check(s)


def test_letters_for_a_value_are_refused(loaded):
    s = loaded
    click(s, 0, s.seen(1)[0])
    (row,) = dock_of(s).rows.values()
    row.box.setFocus()
    row.box.selectAll()
    QtTest.QTest.keyClicks(row.box, "high")
    QtTest.QTest.keyClick(row.box, QtCore.Qt.Key.Key_Return)
    assert row.box.property("wrong")
    assert s.document[Anchors].anchors[0].value == 0


def test_an_anchor_is_dragged_over_the_surface(loaded):
    s = loaded
    start, stop, other = s.seen(3)
    click(s, 0, start)
    click(s, 0, other)
    view = s.panels[0].view
    QtTest.QTest.mousePress(view, LEFT, pos=s.point_of(s.panels[0], start))
    a, b = s.point_of(s.panels[0], start), s.point_of(s.panels[0], stop)
    for k in range(1, 6):
        move(view, a + (b - a) * k / 5)
    QtTest.QTest.mouseRelease(view, LEFT, pos=b)
    complete(s)
    assert s.document.point(s.document[Anchors].anchors[0].point).at == stop
    check(s)
    s.window.session.undo()  # all the way is one step
    complete(s)
    assert s.document.point(s.document[Anchors].anchors[0].point).at == start


def move(view, place):
    send_mouse(view, place, LEFT, LEFT)


def test_weights_and_extrema_are_those_of_the_library(loaded):
    s = loaded
    for vertex in s.seen(4):
        click(s, 0, vertex)
    dock = dock_of(s)
    for box, text in ((dock.exponent, "2.5"), (dock.smoothness, "0.1")):
        box.setFocus()
        box.selectAll()
        QtTest.QTest.keyClicks(box, text)
        QtTest.QTest.keyClick(box, QtCore.Qt.Key.Key_Return)
    complete(s)
    assert (s.document[Anchors].weights.exponent, s.document[Anchors].weights.smoothness) == (2.5, 0.1)
    check(s)
    s.until(lambda: "…" not in str(dock.extrema.facts) and parts(s.window).quality.is_complete)
    s.settle(0.05)
    vertices = SourceSet(tuple(s.document.point(a.point).at for a in s.document[Anchors].anchors))
    for panel, (_, at_tips, elsewhere) in enumerate(dock.extrema.facts):
        found = other_extrema(s.session.mesh().surface, s.answers[panel].field, vertices).vertices
        assert int(at_tips) + int(elsewhere) == len(found)
        said, noun = s.panels[panel].view.over.notes, "extremum" if len(found) == 1 else "extrema"
        starts = f"{len(found)} {noun} besides the anchors", f"{len(found)} {noun}", f"{len(found)}"
        assert said == tuple(start + (f", {at_tips} at tips" if int(at_tips) else "") for start in starts)


def test_a_single_anchor_has_no_extrema_to_wait_for(loaded):
    s = loaded
    click(s, 0, s.seen(4)[0])
    complete(s)
    assert [row[1:] for row in dock_of(s).extrema.facts] == [("–", "–")] * len(s.panels)


def test_extrema_are_marked_on_interpolants_only(loaded):
    s = loaded
    document = s.document
    for k in range(12):
        document, _ = add_anchor(document, 60 * k, float(k % 3))
    # So steep, the one by the geodesic distance has an extremum elsewhere.
    s.session.show(document.with_part(replace(document[Anchors], weights=Weights(6.0))))
    dock, marks = dock_of(s), [panel.view.over.points for panel in s.panels]

    def rest():
        complete(s)
        s.until(lambda: parts(s.window).quality.is_complete)
        s.settle(0.05)

    def counted():
        return [int(near) + int(elsewhere) for _, near, elsewhere in dock.extrema.facts]

    rest()
    assert [len(each.positions("quality")) for each in marks] == counted()
    assert counted() == [0, 1]
    dock.shows.buttons["total"].click()
    rest()
    assert not any(len(each.positions("quality")) for each in marks), "nobody asks for those of weights"
    assert not dock.extrema.isVisible()
    dock.shows.buttons["interpolant"].click()
    rest()
    assert dock.extrema.isVisible()
    s.session.show(show_in(s.document, s.document.panels[1].id, quantity("geodesic")))
    rest()
    assert [len(each.positions("quality")) for each in marks] == [*counted(), 0]
    dock.end_tool()
    rest()
    assert "anchors" in s.document.docks
    assert not any(len(each.positions("quality")) for each in marks)


def test_anchors_are_saved_and_read_and_kept_in_sessions(loaded, tmp_path):
    s = loaded
    for vertex in s.seen(3):
        click(s, 0, vertex)
    rows = list(dock_of(s).rows.values())
    rows[0].name.setFocus()
    rows[0].name.selectAll()
    QtTest.QTest.keyClicks(rows[0].name, "thumb")
    QtTest.QTest.keyClick(rows[0].name, QtCore.Qt.Key.Key_Return)
    complete(s)
    before, field = s.document, s.answers[0].field
    parts(s.window).session_file.save(str(tmp_path / "session.json"))
    from app.document.file import read_recipe

    kept = read_recipe(str(tmp_path / "session.json")).document
    assert kept[Anchors].anchors == before[Anchors].anchors
    assert kept[Anchors].anchors[0].name == "thumb"
    assert "anchors" in kept.docks
    dock_of(s).remove_all()
    complete(s)
    assert not s.document[Anchors].anchors
    s.window.session.undo()
    complete(s)
    assert np.array_equal(s.answers[0].field, field)


def test_panels_go_back_to_distances(loaded):
    s = loaded
    click(s, 0, s.seen(1)[0])
    dock_of(s).end_tool()
    complete(s)
    assert [panel.shows.spec for panel in s.document.panels] == [BIHARMONIC, GEODESIC]
    assert not s.answers[0].failure
    assert dock_of(s).start.isVisible()


def test_up_and_down_go_through_the_list_and_delete_removes(loaded):
    s = loaded
    for vertex in s.seen(3):
        click(s, 0, vertex)
    rows, keys = list(dock_of(s).rows.values()), QtCore.Qt.Key
    rows[1].slider.setFocus()
    values = [anchor.value for anchor in s.document[Anchors].anchors]
    QtTest.QTest.keyClick(rows[1].slider, keys.Key_Down)
    assert s.window.grid.marks.highlighted("anchors") == (rows[2].point,)
    assert [anchor.value for anchor in s.document[Anchors].anchors] == values
    QtTest.QTest.keyClick(rows[2].slider, keys.Key_Delete)
    complete(s)
    assert [a.point for a in s.document[Anchors].anchors] == [rows[0].point, rows[1].point]
    assert s.window.grid.marks.highlighted("anchors") == (rows[1].point,)
    s.window.actions_by_word["remove anchor"].trigger()
    complete(s)
    assert [a.point for a in s.document[Anchors].anchors] == [rows[0].point]


def test_samples_are_farthest_from_the_anchors_and_change_no_value_there(loaded):
    s = loaded
    first, second = s.seen(2)
    click(s, 0, first)
    click(s, 0, second)
    dock = dock_of(s)
    dock.samples.count.setValue(3)
    field = s.answers[0].field
    QtTest.QTest.mouseClick(dock.samples.add, LEFT)
    s.until(lambda: len(s.document[Anchors].anchors) == 5)
    complete(s)
    expected = farthest_points(BiharmonicDistance(s.session.mesh().surface), [first, second], 5)
    assert [s.document.point(a.point).at for a in s.document[Anchors].anchors] == expected.tolist()
    assert [a.value for a in s.document[Anchors].anchors[2:]] == pytest.approx(field[expected[2:]], abs=5e-4)


def test_a_value_is_followed_without_a_solve_even_while_it_moves(loaded):
    s = loaded
    for vertex in s.seen(3):
        click(s, 0, vertex)
    columns = s.session.loaded().memory(InterpolantMemory).columns
    row = list(dock_of(s).rows.values())[2]
    row.slider.setSliderDown(True)
    for step in (200, 400, 600):
        row.slider.setValue(step)
        s.until(lambda: s.session.is_complete)
        assert "heat" not in s.answers[1].label
    row.slider.setSliderDown(False)
    complete(s)
    assert s.session.loaded().memory(InterpolantMemory).columns == columns
    s.until(lambda: "without solving" in s.window.status.time.text)  # in place of how long the fields took


def test_labels_of_anchors_do_not_cover_each_other():
    view, size = Box(0, 0, 300, 300), (40, 20)
    places = [(150 + 14 * (k % 3), 150 + 14 * (k // 3)) for k in range(9)]
    boxes = label_boxes(places, [size] * 9, [1] * 8 + [0], view)
    there = [box for box in boxes if box is not None]
    assert boxes[8] is not None
    assert len(there) > 3
    assert not any(a.meets(b) for k, a in enumerate(there) for b in there[:k])
    (beside,) = label_boxes([(295, 150)], [size], [0], view)
    assert beside.right < 295
