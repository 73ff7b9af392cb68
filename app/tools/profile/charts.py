"""The charts of a profile, side by side: one for all fractions of a maximum, or one for each unit of the values."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray

from ...qt.docks.badges import Badge
from ...qt.look.look import LOOK
from .chart import ProfileChart
from .curves import ProfileCurve, parted

LEAST_WIDTH, LEAST_HEIGHT = 300, 110
"""Logical pixels that a chart has before the next stands below it instead of beside it, and the other way round."""


class ProfileCharts(QtWidgets.QWidget):
    """Charts over the same lengths, with one pointer; `pointed` is emitted as by each of them."""

    pointed = QtCore.Signal(object)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.charts: list[ProfileChart] = []
        self._row = QtWidgets.QBoxLayout(QtWidgets.QBoxLayout.Direction.LeftToRight, self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(0)
        self._add()
        self.setFocusProxy(self.charts[0])

    @property
    def shown(self) -> list[ProfileChart]:
        """Those that show something, the first in any case."""
        return [chart for chart in self.charts if chart is self.charts[0] or not chart.isHidden()]

    @property
    def at(self) -> float | None:
        """The arc length that is marked on all charts, None for none."""
        return self.charts[0].at

    @property
    def arcs(self) -> AnyArray:
        """Arc lengths (k,) of the points of the path."""
        return self.charts[0].arcs

    @property
    def knots(self) -> Sequence[tuple[float, Badge]]:
        """Arc lengths of the points the path was led through, with their badges."""
        return self.charts[0].knots

    @property
    def sentence(self) -> str:
        """What the charts say in place of curves, "" if there are some."""
        return self.charts[0].sentence

    @property
    def curves(self) -> list[ProfileCurve]:
        """Of all charts."""
        return [curve for chart in self.shown for curve in chart.curves]

    # ------------------------------------------------------------------ what is shown
    def say(self, sentence: str) -> None:
        """Why there is nothing to see; "" for nothing."""
        if sentence:
            self._show_count(1)
        self.charts[0].say(sentence)

    def show_path(self, arcs: AnyArray, unit: str, knots: Sequence[tuple[float, Badge]]) -> None:
        """See `ProfileChart.show_path`."""
        for chart in self.charts:
            chart.show_path(arcs, unit, knots)

    def show_curves(self, curves: Sequence[ProfileCurve], in_shares: bool) -> None:
        """Together as shares, else by their units."""
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
        """The line of the pointer in all charts; text: where on the surface that is."""
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
        """In a row where each has room for its words, else one below the other where that gives more."""
        count, ways = len(self.shown), QtWidgets.QBoxLayout.Direction
        is_narrow = self.width() < count * LEAST_WIDTH * LOOK.scale
        is_high = self.height() >= count * LEAST_HEIGHT * LOOK.scale
        self._row.setDirection(ways.TopToBottom if is_narrow and is_high else ways.LeftToRight)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()
