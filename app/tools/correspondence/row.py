"""A row of the list of pairs: the number in its colour, the vertices on both surfaces, and a bin."""

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.painters.qt import number_width, paint_number
from ...qt.docks.instrument import PAD
from ...qt.look.look import LOOK, baseline, smooth_painter
from ...qt.panels.badges import RADIUS, Badge, paint_badge
from ...qt.panels.flat_button import FlatButton

ROW_HEIGHT_PX = 28
BADGE_ROOM_PX, BIN_ROOM_PX = 34, 32
"""Logical pixels: of a row, of its badge, and of its bin."""


class PairRow(QtWidgets.QWidget):
    """A pair in the list, by the name of one of its points; its edits are emitted, and shown when the document has
    them."""

    chosen = QtCore.Signal(str)
    removed = QtCore.Signal(str)
    stepped = QtCore.Signal(str, int)  # to the row above (-1) or below
    accepted = QtCore.Signal()

    def __init__(self, point: str) -> None:
        super().__init__()
        self.point, self.first, self.second = point, "", ""
        self._number, self._colour, self._is_waiting, self._is_chosen = 0, "", False, False
        self.bin = FlatButton(self, "delete")
        self.bin.activated.connect(lambda: self.removed.emit(self.point))
        self.bin.hide()
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.setFixedHeight(round(ROW_HEIGHT_PX * LOOK.scale))
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_Hover)

    def show_pair(self, number: int, colour: str, first: str, second: str, is_waiting: bool) -> None:
        """Show both places in words; with `is_waiting`, one of them is only a candidate."""
        shown = (number, colour, first, second, is_waiting)
        if shown != (self._number, self._colour, self.first, self.second, self._is_waiting):
            self._number, self._colour, self.first, self.second, self._is_waiting = shown
            words = f"Pair {number}: {first or 'nothing'} on A, {second or 'nothing'} on B"
            self.setAccessibleName(words)
            self.bin.setToolTip(f"Remove pair {number}")
            self.bin.setAccessibleName(f"Remove pair {number}")
            self.update()

    def show_chosen(self, is_chosen: bool) -> None:
        """Highlight the row, or no longer."""
        self._is_chosen = is_chosen
        self._show_bin()
        self.update()

    def _show_bin(self) -> None:
        """Show the bin on the row that is chosen or under the pointer."""
        self.bin.setVisible(self._is_chosen or self.underMouse())

    # ------------------------------------------------------------------ what Qt tells
    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        side = self.bin.sizeHint()
        self.bin.setGeometry(
            self.width() - BIN_ROOM_PX, (self.height() - side.height()) // 2, side.width(), side.height()
        )

    def enterEvent(self, event: QtCore.QEvent) -> None:
        self._show_bin()
        self.update()

    leaveEvent = enterEvent

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setFocus(QtCore.Qt.FocusReason.MouseFocusReason)
        self.chosen.emit(self.point)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        keys = QtCore.Qt.Key
        if event.key() in (keys.Key_Up, keys.Key_Down):
            self.stepped.emit(self.point, 1 if event.key() == keys.Key_Down else -1)
        elif event.key() in (keys.Key_Delete, keys.Key_Backspace):
            self.removed.emit(self.point)
        elif event.key() in (keys.Key_Return, keys.Key_Enter):
            self.accepted.emit()
        else:
            super().keyPressEvent(event)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = smooth_painter(self), LOOK.theme
        if self._is_waiting or self._is_chosen:
            painter.fillRect(self.rect(), QtGui.QColor(theme.selection))
        elif self.underMouse():
            painter.fillRect(self.rect(), QtGui.QColor(theme.hover))
        middle = QtCore.QPointF(PAD + RADIUS * LOOK.scale, self.height() / 2)
        paint_badge(painter, middle, Badge(str(self._number), self._colour))
        if self._is_waiting:
            painter.setPen(QtGui.QPen(QtGui.QColor("#FFFFFF"), 1.5))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawEllipse(middle, RADIUS * LOOK.scale, RADIUS * LOOK.scale)
        painter.setFont(LOOK.font())
        y = round(baseline(painter, self.height() / 2))
        painter.setPen(QtGui.QColor(theme.text))
        for text, right in zip((self.first, self.second), column_ends(self.width()), strict=True):
            # What is only a candidate has a mark behind the digits of the column.
            bare = text.removesuffix(" ?")
            x = right - number_width(painter.font(), bare)
            paint_number(painter, x, y, bare)
            if bare != text:
                painter.drawText(QtCore.QPointF(right + 4, y), "?")


def column_ends(width: int) -> tuple[float, float]:
    """Return the right ends of the columns of both surfaces, in a row of this width."""
    left = PAD + BADGE_ROOM_PX * LOOK.scale
    right = width - (BIN_ROOM_PX + 8) * LOOK.scale
    return left + (right - left) * 0.48, right
