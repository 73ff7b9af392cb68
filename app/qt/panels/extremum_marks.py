"""Triangles at extrema, over a view: upwards at maxima, downwards at minima; outlines where the surface hides them."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import AnyArray, FloatArray

from ..look.look import LOOK
from .overlay import shrunk
from .seen_places import SeenPlaces

SIZE = 6.0
"""From the centre to a corner, in logical pixels."""

BRIGHT, DARK = QtGui.QColor("#FFFFFF"), QtGui.QColor("#14161A")


class ExtremumMarks(SeenPlaces):
    """Maxima and minima."""

    def __init__(self, view: Any) -> None:
        super().__init__(view)
        self.is_maximum = np.empty(0, bool)

    def show(self, positions: FloatArray, is_maximum: AnyArray) -> None:
        """Positions (k, 3), and (k,) whether they are maxima."""
        if np.array_equal(positions, self.positions) and np.array_equal(is_maximum, self.is_maximum):
            return
        self.is_maximum = is_maximum
        self.place(positions)

    def paint(self, painter: QtGui.QPainter) -> None:
        if not len(self.positions):
            return
        for position, is_up, is_seen in zip(self.positions, self.is_maximum, self.seen(), strict=True):
            at = self._view.place_of(position)
            with shrunk(painter, at, self._view.proportion):
                paint_triangle(painter, at, bool(is_up), bool(is_seen))


def paint_triangle(painter: QtGui.QPainter, at: QtCore.QPointF, is_up: bool, is_seen: bool) -> None:
    """White with a dark rim; where it is hidden, an outline."""
    way = -1 if is_up else 1
    corners = [(0.0, way * SIZE), (-0.87 * SIZE, -way * 0.6 * SIZE), (0.87 * SIZE, -way * 0.6 * SIZE)]
    triangle = QtGui.QPolygonF([at + QtCore.QPointF(x, y) for x, y in corners])
    painter.setBrush(BRIGHT if is_seen else QtCore.Qt.BrushStyle.NoBrush)
    pens = [QtGui.QPen(DARK, 1.5)]
    if not is_seen:
        bright, dark = QtGui.QColor(BRIGHT), QtGui.QColor(DARK)
        bright.setAlphaF(0.7)
        dark.setAlphaF(0.7)
        pens = [QtGui.QPen(bright, 2.5), QtGui.QPen(dark, 1.0)]
    for pen in pens:
        pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)
        painter.setPen(pen)
        painter.drawPolygon(triangle)


NOTE_LEFT, NOTE_TOP, NOTE_GAP = 14.0, 15.0, 10.0
"""Logical pixels: from the view's corner to the triangle of its note, and from that to the words."""


MOST_NOTE = 0.85
"""Of a view's width; in one that is lower than LOW logical pixels the shape needs the room, and the short form does."""
LOW, TINY = 240, 170


def paint_note(painter: QtGui.QPainter, view: QtCore.QRectF, notes: Sequence[str]) -> None:
    """In the left upper corner of a view: how many of them there are, in the first words for which there is room.

    In a tiny view they would lie on the surface; the dock says them, too.
    """
    if view.height() < TINY * LOOK.scale:
        return
    at = QtCore.QPointF(NOTE_LEFT, NOTE_TOP * LOOK.scale)
    painter.setFont(LOOK.font(12.5))
    metrics = QtGui.QFontMetricsF(painter.font())
    left = at.x() + SIZE + NOTE_GAP
    room = MOST_NOTE * view.width() - left
    fitting = (words for words in notes[view.height() < LOW * LOOK.scale :] if metrics.horizontalAdvance(words) <= room)
    words = next(fitting, notes[-1])
    baseline = at.y() + (metrics.ascent() - metrics.descent()) / 2
    ground = QtGui.QColor(LOOK.theme.canvas)
    ground.setAlphaF(0.8)
    box = QtCore.QRectF(4, 2, left + metrics.horizontalAdvance(words), 2 * (at.y() - 2))
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(ground)
    painter.drawRoundedRect(box, 4, 4)
    paint_triangle(painter, at, True, True)
    painter.setPen(QtGui.QColor(LOOK.theme.quiet))
    painter.drawText(QtCore.QPointF(left, baseline), words)
