"""Segmented controls: a few words in one frame, of which one is chosen."""

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
