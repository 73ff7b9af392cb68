"""A panel's picture with what lies over it, under the mouse: it turns the surface, holds a mark, draws or paints.

Each gesture becomes an event.  What lies over the picture is painted by Qt, and costs no drawing.
"""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from ...scene import moves
from ...scene.offscreen_renderer import OffscreenRenderer
from .events import (
    BrushLift,
    BrushTouch,
    Click,
    Hover,
    MarkClick,
    MarkDrag,
    MarkRelease,
    MenuWanted,
    SecondClick,
    Stroke,
    StrokeEnd,
)
from .marks_over import MarksOver
from .view import View

NOTCH_ZOOM = 1.1
"""Factor by which a notch of the wheel enlarges."""

STROKE_STEP_PX, MAX_STROKE_STEPS = 5, 200
"""Pixels from one point of a drawn stroke to the next, and the most points for one movement of the pointer."""

BRUSH_STEP_PX, MAX_BRUSH_STEPS = 6, 24
"""Pixels between two places that a brush touches, and the most of them for one movement of the pointer."""

_CTRL = QtCore.Qt.KeyboardModifier.ControlModifier
_NONE = QtCore.Qt.MouseButton.NoButton


class PanelView(View):
    """A view that emits what the mouse does in it; of several buttons, the first that went down counts.

    Attributes
    ----------
    over
        What lies over the picture.
    wheel_factor
        -1 for a wheel that zooms the other way.
    """

    def __init__(self, offscreen: OffscreenRenderer, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(offscreen, parent)
        self.over = MarksOver(self)
        self.wheel_factor = 1.0
        self.is_drawn_on = False  # whether the left button draws
        self.brush: QtGui.QCursor | None = None  # what drags paint with, instead of turning
        self._button = _NONE
        self._press: QtCore.QPoint | None = None
        self._last = QtCore.QPoint()
        self._is_dragging = self._is_stroke = self._is_brushing = False
        self._has_clicked = False  # whether the last button that came up was a plain click on the surface
        self._held = -1  # the number of the source's mark that is held
        self._drop: tuple[str, int] | None = None  # the pin or pair that is held, by its number
        self._grip = QtCore.QPoint()  # and from where to its tip

    def show_empty(self, is_empty: bool) -> None:
        self.over.pointed = None
        super().show_empty(is_empty)

    def paint_over(self, painter: QtGui.QPainter) -> None:
        self.over.paint(painter)

    def update_hidden(self) -> None:
        self.over.find_hidden()

    @property
    def is_up(self) -> bool:
        """True if no button is down."""
        return bool(self._button == _NONE)

    def draw_on(self, is_drawn_on: bool) -> None:
        """Set whether the left button draws on the surface, and no longer turns it there."""
        self.is_drawn_on, self._is_stroke = is_drawn_on, False
        self._show_cursor(self._place)

    def set_brush(self, brush: QtGui.QCursor | None) -> None:
        """Set what a drag with the left button paints with from now on; None if it turns the surface again."""
        self.brush = brush
        self._show_cursor(self._place)

    @property
    def _place(self) -> QtCore.QPoint:
        return self.mapFromGlobal(QtGui.QCursor.pos())

    # ------------------------------------------------------------------ mouse
    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        """Decide what the button that goes down holds from here on."""
        self.pressed.emit()
        if not self.is_up:
            return  # another button is down already
        self._button, self._press, self._last, self._is_dragging = event.button(), event.pos(), event.pos(), False
        self._has_clicked = False
        is_plain = event.modifiers() == QtCore.Qt.KeyboardModifier.NoModifier
        is_left = event.button() == QtCore.Qt.MouseButton.LeftButton
        self._is_brushing = is_left and self.brush is not None and not self.is_empty
        if self._is_brushing:
            self._brush_to(event.pos())
            return
        hit = self.pick(event.pos()) if is_left and self.is_drawn_on else None
        self._is_stroke = hit is not None
        if self._is_stroke:
            self.happened.emit(Stroke(hit))
        may_hold = is_left and not self._is_stroke and (is_plain or event.modifiers() == _CTRL)
        self._drop = self.over.points.standing_at(event.pos()) if may_hold else None
        self._grip = self.over.points.tip_of(*self._drop) - event.pos() if self._drop else QtCore.QPoint()
        self._held = self.mark_at(event.pos()) if may_hold and is_plain and not self._drop else -1
        if self._held >= 0 or self._drop:
            self.setCursor(QtCore.Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        """Point, or move what is held."""
        if event.buttons() == _NONE:
            self._button = _NONE
            self.happened.emit(Hover(self.pick(event.pos())))
            self._show_cursor(event.pos())
            return
        if self._is_brushing:
            self._brush_to(event.pos())
            return
        if self._press is not None and not self._is_dragging:
            # A hand that trembles still clicks.
            if (event.pos() - self._press).manhattanLength() < QtWidgets.QApplication.startDragDistance():
                return
            self._is_dragging = True
            self.happened.emit(Hover(None))
        if self._is_stroke:
            self._draw_to(event.pos())
            return
        step, self._last = event.pos() - self._last, event.pos()
        if self._drop or self._held >= 0:
            hit = self.pick(event.pos() + self._grip)
            if hit is not None:
                self.happened.emit(MarkDrag(*(self._drop or ("", self._held)), hit))
        elif not self.is_empty:
            self._drag(step, event.modifiers())

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        """Take a click, or the end of a drag."""
        if event.button() != self._button:
            return
        self._button = _NONE
        press, self._press = self._press, None
        if self._is_brushing:
            self._is_brushing = False
            self.happened.emit(BrushLift())
            self.point_again()
            return
        held, self._held = self._held >= 0, -1
        drop, self._drop = self._drop, None
        is_stroke, self._is_stroke = self._is_stroke, False
        has_ctrl = bool(event.modifiers() & _CTRL)
        if held or drop:
            self.unsetCursor()
        if is_stroke:
            if self._is_dragging and event.pos() != self._last:
                self.happened.emit(Stroke(self.pick(event.pos())))
            self.happened.emit(StrokeEnd(has_ctrl))
        elif self._is_dragging:
            if drop or held:
                self.happened.emit(MarkRelease(drop[0] if drop else ""))
            else:
                self.camera_released.emit()
            self.point_again()
        elif drop:
            self.happened.emit(MarkClick(*drop, has_ctrl))
        elif press is not None and event.button() == QtCore.Qt.MouseButton.RightButton:
            self.happened.emit(MenuWanted(self.pick(press), self.mapToGlobal(press)))
        elif press is not None and event.button() == QtCore.Qt.MouseButton.LeftButton and not held:
            hit = self.pick(press)
            has_shift = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ShiftModifier)
            if hit is not None:
                self._has_clicked = not (has_shift or has_ctrl)
                self.happened.emit(Click(hit, has_shift, has_ctrl))

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        """Centre the view there; what the first click has done is taken back."""
        is_left = event.button() == QtCore.Qt.MouseButton.LeftButton
        hit = self.pick(event.pos()) if is_left and not self.over.points.standing_at(event.pos()) else None
        if hit is not None:
            if self._has_clicked:
                self.happened.emit(SecondClick())
            self.centre(hit.position)
        self._press, self._has_clicked = None, False

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        """Open the menu by the keyboard; that of the mouse comes when its button is let go."""
        if event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard and not self.is_empty:
            middle = self.rect().center()
            self.happened.emit(MenuWanted(self.pick(middle), self.mapToGlobal(middle)))

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        if not self.is_empty and event.angleDelta().y():
            notches = event.angleDelta().y() / 120 * self.wheel_factor
            self.zoom(NOTCH_ZOOM**notches, event.position().toPoint())
        event.accept()

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self.happened.emit(Hover(None))

    def point_again(self) -> None:
        """Emit what is under the pointer now, after the camera or the surface has moved."""
        position = self._place
        if self.is_up and self.underMouse() and self.rect().contains(position):
            self.happened.emit(Hover(self.pick(position)))

    # ------------------------------------------------------------------ what a drag does
    def _show_cursor(self, position: QtCore.QPoint) -> None:
        """Show by the cursor what the left button would do."""
        if self.brush is not None:
            self.setCursor(self.brush)
        elif self.is_drawn_on:
            self.setCursor(QtCore.Qt.CursorShape.CrossCursor)
        elif self.over.points.standing_at(position) or self.mark_at(position) >= 0:
            self.setCursor(QtCore.Qt.CursorShape.OpenHandCursor)
        else:
            self.unsetCursor()

    def _steps_to(self, position: QtCore.QPoint, step_px: int, least: int, most: int) -> list[QtCore.QPoint]:
        """Return places on the way from where the pointer was last, so that a quick hand leaves no gaps."""
        way, start = position - self._last, self._last
        count = min(max(way.manhattanLength() // step_px, least), most)
        if count:
            self._last = position
        return [start + way * step / count for step in range(1, count + 1)]

    def _draw_to(self, position: QtCore.QPoint) -> None:
        for place in self._steps_to(position, STROKE_STEP_PX, 0, MAX_STROKE_STEPS):
            self.happened.emit(Stroke(self.pick(place)))

    def _brush_to(self, position: QtCore.QPoint) -> None:
        for place in self._steps_to(position, BRUSH_STEP_PX, 1, MAX_BRUSH_STEPS):
            if (hit := self.pick(place)) is not None:
                self.happened.emit(BrushTouch(hit, self.pixel_size(hit.position)))

    def _drag(self, step: QtCore.QPoint, modifiers: QtCore.Qt.KeyboardModifier) -> None:
        button = QtCore.Qt.MouseButton
        size = self.width(), self.height()
        if self._button == button.LeftButton and not modifiers & QtCore.Qt.KeyboardModifier.ShiftModifier:
            moves.turn(self.camera, step.x(), -step.y(), size, self.upright)
        elif self._button == button.RightButton:
            about = np.array(self.camera.GetFocalPoint())
            moves.zoom(self.camera, float(np.exp(-4 * step.y() / max(size[1], 1))), about)
        else:
            moves.shift(self.camera, step.x(), -step.y(), size[1])
        self.moved.emit()
