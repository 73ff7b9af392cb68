"""One panel's field against another's over all vertices: how well they agree, and selections by a lasso or a brush."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.field_scatter import FieldScatter, field_scatter
from bihdist_core.analysis.field_statistics import Agreement, field_agreement
from bihdist_core.arrays import AnyArray, FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.formats.field_output import write_array
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.file_names import file_name
from ...document.quantities import quantity_name
from ...document.runs import ids_of
from ...document.shared_parts.selections import Selections
from ...drawing.chart import Axis
from ...drawing.numbers import number, share
from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.docks.fact_table import FactTable
from ...qt.docks.instrument import NO_FIELD, Instrument
from ...qt.files.exports import save_figure
from ...qt.files.saving import save
from ...qt.look.controls import Segments
from ...qt.look.form import describe, heading, in_column, in_row, quiet_label
from ...qt.look.icons import put_icon
from ...qt.look.look import LOOK
from ...qt.panels.badges import curve_colour
from ...qt.panels.flat_button import FlatButton, add_entry, icon_button, menu_button
from ...scene.density import axis_ends
from .chart import ScatterChart
from .part import Scatter
from .selection_list import SelectionList

if TYPE_CHECKING:
    from ...figures.scatter_figure import ScatterFigure

SIDE = 250
"""Logical pixels for the numbers and the selections."""


@dataclass(frozen=True, eq=False)
class _Request:
    surface: Surface
    across: Answer
    up: Answer
    fields: tuple[FloatArray, FloatArray]  # of the two answers, (n,) each
    shares: bool

    @property
    def has_common_unit(self) -> bool:
        return self.shares or self.across.unit == self.up.unit


def _compute(request: _Request, progress: Progress) -> Iterator[FieldScatter | Agreement]:
    scatter = field_scatter(request.surface, *request.fields, request.shares)
    scatter.sort()
    yield scatter
    yield field_agreement(request.surface, *request.fields, request.shares)


class ScatterDock(Instrument):
    word, area = "scatter", "below"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.chart = ScatterChart()
        self.chart.lassoed.connect(self._select)
        self.chart.pointed.connect(self._point)
        self.facts = FactTable()
        self.list = SelectionList(context)
        self.list.chosen.connect(context[Brushing].choose)
        tip = "Begin a new selection with the next stroke of the brush"
        self._new = icon_button(self, "add-panel", tip, self._begin, "Begin a new selection")
        tip = "Save, colour, rename or delete the selection"
        self._more = icon_button(self, "more", tip, self._open_menu, "More about the selection")
        self._heading = heading("Selections")
        self._hint = quiet_label("Draw around points here, or hold B and drag on a surface.", wraps=True)
        self._hint.setAlignment(QtCore.Qt.AlignmentFlag.AlignTop)
        self._below = QtWidgets.QStackedWidget()  # of one size, whichever is shown
        self._below.addWidget(self._hint)
        self._below.addWidget(self.list)
        side = QtWidgets.QWidget()
        side.setFixedWidth(SIDE)
        row = in_row((self._heading, 1), self._new, self._more)
        in_column(self.facts, row, (self._below, 1), of=side, spacing=4, margins=(8, 8, 12, 8))
        in_row((self.chart, 1), side, of=self, spacing=0)
        self.across_button, self.up_button = self._panel_button("across"), self._panel_button("up")
        self.shares = Segments({"Value": "value", "%": "shares"}, "Values")
        self.shares.buttons["shares"].setToolTip("Values: fractions of each maximum")
        self.shares.chosen.connect(lambda word: self._change(shares=word == "shares"))
        brushing = context[Brushing]
        self.brush = QtWidgets.QToolButton(checkable=True, iconSize=QtCore.QSize(20, 20))
        put_icon(self.brush, "brush")
        describe(self.brush, "Brush", "Brush: drag on a surface to select (or hold B; Ctrl takes away)")
        self.brush.clicked.connect(brushing.switch)
        self.radius = brushing.size_slider()
        self.radius.setFixedWidth(64)
        self.radius.hide()
        brushing.switched.connect(self.brush.setChecked)
        brushing.switched.connect(self.radius.setVisible)
        brushing.stroked.connect(lambda vertices: self.chart.show_stroke(vertices, brushing.colour))
        self.head += [self.up_button, self.across_button, self.shares, self.brush, self.radius]
        menu = {"Save as a figure…": self.save_figure, "Save the numbers…": self.save_numbers}
        self._save = self.add_head_button("save", "Save the scatter as a figure, or its numbers", menu, "Save scatter")
        self._save.setEnabled(False)
        self._found: Agreement | None = None
        self._asked: tuple[object, ...] = ()
        self._request: _Request | None = None
        self._background = context.background("scatter", _compute, self._take, self._refuse)
        LOOK.follow(self, self._apply_theme)

    # ------------------------------------------------------------------ what is shown
    def show_document(self, document: Document, before: Document | None) -> None:
        self.shares.choose("shares" if document[Scatter].shares else "value")
        names = self._names(document) or ("", "")
        for button, name in zip((self.across_button, self.up_button), names, strict=True):
            button.setText(name)
            button.updateGeometry()
        if before is None or document[Selections].selections != before[Selections].selections:
            self.chart.show_selections([(ids_of(each.runs), each.colour) for each in document[Selections].selections])
        self.list.show_selections(document[Selections].selections, self.context[Brushing].current)
        self._below.setCurrentWidget(self.list if document[Selections].selections else self._hint)
        self._compare()

    def show_answer(self, panel: int) -> None:
        if panel in (self._pair(self.document) or ()):
            self._compare()

    def show_pointed(self, vertex: int | None) -> None:
        self.chart.mark(vertex)

    def show_closed(self) -> None:
        self.context[Brushing].switch(False)  # its button is gone

    def _apply_theme(self) -> None:
        self._asked = ()
        if self.isVisible():
            self._compare()

    @staticmethod
    def _pair(document: Document) -> tuple[int, int] | None:
        """Return the panels across and up, chosen or the first that are left; None if there is none."""
        ids = [panel.id for panel in document.panels_of()]
        if not ids:
            return None
        across, up = (id if id in ids else None for id in (document[Scatter].across, document[Scatter].up))
        if across is None:
            across = next((id for id in ids if id != up), ids[0])
        if up is None:
            up = next((id for id in ids if id != across), across)
        return across, up

    @staticmethod
    def _name(document: Document, id: int) -> str:
        """Return the name of a panel, with its place where others have the same name."""
        names = {panel.id: quantity_name(panel.shows) for panel in document.panels_of()}
        place = list(names).index(id) + 1
        return f"{names[id]} ({place})" if list(names.values()).count(names[id]) > 1 else names[id]

    def _names(self, document: Document) -> tuple[str, str] | None:
        """Return the names of the panels across and up."""
        pair = self._pair(document)
        return None if pair is None else (self._name(document, pair[0]), self._name(document, pair[1]))

    def _compare(self) -> None:
        """Ask for what is to be shown, if it is not shown yet."""
        session = self.context.session
        document, shown = session.document, session.shown
        pair = self._pair(document)
        if session.loaded() is None or pair is None or not shown.keys() >= set(pair):
            return  # on its way
        across, up = (shown[panel].answer for panel in pair)
        key = (id(across.field), id(up.field), document[Scatter].shares, *pair, document.panels)
        if key == self._asked:
            return
        self._asked = key
        if across.field is None or up.field is None:
            self._background.ask(None)
            self._refuse(None, (across if across.field is None else up).failure or NO_FIELD)
            return
        fields = across.field, up.field
        self._request = _Request(session.mesh().surface, across, up, fields, document[Scatter].shares)
        self._background.ask(self._request)

    def _refuse(self, request: object, sentence: str) -> None:
        self._found = None
        self._save.setEnabled(False)
        self.chart.show_nothing(sentence)
        self.facts.show_facts([])

    def _take(self, request: _Request, answer: FieldScatter | Agreement) -> None:
        if isinstance(answer, FieldScatter):
            self._show_scatter(request, answer)
        else:
            self._show_agreement(request, answer)

    def _show_scatter(self, request: _Request, scatter: FieldScatter) -> None:
        document = self.document
        pair = self._pair(document)
        if pair is None:
            return
        ids = [panel.id for panel in document.panels]
        name, other = ((self._name(document, id), curve_colour(ids.index(id))) for id in pair)
        across, up = (
            Axis(low, high, "" if request.shares else answer.unit, request.shares)
            for (low, high), answer in zip(
                axis_ends(scatter, request.has_common_unit), (request.across, request.up), strict=True
            )
        )
        self._found = None
        self._save.setEnabled(True)
        self.chart.show_scatter(scatter, (name, other), (across, up), request.has_common_unit)

    def _show_agreement(self, request: _Request, found: Agreement) -> None:
        self._found = found
        noun, nouns = request.surface.nouns
        lines = [("rank correlation", number(found.spearman)), ("rank correlation by area", number(found.by_area))]
        if request.has_common_unit:
            across, up = (
                field[found.largest_at] / (np.nanmax(np.abs(field)) if request.shares else 1.0)
                for field in request.fields
            )
            sign = np.sign(across - up)  # as in a panel of the difference of the two
            written = share if request.shares else number
            lines += [
                ("mean deviation, by area", written(found.mean)),
                (f"largest, at {noun} {found.largest_at}", written(float(sign * found.largest), signed=True)),
            ]
        lines.append((nouns, f"{found.count:,}"))
        self.facts.show_facts(lines)
        self.chart.mark_largest(found.largest_at if request.has_common_unit else None)

    # ------------------------------------------------------------------ what the user does
    def _panel_button(self, side: str) -> FlatButton:
        """Return the button of a side, "across" or "up", with a menu of the panels."""

        def fill(menu: QtWidgets.QMenu) -> None:
            document = self.document
            chosen = dict(zip(("across", "up"), self._pair(document) or (-1, -1), strict=True))[side]
            for panel in document.panels_of():
                choose = partial(self.choose_panel, side, panel.id)
                add_entry(menu, self._name(document, panel.id), choose, panel.id == chosen)

        button = menu_button(self, fill, f"{side.capitalize()}: the field of this panel")
        button.setSizePolicy(QtWidgets.QSizePolicy.Policy.Preferred, QtWidgets.QSizePolicy.Policy.Fixed)
        button.symbol = side
        return button

    def choose_panel(self, side: str, id: int) -> None:
        """Choose the panel of a side, "across" or "up"; the other panel takes its place if they would be the same."""
        document = self.document
        across, up = self._pair(document) or (id, id)
        if side == "across":
            across, up = id, across if up == id else up
        else:
            across, up = up if across == id else across, id
        self._change(across=across, up=up)

    def _change(self, **changes: Any) -> None:
        """Change fields of the document's `Scatter`."""
        self.context.session.apply(lambda document: document.with_changed(Scatter, **changes))

    def _select(self, corners: AnyArray, keys: QtCore.Qt.KeyboardModifier) -> None:
        modifier = QtCore.Qt.KeyboardModifier
        way = "added" if keys & modifier.ShiftModifier else "removed" if keys & modifier.ControlModifier else "new"
        if self.chart.scatter is not None:
            self.context[Brushing].select(self.chart.scatter.inside(corners), way)

    def _begin(self) -> None:
        self.context[Brushing].choose("")
        self.list.show_selections(self.document[Selections].selections, "")

    def _open_menu(self) -> None:
        if self.list.current:
            self.list.menu().popup(self._more.mapToGlobal(QtCore.QPoint(0, self._more.height())))

    def _point(self, at: tuple[float, float] | None) -> None:
        """Mark what is under the pointer of the chart on all panels."""
        vertex = None if at is None else self.chart.vertex_at(*at)
        self.chart.mark(vertex)
        context = self.context
        panel = next((panel.id for panel in context.document.panels_of()), None)
        if panel is None:
            return
        context.grid.pointing.show(panel, vertex)
        surface = context.session.mesh(panel).surface
        position = None if vertex is None else surface.vertices[vertex]
        context.status.show_place(vertex, position, surface)

    # ------------------------------------------------------------------ what is saved
    def figure(self) -> "ScatterFigure":
        """Return the figure of the chart, in the style of the page; ParameterError if it shows nothing."""
        from .figure import scatter_figure

        context, request, scatter = self.context, self._request, self.chart.scatter
        names = self._names(context.document)
        if scatter is None or request is None or names is None:
            raise ParameterError("There is no scatter plot yet; wait until both panels have a field.")
        units = request.across.unit, request.up.unit
        return scatter_figure(context.document, context.page, scatter, self._found, names, units)

    def _file_name(self) -> str:
        session = self.context.session
        panels = [session.document.panel(id) for id in self._pair(session.document) or ()]
        return file_name([session.mesh().surface.name], "scatter", *(str(panel.shows) for panel in panels))

    def save_figure(self, path: str = "") -> None:
        """Save the figure; ask for a path if there is none."""
        from ...figures.scatter_figure import save_scatter_figure

        save_figure(
            self.context, "Save the scatter as a figure", self._file_name(), save_scatter_figure, self.figure, path
        )

    def save_numbers(self, path: str = "") -> None:
        """Save the vertices, both fields there, and a column for each selection, 1 at its vertices."""
        context, scatter = self.context, self.chart.scatter
        if scatter is None:
            return
        document = context.document
        header = ["vertex", *(self._names(document) or ())]
        chosen = [np.isin(scatter.ids, ids_of(each.runs)) for each in document[Selections].selections]
        table = np.column_stack([scatter.ids, scatter.x, scatter.y, *chosen])
        header += [each.name for each in document[Selections].selections]

        def write(path: str) -> None:
            write_array(path, table, header)

        save(context, "Save the scatter's numbers", self._file_name(), (".csv",), write, path)
