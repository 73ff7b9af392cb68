"""Pins in the hands of tests: put by mouse and by ids."""

import numpy as np

from app.document.shared_parts.pins import Pins
from tests.qt.parts import parts


def ids(s):
    return [s.document.point(pin.point).at for pin in s.document[Pins].pins]


def shift_click(s, vertex, panel=0):
    from qtpy import QtCore, QtTest

    shift, left = QtCore.Qt.KeyboardModifier.ShiftModifier, QtCore.Qt.MouseButton.LeftButton
    QtTest.QTest.mouseClick(s.panels[panel].view, left, shift, s.point_of(s.panels[panel], vertex))
    s.settle(0.05)


def seen_vertices(s, count):
    """Some that are seen, apart."""
    view, found = s.panels[0].view, []
    for x in np.linspace(0.35, 0.65, count):
        point = view.rect().center()
        point.setX(round(x * view.width()))
        found.append(view.pick(point).vertex)
    assert len(set(found)) == count
    return found


def dock_of(s):
    s.window.actions_by_word["dock pins"].trigger()
    s.settle(0.1)
    return parts(s.window).docks._docks["pins"].content


def type_ids(s, dock, text):
    from qtpy import QtCore, QtTest

    dock.box.setFocus()
    dock.box.selectAll()
    QtTest.QTest.keyClicks(dock.box, text)
    QtTest.QTest.keyClick(dock.box, QtCore.Qt.Key.Key_Return)
    s.settle(0.05)
