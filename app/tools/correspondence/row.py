"""A row of the list of pairs: the number in its colour, the vertices on both surfaces, and a bin."""

from qtpy import QtCore, QtGui, QtWidgets

from ...qt.docks.dock import PAD
from ...qt.look.look import LOOK
from ...qt.look.numbers import number_width, paint_number
from ...qt.panels.flat_button import FlatButton
from ...qt.panels.number_badge import BRIGHT, RADIUS, paint_badge

HEIGHT = 28
BADGE_ROOM, BIN_ROOM = 34, 32
"""Logical pixels: of a row, of its badge, and of its bin."""


class PairRow(QtWidgets.QWidget):
    """point: the name of one of the pair's points.  What is done is told, and shown when it comes back."""

    chosen = QtCore.Signal(str)
    removed = QtCore.Signal(str)
    stepped = QtCore.Signal(str, int)  # to the row above (-1) or below
    accepted = QtCore.Signal()

    def __init__(self, point: str) -> None:
        super().__init__()
        self.point, self.first, self.second = point, "", ""
        self._number, self._colour, self._is_waiting, self._is_chosen = 0, "", False, False
        self.bin = FlatButton(self, "delete")
        self.bin.activated.connect(self._remove)
        self.bin.hide()
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.StrongFocus)
        self.setFixedHeight(round(HEIGHT * LOOK.scale))
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_Hover)

    def show_pair(self, number: int, colour: str, first: str, second: str, is_waiting: bool) -> None:
        """first, second: what is said of its places; is_waiting: one of them is but a candidate."""
        shown = (number, colour, first, second, is_waiting)
        if shown != (self._number, self._colour, self.first, self.second, self._is_waiting):
            self._number, self._colour, self.first, self.second, self._is_waiting = shown
            words = f"Pair {number}: {first or 'nothing'} on A, {second or 'nothing'} on B"
            self.setAccessibleName(words)
            self.bin.setToolTip(f"Remove pair {number}")
            self.bin.setAccessibleName(f"Remove pair {number}")
            self.update()

    def show_chosen(self, is_chosen: bool) -> None:
        """Let the row stand out, or no longer."""
        self._is_chosen = is_chosen
        self._show_bin()
        self.update()

    def _show_bin(self) -> None:
        """Where it is meant: on the row that is chosen or pointed at."""
        self.bin.setVisible(self._is_chosen or self.underMouse())

    # ------------------------------------------------------------------ what Qt tells
    def resizeEvent(self, event: QtGui.QResizeEvent) -> None:
        super().resizeEvent(event)
        side = self.bin.sizeHint()
        self.bin.setGeometry(self.width() - BIN_ROOM, (self.height() - side.height()) // 2, side.width(), side.height())

    def enterEvent(self, event: QtCore.QEvent) -> None:
        self._show_bin()
        self.update()

    def leaveEvent(self, event: QtCore.QEvent) -> None:
        self._show_bin()
        self.update()

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:
        self.setFocus(QtCore.Qt.FocusReason.MouseFocusReason)
        self.chosen.emit(self.point)

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:
        keys = QtCore.Qt.Key
        if event.key() in (keys.Key_Up, keys.Key_Down):
            self.stepped.emit(self.point, 1 if event.key() == keys.Key_Down else -1)
        elif event.key() in (keys.Key_Delete, keys.Key_Backspace):
            self._remove()
        elif event.key() in (keys.Key_Return, keys.Key_Enter):
            self.accepted.emit()
        else:
            super().keyPressEvent(event)

    def _remove(self) -> None:
        self.removed.emit(self.point)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter, theme = QtGui.QPainter(self), LOOK.theme
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        if self._is_waiting or self._is_chosen:
            painter.fillRect(self.rect(), QtGui.QColor(theme.selection))
        elif self.underMouse():
            painter.fillRect(self.rect(), QtGui.QColor(theme.hover))
        middle = QtCore.QPointF(PAD + RADIUS * LOOK.scale, self.height() / 2)
        paint_badge(painter, middle, self._number, self._colour)
        if self._is_waiting:
            painter.setPen(QtGui.QPen(BRIGHT, 1.5))
            painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
            painter.drawEllipse(middle, RADIUS * LOOK.scale, RADIUS * LOOK.scale)
        painter.setFont(LOOK.font())
        metrics = painter.fontMetrics()
        baseline = round((self.height() + metrics.ascent() - metrics.descent()) / 2)
        painter.setPen(QtGui.QColor(theme.text))
        for text, right in zip((self.first, self.second), column_ends(self.width()), strict=True):
            # What is only a candidate has a mark behind the digits of the column.
            bare = text.removesuffix(" ?")
            x = right - number_width(painter.font(), bare)
            paint_number(painter, x, baseline, bare)
            if bare != text:
                painter.drawText(QtCore.QPointF(right + 4, baseline), "?")


def column_ends(width: int) -> tuple[float, float]:
    """Where the columns of both surfaces end, in a row of this width."""
    left = PAD + BADGE_ROOM * LOOK.scale
    right = width - (BIN_ROOM + 8) * LOOK.scale
    return left + (right - left) * 0.48, right
