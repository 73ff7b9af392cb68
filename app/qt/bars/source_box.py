"""The box for the vertex that the first panel's field starts from."""

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK
from ..look.text_box import TextBox, mark_wrong

WIDTH = 76
SHOWN_MS = 6000
"""For how long it is said what is wrong."""


class SourceBox(TextBox):
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

    def ask(self) -> None:
        """Have the keys, for another vertex."""
        self.setFocus(QtCore.Qt.FocusReason.ShortcutFocusReason)
        self.selectAll()

    def refuse(self, sentence: str) -> None:
        """Say under the box what is wrong."""
        mark_wrong(self, True)
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
        mark_wrong(self, False)

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

    def focusOutEvent(self, event: QtGui.QFocusEvent) -> None:
        super().focusOutEvent(event)
        if event.reason() != QtCore.Qt.FocusReason.PopupFocusReason:
            self.give_up()
