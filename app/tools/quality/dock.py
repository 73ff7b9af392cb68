"""The quality of every panel's distance as numbers, as soon as each is known, with charts of circles."""

from qtpy import QtCore, QtGui, QtWidgets

from bihdist_core.analysis.triangle_samples import TRIANGLE_POINTS

from ...document.document import Document
from ...document.edits import mark_extrema
from ...document.quantities import quantity_name
from ...qt.context import Context
from ...qt.docks.dock import PAD
from ...qt.docks.instrument import Instrument
from ...qt.docks.panel_dots import curve_colour
from ...qt.docks.plain import fill, lie_on_dock
from ...qt.look.look import LOOK
from ...qt.panels.flat_button import FlatButton
from .findings import QualityFindings
from .judgement import Found
from .measures import MEASURES, NONE, WAITING
from .polar_chart import PolarChart

ROW, HEAD = 30, 32
LEAST_COLUMN = 64
"""Logical pixels of a panel's column."""

BEHIND = 14
"""The same behind the names of rows."""

BESIDE = 3
"""Charts in a row."""


class QualityDock(Instrument):
    """A row for each of MEASURES, a column for each panel; below, a chart for each."""

    word, title = "quality", "Quality"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self.table = QtWidgets.QTableWidget(len(MEASURES), 0)
        self.table.setAccessibleName("Quality of the panels' distances")
        self.table.setVerticalHeaderLabels([measure.name for measure in MEASURES])
        for row, measure in enumerate(MEASURES):
            self.table.verticalHeaderItem(row).setToolTip(f"<qt>{measure.tip}</qt>")
        lie_on_dock(self.table)
        self.table.setVerticalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.table.horizontalHeader().setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.Stretch)
        self.table.horizontalHeader().setMinimumSectionSize(LEAST_COLUMN)
        self.table.cellDoubleClicked.connect(self._go_to)
        self.tick = QtWidgets.QCheckBox("Mark extrema in figures, too")
        self.tick.setToolTip(
            "<qt>The triangles stay when this dock is closed, and are in figures, movies and recipes.</qt>"
        )
        self.tick.clicked.connect(self._keep_marks)
        self._heading = QtWidgets.QLabel("Circles around the source")
        self._heading.setProperty("heading", True)
        self._heading.setToolTip(
            "<qt>The distance along geodesic circles of 3 to 12 mean edges around the source, seen from above: as far "
            "from the middle as it is large. Grey: the same, were it equal in all directions.</qt>"
        )
        self._columns: list[int] = []  # the panels, by id
        self.charts: dict[int, PolarChart] = {}
        self._before: dict[int, Found] = {}  # what was found of a panel's quantity from another source
        self._names: dict[int, QtWidgets.QLabel] = {}
        self._charts = QtWidgets.QWidget()
        self._grid = QtWidgets.QGridLayout(self._charts)
        self._grid.setContentsMargins(PAD, 0, PAD, PAD)
        self._grid.setSpacing(8)
        inside = QtWidgets.QWidget()
        column = QtWidgets.QVBoxLayout(inside)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        beside = QtWidgets.QHBoxLayout()
        beside.setContentsMargins(0, 0, PAD - 6, 0)  # the cells have the rest
        beside.addWidget(self.table)
        column.addLayout(beside)
        row = QtWidgets.QHBoxLayout()
        row.setContentsMargins(PAD, 0, PAD, 0)
        row.addWidget(self.tick)
        column.addLayout(row)
        heading = QtWidgets.QHBoxLayout()
        heading.setContentsMargins(PAD, 4, PAD, 0)
        heading.addWidget(self._heading)
        column.addLayout(heading)
        column.addWidget(self._charts)
        column.addStretch(1)
        fill(self, inside)
        self.copy_button = FlatButton(self, "copy")
        self.copy_button.setToolTip("Copy the table as text")
        self.copy_button.setAccessibleName("Copy the table as text")
        self.copy_button.activated.connect(self.copy)
        context[QualityFindings].changed.connect(self._fill)
        LOOK.follow(self, self._restyle)

    def head_widgets(self) -> list[QtWidgets.QWidget]:
        return [self.copy_button]

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
        panels = document.panels
        self._columns = [panel.id for panel in panels]
        self.table.setColumnCount(len(panels))
        for k, panel in enumerate(panels):
            item = QtWidgets.QTableWidgetItem(quantity_name(panel.shows))
            item.setTextAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
            item.setToolTip(quantity_name(panel.shows))
            self.table.setHorizontalHeaderItem(k, item)
            for row in range(len(MEASURES)):
                cell = QtWidgets.QTableWidgetItem()
                cell.setTextAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
                self.table.setItem(row, k, cell)
        for id in [id for id in self.charts if id not in {panel.id for panel in panels}]:
            for widget in (self.charts.pop(id), self._names.pop(id)):
                widget.hide()
                widget.deleteLater()
        for k, panel in enumerate(panels):
            if panel.id not in self.charts:
                self.charts[panel.id], self._names[panel.id] = PolarChart(), QtWidgets.QLabel()
                self._names[panel.id].setProperty("small", True)
                self._names[panel.id].setAlignment(QtCore.Qt.AlignmentFlag.AlignHCenter)
            row, column = divmod(k, BESIDE)
            middle = QtCore.Qt.AlignmentFlag.AlignHCenter
            self._grid.addWidget(self.charts[panel.id], 2 * row, column, middle)
            self._grid.addWidget(self._names[panel.id], 2 * row + 1, column, middle)
            metrics = QtGui.QFontMetrics(LOOK.font(12))
            name = metrics.elidedText(
                quantity_name(panel.shows), QtCore.Qt.TextElideMode.ElideRight, self.charts[panel.id].width() + 8
            )
            self._names[panel.id].setText(name)
        for column in range(BESIDE):
            self._grid.setColumnStretch(column, 1)
        self._measure()

    def _fill(self) -> None:
        document = self.context.document
        if self._columns != [panel.id for panel in document.panels]:
            return  # the document's change is on its way
        progress_display, sampled = False, dict[int, int]()
        for k, panel in enumerate(document.panels):
            found = self.context[QualityFindings].found(panel.id)
            failed = self._failed(panel.id)
            old = self._before.get(panel.id, Found())
            if found.whole is not None:
                self._before[panel.id] = found
            for row, measure in enumerate(MEASURES):
                text, tip = (NONE, "") if failed else (measure.written(found), measure.sentence(found))
                is_old = text == WAITING
                progress_display |= is_old
                # Until there are new ones the old numbers stay, so that one sees how they change.
                cell = self.table.item(row, k)
                cell.setText(measure.written(old) if is_old else text)
                cell.setToolTip("From where the source was; it is being measured." if is_old else tip)
                cell.setForeground(QtGui.QColor(LOOK.theme.disabled if is_old else LOOK.theme.text))
            sampled |= {} if failed or found.triangles is None or found.is_sampled else {panel.id: found.points}
            whole = found.whole or (None if failed or found.failure else old.whole)
            colour = curve_colour(k) if found.whole is not None else LOOK.theme.disabled
            self.charts[panel.id].show_circles(whole.circles if whole is not None else (), colour)
        # Only exact geodesic distances take long enough for it to be seen.
        share = f"triangles, {min(sampled.values())} of {TRIANGLE_POINTS:,} points" if sampled else ""
        self.note_changed.emit("measuring…" if progress_display else share)

    def _failed(self, panel: int) -> bool:
        """Whether there is no field that could be measured."""
        shown = self.context.session.shown.get(panel)
        return shown is not None and shown.answer.field is None

    def text(self) -> str:
        """The table, with tabulators and all digits."""
        panels = self.context.document.panels
        found = [self.context[QualityFindings].found(panel.id) for panel in panels]
        lines = [["", *(quantity_name(panel.shows) for panel in panels)]]
        lines += [
            [
                each.name,
                *(
                    NONE if self._failed(panel.id) else each.with_all_digits(of)
                    for panel, of in zip(panels, found, strict=True)
                ),
            ]
            for each in MEASURES
        ]
        return "\n".join("\t".join(line) for line in lines)

    def copy(self) -> None:
        """Copy the table to the clipboard."""
        QtWidgets.QApplication.clipboard().setText(self.text())
        self.context.tell("The table is in the clipboard")

    def _keep_marks(self, is_on: bool) -> None:
        session = self.context.session
        session.show(mark_extrema(session.document, is_on))

    def _go_to(self, row: int, column: int) -> None:
        """To the place that a number is about."""
        panel = self.context.document.panels[column]
        found = self.context[QualityFindings].found(panel.id)
        vertex = _place(MEASURES[row].name, found)
        if vertex is not None:
            widget = self.context.grid.panel(panel.id)
            widget.view.centre(widget.positions[vertex])

    # ------------------------------------------------------------------ how it looks
    def _measure(self) -> None:
        scale = LOOK.scale
        # No wider than its words: the columns need the room.
        names = self.table.verticalHeader()
        widest = max(QtGui.QFontMetrics(LOOK.font()).horizontalAdvance(measure.name) for measure in MEASURES)
        names.setFixedWidth(widest + PAD + round(BEHIND * scale))
        for row in range(self.table.rowCount()):
            self.table.setRowHeight(row, round(ROW * scale))
        height = round(HEAD * scale) + self.table.rowCount() * round(ROW * scale)
        if self.table.columnCount() * LEAST_COLUMN + names.width() > self.width():
            height += self.table.horizontalScrollBar().sizeHint().height()
        self.table.setFixedHeight(height)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self._measure()

    def _restyle(self) -> None:
        self._measure()
        self._fill()


def _place(measure: str, found: Found) -> int | None:
    """The vertex that one of the measures is about."""
    if measure in ("Largest kink", "Kink length"):
        vertex = -1 if found.whole is None else int(found.whole.kink_edge[0])
        return vertex if vertex >= 0 else None
    if found.extrema is None or measure not in ("Other minima", "Maxima"):
        return None
    places = found.extrema.minima if measure == "Other minima" else found.extrema.maxima[:1]
    return int(places[0]) if len(places) else None
