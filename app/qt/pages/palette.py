"""The palette of all commands: typed words leave those that have them, and Enter runs the chosen one."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui, QtWidgets

from ..look.layouts import in_column, quiet_label
from ..look.look import LOOK
from ..look.painting import paint_rounded
from ..panels.number_box import PopUp
from .commands import Command, found

WIDTH, ROW, MOST_ROWS = 640, 30, 14
"""Logical pixels; so many rows are seen at once."""

PAD = 10
"""Left and right of a row's words."""

COMMAND = QtCore.Qt.ItemDataRole.UserRole


class Palette(PopUp):
    """The command palette.

    `recent` holds the titles of the commands that have been run, the latest first; running one puts it to the front.
    """

    def __init__(self, commands: Sequence[Command], recent: list[str], parent: QtWidgets.QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
        self._recent, self._most = recent, MOST_ROWS
        self._commands = sorted(commands, key=lambda command: self._age(command.title))
        hint = "Type a command; “mouse” lists gestures"
        self.box = QtWidgets.QLineEdit(placeholderText=hint, accessibleName="Commands")
        self.box.textChanged.connect(self._show)
        self.box.installEventFilter(self)
        self.rows = QtWidgets.QListWidget(frameShape=QtWidgets.QFrame.Shape.NoFrame, uniformItemSizes=True)
        self.rows.setStyleSheet("QListWidget { border: none; background: transparent; }")
        self.rows.setItemDelegate(_Row(self.rows))
        self.rows.setFocusPolicy(QtCore.Qt.FocusPolicy.NoFocus)
        self.rows.setMouseTracking(True)
        self.rows.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.rows.itemClicked.connect(self.run)
        self.nothing = quiet_label("No matching commands or gestures.")
        in_column(self.box, self.rows, self.nothing, of=self, spacing=6, margins=(8, 8, 8, 8))
        self._show("")

    def open(self) -> None:
        """Over the upper part of the window."""
        window = self.parentWidget()
        self.setFixedWidth(min(round(WIDTH * LOOK.scale), window.width() - 48))
        self._most = max(4, min(MOST_ROWS, int((window.height() - 150 * LOOK.scale) // (ROW * LOOK.scale))))
        self._fit()
        self.move(window.mapToGlobal(QtCore.QPoint((window.width() - self.width()) // 2, round(64 * LOOK.scale))))
        self.show()
        self.box.setFocus(QtCore.Qt.FocusReason.PopupFocusReason)

    def run(self, row: QtWidgets.QListWidgetItem | None) -> None:
        """Do what a row stands for, if that can be done."""
        command = None if row is None else row.data(COMMAND)
        if command is None or not command.can_run:
            return
        self._recent[:] = [command.title, *(title for title in self._recent if title != command.title)]
        self.close()
        # Once it has gone: what it does may ask something.
        QtCore.QTimer.singleShot(0, command.action.trigger)

    def eventFilter(self, box: QtCore.QObject, event: QtCore.QEvent) -> bool:
        """The keys that go through the rows, and that runs one, while the box has the focus."""
        keys = QtCore.Qt.Key
        if event.type() != QtCore.QEvent.Type.KeyPress:
            return False
        if event.key() in (keys.Key_Up, keys.Key_Down, keys.Key_PageUp, keys.Key_PageDown):
            QtWidgets.QApplication.sendEvent(self.rows, event)
        elif event.key() in (keys.Key_Return, keys.Key_Enter):
            self.run(self.rows.currentItem())
        else:
            return False
        return True

    def _show(self, typed: str) -> None:
        self.rows.clear()
        for command in found(self._commands, typed):
            QtWidgets.QListWidgetItem(command.title, self.rows).setData(COMMAND, command)
        self.rows.setCurrentRow(0)
        self._fit()

    def _fit(self) -> None:
        """Make the palette as high as what is found, up to what there is room for."""
        count = self.rows.count()
        self.nothing.setVisible(not count)
        self.rows.setVisible(count > 0)
        self.rows.setFixedHeight(round(ROW * LOOK.scale) * min(count, self._most))
        self.adjustSize()

    def _age(self, title: str) -> int:
        return self._recent.index(title) if title in self._recent else len(self._recent)


class _Row(QtWidgets.QStyledItemDelegate):
    """Paints a command, quietly why it cannot be run or that it is on, and at the right the keys."""

    def sizeHint(self, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex) -> QtCore.QSize:
        return QtCore.QSize(0, round(ROW * LOOK.scale))

    def paint(self, painter: QtGui.QPainter, option: QtWidgets.QStyleOptionViewItem, index: QtCore.QModelIndex) -> None:
        command, theme = index.data(COMMAND), LOOK.theme
        painter.save()
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        states = QtWidgets.QStyle.StateFlag
        is_chosen = bool(option.state & states.State_Selected)
        if is_chosen or option.state & states.State_MouseOver:
            paint_rounded(painter, QtCore.QRectF(option.rect), 5, theme.selection if is_chosen else theme.hover)
        is_quiet = command.action is not None and not command.can_run
        note = command.lack or ("on" if command.is_on else "")
        metrics, room = QtGui.QFontMetrics(LOOK.font()), option.rect.adjusted(PAD, 0, -PAD, 0)
        painter.setFont(LOOK.font())
        align, cut = QtCore.Qt.AlignmentFlag, QtCore.Qt.TextElideMode.ElideRight
        right, left = (int(align.AlignVCenter | side) for side in (align.AlignRight, align.AlignLeft))
        painter.setPen(QtGui.QColor(theme.quiet))
        keys = metrics.elidedText(command.keys, cut, room.width() // 2)
        painter.drawText(room, right, keys)
        room.setRight(room.right() - metrics.horizontalAdvance(keys) - 2 * PAD)
        painter.setPen(QtGui.QColor(theme.disabled if is_quiet else theme.text))
        title = metrics.elidedText(command.title, cut, room.width())
        painter.drawText(room, left, title)
        room.setLeft(room.left() + metrics.horizontalAdvance(title) + PAD)
        painter.setPen(QtGui.QColor(theme.accent if command.is_on and not is_quiet else theme.quiet))
        painter.drawText(room, left, metrics.elidedText(note, cut, max(0, room.width())))
        painter.restore()
