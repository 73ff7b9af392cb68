"""What menus and buttons say is chosen: ticks, and the values beside a button's words."""

from ...document.edits import has_ends
from ..context import Context
from ..look.look import LOOK
from ..look.numbers import MINUS
from ..views import Views
from .colour_menu import colours_in_words
from .isoline_menu import isolines_in_words
from .menus import Menus
from .tool_bar import ToolBar

RANGE_NAMES = {"own": "Own", "shared": "One for all", "shares": "Fraction", "typed": "Typed"}
"""For the button: how the entries of the menu begin."""


class Ticks:
    """Kept equal to what the document, the page and the preferences say."""

    def __init__(self, context: Context, menus: Menus, tool_bar: ToolBar) -> None:
        self._context, self._menus, self._buttons = context, menus, tool_bar.buttons
        context.choice_changed.connect(self.show)
        context[Views].changed.connect(self._show_view)

    def show(self) -> None:
        """All of them."""
        context, document, style, menus = self._context, self._context.document, self._context.page.style, self._menus
        shown_range = "typed" if document.range == "own" and has_ends(document) else document.range
        up = context[Views].up
        for name, value in {
            "isolines": isolines_in_words(document.isolines),
            "colours": colours_in_words(style, document.colours),
            "range": RANGE_NAMES[shown_range],
            "up": "" if up == "auto" else up.replace("-", MINUS),
        }.items():
            self._buttons[name].show_value(value)
        self._show_view()
        menus.isolines.show_choice(document.isolines)
        menus.colours.show_choice(style, document.colours)
        for menu, word in (
            (menus.range, shown_range),
            (menus.theme, LOOK.choice),
            (menus.shading, document.shading.normals),
            (menus.up, up),
        ):
            menus.show_choice(menu, word)
        for word, is_on in {
            "wireframe": document.shading.wireframe,
            "snap": document.snap,
            "link": document.linked,
            "orthographic": document.projection == "orthographic",
            "axes": document.axes,
            "turntable": context.preferences.turntable,
        }.items():
            context.actions[word].setChecked(is_on)
        for word in ("link", "close beside"):
            context.actions[word].setEnabled(len(document.surfaces) > 1)
        meshes = [mesh.repairs for mesh in document.surfaces]
        context.actions["put back"].setEnabled(any(each.is_any for each in meshes))
        context.actions["save ids"].setEnabled(any(each.merge is not None for each in meshes))

    def _show_view(self) -> None:
        self._buttons["views"].show_value(self._context[Views].name)
