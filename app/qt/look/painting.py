"""What widgets that paint themselves share: a smooth painter, rounded boxes, pens, and where words stand."""

from qtpy import QtCore, QtGui, QtWidgets


def smooth_painter(widget: QtWidgets.QWidget) -> QtGui.QPainter:
    """A painter on a widget, with smooth edges."""
    painter = QtGui.QPainter(widget)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    return painter


def paint_rounded(
    painter: QtGui.QPainter,
    box: QtCore.QRectF,
    radius: float,
    ground: QtGui.QColor | str = "",
    line: str = "",
    width: float = 1.0,
) -> None:
    """Paint a box with round corners, its ground and its outline, "" for none; the painter's pen and brush stay so."""
    painter.setPen(QtGui.QPen(QtGui.QColor(line), width) if line else QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(ground) if ground else QtCore.Qt.BrushStyle.NoBrush)
    painter.drawRoundedRect(box, radius, radius)


def round_pen(colour: QtGui.QColor, width: float) -> QtGui.QPen:
    """A pen whose lines have round ends and corners."""
    pen = QtGui.QPen(colour, width)
    pen.setCapStyle(QtCore.Qt.PenCapStyle.RoundCap)
    pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)
    return pen


def translucent(colour: str, opacity: float) -> QtGui.QColor:
    """A colour through which what lies below is seen; opacity: 0 to 1."""
    found = QtGui.QColor(colour)
    found.setAlphaF(opacity)
    return found


def baseline(painter: QtGui.QPainter, middle: float) -> float:
    """Where words in the painter's font stand whose middle is at a height."""
    metrics = QtGui.QFontMetricsF(painter.font())
    return float(middle + (metrics.ascent() - metrics.descent()) / 2)
