"""Figure 10: point-to-point maps between two poses from three landmark correspondences, by three distances.

The paper: "geodesic distance produces bad predictions far from the known correspondences, and diffusion distance
produces unintuitive result for small not-centered areas like the head"; with biharmonic distance the matches are good.
"""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from scipy.spatial import cKDTree

from ..applications.correspondence import Correspondence, correspondence_prediction
from ..arrays import BoolArray, FloatArray, IntArray
from ..distances.distance import Distance
from ..distances.edge_geodesic import EdgeGeodesic
from ..progress import Progress, part
from ..surface import Surface
from .measures import percent
from .result import Cell, Chart, Claim, Mark, Panel, Result, Series, Table
from .shapes import DISTANCES, Shapes, distance, spread_points, starts
from .verdicts import Estimate, mean_estimate

TITLE = "Correspondences from landmarks"
TARGETS, ON_HEAD = 200, 50
"""Random points that are matched, on the whole surface and on the head."""
HEAD = 1 / 8
"""The head is the highest share of the figure."""
QUICK_STARTS = 12
"""Starts of the quick version."""
NEAR, CLUSTER = 0.15, 0.25
"""Distances along edges, in roots of the area: of the near target from a landmark, and how far clustered landmarks lie
apart."""
LAYOUTS = ("spread", "clustered")
BLOCK = 8
CUT = 0.25
"""PCK curves, the share of targets matched within an error, end at this error, in roots of the area."""
COLUMNS = (
    *("median", "90 %", "median, mirror image wrong", "90 %, mirror image wrong", "median, far", "median, head"),
    f"AUC of the PCK curve to {CUT:g}",
)


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Match 200 random points (quick: 50) by spread and clustered landmarks, 25 starts each (quick: 12)."""
    seeds = starts(QUICK_STARTS) if quick else starts()
    one, two = shapes["figure"], shapes["figure_pose2"]
    first, second = shapes.laplacian("figure"), shapes.laplacian("figure_pose2")
    distances = {kind: (distance(first, kind), distance(second, kind)) for kind in DISTANCES}
    targets, on_head = _targets(one, quick)
    part(progress, 0, 1)(0.05, "distances from the right answers")
    off, either = _from_the_right(shapes, targets, part(progress, 0.05, 0.3))
    known = {
        (layout, start): spread_points(one, 3, start) if layout == "spread" else _clustered(one, start)
        for start in seeds
        for layout in LAYOUTS
    }
    every = np.unique(np.concatenate(list(known.values())))
    away = EdgeGeodesic(one).distances(every)[targets]
    rows: list[tuple[Cell, ...]] = []
    pooled: dict[tuple[str, str], list[FloatArray]] = {}
    for k, (kind, pair) in enumerate(distances.items()):
        all_known = _all_known(pair, every, part(progress, 0.3 + 0.2 * k, 0.5 + 0.2 * k))
        for (layout, start), points in known.items():
            candidates = all_known.changed(np.stack([points, points], 1)).map(targets)
            error, wrong = (values[candidates, np.arange(len(targets))] for values in (either, off))
            nearest = away[:, np.searchsorted(every, points)].min(axis=1)
            far = nearest > np.median(nearest[~on_head])
            whole = ~on_head
            numbers = [*np.quantile(error[whole], [0.5, 0.9]), *np.quantile(wrong[whole], [0.5, 0.9])]
            numbers += [np.median(error[whole & far]), np.median(error[on_head])]
            # The area under a PCK curve, over its cut, is the mean of what errors leave of the cut.
            numbers += [np.clip(1 - error[whole] / CUT, 0, 1).mean()]
            pooled.setdefault((layout, kind), []).append(error[whole])
            rows.append((layout, start, kind, *(float(x) for x in numbers)))
    table = Table("errors", ("landmarks", "start", "distance", *COLUMNS), tuple(rows))
    means = Table("mean errors", ("landmarks", "distance", "error", "mean", "low", "high"), tuple(_means(table)))
    pictured = {kind: pair[0] for kind, pair in distances.items()}, {kind: pair[1] for kind, pair in distances.items()}
    return Result(
        "fig10",
        TITLE,
        "Landmark correspondences: three by farthest-point sampling from a start, over the surface or within a disc "
        f"around it; {len(seeds)} starts, vertex 0 (pictured) and random ones. {int((~on_head).sum())} random "
        "targets; far are those farther from all landmarks than the median target is. On the head, the highest "
        f"eighth of the figure, {int(on_head.sum())} more. The point-to-point map takes a target to the vertex of the "
        "least matching cost. Its error, in roots of the area, is the geodesic distance on the second pose from the "
        "right vertex; it is symmetry-aware, from that vertex or its mirror image, whichever is nearer, as a "
        "distance cannot tell left from right. Vectors of distances to the landmarks are divided by their maximum. "
        f"The PCK curve is the share of targets matched within an error, over all starts, and ends at {CUT:g}; AUC is "
        "the mean of the curve. Differences of the starts' median errors are paired, with intervals by resampling "
        "the starts.",
        {"figure": one, "figure_pose2": two},
        tuple(_pictures(one, known["spread", "vertex 0"], *pictured)),
        charts=tuple(_pck(layout, pooled) for layout in LAYOUTS),
        tables=(means, table),
        claims=_claims(table),
    )


def _pck(layout: str, pooled: Mapping[tuple[str, str], list[FloatArray]]) -> Chart:
    """Return the PCK curves of the distances, over all starts."""
    radii = np.linspace(0, CUT, 101)
    curves = (
        Series(kind, radii, (np.concatenate(pooled[layout, kind]) <= radii[:, None]).mean(axis=1)) for kind in DISTANCES
    )
    return Chart(f"PCK, landmarks {layout}", "error over root of area", "share of targets", tuple(curves))


def _targets(surface: Surface, quick: bool) -> tuple[IntArray, BoolArray]:
    """Return (k,) random vertices, and (k,) whether they are those on the head."""
    y, rng = surface.vertices[:, 1], np.random.default_rng(0)
    head = np.flatnonzero(y >= y.max() - HEAD * np.ptp(y))
    everywhere = rng.choice(len(y), TARGETS // 4 if quick else TARGETS, replace=False)
    there = rng.choice(head, min(ON_HEAD, len(head)), replace=False)
    return np.concatenate([everywhere, there]), np.arange(len(everywhere) + len(there)) >= len(everywhere)


def _from_the_right(shapes: Shapes, targets: IntArray, progress: Progress) -> tuple[FloatArray, FloatArray]:
    """Return (n, k) distances on the second pose from the targets, and from these or their mirror images.

    Root of area.
    """
    unit = float(np.sqrt(shapes["figure_pose2"].face_areas.sum()))
    truth = distance(shapes.laplacian("figure_pose2"), "geodesic")
    off = truth.from_sources(targets, part(progress, 0, 0.5)) / unit
    mirrored = truth.from_sources(_mirror(shapes["figure"])[targets], part(progress, 0.5, 1)) / unit
    return off, np.minimum(off, mirrored)


def _all_known(pair: tuple[Distance, Distance], points: IntArray, progress: Progress) -> Correspondence:
    """Return the correspondence of all points, each of which keeps its distances; the two surfaces side by side."""
    columns: tuple[dict[int, FloatArray], dict[int, FloatArray]] = ({}, {})
    with ThreadPoolExecutor(2) as lanes:
        for start in range(0, len(points), BLOCK):
            progress(start / len(points), f"distances from landmarks, {pair[0].label}")
            some = points[start : start + BLOCK]
            for known, fields in zip(columns, lanes.map(lambda d, some=some: d.from_sources(some), pair), strict=True):
                known.update(zip(some.tolist(), np.ascontiguousarray(fields.T), strict=True))
    return Correspondence(*pair, np.stack([points, points], 1), known_columns=columns)


def _paired(table: Table, layout: str, kind: str, column: str) -> Estimate:
    """Return by how much more than biharmonic distance another one errs, over the starts."""
    own, other = (np.array(table.values(column, landmarks=layout, distance=k), float) for k in ("biharmonic", kind))
    return mean_estimate(other - own)


def _means(table: Table) -> list[tuple[Cell, ...]]:
    rows: list[tuple[Cell, ...]] = []
    for layout in LAYOUTS:
        for kind in DISTANCES:
            for column in COLUMNS:
                found = mean_estimate(np.array(table.values(column, landmarks=layout, distance=kind), float))
                rows.append((layout, kind, column, found.value, found.low, found.high))
    return rows


def _claims(table: Table) -> tuple[Claim, ...]:
    def means_of(layout: str, column: str) -> str:
        means = (np.mean(np.array(table.values(column, landmarks=layout, distance=k), float)) for k in DISTANCES)
        return ", ".join(f"{kind} {percent(float(mean))}" for kind, mean in zip(DISTANCES, means, strict=True))

    better = [
        Claim(
            f"fig10-{k}",
            {
                f"median error more than biharmonic's, {kind}": _paired(table, layout, kind, "median")
                for kind in DISTANCES[1:]
            },
            f"Mean over the starts of the median error, in roots of the area: {means_of(layout, 'median')}; of the "
            f"error that 90 % of the targets are within: {means_of(layout, '90 %')}; with mirror images counted as "
            f"wrong the medians are {means_of(layout, 'median, mirror image wrong')}.",
        )
        for k, layout in enumerate(LAYOUTS, 1)
    ]
    words = {"fig10-3": ("far from the landmarks", "geodesic", "far"), "fig10-4": ("on the head", DISTANCES[2], "head")}
    for id, (where, kind, column) in words.items():
        name = f"median error {where} more than biharmonic's, {kind}, landmarks"
        numbers: Mapping[str, Estimate] = {
            f"{name} {layout}": _paired(table, layout, kind, f"median, {column}") for layout in LAYOUTS
        }
        means = "; ".join(f"landmarks {layout}: {means_of(layout, f'median, {column}')}" for layout in LAYOUTS)
        better.append(Claim(id, numbers, f"Mean over the starts of the median error {where}, {means}."))
    return tuple(better)


def _pictures(
    one: Surface, known: IntArray, on_one: Mapping[str, Distance], on_two: Mapping[str, Distance]
) -> list[Panel]:
    lengths = EdgeGeodesic(one).distances(known).min(axis=1)
    unit = float(np.sqrt(one.face_areas.sum()))
    targets = {"near": int(np.abs(lengths - NEAR * unit).argmin()), "far": int(lengths.argmax())}
    anchors = tuple(Mark(int(v), "anchor") for v in known)
    panels = []
    pairs, both = np.stack([known, known], 1), list(targets.values())
    fields = {kind: correspondence_prediction(on_one[kind], on_two[kind], pairs, both) for kind in on_one}
    for k, (row, x) in enumerate(targets.items()):
        marks = (*anchors, Mark(x, "target"))
        panels.append(Panel("landmarks and the point to match", "figure", None, row, marks, ("back", "front")))
        for kind in on_one:
            field = fields[kind][:, k]
            marks = (*anchors, Mark(x, "place"), Mark(int(field.argmin()), "candidate"))
            panels.append(Panel(kind, "figure_pose2", field, row, marks, ("back", "front"), exaggerate=0.5))
    return panels


def _clustered(surface: Surface, seed: str) -> IntArray:
    """Return (3,) vertices spread within a disc around the start."""
    lengths = EdgeGeodesic(surface)
    points = spread_points(surface, 1, seed)
    nearest = lengths.distances(points[0])
    disc = nearest <= CLUSTER * float(np.sqrt(surface.face_areas.sum()))
    for _ in range(2):
        points = np.append(points, np.argmax(np.where(disc, nearest, -1)))
        nearest = np.minimum(nearest, lengths.distances(points[-1]))
    return points


def _mirror(surface: Surface) -> IntArray:
    """Return (n,) for each vertex the one nearest to its mirror image, left and right exchanged."""
    x = surface.vertices
    image = x * [-1, 1, 1] + [x[:, 0].min() + x[:, 0].max(), 0, 0]
    nearest: IntArray = cKDTree(x).query(image)[1]
    return nearest
