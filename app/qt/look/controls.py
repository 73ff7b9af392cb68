"""Small controls: segmented ones, text boxes, buttons that paint themselves, and labels that are cut short."""

from typing import Any

from qtpy import QtCore, QtGui, QtWidgets

from .look import LOOK

PADDING = 26
"""Padding at both sides of a word together, with the frame, in logical pixels."""


class Segments(QtWidgets.QWidget):
    """A choice of a few texts, which stand for words; `chosen` is emitted with a word when the user chooses."""

    chosen = QtCore.Signal(object)

    def __init__(self, choices: dict[str, Any], name: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Fixed)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        self._group = QtWidgets.QButtonGroup(self)
        self.buttons: dict[Any, QtWidgets.QPushButton] = {}
        places = ["first", *["middle"] * (len(choices) - 2), "last"][: len(choices)]
        for place, (text, word) in zip(places, choices.items(), strict=True):
            button = QtWidgets.QPushButton(text, checkable=True, autoDefault=False)
            button.setProperty("segment", place)
            button.setAccessibleName(f"{name}: {text}")
            button.setToolTip(f"{name}: {text}")
            button.clicked.connect(lambda _=False, word=word: self.chosen.emit(word))
            self._group.addButton(button)
            row.addWidget(button)
            self.buttons[word] = button
        self._group.buttonToggled.connect(lambda button, is_on: is_on and self.setFocusProxy(button))
        self._measure()
        LOOK.changed.connect(self._measure)

    def choice(self) -> Any:
        """Return the value of the chosen segment, "" for none."""
        return next((word for word, button in self.buttons.items() if button.isChecked()), "")

    def choose(self, word: Any) -> None:
        """Show a choice without emitting `chosen`."""
        self.buttons[word].setChecked(True)

    def _measure(self) -> None:
        """Give each word the room that it needs in bold."""
        metrics = QtGui.QFontMetrics(LOOK.font(bold=True))
        for button in self.buttons.values():
            button.setMinimumWidth(metrics.horizontalAdvance(button.text()) + PADDING)


class TextBox(QtWidgets.QLineEdit):
    """A text box that leaves the window's shortcuts to the window."""

    def event(self, event: QtCore.QEvent) -> bool:
        if event.type() == QtCore.QEvent.Type.ShortcutOverride and not self._edits(event):
            event.ignore()
            return True
        return bool(super().event(event))

    def _edits(self, event: QtGui.QKeyEvent) -> bool:
        """Return whether a key is for the text rather than for the window."""
        modifier, keys = QtCore.Qt.KeyboardModifier, QtGui.QKeySequence.StandardKey
        if not event.modifiers() & (modifier.ControlModifier | modifier.AltModifier | modifier.MetaModifier):
            return True
        if event.matches(keys.Undo):
            return bool(self.isUndoAvailable())
        if event.matches(keys.Redo):
            return bool(self.isRedoAvailable())
        always = (keys.SelectAll, keys.Copy, keys.Cut, keys.Paste)
        moves = (keys.MoveToNextWord, keys.MoveToPreviousWord, keys.SelectNextWord, keys.SelectPreviousWord)
        deletes = (keys.DeleteStartOfWord, keys.DeleteEndOfWord)
        return any(event.matches(key) for key in (*always, *moves, *deletes))


def mark_wrong(box: QtWidgets.QWidget, is_wrong: bool) -> None:
    """Show or remove the outline of a wrong value."""
    if bool(box.property("wrong")) != is_wrong:
        box.setProperty("wrong", is_wrong)
        box.style().unpolish(box)
        box.style().polish(box)


class BareButton(QtWidgets.QToolButton):
    """A button that is reached by Tab and knows whether to show the pointer and the keyboard focus."""

    def __init__(self, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self._by_keyboard = False
        self.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        self.setPopupMode(QtWidgets.QToolButton.ToolButtonPopupMode.InstantPopup)

    @property
    def is_pointed(self) -> bool:
        """Whether the pointer is on it, also while a menu is open, when Qt does not notice that it leaves."""
        return bool(self.underMouse() and self.rect().contains(self.mapFromGlobal(QtGui.QCursor.pos())))

    @property
    def has_keys(self) -> bool:
        """Whether it has the keyboard focus, and got it by the keyboard."""
        return self._by_keyboard and self.hasFocus()

    def setMenu(self, menu: QtWidgets.QMenu) -> None:
        super().setMenu(menu)
        menu.aboutToHide.connect(self.update)

    def focusInEvent(self, event: QtGui.QFocusEvent) -> None:
        reasons = QtCore.Qt.FocusReason
        # A menu or a window that closes gives the focus back, however it was opened.
        if event.reason() not in (reasons.PopupFocusReason, reasons.ActiveWindowFocusReason):
            self._by_keyboard = event.reason() != reasons.MouseFocusReason
        super().focusInEvent(event)


ANYWHERE = QtGui.QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere


def lines_of(
    text: str, font: QtGui.QFont, width: float, most: int, wrap: QtGui.QTextOption.WrapMode = ANYWHERE
) -> list[str]:
    """Break a text into at most `most` lines of a width; what does not fit ends in dots."""
    text = " ".join(text.split())
    layout = QtGui.QTextLayout(text, font)
    option = QtGui.QTextOption()
    option.setWrapMode(wrap)
    layout.setTextOption(option)
    found: list[str] = []
    layout.beginLayout()
    while (line := layout.createLine()).isValid():
        line.setLineWidth(max(width, 1))
        rest = text[line.textStart() :]
        if len(found) == most - 1:
            found.append(QtGui.QFontMetrics(font).elidedText(rest, QtCore.Qt.TextElideMode.ElideRight, int(width)))
            break
        found.append(rest[: line.textLength()].rstrip())
    layout.endLayout()
    return found


class ElidedLabel(QtWidgets.QLabel):
    """A line of text that is cut short where there is no room, and gone if `least` characters would not be left."""

    def __init__(self, cut: QtCore.Qt.TextElideMode, least: int = 0) -> None:
        super().__init__()
        self._cut, self._least = cut, least

    def minimumSizeHint(self) -> QtCore.QSize:
        return QtCore.QSize(1, super().minimumSizeHint().height())

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        shown = self.fontMetrics().elidedText(self.text(), self._cut, self.width())
        if len(shown) > self._least or shown == self.text():
            painter.drawText(self.rect(), int(self.alignment()), shown)
