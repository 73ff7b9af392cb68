"""The box for the vertex that the first panel's field starts from."""

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK

WIDTH = 76
SHOWN_MS = 6000
"""For how long it is said what is wrong."""


class SourceBox(QtWidgets.QLineEdit):
    """`chosen(int)` by Enter; what is no vertex is said under the box, with those that there are."""

    chosen = QtCore.Signal(int)
    left = QtCore.Signal()  # the keys are wanted elsewhere again

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFixedWidth(WIDTH)
        self.setAccessibleName("Source vertex")
        self.setToolTip("The vertex that distances start from: type an id and press Enter (G)")
        self.setPlaceholderText("–")
        digits = QtCore.QRegularExpression("[0-9, ]*")
        self.setValidator(QtGui.QRegularExpressionValidator(digits, self))
        self._vertex: int | None = None
        self._count = 0
        self.wrong = QtWidgets.QLabel(self.window(), QtCore.Qt.WindowType.ToolTip)
        self.wrong.setProperty("error", True)
        self.wrong.setMargin(6)
        self._hide_soon = QtCore.QTimer(self, singleShot=True, interval=SHOWN_MS)
        self._hide_soon.timeout.connect(self.forgive)
        self.returnPressed.connect(self._choose)
        self.textEdited.connect(self.forgive)
        self.show_source(None, 0)

    def show_source(self, vertex: int | None, count: int) -> None:
        """The present source, None if there is none; count: of vertices, all ids being less."""
        self._vertex, self._count = vertex, count
        self.setEnabled(vertex is not None)
        self.setText("" if vertex is None else str(vertex))
        self.setModified(False)
        self.forgive()

    def value(self) -> int:
        """The source that is shown; -1 if there is none."""
        return -1 if self._vertex is None else self._vertex

    def refuse(self, sentence: str) -> None:
        """Say under the box what is wrong."""
        self._mark_wrong(True)
        theme = LOOK.theme
        self.wrong.setStyleSheet(
            f"background: {theme.error_ground}; color: {theme.error}; border: 1px solid {theme.error}; font: 13px;"
        )
        self.wrong.setText(sentence)
        self.wrong.adjustSize()
        self.wrong.move(self.mapToGlobal(QtCore.QPoint(0, self.height() + 4)))
        self.wrong.setVisible(self.isVisible())
        self._hide_soon.start()

    def forgive(self) -> None:
        """Nothing is wrong."""
        self._hide_soon.stop()
        self.wrong.hide()
        self._mark_wrong(False)

    def give_up(self) -> None:
        """What was typed is not meant."""
        self.show_source(self._vertex, self._count)

    def _choose(self) -> None:
        text = self.text().strip().replace(",", "")
        if not text.isascii() or not text.isdigit() or int(text) >= self._count:
            self.refuse(f"No vertex {self.text().strip()[:20] or 'of no id'} here: 0 to {self._count - 1:,}")
            self.selectAll()
            return
        self.chosen.emit(int(text))
        if not self.wrong.isVisible() and not self.property("wrong"):
            self.left.emit()

    def _mark_wrong(self, is_wrong: bool) -> None:
        if bool(self.property("wrong")) != is_wrong:
            self.setProperty("wrong", is_wrong)
            self.style().unpolish(self)
            self.style().polish(self)

    def event(self, event: QtCore.QEvent) -> bool:
        """The window's keys go to the window, but for those that edit what is being typed."""
        if event.type() == QtCore.QEvent.Type.ShortcutOverride and not self._edits(event):
            event.ignore()
            return True
        return super().event(event)

    def _edits(self, event: QtGui.QKeyEvent) -> bool:
        keys = QtGui.QKeySequence.StandardKey
        if self.isModified() and any(event.matches(key) for key in (keys.Undo, keys.Redo)):
            return True
        edits = (keys.Copy, keys.Cut, keys.Paste, keys.SelectAll)
        moves = {QtCore.Qt.Key.Key_Left, QtCore.Qt.Key.Key_Right, QtCore.Qt.Key.Key_Home, QtCore.Qt.Key.Key_End}
        deletes = {QtCore.Qt.Key.Key_Backspace, QtCore.Qt.Key.Key_Delete}
        if any(event.matches(key) for key in edits) or event.key() in deletes:
            return True
        others = QtCore.Qt.KeyboardModifier.KeypadModifier | QtCore.Qt.KeyboardModifier.ShiftModifier
        is_plain = not event.modifiers() & ~others
        return is_plain and (event.key() in moves or (event.text().isprintable() and bool(event.text())))

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() != QtCore.Qt.FocusReason.PopupFocusReason:
            self.give_up()
