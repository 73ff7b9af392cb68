"""Measurements that several experiments share."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..analysis import diagnostics
from ..analysis.circles import small_radius
from ..analysis.diagnostics import FieldChange, field_change, isotropy_ratio
from ..analysis.persistence import Extrema, extrema
from ..arrays import BoolArray, FloatArray, IntArray
from ..surface import Surface
from ._stated_figures import DEEP
from .result import Cell, Mark
from .verdicts import BySource

KINK = 0.5
"""An edge across which the gradient jumps by this share of its length is part of a kink."""
FIELD_COLUMNS = (
    "shape",
    "source",
    "distance",
    "minima besides the source",
    "deepest of them, % of range",
    "maxima",
    "raw minima",
    "raw maxima",
    "isotropy ratio",
    "edges in kinks, %",
    "largest jump",
)
CHANGE_COLUMNS = ("raw mean", "raw largest", "normalised mean", "normalised largest")


def other_minima(found: Extrema, source: int) -> IntArray:
    """Return (k,) the minima that are not the source."""
    minima: IntArray = found.minima[found.minima != source]
    return minima


def field_row(
    surface: Surface, name: str, source_name: str, source: int, distance: str, field: FloatArray, geodesic: FloatArray
) -> tuple[Cell, ...]:
    """Return a row under `FIELD_COLUMNS`: extrema, isotropy and kinks of a distance field (n,)."""
    found = extrema(surface, field)
    relative = inner_jumps(surface, field, geodesic)
    deepest = found.minima_persistence[found.minima != source]
    return (
        name,
        source_name,
        distance,
        len(deepest),
        100 * float(deepest[0] / np.nanmax(field)) if len(deepest) else None,
        len(found.maxima),
        found.raw_minima,
        found.raw_maxima,
        isotropy_ratio(surface, field, geodesic, small_radius(surface)),
        100 * float((relative >= KINK).sum()) / max(1, len(relative)),
        largest_jump(surface, field, geodesic),
    )


def inner_jumps(surface: Surface, field: FloatArray, near: FloatArray, radius: float | None = None) -> FloatArray:
    """Return (k,) relative jumps of the gradient away from the source and the boundary."""
    return diagnostics.inner_jumps(surface, field, near, radius).relative


def largest_jump(surface: Surface, field: FloatArray, near: FloatArray, radius: float | None = None) -> float:
    """Return the largest jump of the gradient where `near` (n,) exceeds a radius, the small one by default."""
    return diagnostics.kinks(surface, field, near, radius).largest


def deepest_minimum(surface: Surface, field: FloatArray, source: int, among: BoolArray | None = None) -> float:
    """Return the depth of the deepest minimum but the source, as a fraction of the range; 0 if there is none.

    Minima of the field (n,) are looked for where `among` (n,) is True.
    """
    found = extrema(surface, field)
    counted = found.minima != source
    if among is not None:
        counted &= among[found.minima]
    return float(found.minima_persistence[counted].max(initial=0) / np.nanmax(field))


def kinked_edges(surface: Surface, field: FloatArray, geodesic: FloatArray) -> tuple[float, IntArray]:
    """Return the share of edges in kinks away from the source, and (k, 2) these edges."""
    jumps = diagnostics.inner_jumps(surface, field, geodesic)
    kinked = jumps.relative >= KINK
    return float(kinked.mean()) if len(kinked) else 0.0, jumps.edges[kinked]


def over(one: float, other: float) -> float:
    """Divide one number by another; NaN where both vanish, which tells nothing."""
    return one / other if other > 0 else (np.inf if one > 0 else np.nan)


def marks(surface: Surface, field: FloatArray, source: int) -> tuple[Mark, ...]:
    """Return the source, and the extrema that a figure points at with arrows."""
    found = extrema(surface, field, DEEP)
    return (
        Mark(int(source), "source"),
        *(Mark(int(v), "minimum") for v in other_minima(found, source)),
        *(Mark(int(v), "maximum") for v in found.maxima),
    )


def change_cells(change: FieldChange) -> tuple[float, ...]:
    """Return the cells under `CHANGE_COLUMNS`."""
    return change.mean, change.largest, change.normalised_mean, change.normalised_largest


def changes(before: Mapping[str, FloatArray], after: Mapping[str, FloatArray]) -> dict[str, FieldChange]:
    """Measure the change of each field, by its name."""
    return {name: field_change(before[name], after[name]) for name in before}


def by_source(numbers: Sequence[float], pictured: int = 1) -> BySource:
    """Group numbers of which the first belong to the pictured sources."""
    return BySource(tuple(numbers[:pictured]), tuple(numbers[pictured:]))


def percent(value: float) -> str:
    """Return a share in words: three digits, in percent."""
    return f"{100 * value:.3g} %"
