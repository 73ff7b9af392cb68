"""The page of a chart's figure: its look, its axes, and its file."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from bihdist_core import OutputError
from bihdist_core.file_output import atomic_write, check_output
from bihdist_core.progress import Progress

from ..document.page import Page
from ..drawing.chart import ASCENT, GAP, Axis, Ink, Plot, tick_shapes
from ..drawing.painters.mpl import POINT, paint
from ..drawing.shapes import RGBA, Box, Pen, Shape, Text, opaque
from ..scene.style import PAPER, Style
from .canvas import blank_page, matplotlib_settings
from .draw import FIGURE_FORMATS
from .fonts import check_font, text_width
from .page_output import write_undated
from .size import MM_PER_INCH, UNITS_PER_INCH, Size

INCHES = 5.5
"""As wide as the text of most papers."""

POINTS = 8.0
"""The font size, if nothing is said."""

PIXELS_PER_INCH = 300

RULE, TICK = 0.8, 3.3
"""Units that an axis is wide, and its ticks long."""

RIM = 4.0
"""Units that words keep from the edge of the page."""

FAINT = 0.25
"""Contrast of a grid's lines, as a fraction of that of quiet text."""

APART = (4.5, 2.6)
"""Least font sizes between ticks, across and up."""


@dataclass(frozen=True)
class ChartLook:
    """The look of a chart's figure.

    Attributes
    ----------
    inches
        Width of the page.
    points
        Font size.
    font
        Family, "" for the usual one.
    """

    style: Style = PAPER
    font: str = ""
    inches: float = INCHES
    points: float = POINTS

    @classmethod
    def of(cls, page: Page, style: Style, inches: float = INCHES) -> ChartLook:
        """Return the look of other figures on a page; a page without a width on paper is `inches` wide."""
        size = Size.parse(page.size) if page.size else Size()
        across = size.width / MM_PER_INCH if size.unit == "mm" and size.width else inches
        return cls(style, page.font_family, across, page.font_size or POINTS)

    @property
    def size(self) -> float:
        """The font size in units."""
        return self.points / POINT

    @property
    def width(self) -> float:
        """The width of the page in units."""
        return self.inches * UNITS_PER_INCH

    @property
    def ink(self) -> Ink:
        """The colours and the font of a chart's shapes."""
        style = self.style
        grid = Pen(faded(style, FAINT), 0.67)
        return Ink(opaque(style.text), opaque(style.quiet_text), grid, self.size)

    def text_width(self, text: str, size: float, is_bold: bool = False) -> float:
        """Return the width of a text, in the unit of its size."""
        return text_width(text, size, is_bold, self.font)

    @property
    def foot(self) -> float:
        """The height of ticks and of the words under them."""
        return TICK + (2 * GAP + 2 * ASCENT + 0.35) * self.size + RIM

    def right(self, across: Axis) -> float:
        """Return the free width at the right of a plot, where half of a tick's text may stand."""
        return RIM + max(self.text_width(across.words(value), self.size) for value in (across.low, across.high)) / 2

    def left(self, up: Axis, height: float, words: str) -> float:
        """Return the width at the left of a plot this high: of the words at the axis up, and of its ticks."""
        rows = up.ticks(height, APART[1] * self.size)
        widest = max((self.text_width(up.words(v, v == rows[-1]), self.size) for v in rows), default=0.0)
        return RIM + (1.5 * self.size if words else 0.0) + widest + GAP * self.size + TICK

    def plot(
        self,
        room: Box,
        across: Axis,
        up: Axis,
        words: tuple[str, str],
        left: float | None = None,
        is_square: bool = False,
    ) -> tuple[Plot, list[Shape]]:
        """Place a plot in a room with words at its axes; return it with its axes as shapes.

        The room is for the plot and what stands at its left, so wide if it is given, and under it.
        """
        size, high = self.size, room.height - (self.foot if words[0] else self.foot - 1.3 * self.size)
        left = self.left(up, high, words[1]) if left is None else left
        box = Box(room.x + left, room.y, max(room.width - left, size), high)
        if is_square and box.width > high:
            box = Box(box.x + (box.width - high) / 2, box.y, high, high)
        elif is_square:
            box = Box(box.x, box.y + high - box.width, box.width, box.width)
        plot = Plot(box, across, up)
        apart = APART[0] * size, APART[1] * size
        shapes = tick_shapes(plot, self.ink, apart, Pen(opaque(self.style.quiet_text), RULE), TICK)
        return plot, [*shapes, *_axis_words(self, plot, room, words, box.x - left)]


def _axis_words(look: ChartLook, plot: Plot, room: Box, words: tuple[str, str], left: float) -> list[Shape]:
    """Return words at the axes, moved along them where they would leave the room."""
    size, ink, (x, y) = look.size, look.ink, plot.box.middle
    across, up = words
    shapes: list[Shape] = []
    if across:
        half = look.text_width(across, size) / 2
        x = min(max(x, room.x + RIM + half), max(room.right - RIM - half, room.x + RIM + half))
        shapes.append(Text(across, x, room.bottom - RIM - 0.25 * size, size, ink.text, align="centre"))
    if up:
        half = look.text_width(up, size) / 2
        y = max(min(y, room.bottom - RIM - half), room.y - 0.7 * size + half)
        shapes.append(Text(up, left + RIM + 0.8 * size, y, size, ink.text, align="centre", angle=90.0))
    return shapes


USUAL_LOOK = ChartLook()


def faded(style: Style, share: float) -> RGBA:
    """Return the colour of quiet text with a fraction of its contrast; EPS knows no transparency."""
    pairs = zip(style.quiet_text, style.background, strict=True)
    return opaque([share * a + (1 - share) * b for a, b in pairs])


def draw_chart(save: Callable[[Any, str], None], figure: object, path: str, progress: Progress | None = None) -> None:
    """Save a figure as a job does, too quickly to report any progress."""
    save(figure, path)


def save_chart(
    path: str | os.PathLike[str],
    look: ChartLook,
    height: float,
    shapes: Sequence[Shape],
) -> None:
    """Write shapes on a page of a height in units to a .png, .pdf, .svg or .eps file, whole or not at all.

    Raises
    ------
    ParameterError
        If there is no such font.
    OutputError
        If the file cannot be written.
    """
    extension = check_output(path, FIGURE_FORMATS)
    check_font(look.font)
    with atomic_write(path) as temporary, matplotlib_settings(look.font):
        try:
            page = (look.inches, height / UNITS_PER_INCH), (look.width, height)
            figure, axes = blank_page(*page, PIXELS_PER_INCH, look.style.background)
            paint(axes, shapes, is_opaque=extension == ".eps")
            made: dict[str, Any] = {".png": {"Software": None}}.get(extension, {"Creator": "bihdist"})
            write_undated(figure, temporary, made, facecolor=look.style.background)
        except ValueError as error:  # matplotlib's word for a page it cannot make
            raise OutputError(f"{path} could not be written: {error}.") from error
