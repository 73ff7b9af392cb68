"""Sources of all kinds in the window, by mouse and keys."""

import json

import numpy as np
import pytest

from app.main import main
from bihdist_core import BoundaryLoop, Curve, Place, SourceSet
from tests.shapes import bumpy, grid

pytest.importorskip("qtpy")


@pytest.fixture
def opened(screen, mesh_file):
    s = screen()
    s.path = mesh_file(bumpy(2000))
    s.open(s.path, 5)
    return s


@pytest.fixture
def sheet(screen, mesh_file):
    """A flat square, which has a boundary."""
    s = screen()
    s.path = mesh_file(grid(12, 12))
    s.open(s.path, 84)
    return s


def where(s, vertex, panel=0):
    return s.point_of(s.panels[panel], vertex)


def click(s, place, panel=0, modifiers=None):
    from qtpy import QtCore, QtTest

    modifiers = QtCore.Qt.KeyboardModifier.NoModifier if modifiers is None else modifiers
    QtTest.QTest.mouseClick(s.panels[panel].view, QtCore.Qt.MouseButton.LeftButton, modifiers, place)
    s.until(lambda: s.session.is_complete)


def ctrl_click(s, place, panel=0):
    from qtpy import QtCore

    click(s, place, panel, QtCore.Qt.KeyboardModifier.ControlModifier)


def drag(s, places, panel=0, end=True):
    """With the left button down, through places of a view."""
    from qtpy import QtCore, QtGui, QtTest

    view, left = s.panels[panel].view, QtCore.Qt.MouseButton.LeftButton
    QtTest.QTest.mousePress(view, left, pos=places[0])
    for place in places[1:]:
        nothing = QtCore.Qt.KeyboardModifier.NoModifier
        moved = QtGui.QMouseEvent(
            QtCore.QEvent.Type.MouseMove, QtCore.QPointF(place), QtCore.Qt.MouseButton.NoButton, left, nothing
        )
        s.application.sendEvent(view, moved)
        s.settle(0.02)
    if end:
        QtTest.QTest.mouseRelease(view, left, pos=places[-1])
        s.until(lambda: s.session.is_complete)


def typed(s, words):
    from qtpy import QtTest

    box = s.window.source_box
    box.setFocus()
    box.selectAll()
    QtTest.QTest.keyClicks(box, f"{words}\r")
    s.until(lambda: s.session.is_complete)


def check_fields(s, words, tmp_path):
    """That the panels show what the command line computes."""
    for panel, answer in zip(s.document.panels, s.answers, strict=True):
        out = tmp_path / f"{panel.id}.csv"
        spec = str(panel.shows)
        assert main(["field", str(s.path), "--distance", spec, "--source", words, "-o", str(out)]) == 0
        field = np.loadtxt(out, delimiter=",", skiprows=1)[:, -1]
        assert np.abs(field - answer.field).max() <= 1e-9 * answer.maximum, spec


# ---------------------------------------------------------------------- words
@pytest.mark.parametrize("words", ["12", "12+40+7", "f31:0.25,0.5", "loop:0", "7+loop:0", "CURVE"])
def test_all_words_of_sources_can_be_typed(sheet, tmp_path, words, capsys):
    s = sheet
    if words == "CURVE":
        path = tmp_path / "c.json"
        path.write_text(json.dumps({"points": [[3, 0.25, 0.25], [120, 0.5, 0.25]]}))
        words = str(path)
    typed(s, words)
    assert not s.window.source_box.wrong.isVisible()
    check_fields(s, words, tmp_path)
    shown = s.window.source_box.text()
    assert shown == (words if not words.endswith(".json") else "a curve of 2 points")
    s.session.undo()
    assert s.source == 84
    assert s.window.source_box.text() == "84"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("f31", "a place in a face has two weights"),
        ("f999:0.2,0.2", "has no face 999"),
        ("loop:3", "its only one is loop:0"),
        ("12+9999", "9999"),
        ("missing.json", "cannot be read"),
        ("banana", "is no source"),
    ],
)
def test_words_of_no_source_are_refused_under_the_box(sheet, words, said):
    s = sheet
    typed(s, words)
    assert s.window.source_box.wrong.isVisible()
    assert said in s.window.source_box.wrong.text()
    assert s.source == 84


def test_a_short_sentence_after_a_long_one_has_a_low_box(sheet):
    box = sheet.window.source_box
    typed(sheet, "9999")
    low = box.wrong.height()
    typed(sheet, "banana")
    assert box.wrong.height() > low
    typed(sheet, "9999")
    assert box.wrong.height() == low


