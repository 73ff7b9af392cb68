"""A segmented control: a few words in one frame, of which one is chosen."""

from qtpy import QtCore, QtGui, QtWidgets

from .look import LOOK

PADDING = 26
"""To the left and right of a word together, with the frame."""


class Segments(QtWidgets.QWidget):
    """choices: the words on it, and what each stands for; `chosen` is emitted with that when the user chooses."""

    chosen = QtCore.Signal(str)

    def __init__(self, choices: dict[str, str], name: str, parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setSizePolicy(QtWidgets.QSizePolicy.Policy.Fixed, QtWidgets.QSizePolicy.Policy.Fixed)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        self._group = QtWidgets.QButtonGroup(self)
        self.buttons: dict[str, QtWidgets.QPushButton] = {}
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

    def choice(self) -> str:
        """The word of the segment that is on, "" for none."""
        return next((word for word, button in self.buttons.items() if button.isChecked()), "")

    def choose(self, word: str) -> None:
        """Show a choice; nothing is emitted."""
        self.buttons[word].setChecked(True)

    def _measure(self) -> None:
        """Each word has the room that it needs when it is chosen, and bold."""
        metrics = QtGui.QFontMetrics(LOOK.font(bold=True))
        for button in self.buttons.values():
            button.setMinimumWidth(metrics.horizontalAdvance(button.text()) + PADDING)
