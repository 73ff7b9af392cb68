"""Bands of one colour each: they begin and end at the isolines, from one end of the colour bar to the other."""

import numpy as np

from bihdist_core.arrays import AnyArray, FloatArray

from ..document.looks import Isolines
from ..drawing.colour_bar import BarColours
from .levels import levels
from .style import Colour, Style

BAR_STEPS = 256
"""Parts of a colour bar that has no bands."""


def band_edges(isolines: Isolines, maximum: float, signed: bool = False) -> FloatArray:
    """Return the fractions (k,) of the maximum, from 0 or, if signed, -1 to 1, that have an isoline.

    There are none where more would be there than can be told apart.
    """
    if not maximum > 0:
        return np.empty(0)
    return levels(isolines, maximum, maximum, signed).values / maximum


def bar_colours(
    style: Style, edges: FloatArray, signed: bool = False, goes_beyond: tuple[bool, bool] = (False, False)
) -> BarColours:
    """Return the colours of a bar, in bands that end at `edges` (see `band_edges`) if the style has any."""
    if not (style.bands and len(edges)):
        return BarColours(_triples(style.colours(BAR_STEPS, signed)), (), goes_beyond)
    starts = 0.0, *((edges + 1) / 2 if signed else edges).tolist()
    return BarColours(_triples(style.band_colours(edges, signed)), starts, goes_beyond)


def _triples(colours: FloatArray) -> tuple[Colour, ...]:
    return tuple((r, g, b) for r, g, b in colours.tolist())


def beyond(field: AnyArray | None, top: float, signed: bool = False) -> tuple[bool, bool]:
    """Return whether a field (n,) goes beyond the ends of a colour bar: below 0 or, if signed, -top; and above top."""
    if field is None or not top > 0:
        return False, False
    end = top * (1 + 1e-6)  # by a hair it does not
    low = -end if signed else 0.0
    return bool(np.nanmin(field, initial=0.0) < low), bool(np.nanmax(field, initial=0.0) > end)
