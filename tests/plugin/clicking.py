"""Opens the window, clicks on the panel of geodesic distance while the dock is open, and prints what comes of it."""

import sys

import bihdist
from bihdist.document.page import Recipe
from bihdist.figures.one_line import command_line
from qtpy import QtCore, QtGui, QtWidgets
from qtpy.QtTest import QTest


def wait(is_so):
    for _ in range(600):
        if is_so():
            return
        QTest.qWait(50)
    raise TimeoutError


def drag(view, start, now):
    """The pin marker, which stands where the view was clicked, to a place below it."""
    left, tip = QtCore.Qt.MouseButton.LeftButton, view.rect().center()
    heads = (tip - QtCore.QPoint(0, up) for up in range(2, 60))
    head = next(at for at in heads if view.over.points.standing_at(at))
    QTest.mousePress(view, left, pos=head)
    for down in (8, 16, 24, 32):
        at, none = head + QtCore.QPoint(0, down), QtCore.Qt.KeyboardModifier.NoModifier
        here, there = QtCore.QPointF(at), QtCore.QPointF(view.mapToGlobal(at))
        move = QtGui.QMouseEvent(QtCore.QEvent.Type.MouseMove, here, there, left, left, none)
        QtWidgets.QApplication.sendEvent(view, move)
    QTest.mouseRelease(view, left, pos=head + QtCore.QPoint(0, 32))
    wait(lambda: now() != start)


def main(folder):
    viewer = bihdist.show("hand", ["biharmonic", "geodesic"], source=12, block=False)
    (window,) = (each for each in QtWidgets.QApplication.topLevelWidgets() if isinstance(each, QtWidgets.QMainWindow))
    (action,) = (each for each in window.findChildren(QtWidgets.QAction) if each.text() == "Geodesic ci&rcle")
    action.trigger()
    wait(lambda: any(each.objectName() == "circle measures" for each in window.findChildren(QtWidgets.QLabel)))
    (label,) = window.findChildren(QtWidgets.QLabel, "circle measures")
    print(label.text())
    view = [each for each in window.findChildren(QtWidgets.QWidget) if type(each).__name__ == "PanelView"][1]
    before = viewer.screenshot(f"{folder}/before.png").read_bytes()
    wait(lambda: viewer.panels[1].field is not None)
    QTest.mouseClick(view, QtCore.Qt.MouseButton.LeftButton, pos=view.rect().center())
    wait(lambda: label.text().startswith("radius"))
    print(label.text())
    drag(view, viewer.document.point("circle"), lambda: viewer.document.point("circle"))
    assert viewer.screenshot(f"{folder}/after.png").read_bytes() != before
    print(command_line(Recipe(viewer.document), "out.png"))
    viewer.close()


main(sys.argv[1])
