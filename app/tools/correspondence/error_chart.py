"""The chart of maps' errors: which share of the vertices is at most so far from where it belongs; and its table."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.applications.map_errors import LIMIT, ErrorCurve

from ...qt.docks.chart import Axis, CardLine, Chart, paint_card, paint_dot
from ...qt.look.look import LOOK
from ...qt.look.numbers import number, number_width, paint_number, share

LINE = 2.0
"""Logical pixels of a curve."""

STEPS = 500
"""Thresholds at which curves are drawn."""

GAP = 12
"""Logical pixels between two columns of numbers."""

ACROSS = "geodesic error / √area"

STEP = 0.0025
"""Of the thresholds, for an arrow key."""


@dataclass(frozen=True, eq=False)
class MapCurve:
    """A map's errors under a name, in a colour."""

    name: str
    colour: str
    errors: ErrorCurve


class ErrorChart(Chart):
    """`show_at` puts the line of the pointer at a threshold."""

    LEFT, RIGHT, TOP, BOTTOM = 46.0, 14.0, 8.0, 46.0
    HEIGHT = 208.0
    APART = (44.0, 40.0)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__("Errors of maps", parent)
        self.curves: Sequence[MapCurve] = ()
        self.at: float | None = None
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.show_axes(Axis(0.0, LIMIT), Axis(0.0, 1.0, in_percent=True))
        self.pointed.connect(self._point)
        LOOK.follow(self, self._fit)
        self._fit()

    def _fit(self) -> None:
        self.setFixedHeight(round(self.HEIGHT * LOOK.scale))

    def show_curves(self, curves: Sequence[MapCurve]) -> None:
        """Show a curve for each map."""
        self.curves = curves
        self.redraw()

    def show_at(self, threshold: float | None) -> None:
        """Mark a threshold on the curves, None for none."""
        if threshold != self.at:
            self.at = threshold
            self.update()

    def _point(self, at: tuple[float, float] | None) -> None:
        self.show_at(None if at is None else min(max(at[0], 0.0), LIMIT))

    @property
    def lines(self) -> list[CardLine]:
        """What the card says at the threshold of the pointer."""
        if self.at is None:
            return []
        shares = [float(curve.errors.shares(self.at)) for curve in self.curves]
        return [
            CardLine(curve.name, (share(each),), curve.colour) for curve, each in zip(self.curves, shares, strict=True)
        ]

    # ------------------------------------------------------------------ the keys
    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        """The arrows move the threshold, with Shift in larger steps."""
        keys, step = QtCore.Qt.Key, {QtCore.Qt.Key.Key_Left: -1, QtCore.Qt.Key.Key_Right: 1}.get(event.key(), 0)
        if event.key() == keys.Key_Escape and self.at is not None:
            self.show_at(None)
        elif step and self.curves and not self.sentence:
            large = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ShiftModifier)
            at = 0.0 if self.at is None else self.at + step * STEP * (10 if large else 1)
            self.show_at(min(max(at, 0.0), LIMIT))
        else:
            super().keyPressEvent(event)

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.show_at(None)

    # ------------------------------------------------------------------ painting
    def paint_content(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        thresholds = np.linspace(0, LIMIT, STEPS + 1)
        painter.save()
        painter.setClipRect(plot.adjusted(-2, -3, 2, 3))
        painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
        for curve in self.curves:
            pen = QtGui.QPen(QtGui.QColor(curve.colour), LINE)
            pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)
            painter.setPen(pen)
            x, y = self.pixels(thresholds, curve.errors.shares(thresholds))
            points = [QtCore.QPointF(a, b) for a, b in zip(x.tolist(), y.tolist(), strict=True)]
            painter.drawPolyline(QtGui.QPolygonF(points))
        painter.restore()
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        metrics = QtGui.QFontMetricsF(painter.font())
        baseline = self.baseline(plot, metrics) + metrics.height() + 1
        paint_number(painter, plot.center().x() - number_width(painter.font(), ACROSS) / 2, baseline, ACROSS)

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        if self.at is None or not self.curves:
            return
        x = float(self.pixels(self.at, 0)[0])
        painter.fillRect(QtCore.QRectF(round(x), plot.top(), 1, plot.height()), QtGui.QColor(LOOK.theme.text))
        shares = [float(curve.errors.shares(self.at)) for curve in self.curves]
        for curve, each in zip(self.curves, shares, strict=True):
            paint_dot(painter, QtCore.QPointF(round(x) + 0.5, float(self.pixels(0, each)[1])), curve.colour)
        is_low = float(np.mean(shares)) > 0.5
        paint_card(painter, QtCore.QPointF(x, 0), plot, (f"error up to {number(self.at)}", ""), self.lines, is_low)


