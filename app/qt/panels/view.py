"""The picture of a panel, and what the mouse does in it.  Gestures become signals; it decides nothing.

The surface is drawn off the screen, once for each change; what lies over it is painted by Qt, and costs no drawing.
"""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from ...drawing import moves
from ...drawing.axes import arms, middle
from ...drawing.board import Board
from ...drawing.camera import camera_seen, frame
from ...drawing.lines_of_sight import pixels_in
from ...drawing.picking import Met, Picker, pixel_of
from ...drawing.style import Style
from ..look.look import LOOK
from . import overlay
from .extremum_marks import ExtremumMarks
from .overlay import Pointed
from .path_marks import PathMarks
from .pin_marks import PinMark, paint_pins

MARK_SLACK = 4.0
"""Pixels beside a mark of the source at which it can still be taken hold of."""

MOST_HELD = 300
"""Marks up to which each can be taken hold of."""

STROKE_STEP = 5
"""Pixels from one point of what is drawn to the next."""

NOTCH = 1.1
"""By how much a notch of the wheel enlarges."""

DIMMED = 0.28
"""How opaque a field is that is no longer the answer."""

DAB = 4.0
"""Pixels across of a vertex that a brush touches."""

BRUSH_STEP, MOST_BRUSHED = 6, 24
"""Pixels between two places that a brush touches, and how many at most for one movement of the pointer."""

KEY_TURN, KEY_SHIFT = 15.0, 0.05
"""Degrees, and shares of the view's height, for a key."""


