"""The picture of a panel: a surface that is drawn off the screen, once for each change, and where places are in it."""

from collections.abc import Iterator

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from bihdist_core.arrays import AnyArray, FloatArray

from ...scene import moves
from ...scene.clipping import ClipPlane
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.panel_scene import proportion
from ...scene.picking import Hit, Picker, pixel_of
from ...scene.style import Style
from ..look.look import LOOK

MARK_SLACK = 4.0
"""Pixels beside a mark of the source at which it can still be taken hold of."""

MOST_HELD = 300
"""Marks up to which each can be taken hold of."""

AT_ONCE = 0.15
"""Seconds that views are drawn for one after the other before keys and clicks are looked at."""

DIMMED = 0.28
"""How opaque a field is that is no longer the answer."""

NO_PIXELS = np.empty((0, 0, 4), np.uint8)

KEY_TURN, KEY_SHIFT = 15.0, 0.05
"""Degrees, and shares of the view's height, for a key."""


class View(QtWidgets.QWidget):
    """A scene on the screen.  What lies over it, and what the mouse does, is `PanelView`'s."""

    pressed = QtCore.Signal()  # any button
    happened = QtCore.Signal(object)  # one of `events`
    camera_released = QtCore.Signal()  # the button that has moved the camera
    moved = QtCore.Signal()  # the camera
    resized = QtCore.Signal()
    drawn = QtCore.Signal()  # another picture
    shot_wanted = QtCore.Signal()  # what is written on the picture is needed now

    def __init__(self, offscreen: OffscreenRenderer, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.offscreen = offscreen
        self.plotter = offscreen.new_plotter(self.redraw)
        self.scene = offscreen.new_scene(scale=self.devicePixelRatioF(), plotter=self.plotter)
        self.picker: Picker | None = None
        self.handles = np.empty((0, 3))  # where the source's marks are
        self.upright: FloatArray | None = None  # what stays upright while the surface turns
        self._picture: QtGui.QImage | None = None
        self._drawing = NO_PIXELS
        self._written: AnyArray | None = None
        self.pictures = 0  # how many have been drawn
        self._is_stale, self.is_empty, self._is_dimmed = True, True, False
        self.setMouseTracking(True)
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setMinimumSize(1, 1)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Ignored, QtWidgets.QSizePolicy.Policy.Ignored)
        LOOK.changed.connect(self.update)

    # ------------------------------------------------------------------ what is seen
    @property
    def renderer(self) -> vtkRenderer:
        """The renderer of the view's scene, as large as the view."""
        self.offscreen.fit(self.pixels)
        return self.scene.renderer

    @property
    def camera(self) -> vtkCamera:
        """The camera of the view's scene."""
        return self.scene.renderer.GetActiveCamera()

    @property
    def clip(self) -> ClipPlane | None:
        """The plane beyond which the surface is cut away."""
        return self.scene.field_actor.clip

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height in device pixels."""
        ratio = self.devicePixelRatioF()
        return max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1)

    @property
    def proportion(self) -> float:
        """The share of their usual size that lines and marks have here."""
        return proportion(self.width(), self.height())

    @property
    def is_stale(self) -> bool:
        """True if the view is on the screen and has not been drawn as it is now."""
        return self._is_stale and not self.is_empty and not self.visibleRegion().isEmpty()

    def show_style(self, style: Style) -> bool:
        """Take a style; return whether it is another one, so that everything has to be shown again."""
        ratio = self.devicePixelRatioF()
        if (style, ratio) == (self.scene.style, self.scene.scale):
            return False
        self.offscreen.remove(self.scene)
        self.scene = self.offscreen.new_scene(style, ratio, self.plotter)
        self.redraw()
        return True

    def show_empty(self, is_empty: bool) -> None:
        """Set whether there is no surface: then nothing is drawn."""
        self.is_empty = is_empty
        self.redraw()

    def forget_picture(self) -> None:
        """Drop the picture: it shows another surface than the one that is drawn next."""
        self._picture, self._drawing, self._written = None, NO_PIXELS, None

    def redraw(self) -> None:
        """Draw once more when Qt paints next, as the surface, its field, its marks or the camera have changed."""
        self._is_stale = True
        self.update()

    def dim(self, is_dimmed: bool) -> None:
        """Let a field that is no longer the answer stand back."""
        if is_dimmed != self._is_dimmed:
            self._is_dimmed = is_dimmed
            self.update()

    # ------------------------------------------------------------------ painting
    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        # At a fractional scale the picture may end a pixel before the view does.
        painter.fillRect(event.rect(), QtGui.QColor(LOOK.theme.canvas))
        if self.is_empty:
            return
        waits = self._waits()
        picture = self._picture if waits else self._drawn()
        if self._is_dimmed:
            painter.setOpacity(DIMMED)
        if waits and picture is not None:
            painter.drawImage(self.rect(), picture)  # which may be of another size
        elif picture is not None:
            painter.drawImage(QtCore.QPointF(0, 0), picture)
        painter.setOpacity(1.0)
        self.paint_over(painter)

    def paint_over(self, painter: QtGui.QPainter) -> None:
        """Paint what lies over the picture."""

    def update_hidden(self) -> None:
        """Update which places are hidden, after another picture has been drawn."""

    def _waits(self) -> bool:
        """Return whether keys and clicks come first: other views have taken long, and what is painted is as it was."""
        waits = self._is_old() and self.offscreen.seconds > AT_ONCE
        if waits:
            QtCore.QTimer.singleShot(0, self.update)
        return waits

    def _is_old(self) -> bool:
        return self._is_stale or self._picture is None or self._picture.size() != QtCore.QSize(*self.pixels)

    def _drawn(self) -> QtGui.QImage:
        """Return the picture, drawn if something has changed since."""
        width, height = self.pixels
        if self._is_old() or self._picture is None:
            QtCore.QTimer.singleShot(0, self.offscreen.begin)
            self.scene.set_proportion(self.proportion)
            self._drawing, self._written = self.offscreen.picture(self.scene, (width, height)), None
            self._picture = self._image(self._drawing)
            self._is_stale = False
            self.update_hidden()
            self.pictures += 1
            self.drawn.emit()
        return self._picture

    def _image(self, pixels: AnyArray) -> QtGui.QImage:
        """Return an image in the memory of pixels (h, w, 4), which have to be kept."""
        height, width, _ = pixels.shape
        image = QtGui.QImage(pixels.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBX8888)
        image.setDevicePixelRatio(self.devicePixelRatioF())
        return image

    @property
    def picture(self) -> AnyArray | None:
        """The surface as it is seen now, (h, w, 4) uint8; None before it is drawn again."""
        return None if self._is_stale or self.is_empty or self._picture is None else self._drawing

    def write(self, pixels: AnyArray) -> None:
        """Show the picture (h, w, 4) with what is written on it, until the next one is drawn."""
        self._written, self._picture = pixels, self._image(pixels)
        self.update()

    def draw_in_full(self) -> None:
        """Draw the surface again where something has stood in for it."""
        if self.scene.field_actor.stand_in.is_shown:
            self.scene.field_actor.show_stand_in(False)
            self.redraw()

    def shot(self) -> AnyArray:
        """Return the surface and what is written on it (h, w, 3) uint8, without what lies over it."""
        self.draw_in_full()
        self._drawn()
        self.shot_wanted.emit()
        return (self._drawing if self._written is None else self._written)[..., :3].copy()

    # ------------------------------------------------------------------ places
    def parts(self) -> Iterator[tuple[vtkRenderer, QtGui.QRegion, tuple[int, int, int, int]]]:
        """Yield the view without its insets, and each of these: the renderer, its region, and its box in device pixels.

        The box is (left, top, width, height), for the view itself all of its picture.
        """
        (width, height), ratio = self.pixels, self.devicePixelRatioF()
        placed = self.scene.insets.placed.items()
        boxes = {each: (left, height - bottom - high, wide, high) for each, (left, bottom, wide, high) in placed}
        regions = {
            each: QtGui.QRegion(QtCore.QRectF(*(side / ratio for side in box)).toAlignedRect())
            for each, box in boxes.items()
        }
        everywhere = QtGui.QRegion(self.rect())
        for region in regions.values():
            everywhere -= region
        yield self.renderer, everywhere, (0, 0, width, height)
        for each, box in boxes.items():
            yield each, regions[each], box

    def place_of(self, point: FloatArray, renderer: vtkRenderer | None = None) -> QtCore.QPointF:
        """Return the position of a point (3,) in logical pixels; in an inset, if its renderer is given."""
        x, y = pixel_of(renderer or self.renderer, point)
        ratio = self.devicePixelRatioF()
        return QtCore.QPointF(x / ratio, self.height() - y / ratio)

    def pick(self, position: QtCore.QPoint) -> Hit | None:
        """Return the hit on the surface under a point of the view."""
        if self.picker is None or self.is_empty:
            return None
        pixel = self._pixel(position)
        self.offscreen.fit(self.pixels)
        return self.picker.pick(self.scene.insets.renderer_at(*pixel), *pixel, self.clip)

    def sees(self, point: FloatArray) -> bool:
        """Return whether no part of the surface is before a point (3,) of it, and it is not cut away."""
        return self.picker is None or self.picker.sees(self.renderer, point, self.clip)

    def _pixel(self, position: QtCore.QPoint) -> tuple[float, float]:
        """Return the device pixel, y up, at a point of the view."""
        ratio = self.devicePixelRatioF()
        return (position.x() + 0.5) * ratio, (self.height() - position.y() - 0.5) * ratio

    def pixel_size(self, point: FloatArray) -> float:
        """Return the length of a logical pixel at a point (3,)."""
        camera = self.camera
        if camera.GetParallelProjection():
            return float(2 * camera.GetParallelScale() / max(self.height(), 1))
        depth = (point - np.array(camera.GetPosition())) @ np.array(camera.GetDirectionOfProjection())
        return float(2 * depth * np.tan(np.radians(camera.GetViewAngle()) / 2) / max(self.height(), 1))

    def mark_at(self, position: QtCore.QPoint) -> int:
        """Return the number of the source's mark that is seen under a point of the view; -1 for none."""
        if not 0 < len(self.handles) <= MOST_HELD or self.picker is None or self.is_empty:
            return -1
        x, y = self._pixel(position)
        renderer = self.renderer
        if self.scene.insets.renderer_at(x, y) is not renderer:
            return -1
        at = np.array([pixel_of(renderer, handle) for handle in self.handles])
        away = np.hypot(x - at[:, 0], y - at[:, 1])
        nearest = int(away.argmin())
        reach = (self.scene.style.marker_size * self.proportion / 2 + MARK_SLACK) * self.devicePixelRatioF()
        return nearest if away[nearest] <= reach and self.sees(self.handles[nearest]) else -1

    # ------------------------------------------------------------------ the camera
    def zoom(self, factor: float, position: QtCore.QPoint | None = None) -> None:
        """Zoom in by a factor about what is under a point of the view, or about its middle."""
        about = np.array(self.camera.GetFocalPoint())
        if position is not None:
            hit = self.pick(position)
            about = moves.at_focal_depth(self.renderer, *self._pixel(position)) if hit is None else hit.position
        moves.zoom(self.camera, factor, about)
        self.moved.emit()

    def turn_by(self, right: int, up: int) -> None:
        """Turn the surface by a step of the keyboard, as if it was dragged."""
        step = KEY_TURN / moves.TURN
        moves.turn(self.camera, right * step, up * step, (1, 1), self.upright)
        self.moved.emit()

    def shift_by(self, right: int, up: int) -> None:
        """Move the surface sideways by a step of the keyboard."""
        moves.shift(self.camera, right * KEY_SHIFT, up * KEY_SHIFT, 1)
        self.moved.emit()

    def centre(self, point: FloatArray) -> None:
        """Let a point (3,) be in the middle, and what is turned about."""
        moves.centre(self.camera, point)
        self.moved.emit()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._is_stale = True
        self.resized.emit()
