"""Lines as sources: boundaries under the pointer, what is drawn on the surface, and their files."""

import json

import numpy as np
import pytest

from bihdist_core import BoundaryLoop, Curve, SourceSet, SurfacePoint
from tests.shapes import bumpy, grid

pytest.importorskip("qtpy")

from tests.qt.parts import parts
from tests.tools.source.sourcing import check_fields, click, drag, typed, where


@pytest.fixture
def loaded(screen, mesh_file):
    s = screen()
    s.open(mesh_file(bumpy(2000)), 5)
    return s


@pytest.fixture
def sheet(screen, mesh_file):
    """A flat square, which has a boundary."""
    s = screen()
    s.open(mesh_file(grid(12, 12)), 84)
    return s


def choose(s, place, text, panel=0):
    """A line of the menu of a place."""
    from qtpy import QtCore, QtTest

    QtTest.QTest.mouseClick(s.panels[panel].view, QtCore.Qt.MouseButton.RightButton, pos=place)
    s.settle(0.1)
    menu = s.application.activePopupWidget()
    (action,) = [action for action in menu.actions() if action.text().partition("\t")[0] == text]
    action.trigger()
    menu.close()
    s.until(lambda: s.session.is_complete)


def texts(s, place, panel=0):
    from qtpy import QtCore, QtTest

    QtTest.QTest.mouseClick(s.panels[panel].view, QtCore.Qt.MouseButton.RightButton, pos=place)
    s.settle(0.1)
    menu = s.application.activePopupWidget()
    found = [action.text().partition("\t")[0] for action in menu.actions()]
    menu.close()
    return found


def test_the_boundary_under_the_pointer_becomes_the_source(sheet, tmp_path):
    s = sheet
    assert "This boundary as source" not in texts(s, where(s, 84))
    corner = int(s.session.mesh().surface.boundary_edges[5][0])
    inside = where(s, corner) + (where(s, 84) - where(s, corner)) / 40
    choose(s, inside, "This boundary as source")
    assert s.source == BoundaryLoop(0)
    assert s.answers[1].label == "geodesic, exact"
    assert s.panels[1].head.controls[0].text() == "auto: exact"
    check_fields(s, "loop:0", tmp_path)
    choose(s, where(s, 84), "Add to the source")
    assert s.source == SourceSet((BoundaryLoop(0), 84))
    choose(s, inside, "Remove from the source")
    assert s.source == 84


def test_what_is_drawn_on_the_surface_becomes_a_curve(loaded, tmp_path):
    from qtpy import QtCore, QtTest

    from bihdist_core.sources.words import curve_text

    s, view = loaded, loaded.panels[0].view
    camera = view.camera.GetPosition()
    s.activate()
    s.settle()
    QtTest.QTest.keyClick(view, QtCore.Qt.Key.Key_D)
    assert s.window.actions_by_word["draw source"].isChecked()
    start = view.rect().center() - QtCore.QPoint(60, 0)
    drag(s, [start + QtCore.QPoint(8 * k, k) for k in range(16)], end=False)
    assert all(len(panel.view.over.strokes[0]) > 5 for panel in s.panels), "it is seen while it is drawn"
    QtTest.QTest.mouseRelease(view, QtCore.Qt.MouseButton.LeftButton, pos=start + QtCore.QPoint(120, 15))
    s.until(lambda: s.session.is_complete)
    assert isinstance(s.source, Curve)
    assert not s.source.closed
    assert len(s.source.places) > 5
    assert view.camera.GetPosition() == camera
    assert not any(panel.view.over.strokes for panel in s.panels)
    assert s.refusals == []
    path = tmp_path / "c.json"
    path.write_text(curve_text(s.source))
    check_fields(s, str(path), tmp_path)
    QtTest.QTest.keyClick(view, QtCore.Qt.Key.Key_Escape)
    assert not parts(s.window).sources.is_drawing
    s.session.undo()
    assert s.source == 5


