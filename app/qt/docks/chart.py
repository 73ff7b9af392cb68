"""What every chart in a dock has: axes with round ticks, the pointer, and a card that says what is under it.

Painted with QPainter in the window's own fonts, digits and colours.  What takes long is painted once into a picture and
kept, so that the pointer costs next to nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray

from ..look.look import LOOK
from ..look.numbers import number_width, paint_number, tick, ticks

LEAST_APART = (72.0, 22.0)
"""Logical pixels between two ticks, across and up."""

CARD_PAD, CARD_LINE, CARD_DOT, CARD_GAP = 9.0, 18.0, 8.0, 16.0


@dataclass(frozen=True)
class Axis:
    """From low to high; unit: written at its end; in_percent: the values are shares of 1."""

    low: float = 0.0
    high: float = 1.0
    unit: str = ""
    in_percent: bool = False

    @property
    def span(self) -> float:
        """The length of the axis in its own unit, 1 for an empty one."""
        return (self.high - self.low) or 1.0

    def ticks(self, room: float, apart: float) -> list[float]:
        """Round values that have so many pixels between them, in as many pixels."""
        scale = 100 if self.in_percent else 1
        most = max(int(room / (apart * LOOK.scale)), 2)
        return [value / scale for value in ticks(self.low * scale, self.high * scale, most)]

    def words(self, value: float, is_end: bool = False) -> str:
        """Of a tick; the sign for percent stands at the last one only."""
        if not self.in_percent:
            return tick(value)
        return f"{tick(100 * value)} %" if is_end else tick(100 * value)


@dataclass(frozen=True)
class CardLine:
    """A line of a card: a dot in a colour if there is one, then words, and numbers at the right."""

    words: str
    numbers: tuple[str, ...] = ()
    colour: str = ""


class Chart(QtWidgets.QWidget):
    """See the module.  A subclass paints what is in it (`paint_content`, kept) and over it (`paint_over`, each time).

    `pointed` is emitted with (x, y) in the units of the axes, or with None when the pointer leaves.
    """

    pointed = QtCore.Signal(object)

    LEFT, RIGHT, TOP, BOTTOM = 56.0, 24.0, 10.0, 30.0
    """Logical pixels about the plot, before the letters are enlarged."""

    APART = LEAST_APART

    def __init__(self, name: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.across, self.up = Axis(), Axis()
        self.sentence = ""
        self._kept: QtGui.QPixmap | None = None
        self.setAccessibleName(name)
        self.setMouseTracking(True)
        self.setMinimumSize(160, 96)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Expanding)
        LOOK.follow(self, self.redraw)

    # ------------------------------------------------------------------ for subclasses
    def paint_content(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """What is plotted, over the grid; kept until `redraw`."""

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """What moves with the pointer."""

    def paint_ticks(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """Grid lines and the words at both axes."""
        theme = LOOK.theme
        painter.setFont(LOOK.font(12))
        metrics = QtGui.QFontMetricsF(painter.font())
        rise = (metrics.ascent() - metrics.descent()) / 2
        rows = self.up.ticks(plot.height(), self.APART[1])
        for value in rows:
            y = round(float(self.pixels(self.across.low, value)[1]))
            painter.fillRect(QtCore.QRectF(plot.left(), y, plot.width(), 1), QtGui.QColor(theme.border))
            words = self.up.words(value, value == rows[-1])
            painter.setPen(QtGui.QColor(theme.quiet))
            paint_number(painter, plot.left() - 8 - number_width(painter.font(), words), round(y + rise), words)
        for value in self.across.ticks(plot.width(), self.APART[0]):
            x = float(self.pixels(value, self.up.low)[0])
            self.paint_tick(painter, plot, value, x)

    def paint_tick(self, painter: QtGui.QPainter, plot: QtCore.QRectF, value: float, x: float) -> None:
        """A value under the axis across, at a pixel."""
        metrics, words = QtGui.QFontMetricsF(painter.font()), self.across.words(value)
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        paint_number(painter, x - number_width(painter.font(), words) / 2, self.baseline(plot, metrics), words)

    @staticmethod
    def baseline(plot: QtCore.QRectF, metrics: QtGui.QFontMetricsF) -> float:
        """Of the words under the axis across."""
        return float(round(plot.bottom() + 6 + metrics.ascent()))

    # ------------------------------------------------------------------ where
    @property
    def plot(self) -> QtCore.QRectF:
        """The rectangle between the axes, in the widget's pixels."""
        scale = LOOK.scale
        left, top = round(self.LEFT * scale), round(self.TOP * scale)
        right, bottom = round(self.RIGHT * scale), round(self.BOTTOM * scale)
        return QtCore.QRectF(left, top, max(self.width() - left - right, 1), max(self.height() - top - bottom, 1))

    def pixels(self, x: float | AnyArray, y: float | AnyArray) -> tuple[AnyArray, AnyArray]:
        """Where values are, in the widget's pixels."""
        plot = self.plot
        right = plot.left() + (np.asarray(x, float) - self.across.low) / self.across.span * plot.width()
        down = plot.bottom() - (np.asarray(y, float) - self.up.low) / self.up.span * plot.height()
        return right, down

    def values(self, at: QtCore.QPointF) -> tuple[float, float]:
        """What is at a pixel of the widget."""
        plot = self.plot
        x = self.across.low + (at.x() - plot.left()) / plot.width() * self.across.span
        return x, self.up.low + (plot.bottom() - at.y()) / plot.height() * self.up.span

    # ------------------------------------------------------------------ events
    def show_axes(self, across: Axis, up: Axis) -> None:
        """Take other axes and draw the chart again."""
        self.across, self.up = across, up
        self.redraw()

    def say(self, sentence: str) -> None:
        """Why there is nothing to see; "" for nothing."""
        if sentence != self.sentence:
            self.sentence = sentence
            self.redraw()

    def redraw(self) -> None:
        """What is plotted has changed."""
        self._kept = None
        self.update()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._kept = None

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        at = QtCore.QPointF(event.pos())
        inside = not self.sentence and self.plot.adjusted(-8, -8, 8, 8).contains(at)
        self.pointed.emit(self.values(at) if inside else None)

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self.pointed.emit(None)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        if self._kept is None or self._kept.devicePixelRatioF() != self.devicePixelRatioF():
            self._kept = self._painted()
        painter.drawPixmap(0, 0, self._kept)
        if not self.sentence:
            painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
            self.paint_over(painter, self.plot)

    def _painted(self) -> QtGui.QPixmap:
        ratio, theme = self.devicePixelRatioF(), LOOK.theme
        picture = QtGui.QPixmap(self.size() * ratio)
        picture.setDevicePixelRatio(ratio)
        picture.fill(QtGui.QColor(theme.window))
        painter = QtGui.QPainter(picture)
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        if self.sentence:
            painter.setFont(LOOK.font(13))
            painter.setPen(QtGui.QColor(theme.quiet))
            flags = int(QtCore.Qt.AlignmentFlag.AlignCenter | QtCore.Qt.TextFlag.TextWordWrap)
            painter.drawText(self.rect().adjusted(24, 8, -24, -8), flags, self.sentence)
        else:
            self.paint_ticks(painter, self.plot)
            self.paint_content(painter, self.plot)
        painter.end()
        return picture


