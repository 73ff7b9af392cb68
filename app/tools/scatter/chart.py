"""The scatter of two fields: a picture of how many vertices lie where, selections in it, and a lasso."""

from collections.abc import Sequence

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.analysis.field_scatter import FieldScatter
from bihdist_core.arrays import AnyArray, IntArray

from ...drawing.chart import Axis
from ...qt.docks.chart import Chart, paint_dot
from ...qt.look.look import LOOK
from ...scene.density import cell_size, density_picture
from ...scene.style import PINS

POINTER_REACH_PX = 12.0
"""Pixels from the pointer to the point that it means."""


class ScatterChart(Chart):
    """`lassoed` is emitted with the corners (m, 2) of a lasso in the units of the axes, and the keys that were held."""

    lassoed = QtCore.Signal(object, object)

    LEFT, RIGHT, TOP, BOTTOM = 64.0, 20.0, 10.0, 46.0

    def __init__(self) -> None:
        super().__init__("Scatter of two panels")
        self.scatter: FieldScatter | None = None
        self._names: tuple[tuple[str, str], tuple[str, str]] = (("", ""), ("", ""))
        self._has_diagonal = False
        self._largest: int | None = None  # vertex
        self._marked: int | None = None  # the vertex that is pointed at
        self._selections: Sequence[tuple[AnyArray, int]] = ()
        self._stroke: AnyArray = np.empty(0, np.int64)
        self._stroke_colour = 0
        self._lasso: list[QtCore.QPointF] | None = None
        self._cell = np.empty(0, np.intp)
        self.setCursor(QtCore.Qt.CursorShape.CrossCursor)
        self.setToolTip("Draw around points to select their vertices (Shift adds, Ctrl takes away)")

    # ------------------------------------------------------------------ what is shown
    def show_scatter(
        self,
        scatter: FieldScatter,
        names: tuple[tuple[str, str], tuple[str, str]],
        axes: tuple[Axis, Axis],
        has_diagonal: bool,
    ) -> None:
        """Show a scatter; the names of both fields come with the colours of their panels."""
        self.scatter, self._names, self._has_diagonal, self._largest = scatter, names, has_diagonal, None
        self.sentence = ""
        self.show_axes(*axes)

    def show_nothing(self, sentence: str) -> None:
        """Show a sentence in place of points."""
        self.scatter = None
        self.say(sentence)

    def mark_largest(self, vertex: int | None) -> None:
        """Mark where the fields are farthest apart."""
        self._largest = vertex
        self.update()

    def mark(self, vertex: int | None) -> None:
        """Mark the vertex that is pointed at."""
        if vertex != self._marked:
            self._marked = vertex
            self.update()

    def show_selections(self, selections: Sequence[tuple[AnyArray, int]]) -> None:
        """Show selections of vertices (k,), each with the number of a colour."""
        self._selections = selections
        self.redraw()

    def show_stroke(self, vertices: IntArray, colour: int) -> None:
        """Show the vertices of a brush that is still down."""
        self._stroke, self._stroke_colour = vertices, colour
        self.update()

    def point_of(self, vertex: int) -> QtCore.QPointF | None:
        """Return the place of a vertex in the widget's pixels."""
        if self.scatter is None:
            return None
        place = int(np.searchsorted(self.scatter.ids, vertex))
        if place == len(self.scatter.ids) or self.scatter.ids[place] != vertex:
            return None
        x, y = self.pixels(self.scatter.x[place], self.scatter.y[place])
        return QtCore.QPointF(float(x), float(y))

    def vertex_at(self, x: float, y: float) -> int | None:
        """Return the vertex nearest to a place in the units of the axes, None if it is far on the screen."""
        if self.scatter is None:
            return None
        plot = self.plot
        across = (self.scatter.x - x) * (plot.width() / self.across.span)
        near = np.flatnonzero(np.abs(across) <= POINTER_REACH_PX)
        up = (self.scatter.y[near] - y) * (plot.height() / self.up.span)
        apart = np.hypot(across[near], up)
        return int(self.scatter.ids[near[apart.argmin()]]) if len(apart) and apart.min() <= POINTER_REACH_PX else None

    # ------------------------------------------------------------------ painting
    def paint_content(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        theme = LOOK.theme
        if self._has_diagonal:
            low, high = max(self.across.low, self.up.low), min(self.across.high, self.up.high)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.strong), 1.5, QtCore.Qt.PenStyle.DashLine))
            ends = [QtCore.QPointF(*map(float, self.pixels(value, value))) for value in (low, high)]
            painter.drawLine(*ends)
        if self.scatter is not None:
            painter.drawImage(plot, self._picture(self.scatter, plot))
        painter.setFont(LOOK.font(12))
        metrics = QtGui.QFontMetricsF(painter.font())
        (across, dot), (up, other_dot) = self._names
        width = metrics.horizontalAdvance(across)
        baseline = plot.bottom() + 6 + metrics.ascent() + metrics.height() + 1
        left = plot.center().x() - width / 2
        painter.setPen(QtGui.QColor(theme.text))
        painter.drawText(QtCore.QPointF(left, baseline), across)
        paint_dot(painter, QtCore.QPointF(left - 10, baseline - metrics.xHeight() / 2), dot)
        painter.save()
        painter.translate(14 * LOOK.scale, plot.center().y())
        painter.rotate(-90)
        width = metrics.horizontalAdvance(up)
        painter.setPen(QtGui.QColor(theme.text))
        painter.drawText(QtCore.QPointF(-width / 2, metrics.xHeight() / 2), up)
        paint_dot(painter, QtCore.QPointF(-width / 2 - 10, 0), other_dot)
        painter.restore()

    def _picture(self, scatter: FieldScatter, plot: QtCore.QRectF) -> QtGui.QImage:
        """Return the cells as a picture: grey by the logarithm of their counts, selections in their colours."""
        ratio, size = self.devicePixelRatioF(), cell_size(len(scatter.ids))
        columns, rows = (max(round(side * ratio / size), 1) for side in (plot.width(), plot.height()))
        grid = columns, rows, (self.across.low, self.across.high), (self.up.low, self.up.high)
        chosen = []
        for vertices, colour in self._selections:
            shown = QtGui.QColor(PINS[colour])
            chosen.append((vertices, _rgb(shown.lighter(150) if LOOK.theme.is_dark else shown)))
        pixels = density_picture(scatter, grid, _rgb(QtGui.QColor(LOOK.theme.text)), chosen)
        image = QtGui.QImage(pixels.data, columns, rows, 4 * columns, QtGui.QImage.Format.Format_RGBA8888)
        return image.copy()

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        theme = LOOK.theme
        if len(self._stroke) and self.scatter is not None:
            chosen = np.isin(self.scatter.ids, self._stroke, assume_unique=True)
            x, y = self.pixels(self.scatter.x[chosen], self.scatter.y[chosen])
            places = np.unique(np.round(np.stack([x, y], 1)), axis=0)
            painter.setPen(QtGui.QPen(QtGui.QColor(PINS[self._stroke_colour]), 3))
            painter.drawPoints(QtGui.QPolygonF([QtCore.QPointF(*place) for place in places.tolist()]))
        largest = None if self._largest is None else self.point_of(self._largest)
        if largest is not None:
            for colour, width in ((theme.window, 4.0), (theme.text, 1.75)):
                painter.setPen(QtGui.QPen(QtGui.QColor(colour), width))
                painter.drawLine(largest - QtCore.QPointF(6, 0), largest + QtCore.QPointF(6, 0))
                painter.drawLine(largest - QtCore.QPointF(0, 6), largest + QtCore.QPointF(0, 6))
        marked = None if self._marked is None else self.point_of(self._marked)
        if marked is not None:
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            for colour, width in (("#14161A", 4.5), ("#FFFFFF", 2.0)):
                painter.setPen(QtGui.QPen(QtGui.QColor(colour), width))
                painter.drawEllipse(marked, 6, 6)
        if self._lasso:
            ground = QtGui.QColor(theme.accent)
            ground.setAlphaF(0.14)
            painter.setBrush(ground)
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.accent), 1.5))
            painter.drawPolygon(QtGui.QPolygonF(self._lasso))

    # ------------------------------------------------------------------ the lasso
    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() == QtCore.Qt.MouseButton.LeftButton and self.scatter is not None:
            self._lasso = [QtCore.QPointF(event.pos())]

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        if self._lasso is None:
            super().mouseMoveEvent(event)
        else:
            self._lasso.append(QtCore.QPointF(event.pos()))
            self.update()

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:
        if event.button() != QtCore.Qt.MouseButton.LeftButton or self._lasso is None:
            return
        lasso, self._lasso = self._lasso, None
        self.update()
        if len(lasso) > 2 and self.scatter is not None:
            self.lassoed.emit(np.array([self.values(at) for at in lasso]), event.modifiers())


def _rgb(colour: QtGui.QColor) -> tuple[int, int, int]:
    return colour.red(), colour.green(), colour.blue()
