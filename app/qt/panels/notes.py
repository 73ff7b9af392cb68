"""A line of words in the left upper corner of a view: how many extrema there are, or what glyphs stand for."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui

from ...marks.glyphs import TRIANGLE_UP
from ...marks.primitives import LegendRow, PointMark
from ...scene.style import Style
from ..look.look import LOOK
from ..look.painting import baseline, paint_rounded, translucent
from .glyph_painting import paint_glyph, paint_sample

LEFT, TOP, GAP = 14.0, 15.0, 10.0
"""Logical pixels: from the view's corner to the glyph of a note, and from that to the words."""

MOST_NOTE = 0.85
"""Of a view's width; in one that is lower than LOW logical pixels the shape needs the room, and the short form does."""
LOW, TINY = 240, 170


def paint_note(painter: QtGui.QPainter, view: QtCore.QRectF, style: Style, notes: Sequence[str]) -> None:
    """How many extrema there are, in the first words for which there is room.

    In a tiny view they would lie on the surface; the dock says them, too.
    """
    if view.height() < TINY * LOOK.scale:
        return
    at = QtCore.QPointF(LEFT, TOP * LOOK.scale)
    painter.setFont(LOOK.font(12.5))
    metrics = QtGui.QFontMetricsF(painter.font())
    left = at.x() + TRIANGLE_UP.pixels + GAP
    room = MOST_NOTE * view.width() - left
    fitting = (words for words in notes[view.height() < LOW * LOOK.scale :] if metrics.horizontalAdvance(words) <= room)
    words = next(fitting, notes[-1])
    box = QtCore.QRectF(4, 2, left + metrics.horizontalAdvance(words), 2 * (at.y() - 2))
    paint_rounded(painter, box, 4, translucent(LOOK.theme.canvas, 0.8))
    paint_glyph(painter, PointMark(0, TRIANGLE_UP), at, style, 1.0)
    painter.setPen(QtGui.QColor(LOOK.theme.quiet))
    painter.drawText(QtCore.QPointF(left, baseline(painter, at.y())), words)


def paint_legend(painter: QtGui.QPainter, view: QtCore.QRectF, rows: Sequence[LegendRow]) -> None:
    """What glyphs stand for, in a view that has room for it."""
    if view.height() < LOW * LOOK.scale:
        return
    painter.setFont(LOOK.font(12.5))
    metrics = QtGui.QFontMetricsF(painter.font())
    x, middle = LEFT + 2, TOP * LOOK.scale
    for row in rows:
        colour = LOOK.theme.quiet if row.glyph.rise else LOOK.theme.text
        paint_sample(painter, row.glyph, QtCore.QPointF(x, middle), QtGui.QColor(colour))
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        x += 14 * LOOK.scale
        painter.drawText(QtCore.QPointF(x, baseline(painter, middle)), row.text)
        x += metrics.horizontalAdvance(row.text) + 22 * LOOK.scale
