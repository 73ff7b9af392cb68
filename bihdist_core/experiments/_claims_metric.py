"""Claims of section 4: the axioms of a metric."""

import numpy as np

from ..analysis.diagnostics import smallest_distance, triangle_violations
from ..distances.diffusion import DiffusionDistance
from ..distances.distance import Distance
from ..laplacian import Component, Laplacian
from ..progress import Progress, part
from .result import Claim, Table
from .shapes import Shapes, distance

FEW = 5
"""Eigenpairs of a strongly truncated diffusion distance."""


def metric(shapes: Shapes, name: str, quick: bool, progress: Progress) -> tuple[list[Table], list[Claim]]:
    """Triangle inequality over random triples, and the smallest distance of different points."""
    count, among, all_pairs = (100_000, 300, 800) if quick else (1_000_000, 1_500, 2_500)
    surface = shapes.sized(name, min(all_pairs, len(shapes[name].vertices)), part(progress, 0, 0.1))
    laplacian = Laplacian(surface)
    n = len(surface.vertices)
    points = np.random.default_rng(0).choice(n, min(among, n), replace=False)
    distances: dict[str, Distance] = {
        "biharmonic": distance(laplacian, "biharmonic"),
        "geodesic along edges": distance(laplacian, "geodesic method = dijkstra"),
        "diffusion t = 1": distance(laplacian, "diffusion t = 1"),
        "diffusion t = 4": distance(laplacian, "diffusion t = 4"),
        f"diffusion t = 1, {FEW} eigenpairs": _Truncated(laplacian, 1, FEW),
        "biharmonic, 200 eigenpairs": distance(laplacian, "truncated"),
    }
    rows = []
    for k, (label, each) in enumerate(distances.items()):
        step = part(progress, 0.1 + 0.9 * k / len(distances), 0.1 + 0.9 * (k + 1) / len(distances))
        among_points = each.pairwise(points)
        sample = triangle_violations(among_points, count)
        step(0.3, f"all pairs, {label}")
        least = smallest_distance(each, part(step, 0.3, 1))[0]
        rows.append((label, sample.triples, sample.violations, sample.worst, least / float(among_points.max())))
    table = Table("metric", ("distance", "triples", "violations", "worst violation", "smallest distance"), tuple(rows))
    broken = sum(row[2] for row in rows)
    few = table.value("smallest distance", distance=f"diffusion t = 1, {FEW} eigenpairs")
    own = table.value("smallest distance", distance="biharmonic")
    return [table], [
        Claim(
            "Biharmonic distance satisfies the triangle inequality.",
            f"{rows[0][2]} of {count:,} random triples break it by more than rounding.",
            rows[0][2] == 0,
        ),
        Claim(
            "Biharmonic distance tells all points apart.",
            f"Smallest distance of different vertices over the largest, all pairs of {n:,}: {own:.2g}.",
            own > 1e-6,
        ),
        Claim(
            "Diffusion distance is not necessarily a metric when computed from the first few eigenpairs.",
            f"Triangle inequality: {broken} violations over all distances, truncated ones included (a sum over "
            f"eigenpairs is a distance of points, so it always holds). Identity of indiscernibles: the smallest "
            f"distance of different vertices from {FEW} eigenpairs is {few:.2g} of the largest, against {own:.2g}.",
            few < 0.1 * own,
        ),
    ]


class _Truncated(DiffusionDistance):
    """Diffusion distance from its first few eigenpairs, whatever the weights of the others."""

    def __init__(self, laplacian: Laplacian, t: float, count: int) -> None:
        self._count = count
        super().__init__(laplacian, t)

    def points(self, component: Component, progress: Progress | None = None) -> np.ndarray:
        return super().points(component, progress)[:, : self._count]
