"""A figure drawn small and soon, to be looked at while its size and looks are chosen."""

from dataclasses import dataclass

from bihdist_core.arrays import ByteArray

from .description import Figure
from .draw import draw_figure
from .glyphs import POINT
from .layout import lay_out
from .shots import RenderCache
from .size import MM_PER_INCH, UNITS_PER_INCH

FINER = 2
"""Letters of a few pixels are read where they are drawn larger, and made smaller as a picture."""


@dataclass(frozen=True, eq=False)
class Preview:
    """pixels: (height, width, 3 or 4) uint8.

    size: of the whole figure, in millimetres if it is to be printed and in pixels otherwise; smallest: of its letters,
    in points or pixels.
    """

    pixels: ByteArray
    size: tuple[float, float]
    is_printed: bool
    smallest: float


_STAGE: list[RenderCache] = []


def preview(figure: Figure, room: tuple[int, int]) -> Preview:
    """The figure as it will be, in a picture that fills FINER times so many pixels across or down.

    For a process of its own: what it needs for the next one is kept.
    """
    if not _STAGE:
        _STAGE.append(RenderCache(finer=1, samples=0))
    layout = lay_out(figure)
    share = FINER * min(room[0] / layout.page[0], room[1] / layout.page[1])
    pixels = draw_figure(figure, render_cache=_STAGE[0], share=share)
    is_printed = figure.size.unit == "mm"
    size = (layout.width, layout.height) if is_printed else layout.page
    per = MM_PER_INCH / UNITS_PER_INCH if is_printed else 1.0
    letters = layout.smallest if is_printed else layout.smallest / POINT * layout.scale
    return Preview(pixels, (size[0] * per, size[1] * per), is_printed, letters)


def whole_picture(figure: Figure, most: int) -> tuple[ByteArray, float]:
    """(height, width, 3 or 4) uint8, as it would be exported, and its pixels per inch.

    A picture with more than `most` pixels along a side is drawn smaller.
    """
    layout = lay_out(figure)
    share = min(most / max(layout.page), 1.0)
    return draw_figure(figure, share=share), UNITS_PER_INCH * layout.scale * share
