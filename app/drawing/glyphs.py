"""The shapes of marked points, with the places of labels beside them, and the looks of lines, each defined once.

Outlines are in unit coordinates about the place that is marked, with y down; a glyph's outside is at 1.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import acos, cos, degrees, radians, sin, tan

from .shapes import CIRCLE, Box, Path, Pen, Point, Segment, Shape, Subpath, Text, disc, hexadecimal, opaque, polyline


@dataclass(frozen=True)
class Layer:
    """One stroke or fill of a glyph.

    Attributes
    ----------
    line, fill
        Colours by names that `Style.named` knows, "own" for the mark's, "" for none.
    width
        Of the line, in rims.
    dashes
        Lengths of a dash and of a gap, in widths.
    inset
        Rims by which the outline is within the outside.
    opacity
        Where a page can have one.
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

    Attributes
    ----------
    screen
        Layers in the window, if these are others.
    reach
        From the place to the outside, as a fraction of the width of marks.
    least, of_text
        Least reach in pixels at scale 1, and as a fraction of the size of labels.
    pixels
        Reach in the window, 0 if the fraction says it.
    rim, least_rim
        Width of a rim as a fraction of the reach, and in pixels at least.
    join, cap
        Of corners and of the ends of open lines, "round", "miter" or "butt".
    rise
        Reaches from the place up to the middle of the shape, where a mark's number stands in the colour `numeral`.
    rank
        Glyphs of a higher rank are painted over others.
    hidden
        Glyph where the surface hides the place; None for nothing.
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
        """Return the reach, where marks are so far across and labels so large."""
        return max(self.reach * across, self.of_text * label, self.least)


def arc(start: float, stop: float, middle: Point = (0.0, 0.0), steps: int = 8) -> tuple[Point, tuple[Segment, ...]]:
    """Return the start and the curves of an arc of radius 1; angles in degrees, from the right towards below."""
    step = radians(stop - start) / steps
    reach = 4 / 3 * tan(step / 4)
    x, y = middle

    def at(k: int, along: float = 0.0) -> Point:
        angle = radians(start) + k * step
        return x + cos(angle) - along * sin(angle), y + sin(angle) + along * cos(angle)

    return at(0), tuple((at(k, reach), at(k + 1, -reach), at(k + 1)) for k in range(steps))


def _marker(rise: float) -> tuple[Subpath, ...]:
    """Return a circle so far above the place, and its tangents from there."""
    half = degrees(acos(1 / rise))
    start, curves = arc(90 - half, -270 + half, (0.0, -rise))
    return (Subpath((0.0, 0.0), ((start,), *curves)),)


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
"""Marks where a field starts."""
LARGEST = replace(DISC, name="largest", rank=4)
"""Marks the largest difference."""
SWATCH = Glyph(
    "swatch",
    polyline([(-1, -1), (1, -1), (1, 1), (-1, 1)], True),
    (Layer("quiet_text", 0.5, "own"),),
    least=3.5,
    of_text=0.36,
)
"""Stands in a legend for a colour."""
DOT = replace(DISC, name="dot", reach=0.3, least=2.0, rank=1, hidden=None)
"""Marks a point that an isoline passes through."""
RING = Glyph(
    "ring",
    CIRCLE,
    # A dark ring on a white disc, which is its halo, too.
    (Layer(fill="white"), Layer(fill="mark_edge", inset=0.17), Layer(fill="white", inset=0.5)),
    rim=1.0,
    rank=3,
    hidden=GHOST,
)
"""Marks an anchor."""

UP, DOWN = (polyline([(0.0, way), (-0.87, -0.6 * way), (0.87, -0.6 * way)], True) for way in (-1.0, 1.0))
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
"""Mark a maximum and a minimum."""

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
"""Marks a point whose partner is sought."""
NAMED = replace(_BALL, name="named", reach=0.4, hidden=GHOST)
"""Marks a pin whose name is written, at the end of a line."""
_DIAMOND = replace(_BALL, name="diamond", outline=polyline([(0, -1), (1, 0), (0, 1), (-1, 0)], True), reach=0.72)
DIAMOND = replace(_DIAMOND, hidden=replace(_DIAMOND, layers=_HOLLOW))
"""Marks the partner that was found."""

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
"""Marks the true partner of a point."""

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
"""Marks the place of a pin that is not set yet."""

NUMERAL = (1.25, 1.1, 0.85)
"""The size of a number of one, two and three digits in a figure, in reaches of its glyph."""
SCREEN_NUMERAL = (11 / 8.5, 10 / 8.5, 8 / 8.5)
"""The same on a screen."""


def glyph_shapes(
    glyph: Glyph,
    at: Point,
    reach: float,
    colour_of: Callable[[str], Sequence[float]],
    number: int | None = None,
    layers: Sequence[Layer] | None = None,
    scale: float = 1.0,
    is_upside_down: bool = False,
    numerals: Sequence[float] = NUMERAL,
) -> list[Shape]:
    """Return a glyph about a place.

    Parameters
    ----------
    reach
        From the place to the outside, before it is scaled.
    colour_of
        Returns the colour that a layer names.
    number
        Stands in a glyph that has room for one.
    layers
        Those of the glyph if not given.
    scale
        Of all of it, its rims and its number.
    is_upside_down
        Whether a glyph that stands above its place hangs below it.
    """
    rim, way = max(glyph.rim * reach, glyph.least_rim), -1.0 if is_upside_down else 1.0
    shapes: list[Shape] = []
    for layer in glyph.layers if layers is None else layers:
        size = scale * (reach - layer.inset * rim)
        fill = opaque(colour_of(layer.fill), layer.opacity) if layer.fill else None
        shapes.append(Path(glyph.outline, fill, _pen(glyph, layer, rim, colour_of, scale), at, (size, way * size)))
    if glyph.rise and number is not None:
        text, colour = str(number), opaque(colour_of(glyph.numeral))
        size, y = scale * reach * numerals[min(len(text), 3) - 1], at[1] - way * glyph.rise * scale * reach
        shapes.append(Text(text, at[0], y, size, colour, is_bold=True, align="centre", level="capitals"))
    return shapes


