"""The styles of figures on the canvas of the window."""

from dataclasses import replace
from typing import Any

import numpy as np
from qtpy import QtGui

from ...document.looks import OF_THE_STYLE, Colours
from ...scene.style import STYLES, Colour, Style, style_of
from .theme import Theme

STYLE_NAMES = {"paper": "White ground", "lines": "Lines only", "dark": "Dark ground", "cover": "Cover"}
"""The names of styles for the user; others are shown by their words."""

UNIFORM = "uniform"
"""The style that differs from "paper" in nothing but its map, which has this name, too; it is offered as that map."""


def map_word(style: str, colours: Colours) -> str | None:
    """Return the map in which a style draws in a document's colours; None for a file's."""
    return None if colours.stops else colours.map or (UNIFORM if style == UNIFORM else "paper")


def offered_styles(now: str) -> list[str]:
    """Return the styles that can be chosen where `now` is, which stands for one that differs in its map alone."""
    return [now if (word, now) == ("paper", UNIFORM) else word for word in STYLES if word != UNIFORM]


def style_name(word: str) -> str:
    """Return the name of a figure's style in the window."""
    return STYLE_NAMES.get("paper" if word == UNIFORM else word, word)


def style_entry(word: str) -> str:
    """Return the name of a style in menus of the window, whose own ground is that of its theme."""
    return style_name(word) if word == "lines" else f"{style_name(word)} in figures"


TWINS = {(True, "paper"): "dark", (True, "cover"): "dark", (False, "dark"): "paper"}
"""The paper's colours on a dark ground have lighter ends, which is the style for slides; and the other way round."""


def canvas_style(word: str, theme: Theme, colours: Colours = OF_THE_STYLE) -> Style:
    """Return a figure's style, in a document's colours, with the window's own ground and text."""
    style = style_of(TWINS.get((theme.is_dark, word), word), colours)
    if theme.is_dark and not style.coloured:
        style = _on_dark(style, theme)
    return replace(style, background=_rgb(theme.canvas), text=_rgb(theme.text), quiet_text=_rgb(theme.quiet))


TURNED = (
    "isoline", "signed_isoline", "outline_colour", "largest", "undefined", "plain", "back", "edge", "source",
    "mark_edge",
)  # fmt: skip
"""Greys of a style that are light on dark grounds where they are dark on light ones, and the other way round."""


def _on_dark(style: Style, theme: Theme) -> Style:
    """Return a style of black lines on white with lines and ground of the theme."""
    ink, ground = np.array(_rgb(theme.text)), np.array(_rgb(theme.canvas))

    def turned(colour: Colour) -> Colour:
        red, green, blue = (ink + np.array(colour) * (ground - ink)).tolist()
        return red, green, blue

    colours: dict[str, Any] = {
        name: tuple((at, turned(each)) for at, each in getattr(style, name)) for name in ("stops", "diverging")
    }
    for name in TURNED:
        colours[name] = turned(getattr(style, name))
    return replace(style, **colours)


def _rgb(colour: str) -> Colour:
    red, green, blue, _ = QtGui.QColor(colour).getRgbF()
    return red, green, blue
