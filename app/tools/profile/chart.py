"""A chart of a profile: curves of one unit over the length of a path, with their names at their ends."""

from collections.abc import Sequence

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray, FloatArray

from ...qt.docks.badges import BADGE, Badge, paint_badge
from ...qt.docks.chart import Axis, CardLine, Chart, paint_card, paint_dot
from ...qt.look.look import LOOK
from ...qt.look.numbers import number, number_width, paint_number, percent, share
from ...qt.panels.flat_button import paint_ring
from .curves import ProfileCurve

LINE = 2.0
"""Logical pixels of a curve."""

STEP = 0.01
"""Of the path's length, for an arrow key."""

ROOM = 0.04
"""What is left above the highest value, as a share of it."""


class ProfileChart(Chart):
    """`show_at` puts the line of the pointer somewhere along the path."""

    LEFT, BOTTOM = 56.0, 34.0
    TOPS = (12.0, 28.0)  # without and with a unit over the axis

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__("Profile", parent)
        self.arcs = np.array([0.0, 1.0])
        self.curves: Sequence[ProfileCurve] = ()
        self.in_shares = True
        self.knots: Sequence[tuple[float, Badge]] = ()
        self.length_unit = self.unit = ""
        self.at: float | None = None
        self._head = ("", "")
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)

    # ------------------------------------------------------------------ what is shown
    def show_path(self, arcs: AnyArray, unit: str, knots: Sequence[tuple[float, Badge]]) -> None:
        """Points at lengths (k,) in a unit; knots: the lengths at which it goes through marked points."""
        self.arcs, self.length_unit, self.knots = arcs, unit, knots
        self._fit()

    def show_curves(self, curves: Sequence[ProfileCurve], in_shares: bool, unit: str = "") -> None:
        """unit: of the values, where these are drawn and not their shares."""
        self.curves, self.in_shares, self.unit = curves, in_shares, unit
        self._fit()

    @property
    def head_text(self) -> str:
        """Where on the surface the pointer is."""
        return self._head[1]

    def show_at(self, arc: float | None, text: str = "") -> None:
        """The line of the pointer; text: where on the surface that is."""
        if (arc, text) != (self.at, self._head[1]):
            self.at = arc
            length = float(self.arcs[-1])
            self._head = ("" if arc is None else f"at {number(arc)} of {number(length)}", text)
            self.update()

    def plotted(self, curve: ProfileCurve) -> AnyArray:
        """(k,) what is drawn of a curve."""
        return curve.shares if self.in_shares else curve.values

    def _fit(self) -> None:
        """The axes hold all curves, the names at the right have room."""
        is_whole = self.in_shares and not (self.curves and all(curve.is_share for curve in self.curves))
        ends = [(0.0, 1.0 if is_whole else 0.0)]
        for curve in self.curves:
            found = self.plotted(curve)
            if np.isfinite(found).any():
                ends.append((float(np.nanmin(found)), float(np.nanmax(found))))
        low, high = min(low for low, _ in ends), max(high for _, high in ends)
        high = high if is_whole and high <= 1 else high + ROOM * (high - low)
        low = low if low >= 0 else low - ROOM * (high - low)
        font = LOOK.font(12, bold=True)
        names = max((number_width(font, curve.name) for curve in self.curves), default=0.0)
        unit = number_width(LOOK.font(12), self.length_unit) + BADGE
        self.RIGHT = (max(names, unit) + 24) / LOOK.scale
        self.TOP = self.TOPS[bool(self.unit)]
        up = Axis(low, high if high > low else low + 1, in_percent=self.in_shares)
        self.show_axes(Axis(0.0, float(self.arcs[-1]) or 1.0, self.length_unit), up)

    # ------------------------------------------------------------------ the keys
    def event(self, event: QtCore.QEvent) -> bool:
        is_override = event.type() == QtCore.QEvent.Type.ShortcutOverride
        if is_override and event.key() == QtCore.Qt.Key.Key_Escape and self.at is not None:
            event.accept()  # it stops nothing else meanwhile
            return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        """The arrows go along the path, with Shift in larger steps."""
        keys, step = QtCore.Qt.Key, {QtCore.Qt.Key.Key_Left: -1, QtCore.Qt.Key.Key_Right: 1}.get(event.key(), 0)
        if event.key() == keys.Key_Escape and self.at is not None:
            self.pointed.emit(None)
        elif step and not self.sentence:
            large = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ShiftModifier)
            at = 0.0 if self.at is None else self.at + step * STEP * (10 if large else 1) * self.across.high
            self.pointed.emit((min(max(at, 0.0), self.across.high), 0.0))
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.pointed.emit(None)
        self.update()

    # ------------------------------------------------------------------ painting
    def paint_tick(self, painter: QtGui.QPainter, plot: QtCore.QRectF, value: float, x: float) -> None:
        room = number_width(painter.font(), self.across.words(value)) / 2 + BADGE / 2 + 4
        taken = [float(self.pixels(arc, 0)[0]) for arc, _ in self.knots]
        if all(abs(x - other) > room for other in taken):
            super().paint_tick(painter, plot, value, x)

    def paint_content(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        if self.up.low < 0:
            y = round(float(self.pixels(0, 0)[1]))
            painter.fillRect(QtCore.QRectF(plot.left(), y, plot.width(), 1), QtGui.QColor(LOOK.theme.strong))
        ends = []
        painter.save()
        painter.setClipRect(plot.adjusted(-2, -4, 2, 4))
        for curve in self.curves:
            found = self.plotted(curve)
            pen = QtGui.QPen(QtGui.QColor(curve.colour), LINE)
            pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)
            pen.setCapStyle(QtCore.Qt.PenCapStyle.RoundCap)
            if curve.is_dashed:
                pen.setDashPattern([4, 3])
            painter.setPen(pen)
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            for line in _lines(*self.pixels(self.arcs, found)):
                painter.drawPolyline(line)
            known = np.flatnonzero(np.isfinite(found))
            if len(known):
                ends.append((float(self.pixels(0, found[known[-1]])[1]), curve))
        painter.restore()
        self._paint_names(painter, plot, ends)
        self._paint_foot(painter, plot)

    def _paint_names(
        self, painter: QtGui.QPainter, plot: QtCore.QRectF, ends: Sequence[tuple[float, ProfileCurve]]
    ) -> None:
        """Each at the end of its curve, below the one before it."""
        painter.setFont(LOOK.font(12, bold=True))
        metrics = QtGui.QFontMetricsF(painter.font())
        step, rise = metrics.height(), (metrics.ascent() - metrics.descent()) / 2
        ends = sorted(ends, key=lambda end: end[0])
        places = apart([y for y, _ in ends], step, plot.top(), plot.bottom())
        for y, (_, curve) in zip(places, ends, strict=True):
            painter.setPen(QtGui.QColor(curve.colour))
            painter.drawText(QtCore.QPointF(plot.right() + 12, round(y + rise)), curve.name)

    def _paint_foot(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """The points that the path goes through, and the units."""
        painter.setFont(LOOK.font(12))
        metrics = QtGui.QFontMetricsF(painter.font())
        if self.unit:
            painter.setPen(QtGui.QColor(LOOK.theme.quiet))
            paint_number(painter, 12, round(plot.top() - 6 - metrics.descent()), self.unit)
        baseline = self.baseline(plot, metrics)
        middle = baseline - (metrics.ascent() - metrics.descent()) / 2
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        paint_number(painter, plot.right() + BADGE / 2 + 6, baseline, self.length_unit)
        for arc, badge in self.knots:
            paint_badge(painter, QtCore.QPointF(float(self.pixels(arc, 0)[0]), middle), badge)

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        if self.hasFocus():
            paint_ring(painter, QtCore.QRectF(self.rect()))
        if self.at is None or not self.curves:
            return
        theme = LOOK.theme
        x = float(self.pixels(self.at, 0)[0])
        painter.fillRect(QtCore.QRectF(round(x), plot.top(), 1, plot.height()), QtGui.QColor(theme.text))
        lines, heights = [], []
        for curve in self.curves:
            height = float(value_at(self.arcs, self.plotted(curve), self.at))
            if np.isfinite(height):
                heights.append(float(self.pixels(0, height)[1]))
                paint_dot(painter, QtCore.QPointF(round(x) + 0.5, heights[-1]), curve.colour)
            text = _words(curve, float(value_at(self.arcs, curve.values, self.at)))
            lines.append(CardLine(curve.name, text, curve.colour))
        is_low = bool(heights) and float(np.mean(heights)) < plot.center().y()
        paint_card(painter, QtCore.QPointF(x, 0), plot, self._head, lines, is_low)


def _words(curve: ProfileCurve, at: float) -> tuple[str, str]:
    """A value, and its share, for the card."""
    if np.isnan(at):
        return "–", ""
    if curve.is_share:
        return "", number(at, signed=True) + percent(curve.unit)
    part = share(at / curve.whole, curve.is_signed) if curve.whole > 0 else ""
    return number(at, curve.is_signed), part


def value_at(arcs: AnyArray, values: FloatArray, arc: float) -> float:
    """Between two points values (k,) change linearly; NaN next to where there are none."""
    k = int(np.clip(np.searchsorted(arcs, arc, side="right") - 1, 0, len(arcs) - 2))
    span = arcs[k + 1] - arcs[k]
    t = min(max((arc - arcs[k]) / span, 0.0), 1.0) if span > 0 else 0.0
    if t in (0.0, 1.0):
        return float(values[k + int(t)])
    return float((1 - t) * values[k] + t * values[k + 1])


def apart(places: Sequence[float], step: float, low: float, high: float) -> list[float]:
    """Places that go up, at least a step from each other, near where they were and, as far as they fit, inside."""
    found = list(places)
    for k, place in enumerate(found):
        found[k] = max(place, low if k == 0 else found[k - 1] + step)
    over = high
    for k in range(len(found) - 1, -1, -1):
        found[k] = min(found[k], over)
        over = found[k] - step
    return found


def _lines(x: AnyArray, y: AnyArray) -> list[QtGui.QPolygonF]:
    """The parts of a curve between places where it has no value."""
    known = np.isfinite(y)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], known, [False]]).astype(int)))
    return [
        QtGui.QPolygonF([QtCore.QPointF(a, b) for a, b in zip(x[i:j].tolist(), y[i:j].tolist(), strict=True)])
        for i, j in edges.reshape(-1, 2)
    ]
