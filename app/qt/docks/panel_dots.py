"""The colours by which docks tell panels apart: those of curves, in the panels' order."""

from qtpy import QtCore, QtGui

from ..look.look import LOOK

SIDE = 10
"""Logical pixels across a dot, with the air around it."""


def curve_colour(place: int) -> str:
    """That of the panel at a place."""
    return LOOK.theme.curves[place % len(LOOK.theme.curves)]


def dot(colour: str) -> QtGui.QIcon:
    """An icon with a disc of a colour."""
    side = 2 * SIDE
    picture = QtGui.QPixmap(side, side)
    picture.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(colour))
    painter.drawEllipse(2, 2, side - 4, side - 4)
    painter.end()
    picture.setDevicePixelRatio(2)
    return QtGui.QIcon(picture)
