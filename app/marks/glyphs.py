"""The shapes of marked points, each defined once: the window and figures paint them from here.

Outlines are in unit coordinates about the place that is marked, with y down; a glyph's outside is at 1.
"""

from dataclasses import dataclass, replace
from math import acos, cos, degrees, radians, sin, tan

Point = tuple[float, float]

Segment = tuple[Point, ...]
"""From where the one before ends: to a point, or along a cubic Bézier curve by two control points to a third."""


@dataclass(frozen=True)
class Subpath:
    """Segments from a start; is_closed: by a line back to it, if they do not end there."""

    start: Point
    segments: tuple[Segment, ...]
    is_closed: bool = True


@dataclass(frozen=True)
class Layer:
    """One stroke or fill of a glyph.

    line, fill: colours, by names that `Style.named` knows, "own" for the mark's, "" for none.  width: of the line, in
    rims; dashes: lengths of a dash and of a gap, in widths.  inset: rims by which the outline is within the outside.
    opacity: where a page can have one.
    """

    line: str = ""
    width: float = 0.0
    fill: str = ""
    dashes: tuple[float, float] | None = None
    inset: float = 0.0
    opacity: float = 1.0


@dataclass(frozen=True)
class Glyph:
    """A shape, painted in layers, the lowest first.

    reach: from the place to the outside, as a fraction of what marks are across; least: in pixels at scale 1;
    of_text: as a fraction of the size of labels, at least.  pixels: the reach in the window, 0 if the fraction says it.
    rim: as a fraction of the reach; least_rim: in pixels.  join: of corners, "round" or "miter"; cap: of open lines.
    screen: layers in the window, if these are others.
    rise: reaches from the place up to the middle of the shape, where a mark's number stands, in the colour `numeral`.
    rank: glyphs of a higher one are painted over others.  hidden: what is painted where the surface hides the
    place; None for nothing.
    """

    name: str
    outline: tuple[Subpath, ...]
    layers: tuple[Layer, ...]
    screen: tuple[Layer, ...] = ()
    reach: float = 0.5
    least: float = 0.0
    of_text: float = 0.0
    pixels: float = 0.0
    rim: float = 0.2
    least_rim: float = 0.0
    join: str = "miter"
    cap: str = "butt"
    rise: float = 0.0
    numeral: str = "white"
    rank: int = 0
    hidden: "Glyph | None" = None

    def reach_of(self, across: float, label: float) -> float:
        """Where marks are so far across and labels so large."""
        return max(self.reach * across, self.of_text * label, self.least)


def arc(start: float, stop: float, middle: Point = (0.0, 0.0), steps: int = 8) -> tuple[Point, tuple[Segment, ...]]:
    """Where an arc of radius 1 starts, and its curves; angles in degrees, from the right towards below."""
    step = radians(stop - start) / steps
    reach = 4 / 3 * tan(step / 4)
    x, y = middle

    def at(k: int, along: float = 0.0) -> Point:
        angle = radians(start) + k * step
        return x + cos(angle) - along * sin(angle), y + sin(angle) + along * cos(angle)

    return at(0), tuple((at(k, reach), at(k + 1, -reach), at(k + 1)) for k in range(steps))


def polygon(*corners: Point) -> tuple[Subpath, ...]:
    """A closed outline."""
    return (Subpath(corners[0], tuple((corner,) for corner in corners[1:])),)


def _marker(rise: float) -> tuple[Subpath, ...]:
    """A circle so far above the place, and its tangents from there."""
    half = degrees(acos(1 / rise))
    start, curves = arc(90 - half, -270 + half, (0.0, -rise))
    return (Subpath((0.0, 0.0), ((start,), *curves)),)


CIRCLE = (Subpath(*arc(-90, 270)),)
DASHED = (2.2, 1.4)

