"""Isolines in the window: chosen from the menu, through points, on the surface and on the colour bar."""

from dataclasses import replace

import numpy as np
import pytest
from qtpy import QtCore, QtTest

from app.document.document import Inset
from app.document.edits import move_source
from app.document.looks import Isolines
from app.document.quantities import Difference
from app.document.settings import BOLD_ISOLINES, EQUAL_STEPS, RANGE
from app.qt.panels.line_labels import LabelFinder, label_request
from app.scene.levels import round_step
from app.scene.line_labels import value_text
from bihdist_core import ParameterError
from tests.qt.parts import parts
from tests.tools.source.sourcing import drag


@pytest.fixture
def s(shared_screen):
    return shared_screen()


def words(menu):
    return [action.text() for action in menu.actions() if action.isChecked()]


def test_the_menu_and_the_button_say_where_they_are(s):
    menu, button = s.window.menus.isolines, s.window.tool_bar.buttons["isolines"]
    choices = parts(s.window).isolines
    assert (words(menu), button.accessibleDescription()) == (["About 20"], "20")
    choices.steps(7)
    assert (words(menu), button.accessibleDescription()) == (["Another number (7)…"], "7")
    choices.spacing("0,25")
    assert (words(menu), button.accessibleDescription()) == (["Spacing (0.25)…"], "0.25 apart")
    choices.values("0.5 0.1 0.5")
    assert (words(menu), s.document.isolines.values) == (["Values (2)…"], (0.1, 0.5))
    s.window.actions_by_word["bold_isolines"].trigger()
    s.window.actions_by_word["isoline_labels"].trigger()
    assert s.document.isolines == Isolines(7, values=(0.1, 0.5), bold=5, labels=True)
    choices.steps(10)
    assert words(menu) == ["About 10", "Bold every fifth", "Labels"]
    choices.steps(0)
    assert (words(menu)[0], button.accessibleDescription()) == ("None", "None")
    for _ in range(6):
        s.session.undo()
    assert (s.document.isolines, words(menu)) == (Isolines(), ["About 20"])


def test_what_is_typed_wrong_is_said(s):
    choices = parts(s.window).isolines
    for take, text, said in [
        (choices.spacing, "wide", "'wide' is not a number"),
        (choices.spacing, "0", "positive"),
        (choices.spacing, "1e-9", "isolines up to"),
        (choices.values, "", "one value at least"),
        (choices.values, "1 x", "'x' is not a number"),
    ]:
        with pytest.raises(ParameterError, match=said):
            take(text)
    assert s.document.isolines == Isolines()


def test_a_spacing_is_a_fraction_for_differences(s):
    document = s.document
    shows = Difference(document.panels[0].shows, document.panels[1].shows)
    s.session.show(replace(document, panels=(replace(document.panels[0], shows=shows),)))
    s.until(lambda: s.session.is_complete)
    field = s.answers[0].field
    step = np.abs(field).max() / 100 / 20.5
    parts(s.window).isolines.spacing(f"{step:.12g}")
    assert np.diff(s.panels[0].view.scene.field_actor.levels.values) == pytest.approx(100 * step)
    # In percentage points there would be a hundred times as many.
    parts(s.window).isolines.spacing(f"{step / 20:.12g}")
    with pytest.raises(ParameterError, match="isolines up to 0"):
        parts(s.window).isolines.spacing(f"{step / 100:.12g}")


def test_lines_are_where_their_values_are(s):
    parts(s.window).isolines.steps(0)
    s.settle()
    bare = s.pictures()[0].astype(int)
    field = s.answers[0].field
    values = np.array([0.2, 0.4, 0.7, 0.9]) * field.max()
    parts(s.window).isolines.values(" ".join(map(repr, values.tolist())))
    s.settle()
    changed = np.abs(s.pictures()[0].astype(int) - bare).max(axis=2) > 40
    assert changed.sum() > 100
    view, surface = s.panels[0].view, s.session.mesh().surface
    at = np.array([[p.x(), p.y()] for p in map(view.place_of, surface.vertices)]) * view.devicePixelRatioF()
    found = []
    for value in values:
        a, b = field[surface.edges.T] - value
        crossed = a * b < 0
        ends, share = at[surface.edges[crossed]], (a / (a - b))[crossed, None]
        found.append((1 - share) * ends[:, 0] + share * ends[:, 1])
    rows, columns = np.nonzero(changed)
    # Every changed pixel is near where some edge of the mesh has one of the values.
    off = np.linalg.norm(np.stack([columns, rows], 1)[:, None] - np.concatenate(found)[None], axis=2).min(axis=1)
    assert np.median(off) < 5
    assert off.max() < 45  # an edge of this mesh is some 80 pixels long
    assert s.panels[0].bar._reading.lines == pytest.approx(values)


