"""The list of pins: a row for each with its number, name, vertex, and what every panel has there."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.painters.qt import number_width, paint_number
from ...qt.look.controls import TextBox
from ...qt.look.look import LOOK, baseline, paint_elided
from ...qt.panels.badges import Badge, paint_badge

ROW_HEIGHT_PX = 30
PAD_PX = 6
MIN_NAME_WIDTH_PX = 44
"""Logical pixels of a name at least; where there is no room for it the table is scrolled."""

TITLE_PAD_PX = 19
"""Logical pixels beside the words of a title, together."""

PIECES = re.compile(r"[^ ]+(?: −)?")
"""The pieces of a title that stay whole on a line; a minus stays with what is before it."""

BADGE, NAME, VERTEX = range(3)


@dataclass(frozen=True)
class PinRow:
    """A row of the table; `point` is its name in the document, and values that are still to change are `quiet`."""

    point: str
    number: int
    colour: str
    name: str
    vertex: str
    place: str
    values: tuple[str, ...]
    tips: tuple[str, ...] = ()
    quiet: tuple[bool, ...] = ()

    @property
    def texts(self) -> tuple[str, ...]:
        """The texts of the cells."""
        return str(self.number), self.name, self.vertex, *self.values


class PinTable(QtWidgets.QTableWidget):
    """The list of pins, by the names of their points.

    Signals: `chosen(points)` when other rows are selected, `named(point, name)` when a name has been typed,
    `moved(point, place)`, `removed(points)`, and `menu_wanted(where)`.
    """

    chosen = QtCore.Signal(tuple)
    named = QtCore.Signal(str, str)
    moved = QtCore.Signal(str, int)
    removed = QtCore.Signal(tuple)
    menu_wanted = QtCore.Signal(QtCore.QPoint)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.rows: tuple[PinRow, ...] = ()
        self.titles: tuple[str, ...] = ()
        self.short_titles: tuple[str, ...] = ()
        self._title_tips: tuple[str, ...] = ()
        self._is_filling = False
        self.setItemDelegate(_Cells(self))
        self.setAccessibleName("Pins")
        self.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectionBehavior.SelectRows)
        self.setSelectionMode(QtWidgets.QAbstractItemView.SelectionMode.ExtendedSelection)
        triggers = QtWidgets.QAbstractItemView.EditTrigger
        self.setEditTriggers(triggers.DoubleClicked | triggers.EditKeyPressed)
        self.setShowGrid(False)
        self.setFrameShape(QtWidgets.QFrame.Shape.NoFrame)
        self.setStyleSheet(
            "QTableView { background: transparent; border: none; } QHeaderView::section { padding: 4px 7px 4px 4px; }"
        )
        self.setHorizontalScrollMode(QtWidgets.QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setVerticalScrollMode(QtWidgets.QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.setTabKeyNavigation(False)
        self.setDragDropMode(QtWidgets.QAbstractItemView.DragDropMode.InternalMove)
        self.setDragDropOverwriteMode(False)
        self.setDropIndicatorShown(True)
        self.setContextMenuPolicy(QtCore.Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._open_menu)
        self.verticalHeader().hide()
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setMinimumSectionSize(20)
        header.setSectionResizeMode(QtWidgets.QHeaderView.ResizeMode.Fixed)
        self._points: tuple[str, ...] = ()
        self.itemSelectionChanged.connect(self._choose)
        self.itemChanged.connect(self._take_name)
        LOOK.follow(self, self.fit)

    # ------------------------------------------------------------------ what is shown
    def show_rows(
        self, rows: Sequence[PinRow], titles: Sequence[str], short_titles: Sequence[str], tips: Sequence[str]
    ) -> None:
        """Show these rows; those still there stay selected.

        Columns with little room have the titles of `short_titles`.
        """
        points, flag = self._points, QtCore.Qt.ItemFlag
        self.rows, self.titles = tuple(rows), tuple(titles)
        self.short_titles, self._title_tips = tuple(short_titles), tuple(tips)
        self._is_filling = True
        self.setRowCount(len(rows))
        self.setColumnCount(3 + len(titles))
        for k, row in enumerate(rows):
            for column, text in enumerate(row.texts):
                item = self.item(k, column)
                if item is None:
                    item = QtWidgets.QTableWidgetItem()
                    self.setItem(k, column, item)
                item.setText(text)
                item.setToolTip(row.tips[column - 3] if column > VERTEX and row.tips else row.place)
                item.setFlags(item.flags() if column == NAME else item.flags() & ~flag.ItemIsEditable)
        self._is_filling = False
        there = {row.point for row in rows}
        self.select(tuple(point for point in points if point in there))
        self.fit()
        self.viewport().update()

    def select(self, points: Sequence[str]) -> None:
        """Select the rows of these points."""
        wanted = [k for k, row in enumerate(self.rows) if row.point in points]
        if wanted != sorted(index.row() for index in self.selectionModel().selectedRows()):
            selection, index = QtCore.QItemSelection(), self.model().index
            for row in wanted:
                selection.select(index(row, 0), index(row, self.columnCount() - 1))
            self.selectionModel().select(selection, QtCore.QItemSelectionModel.SelectionFlag.ClearAndSelect)
            if wanted:
                self.scrollTo(index(wanted[0], NAME))
        self._choose()

    @property
    def points(self) -> tuple[str, ...]:
        """The points of the selected rows, in their order."""
        return self._points

    def rename(self) -> None:
        """Open the editor for the name of the first selected row."""
        rows = [index.row() for index in self.selectionModel().selectedRows()]
        if rows:
            self.edit(self.model().index(min(rows), NAME))

    def move(self, step: int) -> None:
        """Ask for the only selected row to be moved so many places down."""
        place = next(k for k, row in enumerate(self.rows) if row.point == self._points[0]) + step
        if 0 <= place < len(self.rows):
            self.moved.emit(self._points[0], place)

    def fit(self) -> None:
        """Make columns as wide as their content, with titles in several lines or short where there is little room.

        The name has the rest.
        """
        self.verticalHeader().setDefaultSectionSize(round(ROW_HEIGHT_PX * LOOK.scale))
        for titles in (self.titles, self.short_titles):
            if self._fit_columns(("", "Name", "Vertex", *titles)):
                break
        self.updateGeometries()

    def _fit_columns(self, titles: Sequence[str]) -> bool:
        """Fit the columns under these titles, and return whether all can be seen at a time."""
        scale = LOOK.scale
        font, metrics = LOOK.font(13), QtGui.QFontMetrics(LOOK.font(12))
        widths, more_for = {BADGE: round(24 * scale)}, {}
        for column, title in list(enumerate(titles))[VERTEX:]:
            texts = [row.texts[column] for row in self.rows]
            wide = max([number_width(font, text) for text in texts], default=0)
            longest = max(map(metrics.horizontalAdvance, PIECES.findall(title)), default=0)
            widths[column] = round(max(wide + 2 * PAD_PX, longest + TITLE_PAD_PX) + 0.5)
            more_for[column] = max(metrics.horizontalAdvance(title) + TITLE_PAD_PX - widths[column], 0)
        room = self.viewport().width() - sum(widths.values())
        names = [QtGui.QFontMetrics(font).horizontalAdvance(row.name) for row in self.rows]
        least = max(round(MIN_NAME_WIDTH_PX * scale), metrics.horizontalAdvance("Name") + TITLE_PAD_PX)
        room -= max([least, *(name + 2 * PAD_PX for name in names)])
        for column, missing in sorted(more_for.items(), key=lambda each: each[1]):
            # Where names need less, titles have more.
            more = min(missing, max(room, 0))
            widths[column] += more
            room -= more
        left = self.viewport().width() - sum(widths.values())
        widths[NAME] = max(left, least)
        for column, title in enumerate(titles[: self.columnCount()]):
            self.setColumnWidth(column, widths[column])
            head = QtWidgets.QTableWidgetItem(title)
            if column in more_for:
                head.setText(_in_lines(title, widths[column] - TITLE_PAD_PX, metrics.horizontalAdvance))
            side = QtCore.Qt.AlignmentFlag.AlignRight if column >= VERTEX else QtCore.Qt.AlignmentFlag.AlignLeft
            head.setTextAlignment(side | QtCore.Qt.AlignmentFlag.AlignVCenter)
            if column > VERTEX and self._title_tips:
                head.setToolTip(self._title_tips[column - 3])
            self.setHorizontalHeaderItem(column, head)
        return bool(left >= least)

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    # ------------------------------------------------------------------ what is done
    def _take_name(self, item: QtWidgets.QTableWidgetItem) -> None:
        """Emit a typed name; the row shows it once the document has it."""
        if not self._is_filling and item.column() == NAME:
            row, name = self.rows[item.row()], item.text().strip()
            self._is_filling = True
            item.setText(row.name)
            self._is_filling = False
            if name != row.name:
                self.named.emit(row.point, name)

    def supportedDropActions(self) -> QtCore.Qt.DropAction:
        """Rows are moved, and never copied."""
        return QtCore.Qt.DropAction.MoveAction

    def _choose(self) -> None:
        if self._is_filling:
            return
        chosen = sorted(index.row() for index in self.selectionModel().selectedRows())
        points = tuple(self.rows[row].point for row in chosen if row < len(self.rows))
        if points != self._points:
            self._points = points
            self.chosen.emit(points)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        keys, alt = QtCore.Qt.Key, QtCore.Qt.KeyboardModifier.AltModifier
        if event.key() in (keys.Key_Delete, keys.Key_Backspace) and self._points:
            self.removed.emit(self._points)
        elif event.key() in (keys.Key_Up, keys.Key_Down) and event.modifiers() & alt and len(self._points) == 1:
            self.move(1 if event.key() == keys.Key_Down else -1)
        elif event.key() in (keys.Key_Return, keys.Key_Enter):
            # The one that ends typing arrives here, too.
            if self.state() != QtWidgets.QAbstractItemView.State.EditingState:
                self.rename()
        else:
            super().keyPressEvent(event)

    def dropEvent(self, event: QtGui.QDropEvent) -> None:
        """Move a row between others, or to the place of another."""
        if event.source() is not self or len(self._points) != 1:
            event.ignore()
            return
        index = self.indexAt(event.pos())
        rows = [row.point for row in self.rows]
        place = len(rows) if not index.isValid() else index.row()
        if index.isValid() and event.pos().y() > self.visualRect(index).center().y():
            place += 1
        before = rows.index(self._points[0])
        place -= place > before
        # The rows are told to move by the document; Qt is to remove nothing.
        event.setDropAction(QtCore.Qt.DropAction.IgnoreAction)
        event.accept()
        if place != before:
            self.moved.emit(self._points[0], place)

    def _open_menu(self, at: QtCore.QPoint) -> None:
        if self._points:
            self.menu_wanted.emit(self.viewport().mapToGlobal(at))


def _in_lines(title: str, room: int, wide: Callable[[str], int]) -> str:
    """Return the title with a new line wherever the next piece does not fit into the room."""
    lines: list[str] = []
    for piece in PIECES.findall(title):
        longer = f"{lines[-1]} {piece}" if lines else piece
        lines[-1:] = [longer] if not lines or wide(longer) <= room else [lines[-1], piece]
    return "\n".join(lines)


class _Cells(QtWidgets.QStyledItemDelegate):
    """Paints badges, and numbers with digits of equal width."""

    def paint(self, painter: QtGui.QPainter, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex) -> None:
        theme, row, column = LOOK.theme, self.parent().rows[index.row()], index.column()
        painter.save()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        rect = QtCore.QRectF(option.rect)
        state = QtWidgets.QStyle.StateFlag
        if option.state & state.State_Selected:
            painter.fillRect(rect, QtGui.QColor(theme.selection))
        elif option.state & state.State_MouseOver:
            painter.fillRect(rect, QtGui.QColor(theme.hover))
        if column == BADGE:
            paint_badge(painter, rect.center() + QtCore.QPointF(2, 0), Badge(str(row.number), row.colour))
            painter.restore()
            return
        painter.setFont(LOOK.font(13))
        y = round(baseline(painter, rect.center().y()))
        text = row.texts[column]
        is_quiet = column == VERTEX or (column == NAME and not row.name)
        is_quiet = is_quiet or (column > VERTEX and bool(row.quiet) and row.quiet[column - 3])
        painter.setPen(QtGui.QColor(theme.quiet if is_quiet else theme.text))
        if column == NAME:
            paint_elided(painter, rect.left() + PAD_PX, y, text or "–", rect.width() - PAD_PX)
        else:
            paint_number(painter, rect.right() - PAD_PX - number_width(painter.font(), text), y, text)
        painter.restore()

    def createEditor(
        self, parent: QtWidgets.QWidget, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex
    ) -> QtWidgets.QWidget:
        return TextBox(parent)