def _pen(
    glyph: Glyph, layer: Layer, rim: float, colour_of: Callable[[str], Sequence[float]], scale: float
) -> Pen | None:
    if not layer.line:
        return None
    cap = "butt" if layer.dashes else glyph.cap
    colour = opaque(colour_of(layer.line), layer.opacity)
    return Pen(colour, scale * layer.width * rim, layer.dashes or (), cap, glyph.join)


@dataclass(frozen=True)
class Stroke:
    """A stroke in a named colour, so many pixels wide at scale 1, or of dots as many pixels apart."""

    colour: str
    width: float
    dots: float = 0.0


@dataclass(frozen=True)
class LineLook:
    """The strokes of a line, the lowest first; lines of a higher rank are drawn over others.

    Attributes
    ----------
    hidden
        Strokes where the surface is before the line, () for none.
    """

    name: str
    strokes: tuple[Stroke, ...]
    hidden: tuple[Stroke, ...] = ()
    rank: int = 0

    def behind(self, opacity: float) -> tuple[tuple[Stroke, ...], float]:
        """Return the strokes behind a surface of this opacity, and their own opacity: paler, if it is translucent."""
        return (self.hidden, 1.0) if opacity == 1 else (self.strokes, max(1 - opacity, FAINTEST))


FAINTEST = 0.35
"""Opacity of lines behind a translucent surface, at least."""
BOUNDARY = LineLook("regions", (Stroke("white", 4.5), Stroke("mark_edge", 2.0)))
"""The look of a region's boundary."""
PATH = LineLook(
    "path",
    (Stroke("white", 4.5), Stroke("mark_edge", 2.0)),
    hidden=(Stroke("white", 4.0, dots=6.0), Stroke("mark_edge", 1.5, dots=6.0)),
    rank=1,
)
"""The look of a profile's path."""
LABELS = LineLook("labels", (Stroke("outline_colour", 0.7),), rank=-3)
"""The look of borders between labels."""
FEATURE_EDGES = LineLook("feature-edges", (Stroke("outline_colour", 0.7),), rank=-2)
"""The look of lines along sharp edges."""
SECTION = LineLook("section", (Stroke("section", 1.8),), rank=-1)
"""The look of the line where a clip plane cuts a surface."""
SOURCE = LineLook("source", (Stroke("mark_edge", 6.0), Stroke("source", 3.5)), rank=2)
"""The look of a line from which a field starts."""


RADIUS, ECHO = 8.0, 6.0
"""Logical pixels: the radius of the ring under the pointer, and of that in the other panels."""

REACH = 14
"""Logical pixels about a place that its ring may cover."""

BRIGHT, DARK = hexadecimal("#FFFFFF"), hexadecimal("#14161A")


def ring_shapes(at: Point, is_own: bool, is_hidden: bool = False, scale: float = 1.0) -> list[Shape]:
    """Return a white ring between dark rims, with a dot in the panel of the pointer; dashed behind the surface."""
    radius = scale * (RADIUS if is_own else ECHO)
    shapes: list[Shape] = []
    for colour, width in ((DARK, 4.5), (BRIGHT, 2.0)):
        dashes = (4.0 / width, 3.0 / width) if is_hidden else ()
        shapes.append(disc(at, radius, pen=Pen(colour, scale * width, dashes)))
    if is_own:
        shapes.append(disc(at, 2.0 * scale, BRIGHT, Pen(DARK, scale)))
    return shapes


AWAY, RIM = 9.0, 6.0
"""Logical pixels from a place to its label, and to the rim of its mark."""


def label_boxes(
    places: Sequence[Point], sizes: Sequence[Point], ranks: Sequence[int], view: Box, scale: float = 1.0
) -> list[Box | None]:
    """Place labels (width, height) in a view, off each other and off all places; None where there is no room.

    Those of the lowest rank are placed first, and of rank 0 stand somewhere whatever they cover.
    """
    found: list[Box | None] = [None] * len(places)
    dots = [Box(*at, 0.0, 0.0).grown(RIM * scale) for at in places]
    for k in sorted(range(len(places)), key=lambda k: ranks[k]):
        taken = [box for box in found if box is not None] + dots[:k] + dots[k + 1 :]
        boxes = [box for box in _beside(places[k], sizes[k], scale) if view.contains(box)]
        found[k] = next((box for box in boxes if not any(box.meets(other) for other in taken)), None)
        if found[k] is None and not ranks[k]:
            found[k] = next(iter(boxes), None)
    return found


def _beside(at: Point, size: Point, scale: float) -> list[Box]:
    """Return boxes at the right, the left, above, below, and at the corners of a place."""
    (x, y), (wide, high), away = at, size, AWAY * scale
    near = 0.7 * away
    lefts = (away, -away - wide, -wide / 2, -wide / 2, near, -near - wide, near, -near - wide)
    tops = (-high / 2, -high / 2, -away - high, away, -near - high, -near - high, near, near)
    return [Box(x + left, y + top, wide, high) for left, top in zip(lefts, tops, strict=True)]