def test_a_line_through_a_point_follows_source_and_undo(s):
    choices = parts(s.window).isolines
    choices.pass_through(0, 40)
    s.settle()
    field = s.answers[0].field

    def through():
        found = s.panels[0].view.scene.field_actor.levels
        return found.values[found.is_through].tolist()

    assert through() == [field[40]]
    points = s.panels[0].view.over.points
    assert np.array_equal(points.positions("isolines"), s.session.mesh().surface.vertices[[40]])
    assert field[40] in s.panels[0].bar._reading.lines
    assert s.window.menus.isolines.through.isEnabled()
    s.session.show(move_source(s.document, 0, 100))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert s.answers[0].field[40] != field[40]
    assert through() == [s.answers[0].field[40]]
    choices.pass_through_none()
    assert through() == []
    assert not len(points.positions("isolines"))
    s.session.undo()
    assert through() == [s.answers[0].field[40]]
    # A new panel has it, too.
    parts(s.window).choices.add_panel()
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert s.panels[-1].view.scene.field_actor.levels.is_through.sum() == 1


def test_lines_are_at_round_values_unless_equal_steps_are_chosen(s):
    scene = s.panels[0].view.scene
    top = scene.field_actor.maximum
    step = round_step(top, 20)
    assert scene.field_actor.levels.values == pytest.approx(np.arange(step, top, step))
    parts(s.window).choices.set(RANGE, "fraction")
    assert scene.field_actor.levels.values == pytest.approx(top * np.arange(1, 20) / 20)
    s.session.undo()
    assert scene.field_actor.levels.values == pytest.approx(np.arange(step, top, step))
    equal = s.window.actions_by_word["equal_isolines"]
    equal.trigger()
    assert scene.field_actor.levels.values == pytest.approx(top * np.arange(1, 20) / 20)
    assert (s.document.isolines, equal.isChecked()) == (
        Isolines(round=False),
        True,
    )


def test_lines_keep_their_step_until_a_dragged_source_is_released(s):
    panel, (one, other) = s.panels[0], s.seen(2)
    scene, tops = panel.view.scene, []
    for vertex in (one, other):
        s.session.show(move_source(s.document, 0, vertex))
        s.until(lambda: s.session.is_complete)
        tops.append(scene.field_actor.maximum)
    count = next(n for n in range(10, 100) if len({round_step(top, n) for top in tops}) == 2)
    parts(s.window).isolines.steps(count)
    before, after = (round_step(top, count) for top in reversed(tops))
    place = s.point_of(panel, one)
    drag(s, [s.point_of(panel, other), place], end=False)
    s.until(lambda: s.session.is_complete and scene.field_actor.maximum == tops[0])
    s.settle(0.05)
    assert scene.field_actor.levels.values == pytest.approx(np.arange(before, tops[0], before))
    QtTest.QTest.mouseRelease(panel.view, QtCore.Qt.MouseButton.LeftButton, pos=place)
    s.until(lambda: s.session.is_complete)
    assert scene.field_actor.levels.values == pytest.approx(np.arange(after, tops[0], after))


def test_the_colour_bar_tells_bold_lines_and_lines_through_points(s):
    choices = parts(s.window).isolines
    choices.steps(10)
    parts(s.window).choices.set(EQUAL_STEPS, False)
    parts(s.window).choices.set(BOLD_ISOLINES, 5)
    choices.pass_through(0, 40)
    s.settle()
    bar, scene = s.panels[0].bar, s.panels[0].view.scene
    layout, value = bar._layout, s.answers[0].field[40]
    assert (len(layout.isolines), len(layout.bold), len(layout.through)) == (9, 1, 1)
    picture = bar.grab().toImage()
    ratio, row = bar.devicePixelRatioF(), layout.bar.middle[1]

    def colour(x):
        return np.array(picture.pixelColor(int(x * ratio), int(row * bar.devicePixelRatioF())).getRgbF()[:3])

    (x,) = layout.through
    assert x == pytest.approx(layout.bar.x + layout.bar.width * value / scene.field_actor.maximum)
    assert colour(x) == pytest.approx(scene.style.source, abs=0.02)
    (x,) = layout.bold
    usual = next(other for other in layout.isolines if other != x)
    line = np.array(scene.style.isoline)

    def width(x):
        return sum(np.abs(colour(x + step) - line).max() < 0.02 for step in np.arange(-4, 5) / ratio)

    assert width(x) == 2 * width(usual)


