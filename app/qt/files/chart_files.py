"""Saving charts as figures, in the background."""

from collections.abc import Callable
from functools import partial

from bihdist_core.file_output import check_output

from ...scene.style import style_of
from ..context import Context
from ..look.theme import DARK, LIGHT, Theme, lightness
from .exports import Exports
from .saving import ask_path

FORMATS = (".pdf", ".png", ".svg", ".eps")


def paper_theme(context: Context) -> Theme:
    """Return the theme that suits the background of a figure style."""
    style = style_of(context.page.style, context.document.colours)
    ground = "#" + "".join(f"{round(255 * x):02X}" for x in style.background)
    return LIGHT if lightness(ground) > 0.5 else DARK


def save_figure(
    context: Context, title: str, name: str, save: Callable[..., None], figure: Callable[[], object], path: str = ""
) -> None:
    """Save the chart of `figure()` in the background; asks for a path if none is given."""
    from ...figures.chart_page import draw_chart

    with context.errors_shown():
        shown = figure()
        path = path or ask_path(context, title, name, FORMATS)
        if path:
            check_output(path, FORMATS)
            context[Exports].start(partial(draw_chart, save, shown, path), path, "Figure")
