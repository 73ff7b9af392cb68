"""A distance along circles around its source, as a polar chart: round where it is isotropic."""

from collections.abc import Sequence

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.circles import Circle

from ...qt.look.look import LOOK

SIDE = 84
"""Of the chart, in logical pixels."""

SHOWN = 5
"""Of the circles at most so many are drawn: more would touch."""


class PolarChart(QtWidgets.QWidget):
    """Circles of growing radius, each as far from the middle as the field is large there, in a colour."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.circles: tuple[Circle, ...] = ()
        self._colour = "#000000"
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Fixed)
        LOOK.follow(self, self._apply_theme)
        self._apply_theme()

    def show_circles(self, circles: Sequence[Circle], colour: str) -> None:
        """Some of these, the largest among them."""
        step = max(1, -(-len(circles) // SHOWN))
        self.circles, self._colour = tuple(circles[::-1][::step]), colour
        self.update()

    def sizeHint(self) -> QtCore.QSize:
        side = round(SIDE * LOOK.scale)
        return QtCore.QSize(side, side)

    def _apply_theme(self) -> None:
        self.setFixedSize(self.sizeHint())
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        middle, reach = QtCore.QPointF(self.width() / 2, self.height() / 2), self.width() / 2 - 2
        painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
        painter.setPen(QtGui.QPen(QtGui.QColor(LOOK.theme.border), 1))
        painter.drawLine(QtCore.QPointF(2, middle.y()), QtCore.QPointF(self.width() - 2, middle.y()))
        painter.drawLine(QtCore.QPointF(middle.x(), 2), QtCore.QPointF(middle.x(), self.height() - 2))
        every = [values for circle in self.circles for values in circle.values]
        top = max((float(values.max()) for values in every), default=0.0)
        if not top > 0:
            return
        for circle in self.circles:
            # What it would be if it was isotropic.
            mean = float(np.concatenate(circle.values).mean()) / top * reach
            painter.setPen(QtGui.QPen(QtGui.QColor(LOOK.theme.strong), 1))
            painter.drawEllipse(middle, mean, mean)
        painter.setPen(QtGui.QPen(QtGui.QColor(self._colour), 1.5))
        for circle in self.circles:
            for angles, values in zip(circle.angles, circle.values, strict=True):
                radii = values / top * reach
                places = np.stack([middle.x() + radii * np.cos(angles), middle.y() - radii * np.sin(angles)], 1)
                painter.drawPolyline(QtGui.QPolygonF([QtCore.QPointF(x, y) for x, y in places.tolist()]))
        painter.setPen(QtCore.Qt.PenStyle.NoPen)
        painter.setBrush(QtGui.QColor(LOOK.theme.text))
        painter.drawEllipse(middle, 1.5, 1.5)
