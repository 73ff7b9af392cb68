"""Numbers of pins: numerals in the middle of a disc, as they stand in pins on surfaces and in lists."""

from qtpy import QtCore, QtGui

from ..look.look import LOOK

RADIUS = 8.5
"""Of a badge, in logical pixels: as large as the head of a pin."""

BRIGHT = QtGui.QColor("#FFFFFF")


def paint_badge(painter: QtGui.QPainter, middle: QtCore.QPointF, number: int, colour: str) -> None:
    """A disc in the colour of a pin, with its number."""
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(colour))
    radius = RADIUS * LOOK.scale
    painter.drawEllipse(middle, radius, radius)
    paint_numeral(painter, middle, number, BRIGHT)


def paint_numeral(painter: QtGui.QPainter, middle: QtCore.QPointF, number: int, colour: QtGui.QColor) -> None:
    """In the middle of a disc, smaller where there are more digits."""
    text = str(number)
    painter.setFont(LOOK.font((11, 10, 8)[min(len(text), 3) - 1], bold=True))
    painter.setPen(colour)
    metrics = QtGui.QFontMetricsF(painter.font())
    x = middle.x() - metrics.horizontalAdvance(text) / 2
    painter.drawText(QtCore.QPointF(x, middle.y() + metrics.capHeight() / 2), text)
