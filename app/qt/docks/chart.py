"""A chart in a dock: axes with round ticks, the pointer, and a card that says what is under it.

Painted with QPainter in the window's own fonts, digits and colours.  What takes long is painted once into a picture and
kept, so that the pointer costs next to nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import AnyArray

from ...drawing.chart import LEAST_APART, Axis, Ink, Plot, tick_shapes
from ...drawing.painters.qt import box_of, paint, rgba_of, text_width
from ...drawing.shapes import Box, Path, Pen, Shape, Text, disc, rounded
from ..look.look import LOOK, smooth_painter
from ..panels.flat_button import paint_ring

FONT, GAP = 12.0, 8 / 12
"""Logical pixels of the font at axes, and from these to the words, in font sizes."""

CARD_PAD, CARD_LINE, CARD_DOT, CARD_GAP = 9.0, 18.0, 8.0, 16.0


@dataclass(frozen=True)
class CardLine:
    """A line of a card: a dot in a colour if there is one, then words, and numbers at the right."""

    words: str
    numbers: tuple[str, ...] = ()
    colour: str = ""


class Chart(QtWidgets.QWidget):
    """A chart whose subclasses paint its content (`paint_content`, kept) and what moves over it (`paint_over`).

    `pointed` is emitted with (x, y) in the units of the axes, or with None when the pointer leaves.
    """

    pointed = QtCore.Signal(object)

    LEFT, RIGHT, TOP, BOTTOM = 56.0, 24.0, 10.0, 30.0
    """Logical pixels about the plot, before the letters are enlarged."""

    APART = LEAST_APART
    """Least logical pixels between two ticks, across and up."""

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
        """Paint what is plotted, over the grid; kept until `redraw`."""

    def paint_over(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """Paint what moves with the pointer."""

    def paint_ticks(self, painter: QtGui.QPainter, plot: QtCore.QRectF) -> None:
        """Paint grid lines and the words at both axes."""
        theme, scale = LOOK.theme, LOOK.scale
        ink = Ink(rgba_of(theme.text), rgba_of(theme.quiet), Pen(rgba_of(theme.border)), FONT * scale)
        apart = self.APART[0] * scale, self.APART[1] * scale
        paint(painter, tick_shapes(self.shown, ink, apart, is_free=self.is_free, gap=GAP / scale))
        painter.setFont(LOOK.font(FONT))

    def is_free(self, x: float, words: str) -> bool:
        """Return whether a tick has room at a pixel of the axis across."""
        return True

    @staticmethod
    def baseline(plot: QtCore.QRectF, metrics: QtGui.QFontMetricsF) -> float:
        """Return the baseline of the words under the axis across."""
        return float(round(plot.bottom() + 6 + metrics.ascent()))

    # ------------------------------------------------------------------ where
    @property
    def plot(self) -> QtCore.QRectF:
        """The rectangle between the axes, in the widget's pixels."""
        scale = LOOK.scale
        left, top = round(self.LEFT * scale), round(self.TOP * scale)
        right, bottom = round(self.RIGHT * scale), round(self.BOTTOM * scale)
        return QtCore.QRectF(left, top, max(self.width() - left - right, 1), max(self.height() - top - bottom, 1))

    @property
    def shown(self) -> Plot:
        """The plot in the widget's pixels, for shapes."""
        return Plot(box_of(self.plot), self.across, self.up)

    def pixels(self, x: float | AnyArray, y: float | AnyArray) -> tuple[AnyArray, AnyArray]:
        """Return the pixels of the widget at which values are drawn."""
        return self.shown.x(x), self.shown.y(y)

    def values(self, at: QtCore.QPointF) -> tuple[float, float]:
        """Return the values at a pixel of the widget."""
        plot = self.plot
        x = self.across.low + (at.x() - plot.left()) / plot.width() * self.across.span
        return x, self.up.low + (plot.bottom() - at.y()) / plot.height() * self.up.span

    # ------------------------------------------------------------------ events
    def show_axes(self, across: Axis, up: Axis) -> None:
        """Take other axes and draw the chart again."""
        self.across, self.up = across, up
        self.redraw()

    def say(self, sentence: str) -> None:
        """Show a sentence in place of the chart, "" for none."""
        if sentence != self.sentence:
            self.sentence = sentence
            self.redraw()

    def redraw(self) -> None:
        """Plot anew, as something has changed."""
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
        painter = smooth_painter(self)
        if self._kept is None or self._kept.devicePixelRatioF() != self.devicePixelRatioF():
            self._kept = self._painted()
        painter.drawPixmap(0, 0, self._kept)
        if not self.sentence:
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


