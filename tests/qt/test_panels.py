"""The window shows a document: its panels, their menus, undo, and what boxes and keys do to it."""

from dataclasses import replace

import numpy as np
import pytest
from qtpy.QtCore import Qt
from qtpy.QtTest import QTest

from app.document.edits import add_panel, move_source, remove_panel
from app.document.quantities import DistanceFrom, quantity
from app.document.settings import RANGE
from app.drawing.numbers import number
from app.scene.levels import round_step
from bihdist_core.distances.distance_types import Spec
from tests.qt.painting import pixels_of
from tests.qt.parts import parts
from tests.qt.test_head import choose
from tests.shapes import bumpy


def test_as_many_panels_as_the_document_has_of_equal_size(shared_screen):
    s = shared_screen()
    document = s.document
    for word in ("commute-time", "truncated", "power"):
        document = add_panel(document, DistanceFrom(Spec.of(word)))
    first = s.panels[0]
    s.session.show(document)
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert len(s.panels) == 6
    assert s.panels[0] is first
    assert len({(panel.width(), panel.height()) for panel in s.panels}) == 1
    assert {panel.y() for panel in s.panels[3:]} == {s.panels[3].y()} != {first.y()}
    assert all(picture.std() > 20 for picture in s.pictures())
    s.session.show(remove_panel(remove_panel(document, 0), 4))
    s.settle()
    assert s.panels[-1].answer.label.startswith("1/λ")
    assert len(s.panels) == 4
    assert first not in s.panels
    s.session.undo()
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert all(picture.std() > 20 for picture in s.pictures())


@pytest.mark.parametrize("place", [0, 2])
def test_a_panel_that_comes_back_shows_what_it_did_before(shared_screen, place):
    s = shared_screen()
    before = s.pictures()
    s.panels[place].head.edits["Remove panel"].trigger()
    s.settle()
    assert all(picture.shape != before[0].shape for picture in s.pictures())
    s.session.undo()
    s.settle()
    assert all(np.array_equal(a, b) for a, b in zip(before, s.pictures(), strict=True))


def test_colours_and_their_bars_end_where_the_document_says(shared_screen):
    s = shared_screen(
        bumpy(300), (Spec.of("biharmonic"), Spec.of("geodesic", method="heat"), Spec.of("commute-time")), source=5
    )

    def ends():
        tops = [panel.view.scene.field_actor.maximum for panel in s.panels]
        assert [panel.bar._reading.high for panel in s.panels] == tops
        return tops

    own = ends()
    assert own == [answer.maximum for answer in s.answers]
    panels = tuple(replace(panel, maximum=2 * own[0]) if panel.id == 0 else panel for panel in s.document.panels)
    s.session.show(replace(s.document, panels=panels))
    assert ends() == [2 * own[0], *own[1:]]
    s.session.undo()
    parts(s.window).choices.set(RANGE, "shared")
    largest = max(own[:2])
    assert ends() == [largest, largest, own[2]]
    s.session.undo()
    assert ends() == own


def test_undo_brings_back_source_parameters_and_lines_but_not_the_view(shared_screen):
    s = shared_screen()
    before = s.pictures()

    def lines():
        said, scene = s.window.tool_bar.buttons["isolines"].accessibleDescription(), s.panels[0].view.scene
        step = round_step(scene.field_actor.maximum, int(said))
        assert scene.field_actor.levels.values == pytest.approx(np.arange(step, scene.field_actor.maximum, step))
        return said

    assert lines() == "20"
    parts(s.window).isolines.steps(7)
    assert lines() == "7"
    s.session.show(move_source(s.document, 0, 9))
    s.panels[2].head.changed.emit(DistanceFrom(Spec.of("diffusion", t=0.25)))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert all((a != b).any() for a, b in zip(before, s.pictures(), strict=True))
    for _ in range(3):
        s.session.undo()
    assert (parts(s.window).typed_source.box.text(), lines()) == ("5", "20")
    assert s.panels[2].head.shows == DistanceFrom(Spec.of("diffusion"))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert all(np.array_equal(a, b) for a, b in zip(before, s.pictures(), strict=True))
    parts(s.window).views.reset("back")
    turned = s.window.grid.camera_controller.camera.GetPosition()
    s.session.redo()
    s.settle()
    assert s.window.grid.camera_controller.camera.GetPosition() == turned
    assert s.source in (5, 9)


