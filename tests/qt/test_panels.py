"""The window shows a document: its panels, their menus, undo, and what boxes and keys do to it."""

from dataclasses import replace

import numpy as np
import pytest

from app.document.edits import add_panel, move_source, remove_panel
from app.document.quantities import DistanceFrom, quantity
from bihdist_core.distances.kinds import Spec
from tests.shapes import bumpy

pytest.importorskip("qtpy")


def test_as_many_panels_as_the_document_has_of_equal_size(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    document = s.document
    for word in ("commute-time", "truncated", "power"):
        document = add_panel(document, DistanceFrom(Spec.of(word)))
    first = s.panels[0]
    s.session.show(document)
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert len(s.panels) == 6
    assert s.panels[0] is first
    sizes = {(panel.width() // 2, panel.height() // 2) for panel in s.panels}
    assert len(sizes) == 1
    assert {panel.y() for panel in s.panels[3:]} == {s.panels[3].y()} != {first.y()}
    assert all(picture.std() > 20 for picture in s.pictures())
    s.session.show(remove_panel(remove_panel(document, 0), 4))
    s.settle()
    assert [panel.title.text() for panel in s.panels][-1].startswith("1/λ")
    assert len(s.panels) == 4
    assert first not in s.panels
    s.session.undo()
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert all(picture.std() > 20 for picture in s.pictures())


def test_colour_bars_end_where_the_document_says(screen, mesh_file):
    s = screen((Spec.of("biharmonic"), Spec.of("geodesic", method="heat"), Spec.of("commute-time")))
    s.open(mesh_file(bumpy(300)), 5)
    own = [panel.scene._field.maximum for panel in s.panels]
    panels = tuple(replace(panel, maximum=2 * own[0]) if panel.id == 0 else panel for panel in s.document.panels)
    s.session.show(replace(s.document, panels=panels))
    assert [panel.scene._field.maximum for panel in s.panels] == [2 * own[0], *own[1:]]
    s.session.undo()
    s.session.show(replace(s.document, shared_range=True))
    largest = max(own[:2])
    assert [panel.scene._field.maximum for panel in s.panels] == [largest, largest, own[2]]
    s.session.undo()
    assert [panel.scene._field.maximum for panel in s.panels] == own


def test_undo_brings_back_source_controls_and_lines_but_not_the_view(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    before = s.pictures()
    s.window.isolines_box.setValue(7)
    s.session.show(move_source(s.document, 0, 9))
    s.panels[2].controls.changed.emit(DistanceFrom(Spec.of("diffusion", t=0.25)))
    s.until(lambda: s.session.is_complete)
    for _ in range(3):
        s.session.undo()
    assert (s.window.source_box.value(), s.window.isolines_box.value()) == (5, 20)
    assert s.panels[2].controls.shows == DistanceFrom(Spec.of("diffusion"))
    s.settle()
    assert all(np.array_equal(a, b) for a, b in zip(before, s.pictures(), strict=True))
    s.window.reset_view("back")
    turned = s.window.grid.camera.GetPosition()
    s.session.redo()
    s.settle()
    assert s.window.grid.camera.GetPosition() == turned
    assert s.source in (5, 9)


def test_a_panel_shows_the_difference_of_two_distances_and_names_the_largest(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(800)), 5)
    one, other = (answer.field / answer.maximum for answer in s.answers[:2])
    controls = s.panels[0].controls
    menu = controls.first.distance
    menu.setCurrentIndex(menu.findText("Difference of two"))
    s.until(lambda: s.session.is_complete)
    s.settle()
    assert s.panels[0].title.text() == "biharmonic, exact − geodesic, exact"
    assert np.allclose(s.answers[0].field, one - other)
    vertex = int(np.abs(one - other).argmax())
    assert s.panels[0].hint.text() == f"largest {(one - other)[vertex]:+.3g} at vertex {vertex}"
    assert controls.second.isVisible()
    scene = s.panels[0].scene
    assert scene._bar.GetLookupTable().GetRange() == pytest.approx((-s.answers[0].maximum, s.answers[0].maximum))
    s.panels[0].show_value(vertex)
    assert s.panels[0].value.text().startswith(f"{(one - other)[vertex]:+.5g} ")
    second = controls.second.distance
    second.setCurrentIndex(second.findData("commute-time"))
    s.until(lambda: s.session.is_complete)
    assert s.panels[0].title.text() == "biharmonic, exact − commute-time, exact"
    controls.alone.click()
    s.until(lambda: s.session.is_complete)
    assert s.panels[0].title.text() == "biharmonic, exact"
    assert not controls.second.isVisible()
    for _ in range(3):
        s.session.undo()
    s.settle()
    assert s.panels[0].title.text() == "biharmonic, exact"
    assert scene._bar.GetLookupTable().GetRange()[0] == 0


def test_panels_are_added_duplicated_moved_and_removed_from_their_menus(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)

    def shown():
        return [str(panel.shows) for panel in s.document.panels]

    def choose(place, word):
        s.panels[place].controls.edits[word].trigger()

    def possible(place):
        return {word for word, action in s.panels[place].controls.edits.items() if action.isEnabled()}

    choose(0, "Duplicate this panel")
    assert shown() == ["biharmonic", "biharmonic", "geodesic", "diffusion"]
    choose(0, "Remove it")
    choose(0, "Move it on")
    choose(2, "Move it back")
    assert shown() == ["geodesic", "diffusion", "biharmonic"]
    assert possible(0) == {"Add a panel", "Duplicate this panel", "Move it on", "Remove it"}
    for count in (4, 5, 6):
        s.window.add_panel()
        assert len(set(shown())) == count
    assert "Add a panel" not in possible(5)
    s.window.add_panel()
    assert len(s.panels) == 6
    for _ in range(5):
        choose(0, "Remove it")
    assert possible(0) == {"Add a panel", "Duplicate this panel"}
    s.until(lambda: s.session.is_complete)
    for _ in range(5 + 3 + 4):
        s.session.undo()
    assert shown() == ["biharmonic", "geodesic", "diffusion"]
    assert not s.session.history.can_undo


def test_undo_redo_and_the_walk_through_sources_by_keyboard(screen, mesh_file):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    for vertex in (6, 7, 8):
        s.session.show(move_source(s.document, 0, vertex))
    s.window.activateWindow()
    s.settle()
    view, control, shift, alt = s.panels[0].interactor, Qt.ControlModifier, Qt.ShiftModifier, Qt.AltModifier
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


def test_views_have_a_history_of_their_own(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    s.settle(0.6)
    cameras = [s.window.grid.camera.GetPosition()]
    for view in ("left", "top"):
        s.window.reset_view(view)
        s.settle(0.6)
        cameras.append(s.window.grid.camera.GetPosition())

    def there():
        return s.window.grid.camera.GetPosition()

    for step, place in [(-1, 1), (-1, 0), (-1, 0), (1, 1), (1, 2), (1, 2), (-1, 1)]:
        s.window.views.back() if step < 0 else s.window.views.on()
        assert np.allclose(there(), cameras[place])
    assert not s.session.history.can_undo


def test_panels_are_equal_and_the_window_is_as_narrow_as_asked_whatever_the_controls(screen, mesh_file):
    s = screen((quantity("diffusion - biharmonic"), Spec.of("truncated"), Spec.of("power")))
    s.open(mesh_file(bumpy(300)), 5)
    slider = s.panels[0].controls.first.parameters["t"].widget
    for width, has_room in ((900, False), (1580, True)):
        s.window.resize(width, 600)
        s.settle()
        assert s.window.width() == width
        widths = [panel.width() for panel in s.panels]
        assert max(widths) - min(widths) <= 1
        assert slider.isVisible() is has_room


def test_escape_puts_a_box_back_and_elsewhere_stops_the_work(screen, mesh_file):
    from qtpy.QtCore import Qt
    from qtpy.QtTest import QTest

    s = screen()
    s.open(mesh_file(bumpy(300)), 5)
    s.window.activateWindow()
    s.settle()
    for box, value in ((s.window.source_box, 5), (s.window.isolines_box, 20)):
        box.setFocus()
        box.selectAll()
        QTest.keyClicks(box, "7")
        QTest.keyClick(box, Qt.Key_Escape)
        assert (box.value(), box.text()) == (value, str(value))
        assert s.window.focusWidget() is s.panels[0].interactor
    assert not s.session.is_stopped
    QTest.keyClick(s.panels[0].interactor, Qt.Key_Escape)
    assert s.session.is_stopped
    assert not s.session.history.can_undo


def test_a_first_mesh_that_fails_leaves_an_empty_window_that_says_what_to_do(screen, mesh_file, tmp_path):
    s = screen()
    s.window.open(str(tmp_path / "gone.off"))
    s.until(lambda: s.refusals)
    assert s.window._empty.isVisible()
    assert "Ctrl+O" in s.window._empty.text()
    assert not s.panels[0].isVisible()
    assert (s.window.source_box.text(), s.window.source_box.isEnabled()) == ("–", False)
    s.open(mesh_file(bumpy(300)), 5)
    assert s.panels[0].isVisible()
    assert s.window.source_box.value() == 5
    assert all(picture.std() > 20 for picture in s.pictures())
