"""The picture of a panel: a surface that is drawn off the screen, once for each change, and where places are in it."""

from collections.abc import Iterator

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets
from vtkmodules.vtkRenderingCore import vtkCamera, vtkRenderer

from bihdist_core.arrays import AnyArray, FloatArray

from ...scene import moves
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.picking import Hit, LatePicker, Picker, pixel_of
from ...scene.proportion import proportion
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

KEY_TURN, KEY_SHIFT = 15.0, 0.05
"""Degrees, and shares of the view's height, for a key."""


class View(QtWidgets.QWidget):
    """A scene on the screen.  What lies over it, and what the mouse does, is `PanelView`'s."""

    pressed = QtCore.Signal()  # any button
    happened = QtCore.Signal(object)  # one of `events`
    let_go = QtCore.Signal()  # the button that has moved the camera
    moved = QtCore.Signal()  # the camera
    resized = QtCore.Signal()
    drawn = QtCore.Signal()  # another picture
    shot_wanted = QtCore.Signal()  # what is written on the picture is needed now

    def __init__(self, offscreen: OffscreenRenderer, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.offscreen = offscreen
        self.plotter = offscreen.new_plotter(self.redraw)
        self.scene = offscreen.new_scene(scale=self.devicePixelRatioF(), plotter=self.plotter)
        self.picker: Picker | LatePicker | None = None
        self.handles = np.empty((0, 3))  # where the source's marks are
        self.upright: FloatArray | None = None  # what stays upright while the surface turns
        self._picture: QtGui.QImage | None = None
        self._drawing = np.empty((0, 0, 4), np.uint8)
        self._written: AnyArray | None = None
        self.pictures = 0  # how many have been drawn
        self._is_stale, self._is_empty, self._is_dimmed = True, True, False
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
    def pixels(self) -> tuple[int, int]:
        """Width and height in device pixels."""
        ratio = self.devicePixelRatioF()
        return max(round(self.width() * ratio), 1), max(round(self.height() * ratio), 1)

    @property
    def proportion(self) -> float:
        """The share of their usual size that lines and marks have here."""
        return proportion(self.width(), self.height())

    @property
    def mark_size(self) -> float:
        """How far the mark of a source is across, in logical pixels."""
        return self.scene.style.marker_size * self.proportion

    @property
    def is_empty(self) -> bool:
        """Whether there is no surface in the view."""
        return self._is_empty

    @property
    def is_stale(self) -> bool:
        """Whether it is on the screen, and has not been drawn as it is now."""
        return self._is_stale and not self._is_empty and not self.visibleRegion().isEmpty()

    def show_style(self, style: Style) -> bool:
        """Look like this from now on; whether that is another look, so that all has to be shown again."""
        ratio = self.devicePixelRatioF()
        if (style, ratio) == (self.scene.style, self.scene.scale):
            return False
        self.offscreen.remove(self.scene)
        self.scene = self.offscreen.new_scene(style, ratio, self.plotter)
        self.redraw()
        return True

    def show_empty(self, is_empty: bool) -> None:
        """Whether there is no surface: then nothing is drawn."""
        self._is_empty, self._picture = is_empty, None
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

    # ------------------------------------------------------------------ painting
    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        ground = QtGui.QColor(LOOK.theme.canvas)
        if self._is_empty:
            painter.fillRect(event.rect(), ground)
            return
        waits = self._waits()
        picture = self._picture if waits else self._drawn()
        if self._is_dimmed or picture is None:
            painter.fillRect(event.rect(), ground)
            painter.setOpacity(DIMMED)
        if waits and picture is not None:
            painter.drawImage(self.rect(), picture)  # which may be of another size
        elif picture is not None:
            painter.drawImage(QtCore.QPointF(0, 0), picture)
        painter.setOpacity(1.0)
        self.paint_over(painter)

    def paint_over(self, painter: QtGui.QPainter) -> None:
        """What lies over the picture."""

    def see_again(self) -> None:
        """Another picture has been drawn: other places may be hidden."""

    def _waits(self) -> bool:
        """Whether keys and clicks come first: other views have taken long, and what is painted is as it was."""
        waits = self._is_old() and self.offscreen.seconds > AT_ONCE
        if waits:
            QtCore.QTimer.singleShot(0, self.update)
        return waits

    def _is_old(self) -> bool:
        return self._is_stale or self._picture is None or self._picture.size() != QtCore.QSize(*self.pixels)

    def _drawn(self) -> QtGui.QImage:
        """The picture, drawn if something has changed since."""
        width, height = self.pixels
        if self._is_old() or self._picture is None:
            QtCore.QTimer.singleShot(0, self.offscreen.begin)
            self.scene.set_proportion(self.proportion)
            self._drawing, self._written = self.offscreen.picture(self.scene, (width, height)), None
            self._picture = self._image(self._drawing)
            self._is_stale = False
            self.see_again()
            self.pictures += 1
            self.drawn.emit()
        return self._picture

    def _image(self, pixels: AnyArray) -> QtGui.QImage:
        """In the memory of pixels (h, w, 4), which have to be kept."""
        height, width, _ = pixels.shape
        image = QtGui.QImage(pixels.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBX8888)
        image.setDevicePixelRatio(self.devicePixelRatioF())
        return image

    @property
    def picture(self) -> AnyArray | None:
        """(h, w, 4) uint8: the surface as it is seen now; None before it is drawn again."""
        return None if self._is_stale or self._is_empty or self._picture is None else self._drawing

    def write(self, pixels: AnyArray) -> None:
        """The picture (h, w, 4) with what is written on it, until the next one is drawn."""
        self._written, self._picture = pixels, self._image(pixels)
        self.update()

    def draw_in_full(self) -> None:
        """Draw the surface again where something has stood in for it."""
        if self.scene.is_stand_in:
            self.scene.show_stand_in(False)
            self.redraw()

    def shot(self) -> AnyArray:
        """(height, width, 3) uint8: the surface and what is written on it, without what lies over it."""
        self.draw_in_full()
        self._drawn()
        self.shot_wanted.emit()
        return (self._drawing if self._written is None else self._written)[..., :3].copy()

    # ------------------------------------------------------------------ places
    def parts(self) -> Iterator[tuple[vtkRenderer, QtGui.QRegion, tuple[int, int, int, int]]]:
        """The view without its insets, and these: renderers, regions, and (left, top, width, height) of the picture.

        The latter are device pixels, of the view's own all of them.
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
        """Where a point (3,) is seen, in logical pixels; renderer: of an inset, if it is that."""
        x, y = pixel_of(renderer or self.renderer, point)
        ratio = self.devicePixelRatioF()
        return QtCore.QPointF(x / ratio, self.height() - y / ratio)

    def pick(self, position: QtCore.QPoint) -> Hit | None:
        """Where the surface is met under a point of the view."""
        if self.picker is None or self._is_empty:
            return None
        pixel = self._pixel(position)
        self.offscreen.fit(self.pixels)
        return self.picker.pick(self.scene.insets.renderer_at(*pixel), *pixel)

    def sees(self, point: FloatArray) -> bool:
        """Whether no part of the surface is before a point (3,) of it."""
        return self.picker is None or self.picker.sees(self.renderer, point)

    def _pixel(self, position: QtCore.QPoint) -> tuple[float, float]:
        """Device pixels, y up."""
        ratio = self.devicePixelRatioF()
        return (position.x() + 0.5) * ratio, (self.height() - position.y() - 0.5) * ratio

    def pixel_size(self, point: FloatArray) -> float:
        """How long a logical pixel is at a point (3,)."""
        camera = self.camera
        if camera.GetParallelProjection():
            return float(2 * camera.GetParallelScale() / max(self.height(), 1))
        depth = (point - np.array(camera.GetPosition())) @ np.array(camera.GetDirectionOfProjection())
        return float(2 * depth * np.tan(np.radians(camera.GetViewAngle()) / 2) / max(self.height(), 1))

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
        reach = (self.mark_size / 2 + MARK_SLACK) * self.devicePixelRatioF()
        return nearest if away[nearest] <= reach and self.sees(self.handles[nearest]) else -1

    # ------------------------------------------------------------------ the camera
    def zoom(self, factor: float, position: QtCore.QPoint | None = None) -> None:
        """Nearer by a factor, about what is under a point of the view; about the middle if none is given."""
        about = np.array(self.camera.GetFocalPoint())
        if position is not None:
            hit = self.pick(position)
            about = moves.at_focal_depth(self.renderer, *self._pixel(position)) if hit is None else hit.position
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

    def centre(self, point: FloatArray) -> None:
        """Let a point (3,) be in the middle, and what is turned about."""
        moves.centre(self.camera, point)
        self.moved.emit()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._is_stale = True
        self.resized.emit()
