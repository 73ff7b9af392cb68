"""Styles of pictures: the one place where colours and line widths are defined."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core.arrays import ByteArray, FloatArray
from bihdist_core.errors import ParameterError

from ..document.looks import OF_THE_STYLE, Colours, Stops
from ..drawing.shapes import RGBA, opaque
from . import colour_maps
from .colour_maps import MAPS, backwards, colours_at, goes_both_ways, lightened, oklab

Colour = tuple[float, float, float]

WHITE, INK = (1.0, 1.0, 1.0), (0.08, 0.085, 0.1)

LINES_ON_COLOURS = (WHITE, INK, (1.0, 0.45, 0.0), (0.0, 0.75, 0.3))
"""Isolines have the first of these that stands out from every colour of a map."""

RIM_OPACITY, RIM = 0.6, 0.8
"""Of the rim beside isolines of signed fields, and its width on each side in pixels at scale 1."""

CASING = 1.2
"""Pixels, at scale 1, of the dark rim on each side of an isoline through a point."""

COLOURED = 1.4
"""Times the usual width that isolines have whose colour is to be read."""

STANDS_OUT = 0.12
"""Distances in Oklab from which on a line is seen well."""


@dataclass(frozen=True)
class IsolineInk:
    """The colour of an isoline and, if it has one, of the rim on each side, so wide in pixels at scale 1; the line is
    `width` times as wide as usual."""

    colour: RGBA
    rim: RGBA | None = None
    rim_width: float = 0.0
    width: float = 1.0


@dataclass(frozen=True)
class Style:
    """A look: colours are RGB from 0 to 1, widths in pixels at scale 1, which are 1/96 of an inch.

    Attributes
    ----------
    outline
        Width of the line around the shape and along its folds; 0 for none.
    feature_edges
        Whether there are thin lines along sharp edges.
    shading
        Whether surfaces are lit; if not, colours are drawn as they are.
    coloured
        Whether surfaces are coloured; if not, isolines alone show the field.
    base_light, base_dark
        The greys of a base.
    plain
        Colour of a surface that is meant to have no field.
    back
        Colour of the inside of a surface.
    edge, edge_on_dark
        Colours of mesh edges on light and on dark colours.
    signed_isoline
        Colour of the isoline at 0 of a signed field; see `isoline_ink`.
    section
        Colour of the line where a clip plane cuts a surface.
    bands
        Whether there is one colour from each isoline to the next.
    occlusion
        Fraction of its colours that a surface loses where no light arrives.
    rim
        How much lighter surfaces are where they turn away.
    """

    stops: Stops
    background: Colour = (1, 1, 1)
    text: Colour = (0.13, 0.14, 0.16)
    quiet_text: Colour = (0.45, 0.47, 0.5)
    isoline: Colour = (1, 1, 1)
    isoline_width: float = 1.5
    outline: float = 0.0
    outline_colour: Colour = (0, 0, 0)
    feature_edges: bool = False
    shading: bool = True
    coloured: bool = True
    base_light: Colour = (0.80, 0.80, 0.80)
    base_dark: Colour = (0.56, 0.56, 0.56)
    undefined: Colour = (0.72, 0.72, 0.7)
    plain: Colour = (0.66, 0.68, 0.70)
    back: Colour = (0.80, 0.74, 0.62)
    edge: Colour = (0.05, 0.06, 0.08)
    edge_on_dark: Colour = (0.62, 0.65, 0.70)
    source: Colour = (1.0, 0.86, 0.1)
    largest: Colour = (0.10, 0.72, 0.50)
    marker_size: float = 15.0
    mark_edge: Colour = (0.1, 0.1, 0.12)
    section: Colour = (0.1, 0.1, 0.12)
    diverging: Stops = colour_maps.DIVERGING
    signed_isoline: Colour = INK
    bands: bool = False
    occlusion: float = 0.0
    rim: float = 0.0

    def colours(self, count: int = 512, signed: bool = False) -> FloatArray:
        """Return the colour map (count, 3) from 0 to the maximum or, if signed, from -maximum to maximum."""
        return self.colours_at(np.linspace(-1 if signed else 0, 1, count), signed)

    def band_colours(self, edges: FloatArray, signed: bool = False) -> FloatArray:
        """Return the colours (k + 1, 3) of bands that end at fractions (k,) of the maximum, each that of its middle."""
        ends = np.concatenate([[-1.0 if signed else 0.0], edges, [1.0]])
        return self.colours_at((ends[1:] + ends[:-1]) / 2, signed)

    def colours_at(self, shares: FloatArray, signed: bool = False) -> FloatArray:
        """Return the colours (k, 3) at fractions (k,) of the maximum, 0 to 1, or -1 to 1 if signed."""
        return colours_at(self.diverging if signed else self.stops, shares)

    def value_colours(self, values: FloatArray, top: float, signed: bool = False) -> FloatArray:
        """Return the colours (k, 3) of values (k,), where colours end at `top`; what is undefined is grey."""
        is_defined = np.isfinite(values)
        shares = np.clip(values[is_defined] / top, -1 if signed else 0, 1) if top > 0 else np.zeros(is_defined.sum())
        colours = np.tile(self.undefined, (len(values), 1))
        colours[is_defined] = self.colours_at(shares, signed)
        return colours

    def bin_colours(self, ends: FloatArray, top: float, signed: bool = False) -> FloatArray:
        """Return the colours (b, 3) of the middles of bins with ends (b + 1,), where colours end at `top`."""
        return self.value_colours((ends[1:] + ends[:-1]) / 2, top, signed)

    def vertex_colours(self, field: FloatArray, top: float, signed: bool = False) -> ByteArray:
        """Return the colours (n, 3) uint8 of values (n,), where colours end at `top`; what is undefined is grey."""
        rounded: ByteArray = np.rint(255 * self.value_colours(field, top, signed)).astype(np.uint8)
        return rounded

    def named(self, name: str) -> Colour:
        """Return a colour such as "#1F7A3D", "white", or that of one of the fields, such as "source"."""
        if name.startswith("#"):
            red, green, blue = (int(name[k : k + 2], 16) / 255 for k in (1, 3, 5))
            return red, green, blue
        return WHITE if name == "white" else getattr(self, name)

    def named_for(self, own: str) -> Callable[[str], Colour]:
        """Return `named` for a mark whose own colour is meant by "own"."""
        return lambda name: self.named(own if name == "own" else name)

    def isoline_ink(
        self,
        signed: bool = False,
        value: float = 1.0,
        is_through: bool = False,
        on_base: bool = False,
        share: float | None = None,
    ) -> IsolineInk:
        """Return the colours of an isoline; of its value it only matters whether it is 0.

        Isolines have one colour in all panels, but for that at 0 of a signed field and those through points.  On a
        signed field, which is light in its middle, and on a base they have a faint rim.  With a `share` of the maximum
        they have the colour of the map there.
        """
        if is_through:
            return IsolineInk(opaque(self.source), opaque(self.mark_edge), CASING)
        if share is not None and self.coloured and not (signed and value == 0):
            colour = self.colours_at(np.clip([share], -1, 1), signed)[0]
            return IsolineInk(opaque(tuple(colour.tolist())), opaque(INK, RIM_OPACITY), RIM, COLOURED)
        if not (signed or on_base) or (signed and value == 0):
            return IsolineInk(opaque(self.signed_isoline if signed else self.isoline))
        if not self.coloured:
            return IsolineInk(opaque(self.isoline))
        rim = opaque(INK if sum(self.isoline) > 1.5 else WHITE, RIM_OPACITY)
        return IsolineInk(opaque(self.isoline), rim, RIM)


CURVES = ("#0A7358", "#B45309", "#6D4AC7", "#1D2125", "#8A3A78", "#5F6B00")
CURVES_ON_DARK = ("#52CFA6", "#F0A45A", "#B79CFF", "#E8EAED", "#E59BD3", "#C9CC5A")
"""The colours of curves in charts, in the order of panels, on light and on dark grounds."""

PINS = (
    "#1F7A3D",
    "#A84A00",
    "#6B3FC0",
    "#6B6400",
    "#8A3A78",
    "#4A5560",
    "#7A4B1E",
    "#00696B",
    "#3F4FA8",
    "#99621E",
)
"""The colours of pins and selections, `MARK_COLOURS` of them; white numerals on them have a contrast of 5 : 1."""

WAITING = "#14161A"
"""The colour of a pair of points that is not whole yet."""

PAPER = Style(stops=colour_maps.PAPER)
"""The paper's look: dark blue near, through cyan, grey and pink, to dark red far; white isolines."""