def test_a_panel_shows_the_difference_of_two_distances_and_names_the_largest(shared_screen):
    s = shared_screen(bumpy(800))
    one, other = (answer.field / answer.maximum for answer in s.answers[:2])
    panel = s.panels[0]

    def chosen(*path):
        choose(panel.head, *path)
        s.until(lambda: s.session.is_complete)
        s.settle()
        return panel.head.name.text(), panel.answer.label

    def ends():
        return panel.bar._reading.low, panel.bar._reading.high

    assert chosen("Difference with", "Geodesic") == ("Biharmonic − Geodesic", "biharmonic, exact − geodesic, exact")
    assert np.allclose(panel.answer.field, 100 * (one - other))
    vertex = int(np.abs(one - other).argmax())
    value = panel.answer.field[vertex]
    largest = f"{number(value, signed=True)} %"
    farther = "biharmonic" if value > 0 else "geodesic"
    size = f"largest {'+' if value > 0 else '−'}{abs(value):.3g} %"
    words = f"{size} at vertex {vertex}: {farther} is farther", f"{size} at vertex {vertex}", size
    for word in ("own", "shared", "fraction"):
        parts(s.window).choices.set(RANGE, word)
        assert (panel.bar._reading.unit, panel.bar._reading.notes) == ("percentage points", words)
        assert ends() == pytest.approx((-panel.answer.maximum, panel.answer.maximum))
        ticks = [tick.text for tick in panel.bar._layout.ticks]
        assert all(tick.endswith(" %") and abs(float(tick[:-2].replace("−", "-"))) <= abs(value) for tick in ticks)
    assert s.panels[1].bar._layout.ticks[-1].text == "100 %"
    for _ in range(2):
        s.session.undo()
    s.window.grid.pointing.show(panel.id, vertex)
    # Beside the value under the pointer it cannot be taken for what that is.
    assert (panel.view.over.pointed.value, panel.view.over.pointed.share) == (largest, "largest")
    assert (panel.bar._reading.value, panel.bar._reading.remarks) == (panel.answer.field[vertex], words[1:])
    assert [row.text for row in panel.view.over.legend] == ["largest difference"]
    of_commute_time = "Biharmonic − Commute-time", "biharmonic, exact − commute-time, exact"
    assert chosen("Second: Geodesic", "Commute-time") == of_commute_time
    assert chosen("Show the first alone") == ("Biharmonic", "biharmonic, exact")
    s.session.undo()
    assert (panel.head.name.text(), ends()[0] < 0) == ("Biharmonic − Commute-time", True)
    for _ in range(2):
        s.session.undo()
    assert (panel.head.name.text(), panel.answer.label) == ("Biharmonic", "biharmonic, exact")
    assert (ends(), panel.bar._reading.notes) == ((0, panel.answer.maximum), ())
    assert not panel.view.over.legend


def test_panels_are_added_duplicated_moved_and_removed_from_their_menus(shared_screen):
    s = shared_screen()

    def shown():
        return [str(panel.shows) for panel in s.document.panels]

    def edit(place, word):
        s.panels[place].head.edits[word].trigger()

    def possible(place):
        return {word for word, action in s.panels[place].head.edits.items() if action.isEnabled()}

    edit(0, "Duplicate panel")
    assert shown() == ["biharmonic", "biharmonic", "geodesic", "diffusion"]
    edit(0, "Remove panel")
    edit(0, "Move panel right")
    edit(2, "Move panel left")
    assert shown() == ["geodesic", "diffusion", "biharmonic"]
    assert possible(0) == {"Add panel", "Duplicate panel", "Move panel right", "Remove panel"}
    for count in (4, 5, 6):
        parts(s.window).choices.add_panel()
        assert len(set(shown())) == count
    assert "Add panel" not in possible(5)
    parts(s.window).choices.add_panel()
    assert len(s.panels) == 6
    for _ in range(5):
        edit(0, "Remove panel")
    assert possible(0) == {"Add panel", "Duplicate panel"}
    s.until(lambda: s.session.is_complete)
    for _ in range(5 + 3 + 4):
        s.session.undo()
    assert shown() == ["biharmonic", "geodesic", "diffusion"]
    assert not s.session.history.can_undo


def test_undo_redo_and_the_walk_through_sources_by_keyboard(shared_screen):
    s = shared_screen()
    for vertex in (6, 7, 8):
        s.session.show(move_source(s.document, 0, vertex))
    s.activate()
    s.settle()
    view, control, shift, alt = s.panels[0].view, Qt.ControlModifier, Qt.ShiftModifier, Qt.AltModifier
    QTest.keyClick(view, Qt.Key_Z, control)
    QTest.keyClick(view, Qt.Key_Z, control)
    assert s.source == 6
    QTest.keyClick(view, Qt.Key_Z, control | shift)
    assert s.source == 7
    for key, source in [(Qt.Key_Left, 6), (Qt.Key_Left, 5), (Qt.Key_Left, 5), (Qt.Key_Right, 6), (Qt.Key_Right, 7)]:
        QTest.keyClick(view, key, alt)
        assert s.source == source
    QTest.keyClick(view, Qt.Key_Z, control)
    assert s.source == 6  # the walk came back to 7, and was no step


