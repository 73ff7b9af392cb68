"""Tables, lists of rows and scrolled contents with the background of a dock."""

from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import Any

from qtpy import QtCore, QtWidgets

from ...document.document import Document, Panel
from ...document.quantities import quantity_name
from ...document.second_mesh_edits import panel_names
from ..look.form import in_column
from ..look.look import LOOK

CELL_PADS = 14
"""Padding at both sides of a column together, in pixels."""

SHEET = """
QTableWidget { background: transparent; border: none; }
QTableWidget::item { padding: 0px 6px 0px 0px; }
QHeaderView::section:horizontal { padding: 4px 6px 4px 2px; }
QHeaderView::section:vertical { padding: 4px 4px 4px 12px; border: none; }
"""


ROW_HEIGHT, HEAD_HEIGHT = 30, 32


class PanelTable(QtWidgets.QTableWidget):
    """A table with a column of numbers for each of some panels: read-only, as high as its rows, without lines and
    without a background of its own."""

    def __init__(self, name: str, least_width: int) -> None:
        super().__init__()
        self._least_width = least_width
        self.setAccessibleName(name)
        self.setEditTriggers(QtWidgets.QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setShowGrid(False)
        self.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
        self.setTabKeyNavigation(False)
        self.setVerticalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setStyleSheet(SHEET)
        for header in (self.horizontalHeader(), self.verticalHeader()):
            header.setHighlightSections(False)
            header.setTextElideMode(QtCore.Qt.TextElideMode.ElideRight)
        self.horizontalHeader().setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.Fixed)
        self.horizontalHeader().setMinimumSectionSize(1)

    def make_cells(self, rows: int, columns: int) -> None:
        """Make a grid of empty cells."""
        self.setRowCount(rows)
        self.setColumnCount(columns)
        for row in range(rows):
            for column in range(columns):
                cell = QtWidgets.QTableWidgetItem()
                cell.setTextAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
                self.setItem(row, column, cell)

    def fit(self, document: Document, panels: Sequence[Panel]) -> None:
        """Name the columns by their panels, and give all rows and columns the room that they need."""
        scale = LOOK.scale
        for row in range(self.rowCount()):
            self.setRowHeight(row, round(ROW_HEIGHT * scale))
        height = round(HEAD_HEIGHT * scale) + self.rowCount() * round(ROW_HEIGHT * scale) + 2
        if self._show_columns(document, panels):
            height += self.horizontalScrollBar().sizeHint().height()
        self.setFixedHeight(height)

    def _show_columns(self, document: Document, panels: Sequence[Panel]) -> bool:
        """Let each column be as wide as what is in it; return whether the table has to be scrolled.

        Names are short where the whole ones have no room; what is left over is spread over all columns.
        """
        cells = [[self.item(row, k) for row in range(self.rowCount())] for k in range(len(panels))]
        in_cell, in_head = (each.fontMetrics().horizontalAdvance for each in (self, self.horizontalHeader()))
        wide = [max([in_cell(cell.text()) for cell in column if cell], default=0) for column in cells]
        room = self.width() - self.verticalHeader().width()
        for are_short in (False, True):
            names = panel_names(document, panels, are_short)
            widths = [
                max(self._least_width, text + CELL_PADS, in_head(name) + CELL_PADS)
                for text, name in zip(wide, names, strict=True)
            ]
            if sum(widths) <= room:
                break
        spare = max(room - sum(widths), 0)
        for k, (name, width) in enumerate(zip(names, widths, strict=True)):
            item = QtWidgets.QTableWidgetItem(name)
            item.setTextAlignment(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
            item.setToolTip(quantity_name(panels[k].shows))
            self.setHorizontalHeaderItem(k, item)
            self.setColumnWidth(k, width + spare * (k + 1) // len(panels) - spare * k // len(panels))
        return bool(sum(widths) > room)


def fill(dock: QtWidgets.QWidget, inside: QtWidgets.QWidget) -> None:
    """Fill a dock with a widget, which is scrolled where there is not enough room."""
    scrolled = QtWidgets.QScrollArea()
    scrolled.setWidgetResizable(True)
    scrolled.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    scrolled.setWidget(inside)
    for widget in (inside, scrolled.viewport()):
        widget.setAutoFillBackground(False)
    in_column(scrolled, of=dock, spacing=0)


class RowList(QtWidgets.QVBoxLayout):
    """Rows one below the other; `rows` has them in their order, by the words or ids that they are made for."""

    def __init__(self, make: Callable[[Any], QtWidgets.QWidget], spacing: int = 0) -> None:
        super().__init__()
        self.setSpacing(spacing)
        self._make = make
        self.rows: dict[Any, Any] = {}

    def show_rows(self, words: Iterable[Hashable]) -> None:
        """Show a row for each of these words, in this order: rows of others go, and new ones are made."""
        before = dict(self.rows)
        self.rows.clear()
        for place, word in enumerate(words):
            row = self.rows[word] = before.pop(word, None) or self._make(word)
            if self.indexOf(row) != place:
                self.removeWidget(row)
                self.insertWidget(place, row)
        for gone in before.values():
            gone.hide()
            gone.deleteLater()

    def beside(self, word: str, by: int) -> str:
        """Return the word of the row that is `by` rows below, "" for none."""
        words = list(self.rows)
        place = words.index(word) + by
        return words[place] if 0 <= place < len(words) else ""

    def after_removal(self, word: str) -> str:
        """Return the word of the row that takes the focus as this one is removed: the next, or the last."""
        return self.beside(word, 1) or self.beside(word, -1)