class CurveChart(Chart):
    """A chart of curves, with a line across them that follows the pointer and the arrow keys: `at` says where.

    Both are told by `pointed`.
    """

    KEY_STEP = 0.01
    """The fraction of the axis that an arrow key moves the line by, with Shift ten times as much."""

    def __init__(self, name: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(name, parent)
        self.at: float | None = None
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)

    def event(self, event: QtCore.QEvent) -> bool:
        is_override = event.type() == QtCore.QEvent.Type.ShortcutOverride
        if is_override and event.key() == QtCore.Qt.Key.Key_Escape and self.at is not None:
            event.accept()  # it stops nothing else meanwhile
            return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        keys, step = QtCore.Qt.Key, {QtCore.Qt.Key.Key_Left: -1, QtCore.Qt.Key.Key_Right: 1}.get(event.key(), 0)
        if event.key() == keys.Key_Escape and self.at is not None:
            self.pointed.emit(None)
        elif step and not self.sentence:
            large = bool(event.modifiers() & QtCore.Qt.KeyboardModifier.ShiftModifier)
            high = self.across.high
            at = 0.0 if self.at is None else self.at + step * self.KEY_STEP * (10 if large else 1) * high
            self.pointed.emit((min(max(at, 0.0), high), 0.0))
        else:
            super().keyPressEvent(event)

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusInEvent(event)
        self.update()

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        self.pointed.emit(None)
        self.update()

    def paint_line(
        self,
        painter: QtGui.QPainter,
        plot: QtCore.QRectF,
        heights: Sequence[tuple[float, str]],
        head: tuple[str, str],
        lines: Sequence[CardLine],
    ) -> None:
        """Paint the line, dots where curves with these values and colours meet it, and a card."""
        if self.hasFocus():
            paint_ring(painter, QtCore.QRectF(self.rect()))
        if self.at is None or not lines:
            return
        x = float(self.pixels(self.at, 0)[0])
        painter.fillRect(QtCore.QRectF(round(x), plot.top(), 1, plot.height()), QtGui.QColor(LOOK.theme.text))
        places = [(float(self.pixels(0, height)[1]), colour) for height, colour in heights if np.isfinite(height)]
        for y, colour in places:
            paint_dot(painter, QtCore.QPointF(round(x) + 0.5, y), colour)
        is_low = bool(places) and float(np.mean([y for y, _ in places])) < plot.center().y()
        paint(painter, card_shapes(x, box_of(plot), self.width(), head, lines, is_low))


def paint_dot(painter: QtGui.QPainter, at: QtCore.QPointF, colour: str, radius: float = 4.0) -> None:
    """Paint a point of a curve, with a rim that parts it from others."""
    paint(painter, [disc((at.x(), at.y()), radius, rgba_of(colour), Pen(rgba_of(LOOK.theme.window), 2))])


def card_shapes(
    at: float, room: Box, width: float, head: tuple[str, str], lines: Sequence[CardLine], is_low: bool = False
) -> list[Shape]:
    """Return a card on what is under the pointer, left of a place or, where there is no room, right of it.

    Parameters
    ----------
    at
        The x of the place.
    room, width
        The plot, and the width of the chart, where the card stays.
    is_low
        Whether it stands at the lower end of the room rather than at the upper.
    """
    theme, size, step = LOOK.theme, FONT * LOOK.scale, CARD_LINE * LOOK.scale
    indent = CARD_DOT + 6 if any(line.colour for line in lines) else 0.0
    columns = [
        max((text_width(line.numbers[k], size) for line in lines if len(line.numbers) > k), default=0.0)
        for k in range(max((len(line.numbers) for line in lines), default=0))
    ]
    words = max((indent + text_width(line.words, size) for line in lines), default=0.0)
    inside = max(words + sum(column + CARD_GAP for column in columns), sum(text_width(t, size) for t in head) + 24)
    wide, high = inside + 2 * CARD_PAD, (len(lines) + 1) * step + 2 * CARD_PAD - 4
    left = at - 16 - wide if at - 16 - wide >= room.x - 40 else at + 16
    # Where neither side has room, it stays in the chart.
    box = Box(max(min(left, width - wide - 4), 4), room.bottom - high if is_low else room.y, wide, high)
    x, right, y = box.x + CARD_PAD, box.right - CARD_PAD, box.y + CARD_PAD - 2 + step / 2

    def text(words: str, x: float, y: float, colour: str, align: str = "left") -> Text:
        return Text(words, x, y, size, rgba_of(colour), align=align, level="line", are_digits_even=True)

    shapes: list[Shape] = [Path(rounded(box.grown(-0.5), 5), rgba_of(theme.raised), Pen(rgba_of(theme.border)))]
    shapes += [text(head[0], x, y, theme.quiet), text(head[1], right, y, theme.quiet, "right")]
    for line in lines:
        y += step
        if line.colour:
            shapes.append(disc((x + CARD_DOT / 2, y), CARD_DOT / 2, rgba_of(line.colour)))
        shapes.append(text(line.words, x + indent, y, theme.text))
        edge = right
        for number, column in reversed(list(zip(line.numbers, columns[: len(line.numbers)], strict=True))):
            shapes.append(text(number, edge, y, theme.text, "right"))
            edge -= column + CARD_GAP
    return shapes
