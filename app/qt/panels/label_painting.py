"""Values painted on isolines of a picture, each in a gap of its line."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from qtpy import QtGui

from bihdist_core.arrays import AnyArray, ByteArray, FloatArray

from ...drawing.painters.qt import paint
from ...drawing.shapes import Pen, Text
from ...scene.levels import BOLD
from ...scene.line_labels import PAD, STRAIGHT
from ...scene.style import CASING, IsolineInk, Style
from ..look.look import LOOK

Ink = Callable[[float, bool], IsolineInk]
"""The ink of an isoline of a value, and whether it passes through a point."""

FONT_SIZE = 11.0
"""Logical pixels."""


@dataclass(frozen=True)
class PlacedLabel:
    """A text of this width about a middle (x, y) of the picture, in logical pixels, turned against the clock."""

    text: str
    middle: tuple[float, float]
    angle: float
    width: float
    value: float
    is_bold: bool
    is_through: bool


def painted(picture: AnyArray, written: Sequence[PlacedLabel], style: Style, ink_of: Ink, ratio: float) -> AnyArray:
    """Return a copy of a picture (h, w, 4) with labels; `ratio` is the number of device pixels in a pixel."""
    result = picture.copy()
    for label in written:
        _open(result, label, style, ratio)
    height, width, _ = result.shape
    image = QtGui.QImage(result.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBX8888)
    painter = QtGui.QPainter(image)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    paint(painter, [_shape(label, ink_of, ratio) for label in written])
    painter.end()
    return _pixels(image)


def _shape(label: PlacedLabel, ink_of: Ink, ratio: float) -> Text:
    """Return a label in device pixels, in the colour of its line."""
    ink = ink_of(label.value, label.is_through)
    halo = ink.rim and Pen(ink.rim, 2 * ink.rim_width * ratio, cap="round", join="round")
    (x, y), size = (ratio * place for place in label.middle), ratio * round(FONT_SIZE * LOOK.scale)
    return Text(label.text, x, y, size, ink.colour, True, "centre", "capitals", label.angle, halo)


def _open(picture: AnyArray, label: PlacedLabel, style: Style, ratio: float) -> None:
    """Clear a gap in a label's line, in place, with the colours of the surface on both sides of it."""
    height, width, _ = picture.shape
    across = style.isoline_width / 2 * (BOLD if label.is_bold or label.is_through else 1.0)
    band = ratio * (across + CASING * label.is_through + STRAIGHT * FONT_SIZE * LOOK.scale + 1.2)
    half = ratio * (label.width / 2 + PAD - 0.5)
    middle = ratio * np.array(label.middle)
    turn = np.radians(label.angle)
    way = np.array([np.cos(turn), -np.sin(turn)])
    normal = np.array([-way[1], way[0]])
    reach = np.abs(half * way) + np.abs(band * normal)
    low = np.maximum(np.floor(middle - reach), 0).astype(int)
    high = np.minimum(np.ceil(middle + reach), (width, height)).astype(int)
    y, x = np.mgrid[low[1] : high[1], low[0] : high[0]]
    off = np.stack([x.ravel(), y.ravel()], 1) + 0.5 - middle
    along, side = off @ way, off @ normal
    inside = (np.abs(along) <= half) & (np.abs(side) <= band)
    along, side, off = along[inside], side[inside], off[inside]

    def beside(which: int) -> FloatArray:
        at = np.floor(middle + along[:, None] * way + which * (band + 1) * normal).astype(int)
        paint: FloatArray = picture[at[:, 1].clip(0, height - 1), at[:, 0].clip(0, width - 1)].astype(float)
        return paint

    share = ((side / (band + 1)) + 1)[:, None] / 2
    column, row = np.floor(middle + off).astype(int).T
    picture[row, column] = np.round((1 - share) * beside(-1) + share * beside(1)).astype(np.uint8)


def _pixels(image: QtGui.QImage) -> ByteArray:
    """Return a copy of an image's pixels (h, w, 4)."""
    memory = image.constBits()
    if hasattr(memory, "setsize"):  # of PyQt
        memory.setsize(image.sizeInBytes())
    return np.array(memory, np.uint8).reshape(image.height(), image.width(), 4)