def test_views_have_a_history_of_their_own(shared_screen):
    s = shared_screen()
    views = parts(s.window).views
    s.until(lambda: not views._still.isActive())
    cameras = [s.window.grid.camera_controller.camera.GetPosition()]
    for view in ("left", "top"):
        views.reset(view)
        s.until(lambda: not views._still.isActive())
        cameras.append(s.window.grid.camera_controller.camera.GetPosition())

    def there():
        return s.window.grid.camera_controller.camera.GetPosition()

    for step, place in [(-1, 1), (-1, 0), (-1, 0), (1, 1), (1, 2), (1, 2), (-1, 1)]:
        views.back() if step < 0 else views.on()
        assert np.allclose(there(), cameras[place])
    assert not s.session.history.can_undo


def test_panels_are_equal_and_the_window_is_as_narrow_as_asked_whatever_is_in_their_heads(shared_screen):
    s = shared_screen(
        bumpy(300), (quantity("diffusion - biharmonic"), Spec.of("truncated"), Spec.of("power")), source=5
    )
    slider = s.panels[2].head.controls[0].slider
    for width, has_room in ((900, False), (1580, True)):
        s.window.resize(width, 600)
        s.settle()
        assert s.window.width() == width
        assert len({panel.width() for panel in s.panels}) == 1
        assert slider.isVisible() is has_room