class View(QtWidgets.QWidget):
    """A scene on the screen."""

    pressed = QtCore.Signal()  # any button
    clicked = QtCore.Signal(object)  # a `Met`, clicked without dragging
    pinned = QtCore.Signal(object)  # the same with Shift
    added = QtCore.Signal(object)  # the same with Ctrl
    dragged = QtCore.Signal(int, object)  # a mark of the source by its number, over a `Met`
    released = QtCore.Signal()  # the mark
    stroked = QtCore.Signal(object)  # over a `Met`, while the surface is drawn on
    stroke_ended = QtCore.Signal(bool)  # the button is up; whether with Ctrl
    let_go = QtCore.Signal()  # the button that has moved the camera
    hovered = QtCore.Signal(object)  # a `Met`, or None beside the surface
    moved = QtCore.Signal()  # the camera
    resized = QtCore.Signal()
    menu_wanted = QtCore.Signal(object, object)  # a `Met` or None, and where on the screen
    centred = QtCore.Signal(object)  # double click on a `Met`
    brushed = QtCore.Signal(object, float)  # a `Met`, and how long a pixel is there
    brush_lifted = QtCore.Signal()
    drawn = QtCore.Signal()  # another picture
    shot_wanted = QtCore.Signal()  # what is written on the picture is needed now

    def __init__(self, board: Board, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._board = board
        self.scene = board.new_scene(scale=self.devicePixelRatioF())
        self.picker: Picker | None = None
        self.handles = np.empty((0, 3))  # where the source's marks are
        self.is_drawn_on = False  # whether the left button draws
        self.stroke: np.ndarray | None = None  # (k, 3) what has been drawn
        self.wheel_factor = 1.0  # -1 for a wheel that goes the other way
        self.upright: np.ndarray | None = None  # what stays upright while the surface turns
        self._picture: QtGui.QImage | None = None
        self._drawing = np.empty((0, 0, 4), np.uint8)
        self._written: np.ndarray | None = None
        self.pictures = 0  # how many have been drawn
        self._is_stale = True
        self._is_empty = True
        self._is_dimmed = False
        self.sentence = ""
        self._has_axes = False
        self.extrema = ExtremumMarks(self)
        self._pointed: Pointed | None = None
        self.path = PathMarks()
        self._pins: tuple[PinMark, ...] = ()
        self._unseen: frozenset[int] | None = None  # which pins the surface hides; None until it is looked
        self._covered = QtCore.QRect()
        self._press: QtCore.QPoint | None = None
        self._last = QtCore.QPoint()
        self._button = QtCore.Qt.MouseButton.NoButton
        self._dragging = self._is_stroke = False
        self._held = -1  # which mark
        self._dabs: list[tuple[str, QtGui.QPolygonF]] = []  # of a brush that is down
        self.brush: QtGui.QCursor | None = None  # what drags paint with, instead of turning
        self._is_brushing = False
        self.setMouseTracking(True)
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumSize(1, 1)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Ignored)
        LOOK.changed.connect(self.update)

    # ------------------------------------------------------------------ what is seen
    @property
    def renderer(self) -> vtkRenderer:
        self._board.fit(self.pixels)
        return self.scene.renderer

    @property
    def camera(self) -> vtkCamera:
        return self.scene.renderer.GetActiveCamera()

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height in device pixels."""
        ratio = self.devicePixelRatioF()
        return max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1)

    @property
    def is_empty(self) -> bool:
        return self._is_empty

    def show_style(self, style: Style) -> bool:
        """Look like this from now on; whether that is another look, so that all has to be shown again."""
        ratio = self.devicePixelRatioF()
        if (style, ratio) == (self.scene.style, self.scene.scale):
            return False
        camera = self.camera
        self._board.remove(self.scene)
        self.scene = self._board.new_scene(style, ratio)
        self.scene.renderer.SetActiveCamera(camera)
        self.redraw()
        return True

    def show_empty(self, is_empty: bool) -> None:
        """Whether there is no surface: then nothing is drawn."""
        self._is_empty, self._picture, self._pointed = is_empty, None, None
        self.redraw()

    def redraw(self) -> None:
        """The surface, its field, its marks or the camera have changed: draw once, when Qt paints next."""
        self._is_stale = True
        self.update()

    def dim(self, is_dimmed: bool) -> None:
        """Let a field that is no longer the answer stand back."""
        if is_dimmed != self._is_dimmed:
            self._is_dimmed = is_dimmed
            self.update()

    def say(self, sentence: str) -> None:
        """In the middle of the view: why there is no field; "" for nothing."""
        if sentence != self.sentence:
            self.sentence = sentence
            self.update()

    def show_axes(self, has_axes: bool) -> None:
        """Whether a cross in a corner says where x, y and z point to."""
        if has_axes != self._has_axes:
            self._has_axes = has_axes
            self.update()

    def point_at(self, pointed: Pointed | None) -> None:
        """Put the ring somewhere; the surface is not drawn for it."""
        self._pointed = pointed
        before, self._covered = self._covered, self._cover()
        self.update(before | self._covered)

    def show_pins(self, pins: tuple[PinMark, ...]) -> None:
        """Put drops at these places; the surface is not drawn for them."""
        if pins != self._pins:
            self._pins, self._unseen = pins, None
            self.update()

    def show_stroke(self, stroke: np.ndarray | None) -> None:
        """What has been drawn so far, points (k, 3); the surface is not drawn for it."""
        self.stroke = stroke
        self.update()

    # ------------------------------------------------------------------ painting
    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        ground = QtGui.QColor(LOOK.theme.canvas)
        if self._is_empty:
            painter.fillRect(event.rect(), ground)
            return
        picture = self._drawn()
        if self._is_dimmed:
            painter.fillRect(event.rect(), ground)
            painter.setOpacity(DIMMED)
        painter.drawImage(QtCore.QPointF(0, 0), picture)
        painter.setOpacity(1.0)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        self.path.paint(painter, self.devicePixelRatioF())
        for colour, places in self._dabs:
            painter.setPen(QtGui.QPen(QtGui.QColor(colour), DAB))
            painter.drawPoints(places)
        self.extrema.paint(painter)
        if self._has_axes:
            at = middle(self.width(), self.height(), self.scene.insets.corners)
            overlay.paint_axes(painter, arms(frame(camera_seen(self.camera, 1.0))), at)
        if self._pins:
            paint_pins(painter, self._seen_pins(), self._hidden_pins())
        if self.sentence:
            overlay.paint_sentence(painter, self.rect(), self.sentence)
        if self.stroke is not None and len(self.stroke):
            style = self.scene.style
            overlay.paint_stroke(painter, [self.place_of(x) for x in self.stroke], style.source, style.mark_edge)
        if self._pointed is not None:
            at = self.place_of(self._pointed.position)
            overlay.paint_ring(painter, at, self._pointed.is_own, self._pointed.is_hidden)
            if self._pointed.value:
                value, share = self._pointed.value, self._pointed.share
                place = overlay.label_place(at, value, share, QtCore.QRectF(self.rect()))
                overlay.paint_label(painter, place, value, share)

    def _seen_pins(self) -> dict[int, tuple[PinMark, QtCore.QPointF]]:
        """By their numbers: the pins with their places, but for those that an inset covers."""
        found, renderer = {}, self.renderer
        for pin in self._pins:
            x, y = pixel_of(renderer, pin.position)
            if self.scene.insets.renderer_at(x, y) is renderer:
                ratio = self.devicePixelRatioF()
                found[pin.number] = (pin, QtCore.QPointF(x / ratio, self.height() - y / ratio))
        return found

    def _hidden_pins(self) -> frozenset[int]:
        """The numbers of those that the surface is before."""
        if self._unseen is None:
            self._unseen = frozenset(pin.number for pin in self._pins if not self.sees(pin.position))
        return self._unseen

    def _drawn(self) -> QtGui.QImage:
        """The picture, drawn if something has changed since."""
        width, height = self.pixels
        size = QtCore.QSize(width, height)
        if self._is_stale or self._picture is None or self._picture.size() != size:
            self._drawing, self._written = self._board.picture(self.scene, (width, height)), None
            self._picture = self._image(self._drawing)
            self._is_stale, self._unseen = False, None
            self.path.see(self.scene, self._board)
            self._covered = self._cover()
            self.pictures += 1
            self.drawn.emit()
        return self._picture

    def _image(self, pixels: np.ndarray) -> QtGui.QImage:
        """In the memory of pixels (h, w, 4), which have to be kept."""
        height, width, _ = pixels.shape
        image = QtGui.QImage(pixels.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBX8888)
        image.setDevicePixelRatio(self.devicePixelRatioF())
        return image

    @property
    def picture(self) -> np.ndarray | None:
        """(h, w, 4) uint8: the surface as it is seen now; None before it is drawn again."""
        return None if self._is_stale or self._is_empty or self._picture is None else self._drawing

    def write(self, pixels: np.ndarray) -> None:
        """The picture (h, w, 4) with what is written on it, until the next one is drawn."""
        self._written, self._picture = pixels, self._image(pixels)
        self.update()

    def draw_in_full(self) -> None:
        """Draw the surface again where something has stood in for it."""
        if self.scene.is_stand_in:
            self.scene.show_stand_in(False)
            self.redraw()

    def shot(self) -> np.ndarray:
        """(height, width, 3) uint8: the surface and what is written on it, without what lies over it."""
        self.draw_in_full()
        self._drawn()
        self.shot_wanted.emit()
        return (self._drawing if self._written is None else self._written)[..., :3].copy()

    def _cover(self) -> QtCore.QRect:
        """What the ring and its label take."""
        if self._pointed is None:
            return QtCore.QRect()
        at = self.place_of(self._pointed.position)
        found = QtCore.QRectF(at.x() - overlay.REACH, at.y() - overlay.REACH, 2 * overlay.REACH, 2 * overlay.REACH)
        if self._pointed.value:
            view = QtCore.QRectF(self.rect())
            found |= overlay.label_place(at, self._pointed.value, self._pointed.share, view)
        return found.toAlignedRect().adjusted(-2, -2, 2, 2)

    # ------------------------------------------------------------------ places
    def place_of(self, point: np.ndarray) -> QtCore.QPointF:
        """Where a point (3,) is seen, in logical pixels."""
        x, y = pixel_of(self.renderer, point)
        ratio = self.devicePixelRatioF()
        return QtCore.QPointF(x / ratio, self.height() - y / ratio)

    def met_at(self, position: QtCore.QPoint) -> Met | None:
        """Where the surface is met under a point of the view."""
        if self.picker is None or self._is_empty:
            return None
        pixel = self._pixel(position)
        self._board.fit(self.pixels)
        return self.picker.met_at(self.scene.insets.renderer_at(*pixel), *pixel)

    def sees(self, point: np.ndarray) -> bool:
        """Whether no part of the surface is before a point (3,) of it."""
        return self.picker is None or self.picker.sees(self.renderer, point)

    def _pixel(self, position: QtCore.QPoint) -> tuple[float, float]:
        """Device pixels, y up."""
        ratio = self.devicePixelRatioF()
        return (position.x() + 0.5) * ratio, (self.height() - position.y() - 0.5) * ratio

    @property
    def source(self) -> np.ndarray | None:
        """(3,) where its first mark is."""
        return self.handles[0] if len(self.handles) else None

    def mark_at(self, position: QtCore.QPoint) -> int:
        """The number of the source's mark that is seen under a point of the view; -1 for none."""
        if not 0 < len(self.handles) <= MOST_HELD or self.picker is None or self._is_empty:
            return -1
        x, y = self._pixel(position)
        renderer = self.renderer
        if self.scene.insets.renderer_at(x, y) is not renderer:
            return -1
        at = np.array([pixel_of(renderer, handle) for handle in self.handles])
        away = np.hypot(x - at[:, 0], y - at[:, 1])
        nearest = int(away.argmin())
        reach = (self.scene.style.marker_size / 2 + MARK_SLACK) * self.devicePixelRatioF()
        return nearest if away[nearest] <= reach and self.sees(self.handles[nearest]) else -1

    # ------------------------------------------------------------------ the mouse
    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.pressed.emit()
        if self._button != QtCore.Qt.MouseButton.NoButton:
            return  # another button is down already
        self._button, self._press, self._last, self._dragging = event.button(), event.pos(), event.pos(), False
        is_plain = event.modifiers() == QtCore.Qt.KeyboardModifier.NoModifier
        is_left = event.button() == QtCore.Qt.MouseButton.LeftButton
        self._is_brushing = is_left and self.brush is not None and not self._is_empty
        if self._is_brushing:
            self._brush_to(event.pos())
            return
        self._is_stroke = is_left and self.is_drawn_on and self._draw(event.pos())
        self._held = self.mark_at(event.pos()) if is_left and is_plain and not self._is_stroke else -1
        if self._held >= 0:
            self.setCursor(QtCore.Qt.CursorShape.ClosedHandCursor)

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.buttons() == QtCore.Qt.MouseButton.NoButton:
            self._button = QtCore.Qt.MouseButton.NoButton
            self.hovered.emit(self.met_at(event.pos()))
            self._show_cursor(event.pos())
            return
        if self._is_brushing:
            self._brush_to(event.pos())
            return
        if self._press is not None and not self._dragging:
            # A hand that trembles still clicks.
            if (event.pos() - self._press).manhattanLength() < QtWidgets.QApplication.startDragDistance():
                return
            self._dragging = True
            self.hovered.emit(None)
        if self._is_stroke:
            if (event.pos() - self._last).manhattanLength() >= STROKE_STEP and self._draw(event.pos()):
                self._last = event.pos()
            return
        step, self._last = event.pos() - self._last, event.pos()
        if self._held >= 0:
            met = self.met_at(event.pos())
            if met is not None:
                self.dragged.emit(self._held, met)
        elif not self._is_empty:
            self._drag(step, event.modifiers())

    def _draw(self, position: QtCore.QPoint) -> bool:
        """Go on drawing at a point of the view; whether the surface is there."""
        met = self.met_at(position)
        if met is not None:
            self.stroked.emit(met)
        return met is not None

    def _show_cursor(self, position: QtCore.QPoint) -> None:
        """What the left button would do."""
        if self.brush is not None:
            self.setCursor(self.brush)
        elif self.is_drawn_on:
            self.setCursor(QtCore.Qt.CursorShape.CrossCursor)
        elif self.mark_at(position) >= 0:
            self.setCursor(QtCore.Qt.CursorShape.OpenHandCursor)
        else:
            self.unsetCursor()

    def draw_on(self, is_drawn_on: bool) -> None:
        """Whether the left button draws on the surface, and no longer turns it there."""
        self.is_drawn_on, self._is_stroke = is_drawn_on, False
        self._show_cursor(self.mapFromGlobal(QtGui.QCursor.pos()))

    def _drag(self, step: QtCore.QPoint, modifiers: QtCore.Qt.KeyboardModifiers) -> None:
        button, shift = QtCore.Qt.MouseButton, QtCore.Qt.KeyboardModifier.ShiftModifier
        if self._button == button.LeftButton and not modifiers & shift:
            moves.turn(self.camera, step.x(), -step.y(), (self.width(), self.height()), self.upright)
        elif self._button == button.RightButton:
            moves.zoom(self.camera, float(np.exp(-4 * step.y() / max(self.height(), 1))), self._focal_point())
        else:
            moves.shift(self.camera, step.x(), -step.y(), self.height())
        self.moved.emit()

    def set_brush(self, brush: QtGui.QCursor | None) -> None:
        """What a drag with the left button paints with from now on; None if it turns the surface again."""
        self.brush = brush
        self._show_cursor(self.mapFromGlobal(QtGui.QCursor.pos()))

    def show_dabs(self, points: np.ndarray | None, colour: str = "") -> None:
        """More vertices (k, 3) that a brush has touched, over the picture as long as the brush is down; None for none.

        The surface is not drawn for them.
        """
        if points is None:
            self._dabs.clear()
        else:
            at = pixels_in(self.scene.renderer, points, *self.pixels) / self.devicePixelRatioF()
            self._dabs.append((colour, QtGui.QPolygonF([QtCore.QPointF(*place) for place in at.tolist()])))
        self.update()

    def _brush_to(self, position: QtCore.QPoint) -> None:
        """Along the way from where it was last: a quick hand leaves no gaps."""
        way, start = position - self._last, self._last
        self._last = position
        steps = min(max(way.manhattanLength() // BRUSH_STEP, 1), MOST_BRUSHED)
        for step in range(1, steps + 1):
            met = self.met_at(start + way * step / steps)
            if met is not None:
                self.brushed.emit(met, self._pixel_size(met.position))

    def _pixel_size(self, point: np.ndarray) -> float:
        """How long a logical pixel is at a point (3,)."""
        camera = self.camera
        if camera.GetParallelProjection():
            return float(2 * camera.GetParallelScale() / max(self.height(), 1))
        depth = (point - np.array(camera.GetPosition())) @ np.array(camera.GetDirectionOfProjection())
        return float(2 * depth * np.tan(np.radians(camera.GetViewAngle()) / 2) / max(self.height(), 1))

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() != self._button:
            return
        self._button = QtCore.Qt.MouseButton.NoButton
        press, self._press = self._press, None
        if self._is_brushing:
            self._is_brushing = False
            self.brush_lifted.emit()
            self.point_again()
            return
        held, self._held = self._held >= 0, -1
        is_stroke, self._is_stroke = self._is_stroke, False
        has_ctrl = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ControlModifier)
        if held:
            self.unsetCursor()
        if is_stroke:
            self._draw(event.pos()) if self._dragging else None
            self.stroke_ended.emit(has_ctrl)
        elif self._dragging:
            if held:
                self.released.emit()
            else:
                self.let_go.emit()
            self.point_again()
        elif press is not None and event.button() == QtCore.Qt.MouseButton.RightButton:
            self.menu_wanted.emit(self.met_at(press), self.mapToGlobal(press))
        elif press is not None and event.button() == QtCore.Qt.MouseButton.LeftButton and not held:
            met = self.met_at(press)
            has_shift = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ShiftModifier)
            if met is not None:
                (self.pinned if has_shift else self.added if has_ctrl else self.clicked).emit(met)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        """The first click has moved the source there."""
        if event.button() == QtCore.Qt.MouseButton.LeftButton:
            met = self.met_at(event.pos())
            if met is not None:
                self.centred.emit(met)
        self._press = None

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        """By the keyboard; that of the mouse comes when its button is let go."""
        if event.reason() == QtGui.QContextMenuEvent.Reason.Keyboard and not self._is_empty:
            middle = self.rect().center()
            self.menu_wanted.emit(self.met_at(middle), self.mapToGlobal(middle))

    def wheelEvent(self, event: QtGui.QWheelEvent) -> None:
        if not self._is_empty and event.angleDelta().y():
            notches = event.angleDelta().y() / 120 * self.wheel_factor
            self.zoom(NOTCH**notches, event.position().toPoint())
        event.accept()

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self.hovered.emit(None)

    def point_again(self) -> None:
        """What is under the pointer now, after the camera or the surface has moved."""
        position = self.mapFromGlobal(QtGui.QCursor.pos())
        if self._button == QtCore.Qt.MouseButton.NoButton and self.underMouse() and self.rect().contains(position):
            self.hovered.emit(self.met_at(position))

    # ------------------------------------------------------------------ the camera
    def zoom(self, factor: float, position: QtCore.QPoint | None = None) -> None:
        """Nearer by a factor, about what is under a point of the view; about the middle if none is given."""
        about = self._focal_point()
        if position is not None:
            met = self.met_at(position)
            about = moves.at_focal_depth(self.renderer, *self._pixel(position)) if met is None else met.position
        moves.zoom(self.camera, factor, about)
        self.moved.emit()

    def turn_by(self, right: int, up: int) -> None:
        """A step by the keyboard: the surface turns as if it was dragged."""
        step = KEY_TURN / moves.TURN
        moves.turn(self.camera, right * step, up * step, (1, 1), self.upright)
        self.moved.emit()

    def shift_by(self, right: int, up: int) -> None:
        """The same sideways."""
        moves.shift(self.camera, right * KEY_SHIFT, up * KEY_SHIFT, 1)
        self.moved.emit()

    def centre(self, point: np.ndarray) -> None:
        """Let a point (3,) be in the middle, and what is turned about."""
        moves.centre(self.camera, point)
        self.moved.emit()

    def _focal_point(self) -> np.ndarray:
        return np.array(self.camera.GetFocalPoint())

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._is_stale = True
        self.resized.emit()
