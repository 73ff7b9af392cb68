"""Paths, texts, images and groups of these: a drawing in the units of its page, y down, for any painter."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core.arrays import AnyArray, ByteArray

Point = tuple[float, float]
RGBA = tuple[float, float, float, float]
"""Red, green, blue and opacity, 0 to 1."""

Segment = tuple[Point, ...]
"""A line to a point, or a cubic Bézier curve by two control points to a third, from the end of the segment before."""


@dataclass(frozen=True)
class Box:
    """A rectangle."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """The x of the right side."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """The y of the lower side."""
        return self.y + self.height

    @property
    def middle(self) -> Point:
        """The x and y of the centre."""
        return self.x + self.width / 2, self.y + self.height / 2

    def grown(self, x: float, y: float | None = None) -> Box:
        """Return the box with so much more at its left and right, and as much or `y` above and below."""
        y = x if y is None else y
        return Box(self.x - x, self.y - y, self.width + 2 * x, self.height + 2 * y)

    def moved(self, across: float, down: float) -> Box:
        """Return the box so much farther across and down."""
        return Box(self.x + across, self.y + down, self.width, self.height)

    def without(self, edge: float) -> Box:
        """Return the box with so much less at each side, at most a quarter of the side."""
        edge = min(edge, self.width / 4, self.height / 4)
        return self.grown(-edge)

    def meets(self, other: Box) -> bool:
        """Return whether two boxes overlap."""
        return self.x < other.right and other.x < self.right and self.y < other.bottom and other.y < self.bottom

    def holds(self, x: float, y: float, edge: float = 0.0) -> bool:
        """Return whether a place is inside, or outside by less than `edge`."""
        return self.x - edge <= x <= self.right + edge and self.y - edge <= y <= self.bottom + edge

    def contains(self, other: Box) -> bool:
        """Return whether another box lies inside."""
        return self.holds(other.x, other.y) and self.holds(other.right, other.bottom)

    def shares(self, points: AnyArray) -> AnyArray:
        """Return points (…, 2) as fractions of the sides, from the upper left corner."""
        return (points - [self.x, self.y]) / [self.width, self.height]

    def at(self, shares: AnyArray) -> AnyArray:
        """Return the points (…, 2) at fractions of the sides."""
        return shares * [self.width, self.height] + [self.x, self.y]

    def snapped(self, scale: float, keeps_size: bool = False) -> Box:
        """Return the box with its sides on whole pixels, `scale` of which are a unit.

        With `keeps_size`, equal boxes have equal numbers of pixels wherever they stand.
        """
        x, y = round(self.x * scale), round(self.y * scale)
        if keeps_size:
            width, height = max(round(self.width * scale), 1), max(round(self.height * scale), 1)
            return Box(x / scale, y / scale, width / scale, height / scale)
        right, bottom = max(round(self.right * scale), x + 1), max(round(self.bottom * scale), y + 1)
        return Box(x / scale, y / scale, (right - x) / scale, (bottom - y) / scale)

    def pixels(self, scale: float) -> tuple[int, int, int, int]:
        """Return left, top, width and height of a snapped box in pixels."""
        return round(self.x * scale), round(self.y * scale), round(self.width * scale), round(self.height * scale)


@dataclass(frozen=True)
class Subpath:
    """Segments from a start; a closed one returns to it by a line if its segments do not."""

    start: Point
    segments: tuple[Segment, ...]
    is_closed: bool = True


@dataclass(frozen=True)
class Pen:
    """A stroke along a path, with dashes and gaps in widths of the line.

    `cap` is "butt" or "round", `join` is "miter" or "round".
    """

    colour: RGBA
    width: float = 1.0
    dashes: tuple[float, ...] = ()
    cap: str = "butt"
    join: str = "miter"


@dataclass(frozen=True, eq=False)
class Gradient:
    """Colours (k, 3 or 4), evenly from a start to a stop in the path's own coordinates."""

    start: Point
    stop: Point
    colours: tuple[tuple[float, ...], ...]


@dataclass(frozen=True)
class Path:
    """Outlines that are filled, stroked, or both, in units of `scale` about `at`; the pen's width is in page units."""

    subpaths: tuple[Subpath, ...]
    fill: RGBA | Gradient | None = None
    pen: Pen | None = None
    at: Point = (0.0, 0.0)
    scale: Point = (1.0, 1.0)
    name: str = ""


