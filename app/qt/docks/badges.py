"""Small discs that stand for pins and sources, in charts and heads."""

from dataclasses import dataclass

from qtpy import QtCore, QtGui

from ..look.look import LOOK

BADGE = 16.0
"""Logical pixels across."""

SOURCE, RIM = "#FFDB1A", "#1A1A1F"


@dataclass(frozen=True)
class Badge:
    """A point of the document: text on its disc, "" for a source; name: in words."""

    text: str
    colour: str
    name: str


def paint_badge(painter: QtGui.QPainter, at: QtCore.QPointF, badge: Badge) -> None:
    """Paint a disc with a number, or a small ring without one."""
    if not badge.text:
        painter.setPen(QtGui.QPen(QtGui.QColor(RIM), 1.5))
        painter.setBrush(QtGui.QColor(badge.colour))
        painter.drawEllipse(at, 5.0, 5.0)
        return
    painter.setPen(QtCore.Qt.PenStyle.NoPen)
    painter.setBrush(QtGui.QColor(badge.colour))
    radius = BADGE / 2
    painter.drawEllipse(at, radius, radius)
    painter.setFont(LOOK.font(10 if len(badge.text) < 3 else 8, bold=True))
    painter.setPen(QtGui.QColor("#FFFFFF"))
    box = QtCore.QRectF(at.x() - radius, at.y() - radius, BADGE, BADGE)
    painter.drawText(box, int(QtCore.Qt.AlignmentFlag.AlignCenter), badge.text)
