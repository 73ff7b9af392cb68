"""Buttons of the start page: recent files as rows, samples as tiles with pictures."""

import os
from contextlib import suppress
from datetime import datetime, timedelta
from functools import lru_cache

import numpy as np
from PIL import Image
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray

from ...samples import mesh_path, sample_names, sample_title, thumbnail
from ..look.look import LOOK, paint_rounded, smooth_painter
from ..remembered import Recent
from .messages import from_home

ROW = 32
"""Height of a row in logical pixels, as all lengths here."""

NARROWEST_TILE, GAP = 112, 8
SMALLEST_PICTURE, LARGEST_PICTURE = 88, 124
FIRST_SAMPLES = ("figure", "beast", "hand", "genus3")
"""The samples that are shown at first: limbs, many tips, fingers, handles."""

MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")

WHITE = 250
"""Brightness, of 255, from which on a pixel may belong to the background."""

LINE = 1
"""Pixels at each side within which white lines, the isolines, end, but not the background."""


class OpenButton(QtWidgets.QAbstractButton):
    """A button that opens the file at `path` by a click or by Enter."""

    INSET, RADIUS = 8, 6

    def __init__(self, path: str = "") -> None:
        super().__init__()
        self.path = path
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_Hover)
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)  # a click opens; the outline is for the keyboard
        LOOK.changed.connect(self._apply_theme)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        if event.key() in (QtCore.Qt.Key.Key_Return, QtCore.Qt.Key.Key_Enter):
            self.click()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter, box = LOOK.theme, smooth_painter(self), QtCore.QRectF(self.rect()).adjusted(1, 1, -1, -1)
        painter.setRenderHint(QtGui.QPainter.RenderHint.SmoothPixmapTransform)
        ground = theme.pressed if self.isDown() else theme.hover if self.underMouse() else ""
        paint_rounded(painter, box, self.RADIUS, ground, theme.accent if self.hasFocus() else "", 2)
        self.paint(painter)

    def _apply_theme(self) -> None:
        self.updateGeometry()
        self.update()

    def paint(self, painter: QtGui.QPainter) -> None:
        """Paint the content."""
        raise NotImplementedError


def _write(painter: QtGui.QPainter, box: QtCore.QRectF, text: str, colour: str, align: QtCore.Qt.AlignmentFlag) -> None:
    """Write a line, with dots in its middle where it has no room."""
    short = painter.fontMetrics().elidedText(text, QtCore.Qt.TextElideMode.ElideMiddle, int(box.width()) + 1)
    painter.setPen(QtGui.QColor(colour))
    painter.drawText(box, align | QtCore.Qt.AlignmentFlag.AlignVCenter, short)


# ---------------------------------------------------------------------- recent files
class RecentRow(OpenButton):
    """A row with a file's name, its folder, and when it was opened."""

    def __init__(self) -> None:
        super().__init__()
        self.name = self.folder = self.when = ""
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)

    def show_file(self, file: Recent, now: datetime) -> None:
        """Show a file by its name, its folder and when it was opened."""
        self.path = file.path
        self.name, self.folder = os.path.basename(file.path), from_home(os.path.dirname(file.path))
        self.when = when(file.opened_at, now)
        self.setToolTip(file.path)
        self.setAccessibleName(f"{self.name}, {self.folder}")
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(160, round(ROW * LOOK.scale))

    minimumSizeHint = sizeHint

    def paint(self, painter: QtGui.QPainter) -> None:
        theme, inside = LOOK.theme, QtCore.QRectF(self.rect()).adjusted(self.INSET, 0, -self.INSET, 0)
        painter.setFont(LOOK.font())
        metrics = QtGui.QFontMetricsF(painter.font())
        # The same in each row, so that they stand in columns.
        times = max(metrics.horizontalAdvance(text) for text in ("today, 00:00", "00 Mmm 0000"))
        names = (inside.width() - times) * 0.55
        left, right = QtCore.Qt.AlignmentFlag.AlignLeft, QtCore.Qt.AlignmentFlag.AlignRight
        _write(painter, QtCore.QRectF(inside.left(), 0, names - 8, self.height()), self.name, theme.text, left)
        folders = QtCore.QRectF(inside.left() + names, 0, inside.width() - times - names - 8, self.height())
        _write(painter, folders, self.folder, theme.quiet, left)
        _write(painter, inside, self.when, theme.quiet, right)


def when(opened_at: datetime | None, now: datetime) -> str:
    """Return a local time as "today, 14:20", "yesterday", "12 Nov" or "12 Nov 2023"."""
    if opened_at is None:
        return ""
    if opened_at.date() == now.date():
        return f"today, {opened_at:%H:%M}"
    if opened_at.date() == now.date() - timedelta(days=1):
        return "yesterday"
    year = "" if opened_at.year == now.year else f" {opened_at.year}"
    return f"{opened_at.day} {MONTHS[opened_at.month - 1]}{year}"