# ---------------------------------------------------------------------- places
def test_without_snapping_a_click_puts_the_source_into_the_face(opened, tmp_path):
    from qtpy import QtCore

    s, view = opened, opened.panels[0].view
    s.window.actions_by_word["snap"].trigger()
    place = view.rect().center()
    met = view.met_at(place)
    click(s, place)
    at = s.source
    assert isinstance(at, Place)
    assert at.face == met.face
    assert np.abs(np.array(at.weights) - met.weights).max() <= 1e-4
    check_fields(s, s.window.source_box.text(), tmp_path)
    corners = s.session.surface.faces[at.face]
    position = np.array(at.weights) @ s.session.surface.vertices[corners]
    for panel in s.panels:
        assert np.allclose(panel.view.source, position), "its mark is there on all panels"
    s.window.actions_by_word["snap"].trigger()
    place += QtCore.QPoint(90, 0)
    click(s, place)
    assert s.source == view.met_at(place).vertex


def test_without_snapping_the_mark_is_dragged_through_faces_and_is_exact_at_the_end(opened, tmp_path):
    from qtpy import QtCore

    s, view = opened, opened.panels[1].view
    s.window.actions_by_word["snap"].trigger()
    start = view.rect().center()
    click(s, start, 1)
    before, labels, rates = s.source, [], []
    tell, rate = s.window.answer_changed, s.window.status.show_rate
    s.window.answer_changed = lambda id: (labels.append(s.session.shown[1].answer.label), tell(id))
    s.window.status.show_rate = lambda text: (rates.append(text), rate(text))
    drag(s, [start + QtCore.QPoint(4 * k, k) for k in range(30)], 1)
    assert "geodesic, heat method" in labels
    assert s.answers[1].label.startswith("geodesic, exact")
    assert any("fields a second" in text and "geodesic, heat method" in text for text in rates)
    assert rates[-1] == "", "nothing is said once it rests"
    assert isinstance(s.source, Place)
    seen = view.place_of(view.source) - (start + QtCore.QPoint(116, 29))
    assert abs(seen.x()) < 1.5
    assert abs(seen.y()) < 1.5
    check_fields(s, s.window.source_box.text(), tmp_path)
    s.session.undo()
    assert s.source == before, "the drag is one step"


# ---------------------------------------------------------------------- sets
def test_ctrl_click_makes_a_set_and_takes_from_it_and_undo_goes_back(opened, tmp_path):
    from qtpy import QtCore

    s, view = opened, opened.panels[0].view
    middle = view.rect().center()
    first = view.met_at(middle).vertex
    click(s, where(s, first))
    others = [view.met_at(middle + QtCore.QPoint(*by)).vertex for by in ((70, 0), (0, 60))]
    for other in others:
        ctrl_click(s, where(s, other))
    assert s.source == SourceSet((first, *others))
    assert s.window.source_box.text() == "+".join(map(str, (first, *others)))
    check_fields(s, s.window.source_box.text(), tmp_path)
    assert len(view.handles) == 3
    ctrl_click(s, where(s, first))
    assert s.source == SourceSet(tuple(others))
    s.session.undo()
    s.session.undo()
    assert s.source == SourceSet((first, others[0]))
    s.session.undo()
    assert s.source == first
    ctrl_click(s, where(s, first))
    assert s.source == first, "the last one stays"


def test_a_member_of_a_set_is_dragged_alone(opened):
    from qtpy import QtCore

    s, view = opened, opened.panels[0].view
    middle = view.rect().center()
    one, two = (view.met_at(middle + QtCore.QPoint(x, 0)).vertex for x in (0, 80))
    click(s, where(s, one))
    ctrl_click(s, where(s, two))
    start = where(s, two)
    drag(s, [start + QtCore.QPoint(0, 4 * k) for k in range(15)])
    members = s.source.members
    assert len(members) == 2
    assert members[0] == one
    assert members[1] not in (one, two)
    s.session.undo()
    assert s.source == SourceSet((one, two))


def test_the_walk_goes_through_sources_of_all_kinds_and_leaves_pins_alone(opened):
    from app.document.measuring import add_pins

    s = opened
    for words in ("12+40", "f31:0.25,0.5"):
        typed(s, words)
    s.session.show(add_pins(s.document, [7]))
    s.window.actions_by_word["source before"].trigger()
    assert s.source == SourceSet((12, 40))
    s.window.actions_by_word["source before"].trigger()
    assert s.source == 5
    assert len(s.document.pins) == 1
    s.window.actions_by_word["source after"].trigger()
    assert s.source == SourceSet((12, 40))