def test_a_spacing_that_is_too_small_for_a_field_is_said(s):
    panel = s.panels[0]
    spacing = s.answers[0].maximum / 3000
    s.session.show(replace(s.document, isolines=Isolines(spacing=spacing)))  # as of a session's file
    s.settle()
    assert len(panel.view.scene.field_actor.levels.values) == 0
    assert panel.bar._reading.notes == ("no isolines: 2,999 are too many",)
    assert "Choose a spacing of" in panel.head.warning.toolTip()
    s.session.undo()
    s.settle()
    assert (panel.bar._reading.notes, panel.head.warning.toolTip()) == ((), "")


def written_on(panel):
    """(h, w) where something is written on a panel's picture; None before anything is."""
    view = panel.view
    return None if view._written is None else (view._written != view._drawing).any(axis=2)


def test_labels_come_once_the_camera_rests_and_go_when_it_moves(s):
    s.window.actions_by_word["isoline_labels"].trigger()
    s.until(lambda: all(written_on(panel) is not None for panel in s.panels))
    panel = s.panels[0]
    assert panel.view.picture.shape[:2] == written_on(panel).shape
    assert 300 < written_on(panel).sum() < 0.1 * written_on(panel).size
    assert (panel.view.shot() == panel.view._written[..., :3]).all()
    # Nothing is written over the source.
    source = panel.view.place_of(s.session.mesh().surface.vertices[s.source])
    rows, columns = np.nonzero(written_on(panel))
    ratio = panel.view.devicePixelRatioF()
    off = np.hypot(columns / ratio - source.x(), rows / ratio - source.y())
    assert off.min() > panel.view.scene.style.marker_size / 2
    drawn = []
    panel.view.drawn.connect(lambda: drawn.append(written_on(panel)))
    panel.view.turn_by(1, 0)
    s.until(lambda: drawn)
    assert drawn[0] is None
    s.until(lambda: written_on(panel) is not None)
    s.window.actions_by_word["isoline_labels"].trigger()
    s.settle()
    assert written_on(panel) is None
    s.session.undo()
    s.settle(0.05)
    # A picture that is wanted now has them at once.
    assert (panel.view.shot() != panel.view._drawing[..., :3]).any()


def test_labels_say_the_values_of_the_lines_they_stand_on(s):
    s.window.actions_by_word["isoline_labels"].trigger()
    s.settle()
    panel, field = s.panels[0], s.answers[0].field
    found = LabelFinder().find(label_request(panel))
    assert len(found) >= 4
    for label in found:
        assert label.text == value_text(label.value)
        hit = panel.view.pick(QtCore.QPoint(round(label.middle[0] - 0.5), round(label.middle[1] - 0.5)))
        there = field[s.session.mesh().surface.faces[hit.face]] @ hit.weights
        # A label may stand a few pixels beside its line, which is one of twenty steps.
        assert abs(there - label.value) < 0.3 * field.max() / 20


def test_an_inset_has_a_number_of_its_own(s):
    panel = s.panels[0]
    vertex = panel.view.pick(panel.view.rect().center()).vertex
    parts(s.window).choices.set(EQUAL_STEPS, False)
    s.session.show(replace(s.document, insets=(Inset(vertex, 3.0, "top left"),)))
    s.settle()
    view, same = panel.view, panel.view.shot()
    s.session.show(replace(s.document, insets=(Inset(vertex, 3.0, "top left", 100),)))
    s.settle()
    (part,) = view.scene.insets.parts
    assert (len(part.levels.values), len(view.scene.field_actor.levels.values)) == (99, 19)
    left, right, bottom, top = (round(side) for side in part.box)
    box = np.s_[view.pixels[1] - top : view.pixels[1] - bottom, left:right]
    own, inside = view.shot(), np.zeros(same.shape[:2], bool)
    inside[box] = True
    differs = np.abs(own.astype(int) - same).max(axis=2) > 30
    assert differs[inside].mean() > 0.05
    assert not differs[~inside].any()
    # What the panel shows later is followed: another source, no lines, the surface alone.
    s.session.show(move_source(s.document, 0, 100))
    s.until(lambda: s.session.is_complete)
    s.settle()
    moved = view.shot()
    assert (np.abs(moved.astype(int) - own).max(axis=2) > 30)[inside].mean() > 0.05
    s.session.show(replace(s.document, insets=(Inset(vertex, 3.0, "top left"),)))
    s.settle()
    assert (np.abs(view.shot().astype(int) - moved).max(axis=2) > 30)[inside].mean() > 0.05
    s.session.undo()
    s.settle()
    assert (view.shot() == moved).all()