@dataclass(frozen=True)
class Text:
    """A line of text.

    Attributes
    ----------
    align
        What stands at x: the "left", the "centre" or the "right".
    level
        What stands at y: the "baseline", or the middle of the "capitals", of the "lowercase" letters, or of the "line".
    angle
        Degrees against the clock about (x, y).
    halo
        A pen around the letters.
    are_digits_even
        Whether each digit takes the width of the widest.
    """

    text: str
    x: float
    y: float
    size: float
    colour: RGBA
    is_bold: bool = False
    align: str = "left"
    level: str = "baseline"
    angle: float = 0.0
    halo: Pen | None = None
    are_digits_even: bool = False
    name: str = ""


@dataclass(frozen=True, eq=False)
class Image:
    """Pixels (h, w, 4) in a box."""

    pixels: ByteArray
    box: Box


@dataclass(frozen=True)
class Group:
    """Shapes that are seen inside a box only."""

    shapes: tuple[Shape, ...]
    clip: Box


Shape = Path | Text | Image | Group


def moved(shapes: Iterable[Shape], across: float, down: float) -> list[Shape]:
    """Return shapes at places so much farther across and down."""

    def one(shape: Shape) -> Shape:
        if isinstance(shape, Text):
            return replace(shape, x=shape.x + across, y=shape.y + down)
        if isinstance(shape, Path):
            return replace(shape, at=(shape.at[0] + across, shape.at[1] + down))
        if isinstance(shape, Image):
            return replace(shape, box=shape.box.moved(across, down))
        return Group(tuple(moved(shape.shapes, across, down)), shape.clip.moved(across, down))

    return [one(shape) for shape in shapes]


def opaque(colour: Sequence[float], opacity: float = 1.0) -> RGBA:
    """Return a colour with an opacity; that of a colour which has one is kept, times the other."""
    red, green, blue, *own = (float(part) for part in colour)
    return red, green, blue, opacity * (own[0] if own else 1.0)


def hexadecimal(colour: str, opacity: float = 1.0) -> RGBA:
    """Return the colour "#rrggbb" with an opacity."""
    red, green, blue = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return red, green, blue, opacity


def polyline(points: np.ndarray | Sequence[Point], is_closed: bool = False) -> tuple[Subpath, ...]:
    """Return a line through points (k, 2), or a polygon."""
    first, *others = ((float(x), float(y)) for x, y in points)
    return (Subpath(first, tuple((point,) for point in others), is_closed),)


def rectangle(box: Box) -> tuple[Subpath, ...]:
    """Return the outline of a box."""
    return polyline([(box.x, box.y), (box.right, box.y), (box.right, box.bottom), (box.x, box.bottom)], True)


ROUND = 4 / 3 * (2**0.5 - 1)
"""Distance from the ends of a quarter of a circle of radius 1 to the control points of its Bézier curve."""


def rounded(box: Box, radius: float) -> tuple[Subpath, ...]:
    """Return the outline of a box with round corners."""
    x, y = min(radius, box.width / 2), min(radius, box.height / 2)
    left, right, top, bottom, a, b = box.x, box.right, box.y, box.bottom, x * (1 - ROUND), y * (1 - ROUND)
    return (
        Subpath(
            (left + x, top),
            (
                ((right - x, top),),
                ((right - a, top), (right, top + b), (right, top + y)),
                ((right, bottom - y),),
                ((right, bottom - b), (right - a, bottom), (right - x, bottom)),
                ((left + x, bottom),),
                ((left + a, bottom), (left, bottom - b), (left, bottom - y)),
                ((left, top + y),),
                ((left, top + b), (left + a, top), (left + x, top)),
            ),
        ),
    )


CIRCLE = rounded(Box(-1.0, -1.0, 2.0, 2.0), 1.0)
"""The circle of radius 1 about the origin."""


def disc(at: Point, radius: float, fill: RGBA | None = None, pen: Pen | None = None) -> Path:
    """Return a circle about a place."""
    return Path(CIRCLE, fill, pen, at, (radius, radius))


def line(start: Point, stop: Point, pen: Pen) -> Path:
    """Return a line from one place to another."""
    return Path(polyline([start, stop]), pen=pen)
