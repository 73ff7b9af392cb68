"""Sources in the hands of tests: clicked, dragged, typed, and compared with what the command line computes."""

import numpy as np

from app.main import main
from tests.qt.events import send_mouse
from tests.qt.parts import parts


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
    from qtpy import QtCore, QtTest

    view, left = s.panels[panel].view, QtCore.Qt.MouseButton.LeftButton
    QtTest.QTest.mousePress(view, left, pos=places[0])
    for place in places[1:]:
        send_mouse(view, place, buttons=left)
        s.settle(0.02)
    if end:
        QtTest.QTest.mouseRelease(view, left, pos=places[-1])
        s.until(lambda: s.session.is_complete)


def typed(s, words):
    from qtpy import QtTest

    box = parts(s.window).typed_source.box
    box.setFocus()
    box.selectAll()
    QtTest.QTest.keyClicks(box, f"{words}\r")
    s.until(lambda: s.session.is_complete)


def check_fields(s, words, tmp_path):
    """That the panels show what the command line computes."""
    for panel, answer in zip(s.document.panels, s.answers, strict=True):
        out = tmp_path / f"{panel.id}.csv"
        spec = str(panel.shows)
        assert main(["field", str(s.path), "--distance", spec, "--sources", words, "-o", str(out)]) == 0
        field = np.loadtxt(out, delimiter=",", skiprows=1)[:, -1]
        assert np.abs(field - answer.field).max() <= 1e-9 * answer.maximum, spec
