"""Entries of the menu over a panel: edits of the document that are about one panel, those of tools as well."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

from .document import Document
from .edits import MOST_ADDED, add_another, duplicate_panel, move_panel, place_of, remove_panel
from .tools import tools

ADD = "Add panel"


@dataclass(frozen=True)
class PanelEdit:
    """An edit of a document at one of its panels, given by the panel's id.

    Attributes
    ----------
    text
        Its entry in menus.
    edit
        Returns the edited document.
    is_possible
        Returns whether the edit makes sense.
    adds
        Whether the edit adds a panel.
    synonyms
        Other words by which it is found.
    is_on
        Returns whether a panel has it switched on; None for edits that are no switches.
    """

    text: str
    edit: Callable[[Document, int], Document]
    is_possible: Callable[[Document, int], bool] = lambda document, panel: True
    adds: bool = False
    synonyms: str = ""
    is_on: Callable[[Document, int], bool] | None = None


BEFORE = (
    PanelEdit(ADD, lambda document, panel: add_another(document, document.panel(panel).surface), adds=True),
    PanelEdit("Duplicate panel", duplicate_panel, adds=True, synonyms="copy clone compare"),
    PanelEdit(
        "Move panel left",
        lambda document, panel: move_panel(document, panel, max(place_of(document, panel) - 1, 0)),
        lambda document, panel: place_of(document, panel) > 0,
        synonyms="back before order",
    ),
    PanelEdit(
        "Move panel right",
        lambda document, panel: move_panel(document, panel, place_of(document, panel) + 1),
        lambda document, panel: place_of(document, panel) < len(document.panels) - 1,
        synonyms="on after order",
    ),
)
AFTER = (
    PanelEdit(
        "Remove panel",
        remove_panel,
        lambda document, panel: len(document.panels) > 1,
        synonyms="close",
    ),
)
"""Those that no tool has, before and after those of tools."""


@cache
def panel_edits() -> Mapping[str, PanelEdit]:
    """Return all edits of panels by their texts, in the order of the menu."""
    of_tools = (edit for tool in tools() if tool.panel_edits for edit in tool.load(tool.panel_edits))
    return {edit.text: edit for edit in (*BEFORE, *of_tools, *AFTER)}


def edits_that_are_on(document: Document, panel: int) -> set[str]:
    """Return the texts of those that are on in a panel, such as its regions."""
    return {edit.text for edit in panel_edits().values() if edit.is_on is not None and edit.is_on(document, panel)}


def possible_edits(document: Document, panel: int, most: int = MOST_ADDED) -> set[str]:
    """Return the texts of those that make sense; no more than `most` panels are made, and one stays."""
    is_full = len(document.panels) >= most
    return {
        edit.text
        for edit in panel_edits().values()
        if not (edit.adds and is_full) and edit.is_possible(document, panel)
    }
