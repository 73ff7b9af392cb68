"""The charts of a profile, side by side: one for all fractions of a maximum, or one for each unit of the values."""

from collections.abc import Sequence

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray, FloatArray

from ...drawing.chart import Axis
from ...drawing.numbers import number, percent, share
from ...drawing.painters.qt import number_width, paint, paint_number, rgba_of, text_width
from ...drawing.shapes import Pen
from ...qt.docks.chart import FONT, CardLine, CurveChart
from ...qt.look.form import in_row
from ...qt.look.look import LOOK, baseline
from ...qt.panels.badges import RADIUS, Badge, paint_badge
from .curves import ProfileCurve, parted

LINE_WIDTH_PX, EDGE_PX = 2.0, 3.0
"""Logical pixels of a curve, and of what is seen of it outside of the plot."""

HEADROOM = 0.04
"""The room above the highest value, as a fraction of it."""

MIN_CHART_WIDTH_PX, MIN_CHART_HEIGHT_PX = 300, 110
"""Logical pixels that a chart has before the next stands below it instead of beside it, and the other way round."""


class ProfileChart(CurveChart):
    """Curves of one unit over the length of a path, with their names at their ends."""

    LEFT, BOTTOM = 56.0, 34.0
    TOPS = (12.0, 28.0)  # without and with a unit over the axis

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__("Profile", parent)
        self.arcs = np.array([0.0, 1.0])
        self.curves: Sequence[ProfileCurve] = ()
        self.in_shares = True
        self.knots: Sequence[tuple[float, Badge]] = ()
        self.length_unit = self.unit = ""
        self._head = ("", "")

    # ------------------------------------------------------------------ what is shown
    def show_path(self, arcs: AnyArray, unit: str, knots: Sequence[tuple[float, Badge]]) -> None:
        """Show a path with points at these lengths (k,) in a unit; knots are the lengths of the points that it was
        led through."""
        self.arcs, self.length_unit, self.knots = arcs, unit, knots
        self._fit()

    def show_curves(self, curves: Sequence[ProfileCurve], in_shares: bool, unit: str = "") -> None:
        """Show curves, as fractions of their maxima or in the unit of the values."""
        self.curves, self.in_shares, self.unit = curves, in_shares, unit
        self._fit()

    @property
    def head_text(self) -> str:
        """The place of the pointer on the surface, in words."""
        return self._head[1]

    def show_at(self, arc: float | None, text: str = "") -> None:
        """Show the line of the pointer; the text says where that is on the surface."""
        if (arc, text) != (self.at, self._head[1]):
            self.at = arc
            length = float(self.arcs[-1])
            self._head = ("" if arc is None else f"at {number(arc)} of {number(length)}", text)
            self.update()

    def plotted(self, curve: ProfileCurve) -> AnyArray:
        """Return the values (k,) that are drawn of a curve."""
        return curve.shares if self.in_shares else curve.values

    def _fit(self) -> None:
        """Fit the axes to all curves, with room for the names at the right."""
        is_whole = self.in_shares and not (self.curves and all(curve.is_share for curve in self.curves))
        ends = [(0.0, 1.0 if is_whole else 0.0)]
        for curve in self.curves:
            found = self.plotted(curve)
            if np.isfinite(found).any():
                ends.append((float(np.nanmin(found)), float(np.nanmax(found))))
        low, high = min(low for low, _ in ends), max(high for _, high in ends)
        high = high if is_whole and high <= 1 else high + HEADROOM * (high - low)
        low = low if low >= 0 else low - HEADROOM * (high - low)
        font = LOOK.font(12, bold=True)
        names = max((number_width(font, curve.name) for curve in self.curves), default=0.0)
        unit = number_width(LOOK.font(12), self.length_unit) + 2 * RADIUS
        self.RIGHT = (max(names, unit) + 24) / LOOK.scale
        self.TOP = self.TOPS[bool(self.unit)]
        up = Axis(low, high if high > low else low + 1, in_percent=self.in_shares)
        self.show_axes(Axis(0.0, float(self.arcs[-1]) or 1.0, self.length_unit), up)

    # ------------------------------------------------------------------ painting
    def is_free(self, x: float, words: str) -> bool:
        room = text_width(words, FONT * LOOK.scale) / 2 + RADIUS + 4
        return all(abs(x - float(self.pixels(arc, 0)[0])) > room for arc, _ in self.knots)

    def paint_content(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        if self.up.low < 0:
            y = round(float(self.pixels(0, 0)[1]))
            painter.fillRect(QtCore.QRectF(plot.left(), y, plot.width(), 1), QtGui.QColor(LOOK.theme.strong))
        ends, curves, shown = [], [], self.shown
        for curve in self.curves:
            found = self.plotted(curve)
            pen = Pen(rgba_of(curve.colour), LINE_WIDTH_PX, (4.0, 3.0) if curve.is_dashed else (), "round", "round")
            path = shown.curve(self.arcs, found, pen)
            if path is not None:
                curves.append(path)
                ends.append((float(self.pixels(0, found[np.isfinite(found)][-1])[1]), curve))
        paint(painter, [shown.clipped(curves, EDGE_PX)])
        self._paint_names(painter, plot, ends)
        self._paint_foot(painter, plot)

    def _paint_names(
        self, painter: QtGui.QPainter, plot: QtCore.QRectF, ends: Sequence[tuple[float, ProfileCurve]]
    ) -> None:
        """Write each name at the end of its curve, below the one before it."""
        painter.setFont(LOOK.font(12, bold=True))
        step = QtGui.QFontMetricsF(painter.font()).height()
        ends = sorted(ends, key=lambda end: end[0])
        places = apart([y for y, _ in ends], step, plot.top(), plot.bottom())
        for y, (_, curve) in zip(places, ends, strict=True):
            painter.setPen(QtGui.QColor(curve.colour))
            painter.drawText(QtCore.QPointF(plot.right() + 12, round(baseline(painter, y))), curve.name)

    def _paint_foot(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """Paint the points that the path goes through, and the units."""
        painter.setFont(LOOK.font(12))
        metrics = QtGui.QFontMetricsF(painter.font())
        if self.unit:
            painter.setPen(QtGui.QColor(LOOK.theme.quiet))
            paint_number(painter, 12, round(plot.top() - 6 - metrics.descent()), self.unit)
        y = self.baseline(plot, metrics)
        middle = y - (metrics.ascent() - metrics.descent()) / 2
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        paint_number(painter, plot.right() + RADIUS + 6, y, self.length_unit)
        for arc, badge in self.knots:
            paint_badge(painter, QtCore.QPointF(float(self.pixels(arc, 0)[0]), middle), badge)

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        heights, lines, at = [], [], self.at or 0.0
        for curve in self.curves:
            heights.append((value_at(self.arcs, self.plotted(curve), at), curve.colour))
            lines.append(CardLine(curve.name, _words(curve, value_at(self.arcs, curve.values, at)), curve.colour))
        self.paint_line(painter, plot, heights, self._head, lines)


def _words(curve: ProfileCurve, at: float) -> tuple[str, str]:
    """Return a value and its fraction of the maximum, for the card."""
    if np.isnan(at):
        return "–", ""
    if curve.is_share:
        return "", number(at, signed=True) + percent(curve.unit)
    return number(at, curve.is_signed), share(at / curve.whole, curve.is_signed) if curve.whole > 0 else ""


def value_at(arcs: AnyArray, values: FloatArray, arc: float) -> float:
    """Return the value at an arc length, linear between points with values (k,); NaN next to where there are none."""
    k = int(np.clip(np.searchsorted(arcs, arc, side="right") - 1, 0, len(arcs) - 2))
    span = arcs[k + 1] - arcs[k]
    t = min(max((arc - arcs[k]) / span, 0.0), 1.0) if span > 0 else 0.0
    if t in (0.0, 1.0):
        return float(values[k + int(t)])
    return float((1 - t) * values[k] + t * values[k + 1])


def apart(places: Sequence[float], step: float, low: float, high: float) -> list[float]:
    """Return places that go up, at least a step from each other, near where they were and, as far as they fit,
    inside."""
    found = list(places)
    for k, place in enumerate(found):
        found[k] = max(place, low if k == 0 else found[k - 1] + step)
    over = high
    for k in range(len(found) - 1, -1, -1):
        found[k] = min(found[k], over)
        over = found[k] - step
    return found


class ProfileCharts(QtWidgets.QWidget):
    """Charts over the same lengths, with one pointer; `pointed` is emitted as by each of them."""

    pointed = QtCore.Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.charts: list[ProfileChart] = []
        self._row = in_row(of=self, spacing=0)
        self._add()
        self.setFocusProxy(self.charts[0])

    @property
    def shown(self) -> list[ProfileChart]:
        """The charts that show something, and the first in any case."""
        return [chart for chart in self.charts if chart is self.charts[0] or not chart.isHidden()]

    @property
    def sentence(self) -> str:
        """The sentence in place of curves, "" if there are some."""
        return self.charts[0].sentence

    @property
    def curves(self) -> list[ProfileCurve]:
        """The curves of all charts."""
        return [curve for chart in self.shown for curve in chart.curves]

    # ------------------------------------------------------------------ what is shown
    def say(self, sentence: str) -> None:
        """Show why there are no curves, or "" for nothing."""
        if sentence:
            self._show_count(1)
        self.charts[0].say(sentence)

    def show_path(self, arcs: AnyArray, unit: str, knots: Sequence[tuple[float, Badge]]) -> None:
        """See `ProfileChart.show_path`."""
        for chart in self.charts:
            chart.show_path(arcs, unit, knots)

    def show_curves(self, curves: Sequence[ProfileCurve], in_shares: bool) -> None:
        """Show curves in one chart as fractions of their maxima, or in a chart for each unit."""
        parts = parted(curves, in_shares) or [("", in_shares, [])]
        first = self.charts[0]
        while len(self.charts) < len(parts):
            self._add()
            self.charts[-1].show_path(first.arcs, first.length_unit, first.knots)
            self.charts[-1].show_at(first.at, first.head_text)
        for chart, (unit, are_shares, some) in zip(self.charts, parts, strict=False):
            chart.show_curves(some, are_shares, unit)
        self._show_count(len(parts))

    def show_at(self, arc: float | None, text: str = "") -> None:
        """Show the line of the pointer in all charts; the text says where that is on the surface."""
        for chart in self.charts:
            chart.show_at(arc, text)

    # ------------------------------------------------------------------ side by side
    def _add(self) -> None:
        chart = ProfileChart(self)
        chart.pointed.connect(self.pointed)
        self.charts.append(chart)
        self._row.addWidget(chart, 1)

    def _show_count(self, count: int) -> None:
        for k, chart in enumerate(self.charts):
            chart.setVisible(k < count)
        self._arrange()

    def _arrange(self) -> None:
        """Arrange the charts side by side if each has room for its words, else below each other if that gives more
        room."""
        count, ways = len(self.shown), QtWidgets.QBoxLayout.Direction
        is_narrow = self.width() < count * MIN_CHART_WIDTH_PX * LOOK.scale
        is_high = self.height() >= count * MIN_CHART_HEIGHT_PX * LOOK.scale
        self._row.setDirection(ways.TopToBottom if is_narrow and is_high else ways.LeftToRight)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()
