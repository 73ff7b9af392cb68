"""The field of the active panel in numbers: its histogram, mean, extremes and quantiles, what a truncation loses of it,
and its isolines as objects."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core import ParameterError
from bihdist_core.analysis.field_statistics import FieldStatistics, field_statistics, rank_correlation
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.formats.field_output import write_array
from bihdist_core.progress import Progress, part

from ...document.document import Document
from ...document.file_names import field_names, file_name
from ...document.quantities import quantity_name
from ...drawing.numbers import number, percent, share, tick, ticks
from ...drawing.painters.qt import number_width, paint_number
from ...qt.context import Context
from ...qt.docks.fact_table import FactTable
from ...qt.docks.instrument import NO_FIELD, Instrument
from ...qt.docks.plain import fill
from ...qt.files.exports import save_figure
from ...qt.files.field_files import levels_of
from ...qt.files.saving import save
from ...qt.look.form import Form, heading, in_row, quiet_label
from ...qt.look.look import LOOK
from ...scene.style import style_of
from ...session.loaded_mesh import LoadedMesh
from ...session.questions import DifferenceQuestion, Question
from .level_box import LevelBox
from .truncation_box import TruncationBox

if TYPE_CHECKING:
    from ...figures.histogram_figure import HistogramFigure

HEIGHT_PX = 128
PAD_PX = 2.0
MIN_BAR_PX = 1.0
"""Pixels of the least area that there is."""


class Histogram(QtWidgets.QWidget):
    """`pointed` is emitted with what a bin under the pointer holds, in words, "" beside them."""

    pointed = QtCore.Signal(str)

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._ends, self._shares = np.empty(0), np.empty(0)
        self._colours = np.empty((0, 3))
        self._unit, self._is_signed = "", False
        self._under: int | None = None
        self.setMouseTracking(True)
        self.setAccessibleName("Histogram by area")
        self.setFixedHeight(HEIGHT_PX)
        LOOK.follow(self, self.update)

    def show_bins(self, ends: AnyArray, areas: AnyArray, colours: FloatArray, unit: str, is_signed: bool) -> None:
        """Show bins between ends (b + 1,) with areas (b,) and colours (b, 3) from 0 to 1, in the unit of the values."""
        total = areas.sum()
        self._ends, self._shares = ends, areas / total if total > 0 else areas
        self._colours, self._unit, self._is_signed = colours, unit, is_signed
        self._under = None
        self.update()

    @property
    def bars(self) -> list[QtCore.QRectF]:
        """Return the rectangles of the bins."""
        if not len(self._shares) or not self._shares.max() > 0:
            return []
        left, width = PAD_PX, (self.width() - 2 * PAD_PX) / len(self._shares)
        bottom = self.height() - 24 * LOOK.scale
        tallest = bottom - 6
        heights = np.where(self._shares > 0, np.maximum(tallest * self._shares / self._shares.max(), MIN_BAR_PX), 0)
        return [
            QtCore.QRectF(left + k * width, bottom - height, max(width - 1, 1), height)
            for k, height in enumerate(heights)
        ]

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        bars = self.bars
        if not bars:
            return
        theme, painter = LOOK.theme, QtGui.QPainter(self)
        bottom = bars[0].bottom()
        low, high = float(self._ends[0]), float(self._ends[-1])
        edge = QtGui.QColor(theme.quiet)
        edge.setAlphaF(0.55)
        for k, bar in enumerate(bars):
            if bar.height() <= 0:
                continue
            painter.fillRect(bar, QtGui.QColor.fromRgbF(*np.clip(self._colours[k], 0, 1)))
            painter.setPen(QtGui.QPen(QtGui.QColor(theme.text) if k == self._under else edge, 1))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawRect(bar.adjusted(0.5, 0.5, -0.5, -0.5))
        painter.fillRect(QtCore.QRectF(PAD_PX, bottom, self.width() - 2 * PAD_PX, 1), QtGui.QColor(theme.border))
        painter.setFont(LOOK.font(12))
        metrics = QtGui.QFontMetricsF(painter.font())
        painter.setPen(QtGui.QColor(theme.quiet))
        for value in ticks(low, high, max(int(self.width() / 72), 2)):
            words = self._tick(value)
            x = PAD_PX + (value - low) / ((high - low) or 1) * (self.width() - 2 * PAD_PX)
            width = number_width(painter.font(), words)
            x = min(max(x - width / 2, 0), self.width() - width)
            paint_number(painter, x, round(bottom + 5 + metrics.ascent()), words)

    def _tick(self, value: float) -> str:
        plus = "+" if self._is_signed and value > 0 else ""
        return f"{plus}{tick(value)}{percent(self._unit) if value else ''}"

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:
        bars = self.bars
        x = event.pos().x()
        under = next((k for k, bar in enumerate(bars) if bar.left() <= x <= bar.right() + 1), None)
        if under != self._under:
            self._under = under
            self.update()
            self.pointed.emit("" if under is None else self._words(under))

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._under = None
        self.update()
        self.pointed.emit("")

    def _words(self, k: int) -> str:
        def written(value: float) -> str:
            return number(value, self._is_signed) + percent(self._unit)

        low, high = written(float(self._ends[k])), written(float(self._ends[k + 1]))
        return f"{low} to {high}: {share(float(self._shares[k]))}"


BINS = 40
UNIT = "fraction of the area"
SHARES = (0.05, 0.25, 0.5, 0.75, 0.95)


@dataclass(frozen=True, eq=False)
class _Request:
    """A field (n,), and the question of a difference, whose two fields are correlated."""

    loaded: LoadedMesh
    answer: Answer
    field: FloatArray
    parts: DifferenceQuestion | None


def _compute(request: _Request, progress: Progress) -> Iterator[FieldStatistics | float]:
    surface = request.loaded.surface
    yield field_statistics(surface, request.field, BINS, SHARES)
    if request.parts is not None:
        one, other = (
            question.answer(request.loaded, part(progress, k / 2, (k + 1) / 2)).field
            for k, question in enumerate((request.parts.minuend, request.parts.subtrahend))
        )
        if one is not None and other is not None:
            there = np.isfinite(one) & np.isfinite(other) & (surface.component_of_vertex >= 0)
            yield rank_correlation(one[there], other[there])


class StatisticsDock(Instrument):
    word = "statistics"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._panel = -1
        self._asked: tuple[Any, ...] = ()
        self._request: _Request | None = None
        self.statistics: FieldStatistics | None = None
        self._correlation: float | None = None
        self.name, self._unit = heading(""), quiet_label()
        self.histogram = Histogram()
        self.histogram.pointed.connect(lambda words: self._unit.setText(words or UNIT))
        self.facts, self.quantiles = FactTable(), FactTable()
        self.truncation, self.levels = TruncationBox(context), LevelBox(context)
        self.sentence = quiet_label(wraps=True)
        form = Form(spacing=6, margins=(12, 10, 12, 12))
        form.add(in_row((self.name, 1), self._unit), self.sentence, self.histogram, self.facts)
        for title, widget in (
            ("Quantiles, by area", self.quantiles),
            ("Truncation", self.truncation),
            ("Isolines and regions", self.levels),
        ):
            form.section(title)
            form.add(widget)
        form.add(None)
        fill(self, form)
        self.setMinimumWidth(240)
        menu = {
            "Save the histogram as a figure…": self.save_figure,
            "Save the histogram's numbers…": self.save_numbers,
            "Copy the statistics": self.copy,
        }
        self._save = self.add_head_button(
            "save", "Save the histogram as a figure, or its numbers", menu, "Save histogram"
        )
        self._background = context.background("statistics", _compute, self._take, self._refuse)
        context.grid.activated.connect(lambda *_: self._ask() if self.isVisible() else None)
        LOOK.follow(self, self._show)

    # ------------------------------------------------------------------ what it is about
    def show_document(self, document: Document, before: Document | None) -> None:
        self._ask()

    def show_answer(self, panel: int) -> None:
        if panel == self._panel:
            self._ask()

    def _ask(self) -> None:
        """Ask for the numbers of the active panel, if they are not there."""
        context = self.context
        session, id = context.session, context.grid.active
        shown, loaded = session.shown.get(id), session.loaded(id)
        self._panel = id
        if loaded is None or shown is None:
            return  # on its way
        names = {panel.id: quantity_name(panel.shows) for panel in session.document.panels}
        self.name.setText(names.get(id, ""))
        question: Question = shown.question
        self.truncation.expect(loaded, question)
        scene = context.grid.panel(id).view.scene
        about = (id, shown.answer.field is not None and shown.answer.field.ctypes.data, loaded.surface)
        lines = (scene.field_actor.maximum, scene.field_actor.levels.values.tobytes(), scene.style)
        if (about, lines) == self._asked:
            return
        if self._asked[:1] != (about,):
            self.statistics = self._correlation = None
            if shown.answer.field is None:
                self._background.ask(None)
                self._refuse(None, shown.answer.failure or NO_FIELD)
            else:
                parts = question if isinstance(question, DifferenceQuestion) else None
                self._request = _Request(loaded, shown.answer, shown.answer.field, parts)
                self._background.ask(self._request)
        else:
            self._show()
        self._asked = (about, lines)
        self.levels.show_levels(levels_of(context, id))

    def _refuse(self, request: object, sentence: str) -> None:
        self.statistics = None
        self.sentence.setText(sentence)
        self._show()

    def _take(self, request: _Request, answer: FieldStatistics | float) -> None:
        if isinstance(answer, FieldStatistics):
            self.statistics = answer
        else:
            self._correlation = answer
        self._show()

    # ------------------------------------------------------------------ what is seen
    def _show(self) -> None:
        found = self.statistics
        for widget in (self.histogram, self.facts, self.quantiles):
            widget.setVisible(found is not None)
        self._save.setEnabled(found is not None)
        self.sentence.setVisible(found is None and bool(self.sentence.text()))
        there = [panel.id for panel in self.context.grid.panels]
        if found is None or self._request is None or self._panel not in there:
            return
        answer = self._request.answer
        scene = self.context.grid.panel(self._panel).view.scene
        top, signed = scene.field_actor.maximum, answer.is_signed
        colours = scene.style.bin_colours(found.bins, top, signed)
        self.histogram.show_bins(found.bins, found.areas, colours, answer.unit, signed)
        self._unit.setText(UNIT)
        self.facts.show_facts(self._facts(found, self._request))
        self.quantiles.show_facts(self._quantiles(found, answer))

    def _quantiles(self, found: FieldStatistics, answer: Answer, exact: bool = False) -> list[tuple[str, ...]]:
        return [
            (f"{100 * part:g} % of the area up to", *self._value_and_fraction(float(value), answer, exact=exact))
            for part, value in zip(found.fractions, found.quantiles, strict=True)
        ]

    def _facts(self, found: FieldStatistics, request: _Request, exact: bool = False) -> list[tuple[str, ...]]:
        """Return the rows of the table, with all digits if `exact`."""
        answer = request.answer

        def written(value: float, with_sign: bool = True) -> tuple[str, ...]:
            return self._value_and_fraction(value, answer, with_sign, exact)

        facts: list[tuple[str, ...]] = []
        if answer.is_signed:
            largest = float(request.field[found.largest_at])
            facts.append((f"largest, at vertex {found.largest_at}", *written(largest)))
            facts.append(("mean size, by area", *written(found.mean_size, False)))
        else:
            facts.append((f"greatest, at vertex {found.greatest_at}", *written(found.greatest)))
            facts.append((f"least, at vertex {found.least_at}", *written(found.least)))
        facts.append(("mean, by area", *written(found.mean)))
        facts.append(("standard deviation", *written(found.deviation, False)))
        if self._correlation is not None:
            facts.append(("rank correlation", repr(self._correlation) if exact else number(self._correlation)))
        return facts

    @staticmethod
    def _value_and_fraction(
        value: float, answer: Answer, with_sign: bool = True, exact: bool = False
    ) -> tuple[str, ...]:
        """Return a value and its fraction of the maximum, which a difference does not have."""
        signed = answer.is_signed and with_sign
        top = 0.0 if answer.signs else answer.maximum
        text = repr(float(value)) if exact else number(value, signed) + percent(answer.unit)
        if not top > 0:
            return (text,)
        return text, repr(float(value / top)) if exact else share(value / top, signed)

    # ------------------------------------------------------------------ what is saved
    def _there(self) -> tuple[_Request, FieldStatistics]:
        """Return the request and its statistics; ParameterError as long as there are none."""
        if self._request is None or self.statistics is None:
            raise ParameterError("There are no statistics yet; wait until the panel has a field.")
        return self._request, self.statistics

    def figure(self) -> "HistogramFigure":
        """Return the histogram in the style and the colours of figures."""
        from ...figures.chart_look import ChartLook
        from ...figures.histogram_figure import HistogramFigure

        (request, found), context = self._there(), self.context
        answer, page, document = request.answer, context.page, context.document
        style = style_of(page.style, document.colours)
        top = context.grid.panel(self._panel).view.scene.field_actor.maximum
        return HistogramFigure(
            found.bins,
            found.areas / found.areas.sum(),
            style.bin_colours(found.bins, top, answer.is_signed),
            self.name.text(),
            answer.unit,
            found.mean,
            ChartLook.of(page, style),
        )

    def _file_name(self) -> str:
        session = self.context.session
        words = field_names(session.document, [session.document.panel(self._panel)])
        return file_name([session.mesh(self._panel).surface.name], "histogram", *words)

    def save_figure(self, path: str = "") -> None:
        """Save the figure; ask for a path if there is none."""
        from ...figures.histogram_figure import save_histogram_figure

        save_figure(self.context, "Save the histogram", self._file_name(), save_histogram_figure, self.figure, path)

    def save_numbers(self, path: str = "") -> None:
        """Save the ends of each bin, and its area."""

        def write(path: str) -> None:
            _, found = self._there()
            table = np.column_stack([found.bins[:-1], found.bins[1:], found.areas])
            write_array(path, table, ["from", "to", "area"])

        save(self.context, "Save the histogram's numbers", self._file_name(), (".csv", ".npy"), write, path)

    def copy(self) -> None:
        """Copy what the dock says, with tabs and all digits, as spreadsheets read it."""
        with self.context.errors_shown():
            request, found = self._there()
            quantiles = self._quantiles(found, request.answer, True)
            facts = [(self.name.text(),), *self._facts(found, request, True), *quantiles]
            text = "".join("\t".join(fact) + "\n" for fact in facts)
            self.context.copy(text, "The statistics are on the clipboard")