# A hollow, dashed circle: light under dark, to be seen on every colour.
GHOST = Glyph(
    "ghost",
    CIRCLE,
    (
        Layer("background", 1.9, inset=0.5),
        Layer("text", 1.0, dashes=DASHED, inset=0.5),
    ),
    least=3.75,
    rim=0.24,
    least_rim=0.7,
)
DISC = Glyph("disc", CIRCLE, (Layer("mark_edge", 1.0, "own", inset=0.5),), least_rim=0.5, rank=2, hidden=GHOST)
"""Where a field starts."""
LARGEST = replace(DISC, name="largest", rank=4)
"""Where a difference is largest."""
DOT = replace(DISC, name="dot", reach=0.3, least=2.0, rank=1, hidden=None)
"""On an isoline through a point."""
RING = Glyph(
    "ring",
    CIRCLE,
    # A dark ring on a white disc, which is its halo, too.
    (Layer(fill="white"), Layer(fill="mark_edge", inset=0.17), Layer(fill="white", inset=0.5)),
    rim=1.0,
    rank=3,
    hidden=GHOST,
)
"""At an anchor."""

UP, DOWN = (polygon((0.0, way), (-0.87, -0.6 * way), (0.87, -0.6 * way)) for way in (-1.0, 1.0))
_TRIANGLE = Glyph(
    "triangle_up", UP, (Layer("mark_edge", 1.0, "white"),), least=3.0, pixels=6.0, rim=0.25, least_rim=0.6, join="round"
)
_OUTLINE = (Layer("white", 1.7), Layer("mark_edge", 0.7))
_FAINT = tuple(replace(layer, opacity=0.7) for layer in _OUTLINE)
TRIANGLE_UP = replace(_TRIANGLE, hidden=replace(_TRIANGLE, layers=_OUTLINE, screen=_FAINT))
TRIANGLE_DOWN = replace(
    TRIANGLE_UP,
    name="triangle_down",
    outline=DOWN,
    hidden=replace(_TRIANGLE, outline=DOWN, layers=_OUTLINE, screen=_FAINT),
)
"""At a maximum and at a minimum."""

_HOLLOW = (Layer("white", 2.0, inset=1.0), Layer("own", 1.0, inset=1.0))
_BALL = Glyph(
    "ball",
    CIRCLE,
    (Layer("mark_edge", 2.0, inset=1.0), Layer("white", 1.0, "own", inset=1.0)),
    reach=0.55,
    least=3.5,
    rim=0.22,
    least_rim=0.6,
)
BALL = replace(_BALL, hidden=replace(_BALL, layers=_HOLLOW))
"""A point that is sought."""
_DIAMOND = replace(_BALL, name="diamond", outline=polygon((0, -1), (1, 0), (0, 1), (-1, 0)), reach=0.72)
DIAMOND = replace(_DIAMOND, hidden=replace(_DIAMOND, layers=_HOLLOW))
"""What was found for it."""

_CROSS = Glyph(
    "cross",
    tuple(Subpath((-1.0, -way), (((1.0, way),),), is_closed=False) for way in (-1.0, 1.0)),
    (Layer("mark_edge", 2.2), Layer("white", 1.0)),
    screen=(Layer("mark_edge", 2.45), Layer("white", 1.18)),
    reach=0.45,
    least=3.0,
    pixels=6.0,
    rim=0.34,
    cap="round",
)
_DASHED_CROSS = (Layer("mark_edge", 2.2, dashes=(3.0 / 2.2, 1.6 / 2.2)), Layer("white", 1.0, dashes=(3.0, 1.6)))
CROSS = replace(_CROSS, hidden=replace(_CROSS, layers=_DASHED_CROSS, screen=(), cap="butt"))
"""Where a point belongs."""

RISE = 2.0
_PIN = Glyph(
    "pin",
    _marker(RISE),
    (Layer("mark_edge", 3.2), Layer("white", 1.6, "own")),
    screen=(Layer("mark_edge", 3.1), Layer("white", 1.73), Layer(fill="own")),
    reach=0.6,
    of_text=0.68,  # so that numerals are read
    pixels=8.5,
    rim=0.17,
    join="round",
    rise=RISE,
    rank=5,
)
PIN = replace(
    _PIN,
    hidden=replace(
        _PIN,
        layers=(Layer(fill="white", opacity=0.92), Layer("white", 2.4), Layer("own", 1.0, dashes=DASHED)),
        screen=(),
        numeral="own",
    ),
)
"""A circle with a number and its tangents from the place."""
_CANDIDATE = replace(
    _PIN,
    name="candidate",
    layers=(Layer("mark_edge", 2.4, "own"), Layer("white", 1.0, dashes=DASHED)),
    screen=(),
    rank=6,
)
CANDIDATE = replace(_CANDIDATE, hidden=_CANDIDATE)
"""Where a pin would be."""