def test_undo_redo_and_the_walk_go_through_all_kinds(sheet, tmp_path):
    s, do = sheet, sheet.window.actions_by_word
    path = tmp_path / "c.json"
    path.write_text(json.dumps({"points": [[3, 0.25, 0.25], [120, 0.5, 0.25]]}))
    passed, texts = [s.source], ["84"]
    for words in ("12+40", "f31:0.25,0.5", "loop:0", str(path), f"7+{path}"):
        typed(s, words)
        passed.append(s.source)
        texts.append(s.window.source_box.text())
    assert len(set(passed)) == 6
    for back, on in (("undo", "redo"), ("source before", "source after")):
        for word, order in ((back, range(4, -1, -1)), (on, range(1, 6))):
            for k in order:
                do[word].trigger()
                s.until(lambda: s.session.is_complete)
                assert s.source == passed[k]
                assert s.window.source_box.text() == texts[k]
    assert s.refusals == []


# ---------------------------------------------------------------------- lines
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
    corner = int(s.session.surface.boundary_edges[5][0])
    inside = where(s, corner) + (where(s, 84) - where(s, corner)) / 40
    choose(s, inside, "This boundary as source")
    assert s.source == BoundaryLoop(0)
    check_fields(s, "loop:0", tmp_path)
    choose(s, where(s, 84), "Add to the source")
    assert s.source == SourceSet((BoundaryLoop(0), 84))
    choose(s, inside, "Remove from the source")
    assert s.source == 84


def test_what_is_drawn_on_the_surface_becomes_a_curve(opened, tmp_path):
    from qtpy import QtCore, QtTest

    from bihdist_core.sources.words import curve_text

    s, view = opened, opened.panels[0].view
    camera = view.camera.GetPosition()
    s.window.activateWindow()
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
    assert not s.window.gestures.sources.is_drawing
    s.session.undo()
    assert s.source == 5


