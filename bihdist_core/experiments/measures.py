"""Measurements that several experiments share, with the thresholds that words like "insensitive" stand for."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..analysis import quality
from ..analysis.diagnostics import FieldChange, field_change, isotropy_ratio
from ..analysis.persistence import Extrema, extrema
from ..analysis.quality import small_radius
from ..applications.resizing import refined
from ..laplacian import Laplacian
from ..surface import Surface
from .result import Cell, Chart, Mark, Series
from .shapes import distance

INSENSITIVE = 0.05
"""A field is insensitive to a change if, divided by its maximum, it moves by at most this much in the mean."""
ISOTROPIC = 1.25
"""A field is isotropic near its source if the ratio of farthest to nearest direction is at most this."""
ELONGATED = 1.5
"""Its isolines are ellipses, not circles, from this ratio on."""
KINK = 0.5
"""An edge across which the gradient jumps by this share of its length is part of a kink."""
REFINED_UP_TO = 15_000
"""Vertices up to which isotropy is also measured on the refined mesh: exact geodesic distance there takes seconds."""
CIRCLES = np.arange(3, 13)
"""Radii of geodesic circles, in mean edge lengths, for the chart of isotropy."""

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


def other_minima(found: Extrema, source: int) -> np.ndarray:
    """(k,) the minima that are not the source."""
    return found.minima[found.minima != source]


def field_row(
    surface: Surface, name: str, source_name: str, source: int, distance: str, field: np.ndarray, geodesic: np.ndarray
) -> tuple[Cell, ...]:
    """One row under `FIELD_COLUMNS`: extrema, isotropy and kinks of a distance field (n,)."""
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
        float(relative.max(initial=0)),
    )


def inner_jumps(surface: Surface, field: np.ndarray, near: np.ndarray, radius: float | None = None) -> np.ndarray:
    """(k,) relative jumps of the gradient away from the source and the boundary (see `quality.inner_jumps`)."""
    return quality.inner_jumps(surface, field, near, radius).relative


def isotropy_chart(surface: Surface, source: int, kinds: Sequence[str], heading: str, quick: bool) -> Chart:
    """Isotropy ratio of distances on geodesic circles of growing radius around a source, on the refined mesh.

    Radii in roots of the area, from three edges of the mesh; quick, and on large meshes: of the mesh as it is.
    """
    fine = surface if quick or len(surface.vertices) > REFINED_UP_TO else refined(surface)
    laplacian = Laplacian(fine)
    exact = fine.is_manifold and len(fine.vertices) <= 4 * REFINED_UP_TO
    method = "exact" if exact else "heat"
    geodesic = distance(laplacian, f"geodesic method = {method}").from_source(source)
    unit = float(np.sqrt(surface.face_areas.sum()))
    radii = CIRCLES * fine.mean_edge_length
    series = []
    for kind in kinds:
        field = geodesic if kind == "geodesic" else distance(laplacian, kind).from_source(source)
        ratios = np.array([isotropy_ratio(fine, field, geodesic, float(r)) for r in radii])
        series.append(Series(kind, radii / unit, ratios))
    return Chart(heading, "radius of the circle over root of area", "isotropy ratio", tuple(series), log_y=True)


def shrinking(chart: Chart) -> str:
    """What becomes of the isotropy ratios from the largest to the smallest circle, in words."""
    x = chart.series[0].x
    said = ", ".join(f"{s.name} {s.y[-1]:.3g} to {s.y[0]:.3g}" for s in chart.series)
    return f"as the circle shrinks from {percent(x[-1])} to {percent(x[0])} of the root of the area: {said}"


def marks(surface: Surface, field: np.ndarray, source: int) -> tuple[Mark, ...]:
    """The source, and the extrema that a figure points at with arrows."""
    found = extrema(surface, field)
    return (
        Mark(int(source), "source"),
        *(Mark(int(v), "minimum") for v in other_minima(found, source)),
        *(Mark(int(v), "maximum") for v in found.maxima),
    )


def change_cells(change: FieldChange) -> tuple[float, ...]:
    """The cells under `CHANGE_COLUMNS`."""
    return change.mean, change.largest, change.normalised_mean, change.normalised_largest


def changes(before: Mapping[str, np.ndarray], after: Mapping[str, np.ndarray]) -> dict[str, FieldChange]:
    """How each field changed, by its name."""
    return {name: field_change(before[name], after[name]) for name in before}


def percent(value: float) -> str:
    """A share in words: three digits, in percent."""
    return f"{100 * value:.3g} %"


def span(values: list[float]) -> str:
    """The least and the greatest of several numbers, in words."""
    low, high = min(values), max(values)
    return f"{low:.3g}" if low == high else f"{low:.3g} to {high:.3g}"
