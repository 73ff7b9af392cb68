"""The quality of every panel's distance as numbers, as soon as each is known."""

from qtpy import QtGui, QtWidgets

from bihdist_core.analysis.triangle_samples import TRIANGLE_POINTS

from ...document.document import Document
from ...document.edits import mark_extrema
from ...document.second_mesh_edits import panel_names
from ...qt.context import Context
from ...qt.docks.instrument import PAD, Instrument
from ...qt.docks.plain import PanelTable, fill
from ...qt.look.form import in_column, in_row
from ...qt.look.look import LOOK
from .findings import QualityFindings
from .measures import MEASURES, NONE, WAITING
from .quality_worker import KnownQuality

MIN_COLUMN_WIDTH_PX = 50
"""Logical pixels of a panel's column."""

NAME_PAD_PX = 14
"""Logical pixels behind the names of rows."""


class QualityDock(Instrument):
    """A table with a row for each of MEASURES and a column for each panel."""

    word = "quality"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.table = PanelTable("Quality of the panels' distances", MIN_COLUMN_WIDTH_PX)
        self.table.setRowCount(len(MEASURES))
        self.table.setVerticalHeaderLabels([measure.name for measure in MEASURES])
        for row, measure in enumerate(MEASURES):
            self.table.verticalHeaderItem(row).setToolTip(f"<qt>{measure.tip}</qt>")
        self.table.cellDoubleClicked.connect(self._go_to)
        self.tick = QtWidgets.QCheckBox("Mark extrema in figures as well")
        self.tick.setToolTip(
            "<qt>The triangles stay when this dock is closed, and are in figures, movies and recipes.</qt>"
        )
        self.tick.clicked.connect(lambda is_on: context.session.show(mark_extrema(self.document, is_on)))
        self._columns: list[int] = []  # the panels, by id
        self._before: dict[int, KnownQuality] = {}  # what was found of a panel's quantity from another source
        inside = QtWidgets.QWidget()
        table = in_row(self.table, margins=(0, 0, PAD - 6, 0))  # the cells have the rest
        in_column(table, in_row(self.tick, margins=(PAD, 0, PAD, 0)), None, of=inside, spacing=8)
        fill(self, inside)
        self.copy_button = self.add_head_button("copy", "Copy the table as text", self.copy)
        context[QualityFindings].changed.connect(self._fill)
        LOOK.follow(self, self._fill)

    # ------------------------------------------------------------------ what is told
    def show_document(self, document: Document, before: Document | None) -> None:
        if before is None or document.panels != before.panels or document.surfaces != before.surfaces:
            shows = {} if before is None else {panel.id: panel.shows for panel in before.panels}
            same = {panel.id for panel in document.panels if shows.get(panel.id) == panel.shows}
            is_same_mesh = before is not None and document.surfaces == before.surfaces
            self._before = {id: found for id, found in self._before.items() if id in same and is_same_mesh}
            self._make_columns(document)
        self.tick.setChecked(document.extrema)
        self._fill()

    def show_answer(self, panel: int) -> None:
        self._fill()

    # ------------------------------------------------------------------ the table
    def _make_columns(self, document: Document) -> None:
        self._columns = [panel.id for panel in document.panels]
        self.table.make_cells(len(MEASURES), len(self._columns))
        self._measure()

    def _fill(self) -> None:
        document = self.document
        if self._columns != [panel.id for panel in document.panels]:
            return  # the document's change is on its way
        progress_display, sampled = False, dict[int, int]()
        for k, panel in enumerate(document.panels):
            found = self.context[QualityFindings].found(panel.id)
            failed = self._failed(panel.id)
            old = self._before.get(panel.id, KnownQuality())
            if found.whole is not None:
                self._before[panel.id] = found
            for row, measure in enumerate(MEASURES):
                text, tip = (NONE, "") if failed else (measure.written(found), measure.sentence(found))
                is_old = text == WAITING
                progress_display |= is_old
                # Until there are new ones the old numbers stay, so that one sees how they change.
                cell = self.table.item(row, k)
                cell.setText(measure.written(old) if is_old else text)
                cell.setToolTip("Of the previous source; the new value is being computed." if is_old else tip)
                cell.setForeground(QtGui.QColor(LOOK.theme.disabled if is_old else LOOK.theme.text))
            sampled |= {} if failed or found.triangles is None or found.is_sampled else {panel.id: found.points}
        self._measure()
        # Only exact geodesic distances take long enough for it to be seen.
        share = f"triangles, {min(sampled.values())} of {TRIANGLE_POINTS:,} points" if sampled else ""
        self.note_changed.emit("measuring…" if progress_display else share)

    def _failed(self, panel: int) -> bool:
        """Return whether a panel has no field to measure."""
        answer = self.context.session.answer(panel)
        return answer is not None and answer.field is None

    def text(self) -> str:
        """Return the table with tabs and all digits."""
        panels = self.document.panels
        found = [self.context[QualityFindings].found(panel.id) for panel in panels]
        lines = [["", *panel_names(self.document, panels)]]
        for each in MEASURES:
            numbers = [each.with_all_digits(of) for of in found]
            failed = [self._failed(panel.id) for panel in panels]
            lines.append([each.name, *(NONE if f else number for f, number in zip(failed, numbers, strict=True))])
        return "\n".join("\t".join(line) for line in lines)

    def copy(self) -> None:
        """Copy the table to the clipboard."""
        self.context.copy(self.text(), "The table is on the clipboard")

    def _go_to(self, row: int, column: int) -> None:
        """Centre the view on the place of a number."""
        panel = self.document.panels[column]
        found = self.context[QualityFindings].found(panel.id)
        vertex = _place(MEASURES[row].name, found)
        if vertex is not None:
            widget = self.context.grid.panel(panel.id)
            widget.view.centre(widget.positions[vertex])

    # ------------------------------------------------------------------ how it looks
    def _measure(self) -> None:
        # No wider than its words: the columns need the room.
        names = self.table.verticalHeader()
        widest = max(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(measure.name) for measure in MEASURES)
        names.setFixedWidth(widest + PAD + round(NAME_PAD_PX * LOOK.scale))
        self.table.fit(self.document, [panel for panel in self.document.panels if panel.id in self._columns])

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._measure()


def _place(measure: str, found: KnownQuality) -> int | None:
    """Return the vertex of a measure, None for the others."""
    if measure in ("Largest kink", "Kink length"):
        vertex = -1 if found.whole is None else int(found.whole.kink_edge[0])
        return vertex if vertex >= 0 else None
    if found.extrema is None or measure not in ("Other minima", "Maxima"):
        return None
    places = found.extrema.minima if measure == "Other minima" else found.extrema.maxima[:1]
    return int(places[0]) if len(places) else None
