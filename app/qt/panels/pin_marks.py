"""Pins as they are painted: drops over a view, whose tips are the places, and badges in lists, with numerals."""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import FloatArray

from ..look.look import LOOK
from .overlay import shrunk

HEAD = 8.5
"""Radius of a drop's head, and of a badge's disc."""

RISE = 17.0
"""From the tip to the middle of the head."""

RIMS = 2.5
"""Around the head."""

LEAST = 0.75
"""The share of its size that a drop has in small views, at least: its numeral is to be read."""

BRIGHT, DARK = QtGui.QColor("#FFFFFF"), QtGui.QColor("#14161A")


@dataclass(frozen=True, eq=False)
class PinMark:
    """A pin at a position (3,), in a colour such as "#1F7A3D"; is_lit: it stands out."""

    number: int
    position: FloatArray
    colour: str
    is_lit: bool = False

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, PinMark)
            and (self.number, self.colour, self.is_lit) == (other.number, other.colour, other.is_lit)
            and np.array_equal(self.position, other.position)
        )

    __hash__ = None


def paint_pins(
    painter: QtGui.QPainter,
    pins: Mapping[int, tuple[PinMark, QtCore.QPointF]],
    hidden: Collection[int],
    share: float = 1.0,
) -> None:
    """Drops at their places, by number: those that are hidden under the others, the first and what is lit on top.

    share: of the usual size of marks.
    """
    for pin, at in _upwards(pins, hidden):
        with shrunk(painter, at, max(share, LEAST)):
            paint_drop(painter, at, pin, pin.number in hidden)


def drop_under(
    place: QtCore.QPointF,
    pins: Mapping[int, tuple[PinMark, QtCore.QPointF]],
    hidden: Collection[int],
    share: float = 1.0,
) -> int:
    """The number of the pin whose drop is seen at a place; 0 for none.  share: of the usual size of marks."""
    over = [pin.number for pin, at in _upwards(pins, hidden) if is_in_drop(place, at, share)]
    return over[-1] if over else 0


def is_in_drop(place: QtCore.QPointF, tip: QtCore.QPointF, share: float) -> bool:
    """Whether the drop with its tip at one place covers another, at a share of the usual size of marks."""
    return bool(drop_at(tip).contains(tip + (place - tip) / max(share, LEAST)))


def _upwards(
    pins: Mapping[int, tuple[PinMark, QtCore.QPointF]], hidden: Collection[int]
) -> list[tuple[PinMark, QtCore.QPointF]]:
    """What lies lowest first."""

    def height(each: tuple[PinMark, QtCore.QPointF]) -> tuple[bool, bool, int]:
        pin, _ = each
        return pin.number not in hidden, pin.is_lit, -pin.number

    return sorted(pins.values(), key=height)


def paint_drop(painter: QtGui.QPainter, tip: QtCore.QPointF, pin: PinMark, is_hidden: bool) -> None:
    """A drop whose tip is the place; hollow and dashed on the far side."""
    radius, colour = HEAD * LOOK.scale, QtGui.QColor(pin.colour)
    drop, middle = drop_at(tip), _head_at(tip)
    painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
    if pin.is_lit:
        _outline(painter, drop, QtGui.QColor(LOOK.theme.accent), 9.0)
        _outline(painter, drop, BRIGHT, 4.5)
    if is_hidden:
        ground = QtGui.QColor(BRIGHT)
        ground.setAlphaF(0.92)
        painter.fillPath(drop, ground)
        _outline(painter, drop, BRIGHT, 3.5)
        pen = QtGui.QPen(colour, 1.6)
        pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap)
        pen.setDashPattern([2.4, 1.6])
        painter.setPen(pen)
        painter.drawPath(drop)
    else:
        if not pin.is_lit:
            _outline(painter, drop, DARK, 4.5)
        _outline(painter, drop, BRIGHT, 2.5)
        painter.fillPath(drop, colour)
    paint_numeral(painter, middle, radius, pin.number, colour if is_hidden else BRIGHT)


def paint_badge(painter: QtGui.QPainter, middle: QtCore.QPointF, number: int, colour: str) -> None:
    """A disc in the colour of a pin, with its number."""
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(colour))
    radius = HEAD * LOOK.scale
    painter.drawEllipse(middle, radius, radius)
    paint_numeral(painter, middle, radius, number, BRIGHT)


def paint_numeral(
    painter: QtGui.QPainter, middle: QtCore.QPointF, radius: float, number: int, colour: QtGui.QColor
) -> None:
    """In the middle of a disc, smaller where there are more digits."""
    text = str(number)
    painter.setFont(LOOK.font((11, 10, 8)[min(len(text), 3) - 1], bold=True))
    painter.setPen(colour)
    metrics = QtGui.QFontMetricsF(painter.font())
    x = middle.x() - metrics.horizontalAdvance(text) / 2
    painter.drawText(QtCore.QPointF(x, middle.y() + metrics.capHeight() / 2), text)


def drop_at(tip: QtCore.QPointF) -> QtGui.QPainterPath:
    """Its outline: a circle, and from where tangents from the tip touch it, these."""
    radius, middle = HEAD * LOOK.scale, _head_at(tip)
    box = QtCore.QRectF(middle.x() - radius, middle.y() - radius, 2 * radius, 2 * radius)
    # The tangents touch at this angle from straight towards the tip.
    half, towards = math.degrees(math.acos(HEAD / RISE)), -90 if middle.y() < tip.y() else 90
    drop = QtGui.QPainterPath(tip)
    drop.arcTo(box, towards + half, 360 - 2 * half)
    drop.closeSubpath()
    return drop


def _head_at(tip: QtCore.QPointF) -> QtCore.QPointF:
    """The middle of the head: above the tip, or where the view ends there, below it."""
    rise = RISE * LOOK.scale
    is_upright = tip.y() > rise + (HEAD + RIMS) * LOOK.scale
    return QtCore.QPointF(tip.x(), tip.y() - rise if is_upright else tip.y() + rise)


def _outline(painter: QtGui.QPainter, drop: QtGui.QPainterPath, colour: QtGui.QColor, width: float) -> None:
    pen = QtGui.QPen(colour, width)
    pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)
    painter.setPen(pen)
    painter.drawPath(drop)
