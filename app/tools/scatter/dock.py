"""One panel's field against another's over all vertices: how well they agree, and selections by a lasso or a brush."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core import ParameterError, Surface
from bihdist_core.analysis.field_scatter import FieldScatter, field_scatter
from bihdist_core.analysis.field_statistics import Agreement, field_agreement
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.distances.answers import Answer
from bihdist_core.formats.field_output import write_array
from bihdist_core.progress import Progress

from ...document.document import Document
from ...document.file_names import file_name
from ...document.quantities import quantity_name
from ...document.runs import ids_of
from ...document.shared_parts.selections import Selections
from ...qt.context import Context
from ...qt.docks.brushing import Brushing
from ...qt.docks.chart import Axis
from ...qt.docks.fact_table import FactTable
from ...qt.docks.instrument import NO_FIELD, Instrument
from ...qt.files.chart_files import save_figure
from ...qt.files.saving import save, written
from ...qt.look.icons import put_icon
from ...qt.look.look import LOOK
from ...qt.look.numbers import number, share
from ...qt.look.segments import Segments
from ...qt.panels.flat_button import FlatButton
from ...scene.density import axis_ends
from ...scene.style import PINS, style_of
from .chart import ScatterChart
from .part import Scatter
from .selection_list import SelectionList

if TYPE_CHECKING:
    from ...figures.scatter_figure import ScatterFigure

SIDE = 250
"""Logical pixels for the numbers and the selections."""


@dataclass(frozen=True, eq=False)
class _Request:
    """fields: those of the two answers, (n,) each."""

    surface: Surface
    across: Answer
    up: Answer
    fields: tuple[FloatArray, FloatArray]
    shares: bool

    @property
    def has_common_unit(self) -> bool:
        return self.shares or self.across.unit == self.up.unit


def _compared(request: _Request, progress: Progress) -> Iterator[FieldScatter | Agreement]:
    scatter = field_scatter(request.surface, *request.fields, request.shares)
    scatter.sort()
    yield scatter
    yield field_agreement(request.surface, *request.fields, request.shares)


class ScatterDock(Instrument):
    word, title, area = "scatter", "Scatter", "below"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.chart = ScatterChart()
        self.chart.lassoed.connect(self._select)
        self.chart.pointed.connect(self._point)
        self.facts = FactTable()
        self.list = SelectionList(context)
        self.list.chosen.connect(self._choose)
        self._new = FlatButton(self, "add-panel")
        self._new.setToolTip("Begin a new selection: the brush adds to none that is there")
        self._new.setAccessibleName("Begin a new selection")
        self._new.activated.connect(self._begin)
        self._more = FlatButton(self, "more")
        self._more.setToolTip("Save, colour, rename or delete the selection")
        self._more.setAccessibleName("What to do with the selection")
        self._more.activated.connect(self._open_menu)
        heading = QtWidgets.QHBoxLayout()
        self._heading = QtWidgets.QLabel("Selections")
        self._heading.setProperty("heading", True)
        heading.addWidget(self._heading, 1)
        heading.addWidget(self._new)
        heading.addWidget(self._more)
        self._hint = QtWidgets.QLabel("Draw around points here, or hold B and drag on a surface.", wordWrap=True)
        self._hint.setProperty("quiet", True)
        side = QtWidgets.QWidget()
        side.setFixedWidth(SIDE)
        column = QtWidgets.QVBoxLayout(side)
        column.setContentsMargins(8, 8, 12, 8)
        column.setSpacing(4)
        column.addWidget(self.facts)
        column.addLayout(heading)
        self._hint.setAlignment(QtCore.Qt.AlignmentFlag.AlignTop)
        self._below = QtWidgets.QStackedWidget()  # of one size, whichever is shown
        self._below.addWidget(self._hint)
        self._below.addWidget(self.list)
        column.addWidget(self._below, 1)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        row.addWidget(self.chart, 1)
        row.addWidget(side)
        self.across_button, self.up_button = FlatButton(self), FlatButton(self)
        for button, words, side_word in (
            (self.across_button, "Across", "across"),
            (self.up_button, "Up", "up"),
        ):
            menu = QtWidgets.QMenu(button)
            menu.aboutToShow.connect(lambda menu=menu, side_word=side_word: self._fill(menu, side_word))
            button.setMenu(menu)
            button.setSizePolicy(QtWidgets.QSizePolicy.Policy.Preferred, QtWidgets.QSizePolicy.Policy.Fixed)
            button.symbol = words.lower()
            button.setToolTip(f"{words}: the field of this panel")
        self.shares = Segments({"Value": "value", "%": "shares"}, "Values")
        self.shares.buttons["shares"].setToolTip("Values: fractions of each maximum")
        self.shares.chosen.connect(self._choose_shares)
        self.brush = QtWidgets.QToolButton(checkable=True)
        put_icon(self.brush, "brush")
        self.brush.setToolTip("Brush: drag on a surface to select (or hold B; Ctrl takes away)")
        self.brush.setAccessibleName("Brush")
        self.brush.setIconSize(QtCore.QSize(20, 20))
        self.brush.clicked.connect(context[Brushing].switch)
        self.radius = QtWidgets.QSlider(QtCore.Qt.Orientation.Horizontal)
        self.radius.setRange(4, 28)
        self.radius.setValue(context[Brushing].radius)
        self.radius.setFixedWidth(64)
        self.radius.hide()
        self.radius.setToolTip("Size of the brush")
        self.radius.setAccessibleName("Size of the brush")
        self.radius.valueChanged.connect(context[Brushing].enlarge)
        context[Brushing].switched.connect(self.brush.setChecked)
        context[Brushing].switched.connect(self.radius.setVisible)
        context[Brushing].stroked.connect(self._show_stroke)
        self._save = FlatButton(self, "save")
        self._save.setToolTip("Save the scatter as a figure, or its numbers")
        self._save.setAccessibleName("What to do with the scatter")
        menu = QtWidgets.QMenu(self._save)
        menu.addAction("Save as a figure…", self.save_figure)
        menu.addAction("Save the numbers…", self.save_numbers)
        self._save.setMenu(menu)
        self._save.setEnabled(False)
        self._found: Agreement | None = None
        self._asked: tuple[object, ...] = ()
        self._request: _Request | None = None
        self._background = context.background("scatter", _compared)
        self._background.answered.connect(self._take)
        self._background.failed.connect(self._refuse)
        LOOK.follow(self, self._apply_theme)

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.up_button, self.across_button, self.shares, self.brush, self.radius, self._save]

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
        if panel in (self._pair(self.context.document) or ()):
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
        """The panels across and up: those that are chosen, or the first that are left; None where there is none."""
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
        """Of a panel, with its place where others have the same."""
        names = {panel.id: quantity_name(panel.shows) for panel in document.panels}
        place = list(names).index(id) + 1
        return f"{names[id]} ({place})" if list(names.values()).count(names[id]) > 1 else names[id]

    def _names(self, document: Document) -> tuple[str, str] | None:
        """Of the panels across and up."""
        pair = self._pair(document)
        return None if pair is None else (self._name(document, pair[0]), self._name(document, pair[1]))

    def _compare(self) -> None:
        """Ask for what is to be shown, if it is not shown yet."""
        session = self.context.session
        document, shown = session.document, session.shown
        pair = self._pair(document)
        if session.surface is None or pair is None or not shown.keys() >= set(pair):
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
        self._request = _Request(session.surface, across, up, fields, document[Scatter].shares)
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
        document = self.context.document
        pair = self._pair(document)
        if pair is None:
            return
        ids = [panel.id for panel in document.panels]
        curves = LOOK.theme.curves
        name, other = ((self._name(document, id), curves[ids.index(id) % len(curves)]) for id in pair)
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
        lines = [("rank correlation", number(found.spearman)), ("rank correlation by area", number(found.by_area))]
        if request.has_common_unit:
            across, up = (
                field[found.largest_at] / (np.nanmax(np.abs(field)) if request.shares else 1.0)
                for field in request.fields
            )
            sign = np.sign(up - across)
            written = share if request.shares else number
            lines += [
                ("mean deviation, by area", written(found.mean)),
                (f"largest, at vertex {found.largest_at}", written(float(sign * found.largest), signed=True)),
            ]
        lines.append(("vertices", f"{found.count:,}"))
        self.facts.show_facts(lines)
        self.chart.mark_largest(found.largest_at if request.has_common_unit else None)

    def _show_stroke(self, vertices: IntArray) -> None:
        brushing = self.context[Brushing]
        self.chart.show_stroke(vertices, brushing.colour)

    # ------------------------------------------------------------------ what the user does
    def _fill(self, menu: QtWidgets.QMenu, side: str) -> None:
        menu.clear()
        document = self.context.document
        across, up = self._pair(document) or (-1, -1)
        chosen = across if side == "across" else up
        for panel in document.panels_of():
            action = menu.addAction(self._name(document, panel.id))
            action.setCheckable(True)
            action.setChecked(panel.id == chosen)
            action.triggered.connect(lambda _=False, id=panel.id: self.choose_panel(side, id))

    def choose_panel(self, side: str, id: int) -> None:
        """side: "across" or "up"; the other panel takes the place of this one where they would be the same."""
        document = self.context.document
        across, up = self._pair(document) or (id, id)
        if side == "across":
            across, up = id, across if up == id else up
        else:
            across, up = up if across == id else across, id
        self.context.edit(document.with_part(replace(document[Scatter], across=across, up=up)))

    def _choose_shares(self, word: str) -> None:
        session = self.context.session
        scatter = replace(session.document[Scatter], shares=word == "shares")
        session.show(session.document.with_part(scatter))

    def _select(self, corners: AnyArray, keys: QtCore.Qt.KeyboardModifier) -> None:
        modifier = QtCore.Qt.KeyboardModifier
        way = "added" if keys & modifier.ShiftModifier else "removed" if keys & modifier.ControlModifier else "new"
        if self.chart.scatter is not None:
            self.context[Brushing].select(self.chart.scatter.inside(corners), way)

    def _choose(self, name: str) -> None:
        self.context[Brushing].choose(name)

    def _begin(self) -> None:
        self.context[Brushing].choose("")
        self.list.show_selections(self.context.document[Selections].selections, "")

    def _open_menu(self) -> None:
        if self.list.current:
            self.list.menu().popup(self._more.mapToGlobal(QtCore.QPoint(0, self._more.height())))

    def _point(self, at: tuple[float, float] | None) -> None:
        """What is under the pointer in the chart is marked on all panels."""
        vertex = None if at is None else self.chart.vertex_at(*at)
        self.chart.mark(vertex)
        context = self.context
        panel = next((panel.id for panel in context.document.panels_of()), None)
        if panel is None:
            return
        context.grid.pointing.show(panel, vertex)
        surface = context.session.surface
        context.status.show_place(vertex, None if vertex is None or surface is None else surface.vertices[vertex])

    # ------------------------------------------------------------------ what is saved
    def figure(self) -> "ScatterFigure":
        """What the chart shows, in the style of the page; ParameterError while it shows none."""
        from ...figures.chart_page import ChartLook
        from ...figures.scatter_figure import INCHES, ScatterAxis, ScatterFigure

        context, request, found = self.context, self._request, self._found
        document, page, scatter = context.document, context.page, self.chart.scatter
        names = self._names(document)
        if scatter is None or request is None or names is None:
            raise ParameterError("There is no scatter yet; wait until both panels have a field.")
        across, up = (
            ScatterAxis(name, "% of the maximum" if document[Scatter].shares else axis.unit, axis.low, axis.high)
            for name, axis in zip(names, (self.chart.across, self.chart.up), strict=True)
        )
        return ScatterFigure(
            scatter,
            across,
            up,
            in_shares=document[Scatter].shares,
            is_common=request.has_common_unit,
            selections=tuple(
                (each.name, ids_of(each.runs), PINS[each.colour]) for each in document[Selections].selections
            ),
            correlation=None if found is None else found.spearman,
            largest=found.largest_at if found is not None and request.has_common_unit else None,
            look=ChartLook.of(page, style_of(page.style, document.colours), INCHES),
        )

    def _file_name(self) -> str:
        session = self.context.session
        panels = [session.document.panel(id) for id in self._pair(session.document) or ()]
        return file_name([session.first_surface.name], "scatter", *(str(panel.shows) for panel in panels))

    def save_figure(self, *_: object, path: str = "") -> None:
        """path: asks for one if it is empty."""
        from ...figures.scatter_figure import save_scatter_figure

        save_figure(
            self.context, "Save the scatter as a figure", self._file_name(), save_scatter_figure, self.figure, path
        )

    def save_numbers(self, *_: object, path: str = "") -> None:
        """The vertices, both fields there, and a column for each selection, 1 at its vertices."""
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

        if path:
            written(context, path, write)
        else:
            save(context, "Save the scatter's numbers", self._file_name(), (".csv",), write)