def paint_dot(painter: QtGui.QPainter, at: QtCore.QPointF, colour: str, radius: float = 4.0) -> None:
    """A point of a curve, with a rim that parts it from others."""
    painter.setPen(QtGui.QPen(QtGui.QColor(LOOK.theme.window), 2))
    painter.setBrush(QtGui.QColor(colour))
    painter.drawEllipse(at, radius, radius)


def paint_card(
    painter: QtGui.QPainter,
    at: QtCore.QPointF,
    room: QtCore.QRectF,
    head: tuple[str, str],
    lines: Sequence[CardLine],
    is_low: bool = False,
) -> None:
    """What is under the pointer, to the left of a place or, where there is no room, to its right.

    is_low: at the lower end of the room rather than at the upper.
    """
    theme, font, scale = LOOK.theme, LOOK.font(12), LOOK.scale
    indent = CARD_DOT + 6 if any(line.colour for line in lines) else 0.0
    columns = [
        max((number_width(font, line.numbers[k]) for line in lines if len(line.numbers) > k), default=0.0)
        for k in range(max((len(line.numbers) for line in lines), default=0))
    ]
    words = max((indent + number_width(font, line.words) for line in lines), default=0.0)
    width = max(words + sum(column + CARD_GAP for column in columns), sum(number_width(font, t) for t in head) + 24)
    step = CARD_LINE * scale
    box = QtCore.QRectF(0, 0, width + 2 * CARD_PAD, (len(lines) + 1) * step + 2 * CARD_PAD - 4)
    box.moveTopRight(QtCore.QPointF(at.x() - 16, room.top()))
    if is_low:
        box.moveBottom(room.bottom())
    if box.left() < room.left() - 40:
        box.moveLeft(at.x() + 16)
    # Where neither side has room, it stays in the chart.
    box.moveLeft(max(min(box.left(), painter.device().width() - box.width() - 4), 4))
    painter.setPen(QtGui.QPen(QtGui.QColor(theme.border), 1))
    painter.setBrush(QtGui.QColor(theme.raised))
    painter.drawRoundedRect(box.adjusted(0.5, 0.5, -0.5, -0.5), 5, 5)
    painter.setFont(font)
    metrics = QtGui.QFontMetricsF(font)
    left, right = box.left() + CARD_PAD, box.right() - CARD_PAD
    baseline = box.top() + CARD_PAD - 2 + (step + metrics.ascent() - metrics.descent()) / 2
    painter.setPen(QtGui.QColor(theme.quiet))
    paint_number(painter, left, baseline, head[0])
    paint_number(painter, right - number_width(font, head[1]), baseline, head[1])
    for line in lines:
        baseline += step
        if line.colour:
            painter.setPen(QtCore.Qt.PenStyle.NoPen)
            painter.setBrush(QtGui.QColor(line.colour))
            middle = baseline - (metrics.ascent() - metrics.descent()) / 2
            painter.drawEllipse(QtCore.QPointF(left + CARD_DOT / 2, middle), CARD_DOT / 2, CARD_DOT / 2)
        painter.setPen(QtGui.QColor(theme.text))
        paint_number(painter, left + indent, baseline, line.words)
        edge = right
        for text, column in reversed(list(zip(line.numbers, columns[: len(line.numbers)], strict=True))):
            paint_number(painter, edge - number_width(font, text), baseline, text)
            edge -= column + CARD_GAP