def draw(s, panel=0, count=16, by=(8, 1)):
    """A stroke near the middle of a view."""
    from qtpy import QtCore

    s.window.actions_by_word["draw source"].setChecked(True)
    s.window.gestures.sources.set_drawing(True)
    start = s.panels[panel].view.rect().center() - QtCore.QPoint(by[0] * count // 2, 0)
    drag(s, [start + QtCore.QPoint(by[0] * k, by[1] * k) for k in range(count)], panel)


def in_the_dialog(s, path, do):
    """Do what opens a dialog of files, and type the path of one there."""
    from qtpy import QtCore, QtTest, QtWidgets

    def choose():
        dialog = s.application.activeModalWidget()
        box = None if dialog is None else dialog.findChild(QtWidgets.QLineEdit)
        if box is None or not box.isVisible():
            QtCore.QTimer.singleShot(100, choose)  # on a busy machine it takes its time
            return
        box.selectAll()
        QtTest.QTest.keyClicks(box, f"{path}\r")

    QtCore.QTimer.singleShot(200, choose)
    do()


def copied(s, what):
    from qtpy import QtWidgets

    s.window.files.copy(what)
    return QtWidgets.QApplication.clipboard().text()


def read_again(line):
    """The sources that a copied line names."""
    import argparse
    import shlex

    from app.commands.figure_options import add_figure_options, chosen_recipe

    parser = argparse.ArgumentParser()
    add_figure_options(parser, "")
    return chosen_recipe(parser.parse_args(shlex.split(line)[2:])).document.sources


def test_a_drawn_curve_is_saved_and_the_copied_lines_name_its_file(opened, tmp_path, monkeypatch):
    from app.qt import remembered
    from bihdist_core import source_from_words

    monkeypatch.setattr(remembered, "folder", lambda: tmp_path / "kept")
    s = opened
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
    typed(s, f"7+{s.window.source_box.text()}")
    assert s.source == SourceSet((7, curve)), "what the box says of it means the curve"
    assert read_again(copied(s, "command")) == (s.source,)
    path.write_text(json.dumps({"points": [[1, 0.2, 0.2], [2, 0.2, 0.2]]}))
    assert read_again(copied(s, "command")) == (s.source,), "a file that has changed is not named"
    s.window.files.open(str(path))
    s.until(lambda: s.session.is_complete)
    assert s.source == source_from_words(str(path)), "a curve's file can be opened like a session's"
    assert s.refusals == []


def test_a_loop_stands_in_the_copied_lines(sheet):
    s = sheet
    typed(s, "loop:0+7")
    assert "--source loop:0+7" in copied(s, "command")
    assert "source='loop:0+7'" in copied(s, "python")


def test_a_quick_stroke_follows_the_pointer_and_is_parted_beside_the_surface(opened):
    from qtpy import QtCore

    s, view = opened, opened.panels[0].view
    s.window.actions_by_word["draw source"].setChecked(True)
    s.window.gestures.sources.set_drawing(True)
    middle = view.rect().center()
    drag(s, [middle, middle + QtCore.QPoint(90, 0)])
    assert isinstance(s.source, Curve)
    assert len(s.source.places) > 15, "between two of the pointer's places, too"
    beside = QtCore.QPoint(view.width() - 2, middle.y())
    assert view.met_at(beside) is None
    drag(s, [middle, beside, middle + QtCore.QPoint(0, 60)])
    one, two = s.source.members
    places = [np.array(p.weights) @ s.session.surface.vertices[s.session.surface.faces[p.face]] for p in one.places]
    seen = [view.place_of(x) for x in places]
    assert max(abs(each.y() - middle.y()) for each in seen) < 3, "along the line that the pointer went"
    assert isinstance(two, Curve)
    assert s.refusals == []


def test_a_ring_that_is_drawn_is_closed_and_a_click_is_a_place(opened):
    from qtpy import QtCore, QtTest

    s, view = opened, opened.panels[2].view
    s.window.activateWindow()
    s.settle()
    QtTest.QTest.keyClick(view, QtCore.Qt.Key.Key_D)
    turn = np.linspace(0, 2 * np.pi, 24)
    middle = view.rect().center()
    drag(s, [middle + QtCore.QPoint(round(50 * np.cos(t)), round(50 * np.sin(t))) for t in turn], 2)
    assert isinstance(s.source, Curve)
    assert s.source.closed
    click(s, middle, 2)
    assert isinstance(s.source, Place | int)


def test_snapping_is_remembered_and_kept_with_a_session(application, screen, mesh_file, tmp_path, monkeypatch):
    from qtpy import QtTest

    from app.document.document import comparison
    from app.qt import preferences, remembered, start

    monkeypatch.setattr(remembered, "folder", lambda: tmp_path)
    s = screen()
    s.window.remembers = True
    s.open(mesh_file(bumpy(400)), 5)
    s.window.activateWindow()
    s.settle()
    snaps = s.window.actions_by_word["snap"]
    QtTest.QTest.keyClicks(s.panels[0].view, "v")
    assert not snaps.isChecked()
    assert not preferences.load().snap
    assert not s.session.can_undo, "it is no step"
    path = str(tmp_path / "s.json")
    s.window.session_file.save(path)
    QtTest.QTest.keyClicks(s.panels[0].view, "v")
    assert snaps.isChecked()
    assert preferences.load().snap
    typed(s, "7")
    s.session.undo()
    assert snaps.isChecked(), "undo leaves it as it is"
    s.window.files.open(path)
    s.until(lambda: s.session.is_complete and not snaps.isChecked())
    click(s, s.panels[0].view.rect().center())
    assert isinstance(s.source, Place)
    s.window.remembers = False
    new = start.as_preferred(comparison(""), preferences.Preferences(snap=False))
    assert not new.snap


def test_all_kinds_come_back_with_a_session(sheet, tmp_path):
    s = sheet
    curve = tmp_path / "c.json"
    curve.write_text(json.dumps({"points": [[3, 0.25, 0.25], [120, 0.5, 0.25], [60, 0.1, 0.2]], "closed": True}))
    kinds = ["12+40", "f31:0.25,0.5", "loop:0", str(curve), f"7+loop:0+{curve}"]
    for number, words in enumerate(kinds):
        typed(s, words)
        path = str(tmp_path / f"{number}-session.json")
        s.window.session_file.save(path)
        before, fields = s.source, [answer.field for answer in s.answers]
        text = s.window.source_box.text()
        typed(s, "3")
        s.window.files.open(path)
        s.until(lambda before=before: s.session.is_complete and s.source == before)
        assert s.window.source_box.text() == text
        for field, answer in zip(fields, s.answers, strict=True):
            assert np.array_equal(field, answer.field)