UNIFORM = Style(stops=colour_maps.UNIFORM)
"""Equal steps of distance look equally large, also with colour-vision deficiencies and printed in grey."""

LINES = Style(
    stops=((0.0, (1, 1, 1)), (1.0, (1, 1, 1))),
    isoline=(0, 0, 0),
    isoline_width=1.1,
    outline=1.6,
    shading=False,
    coloured=False,
    diverging=((-1.0, (1, 1, 1)), (1.0, (1, 1, 1))),
    signed_isoline=(0, 0, 0),
    largest=(1, 1, 1),
    text=(0, 0, 0),
    quiet_text=(0.25, 0.25, 0.25),
    undefined=(0.86, 0.86, 0.86),
    plain=(0.86, 0.86, 0.86),
    back=(0.93, 0.93, 0.93),
    edge=(0.55, 0.55, 0.55),
    source=(0, 0, 0),
    mark_edge=(0, 0, 0),
    section=(0, 0, 0),
    marker_size=9.0,
)
"""Isolines and outlines only, for black-and-white print."""

DARK = Style(
    stops=colour_maps.PAPER_ON_DARK,
    background=(0.07, 0.08, 0.10),
    text=(0.93, 0.94, 0.95),
    quiet_text=(0.66, 0.68, 0.71),
    undefined=(0.45, 0.45, 0.45),
    back=(0.42, 0.38, 0.30),
    mark_edge=(0.05, 0.05, 0.06),
    section=(0.93, 0.94, 0.95),
)
"""For slides: the paper's colours with lighter ends, which stay visible on a dark background."""