class ErrorTable(QtWidgets.QWidget):
    """A line for each curve: its dot and name, the mean and the median error, and the area under it."""

    COLUMNS, NARROW = ("mean", "median", "area under"), ("mean", "median", "area")
    HEAD, ROW, DOT = 24.0, 26.0, 8.0

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.rows: Sequence[MapCurve] = ()
        self.failures: Sequence[tuple[str, str, str]] = ()
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        LOOK.follow(self, self._fit)

    def show_rows(self, rows: Sequence[MapCurve], failures: Sequence[tuple[str, str, str]] = ()) -> None:
        """failures: name, colour and why there is no curve, in the tip of the line."""
        self.rows, self.failures = rows, failures
        self.setAccessibleDescription("; ".join(" ".join((row.name, *self.numbers(row))) for row in rows))
        self.setToolTip("\n".join(f"{name}: {why}" for name, _, why in failures))
        self._fit()

    @staticmethod
    def numbers(row: MapCurve) -> tuple[str, str, str]:
        """Of a line."""
        mean, median, area = (
            "∞" if np.isinf(x) else number(x) for x in (row.errors.mean, row.errors.median, row.errors.area)
        )
        return mean, median, area

    def sizeHint(self) -> QtCore.QSize:
        count = len(self.rows) + len(self.failures)
        return QtCore.QSize(200, round((self.HEAD + self.ROW * count) * LOOK.scale) if count else 0)

    minimumSizeHint = sizeHint

    def _fit(self) -> None:
        self.updateGeometry()
        self.update()

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        lines = [(row.name, row.colour, self.numbers(row)) for row in self.rows]
        lines += [(name, colour, ("–", "–", "–")) for name, colour, _ in self.failures]
        if not lines:
            return
        painter, theme, scale = QtGui.QPainter(self), LOOK.theme, LOOK.scale
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        small, usual = LOOK.font(12), LOOK.font(13)
        left, heads = self.DOT + 8, self.COLUMNS
        names = max(QtGui.QFontMetricsF(usual).horizontalAdvance(name) for name, _, _ in lines)
        widths = self._columns(heads, lines, small, usual)
        if left + names + sum(widths) > self.width():
            heads = self.NARROW
            widths = self._columns(heads, lines, small, usual)
        rights = [self.width() - sum(widths[k + 1 :]) for k in range(3)]
        painter.setFont(small)
        painter.setPen(QtGui.QColor(theme.quiet))
        metrics = QtGui.QFontMetricsF(small)
        baseline = (self.HEAD * scale + metrics.ascent() - metrics.descent()) / 2
        for words, right in zip(heads, rights, strict=True):
            painter.drawText(QtCore.QPointF(right - metrics.horizontalAdvance(words), baseline), words)
        painter.setFont(usual)
        metrics = QtGui.QFontMetricsF(usual)
        for k, (name, colour, numbers) in enumerate(lines):
            top = (self.HEAD + self.ROW * k) * scale
            baseline = top + (self.ROW * scale + metrics.ascent() - metrics.descent()) / 2
            painter.setPen(QtCore.Qt.PenStyle.NoPen)
            painter.setBrush(QtGui.QColor(colour))
            painter.drawEllipse(QtCore.QPointF(self.DOT / 2, top + self.ROW * scale / 2), self.DOT / 2, self.DOT / 2)
            painter.setPen(QtGui.QColor(theme.text))
            first = rights[0] - number_width(usual, numbers[0])
            cut = metrics.elidedText(name, QtCore.Qt.TextElideMode.ElideRight, max(first - left - 8, 0))
            painter.drawText(QtCore.QPointF(left, baseline), cut)
            for text, right in zip(numbers, rights, strict=True):
                paint_number(painter, right - number_width(usual, text), baseline, text)

    @staticmethod
    def _columns(
        heads: Sequence[str], lines: Sequence[tuple[Any, ...]], small: QtGui.QFont, usual: QtGui.QFont
    ) -> list[float]:
        """The widths of the columns of numbers, with the air before each."""
        metrics = QtGui.QFontMetricsF(small)
        return [
            max(metrics.horizontalAdvance(words), *(number_width(usual, line[2][k]) for line in lines))
            + GAP * LOOK.scale
            for k, words in enumerate(heads)
        ]
