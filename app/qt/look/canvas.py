"""How the styles of figures look on the canvas of the window."""

from dataclasses import replace

from qtpy import QtGui

from ...document.looks import OF_THE_STYLE, Colours
from ...scene.style import STYLES, Colour, Style, style_of
from .theme import Theme

STYLE_NAMES = {"paper": "White ground", "lines": "Lines only", "dark": "Dark ground"}
"""For the user; of a style without one, its word."""

UNIFORM = "uniform"
"""The style that differs from "paper" in nothing but its map, which has this name, too; it is offered as that map."""


def map_word(style: str, colours: Colours) -> str | None:
    """The map in which a style draws in a document's colours; None for a file's."""
    return None if colours.stops else colours.map or (UNIFORM if style == UNIFORM else "paper")


def offered_styles(now: str) -> list[str]:
    """What can be chosen where `now` is; it counts as the style that differs from it in its map alone."""
    return [now if (word, now) == ("paper", UNIFORM) else word for word in STYLES if word != UNIFORM]


def style_name(word: str) -> str:
    """What a figure's style is called in the window."""
    return STYLE_NAMES.get("paper" if word == UNIFORM else word, word)


TWINS = {(True, "paper"): "dark", (False, "dark"): "paper"}
"""The paper's colours on a dark ground have lighter ends, which is the style for slides; and the other way round."""


def canvas_style(word: str, theme: Theme, colours: Colours = OF_THE_STYLE) -> Style:
    """A figure's style, in a document's colours, with the window's own ground and text."""
    style = style_of(TWINS.get((theme.is_dark, word), word), colours)
    return replace(style, background=_rgb(theme.canvas), text=_rgb(theme.text), quiet_text=_rgb(theme.quiet))


def _rgb(colour: str) -> Colour:
    red, green, blue, _ = QtGui.QColor(colour).getRgbF()
    return red, green, blue
