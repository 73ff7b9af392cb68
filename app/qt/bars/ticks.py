"""Ticks and values in menus and buttons, which say what is chosen."""

from ...document.edits import has_ends
from ...document.settings import RANGE, SHADING
from ..actions import Actions
from ..context import Context
from ..files.mesh_repairs import MeshRepairs
from ..look.look import LOOK
from ..views import Views
from .colour_menu import colours_in_words, isolines_in_words
from .menus import Menus
from .tool_bar import ToolBar

RANGE_NAMES = {"own": "Own", "shared": "Shared", "fraction": "Fraction", "typed": "Typed"}
"""The first words of the menu's entries, for the button."""


class Ticks:
    """Kept equal to what the document, the page and the preferences say."""

    def __init__(self, context: Context, actions: Actions, menus: Menus, tool_bar: ToolBar) -> None:
        self._context, self._actions, self._menus, self._buttons = context, actions, menus, tool_bar.buttons
        context.choice_changed.connect(self.show)
        context[Views].changed.connect(self._show_view)

    def show(self) -> None:
        """Show what is chosen."""
        document, style, menus = self._context.document, self._context.page.style, self._menus
        shown_range = "typed" if document.range == "own" and has_ends(document) else RANGE.value(self._context)
        for name, value in {
            "isolines": isolines_in_words(document.isolines),
            "colours": colours_in_words(style, document.colours),
            "range": RANGE_NAMES[shown_range],
        }.items():
            self._buttons[name].show_value(value)
        self._show_view()
        menus.isolines.show_choice(document.isolines)
        menus.colours.show_choice(style, document.colours)
        for menu, word in (
            (menus.range, shown_range),
            (menus.theme, LOOK.choice),
            (menus.shading, SHADING.value(self._context)),
            (menus.up, self._context[Views].up),
            (menus.operators, self._context[MeshRepairs].operator),
        ):
            menus.show_choice(menu, word)
        self._actions.show()

    def _show_view(self) -> None:
        self._buttons["views"].show_value(self._context[Views].name)
