"""The colour bar under a panel's view: what the colours mean, and the value under the pointer."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt
from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK
from ..look.numbers import number, paint_number
from ..look.painting import baseline, smooth_painter
from ..look.theme import contrast
from .bar_layout import UNDEFINED, Reading, lay_out

POINT = 6
"""Pixels by which a bar goes on, as a point, where there are values beyond its end."""

SENTENCE_MARGIN = 12
"""Pixels beside a sentence, at least."""

FAINT = 1.3
"""Colours of less contrast with the ground need an outline."""


class ColourBar(QtWidgets.QWidget):
    """Colours with round values under them, above them the value at the pointer; grey while there is no field."""

    end_wanted = QtCore.Signal()  # by a double click, or in the menu: to say where it ends

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._reading: Reading | None = None
        self._unit = ""
        self._has_shares, self._is_compact = True, False
        self._colours, self._line_colour = QtGui.QBrush(), QtGui.QColor()
        self._through: tuple[QtGui.QColor, ...] = ()
        self._ends: tuple[QtGui.QColor, ...] = ()
        self._bands: list[tuple[float, QtGui.QColor]] = []
        self._beyond, self._rest_colour = (False, False), QtGui.QColor()
        self._rim: QtGui.QColor | None = None
        self._at_rest: tuple[float, str] | None = None
        self._sentence: tuple[str, ...] = ()
        self._layout = lay_out(None, self.width())
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName("Colour bar")
        LOOK.changed.connect(self._apply_theme)
        self._apply_theme()

    def show_range(
        self,
        colours: npt.ArrayLike,
        low: float,
        high: float,
        lines: npt.ArrayLike,
        unit: str,
        signed: bool = False,
        line_colour: tuple[float, float, float] = (1, 1, 1),
        maximum: float | None = None,
        rest: tuple[tuple[float, ...], tuple[float, ...] | None] | None = None,
        bands: npt.ArrayLike = (),
        beyond: tuple[bool, bool] = (False, False),
        in_shares: bool = False,
        bold: npt.ArrayLike = (),
        through: npt.ArrayLike = (),
        through_colours: tuple[tuple[float, float, float], ...] = ((1, 1, 1), (0, 0, 0)),
    ) -> None:
        """A new field, of which nothing is said yet: colours (k, 3), 0 to 1, evenly from low to high, in `unit`.

        lines: (m,) the isolines' values.  signed: low is -high, and 0 in the middle has a bold line.  maximum: the
        field's own (of its absolute values, if signed), which may be another than high.  rest: colours
        of all lines but that at 0, and of their rims, None for no rims; as `line_colour` if not given.
        bands: (k - 1,) places, 0 to 1,
        where one colour ends and the next begins.  beyond: whether values lie beyond the low and the high end.
        in_shares: the ticks are shares of high.  bold, through: (k,) those of the lines that are bolder, or pass
        through points; these have a colour and that of a rim.
        """
        rgb = np.clip(np.asarray(colours, float), 0, 1).reshape(-1, 3)
        own = high if maximum is None else maximum
        if not (all(map(math.isfinite, (low, high, own))) and low <= high and len(rgb)):
            raise ValueError(f"{len(rgb)} colours from {low} to {high}, maximum {own}, make no colour bar.")
        all_of_them, bolder, passing = (np.sort(np.ravel(some)).tolist() for some in (lines, bold, through))
        self._reading = Reading(
            low, high, tuple(all_of_them), unit, signed, own, self._has_shares,
            in_shares=in_shares, bold=frozenset(bolder), through=frozenset(passing),
        )  # fmt: skip
        self._unit = unit
        if high == low:
            rgb = rgb[[len(rgb) // 2 if signed else 0]]
        self._colours = _gradient(rgb.tobytes())
        starts = [0.0, *np.ravel(bands).tolist()]
        is_banded = high > low and 1 < len(starts) == len(rgb)
        shades = map(QtGui.QColor.fromRgbF, *rgb.T.tolist())
        self._bands = list(zip(starts, shades, strict=True)) if is_banded else []
        self._beyond = beyond
        self._ends = tuple(QtGui.QColor.fromRgbF(*rgb[k]) for k in (0, -1))
        self._line_colour = QtGui.QColor.fromRgbF(*line_colour)
        self._through = tuple(QtGui.QColor.fromRgbF(*colour) for colour in through_colours)
        colour, rim = (line_colour, None) if rest is None else rest
        self._rest_colour = QtGui.QColor.fromRgbF(*colour)
        self._rim = None if rim is None else QtGui.QColor.fromRgbF(*rim)
        self.show_value(None)
        self._lay_out()

    def show_rest(self, value: float | None, words: str = "") -> None:
        """What is said while nothing is pointed at: a value with these words for its unit; None for nothing."""
        at_rest = None if value is None else (value, words)
        if at_rest != self._at_rest:
            self._at_rest = at_rest
            self.show_value(None)

    def show_sentence(self, sentence: Sequence[str]) -> None:
        """Instead of the bar, where there is no field to have one: the first of these for which there is room.

        Ids of vertices stand out.  () for the bar.
        """
        if tuple(sentence) != self._sentence:
            self._sentence = tuple(sentence)
            self._lay_out()

    def show_shares(self, shown: bool) -> None:
        """Whether the value is also given as a fraction of the maximum."""
        self._has_shares = shown
        self._say(has_shares=shown)

    def show_value(self, value: float | None) -> None:
        """The value at the pointer, NaN where there is none, or None for no pointer."""
        is_undefined, unit = value is not None and not math.isfinite(value), self._unit
        if value is None and self._at_rest is not None:
            value, unit = self._at_rest
        self._say(value=None if is_undefined else value, words=UNDEFINED if is_undefined else "", unit=unit)

    def show_words(self, text: str) -> None:
        """Words in the place of a value."""
        self._say(value=None, words=text)

    def show_note(self, text: str, short: str = "") -> None:
        """A remark in the place of the maximum, perhaps with a shorter one where that has no room; empty for none."""
        self._say(note=text, short_note=short)

    def clear(self) -> None:
        """No field: empty and grey."""
        self._reading = None
        self._lay_out()

    def set_compact(self, compact: bool) -> None:
        """Less high, for low panels."""
        self._is_compact = compact
        self._apply_theme()

    def _say(self, **changes: Any) -> None:
        """While there is no field, there is nothing to say."""
        if self._reading is not None and (reading := replace(self._reading, **changes)) != self._reading:
            self._reading = reading
            self._lay_out()

    def _apply_theme(self) -> None:
        self.setFixedHeight(round((50 if self._is_compact else 60) * LOOK.scale))
        self._lay_out()

    def _lay_out(self) -> None:
        self._layout, reading = lay_out(self._reading, self.width(), self._is_compact), self._reading
        sentence = "" if reading is None else reading.sentence
        ends = "no values" if reading is None else f"{number(reading.low)} to {number(reading.high)}"
        is_sentence = bool(self._sentence) and reading is None
        self.setToolTip(self._sentence[0] if is_sentence else "" if self._layout.is_whole else sentence)
        described = f"{ends}: {sentence}" if sentence else ends
        self.setAccessibleDescription(self._sentence[0] if is_sentence else described)
        self.update()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        self._lay_out()

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:
        self.end_wanted.emit()

    def contextMenuEvent(self, event: QtGui.QContextMenuEvent) -> None:
        if self._reading is not None:
            menu = QtWidgets.QMenu(self)
            # Once the menu is gone: two sheets do not pop up at a time.
            menu.addAction("Ends at…").triggered.connect(lambda *_: QtCore.QTimer.singleShot(0, self.end_wanted.emit))
            menu.aboutToHide.connect(menu.deleteLater)
            menu.popup(event.globalPos())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme, layout = smooth_painter(self), LOOK.theme, self._layout
        painter.fillRect(self.rect(), QtGui.QColor(theme.canvas))
        if self._sentence and self._reading is None:
            self._paint_sentence(painter)
            return
        self._paint_bar(painter)
        for word in (*layout.line, *layout.ticks):
            painter.setFont(word.font)
            painter.setPen(QtGui.QColor(theme.quiet if word.is_quiet else theme.text))
            paint_number(painter, word.box.left(), round(baseline(painter, word.box.center().y())), word.text)

    def _paint_sentence(self, painter: QtGui.QPainter) -> None:
        """In the middle of the line over the bar."""
        usual, bold = LOOK.font(), LOOK.font(bold=True)
        metrics, room = QtGui.QFontMetricsF(bold), self.width() - 2 * SENTENCE_MARGIN
        fitting = (words for words in self._sentence if metrics.horizontalAdvance(words) <= room)
        parts = re.split(r"(?<=vertex )(\d+)", next(fitting, self._sentence[-1]))
        fonts = [bold if k % 2 else usual for k in range(len(parts))]
        widths = [QtGui.QFontMetricsF(font).horizontalAdvance(part) for font, part in zip(fonts, parts, strict=True)]
        x = (self.width() - sum(widths)) / 2
        painter.setFont(bold)
        y = round(baseline(painter, 0.2 * self.height()))
        for k, (part, font, width) in enumerate(zip(parts, fonts, widths, strict=True)):
            painter.setFont(font)
            painter.setPen(QtGui.QColor(LOOK.theme.text if k % 2 else LOOK.theme.quiet))
            painter.drawText(QtCore.QPointF(x, y), part)
            x += width

    def _paint_bar(self, painter: QtGui.QPainter) -> None:
        theme, bar = LOOK.theme, self._layout.bar
        painter.setPen(QtCore.Qt.PenStyle.NoPen)
        shape = self._shape(bar)
        painter.setBrush(QtGui.QColor(theme.hover) if self._reading is None else self._colours)
        painter.drawPath(shape)
        if self._reading is not None:
            self._paint_bands(painter, bar, shape)
        for x in self._layout.isolines:
            width = 2 if x in self._layout.bold else 1
            if self._rim is not None:
                self._paint_line(painter, x, width + 2, self._rim)
            self._paint_line(painter, x, width, self._rest_colour)
        if self._layout.zero is not None:
            self._paint_line(painter, self._layout.zero, 2, self._line_colour)
        for x in self._layout.through:
            colour, rim = self._through
            self._paint_line(painter, x, 4, rim)
            self._paint_line(painter, x, 2, colour)
        if self._reading is not None and any(contrast(end.name(), theme.canvas) < FAINT for end in self._ends):
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.strong), 1))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawPath(self._shape(bar.adjusted(0.5, 0.5, -0.5, -0.5)))
        if self._layout.pointer is not None:
            self._paint_line(painter, self._layout.pointer, 6, QtGui.QColor(theme.canvas), beyond=3)
            self._paint_line(painter, self._layout.pointer, 2, QtGui.QColor(theme.text), beyond=3)

    def _shape(self, bar: QtCore.QRectF) -> QtGui.QPainterPath:
        """Of the bar: with a point at an end beyond which there are values."""
        path, (below, above) = QtGui.QPainterPath(), self._beyond if self._reading is not None else (False, False)
        path.addRoundedRect(bar, 2, 2)
        top, middle, bottom = bar.top(), bar.center().y(), bar.bottom()
        for is_there, x, way in ((below, bar.left(), -1), (above, bar.right(), 1)):
            if is_there:
                inside, tip = x - 2 * way, x + way * POINT
                corners = (inside, top), (x, top), (tip, middle), (x, bottom), (inside, bottom)
                end = QtGui.QPainterPath()
                end.addPolygon(QtGui.QPolygonF([QtCore.QPointF(*corner) for corner in corners]))
                end.closeSubpath()
                path = path.united(end)
        return path

    def _paint_bands(self, painter: QtGui.QPainter, bar: QtCore.QRectF, shape: QtGui.QPainterPath) -> None:
        """One colour after the other, and the ends' colours in the points."""
        painter.save()
        painter.setClipPath(shape)
        for start, colour in self._bands:
            left = bar.left() + start * bar.width() if start else bar.left() - POINT
            painter.fillRect(QtCore.QRectF(left, bar.top(), bar.right() + POINT - left, bar.height()), colour)
        for is_there, x, colour in zip(self._beyond, (bar.left() - POINT, bar.right()), self._ends, strict=False):
            if is_there:
                painter.fillRect(QtCore.QRectF(x, bar.top(), POINT, bar.height()), colour)
        painter.restore()

    def _paint_line(self, painter: QtGui.QPainter, x: float, width: int, colour: QtGui.QColor, beyond: int = 0) -> None:
        """Across the bar, on whole pixels of the screen, so that all lines are equally sharp."""
        bar, ratio = self._layout.bar, self.devicePixelRatioF()
        thick = round(width * ratio)
        left = math.floor(x * ratio - thick / 2 + 0.5)
        box = QtCore.QRectF(left / ratio, bar.top() - beyond, thick / ratio, bar.height() + 2 * beyond)
        painter.fillRect(box, colour)


@lru_cache(maxsize=16)
def _gradient(content: bytes) -> QtGui.QBrush:
    """Colours, the bytes of an array (k, 3), from the left to the right end of whatever is filled with them."""
    colours = np.frombuffer(content).reshape(-1, 3)
    gradient = QtGui.QLinearGradient(0, 0, 1, 0)
    gradient.setCoordinateMode(QtGui.QGradient.CoordinateMode.ObjectMode)
    shown = colours[np.linspace(0, len(colours) - 1, min(len(colours), 129)).round().astype(int)]
    ends = np.linspace(0, 1, len(shown)) if len(shown) > 1 else [0.0]
    gradient.setStops([(float(at), QtGui.QColor.fromRgbF(*rgb)) for at, rgb in zip(ends, shown, strict=True)])
    return QtGui.QBrush(gradient)
