"""What the menu over a panel offers: edits of the document that are about one panel, those of tools as well."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache

from .document import Document
from .edits import MOST_ADDED, add_another, duplicate_panel, move_panel, place_of, remove_panel
from .tools import tools

ADD = "Add a panel"


@dataclass(frozen=True)
class PanelEdit:
    """An edit of a document that is about a panel of it, by the panel's id.

    text: in menus.  edit: the edit; is_possible: whether it makes sense.  adds: whether there is a panel more then.
    synonyms: other words by which it is found.
    """

    text: str
    edit: Callable[[Document, int], Document]
    is_possible: Callable[[Document, int], bool] = lambda document, panel: True
    adds: bool = False
    synonyms: str = ""


BEFORE = (
    PanelEdit(ADD, lambda document, panel: add_another(document, document.panel(panel).surface), adds=True),
    PanelEdit("Duplicate this panel", duplicate_panel, adds=True, synonyms="copy clone compare"),
    PanelEdit(
        "Move it back",
        lambda document, panel: move_panel(document, panel, max(place_of(document, panel) - 1, 0)),
        lambda document, panel: place_of(document, panel) > 0,
        synonyms="left before order",
    ),
    PanelEdit(
        "Move it on",
        lambda document, panel: move_panel(document, panel, place_of(document, panel) + 1),
        lambda document, panel: place_of(document, panel) < len(document.panels) - 1,
        synonyms="right after order",
    ),
)
AFTER = (
    PanelEdit(
        "Remove it",
        remove_panel,
        lambda document, panel: len(document.panels) > 1,
        synonyms="delete close panel",
    ),
)
"""Those that no tool has, before and after those of tools."""


@cache
def panel_edits() -> Mapping[str, PanelEdit]:
    """All edits of panels by their texts, in the order of the menu."""
    of_tools = (edit for tool in tools() if tool.panel_edits for edit in tool.load(tool.panel_edits))
    return {edit.text: edit for edit in (*BEFORE, *of_tools, *AFTER)}


def possible_edits(document: Document, panel: int, most: int = MOST_ADDED) -> set[str]:
    """The texts of those that make sense; no more than `most` panels are made, and one stays."""
    is_full = len(document.panels) >= most
    return {
        edit.text
        for edit in panel_edits().values()
        if not (edit.adds and is_full) and edit.is_possible(document, panel)
    }
