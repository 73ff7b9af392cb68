"""The table of gestures and keys: made from the menus' own actions, so that it cannot say what they do not do."""

import re
from collections.abc import Iterator, Sequence

from qtpy import QtCore, QtGui, QtWidgets

from ..look.look import LOOK

Group = tuple[str, Sequence[tuple[str, str]]]
"""A title, and what can be done with which keys or gesture."""

GESTURES: Group = (
    "Mouse",
    (
        ("Put the source there", "click on the surface"),
        ("Move the source", "drag its mark"),
        ("Pin a point", "Shift+click on the surface"),
        ("Turn all panels", "drag"),
        ("Move all panels", "Shift+drag or middle drag"),
        ("Paint a selection", "hold B and drag; with Ctrl it takes away"),
        ("Zoom to the pointer", "wheel"),
        ("Centre the view here", "double click"),
        ("Nearer and farther", "drag with the right button"),
        ("Type where the colours end", "double click on a colour bar"),
        ("Menu of what can be done here", "right click"),
    ),
)

LINE = 30
"""Height of a line of the table, in logical pixels."""


def entries_of(menu_bar: QtWidgets.QMenuBar) -> list[Group]:
    """For each menu the actions that have keys, those of its submenus among them."""
    menus = [(action.text(), action.menu()) for action in menu_bar.actions() if action.menu() is not None]
    groups = [(plain(title), tuple(_entries(menu))) for title, menu in menus]
    return [group for group in groups if group[1]]


def _entries(menu: QtWidgets.QMenu) -> Iterator[tuple[str, str]]:
    for action in menu.actions():
        if action.menu() is not None:
            yield from _entries(action.menu())
        elif action.isVisible() and any(not keys.isEmpty() for keys in action.shortcuts()):
            native = QtGui.QKeySequence.SequenceFormat.NativeText
            keys = (keys.toString(native) for keys in action.shortcuts() if not keys.isEmpty())
            yield plain(action.text()), " or ".join(keys)


def plain(text: str) -> str:
    """A menu's text without the mark of its letter, the dots at its end, and keys written after a tab."""
    text = re.sub(r"&(.)", r"\1", text.partition("\t")[0])
    return re.sub(r"\s*(…|\.\.\.)$", "", text.strip())


class KeysDialog(QtWidgets.QDialog):
    """All groups one below the other, and a box that leaves the lines that have the words typed in it."""

    def __init__(self, groups: Sequence[Group], parent: QtWidgets.QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Gestures and keys")
        self.setModal(False)
        self.setAttribute(QtCore.Qt.WidgetAttribute.WA_DeleteOnClose)
        self.box = QtWidgets.QLineEdit(placeholderText="Filter")
        self.box.textChanged.connect(self.show_only)
        self.tables = [GroupTable(title, entries) for title, entries in groups]
        self.nothing = QtWidgets.QLabel("No gesture and no key has these words.", visible=False)
        self.nothing.setProperty("quiet", True)

        sheet = QtWidgets.QWidget()
        column = QtWidgets.QVBoxLayout(sheet, spacing=20)
        column.setContentsMargins(16, 4, 16, 16)
        for widget in (self.nothing, *self.tables):
            column.addWidget(widget)
        column.addStretch(1)
        scroll = QtWidgets.QScrollArea(widgetResizable=True, frameShape=QtWidgets.QFrame.Shape.NoFrame)
        scroll.setHorizontalScrollBarPolicy(QtCore.Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setWidget(sheet)
        for widget in (scroll.viewport(), sheet):
            widget.setAutoFillBackground(False)  # the dialog's ground
        top = QtWidgets.QVBoxLayout()
        top.setContentsMargins(16, 16, 16, 12)
        top.addWidget(self.box)
        whole = QtWidgets.QVBoxLayout(self, spacing=0)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addLayout(top)
        whole.addWidget(scroll)
        LOOK.dress(self)
        self.resize(round(480 * LOOK.scale), 600)

    def show_only(self, words: str) -> None:
        """Leave the lines in which, or in whose title, each of the words occurs."""
        found = [table.show_only(words.casefold().split()) for table in self.tables]
        self.nothing.setVisible(not any(found))


class GroupTable(QtWidgets.QWidget):
    """A title, and under it a line for each entry."""

    def __init__(self, title: str, entries: Sequence[tuple[str, str]]) -> None:
        super().__init__()
        self.title = QtWidgets.QLabel(title)
        self.lines = [Line(what, keys) for what, keys in entries]
        column = QtWidgets.QVBoxLayout(self, spacing=0)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.title)
        column.addSpacing(4)
        for line in self.lines:
            column.addWidget(line)
        self._dress()
        LOOK.changed.connect(self._dress)

    def show_only(self, words: Sequence[str]) -> bool:
        """Whether any line is left."""
        title = self.title.text()
        left = [all(word in f"{title} {line.what} {line.keys}".casefold() for word in words) for line in self.lines]
        for line, is_left in zip(self.lines, left, strict=True):
            line.setVisible(is_left)
        self.setVisible(any(left))
        return any(left)

    def _dress(self) -> None:
        self.title.setFont(LOOK.font(bold=True))


class Line(QtWidgets.QWidget):
    """What is done, and on the right by which keys, over a hairline."""

    def __init__(self, what: str, keys: str) -> None:
        super().__init__()
        self.what, self.keys = what, keys
        row = QtWidgets.QHBoxLayout(self, spacing=16)
        row.setContentsMargins(0, 0, 0, 1)
        right = QtWidgets.QLabel(keys)
        right.setProperty("quiet", True)
        for label in (left := QtWidgets.QLabel(what)), right:
            label.setTextFormat(QtCore.Qt.TextFormat.PlainText)
        left.setWordWrap(True)
        row.addWidget(left, 1)
        row.addWidget(right)
        self._dress()
        LOOK.changed.connect(self._dress)

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:
        painter = QtGui.QPainter(self)
        painter.fillRect(0, self.height() - 1, self.width(), 1, QtGui.QColor(LOOK.theme.border))

    def _dress(self) -> None:
        self.setMinimumHeight(round(LINE * LOOK.scale))
        self.update()
