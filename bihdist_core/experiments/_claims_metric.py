"""Claims of section 4: the axioms of a metric."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..analysis.diagnostics import smallest_distance, triangle_violations
from ..arrays import FloatArray, IntArray
from ..distances.diffusion import EigenpairDiffusion
from ..distances.distance import Distance
from ..distances.edge_geodesic import EdgeGeodesic
from ..laplacian import Component, Laplacian
from ..progress import Progress, part
from ..sources.source import SurfacePoint
from ..surface import Surface
from ._stated_claims import ROUNDING
from .parts import Parts
from .result import Cell, Claim, Findings, Table
from .shapes import Shapes, distance
from .verdicts import Estimate

CANDIDATES = 150
"""Pairs of vertices near whose images a double point is sought."""


@dataclass(frozen=True, eq=False)
class DoublePoint:
    """Two places in faces (2,), by barycentric weights (2, 3), far apart, and how far apart their images are.

    k functions map a surface into k dimensions. Into the plane no closed surface fits without falling on itself, and
    into three dimensions few do: then two different points have the same values, and their distance by these functions
    is 0.
    """

    faces: IntArray
    weights: FloatArray
    gap: float

    def values(self, surface: Surface, images: FloatArray) -> FloatArray:
        """Return (2, k) functions (n, k), linear in each face, at both places."""
        values: FloatArray = np.einsum("pc,pck->pk", self.weights, images[surface.faces[self.faces]])
        return values


def double_point(surface: Surface, images: FloatArray, along: FloatArray, apart: float) -> DoublePoint | None:
    """Find the two places with the nearest images (n, k), among faces near the likeliest pairs of vertices.

    The pair's distance on the surface, given `along` (n, n), must exceed `apart`. The images of two faces that meet in
    their planes, not in the faces, are no pair. Returns None if there is no pair.
    """
    square = np.einsum("ik,ik->i", images, images)
    gaps = square[:, None] + square - 2 * images @ images.T
    gaps[~(along > apart)] = np.inf
    order = np.argpartition(gaps, min(2 * CANDIDATES, gaps.size - 1), axis=None)[: 2 * CANDIDATES]
    i, j = np.unravel_index(order[np.isfinite(gaps.ravel()[order])], gaps.shape)
    around = [np.flatnonzero((surface.faces == v).any(axis=1)) for v in range(len(images))] if len(i) else []
    pairs = {(int(f), int(g)) for a, b in zip(i, j, strict=True) if a < b for f in around[a] for g in around[b]}
    best: DoublePoint | None = None
    if pairs:
        faces = np.array(sorted(pairs))
        weights = _meeting(images[surface.faces[faces[:, 0]]], images[surface.faces[faces[:, 1]]])
        inside = (weights >= 0).all(axis=(1, 2))
        for pair, weight in zip(faces[inside], weights[inside], strict=True):
            one, two = DoublePoint(pair, weight, np.inf).values(surface, images)
            gap = float(np.linalg.norm(one - two))
            if best is None or gap < best.gap:
                best = DoublePoint(pair, weight, gap)
    return best


def _meeting(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return (m, 2, 3) weights of the nearest places in the planes of triangles (m, 3, k) each, as near the middles as
    can be.

    With the sides u of a and v of b: a0 + u s = b0 + v t, four unknowns and k equations.
    """
    middle = a.mean(axis=1) - b.mean(axis=1)
    sides = np.concatenate([a[:, 1:] - a[:, :1], b[:, :1] - b[:, 1:]], axis=1)
    steps = np.einsum("mij,mj->mi", np.linalg.pinv(sides.transpose(0, 2, 1)), -middle)
    shares = steps.reshape(-1, 2, 2) + 1 / 3
    return np.concatenate([1 - shares.sum(axis=2, keepdims=True), shares], axis=2)


AXIOMS, DOUBLES = "metric axioms", "two points that few eigenpairs confuse"
"""What may be done or not, each for itself; the axioms for each distance."""
FEW = (2, 3, 4, 5)
"""The first few eigenpairs of a truncated diffusion distance."""
APART = (1.0, 0.5, 0.25)
"""Different points are so far apart along edges, in roots of the area; the farthest are sought first."""


