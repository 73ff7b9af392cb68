"""A colour bar: its colours, with a point where values go on beyond an end, and the lines across it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .shapes import (
    RGBA,
    Box,
    Gradient,
    Path,
    Pen,
    Shape,
    Subpath,
    line,
    opaque,
    polyline,
    rectangle,
    rounded,
)

OVERLAP = 2.0
"""Units that a point covers of its bar, whose corners may be round."""


@dataclass(frozen=True)
class BarLine:
    """A line across a bar at a place, 0 to 1, from its lower end, with a rim on both sides if it has one."""

    at: float
    width: float
    colour: RGBA
    rim: RGBA | None = None
    rim_width: float = 0.0


@dataclass(frozen=True)
class BarColours:
    """The colours of a bar, from the lower end to the upper.

    Attributes
    ----------
    colours
        RGB from 0 to 1, evenly along the bar or one for each band.
    starts
        Where bands begin, 0 to 1; empty for a bar without bands.
    goes_beyond
        Whether there are values below the lower and above the upper end.
    """

    colours: tuple[tuple[float, ...], ...]
    starts: tuple[float, ...] = ()
    goes_beyond: tuple[bool, bool] = (False, False)


def bar_shapes(box: Box, bar: BarColours, point: float, is_upright: bool = False, radius: float = 0.0) -> list[Shape]:
    """Return the colours of a bar in a box.

    Parameters
    ----------
    point
        How far a point sticks out at an end beyond which there are values.
    is_upright
        Whether the lower end is at the bottom rather than at the left.
    radius
        Of the corners of a bar without bands.
    """
    shapes: list[Shape] = [
        Path(_point(box, point, is_upright, is_end), opaque(bar.colours[-1 if is_end else 0]))
        for is_end, is_there in enumerate(bar.goes_beyond)
        if is_there
    ]
    if not bar.starts:
        ends = ((box.x, box.bottom), (box.x, box.y)) if is_upright else ((box.x, box.y), (box.right, box.y))
        outline = rounded(box, radius) if radius else rectangle(box)
        return [*shapes, Path(outline, Gradient(*ends, bar.colours))]
    for start, colour in zip(bar.starts, bar.colours, strict=True):
        # Each runs to the end of the bar, under the next ones: side by side they would show seams.
        part = Box(box.x + start * box.width, box.y, (1 - start) * box.width, box.height)
        if is_upright:
            part = Box(box.x, box.y, box.width, (1 - start) * box.height)
        shapes.append(Path(rectangle(part), opaque(colour)))
    return shapes


def outline_shape(box: Box, bar: BarColours, point: float, pen: Pen, radius: float = 0.0) -> Path:
    """Return the outline of a bar that lies flat, with its points."""
    left, right, middle = box.x, box.right, box.middle[1]
    (whole,) = rounded(box, 0.0 if bar.starts else radius)
    upper, lower = whole.segments[:4], whole.segments[4:]
    if bar.goes_beyond[1]:
        upper = ((right, box.y),), ((right + point, middle),), ((right, box.bottom),)
    if bar.goes_beyond[0]:
        lower = ((left, box.bottom),), ((left - point, middle),), ((left, box.y),)
    return Path((Subpath(lower[-1][-1], (*upper, *lower)),), pen=pen)


def line_shapes(box: Box, lines: Sequence[BarLine], is_upright: bool = False, pixel: float = 0.0) -> list[Shape]:
    """Return lines across a bar; their sides are on whole pixels of this size, if it has one."""
    found: list[Shape] = []
    for each in lines:
        if each.rim is not None:
            found.append(across(box, each.at, each.rim_width, each.rim, is_upright, pixel))
        found.append(across(box, each.at, each.width, each.colour, is_upright, pixel))
    return found


def across(
    box: Box, at: float, width: float, colour: RGBA, is_upright: bool = False, pixel: float = 0.0, beyond: float = 0.0
) -> Path:
    """Return one line across a bar at a place, 0 to 1, and so far beyond its sides."""
    pen = Pen(colour, width)
    if is_upright:
        y = box.bottom - at * box.height
        return line((box.x - beyond, y), (box.right + beyond, y), pen)
    x = box.x + at * box.width
    if pixel:
        thick = round(width / pixel)
        x, pen = (math.floor(x / pixel - thick / 2 + 0.5) + thick / 2) * pixel, Pen(colour, thick * pixel)
    return line((x, box.y - beyond), (x, box.bottom + beyond), pen)


def _point(box: Box, point: float, is_upright: bool, is_end: int) -> tuple[Subpath, ...]:
    way, (x, y) = (1 if is_end else -1), box.middle
    if is_upright:
        edge = box.y if is_end else box.bottom
        inside = edge + OVERLAP * way
        corners = [(box.x, inside), (box.x, edge), (x, edge - way * point), (box.right, edge), (box.right, inside)]
    else:
        edge = box.right if is_end else box.x
        inside = edge - OVERLAP * way
        corners = [(inside, box.y), (edge, box.y), (edge + way * point, y), (edge, box.bottom), (inside, box.bottom)]
    return polyline(corners, True)