# ---------------------------------------------------------------------- samples
class Tiles(QtWidgets.QWidget):
    """Tiles of samples, as many in a row as there is room for; at first only a few."""

    def __init__(self) -> None:
        super().__init__()
        names = [*FIRST_SAMPLES, *(name for name in sample_names() if name not in FIRST_SAMPLES)]
        self.tiles = [SampleTile(name) for name in names]
        for place, tile in enumerate(self.tiles):
            tile.setParent(self)
            tile.setVisible(place < len(FIRST_SAMPLES))
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        LOOK.changed.connect(self._arrange)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()

    def show_all(self) -> None:
        """Show all samples."""
        for tile in self.tiles:
            tile.show()
        self._arrange()

    def _arrange(self) -> None:
        tiles = [tile for tile in self.tiles if not tile.isHidden()]
        columns = max(1, int((self.width() + GAP) // (NARROWEST_TILE * LOOK.scale + GAP)))
        columns = min(columns, max(-(-len(tiles) // 2), len(FIRST_SAMPLES)))  # the tiles grow instead
        width = (self.width() + GAP) // columns - GAP
        height = SampleTile.height_for(width)
        for k, tile in enumerate(tiles):
            row, column = divmod(k, columns)
            tile.setGeometry(column * (width + GAP), row * (height + GAP), width, height)
        self.setFixedHeight(-(-len(tiles) // columns) * (height + GAP) - GAP)


class SampleTile(OpenButton):
    """A sample's picture, its name and its number of vertices."""

    RADIUS = 8

    def __init__(self, name: str) -> None:
        super().__init__(mesh_path(name))
        self.sample, self.title = name, sample_title(name)
        count = vertex_count(self.path)
        self.count = f"{count:,} vertices" if count else ""
        self.setAccessibleName(f"{self.title}, {self.count}")

    @staticmethod
    def height_for(width: int) -> int:
        """Return the height of a tile of a width, in pixels."""
        return _picture_side(width) + round(18 + 40 * LOOK.scale)

    def paint(self, painter: QtGui.QPainter) -> None:
        theme, side, middle = LOOK.theme, _picture_side(self.width()), QtCore.Qt.AlignmentFlag.AlignHCenter
        painter.drawPixmap(QtCore.QRect((self.width() - side) // 2, 8, side, side), cut_out(self.sample))
        line = 18 * LOOK.scale
        name = QtCore.QRectF(4, side + 12, self.width() - 8, line)
        painter.setFont(LOOK.font())
        _write(painter, name, self.title, theme.text, middle)
        painter.setFont(LOOK.font(12))
        _write(painter, name.translated(0, line), self.count, theme.quiet, middle)


def _picture_side(width: int) -> int:
    return min(max(width - 24, SMALLEST_PICTURE), LARGEST_PICTURE)


@lru_cache(maxsize=64)
def vertex_count(path: str) -> int:
    """Return the number of vertices in the header of a PLY file; 0 if it has none."""
    with suppress(OSError, ValueError, IndexError), open(path, "rb") as file:
        for line in file:
            if line.startswith(b"element vertex "):
                return int(line.split()[2])
            if line.startswith(b"end_header"):
                break
    return 0


@lru_cache(maxsize=64)
def cut_out(name: str) -> QtGui.QPixmap:
    """Return a sample's picture without its white background; empty if there is none."""
    try:
        with Image.open(thumbnail(name)) as file:
            picture = without_ground(np.asarray(file.convert("RGB")))
    except OSError:
        return QtGui.QPixmap()
    high, wide = picture.shape[:2]
    image = QtGui.QImage(picture.tobytes(), wide, high, 4 * wide, QtGui.QImage.Format.Format_RGBA8888)
    return QtGui.QPixmap.fromImage(image)


def without_ground(picture: AnyArray) -> AnyArray:
    """Return a picture (h, w, 3) of something on white as (h, w, 4) bytes, whose white ground is transparent.

    The ground is what is white and wide.  A pixel beside it is a mixture of white with what is there, for which the
    darkest of its neighbours stands.
    """
    edge = LINE + 1
    padded = np.pad(picture, ((edge, edge), (edge, edge), (0, 0)), constant_values=255)
    white = padded.min(axis=2) >= WHITE
    wide = ~_largest(~white, LINE)
    ground = _largest(wide, edge) & white
    beside = _largest(ground, 1) & ~ground
    darkest = -_largest(-padded.astype(np.int16), 1)
    light, depth = 255.0 - padded, np.maximum(255.0 - darkest, 1)
    opacity = np.where(beside, np.clip((light / depth).max(axis=2), 0, 1), ~ground)
    colours = np.where(beside[..., None], darkest, padded)
    found = np.dstack([colours, np.round(255 * opacity)]).astype(np.uint8)
    return found[edge:-edge, edge:-edge]


def _largest(values: AnyArray, steps: int) -> AnyArray:
    """Return the maximum over a square of pixels, `steps` to each side."""
    for axis in (0, 1):
        before = values
        for shift in range(1, steps + 1):
            values = np.maximum(values, np.maximum(np.roll(before, shift, axis), np.roll(before, -shift, axis)))
    return values
