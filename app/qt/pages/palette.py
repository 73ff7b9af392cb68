"""The palette of all commands, made from the menus: typed words leave those that have them, and Enter runs one."""

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ...document.settings import RANGE, SHADING, THEME
from ..look.form import in_column, quiet_label
from ..look.look import LOOK, paint_rounded
from ..panels.number_box import PopUp

NO_MESH = "open a mesh first"

MENU_SYNONYMS = {
    "Samples": "open example demo mesh",
    "Recent": "open last files history",
    "Standard views": "camera look side",
    "Turn and move by keys": "rotate orbit spin pan shift camera",
    "Up": "axis orientation vertical upright height",
    "Isolines": "contours levels lines curves",
    "Colours": "colourmap palette map look",
    "Paper": "coolwarm jet rainbow",
    "Uniform": "viridis parula turbo",
    "Ember": "inferno magma plasma hot heat",
    "Safe": "cividis colour-blind",
    "Diverging": "seismic RdBu signed",
    "White ground in figures": "background light",
    "Dark ground in figures": "background black",
    "Show here": "distance change replace quantity",
    "Biharmonic, truncated": "eigenpairs eigenfunctions spectral spectrum laplacian",
    "Diffusion": "heat kernel",
    "Geodesic": "shortest path length heat method dijkstra euclidean",
    "Difference with": "compare subtract minus deviation",
    **{each.label.replace("&", ""): each.synonyms for each in (RANGE, SHADING, THEME)},
}
"""Other words for menus and for their entries that are no `Action`, by their texts; only the palette compares them."""


@dataclass(frozen=True)
class Command:
    """A row of the palette: what is done, and how.

    Attributes
    ----------
    title
        Its title after the menus that it is in, such as "Colours: Ember".
    keys
        Its keys, or the gesture.
    also
        Other words for it.
    action
        The action that runs it; None for a gesture.
    can_run
        Whether it can be run now.
    lack
        Why it cannot be run now; "" if it can or nobody knows.
    file
        The name of the file that it opens, by which it is then found instead.
    """

    title: str
    keys: str = ""
    also: str = ""
    action: QtWidgets.QAction | None = None
    can_run: bool = False
    lack: str = ""
    file: str = ""

    @property
    def is_on(self) -> bool:
        """Whether its tick is set."""
        return self.action is not None and self.action.isChecked()

    @property
    def is_choice(self) -> bool:
        """Whether it is one of a menu's values, such as a colour map, or a gesture."""
        return self.action is None or not self.action.objectName()


GESTURES = tuple(
    Command(title, gesture, f"mouse gestures {also}")
    for title, gesture, also in (
        ("Set the source", "click on the surface", "choose put place"),
        ("Move the source", "drag its marker", ""),
        (
            "Add to the source, or remove from it",
            "Ctrl+click on the surface",
            "several two sources set",
        ),
        ("Pin a point", "Shift+click on the surface", "measure marker landmark"),
        ("Rotate all panels", "drag", "turn orbit spin"),
        ("Pan all panels", "Shift+drag or middle drag", "move shift"),
        ("Paint a selection", "hold B and drag; with Ctrl to deselect", "brush select"),
        ("Zoom to the pointer", "wheel", "scroll"),
        ("Centre view here", "double click", "middle pivot focus"),
        ("Zoom in and out", "drag with the right button", "nearer farther"),
        ("Set the colour limit", "double click on a colour bar", "range maximum clim end"),
        ("Context menu", "right click", ""),
    )
)


def commands_of(menus: Sequence[tuple[str, QtWidgets.QMenu]], has_mesh: bool) -> list[Command]:
    """Return the actions in menus and their submenus; each menu comes with the title above it, "" for none."""
    found: list[Command] = []
    for words, menu in menus:
        also = f"{plain(menu.title())} {MENU_SYNONYMS.get(words, '')}"
        found += _commands(menu, (words,) if words else (), also, True, "" if has_mesh else NO_MESH)
    return found


def _commands(
    menu: QtWidgets.QMenu, titles: tuple[str, ...], also: str, is_enabled: bool, lack: str
) -> Iterator[Command]:
    """Yield the commands of a menu and the menus in it.

    `titles` and `also` are of the menus that it is in, and other words for these; where `is_enabled` is false, `lack`
    says why none of it can be run.
    """
    menu.aboutToShow.emit()  # some are filled then
    for action in menu.actions():
        text, can_run = plain(action.text()), is_enabled and action.isEnabled()
        more = f"{also} {action.property('synonyms') or MENU_SYNONYMS.get(text, '')}"
        inner = action.menu()
        if inner is not None:
            yield from _commands(inner, (*titles, text), more, can_run, lack)
        elif action.isVisible() and not action.isSeparator() and not action.property("heading"):
            title = ": ".join((*titles, text))
            why = "" if can_run else action.property("lack") or lack
            path = action.property("path") or ""
            file = ": ".join((*titles, os.path.basename(path))) if path else ""
            yield Command(title, keys_of(action), more, action, can_run, why, file)


def keys_of(action: QtWidgets.QAction) -> str:
    """ "Ctrl+S", "R or Home", as the desktop writes them; or the gesture that a menu names after a tab."""
    native = QtGui.QKeySequence.SequenceFormat.NativeText
    keys = (keys.toString(native) for keys in action.shortcuts() if not keys.isEmpty())
    return " or ".join(keys) or action.text().partition("\t")[2]


def plain(text: str) -> str:
    """Return a menu's text without its access key, and without the keys after a tab."""
    return re.sub(r"&(.)", r"\1", text.partition("\t")[0])


# ---------------------------------------------------------------------- finding
AMERICAN = {"color": "colour", "center": "centre", "gray": "grey", "normaliz": "normalis", "maximiz": "maximis"}


def found(commands: Sequence[Command], typed: str) -> list[Command]:
    """Return the commands with every word that is typed: first those that can be run and have the words in their
    titles, recent files last."""
    words = folded(typed).split()
    ranked = [
        (bool(each.file), not each.can_run, rank, each.is_choice, each)
        for each in commands
        for rank in _ranks(each, words)
    ]
    return [each for *_, each in sorted(ranked, key=lambda row: row[:4])]


def _ranks(command: Command, words: Sequence[str]) -> list[int]:
    """[0] where the title begins with the words, up to [3] where they are inside of others; [] without them."""
    title = folded(command.file or command.title)
    all_of_it = title if command.file else folded(f"{title} {command.also} {command.keys}")
    if title.startswith(" ".join(words)):
        return [0]
    for rank, text in ((1, title), (2, all_of_it)):
        if all(re.search(rf"(?<!\w){re.escape(word)}", text) for word in words):
            return [rank]
    return [3] if all(word in all_of_it for word in words) else []


def folded(text: str) -> str:
    """Return a text in lower case, with American spellings replaced by the window's."""
    text = text.casefold()
    for american, british in AMERICAN.items():
        text = text.replace(american, british)
    return text


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
