"""The claim of section 5.1 that biharmonic distance can be approximated by sub-sampling, geodesic distance less well.

What is sampled is the field: it is known at a few hundred points of the surface and interpolated to all others.
"""

from collections.abc import Callable

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import SolverError
from ..laplacian import Laplacian
from ..progress import Progress
from .measures import by_source, percent
from .parts import Parts
from .result import Cell, Chart, Claim, Findings, Series, Table
from .sampled_fields import PiecewiseLinear, Smoothest
from .shapes import DISTANCES, STARTS, UPPER_BACK, Shapes, distance, spread_points
from .verdicts import Numbers, exponent

COUNTS, QUICK_COUNTS = (100, 150, 200, 300, 500), (100, 300)
"""Points that the fields are sampled at."""
JUDGED = 300
"""A few hundred."""
SOURCES, QUICK_SOURCES = STARTS, 7
SMOOTHEST, LINEAR = "smoothest", "piecewise linear"


def sampling(shapes: Shapes, name: str, quick: bool, parts: Parts, progress: Progress) -> Findings:
    """Measure errors at all vertices of interpolated fields, from the pictured source and from 24 others (quick: 6)."""
    surface = shapes[name]
    component, ids = surface.component(0)
    laplacian = shapes.laplacian(name) if len(ids) == len(surface.vertices) else Laplacian(component)
    pictured = int(np.searchsorted(ids, shapes.vertex_at(surface, *UPPER_BACK, "back")))
    counts = sorted({min(count, len(ids) // 3) for count in (QUICK_COUNTS if quick else COUNTS)})
    judged = min(counts, key=lambda count: abs(count - JUDGED))
    # The sources are samples, so that the cones of all fields are where something is known.
    points = spread_points(component, counts[-1], pictured)
    chosen = np.random.default_rng(0).permutation(np.arange(1, counts[0]))
    sources = points[np.append(0, chosen[: (QUICK_SOURCES if quick else SOURCES) - 1])]
    fields = {}
    for k, kind in enumerate(DISTANCES):
        progress(0.2 * k, f"fields to be sampled, {kind}")
        columns_of = parts.do(f"{kind} to be sampled", _columns, laplacian, kind, sources)
        if columns_of is not None:
            fields[kind] = columns_of
    if "biharmonic" not in fields:
        raise SolverError(parts.why("biharmonic to be sampled"))
    rows: list[tuple[Cell, ...]] = []
    means: dict[tuple[str, str, int], FloatArray] = {}
    for q, count in enumerate(counts):
        progress(0.6 + 0.4 * q / len(counts), f"fields from {count} points")
        known = points[:count]
        interpolants: dict[str, Callable[[FloatArray], FloatArray]] = {
            SMOOTHEST: Smoothest(laplacian.components[0], known),
            LINEAR: PiecewiseLinear(component, known),
        }
        for how, interpolant in interpolants.items():
            for kind, field in fields.items():
                error = np.abs(interpolant(field[known]) - field) / field.max(axis=0)
                means[how, kind, count] = mean = error.mean(axis=0)
                spread = mean.mean(), mean.min(), mean.max(), error.max(axis=0).mean()
                rows.append((count, how, kind, *(float(x) for x in spread)))
    columns = ("points", "interpolant", "distance", "mean error", "least", "most", "largest error, mean")
    table = Table("sub-sampling", columns, tuple(rows))
    tables = [table, _orders(means, counts)] if len(counts) > 1 else [table]
    claim = _claim(means, judged, list(fields), parts.why("geodesic to be sampled"))
    return Findings(charts=_charts(means, counts), tables=tables, claims=[claim])


def _columns(laplacian: Laplacian, kind: str, sources: IntArray) -> FloatArray:
    return distance(laplacian, kind).from_sources(sources)


def _claim(means: dict[tuple[str, str, int], FloatArray], judged: int, kinds: list[str], failure: str) -> Claim:
    """Make the claim; `failure` says why there is no geodesic distance."""

    def ratio(how: str) -> list[float]:
        return list(means[how, "geodesic", judged] / means[how, "biharmonic", judged])

    said = "; ".join(
        f"{how}: " + ", ".join(f"{kind} {percent(float(means[how, kind, judged].mean()))}" for kind in kinds)
        for how in (SMOOTHEST, LINEAR)
    )
    numbers: dict[str, Numbers] = {
        "mean error, biharmonic, smoothest interpolant": by_source(list(means[SMOOTHEST, "biharmonic", judged]))
    }
    if "geodesic" in kinds:
        for how in (SMOOTHEST, LINEAR):
            numbers[f"mean error, geodesic over biharmonic, {how} interpolant"] = by_source(ratio(how))
    return Claim(
        "claims-sampling",
        numbers,
        f"Mean errors from {judged} points, over all sources, of the maximum: {said}. The smoothest "
        "interpolant minimises the sum of (Lf)²/area over the mesh (biharmonic interpolation). It favours smooth "
        "fields, and biharmonic distance above all, whose Green's function it is made of; the piecewise linear one, on "
        "the flat triangles between the points, favours none.",
        failure=failure,
    )


def _kinds(means: dict[tuple[str, str, int], FloatArray]) -> list[str]:
    return list(dict.fromkeys(kind for _, kind, _ in means))


def _orders(means: dict[tuple[str, str, int], FloatArray], counts: list[int]) -> Table:
    """Return the order of approximation: with k points their spacing is about k^(-1/2)."""
    rows: list[tuple[Cell, ...]] = []
    for how in (SMOOTHEST, LINEAR):
        for kind in _kinds(means):
            error = [float(means[how, kind, count].mean()) for count in counts]
            order = exponent(np.array(counts) ** -0.5, error)
            rows.append((how, kind, order))
    return Table(
        "order of the mean error in the points' spacing",
        ("interpolant", "distance", "order"),
        tuple(rows),
    )


def _charts(means: dict[tuple[str, str, int], FloatArray], counts: list[int]) -> list[Chart]:
    if len(counts) < 2:
        return []
    return [
        Chart(
            f"sub-sampling, {how} interpolant",
            "points",
            "mean error over the maximum",
            tuple(
                Series(kind, np.array(counts), np.array([float(means[how, kind, count].mean()) for count in counts]))
                for kind in _kinds(means)
            ),
            log_x=True,
            log_y=True,
        )
        for how in (SMOOTHEST, LINEAR)
    ]
