"""The chart of maps' errors: which share of the vertices is at most so far from where it belongs; and its table."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.applications.map_errors import LIMIT, ErrorCurve

from ...drawing.chart import Axis
from ...drawing.numbers import number, share
from ...drawing.painters.qt import number_width, paint, paint_number, rgba_of
from ...drawing.shapes import Pen
from ...qt.docks.chart import CardLine, CurveChart
from ...qt.docks.fact_table import FactTable
from ...qt.look.look import LOOK

LINE_WIDTH_PX, EDGE_PX = 2.0, 2.0
"""Logical pixels of a curve, and of what is seen of it outside of the plot."""

THRESHOLD_STEPS = 500
"""Thresholds at which curves are drawn."""

ACROSS = "geodesic error / √area"


@dataclass(frozen=True, eq=False)
class MapCurve:
    """A map's errors under a name, in a colour."""

    name: str
    colour: str
    errors: ErrorCurve


class ErrorChart(CurveChart):
    """The error curves of maps, with a line at the threshold under the pointer, `at`."""

    LEFT, RIGHT, TOP, BOTTOM = 46.0, 14.0, 8.0, 46.0
    HEIGHT = 208.0
    APART = (44.0, 40.0)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__("Errors of maps", parent)
        self.curves: Sequence[MapCurve] = ()
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

    def _point(self, at: tuple[float, float] | None) -> None:
        self.at = None if at is None else min(max(at[0], 0.0), LIMIT)
        self.update()

    @property
    def _shares(self) -> list[float]:
        """The share of the vertices with errors up to the threshold, for each map."""
        return [] if self.at is None else [float(curve.errors.fractions(self.at)) for curve in self.curves]

    @property
    def lines(self) -> list[CardLine]:
        """The lines of the card at the threshold under the pointer."""
        return [
            CardLine(curve.name, (share(each),), curve.colour)
            for curve, each in zip(self.curves, self._shares, strict=self.at is not None)
        ]

    # ------------------------------------------------------------------ painting
    def paint_content(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        thresholds = np.linspace(0, LIMIT, THRESHOLD_STEPS + 1)
        shown, curves = self.shown, []
        for each in self.curves:
            pen = Pen(rgba_of(each.colour), LINE_WIDTH_PX, join="round")
            curves.append(shown.curve(thresholds, each.errors.fractions(thresholds), pen))
        paint(painter, [shown.clipped([curve for curve in curves if curve], EDGE_PX)])
        painter.setFont(LOOK.font(12))
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        metrics = QtGui.QFontMetricsF(painter.font())
        baseline = self.baseline(plot, metrics) + metrics.height() + 1
        paint_number(painter, plot.center().x() - number_width(painter.font(), ACROSS) / 2, baseline, ACROSS)

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        heights = [(each, curve.colour) for curve, each in zip(self.curves, self._shares, strict=False)]
        head = "" if self.at is None else f"error up to {number(self.at)}"
        self.paint_line(painter, plot, heights, (head, ""), self.lines)


class ErrorTable(FactTable):
    """A line for each curve: its dot and name, the mean and the median error, and the area under it."""

    HEADS, SHORT_HEADS = ("mean", "median", "area under"), ("mean", "median", "area")
    LINE, HEAD = 26.0, 24.0

    def show_rows(self, rows: Sequence[MapCurve], failures: Sequence[tuple[str, str, str]] = ()) -> None:
        """Show curves, and the names, colours and reasons of maps that have none, in tips."""
        facts = [(row.name, *map(_format_error, (row.errors.mean, row.errors.median, row.errors.area))) for row in rows]
        facts += [(name, "–", "–", "–") for name, _, _ in failures]
        colours = [*(row.colour for row in rows), *(colour for _, colour, _ in failures)]
        self.show_facts(facts, dict(enumerate(colours)))
        self.setToolTip("\n".join(f"{name}: {why}" for name, _, why in failures))


def _format_error(error: float) -> str:
    return "∞" if np.isinf(error) else number(error)
