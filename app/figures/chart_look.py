"""The look of charts in figures, and their axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

from ..document.page import Page
from ..drawing.chart import ASCENT, GAP, Axis, Ink, Plot, tick_shapes
from ..drawing.painters.mpl import POINT
from ..drawing.shapes import RGBA, Box, Pen, Shape, Text, opaque
from ..scene.style import PAPER, Style
from .fonts import text_width
from .size import MM_PER_INCH, UNITS_PER_INCH, Size
from .words import Lettering

INCHES = 5.5
"""As wide as the text of most papers."""

POINTS = 8.0
"""The font size, if nothing is said."""

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
    """The look of a chart.

    Attributes
    ----------
    inches
        Width of the chart, or of its page.
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
    ink, (x, y), lettering = look.ink, plot.box.middle, Lettering(look.font)
    across, up = words
    shapes: list[Shape] = []
    if across:
        size, (lines,) = lettering.fitted([across], look.size, room.width - 2 * RIM, 1)
        half = max((lettering.width(each, size) / 2 for each in lines), default=0.0)
        x = min(max(x, room.x + RIM + half), max(room.right - RIM - half, room.x + RIM + half))
        y_words = room.bottom - RIM - 0.25 * size
        shapes += [Text(each, x, y_words, size, ink.text, align="centre") for each in lines]
    if up:
        top, bottom = room.y - 0.7 * look.size, room.bottom - RIM - (1.4 * look.size if across else 0.0)
        size, (lines,) = lettering.fitted([up], look.size, bottom - top, 1)
        half = max((lettering.width(each, size) / 2 for each in lines), default=0.0)
        y = max(min(y, bottom - half), top + half)
        shapes += [Text(each, left + RIM + 0.8 * size, y, size, ink.text, align="centre", angle=90.0) for each in lines]
    return shapes


USUAL_LOOK = ChartLook()


class Chart(Protocol):
    """A chart on a page of its own or beside panels: a frozen dataclass with a look."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def look(self) -> ChartLook:
        """The colours, font and width."""

    def shapes(self, height: float) -> list[Shape]:
        """Return its shapes, from 0 to the look's width and from 0 to a height, in units."""


def faded(style: Style, share: float) -> RGBA:
    """Return the colour of quiet text with a fraction of its contrast; EPS knows no transparency."""
    pairs = zip(style.quiet_text, style.background, strict=True)
    return opaque([share * a + (1 - share) * b for a, b in pairs])
