"""Figures: fields on surfaces in rows and columns of panels, drawn with no window, to pixels or to PDF and SVG.

A `Figure` says everything that can be seen; `draw_figure` and `save_figure` are all that draws one.
"""

import os
from dataclasses import dataclass, replace

from bihdist_core import OutputError
from bihdist_core.arrays import ByteArray
from bihdist_core.counts import counted
from bihdist_core.file_output import atomic_write, check_output
from bihdist_core.machine_memory import check_memory
from bihdist_core.progress import Progress, part

from ..document.document import Inset
from ..drawing.painters.mpl import POINT
from .description import Figure, FigurePanel
from .isoline_labels import unlabelled_words
from .layout import lay_out
from .marks import hidden_words
from .page_layout import ComposedPage, PageLayout
from .page_output import KeptWords, page_pixels, write_vector
from .raster import check_offscreen
from .shots import RenderCache, take_shots
from .size import MM_PER_INCH, UNITS_PER_INCH

__all__ = ["FIGURE_FORMATS", "Figure", "FigurePanel", "Inset", "check_offscreen", "draw_figure", "save_figure"]

FIGURE_FORMATS = (".png", ".pdf", ".svg", ".eps")

VECTOR_DPI = 300
"""The least resolution of the shading in PDF, SVG and EPS, as long as the page is not larger than MOST_PIXELS."""

BYTES_PER_PIXEL = 20
"""Bytes of memory for each pixel of a page, at most."""
REMEDY = "choose a smaller --size."

FINER = 2
"""Letters of a few pixels in a preview are read where they are drawn larger, and made smaller as a picture."""

MOST_PIXELS = 6000
"""Along a side of a page with vectors: a poster is seen from farther away."""


def draw_figure(
    figure: Figure,
    progress: Progress | None = None,
    render_cache: RenderCache | None = None,
    words: KeptWords | None = None,
    share: float = 1.0,
) -> ByteArray:
    """Draw a figure into pixels.

    Parameters
    ----------
    render_cache, words
        What is kept from one figure to the next.
    share
        A fraction of the figure's own resolution.

    Returns
    -------
    (height, width, 3) uint8 ndarray
        Or (height, width, 4) with alpha if the figure is transparent.

    Raises
    ------
    BihdistError
        If nothing can be drawn off screen.
    """
    return page_pixels(_page(figure, False, progress, render_cache, share), words)


def save_figure(figure: Figure, path: str | os.PathLike[str], progress: Progress | None = None) -> list[str]:
    """Write a figure to a .png, .pdf, .svg or .eps file, and return sentences on what it does not show.

    The file is whole, or not written at all.

    Raises OutputError if it cannot be written; what was at `path` before then stays.
    """
    extension = check_output(path, FIGURE_FORMATS)
    check_transparency(figure.transparent, path)
    with atomic_write(path) as temporary:
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
    return [*figure.remarks, *hidden_words(page), *unlabelled_words(figure, page.layout, page.shots)]


def check_transparency(transparent: bool, path: str | os.PathLike[str]) -> None:
    """Raise OutputError for a page without background in a format that has no transparency."""
    if transparent and os.fspath(path).lower().endswith(".eps"):
        raise OutputError(f"{path}: EPS has no transparency; leave out --transparent, or write PDF, SVG or PNG.")


def described(figure: Figure, path: str | os.PathLike[str] = "") -> str:
    """Return the number of panels and the size of the page: in millimetres in files that have no pixels."""
    layout = lay_out(figure)
    extension = os.path.splitext(path)[1].lower()
    if extension in FIGURE_FORMATS and extension != ".png":
        width, height = (side * MM_PER_INCH / UNITS_PER_INCH for side in (layout.width, layout.height))
        return f"{counted(len(figure.panels), 'panel')} on {width:.1f} x {height:.1f} mm"
    width, height = layout.page
    return f"{counted(len(figure.panels), 'panel')} on {width} x {height} pixels"


def check_room(figure: Figure, extension: str) -> None:
    """Raise NotEnoughMemory before long work if there is none for the picture in such a file."""
    _layout(figure, extension != ".png")


def _layout(figure: Figure, vector: bool, share: float = 1.0) -> PageLayout:
    layout = lay_out(figure, 0.0, share)
    if vector:
        layout = lay_out(figure, min(VECTOR_DPI / 96, MOST_PIXELS / max(layout.width, layout.height)), share)
    width, height = layout.page
    check_memory(BYTES_PER_PIXEL * width * height, f"A picture of {width:,} x {height:,} pixels", REMEDY)
    return layout


def _page(
    figure: Figure, vector: bool, progress: Progress | None, render_cache: RenderCache | None = None, share: float = 1.0
) -> ComposedPage:
    layout = _layout(figure, vector, share)
    return ComposedPage(figure, layout, take_shots(figure, layout, part(progress, 0.0, 0.95), render_cache))


@dataclass(frozen=True, eq=False)
class Preview:
    """A small picture of a figure.

    Attributes
    ----------
    pixels
        (height, width, 3 or 4) uint8.
    size
        Size of the whole figure, in millimetres if it is to be printed and in pixels otherwise.
    smallest
        Size of its smallest font, in points or pixels.
    remarks
        Sentences on what has no room.
    """

    pixels: ByteArray
    size: tuple[float, float]
    is_printed: bool
    smallest: float
    remarks: tuple[str, ...] = ()


_PREVIEW_CACHE: list[RenderCache] = []


def preview(figure: Figure, room: tuple[int, int]) -> Preview:
    """Return the figure as it will be, in a picture that fills FINER times so many pixels across or down.

    For a process of its own: what it needs for the next one is kept.
    """
    if not _PREVIEW_CACHE:
        _PREVIEW_CACHE.append(RenderCache(finer=1, samples=0))
    layout = lay_out(figure)
    share = FINER * min(room[0] / layout.page[0], room[1] / layout.page[1])
    page = _page(figure, False, None, _PREVIEW_CACHE[0], share)
    is_printed = figure.size.unit == "mm"
    size = (layout.width, layout.height) if is_printed else layout.page
    per = MM_PER_INCH / UNITS_PER_INCH if is_printed else 1.0
    letters = layout.smallest if is_printed else layout.smallest / POINT * layout.scale
    remarks = unlabelled_words(figure, page.layout, page.shots)
    return Preview(page_pixels(page), (size[0] * per, size[1] * per), is_printed, letters, tuple(remarks))


def whole_picture(figure: Figure, most: int) -> tuple[ByteArray, float]:
    """Return pixels (height, width, 3 or 4) uint8, as they would be exported, and how many there are in an inch.

    A picture with more than `most` pixels along a side is drawn smaller.
    """
    layout = lay_out(figure)
    share = min(most / max(layout.page), 1.0)
    return draw_figure(figure, share=share), UNITS_PER_INCH * layout.scale * share
