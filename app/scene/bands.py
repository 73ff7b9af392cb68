"""Bands of one colour each: they begin and end at the isolines, from one end of the colour bar to the other."""

import numpy as np

from bihdist_core.arrays import AnyArray, FloatArray

from ..document.looks import Isolines
from .levels import levels
from .style import Colour, Style

BAR_STEPS = 256
"""Parts of a colour bar that has no bands."""


def band_edges(isolines: Isolines, maximum: float, signed: bool = False) -> FloatArray:
    """(k,) fractions of the maximum, from 0 or, if signed, -1 to 1, that have an isoline.

    Empty where there are none, or more than can be told apart.
    """
    if not maximum > 0:
        return np.empty(0)
    return levels(isolines, maximum, maximum, signed).values / maximum


def bar_parts(style: Style, edges: FloatArray, signed: bool = False) -> list[tuple[float, Colour]]:
    """Where on a colour bar, 0 to 1, a colour begins, from the first to the last; edges: as `band_edges` has them."""
    if not (style.bands and len(edges)):
        starts = np.arange(BAR_STEPS) / BAR_STEPS
        colours = style.colours(BAR_STEPS, signed)
    else:
        places = (edges + 1) / 2 if signed else edges
        starts = np.append(0.0, places)
        colours = style.band_colours(edges, signed)
    return [(float(start), (float(r), float(g), float(b))) for start, (r, g, b) in zip(starts, colours, strict=True)]


def beyond(field: AnyArray | None, top: float, signed: bool = False) -> tuple[bool, bool]:
    """Whether a field (n,) goes beyond the ends of a colour bar: below 0 or, if signed, -top; and above top."""
    if field is None or not top > 0:
        return False, False
    end = top * (1 + 1e-6)  # by a hair it does not
    low = -end if signed else 0.0
    return bool(np.nanmin(field, initial=0.0) < low), bool(np.nanmax(field, initial=0.0) > end)
