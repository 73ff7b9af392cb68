"""How the styles of figures look on the canvas of the window."""

from dataclasses import replace

from qtpy import QtGui

from ...document.looks import OF_THE_STYLE, Colours
from ...drawing.style import Colour, Style, style_of
from .theme import Theme

STYLE_NAMES = {
    "paper": "Paper",
    "uniform": "Uniform",
    "lines": "Lines only",
    "dark": "Dark",
}
"""For the user; of a style without one, its word."""

TWINS = {(True, "paper"): "dark", (False, "dark"): "paper"}
"""The paper's colours on a dark ground have lighter ends, which is the style for slides; and the other way round."""


def canvas_style(word: str, theme: Theme, colours: Colours = OF_THE_STYLE) -> Style:
    """A figure's style, in a document's colours, with the window's own ground and text."""
    style = style_of(TWINS.get((theme.is_dark, word), word), colours)
    return replace(style, background=_rgb(theme.canvas), text=_rgb(theme.text), quiet_text=_rgb(theme.quiet))


def _rgb(colour: str) -> Colour:
    red, green, blue, _ = QtGui.QColor(colour).getRgbF()
    return red, green, blue
