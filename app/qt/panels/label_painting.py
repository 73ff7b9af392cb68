"""Values painted on isolines of a picture, each in a gap of its line."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import AnyArray, ByteArray, FloatArray

from ...scene.field_actor import CASING
from ...scene.levels import BOLD
from ...scene.line_labels import PAD, STRAIGHT
from ...scene.style import RIM, Style
from ..look.look import LOOK
from ..look.painting import round_pen

FONT_SIZE = 11.0
"""Logical pixels."""


@dataclass(frozen=True)
class Written:
    """A text of this width about a middle (x, y) of the picture, in logical pixels, turned against the clock."""

    text: str
    middle: tuple[float, float]
    angle: float
    width: float
    value: float
    is_bold: bool
    is_through: bool


def label_font(ratio: float) -> QtGui.QFont:
    """In device pixels, of which there are so many in a logical one."""
    font = LOOK.font(FONT_SIZE, bold=True)
    font.setPixelSize(max(1, round(font.pixelSize() * ratio)))
    return font


def painted(
    picture: AnyArray, written: Sequence[Written], style: Style, signed: bool, top: float, ratio: float
) -> AnyArray:
    """A copy of a picture (h, w, 4) of a field that goes up to `top`, with these on it; ratio: device pixels each."""
    result = picture.copy()
    for label in written:
        _open(result, label, style, ratio)
    height, width, _ = result.shape
    image = QtGui.QImage(result.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBX8888)
    painter = QtGui.QPainter(image)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    font = label_font(ratio)
    metrics = QtGui.QFontMetricsF(font)
    for label in written:
        painter.resetTransform()
        painter.translate(*(ratio * x for x in label.middle))
        painter.rotate(-label.angle)
        path = QtGui.QPainterPath()
        start = QtCore.QPointF(-metrics.horizontalAdvance(label.text) / 2, metrics.capHeight() / 2)
        path.addText(start, font, label.text)
        rim = style.mark_edge if label.is_through else style.rim(signed, label.value)
        if rim is not None:
            width = 2 * (CASING if label.is_through else RIM) * ratio
            painter.strokePath(path, round_pen(QtGui.QColor.fromRgbF(*rim), width))
        colour = style.source if label.is_through else style.line(signed, label.value / top if top > 0 else 0.0)
        painter.fillPath(path, QtGui.QColor.fromRgbF(*colour))
    painter.end()
    return _pixels(image)


def _open(picture: AnyArray, label: Written, style: Style, ratio: float) -> None:
    """A gap in the line, in place: as the surface is on both sides of it."""
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
    """(h, w, 4) a copy of its pixels."""
    memory = image.constBits()
    if hasattr(memory, "setsize"):  # of PyQt
        memory.setsize(image.sizeInBytes())
    return np.array(memory, np.uint8).reshape(image.height(), image.width(), 4)
