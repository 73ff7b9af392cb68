"""A scale bar: a line of a round length in a lower corner of a picture, with the length above it."""

import math
from collections.abc import Collection

from .numbers import tick
from .shapes import RGBA, Box, Path, Pen, Shape, Text, line, rectangle

CORNERS = ("bottom right", "bottom left")
"""Corners for the bar, of which it takes the first that is free."""

LONGEST = 0.3
"""Of the picture's width."""

AWAY, ABOVE, END = 1.2, 0.45, 0.3
"""Letter sizes: from the sides of the picture, from the line to the words, and of half the strokes at its ends."""

WIDE = 0.62
"""Letter sizes that a letter is wide, at most on average."""

ROUND = (1.0, 2.0, 5.0)
"""Lengths, times a power of ten."""


def round_length(most: float) -> float:
    """Return the largest round length that is not longer."""
    power = 10.0 ** math.floor(math.log10(most))
    return max(each * power for each in ROUND if each * power <= most * (1 + 1e-9))


def corner_of_bar(taken: Collection[str]) -> str:
    """Return the corner of the bar, where some are taken."""
    return next((corner for corner in CORNERS if corner not in taken), CORNERS[0])


def scale_bar_shapes(
    box: Box,
    per_unit: float,
    words: tuple[str, str],
    taken: Collection[str],
    letter: float,
    width: float,
    ink: RGBA,
    ground: RGBA,
) -> list[Shape]:
    """Return the scale bar of a picture in a box.

    Parameters
    ----------
    per_unit
        How long a unit of the mesh is on the page.
    words
        What stands before and after the number: "≈ " where lengths depend on the depth, and the unit.
    taken
        Corners that are not free.
    letter, width
        Size of the letters, and width of the line.
    ink, ground
        The colours of the bar, and of what is under it.
    """
    length = round_length(LONGEST * box.width / per_unit)
    is_right = corner_of_bar(taken) == CORNERS[0]
    y, long = box.bottom - AWAY * letter, length * per_unit
    left = box.right - AWAY * letter - long if is_right else box.x + AWAY * letter
    text, pen = f"{words[0]}{tick(length)} {words[1]}", Pen(ink, width)
    wide, high = max(long, WIDE * letter * len(text)), (END + ABOVE + 1) * letter
    under = Box(left + long - wide if is_right else left, y - high, wide, high + END * letter).grown(END * letter)
    return [
        Path(rectangle(under), ground),
        line((left, y), (left + long, y), pen),
        *(line((x, y - END * letter), (x, y + END * letter), pen) for x in (left, left + long)),
        Text(
            text, left + is_right * long, y - (END + ABOVE) * letter, letter, ink, align="right" if is_right else "left"
        ),
    ]
