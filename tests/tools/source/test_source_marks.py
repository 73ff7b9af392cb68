"""The mark of a source in the window: a flat disc with a rim that nothing clips; a dashed ring where it is hidden."""

import threading
from dataclasses import replace

import numpy as np
import pytest

from app.document.document import Inset
from app.document.edits import move_source
from app.session.questions import DistanceQuestion
from tests.qt.parts import parts
from tests.shapes import bumpy
from tests.tools.source.sourcing import drag

pytest.importorskip("qtpy")
from qtpy import QtCore


@pytest.fixture
def shown(screen, mesh_file):
    """A window with a ball that is seen from its front, and its vertices from the back to the front."""
    s = screen()
    surface = bumpy(2000)
    s.open(mesh_file(surface), 5)
    parts(s.window).views.reset("front")
    return s, surface.vertices[:, 2].argsort()


def show_at(s, vertex):
    s.session.show(move_source(s.document, 0, int(vertex)))
    s.until(lambda: s.session.is_complete)
    s.settle(0.3)


def ring_of(panel, radius, place=None):
    """(k, 3) the colours, 0 to 1, about where the source is, this far away."""
    from qtpy import QtGui

    view = panel.view
    image = view.grab().toImage().convertToFormat(QtGui.QImage.Format.Format_RGB888)
    ratio = view.devicePixelRatioF()
    place = place or view.place_of(view.handles[0])
    angles = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    points = np.stack([place.x() + radius * np.cos(angles), place.y() + radius * np.sin(angles)], 1) * ratio
    return np.array([image.pixelColor(int(x), int(y)).getRgbF()[:3] for x, y in np.floor(points)])


def is_disc(panel, place=None):
    style = panel.view.scene.style
    across = panel.view.scene.style.marker_size * panel.view.proportion
    inner = np.concatenate([ring_of(panel, share * across, place) for share in (0, 0.15, 0.3)])
    rim = ring_of(panel, 0.45 * across, place)
    return np.allclose(inner, style.source, atol=0.02) and np.median(np.abs(rim - style.mark_edge)) < 0.15


def test_a_source_is_a_flat_disc_with_a_rim_that_the_surface_does_not_clip(shown):
    s, ids = shown
    # In the middle, and at the outline, where a half of a ball would be in the surface.
    view, positions = s.panels[0].view, s.panels[0].positions
    outermost = next(id for id in np.abs(positions[:, 0]).argsort()[::-1] if view.sees(positions[id]))
    for vertex in (ids[-1], outermost):
        show_at(s, vertex)
        assert all(is_disc(panel) for panel in s.panels)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_source_that_is_hidden_is_a_dashed_ring(shown, theme):
    from app.qt.look.look import LOOK

    before = LOOK.choice
    LOOK.choose(theme)
    try:
        s, ids = shown
        show_at(s, ids[0])
        for panel in s.panels:
            style = panel.view.scene.style
            across, source = style.marker_size * panel.view.proportion, np.array(style.source)
            found = np.concatenate([ring_of(panel, share * across) for share in (0, 0.2, 0.3, 0.44)])
            assert np.abs(found - source).max(axis=1).min() > 0.2
            light = ring_of(panel, 0.44 * across).mean(axis=1)
            ups = np.diff((light > (light.min() + light.max()) / 2).astype(int), append=0) == 1
            assert np.ptp(light) > 0.4
            assert 4 <= ups.sum() <= 14
        # Turned to the front it is a disc at once.
        parts(s.window).views.reset("back")
        s.settle(0.1)
        assert all(is_disc(panel) for panel in s.panels)
    finally:
        LOOK.choose(before)


def test_insets_have_the_disc_too_and_what_they_cover_has_none(shown):
    s, ids = shown
    show_at(s, ids[-1])
    s.session.show(replace(s.document, insets=(Inset(int(ids[-1])),)))
    s.until(lambda: s.session.is_complete)
    s.settle(0.3)
    view = s.panels[0].view
    (renderer,) = view.scene.insets.placed
    assert is_disc(s.panels[0], view.place_of(view.handles[0], renderer))
    assert is_disc(s.panels[0])


class Gate:
    """Answers to questions about distances wait here until they are let through."""

    def __init__(self, monkeypatch):
        self._permits, answer = threading.Semaphore(0), DistanceQuestion.answer

        def answered(*arguments):
            self._permits.acquire()
            return answer(*arguments)

        monkeypatch.setattr(DistanceQuestion, "answer", answered)

    def let_through(self, count):
        self._permits.release(count)


def begin_drag(s, shown):
    """Drag the source of the first panel over two places, while the first of them is being answered."""
    view = s.panels[0].view
    start = view.place_of(view.handles[0]).toPoint()
    drag(s, [start + QtCore.QPoint(0, 25 * k) for k in range(4)], end=False)
    assert s.source != shown


def marked(panel):
    return [mark.vertex for mark in panel.marks._shown["field"]]


def test_fields_far_behind_a_moving_source_are_pale_and_marked_where_it_is(shown, monkeypatch):
    s, ids = shown
    show_at(s, ids[-1])
    monkeypatch.setattr("app.qt.progress_display.BEHIND", 0.0)
    gate = Gate(monkeypatch)
    begin_drag(s, ids[-1])
    s.until(lambda: all(panel.view._is_dimmed for panel in s.panels))
    assert all(marked(panel) == [s.source] for panel in s.panels)
    gate.let_through(10**6)
    parts(s.window).gestures._release()
    s.until(lambda: s.session.is_complete)
    assert not any(panel.view._is_dimmed for panel in s.panels)


def test_a_mark_belongs_to_the_field_that_is_shown_while_the_source_moves(shown, monkeypatch):
    s, ids = shown
    show_at(s, ids[-1])
    monkeypatch.setattr("app.qt.progress_display.BEHIND", np.inf)
    parts(s.window).progress_display._late_soon.setInterval(10**8)
    gate = Gate(monkeypatch)
    begin_drag(s, ids[-1])
    assert all(marked(panel) == [ids[-1]] for panel in s.panels)
    gate.let_through(len(s.panels))
    at = [s.session.shown[panel.id].question.at for panel in s.panels]
    s.until(lambda: [s.session.shown[panel.id].question.at for panel in s.panels] != at)
    for panel in s.panels:
        assert marked(panel) == [s.session.shown[panel.id].question.at]
        assert not panel.view._is_dimmed
    gate.let_through(10**6)
    parts(s.window).gestures._release()
    s.until(lambda: s.session.is_complete)
    assert all(marked(panel) == [s.source] for panel in s.panels)


def test_nothing_is_marked_once_there_is_no_source(shown):
    s, ids = shown
    show_at(s, ids[-1])
    panel = s.panels[0]
    panel.marks.begin(s.session.mesh().surface)
    assert len(panel.view.over.points.positions("field")) == 0
