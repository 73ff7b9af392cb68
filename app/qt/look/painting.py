"""A smooth painter, rounded boxes, translucent colours and baselines for widgets that paint themselves."""

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.painters.qt import number_width, paint_number


def smooth_painter(widget: QtWidgets.QWidget, ground: str = "") -> QtGui.QPainter:
    """Return a painter on a widget, with smooth edges.

    Parameters
    ----------
    widget
        What is painted.
    ground
        The colour to fill it with first, "" for none.  That has no smooth edges: at a fractional scale what was there
        before would be seen through them.
    """
    painter = QtGui.QPainter(widget)
    if ground:
        painter.fillRect(widget.rect(), QtGui.QColor(ground))
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


def paint_elided(painter: QtGui.QPainter, x: float, y: float, text: str, room: float) -> float:
    """Write a text at a baseline, cut short where it is wider than its room, and return where it ends."""
    if number_width(painter.font(), text) > room:
        cut = QtCore.Qt.TextElideMode.ElideRight
        text = QtGui.QFontMetricsF(painter.font()).elidedText(text, cut, max(room, 0.0))
    return paint_number(painter, x, y, text)


def translucent(colour: str, opacity: float) -> QtGui.QColor:
    """Return a colour with an opacity, 0 to 1."""
    found = QtGui.QColor(colour)
    found.setAlphaF(opacity)
    return found


def baseline(painter: QtGui.QPainter, middle: float) -> float:
    """Return the baseline of words in the painter's font whose middle is at a height."""
    metrics = QtGui.QFontMetricsF(painter.font())
    return float(middle + (metrics.ascent() - metrics.descent()) / 2)
