"""Charts saved as figures, in the background as all figures.  `window` is the main window."""

from collections.abc import Callable
from functools import partial
from typing import Any

from bihdist_core.errors import BihdistError
from bihdist_core.whole_file import check_output

from ...scene.style import style_of
from ..look.theme import DARK, LIGHT, Theme, lightness
from .saving import ask_path

FORMATS = (".pdf", ".png", ".svg", ".eps")


def paper_theme(window: Any) -> Theme:
    """The theme whose colours go with the ground of figures."""
    style = style_of(window.page.style, window.session.document.colours)
    ground = "#" + "".join(f"{round(255 * x):02X}" for x in style.background)
    return LIGHT if lightness(ground) > 0.5 else DARK


def save_figure(
    window: Any, title: str, name: str, save: Callable[..., None], figure: Callable[[], object], path: str = ""
) -> None:
    """`save(figure, path, progress)` for what `figure()` says; asks for a path if there is none."""
    try:
        shown = figure()
        path = path or ask_path(window, title, name, FORMATS)
        if path:
            check_output(path, FORMATS)
            window.exports.start(partial(save, shown, path), path, "Figure")
    except BihdistError as error:
        window.failed(str(error))
