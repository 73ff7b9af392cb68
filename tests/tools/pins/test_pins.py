"""Pins on the panels: put and dragged by mouse, seen or hidden, and lit by their rows."""

import pytest

from tests.qt.events import send_mouse
from tests.shapes import bumpy

pytest.importorskip("qtpy")

from app.document.shared_parts.pins import Pins
from app.drawing.glyphs import PIN
from app.scene.style import PAPER
from tests.qt.parts import parts
from tests.tools.pins.pinning import dock_of, ids, seen_vertices, shift_click


@pytest.fixture
def loaded(shared_screen):
    return shared_screen(bumpy(1500))


def colour_at(s, panel, place):
    return s.panels[panel].view.grab().toImage().pixelColor(place).name()


def test_shift_click_pins_a_vertex_on_all_panels_and_leaves_the_source(loaded):
    from qtpy import QtCore

    from app.scene.style import PINS

    s = loaded
    first, second = seen_vertices(s, 2)
    shift_click(s, first)
    shift_click(s, second, panel=2)
    shift_click(s, second, panel=1)  # is there already
    assert ids(s) == [first, second]
    assert s.source == 5
    for panel in range(3):
        for vertex, colour in zip((first, second), PINS, strict=False):
            head = s.point_of(s.panels[panel], vertex) - QtCore.QPoint(6, 17)
            assert colour_at(s, panel, head) == colour.lower()
    s.session.undo()
    assert ids(s) == [first]
    s.session.undo()
    assert ids(s) == []
    s.session.redo()
    assert ids(s) == [first]


def test_a_pin_on_the_far_side_is_hollow(loaded):
    from qtpy import QtCore

    from app.document.shared_parts.pins import add_pins
    from app.scene.style import PINS

    s = loaded
    view = s.panels[0].view
    far = next(v for v in range(1500) if not view.sees(s.session.mesh().surface.vertices[v]))
    s.session.show(add_pins(s.document, [far]))
    head = s.point_of(s.panels[0], far) - QtCore.QPoint(6, 17)
    assert colour_at(s, 0, head) != PINS[0].lower()
    parts(s.window).views.set_view("back")
    s.settle(0.1)
    assert view.sees(s.session.mesh().surface.vertices[far])
    head = s.point_of(s.panels[0], far) - QtCore.QPoint(6, 17)
    assert colour_at(s, 0, head) == PINS[0].lower()


def test_the_walk_through_sources_leaves_pins(loaded):
    from app.document.edits import move_source

    s = loaded
    s.session.show(move_source(s.document, 0, 70))
    shift_click(s, seen_vertices(s, 2)[0])
    pinned = ids(s)
    s.session.walk_sources(-1)
    assert (s.source, ids(s)) == (5, pinned)
    s.session.walk_sources(1)
    assert (s.source, ids(s)) == (70, pinned)


def head_of(s, panel, vertex):
    """The middle of the drop of a pin."""
    from qtpy import QtCore

    return s.point_of(s.panels[panel], vertex) - QtCore.QPoint(0, round(PIN.rise * PIN.pixels))


def test_a_drop_that_is_clicked_selects_its_row(loaded):
    from qtpy import QtCore, QtTest

    s = loaded
    first, second = seen_vertices(s, 2)
    shift_click(s, first)
    shift_click(s, second)
    left, control = QtCore.Qt.MouseButton.LeftButton, QtCore.Qt.KeyboardModifier.ControlModifier
    points = [pin.point for pin in s.document[Pins].pins]

    def click(vertex, panel=0, *modifiers):
        QtTest.QTest.mouseClick(s.panels[panel].view, left, *modifiers, pos=head_of(s, panel, vertex))
        s.settle(0.05)

    # As long as the list is closed, it stands out.
    click(first)
    assert s.window.grid.marks.highlighted("pins") == (points[0],)
    click(first)
    assert s.window.grid.marks.highlighted("pins") == ()
    dock = dock_of(s)
    click(second, 2)
    assert dock.table.points == (points[1],)
    click(first, 0, control)
    assert set(dock.table.points) == set(points)
    click(first)
    assert dock.table.points == (points[0],)
    assert s.window.grid.marks.highlighted("pins") == (points[0],)
    click(first)
    assert dock.table.points == ()
    assert s.source == 5  # which stays where it is
    # With Shift, the place under the drop is pinned.
    hit = s.panels[0].view.pick(head_of(s, 0, first))
    QtTest.QTest.mouseClick(s.panels[0].view, left, QtCore.Qt.KeyboardModifier.ShiftModifier, pos=head_of(s, 0, first))
    assert ids(s) == [first, second, hit.vertex]


def test_a_drop_hangs_down_where_the_view_ends_above_it():

    from app.qt.panels.overlay import RIMS, box_of_glyph

    rise, head = PIN.rise * PIN.pixels, PIN.pixels
    for y in (0.0, rise, rise + head + RIMS - 1):
        box = box_of_glyph(PIN, (50, y), PAPER)
        assert box.top() == y
        assert box.bottom() == pytest.approx(y + rise + head)
    box = box_of_glyph(PIN, (50, 40), PAPER)
    assert (box.top(), box.bottom()) == (pytest.approx(40 - rise - head), 40)


def test_a_drop_is_dragged_in_one_step_and_the_matrix_follows(loaded):
    from qtpy import QtCore, QtTest

    s = loaded
    first, second = seen_vertices(s, 2)
    shift_click(s, first)
    shift_click(s, second)
    dock = dock_of(s)
    s.until(lambda: dock.distances.matrix() is not None)
    view, left = s.panels[0].view, QtCore.Qt.MouseButton.LeftButton
    for _ in range(2):
        head, before = head_of(s, 0, ids(s)[0]), ids(s)
        QtTest.QTest.mousePress(view, left, pos=head)
        for step in range(1, 9):
            _move(view, head + QtCore.QPoint(0, 5 * step))
            s.settle(0.01)
        QtTest.QTest.mouseRelease(view, left, pos=head + QtCore.QPoint(0, 40))
        s.settle(0.05)
        assert ids(s)[0] not in before
        assert ids(s)[1] == second
        tip = s.point_of(s.panels[0], before[0]) + QtCore.QPoint(0, 40)
        assert ids(s)[0] == view.pick(tip).vertex
    s.until(lambda: dock.distances.matrix() is not None)
    spec = dock.distances.spec
    exact = s.session.loaded().distances("voronoi").get(spec).between(*ids(s))
    assert dock.distances.matrix()[0, 1] == pytest.approx(exact, rel=1e-12)  # of a block of columns, and of one
    s.session.undo()
    assert ids(s) == before
    s.session.undo()
    assert ids(s) == [first, second]
    assert s.source == 5


def _move(view, place):
    """The pointer, with the left button down."""
    from qtpy import QtCore

    send_mouse(view, place, buttons=QtCore.Qt.MouseButton.LeftButton)
