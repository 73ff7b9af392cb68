"""A panel's picture with what lies over it, in the hands of the mouse.  Gestures become events; it decides nothing.

What lies over the picture is painted by Qt, and costs no drawing.
"""

from qtpy import QtCore, QtGui, QtWidgets

from ...scene.offscreen_renderer import OffscreenRenderer
from .events import Hover, MenuWanted
from .marks_over import MarksOver
from .pointer import Pointer
from .view import View

NOTCH = 1.1
"""By how much a notch of the wheel enlarges."""


class PanelView(View):
    """over: what lies over the picture; pointer: what the mouse does."""

    def __init__(self, offscreen: OffscreenRenderer, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(offscreen, parent)
        self.over = MarksOver(self)
        self.pointer = Pointer(self, self.over)
        self.wheel_factor = 1.0  # -1 for a wheel that goes the other way

    def show_empty(self, is_empty: bool) -> None:
        self.over.pointed = None
        super().show_empty(is_empty)

    def paint_over(self, painter: QtGui.QPainter) -> None:
        self.over.paint(painter)

    def see_again(self) -> None:
        self.over.see()

    # ------------------------------------------------------------------ the mouse
    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.pointer.press(event)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        self.pointer.move(event)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        self.pointer.release(event)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        self.pointer.double_click(event)

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        """By the keyboard; that of the mouse comes when its button is let go."""
        if event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard and not self.is_empty:
            middle = self.rect().center()
            self.happened.emit(MenuWanted(self.pick(middle), self.mapToGlobal(middle)))

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        if not self.is_empty and event.angleDelta().y():
            notches = event.angleDelta().y() / 120 * self.wheel_factor
            self.zoom(NOTCH**notches, event.position().toPoint())
        event.accept()

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self.happened.emit(Hover(None))

    def point_again(self) -> None:
        """What is under the pointer now, after the camera or the surface has moved."""
        self.pointer.point_again()
