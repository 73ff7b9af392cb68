"""The colour bar under a panel's view: what the colours mean, and the value under the pointer."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from html import escape
from typing import Any

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.arrays import FloatArray

from ...drawing.colour_bar import BarColours, BarLine, across, bar_shapes, line_shapes, outline_shape
from ...drawing.numbers import number
from ...drawing.painters.qt import paint, rgba_of, text_width
from ...drawing.shapes import Box, Path, Pen, Shape, Text, rounded
from ...marks.primitives import LegendRow
from ...scene.bands import bar_colours
from ...scene.style import PAPER, Style
from ..look.look import LOOK, smooth_painter
from ..look.theme import contrast
from .bar_layout import UNDEFINED, Reading, lay_out

POINT, CORNER = 6.0, 2.0
"""Logical pixels by which a bar goes on, as a point, beyond an end, and of the radius of its corners."""

SENTENCE_MARGIN = 12
"""Least logical pixels beside a sentence."""

MOST_LABELS = 400
"""Labels that a legend may name."""

TOOLTIP_LINES = 30
"""Lines of a legend in a column of the tool tip."""

SWATCH_SIZE, ENTRY_GAP = 9.0, 14.0
"""Logical pixels of a colour in a legend, and between two entries."""

FAINT = 1.3
"""Colours of less contrast with the ground need an outline."""


class ColourBar(QtWidgets.QWidget):
    """Colours with round values under them, above them the value at the pointer; grey while there is no field."""

    end_wanted = QtCore.Signal()  # by a double click, or in the menu: to say where it ends

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._reading: Reading | None = None
        self._unit = ""
        self._is_compact = False
        self._colours = BarColours(((0.0, 0.0, 0.0),))
        self._drawn: tuple[object, list[Shape]] = (None, [])
        self._style = PAPER
        self._at_rest: tuple[float, str] | None = None
        self._sentence: tuple[str, ...] = ()
        self._labels: tuple[LegendRow, ...] = ()
        self._layout = lay_out(None, self.width())
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Expanding, QtWidgets.QSizePolicy.Policy.Fixed)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_OpaquePaintEvent)
        self.setAccessibleName("Colour bar")
        LOOK.changed.connect(self._apply_theme)
        self._apply_theme()

    def show_range(
        self, reading: Reading, style: Style, edges: FloatArray, goes_beyond: tuple[bool, bool] = (False, False)
    ) -> None:
        """Show a new field, of which nothing is pointed at yet.

        Parameters
        ----------
        edges
            (k,) fractions of the maximum at which bands end, if the style has any.
        goes_beyond
            Whether values lie beyond the low and the high end.
        """
        self._reading, self._style, self._unit = reading, style, reading.unit
        self._colours = bar_colours(style, edges, reading.signed, goes_beyond)
        if reading.high == reading.low:  # the field is 0 everywhere
            red, green, blue = style.colours_at(np.zeros(1), reading.signed)[0].tolist()
            self._colours = BarColours(((red, green, blue),))
        self.show_value(None)
        self._lay_out()

    def show_rest(self, value: float | None, words: str = "") -> None:
        """Show a value with these words for its unit while nothing is pointed at; None for nothing."""
        at_rest = None if value is None else (value, words)
        if at_rest != self._at_rest:
            self._at_rest = at_rest
            self.show_value(None)

    def show_sentence(self, sentence: Sequence[str]) -> None:
        """Show the first of these sentences for which there is room, where there is no field to have a bar.

        Ids of vertices are bold.  () for the bar.
        """
        if tuple(sentence) != self._sentence:
            self._sentence = tuple(sentence)
            self._lay_out()

    def show_labels(self, rows: Sequence[LegendRow]) -> None:
        """Show a legend of labels in the place of the bar; () for the bar."""
        if tuple(rows) != self._labels:
            self._labels = tuple(rows)
            self._lay_out()

    def show_value(self, value: float | None) -> None:
        """Show the value at the pointer, NaN where there is none; None for no pointer."""
        is_undefined, unit = value is not None and not math.isfinite(value), self._unit
        if value is None and self._at_rest is not None:
            value, unit = self._at_rest
        self._say(value=None if is_undefined else value, words=UNDEFINED if is_undefined else "", unit=unit)

    def show_words(self, text: str) -> None:
        """Show words in the place of a value."""
        self._say(value=None, words=text)

    def clear(self) -> None:
        """Show an empty grey bar, as there is no field."""
        self._reading = None
        self._lay_out()

    def set_compact(self, compact: bool) -> None:
        """Make the bar lower, for low panels, or as high as usual."""
        self._is_compact = compact
        self._apply_theme()

    def _say(self, **changes: Any) -> None:
        """Change what is said; nothing is said while there is no field."""
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
        if self._labels:
            self.setToolTip(_table_of(self._labels))
            self.setAccessibleDescription(", ".join(row.text for row in self._labels))
            self.update()
            return
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
        paint(smooth_painter(self, LOOK.theme.canvas), self.shapes)

    @property
    def shapes(self) -> list[Shape]:
        """All that the bar shows, in logical pixels."""
        if self._labels:
            return self._label_shapes()
        if self._sentence and self._reading is None:
            return self._sentence_shapes()
        return [
            *self._bar_shapes(),
            *self._pointer(),
            *(word.shape for word in (*self._layout.line, *self._layout.ticks)),
        ]

    def _sentence_shapes(self) -> list[Shape]:
        """Return the sentence in the middle of the line over the bar, with ids of vertices bold."""
        size, room = 13 * LOOK.scale, self.width() - 2 * SENTENCE_MARGIN
        fitting = (words for words in self._sentence if text_width(words, size, True) <= room)
        parts = re.split(r"(?<=vertex )(\d+)", next(fitting, self._sentence[-1]))
        widths = [text_width(part, size, bool(k % 2)) for k, part in enumerate(parts)]
        x = (self.width() - sum(widths)) / 2
        found: list[Shape] = []
        for k, (part, width) in enumerate(zip(parts, widths, strict=True)):
            colour = rgba_of(LOOK.theme.text if k % 2 else LOOK.theme.quiet)
            found.append(Text(part, x, 0.2 * self.height(), size, colour, bool(k % 2), level="line"))
            x += width
        return found

    def _label_shapes(self) -> list[Shape]:
        """Return the legend in as many lines as there is room for; what is left out is counted."""
        size, scale, theme = 12 * LOOK.scale, LOOK.scale, LOOK.theme
        room, high = self.width() - 2 * SENTENCE_MARGIN, 18 * scale
        lines: list[list[tuple[LegendRow | None, str, float]]] = [[]]
        most = max(int(self.height() / high), 1)

        def wide(text: str) -> float:
            return text_width(text, size) + (SWATCH_SIZE + 5 + ENTRY_GAP) * scale

        rest = len(self._labels)
        for row in self._labels:
            used = sum(width for _, _, width in lines[-1])
            more = wide(f"{rest} more") if len(lines) == most and rest > 1 else 0.0
            if used + wide(row.text) + more > room:
                if len(lines) == most:
                    break
                lines.append([])
            lines[-1].append((row, row.text, wide(row.text)))
            rest -= 1
        if rest:
            lines[-1].append((None, f"{rest} more", text_width(f"{rest} more", size) + ENTRY_GAP * scale))
        shapes: list[Shape] = []
        y = (self.height() - high * len(lines)) / 2 + high / 2
        for line in lines:
            x = (self.width() - sum(width for _, _, width in line) + ENTRY_GAP * scale) / 2
            for entry, text, width in line:
                at = x
                if entry is not None:
                    side = SWATCH_SIZE * scale
                    is_faint = contrast(entry.colour, theme.canvas) < FAINT
                    pen = Pen(rgba_of(theme.strong)) if is_faint else None
                    swatch = rounded(Box(x, y - side / 2, side, side), CORNER)
                    shapes.append(Path(swatch, rgba_of(entry.colour), pen))
                    at += (SWATCH_SIZE + 5) * scale
                ink = rgba_of(theme.quiet if entry is None else theme.text)
                shapes.append(Text(text, at, y, size, ink, level="line"))
                x += width
            y += high
        return shapes

    def _bar_shapes(self) -> list[Shape]:
        """Return the bar and the lines across it, the same ones as long as they look so."""
        layout = replace(self._layout, line=(), ticks=(), pointer=None)
        key = layout, id(self._colours), self._reading is None, LOOK.theme, self.pixel
        if key != self._drawn[0]:
            self._drawn = key, self._new_bar_shapes()
        return self._drawn[1]

    def _new_bar_shapes(self) -> list[Shape]:
        theme, layout = LOOK.theme, self._layout
        box = layout.bar
        if self._reading is None:
            return [Path(rounded(box, CORNER), rgba_of(theme.hover))]
        shapes = [
            *bar_shapes(box, self._colours, POINT, radius=CORNER),
            *line_shapes(box, self._lines, pixel=self.pixel),
        ]
        ends = (QtGui.QColor.fromRgbF(*self._colours.colours[k]).name() for k in (0, -1))
        if any(contrast(end, theme.canvas) < FAINT for end in ends):
            shapes.append(outline_shape(box.without(0.5), self._colours, POINT, Pen(rgba_of(theme.strong)), CORNER))
        return shapes

    def _pointer(self) -> list[Shape]:
        """Return the mark of the value at the pointer."""
        box, x = self._layout.bar, self._layout.pointer
        colours = () if x is None else ((6, LOOK.theme.canvas), (2, LOOK.theme.text))
        at = 0.0 if x is None else (x - box.x) / box.width
        return [across(box, at, width, rgba_of(colour), pixel=self.pixel, beyond=3) for width, colour in colours]

    @property
    def _lines(self) -> list[BarLine]:
        layout, ink_of, signed = self._layout, self._style.isoline_ink, self._layout.zero is not None
        placed = [(x, 2 if x in layout.bold else 1, ink_of(signed)) for x in layout.isolines]
        placed += [(layout.zero, 2, ink_of(signed, 0.0))] if layout.zero is not None else []
        placed += [(x, 2, ink_of(is_through=True)) for x in layout.through]
        left, room = layout.bar.x, layout.bar.width
        return [BarLine((x - left) / room, wide, ink.colour, ink.rim, wide + 2) for x, wide, ink in placed]

    @property
    def pixel(self) -> float:
        """The size of a device pixel, on whole ones of which all lines are equally sharp."""
        return 1 / float(self.devicePixelRatioF())


def _table_of(rows: Sequence[LegendRow]) -> str:
    """Return a legend as a table of Qt's, in columns."""
    columns = -(-len(rows) // TOOLTIP_LINES)
    lines = -(-len(rows) // columns)
    cells = [f'<td><font color="{row.colour}">■</font>&nbsp;{escape(row.text)}&nbsp;&nbsp;</td>' for row in rows]
    in_lines = ("".join(cells[k::lines]) for k in range(lines))
    return f"<table>{''.join(f'<tr>{line}</tr>' for line in in_lines)}</table>"
