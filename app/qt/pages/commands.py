"""All that can be done, as rows of the palette: made from the menus, so that they cannot say what menus do not do."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from qtpy import QtGui, QtWidgets

from ..synonyms import SYNONYMS

NO_MESH = "open a mesh first"


@dataclass(frozen=True)
class Command:
    """A row: what is done, and how.

    title: with the menus it is in, "Colours: Ember"; keys: or the gesture; also: other words for it.  action: what runs
    it, None for a gesture; lack: why it cannot be run now, "" if it can or nobody knows.
    """

    title: str
    keys: str = ""
    also: str = ""
    action: QtWidgets.QAction | None = None
    can_run: bool = False
    lack: str = ""

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
        ("Put the source there", "click on the surface", "choose set place"),
        ("Move the source", "drag its mark", ""),
        ("Add to the source, or take away from it", "Ctrl+click on the surface", "several set"),
        ("Pin a point", "Shift+click on the surface", "measure marker landmark"),
        ("Turn all panels", "drag", "rotate orbit spin"),
        ("Move all panels", "Shift+drag or middle drag", "pan shift"),
        ("Paint a selection", "hold B and drag; with Ctrl it takes away", "brush select"),
        ("Zoom to the pointer", "wheel", "scroll"),
        ("Centre the view here", "double click", "middle pivot focus"),
        ("Nearer and farther", "drag with the right button", "zoom"),
        ("Type where the colours end", "double click on a colour bar", "range maximum limit"),
        ("Menu of what can be done here", "right click", "context"),
    )
)


def commands_of(menus: Sequence[tuple[str, QtWidgets.QMenu]], has_mesh: bool) -> list[Command]:
    """The actions in menus and in their submenus; with each menu the words before its titles, "" for none."""
    found: list[Command] = []
    for words, menu in menus:
        also = f"{plain(menu.title())} {SYNONYMS.get(words, '')}"
        found += _commands(menu, (words,) if words else (), also, True, "" if has_mesh else NO_MESH)
    return found


def _commands(
    menu: QtWidgets.QMenu, titles: tuple[str, ...], also: str, is_enabled: bool, lack: str
) -> Iterator[Command]:
    """titles, also: of what the menu is in, and other words for it; is_enabled: whether that is; lack: if not, why."""
    menu.aboutToShow.emit()  # some are filled then
    for action in menu.actions():
        text, can_run = plain(action.text()), is_enabled and action.isEnabled()
        more = f"{also} {SYNONYMS.get(action.objectName() or text, '')}"
        inner = action.menu()
        if inner is not None:
            yield from _commands(inner, (*titles, text), more, can_run, lack)
        elif action.isVisible() and not action.isSeparator() and not action.property("heading"):
            title = ": ".join((*titles, text))
            why = "" if can_run else action.property("lack") or lack
            yield Command(title, keys_of(action), more, action, can_run, why)


def keys_of(action: QtWidgets.QAction) -> str:
    """ "Ctrl+S", "R or Home", as the desktop writes them; or the gesture that a menu names after a tab."""
    native = QtGui.QKeySequence.SequenceFormat.NativeText
    keys = (keys.toString(native) for keys in action.shortcuts() if not keys.isEmpty())
    return " or ".join(keys) or action.text().partition("\t")[2]


def plain(text: str) -> str:
    """A menu's text without the mark of its letter, and keys written after a tab."""
    return re.sub(r"&(.)", r"\1", text.partition("\t")[0])


# ---------------------------------------------------------------------- finding
AMERICAN = {"color": "colour", "center": "centre", "gray": "grey"}


def found(commands: Sequence[Command], typed: str) -> list[Command]:
    """Those that have every word that is typed; what can be run stands first, then what has them in its title."""
    words = folded(typed).split()
    ranked = [(not each.can_run, rank, each.is_choice, each) for each in commands for rank in _ranks(each, words)]
    return [each for *_, each in sorted(ranked, key=lambda row: row[:3])]


def _ranks(command: Command, words: Sequence[str]) -> list[int]:
    """[0] where the title begins with the words, up to [3] where they are inside of others; [] without them."""
    title, all_of_it = folded(command.title), folded(f"{command.title} {command.also} {command.keys}")
    if title.startswith(" ".join(words)):
        return [0]
    for rank, text in ((1, title), (2, all_of_it)):
        if all(re.search(rf"(?<!\w){re.escape(word)}", text) for word in words):
            return [rank]
    return [3] if all(word in all_of_it for word in words) else []


def folded(text: str) -> str:
    """Small, and spelt as the window is."""
    text = text.casefold()
    for american, british in AMERICAN.items():
        text = text.replace(american, british)
    return text
