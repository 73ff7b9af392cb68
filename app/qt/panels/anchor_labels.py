"""The values of anchors, painted beside them."""

from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui

from ..look.look import LOOK

AWAY, HEIGHT, PAD = 9.0, 21.0, 5.0
"""Logical pixels: from the place to the label, its height, and beside the text."""


@dataclass(frozen=True, eq=False)
class AnchorLabel:
    """A value at a position (3,); is_chosen: it stands out."""

    position: np.ndarray
    text: str
    is_chosen: bool = False


def paint_anchor_labels(
    painter: QtGui.QPainter, labels: list[tuple[AnchorLabel, QtCore.QPointF]], width: float
) -> None:
    """At their places in a view so wide: at the right, or at the left where there is no room; what is chosen on top."""
    theme = LOOK.theme
    for label, at in sorted(labels, key=lambda each: each[0].is_chosen):
        painter.setFont(LOOK.font(12, bold=True))
        metrics = QtGui.QFontMetricsF(painter.font())
        size = QtCore.QSizeF(metrics.horizontalAdvance(label.text) + 2 * PAD * LOOK.scale, HEIGHT * LOOK.scale)
        left = at.x() + AWAY * LOOK.scale
        if left + size.width() > width:
            left = at.x() - AWAY * LOOK.scale - size.width()
        box = QtCore.QRectF(QtCore.QPointF(left, at.y() - size.height() / 2), size)
        ground, text = (theme.fill, theme.on_fill) if label.is_chosen else (theme.raised, theme.text)
        painter.setPen(QtGui.QPen(QtGui.QColor(ground if label.is_chosen else theme.text), 1))
        painter.setBrush(QtGui.QColor(ground))
        painter.drawRoundedRect(box, 4, 4)
        painter.setPen(QtGui.QColor(text))
        painter.drawText(box, QtCore.Qt.AlignmentFlag.AlignCenter, label.text)