def test_escape_puts_the_box_back_and_elsewhere_stops_the_work(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    s.activate()
    s.settle()
    box, view = parts(s.window).typed_source.box, s.panels[0].view
    QTest.keyClick(view, Qt.Key_G)
    assert s.window.focusWidget() is box
    QTest.keyClicks(box, "7")
    assert box.text() == "7"
    QTest.keyClick(box, Qt.Key_Escape)
    assert (box.value(), box.text()) == (5, "5")
    assert s.window.focusWidget() is view
    QTest.keyClick(view, Qt.Key_Escape)
    assert not s.session.is_stopped, "there is nothing to stop"
    assert not s.session.history.can_undo
    s.session.show(move_source(s.document, 0, 9))
    QTest.keyClick(view, Qt.Key_Escape)
    assert s.session.is_stopped
    s.settle()
    assert s.panels[0].stopped.isVisible()
    s.session.show(move_source(s.document, 0, 12))
    s.until(lambda: s.session.is_complete)
    assert (s.session.is_stopped, s.panels[0].stopped.isVisible()) == (False, False)


def test_what_was_stopped_and_is_not_asked_any_more_is_not_spoken_of(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    before, panel = s.pictures(), s.panels[0]
    s.session.show(move_source(s.document, 0, 9))
    s.window.context.actions["stop"].trigger()
    s.settle()
    assert (panel.stopped.isVisible(), panel.view._is_dimmed, panel.bar._reading) == (True, True, None)
    s.session.undo()
    s.settle()
    said = panel.stopped.isVisible(), panel.view._is_dimmed, panel.bar._reading.high
    assert said == (False, False, panel.answer.maximum)
    assert all(np.array_equal(a, b) for a, b in zip(before, s.pictures(), strict=True))


def test_a_first_mesh_that_fails_leaves_the_page_to_start_from_which_says_why(screen, mesh_file, tmp_path):
    s = screen()
    s.window.context.open(str(tmp_path / "gone.off"))
    s.until(lambda: s.refusals)
    page = s.window._start_page
    assert (page.isVisible(), page.message.isVisible(), page.message.whole) == (True, True, s.refusals[-1])
    assert "gone.off" in page.message.whole
    assert not s.window.grid.isVisible()
    assert (parts(s.window).typed_source.box.text(), parts(s.window).typed_source.box.isEnabled()) == ("", False)
    assert not s.window.actions_by_word["save"].isEnabled()
    s.open(mesh_file(bumpy(300)), 5)
    assert s.panels[0].isVisible()
    assert not page.isVisible()
    assert (parts(s.window).typed_source.box.value(), parts(s.window).typed_source.box.isEnabled()) == (5, True)
    assert s.window.actions_by_word["save"].isEnabled()
    assert all(picture.std() > 20 for picture in s.pictures())


def test_the_head_says_which_method_auto_has_taken(screen, mesh_file, monkeypatch):
    monkeypatch.setattr("bihdist_core.distances.geodesic_solvers.QUICK_WINDOWS", 500**1.5)
    s = screen((Spec.of("geodesic"), Spec.of("biharmonic")))
    for count, said in ((300, "auto: exact"), (800, "auto: approximate")):
        s.open(mesh_file(bumpy(count), f"{count}.off"), 5)
        s.until(lambda: s.session.is_complete)
        s.settle()
        assert [control.text() for control in s.panels[0].head.controls] == [said]


def test_the_head_says_that_auto_has_become_approximate(shared_screen, monkeypatch):
    s = shared_screen(bumpy(300), (Spec.of("geodesic"), Spec.of("biharmonic")))
    head = s.panels[0].head
    assert head.controls[0].text() == "auto: exact"
    for most in ("MOST_WINDOWS_AT_LEAST", "MOST_WINDOWS_PER_VERTEX"):
        monkeypatch.setattr(f"bihdist_core.distances.exact_geodesic.{most}", 0)
    s.session.show(move_source(s.document, 0, 77))
    s.until(lambda: s.session.is_complete)
    assert head.controls[0].text() == "auto: approximate"
    assert s.answers[0].label.startswith("geodesic, approximate")
    assert head.warning.isVisible()


def test_a_panel_that_is_kept_for_later_holds_no_picture(shared_screen):
    s = shared_screen(bumpy(60), source=None)
    gone = s.panels[-1]
    assert gone.view._drawing.size > 1000
    parts(s.window).choices.edit_panel(s.document.panels[-1].id, "Remove panel")
    s.settle()
    assert gone not in s.panels
    assert gone.view._drawing.size == 0


@pytest.mark.parametrize("part", ["head", "view", "bar"])
def test_nothing_shows_through_the_edges_of_a_panel_at_a_fractional_scale(shared_screen, monkeypatch, part):
    s = shared_screen()
    widget = getattr(s.panels[0], part)
    # Neither edge is at a whole pixel then, and the view's picture, of whole ones, ends before the view.
    widget.resize(102, 102)
    monkeypatch.setattr(widget, "devicePixelRatioF", lambda: 1.2, raising=False)
    on_white, on_black = (painted_on(ground, widget, 1.2) for ground in ("white", "black"))
    is_left = (on_white == 255).all(axis=2) & (on_black == 0).all(axis=2)
    width, height = (round(1.2 * (1 + side)) - 1 for side in (widget.width(), widget.height()))
    assert (~is_left).sum() == width * height
    assert np.array_equal(on_white[~is_left], on_black[~is_left])


def painted_on(ground, widget, scale):
    """Return the pixels (h, w, 3) of a picture at a scale, of one colour before a widget was painted into it."""
    from qtpy import QtCore, QtGui, QtWidgets

    image = QtGui.QImage(200, 200, QtGui.QImage.Format.Format_RGB32)
    image.setDevicePixelRatio(scale)
    image.fill(QtGui.QColor(ground))
    painter = QtGui.QPainter(image)
    nothing_else = QtWidgets.QWidget.RenderFlag(0)
    widget.render(painter, QtCore.QPoint(1, 1), QtGui.QRegion(widget.rect()), nothing_else)
    painter.end()
    return pixels_of(image)[..., :3].astype(int)


def test_a_slider_that_is_moved_draws_its_panel_alone_and_asks_for_the_exact_field_when_it_is_let_go(
    shared_screen, monkeypatch
):
    s = shared_screen(bumpy(300), (Spec.of("biharmonic"), Spec.of("power", alpha=1.5)), source=5)
    asked, show = [], s.session.show
    monkeypatch.setattr(s.session, "show", lambda *some, **how: (asked.append(how), show(*some, **how)))
    slider = s.panels[1].head.controls[0].slider
    slider.setSliderDown(True)
    for step in (-3, -6, -9):
        before = [panel.view.pictures for panel in s.panels]
        slider.setSliderPosition(slider.sliderPosition() + step)
        s.until(lambda: s.session.is_answered(1))
        s.settle()
        drawn = [panel.view.pictures - count for panel, count in zip(s.panels, before, strict=True)]
        assert drawn[0] == 0 < drawn[1]
    assert [how["live"] for how in asked] == [True] * 3
    slider.setSliderDown(False)
    assert asked[3:] == [{}]
    assert s.session.is_complete
    s.session.undo()  # all of them are one step
    assert s.document.panel(1).shows.spec["alpha"] == 1.5
