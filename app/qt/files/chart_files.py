"""Charts saved as figures, in the background as all figures."""

from collections.abc import Callable
from functools import partial

from bihdist_core.errors import BihdistError
from bihdist_core.whole_file import check_output

from ...scene.style import style_of
from ..context import Context
from ..look.theme import DARK, LIGHT, Theme, lightness
from .exports import Exports
from .saving import ask_path

FORMATS = (".pdf", ".png", ".svg", ".eps")


def paper_theme(context: Context) -> Theme:
    """The theme whose colours go with the ground of figures."""
    style = style_of(context.page.style, context.document.colours)
    ground = "#" + "".join(f"{round(255 * x):02X}" for x in style.background)
    return LIGHT if lightness(ground) > 0.5 else DARK


def save_figure(
    context: Context, title: str, name: str, save: Callable[..., None], figure: Callable[[], object], path: str = ""
) -> None:
    """`save(figure, path, progress)` for what `figure()` says; asks for a path if there is none."""
    try:
        shown = figure()
        path = path or ask_path(context, title, name, FORMATS)
        if path:
            check_output(path, FORMATS)
            context[Exports].start(partial(save, shown, path), path, "Figure")
    except BihdistError as error:
        context.fail(error)