COVER = Style(
    stops=colour_maps.PAPER,
    outline=0.8,
    outline_colour=(0.12, 0.13, 0.16),
    feature_edges=True,
    isoline_width=1.2,
    occlusion=0.7,
    rim=0.25,
)
"""For covers: the paper's colours in light from all round, with soft shadows and thin outlines."""

STYLES = {"paper": PAPER, "uniform": UNIFORM, "lines": LINES, "dark": DARK, "cover": COVER}
"""The words of the command line and of recipes."""


def curve_colours(style: Style) -> tuple[str, ...]:
    """Return the colours of curves that go with a style's ground."""
    return CURVES if sum(style.background) > 1.5 else CURVES_ON_DARK


def style_of(word: str, colours: Colours = OF_THE_STYLE) -> Style:
    """Return a style with the colours that a document names; raise ParameterError for an unknown style or map.

    The style of lines only has no colours, and stays as it is.
    """
    if word not in STYLES:
        raise ParameterError(f"There is no style {word!r}; choose one of {', '.join(STYLES)}.")
    style, stops = STYLES[word], map_of(colours)
    if not style.coloured:
        return style
    if word == "dark" and stops and not colours.stops:
        # Ends that are seen on a dark ground; the paper's map has those of the style.
        stops = style.stops if colours.map == "paper" else lightened(stops)
    if stops:
        style = replace(style, stops=stops, isoline=line_on(stops))
    if colours.stops and goes_both_ways(colours.stops):
        style = _with_diverging(style, tuple((2 * place - 1, colour) for place, colour in colours.stops))
    if colours.reversed:
        style = replace(style, stops=backwards(style.stops), diverging=backwards(style.diverging))
    return replace(style, bands=colours.bands)


def map_of(colours: Colours) -> Stops:
    """Return the map that colours name, empty for that of the style; ParameterError if there is none."""
    if colours.stops or not colours.map:
        return colours.stops
    if colours.map not in MAPS:
        raise ParameterError(f"There is no colour map {colours.map!r}; choose one of {', '.join(MAPS)}, or a file.")
    return MAPS[colours.map].stops


def line_on(stops: Stops) -> Colour:
    """Return the colour of isolines that stands out from all of a map's colours, or the best if none does."""
    ground = oklab(colours_at(stops, np.linspace(0, 1, 256)))
    apart = [np.linalg.norm(ground - oklab(np.array([line])), axis=1).min() for line in LINES_ON_COLOURS]
    return LINES_ON_COLOURS[next((k for k, far in enumerate(apart) if far > STANDS_OUT), int(np.argmax(apart)))]


def _with_diverging(style: Style, stops: Stops) -> Style:
    """Return the style with another map for signed fields, and a line at 0 that stands out from its middle."""
    is_light = oklab(colours_at(stops, np.zeros(1)))[0, 0] > MIDDLE
    return replace(style, diverging=stops, signed_isoline=INK if is_light else WHITE)


MIDDLE = 0.6
"""The lightness in Oklab from which on dark lines are seen better than white ones."""
