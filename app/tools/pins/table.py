"""The list of pins: a row for each with its number, name, vertex, and what every panel has there."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ...qt.look.look import LOOK
from ...qt.look.numbers import number_width, paint_number
from ...qt.look.text_box import TextBox
from ...qt.panels.number_badge import paint_badge

ROW = 30
PAD = 6
LEAST_NAME = 44
"""Logical pixels of a name at least; where there is no room for it the table is scrolled."""

TITLE = 19
"""Logical pixels beside the words of a title, together."""

PIECES = re.compile(r"[^ ]+(?: −)?")
"""Of a title, each whole on a line; a minus stays with what is before it."""

BADGE, NAME, VERTEX = range(3)
ROLE = QtCore.Qt.ItemDataRole


@dataclass(frozen=True)
class PinRow:
    """point: its name in the document; values: as they are written, with what is said of each in a tip; quiet: those
    that are still to change."""

    point: str
    number: int
    colour: str
    name: str
    vertex: str
    place: str
    values: tuple[str, ...]
    tips: tuple[str, ...] = ()
    quiet: tuple[bool, ...] = ()


class PinRows(QtCore.QAbstractTableModel):
    """`named(point, name)` when a name has been typed."""

    named = QtCore.Signal(str, str)

    def __init__(self, parent: QtCore.QObject) -> None:
        super().__init__(parent)
        self.rows: tuple[PinRow, ...] = ()
        self.titles: tuple[str, ...] = ()
        self.lines: dict[int, str] = {}  # titles by their columns, in as many lines as they need
        self.title_tips: tuple[str, ...] = ()

    def show(self, rows: Sequence[PinRow], titles: Sequence[str], tips: Sequence[str]) -> None:
        """Other rows, or other columns of values; where only values change, the selection stays."""
        rows, titles = tuple(rows), tuple(titles)
        same = [r.point for r in rows] == [r.point for r in self.rows] and len(titles) == len(self.titles)
        if same:
            self.rows, self.titles, self.title_tips = rows, titles, tuple(tips)
            if rows:
                self.dataChanged.emit(self.index(0, 0), self.index(len(rows) - 1, self.columnCount() - 1))
            self.headerDataChanged.emit(QtCore.Qt.Orientation.Horizontal, 0, self.columnCount() - 1)
            return
        self.beginResetModel()
        self.rows, self.titles, self.title_tips = rows, titles, tuple(tips)
        self.endResetModel()

    def rowCount(self, parent: QtCore.QModelIndex = QtCore.QModelIndex()) -> int:  # noqa: B008 (Qt's own default)
        return 0 if parent.isValid() else len(self.rows)

    def columnCount(self, parent: QtCore.QModelIndex = QtCore.QModelIndex()) -> int:  # noqa: B008 (Qt's own default)
        return 0 if parent.isValid() else 3 + len(self.titles)

    def title(self, column: int) -> str:
        """What stands over a column."""
        return ("", "Name", "Vertex", *self.titles)[column]

    def show_lines(self, lines: dict[int, str]) -> None:
        """Write titles, by their columns, in these lines."""
        if lines != self.lines:
            self.lines = lines
            self.headerDataChanged.emit(QtCore.Qt.Orientation.Horizontal, 0, self.columnCount() - 1)

    def text(self, row: PinRow, column: int) -> str:
        """What stands in a column of a row."""
        return (str(row.number), row.name, row.vertex, *row.values)[column]

    def data(self, index: QtCore.QModelIndex, role: int = ROLE.DisplayRole) -> object:
        row, column = self.rows[index.row()], index.column()
        if role in (ROLE.DisplayRole, ROLE.EditRole):
            return self.text(row, column)
        if role == ROLE.ToolTipRole:
            return row.tips[column - 3] if column > VERTEX and row.tips else row.place
        if role == ROLE.TextAlignmentRole and column >= VERTEX:
            return int(QtCore.Qt.AlignmentFlag.AlignRight | QtCore.Qt.AlignmentFlag.AlignVCenter)
        return None

    def setData(self, index: QtCore.QModelIndex, value: object, role: int = ROLE.EditRole) -> bool:
        row, name = self.rows[index.row()], str(value).strip()
        if role != ROLE.EditRole or index.column() != NAME or name == row.name:
            return False
        self.named.emit(row.point, name)
        return True

    def flags(self, index: QtCore.QModelIndex) -> QtCore.Qt.ItemFlags:
        flag = QtCore.Qt.ItemFlag
        found = flag.ItemIsEnabled | flag.ItemIsSelectable | flag.ItemIsDragEnabled | flag.ItemIsDropEnabled
        return found | flag.ItemIsEditable if index.column() == NAME else found

    def supportedDropActions(self) -> QtCore.Qt.DropAction:
        """Rows are moved, and never copied."""
        return QtCore.Qt.DropAction.MoveAction

    def headerData(self, section: int, way: QtCore.Qt.Orientation, role: int = ROLE.DisplayRole) -> object:
        if way != QtCore.Qt.Orientation.Horizontal:
            return None
        if role == ROLE.DisplayRole:
            return self.lines.get(section) or self.title(section)
        if role == ROLE.ToolTipRole and section > VERTEX:
            return self.title_tips[section - 3]
        if role == ROLE.TextAlignmentRole:
            side = QtCore.Qt.AlignmentFlag.AlignRight if section >= VERTEX else QtCore.Qt.AlignmentFlag.AlignLeft
            return int(side | QtCore.Qt.AlignmentFlag.AlignVCenter)
        return None


class PinTable(QtWidgets.QTableView):
    """`chosen(points)`: other rows are selected; `moved(point, place)`, `removed(points)`, `menu_wanted(where)`."""

    chosen = QtCore.Signal(tuple)
    moved = QtCore.Signal(str, int)
    removed = QtCore.Signal(tuple)
    menu_wanted = QtCore.Signal(QtCore.QPoint)

    def __init__(self, parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.rows = PinRows(self)
        self.setModel(self.rows)
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
        self.selectionModel().selectionChanged.connect(self._choose)
        LOOK.follow(self, self.fit)

    # ------------------------------------------------------------------ what is shown
    def show_rows(self, rows: Sequence[PinRow], titles: Sequence[str], tips: Sequence[str]) -> None:
        """Show these rows; those still there stay selected."""
        points = self._points
        self.rows.show(rows, titles, tips)
        there = {row.point for row in rows}
        self.select(tuple(point for point in points if point in there))
        self.fit()

    def select(self, points: Sequence[str]) -> None:
        """Let the rows of these points be selected."""
        wanted = [k for k, row in enumerate(self.rows.rows) if row.point in points]
        if wanted == sorted(index.row() for index in self.selectionModel().selectedRows()):
            self._choose()
            return
        selection = QtCore.QItemSelection()
        for row in wanted:
            selection.select(self.rows.index(row, 0), self.rows.index(row, self.rows.columnCount() - 1))
        self.selectionModel().select(selection, QtCore.QItemSelectionModel.SelectionFlag.ClearAndSelect)
        if wanted:
            self.scrollTo(self.rows.index(wanted[0], NAME))
        self._choose()

    @property
    def points(self) -> tuple[str, ...]:
        """Of the rows that are selected, in their order."""
        return self._points

    def rename(self) -> None:
        """Let the name of the first selected row be typed."""
        rows = [index.row() for index in self.selectionModel().selectedRows()]
        if rows:
            self.edit(self.rows.index(min(rows), NAME))

    def fit(self) -> None:
        """Columns as wide as what is in them, with titles in several lines where there is little room; the name has
        the rest.
        """
        scale = LOOK.scale
        self.verticalHeader().setDefaultSectionSize(round(ROW * scale))
        font, head = LOOK.font(13), QtGui.QFontMetrics(LOOK.font(12))
        widths, more_for = {BADGE: round(24 * scale)}, {}
        for column in range(VERTEX, self.rows.columnCount()):
            texts = [self.rows.text(row, column) for row in self.rows.rows]
            title = self.rows.title(column)
            wide = max([number_width(font, text) for text in texts], default=0)
            longest = max(map(head.horizontalAdvance, PIECES.findall(title)), default=0)
            widths[column] = round(max(wide + 2 * PAD, longest + TITLE) + 0.5)
            more_for[column] = max(head.horizontalAdvance(title) + TITLE - widths[column], 0)
        room = self.viewport().width() - sum(widths.values())
        names = [QtGui.QFontMetrics(font).horizontalAdvance(row.name) for row in self.rows.rows]
        least = max(round(LEAST_NAME * scale), head.horizontalAdvance("Name") + TITLE)
        room -= max([least, *(name + 2 * PAD for name in names)])
        for column, missing in sorted(more_for.items(), key=lambda each: each[1]):
            # Where names need less, titles have more.
            more = min(missing, max(room, 0))
            widths[column] += more
            room -= more
        left = self.viewport().width() - sum(widths.values())
        widths[NAME] = max(left, least)
        for column, width in widths.items():
            if column < self.rows.columnCount():
                self.setColumnWidth(column, width)
        self.rows.show_lines(
            {k: _in_lines(self.rows.title(k), widths[k] - TITLE, head.horizontalAdvance) for k in more_for}
        )
        self.updateGeometries()

    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        self.fit()

    # ------------------------------------------------------------------ what is done
    def _choose(self, *_: object) -> None:
        chosen = sorted(index.row() for index in self.selectionModel().selectedRows())
        points = tuple(self.rows.rows[row].point for row in chosen if row < len(self.rows.rows))
        if points != self._points:
            self._points = points
            self.chosen.emit(points)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        keys, alt = QtCore.Qt.Key, QtCore.Qt.KeyboardModifier.AltModifier
        if event.key() in (keys.Key_Delete, keys.Key_Backspace) and self._points:
            self.removed.emit(self._points)
        elif event.key() in (keys.Key_Up, keys.Key_Down) and event.modifiers() & alt and len(self._points) == 1:
            row = next(k for k, each in enumerate(self.rows.rows) if each.point == self._points[0])
            place = row + (1 if event.key() == keys.Key_Down else -1)
            if 0 <= place < len(self.rows.rows):
                self.moved.emit(self._points[0], place)
        elif event.key() in (keys.Key_Return, keys.Key_Enter):
            # The one that ends typing arrives here, too.
            if self.state() != QtWidgets.QAbstractItemView.State.EditingState:
                self.rename()
        else:
            super().keyPressEvent(event)

    def dropEvent(self, event: QtGui.QDropEvent) -> None:
        """Between rows, or on one: in its place."""
        if event.source() is not self or len(self._points) != 1:
            event.ignore()
            return
        index = self.indexAt(event.pos())
        rows = [row.point for row in self.rows.rows]
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
    """The title with a new line wherever the next piece does not fit into the room."""
    lines: list[str] = []
    for piece in PIECES.findall(title):
        longer = f"{lines[-1]} {piece}" if lines else piece
        lines[-1:] = [longer] if not lines or wide(longer) <= room else [lines[-1], piece]
    return "\n".join(lines)


class _Cells(QtWidgets.QStyledItemDelegate):
    """Paints badges, and numbers with digits of equal width."""

    def paint(self, painter: QtGui.QPainter, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex) -> None:
        theme, model = LOOK.theme, index.model()
        row, column = model.rows[index.row()], index.column()
        painter.save()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        rect = QtCore.QRectF(option.rect)
        state = QtWidgets.QStyle.StateFlag
        if option.state & state.State_Selected:
            painter.fillRect(rect, QtGui.QColor(theme.selection))
        elif option.state & state.State_MouseOver:
            painter.fillRect(rect, QtGui.QColor(theme.hover))
        if column == BADGE:
            paint_badge(painter, rect.center() + QtCore.QPointF(2, 0), row.number, row.colour)
            painter.restore()
            return
        painter.setFont(LOOK.font(13))
        metrics = QtGui.QFontMetricsF(painter.font())
        baseline = round(rect.center().y() + (metrics.ascent() - metrics.descent()) / 2)
        text = model.text(row, column)
        is_quiet = column == VERTEX or (column == NAME and not row.name)
        is_quiet = is_quiet or (column > VERTEX and bool(row.quiet) and row.quiet[column - 3])
        painter.setPen(QtGui.QColor(theme.quiet if is_quiet else theme.text))
        if column == NAME:
            shown = metrics.elidedText(text or "–", QtCore.Qt.TextElideMode.ElideRight, rect.width() - PAD)
            painter.drawText(QtCore.QPointF(rect.left() + PAD, baseline), shown)
        else:
            paint_number(painter, rect.right() - PAD - number_width(painter.font(), text), baseline, text)
        painter.restore()

    def createEditor(
        self, parent: QtWidgets.QWidget, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex
    ) -> QtWidgets.QWidget:
        return TextBox(parent)
