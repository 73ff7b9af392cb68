"""The matrix of distances among pins, shaded by size: grey, since the colours mean distance from the source."""

from collections.abc import Sequence

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import FloatArray

from ...drawing.numbers import number
from ...drawing.painters.qt import number_width, paint_number
from ...qt.look.look import LOOK, baseline, smooth_painter
from ...qt.look.theme import between
from ...qt.panels.badges import Badge, paint_badge

CELL_HEIGHT_PX = 26
HEAD_WIDTH_PX = 30
PAD_PX = 7
GAP_PX = 1


class PinMatrix(QtWidgets.QWidget):
    """`hovered(i, j)`: the pointer is on the cell of two pins, by their places in the list; -1, -1 if on none."""

    hovered = QtCore.Signal(int, int)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMouseTracking(True)
        self.setAccessibleName("Distances among pins")
        self._pins: tuple[tuple[int, str], ...] = ()
        self._matrix: FloatArray | None = None
        self._texts: list[list[str]] = []
        self._room = 0
        self._across = 0.0  # the width of a column
        self.cell = (-1, -1)
        LOOK.follow(self, self._fit)

    # ------------------------------------------------------------------ what is shown
    def show_matrix(self, pins: Sequence[tuple[int, str]], matrix: FloatArray | None) -> None:
        """Show the distances (k, k) among pins with these numbers and colours, None while they are not known."""
        self._pins, self._matrix = tuple(pins), matrix
        self._texts = [] if matrix is None else [[number(value) for value in row] for row in matrix.tolist()]
        if max(self.cell) >= len(self._pins):
            self._point(-1, -1)
        self._fit()

    def fit_into(self, width: int) -> None:
        """Fill this width with the cells, or make them as wide as they need."""
        if width != self._room:
            self._room = width
            self._fit()

    def _fit(self) -> None:
        font = LOOK.font(13)
        texts = [text for row in self._texts for text in row] or ["0.0000"]
        needed = max(number_width(font, text) for text in texts) + 2 * PAD_PX
        room = (self._room - self._left - 1) / max(len(self._pins), 1)
        self._across = max(needed, min(room, 1.6 * needed))
        self.setFixedSize(round(self._left + self._across * len(self._pins)) + 1, round(self._down(len(self._pins))))
        self.update()

    @property
    def _left(self) -> float:
        return HEAD_WIDTH_PX * LOOK.scale

    def _down(self, row: int) -> float:
        return (CELL_HEIGHT_PX + row * CELL_HEIGHT_PX) * LOOK.scale

    def _rect(self, i: int, j: int) -> QtCore.QRectF:
        across, high = self._across, CELL_HEIGHT_PX * LOOK.scale
        return QtCore.QRectF(self._left + j * across, self._down(i), across - GAP_PX, high - GAP_PX)

    # ------------------------------------------------------------------ painting
    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        theme, painter = LOOK.theme, smooth_painter(self)
        across, high = self._across, CELL_HEIGHT_PX * LOOK.scale
        for k, (label, colour) in enumerate(self._pins):
            top = QtCore.QPointF(self._left + (k + 0.5) * across, high / 2)
            left = QtCore.QPointF(self._left / 2 - 1, self._down(k) + high / 2)
            for place in (top, left):
                paint_badge(painter, place, Badge(str(label), colour))
        if self._matrix is None:
            return
        painter.setFont(LOOK.font(13))
        top = float(np.nanmax(self._matrix, initial=0.0))
        for i in range(len(self._pins)):
            for j in range(len(self._pins)):
                rect = self._rect(i, j)
                if not rect.intersects(QtCore.QRectF(event.rect())):
                    continue
                value = self._matrix[i, j]
                if i != j and top > 0 and not np.isnan(value):
                    painter.fillRect(rect, between(theme.cells, value / top))
                text = "·" if i == j else self._texts[i][j]
                painter.setPen(QtGui.QColor(theme.quiet if i == j else theme.text))
                y = round(baseline(painter, rect.center().y()))
                paint_number(painter, rect.right() - PAD_PX - number_width(painter.font(), text), y, text)
        if self.cell != (-1, -1):
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1.5))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawRect(self._rect(*self.cell).adjusted(0, 0, -0.5, -0.5))

    # ------------------------------------------------------------------ the pointer
    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        across, high = self._across, CELL_HEIGHT_PX * LOOK.scale
        j, i = (event.x() - self._left) // across, (event.y() - self._down(0)) // high
        is_in = 0 <= i < len(self._pins) and 0 <= j < len(self._pins) and i != j
        self._point(*(int(i), int(j)) if is_in else (-1, -1))

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._point(-1, -1)

    def _point(self, i: int, j: int) -> None:
        if (i, j) != self.cell:
            self.cell = (i, j)
            self.hovered.emit(i, j)
            self.update()