def draw(s, panel=0, count=16, by=(8, 1)):
    """A stroke near the middle of a view."""
    from qtpy import QtCore

    s.window.actions_by_word["draw source"].setChecked(True)
    parts(s.window).sources.set_drawing(True)
    start = s.panels[panel].view.rect().center() - QtCore.QPoint(by[0] * count // 2, 0)
    drag(s, [start + QtCore.QPoint(by[0] * k, by[1] * k) for k in range(count)], panel)


def in_the_dialog(s, path, do):
    """Do what opens a dialog of files, and type the path of one there."""
    from qtpy import QtCore, QtTest, QtWidgets

    def choose():
        dialog = s.application.activeModalWidget()
        box = None if dialog is None else dialog.findChild(QtWidgets.QLineEdit)
        if box is not None and box.isVisible():
            box.selectAll()
            QtTest.QTest.keyClicks(box, f"{path}\r")

    # On a busy machine the dialog takes its time, and what completes a path may take the key that ends it.
    timer = QtCore.QTimer(interval=300)
    timer.timeout.connect(choose)
    timer.start()
    do()
    timer.stop()


def copied(s, what):
    from qtpy import QtWidgets

    s.window.context.actions[f"copy {what}"].trigger()
    return QtWidgets.QApplication.clipboard().text()


def read_again(line):
    """The sources that a copied line names."""
    import argparse
    import shlex

    from app.commands.figure import add_figure_options, chosen_recipe

    parser = argparse.ArgumentParser()
    add_figure_options(parser, "")
    return chosen_recipe(parser.parse_args(shlex.split(line)[2:])).document.sources


def test_a_drawn_curve_is_saved_and_the_copied_lines_name_its_file(loaded, tmp_path, monkeypatch):
    from app.qt import remembered
    from bihdist_core import source_from_words

    monkeypatch.setattr(remembered, "folder", lambda: tmp_path / "kept")
    s = loaded
    draw(s)
    curve = s.source
    assert isinstance(curve, Curve)
    line = copied(s, "command")
    assert "--recipe" not in line
    assert str(tmp_path / "kept") in line, "one that nobody has saved is kept"
    assert read_again(line) == (curve,)
    path = tmp_path / "mine.json"
    in_the_dialog(s, path, s.window.actions_by_word["save curve"].trigger)
    assert source_from_words(str(path)) == curve
    for what in ("command", "python"):
        assert str(path) in copied(s, what)
        assert "--recipe" not in copied(s, what)
    typed(s, f"7+{parts(s.window).typed_source.box.text()}")
    assert s.source == SourceSet((7, curve)), "what the box says of it means the curve"
    assert read_again(copied(s, "command")) == (s.source,)
    path.write_text(json.dumps({"points": [[1, 0.2, 0.2], [2, 0.2, 0.2]]}))
    assert read_again(copied(s, "command")) == (s.source,), "a file that has changed is not named"
    parts(s.window).files.open(str(path))
    s.until(lambda: s.session.is_complete)
    assert s.source == source_from_words(str(path)), "a curve's file can be opened like a session's"
    assert s.refusals == []


def test_a_loop_stands_in_the_copied_lines(sheet):
    s = sheet
    typed(s, "loop:0+7")
    assert "--sources loop:0+7" in copied(s, "command")
    assert "source='loop:0+7'" in copied(s, "python")


def test_a_quick_stroke_follows_the_pointer_and_is_parted_beside_the_surface(loaded):
    from qtpy import QtCore

    s, view = loaded, loaded.panels[0].view
    s.window.actions_by_word["draw source"].setChecked(True)
    parts(s.window).sources.set_drawing(True)
    middle = view.rect().center()
    drag(s, [middle, middle + QtCore.QPoint(90, 0)])
    assert isinstance(s.source, Curve)
    assert len(s.source.places) > 15, "between two of the pointer's places, too"
    beside = QtCore.QPoint(view.width() - 2, middle.y())
    assert view.pick(beside) is None
    drag(s, [middle, beside, middle + QtCore.QPoint(0, 60)])
    one, two = s.source.members
    places = [
        np.array(p.weights) @ s.session.mesh().surface.vertices[s.session.mesh().surface.faces[p.face]]
        for p in one.places
    ]
    seen = [view.place_of(x) for x in places]
    assert max(abs(each.y() - middle.y()) for each in seen) < 3, "along the line that the pointer went"
    assert isinstance(two, Curve)
    assert s.refusals == []


def test_a_ring_that_is_drawn_is_closed_and_a_click_is_a_place(loaded):
    from qtpy import QtCore, QtTest

    s, view = loaded, loaded.panels[2].view
    s.activate()
    s.settle()
    QtTest.QTest.keyClick(view, QtCore.Qt.Key.Key_D)
    turn = np.linspace(0, 2 * np.pi, 24)
    middle = view.rect().center()
    drag(s, [middle + QtCore.QPoint(round(50 * np.cos(t)), round(50 * np.sin(t))) for t in turn], 2)
    assert isinstance(s.source, Curve)
    assert s.source.closed
    click(s, middle, 2)
    assert isinstance(s.source, SurfacePoint | int)