def metric(shapes: Shapes, name: str, quick: bool, parts: Parts, progress: Progress) -> Findings:
    """Check the triangle inequality over random triples, and find the smallest distance of different points."""
    count, among, all_pairs = (100_000, 300, 800) if quick else (1_000_000, 1_500, 2_500)
    surface = shapes.at_most(name, all_pairs, part(progress, 0, 0.1))
    laplacian = Laplacian(surface)
    n = len(surface.vertices)
    points = np.random.default_rng(0).choice(n, min(among, n), replace=False)
    had = partial(distance, laplacian)
    distances: dict[str, Callable[[], Distance]] = {
        "biharmonic": partial(had, "biharmonic"),
        "geodesic along edges": partial(had, "geodesic method = dijkstra"),
        "diffusion t = 1": partial(had, "diffusion t = 1"),
        "diffusion t = 4": partial(had, "diffusion t = 4"),
        f"diffusion t = 1, {FEW[-1]} eigenpairs": partial(_Truncated, laplacian, 1, FEW[-1]),
        "biharmonic, 200 eigenpairs": partial(had, "truncated"),
    }
    rows: dict[str, tuple[Cell, ...]] = {}
    for k, (label, made) in enumerate(distances.items()):
        step = part(progress, 0.1 + 0.8 * k / len(distances), 0.1 + 0.8 * (k + 1) / len(distances))
        row = parts.do(f"{AXIOMS}, {label}", _checked, label, made, points, count, step)
        if row is not None:
            rows[label] = row
    columns = ("distance", "triples", "violations", "worst violation", "smallest distance")
    table = Table("metric", columns, tuple(rows.values()))
    broken = sum(int(row[2] or 0) for row in rows.values())
    doubles = parts.do(DOUBLES, _doubles, laplacian, part(progress, 0.9, 1))
    why = parts.why(f"{AXIOMS}, biharmonic")
    triangle, identity = Claim("claims-triangle", failure=why), Claim("claims-identity", failure=why)
    if "biharmonic" in rows:
        violations, least = rows["biharmonic"][2], rows["biharmonic"][4]
        triangle = Claim(
            "claims-triangle", {"random triples that break it by more than rounding": Estimate(float(violations or 0))}
        )
        identity = Claim(
            "claims-identity",
            {"smallest distance of different vertices over the largest": Estimate(float(least or 0))},
        )
    truncated = Claim("claims-truncated", failure=parts.why(DOUBLES))
    if doubles is not None:
        truncated = _truncated_claim(
            doubles,
            f"The triangle inequality holds even so, with {broken} violations over all distances, as a sum over "
            "eigenpairs is a distance of points.",
        )
    tables = [each for each in (table, doubles) if each and each.rows]
    return Findings(tables=tables, claims=[triangle, identity, truncated])


def _checked(
    label: str, made: Callable[[], Distance], points: IntArray, count: int, step: Progress
) -> tuple[Cell, ...]:
    """Return a row of the table: the axioms of a distance among points (k,), in `count` triples, and over all pairs."""
    each = made()
    among_points = each.pairwise(points)
    sample = triangle_violations(among_points, count)
    step(0.3, f"all pairs, {label}")
    least = smallest_distance(each, part(step, 0.3, 1))[0]
    return label, sample.triples, sample.violations, sample.worst, least / float(among_points.max())


def _doubles(laplacian: Laplacian, progress: Progress) -> Table:
    """Find for each number of eigenpairs the two different points, anywhere in faces, that are nearest by them."""
    biharmonic = distance(laplacian, "biharmonic")
    truncated = {count: _Truncated(laplacian, 1, count) for count in FEW}
    surface = biharmonic.surface
    along = EdgeGeodesic(surface).distances(np.arange(len(surface.vertices)))
    unit = float(np.sqrt(surface.face_areas.sum()))
    rows: list[tuple[Cell, ...]] = []
    for k, (count, each) in enumerate(truncated.items()):
        progress(k / len(truncated), f"two points at distance 0, {count} eigenpairs")
        images = each.points(each.laplacian.components[0])
        largest = float(max(np.linalg.norm(images - image, axis=1).max() for image in images))
        tried = (double_point(surface, images, along, apart * unit) for apart in APART)
        every = [each for each in tried if each is not None]
        # The farthest apart that are confused within rounding, or else the nearest images.
        found = next(
            (each for each in every if each.gap <= ROUNDING * largest),
            min(every, key=lambda each: each.gap, default=None),
        )
        if found is not None:
            places = [SurfacePoint(int(f), tuple(w)) for f, w in zip(found.faces, found.weights.tolist(), strict=True)]
            farthest = float(biharmonic.from_source(int(surface.faces[0, 0])).max())
            there = biharmonic.between(places[0], places[1]) / farthest
            way = float(along[tuple(surface.faces[found.faces, 0])]) / unit
            rows.append((count, found.gap / largest, there, way, *(_words(place) for place in places)))
    columns = (
        "eigenpairs",
        "distance over the largest",
        "biharmonic over its largest",
        "way along edges",
        "one",
        "other",
    )
    return Table("two different points", columns, tuple(rows))


def _words(place: SurfacePoint) -> str:
    return f"face {place.face}: {', '.join(f'{w:.3f}' for w in place.weights)}"


def _truncated_claim(doubles: Table, note: str) -> Claim:
    if not doubles.rows:
        return Claim(
            "claims-truncated", failure="No two places far apart were found that the first eigenpairs confuse."
        )
    confused = [row for row in doubles.rows if float(row[1] or 0) <= ROUNDING]
    count, gap, there, way = (confused[-1] if confused else min(doubles.rows, key=lambda row: float(row[1] or 0)))[:4]
    least = ", ".join(f"{float(row[1] or 0):.2g} from {row[0]}" for row in doubles.rows)
    return Claim(
        "claims-truncated",
        {
            "distance of two different points over the largest": Estimate(float(gap or 0)),
            "biharmonic distance of the same points over the largest": Estimate(float(there or 0)),
        },
        f"Two points in faces, {float(way or 0):.2f} roots of the area apart along edges, by {count} eigenpairs; "
        f"machine rounding is {np.finfo(float).eps:.1g}. The least found, over the largest: {least} eigenpairs. No "
        "closed surface fits into the plane of two functions without falling on itself; into three dimensions it need "
        f"not fit, and five have room for all. {note}",
    )


class _Truncated(EigenpairDiffusion):
    """Diffusion distance from its first few eigenpairs, whatever the weights of the others."""

    def __init__(self, laplacian: Laplacian, t: float, count: int) -> None:
        self._count = count
        super().__init__(laplacian, t)

    def points(self, component: Component, progress: Progress | None = None) -> FloatArray:
        return super().points(component, progress)[:, : self._count]
