"""Figures: fields on surfaces in rows and columns of panels, drawn with no window, to pixels or to PDF and SVG.

A `Figure` says everything that can be seen; `draw_figure` and `save_figure` are all that draws one.
"""

import os
from dataclasses import replace

from bihdist_core import OutputError
from bihdist_core.arrays import ByteArray
from bihdist_core.machine_memory import check_memory
from bihdist_core.progress import Progress, part
from bihdist_core.whole_file import check_output, whole_file

from ..document.document import Zoom
from .canvas import Composition
from .composition import KeptWords, page_pixels, write_vector
from .description import Figure, FigurePanel
from .layout import Layout, lay_out
from .marks import hidden_words
from .raster import check_offscreen
from .shots import RenderCache, take_shots

__all__ = ["FIGURE_FORMATS", "Figure", "FigurePanel", "Zoom", "check_offscreen", "draw_figure", "save_figure"]

FIGURE_FORMATS = (".png", ".pdf", ".svg", ".eps")

VECTOR_DPI = 300
"""The least resolution of the shading in PDF, SVG and EPS, as long as the page is not larger than MOST_PIXELS."""

BYTES_PER_PIXEL = 20
"""Of memory, at the most at a time."""
REMEDY = "choose a smaller --size."

MOST_PIXELS = 6000
"""Along a side of a page with vectors: a poster is seen from farther away."""


def draw_figure(
    figure: Figure,
    progress: Progress | None = None,
    render_cache: RenderCache | None = None,
    words: KeptWords | None = None,
    share: float = 1.0,
) -> ByteArray:
    """(height, width, 3) uint8 picture, or (height, width, 4) with alpha if it is transparent.

    stage, words: kept from one figure to the next.  share: of its own resolution.
    Raises BihdistError where nothing can be drawn off screen.
    """
    return page_pixels(_page(figure, False, progress, render_cache, share), words)


def save_figure(figure: Figure, path: str | os.PathLike[str], progress: Progress | None = None) -> list[str]:
    """Draw a figure into a .png, .pdf, .svg or .eps file, whole or not at all; sentences on what it does not show.

    Raises OutputError if it cannot be written; what was at `path` before then stays.
    """
    extension = check_output(path, FIGURE_FORMATS)
    check_transparency(figure.transparent, path)
    with whole_file(path) as temporary:
        if extension == ".png":
            from PIL import Image

            page = _page(figure, False, progress)
            dpi = 96 * page.layout.scale
            Image.fromarray(page_pixels(page)).save(temporary, dpi=(dpi, dpi))
        else:
            page = replace(_page(figure, True, progress), is_opaque=extension == ".eps")
            try:
                write_vector(page, temporary)
            except ValueError as error:  # matplotlib's word for a page it cannot make
                raise OutputError(f"{path} could not be written: {error}.") from error
    return [*figure.remarks, *hidden_words(page)]


def check_transparency(transparent: bool, path: str | os.PathLike[str]) -> None:
    """OutputError for a page without background in a format that has none of that."""
    if transparent and os.fspath(path).lower().endswith(".eps"):
        raise OutputError(f"{path}: EPS has no transparency; leave --transparent away, or write PDF, SVG or PNG.")


def described(figure: Figure) -> str:
    """How many panels, and how large a page."""
    width, height = lay_out(figure).page
    count = len(figure.panels)
    return f"{count} {'panel' if count == 1 else 'panels'} on {width} x {height} pixels"


def check_room(figure: Figure, extension: str) -> None:
    """Before long work: NotEnoughMemory where there is none for the picture in such a file."""
    _layout(figure, extension != ".png")


def _layout(figure: Figure, vector: bool, share: float = 1.0) -> Layout:
    layout = lay_out(figure, 0.0, share)
    if vector:
        layout = lay_out(figure, min(VECTOR_DPI / 96, MOST_PIXELS / max(layout.width, layout.height)), share)
    width, height = layout.page
    check_memory(BYTES_PER_PIXEL * width * height, f"A picture of {width:,} x {height:,} pixels", REMEDY)
    return layout


def _page(
    figure: Figure, vector: bool, progress: Progress | None, render_cache: RenderCache | None = None, share: float = 1.0
) -> Composition:
    layout = _layout(figure, vector, share)
    return Composition(figure, layout, take_shots(figure, layout, part(progress, 0.0, 0.95), render_cache))
