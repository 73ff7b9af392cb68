"""The histogram of a field by area, in the colours of its panel's bar."""

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray, FloatArray

from ...drawing.numbers import number, percent, share, tick, ticks
from ...drawing.painters.qt import number_width, paint_number
from ...qt.look.look import LOOK

HEIGHT_PX = 128
PAD_PX = 2.0
MIN_BAR_PX = 1.0
"""Pixels of the least area that there is."""


class Histogram(QtWidgets.QWidget):
    """`pointed` is emitted with what a bin under the pointer holds, in words, "" beside them."""

    pointed = QtCore.Signal(str)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._ends, self._shares = np.empty(0), np.empty(0)
        self._colours = np.empty((0, 3))
        self._unit, self._is_signed = "", False
        self._under: int | None = None
        self.setMouseTracking(True)
        self.setAccessibleName("Histogram by area")
        self.setFixedHeight(HEIGHT_PX)
        LOOK.follow(self, self.update)

    def show_bins(self, ends: AnyArray, areas: AnyArray, colours: FloatArray, unit: str, is_signed: bool) -> None:
        """Show bins between ends (b + 1,) with areas (b,) and colours (b, 3) from 0 to 1, in the unit of the values."""
        total = areas.sum()
        self._ends, self._shares = ends, areas / total if total > 0 else areas
        self._colours, self._unit, self._is_signed = colours, unit, is_signed
        self._under = None
        self.update()

    @property
    def bars(self) -> list[QtCore.QRectF]:
        """Return the rectangles of the bins."""
        if not len(self._shares) or not self._shares.max() > 0:
            return []
        left, width = PAD_PX, (self.width() - 2 * PAD_PX) / len(self._shares)
        bottom = self.height() - 24 * LOOK.scale
        tallest = bottom - 6
        heights = np.where(self._shares > 0, np.maximum(tallest * self._shares / self._shares.max(), MIN_BAR_PX), 0)
        return [
            QtCore.QRectF(left + k * width, bottom - height, max(width - 1, 1), height)
            for k, height in enumerate(heights)
        ]

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        bars = self.bars
        if not bars:
            return
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        bottom = bars[0].bottom()
        low, high = float(self._ends[0]), float(self._ends[-1])
        edge = QtGui.QColor(theme.quiet)
        edge.setAlphaF(0.55)
        for k, bar in enumerate(bars):
            if bar.height() <= 0:
                continue
            painter.fillRect(bar, QtGui.QColor.fromRgbF(*np.clip(self._colours[k], 0, 1)))
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.text) if k == self._under else edge, 1))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawRect(bar.adjusted(0.5, 0.5, -0.5, -0.5))
        painter.fillRect(QtCore.QRectF(PAD_PX, bottom, self.width() - 2 * PAD_PX, 1), QtGui.QColor(theme.border))
        painter.setFont(LOOK.font(12))
        metrics = QtGui.QFontMetricsF(painter.font())
        painter.setPen(QtGui.QColor(theme.quiet))
        for value in ticks(low, high, max(int(self.width() / 72), 2)):
            words = self._tick(value)
            x = PAD_PX + (value - low) / ((high - low) or 1) * (self.width() - 2 * PAD_PX)
            width = number_width(painter.font(), words)
            x = min(max(x - width / 2, 0), self.width() - width)
            paint_number(painter, x, round(bottom + 5 + metrics.ascent()), words)

    def _tick(self, value: float) -> str:
        plus = "+" if self._is_signed and value > 0 else ""
        return f"{plus}{tick(value)}{percent(self._unit) if value else ''}"

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        bars = self.bars
        x = event.pos().x()
        under = next((k for k, bar in enumerate(bars) if bar.left() <= x <= bar.right() + 1), None)
        if under != self._under:
            self._under = under
            self.update()
            self.pointed.emit("" if under is None else self._words(under))

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._under = None
        self.update()
        self.pointed.emit("")

    def _words(self, k: int) -> str:
        def written(value: float) -> str:
            return number(value, self._is_signed) + percent(self._unit)

        low, high = written(float(self._ends[k])), written(float(self._ends[k + 1]))
        return f"{low} to {high}: {share(float(self._shares[k]))}"
