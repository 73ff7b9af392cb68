"""What the mouse does in a view: it turns, holds a mark of the source, a pin or a pair, draws or paints;
each becomes an event."""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from ...scene import moves
from .events import BrushLift, BrushTouch, Click, Hover, MarkClick, MarkDrag, MarkRelease, MenuWanted, Stroke, StrokeEnd
from .marks_over import MarksOver
from .view import View

STROKE_STEP = 5
"""Pixels from one point of what is drawn to the next."""
MOST_DRAWN = 200
"""Points for one movement of the pointer."""

BRUSH_STEP, MOST_BRUSHED = 6, 24
"""Pixels between two places that a brush touches, and how many at most for one movement of the pointer."""

_CTRL = QtCore.Qt.KeyboardModifier.ControlModifier
_NONE = QtCore.Qt.MouseButton.NoButton


class Pointer:
    """view: the one whose events it emits.  One button counts: the first that went down."""

    def __init__(self, view: View, over: MarksOver) -> None:
        self._view, self._over = view, over
        self.is_drawn_on = False  # whether the left button draws
        self.brush: QtGui.QCursor | None = None  # what drags paint with, instead of turning
        self._button = _NONE
        self._press: QtCore.QPoint | None = None
        self._last = QtCore.QPoint()
        self._is_dragging = self._is_stroke = self._is_brushing = False
        self._held = -1  # which mark
        self._drop: tuple[str, int] | None = None  # the pin or pair that is held, by its number
        self._grip = QtCore.QPoint()  # and from where to its tip

    @property
    def is_up(self) -> bool:
        """Whether no button is down."""
        return bool(self._button == _NONE)

    def draw_on(self, is_drawn_on: bool) -> None:
        """Whether the left button draws on the surface, and no longer turns it there."""
        self.is_drawn_on, self._is_stroke = is_drawn_on, False
        self._show_cursor(self._place)

    def set_brush(self, brush: QtGui.QCursor | None) -> None:
        """What a drag with the left button paints with from now on; None if it turns the surface again."""
        self.brush = brush
        self._show_cursor(self._place)

    @property
    def _place(self) -> QtCore.QPoint:
        return self._view.mapFromGlobal(QtGui.QCursor.pos())

    # ------------------------------------------------------------------ what Qt tells
    def press(self, event: QtGui.QMouseEvent) -> None:
        """A button goes down: what it holds from here on is decided."""
        view = self._view
        view.pressed.emit()
        if not self.is_up:
            return  # another button is down already
        self._button, self._press, self._last, self._is_dragging = event.button(), event.pos(), event.pos(), False
        is_plain = event.modifiers() == QtCore.Qt.KeyboardModifier.NoModifier
        is_left = event.button() == QtCore.Qt.MouseButton.LeftButton
        self._is_brushing = is_left and self.brush is not None and not view.is_empty
        if self._is_brushing:
            self._brush_to(event.pos())
            return
        hit = view.pick(event.pos()) if is_left and self.is_drawn_on else None
        self._is_stroke = hit is not None
        if self._is_stroke:
            view.happened.emit(Stroke(hit))
        may_hold = is_left and not self._is_stroke and (is_plain or event.modifiers() == _CTRL)
        self._drop = self._over.points.standing_at(event.pos()) if may_hold else None
        self._grip = self._over.points.tip_of(*self._drop) - event.pos() if self._drop else QtCore.QPoint()
        self._held = view.mark_at(event.pos()) if may_hold and is_plain and not self._drop else -1
        if self._held >= 0 or self._drop:
            view.setCursor(QtCore.Qt.CursorShape.ClosedHandCursor)

    def move(self, event: QtGui.QMouseEvent) -> None:
        """The pointer moves: it points, or what is held follows."""
        view = self._view
        if event.buttons() == _NONE:
            self._button = _NONE
            view.happened.emit(Hover(view.pick(event.pos())))
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
            view.happened.emit(Hover(None))
        if self._is_stroke:
            self._draw_to(event.pos())
            return
        step, self._last = event.pos() - self._last, event.pos()
        if self._drop or self._held >= 0:
            hit = view.pick(event.pos() + self._grip)
            if hit is not None:
                view.happened.emit(MarkDrag(*(self._drop or ("", self._held)), hit))
        elif not view.is_empty:
            self._drag(step, event.modifiers())

    def release(self, event: QtGui.QMouseEvent) -> None:
        """The button comes up: a click, or the end of a drag."""
        view = self._view
        if event.button() != self._button:
            return
        self._button = _NONE
        press, self._press = self._press, None
        if self._is_brushing:
            self._is_brushing = False
            view.happened.emit(BrushLift())
            self.point_again()
            return
        held, self._held = self._held >= 0, -1
        drop, self._drop = self._drop, None
        is_stroke, self._is_stroke = self._is_stroke, False
        has_ctrl = bool(event.modifiers() & _CTRL)
        if held or drop:
            view.unsetCursor()
        if is_stroke:
            if self._is_dragging and event.pos() != self._last:
                view.happened.emit(Stroke(view.pick(event.pos())))
            view.happened.emit(StrokeEnd(has_ctrl))
        elif self._is_dragging:
            if drop or held:
                view.happened.emit(MarkRelease(drop[0] if drop else ""))
            else:
                view.let_go.emit()
            self.point_again()
        elif drop:
            view.happened.emit(MarkClick(*drop, has_ctrl))
        elif press is not None and event.button() == QtCore.Qt.MouseButton.RightButton:
            view.happened.emit(MenuWanted(view.pick(press), view.mapToGlobal(press)))
        elif press is not None and event.button() == QtCore.Qt.MouseButton.LeftButton and not held:
            hit = view.pick(press)
            has_shift = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ShiftModifier)
            if hit is not None:
                view.happened.emit(Click(hit, has_shift, has_ctrl))

    def double_click(self, event: QtGui.QMouseEvent) -> None:
        """The first click has moved the source there, or has chosen a pin."""
        is_left = event.button() == QtCore.Qt.MouseButton.LeftButton
        hit = self._view.pick(event.pos()) if is_left and not self._over.points.standing_at(event.pos()) else None
        if hit is not None:
            self._view.centre(hit.position)
        self._press = None

    def point_again(self) -> None:
        """What is under the pointer now, after the camera or the surface has moved."""
        view, position = self._view, self._place
        if self.is_up and view.underMouse() and view.rect().contains(position):
            view.happened.emit(Hover(view.pick(position)))

    # ------------------------------------------------------------------ what it does
    def _show_cursor(self, position: QtCore.QPoint) -> None:
        """What the left button would do."""
        if self.brush is not None:
            self._view.setCursor(self.brush)
        elif self.is_drawn_on:
            self._view.setCursor(QtCore.Qt.CursorShape.CrossCursor)
        elif self._over.points.standing_at(position) or self._view.mark_at(position) >= 0:
            self._view.setCursor(QtCore.Qt.CursorShape.OpenHandCursor)
        else:
            self._view.unsetCursor()

    def _draw_to(self, position: QtCore.QPoint) -> None:
        """Go on drawing along the way from where it was last: a quick hand draws what it is seen to draw."""
        way, start = position - self._last, self._last
        steps = min(way.manhattanLength() // STROKE_STEP, MOST_DRAWN)
        for step in range(1, steps + 1):
            self._view.happened.emit(Stroke(self._view.pick(start + way * step / steps)))
            self._last = position

    def _brush_to(self, position: QtCore.QPoint) -> None:
        """Along the way from where it was last: a quick hand leaves no gaps."""
        view = self._view
        way, start = position - self._last, self._last
        self._last = position
        steps = min(max(way.manhattanLength() // BRUSH_STEP, 1), MOST_BRUSHED)
        for step in range(1, steps + 1):
            hit = view.pick(start + way * step / steps)
            if hit is not None:
                view.happened.emit(BrushTouch(hit, view.pixel_size(hit.position)))

    def _drag(self, step: QtCore.QPoint, modifiers: QtCore.Qt.KeyboardModifier) -> None:
        view, button = self._view, QtCore.Qt.MouseButton
        size = view.width(), view.height()
        if self._button == button.LeftButton and not modifiers & QtCore.Qt.KeyboardModifier.ShiftModifier:
            moves.turn(view.camera, step.x(), -step.y(), size, view.upright)
        elif self._button == button.RightButton:
            about = np.array(view.camera.GetFocalPoint())
            moves.zoom(view.camera, float(np.exp(-4 * step.y() / max(size[1], 1))), about)
        else:
            moves.shift(view.camera, step.x(), -step.y(), size[1])
        view.moved.emit()
