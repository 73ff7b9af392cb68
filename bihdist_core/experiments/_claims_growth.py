"""Claims of sections 2 and 4 about growth: cost with N, eigenvalues with k, commute-time distance under refinement."""

from collections.abc import Sequence
from time import perf_counter

import numpy as np

from ..distances.biharmonic import BiharmonicDistance
from ..laplacian import Laplacian
from ..progress import Progress
from .measures import percent
from .result import Chart, Claim, Series, Table
from .shapes import Shapes, distance
from .spheres import icosphere, moebius

SIZES = (5_000, 10_000, 20_000, 40_000, 80_000)
QUICK_SIZES = (2_000, 4_000, 8_000)
STRETCH = 2.0
"""The factor of the Moebius transformation in the plane."""
COLUMNS = 5


def cost(shapes: Shapes, name: str, quick: bool, progress: Progress) -> tuple[list[Table], list[Chart], list[Claim]]:
    """Seconds for the set-up and for one column, N doubling."""
    sizes = QUICK_SIZES if quick else SIZES
    rows = []
    BiharmonicDistance(Laplacian(shapes.sized(name, 500))).from_source(0)
    for k, n in enumerate(sizes):
        surface = shapes.sized(name, n)
        start = perf_counter()
        biharmonic = BiharmonicDistance(Laplacian(surface))
        set_up = perf_counter() - start
        columns = []
        for vertex in range(COLUMNS):
            start = perf_counter()
            biharmonic.from_source(vertex)
            columns.append(perf_counter() - start)
        rows.append((n, set_up, float(np.median(columns))))
        progress((k + 1) / len(sizes), f"cost at {n:,} vertices")
    one, many = (_exponent(sizes, [row[q] for row in rows]) for q in (1, 2))
    series = tuple(
        Series(label, np.array(sizes), np.array([row[q] for row in rows]))
        for q, label in ((1, "set-up"), (2, "column"))
    )
    return (
        [Table("cost", ("vertices", "set-up, seconds", "one column, seconds"), tuple(rows))],
        [Chart("cost", "vertices", "seconds", series, log_x=True, log_y=True)],
        [
            Claim(
                "Factorization and each column cost O(N).",
                f"Fitted exponents: set-up {one:.2f}, one column {many:.2f} (nested dissection makes them N^1.5 and "
                "N log N).",
                max(one, many) <= 1.25,
            )
        ],
    )


def eigenvalues(shapes: Shapes, name: str, quick: bool, progress: Progress) -> tuple[list[Chart], list[Claim]]:
    """Eigenvalues of a surface grow like k (Weyl): lambda_k ~ 4 pi k / area."""
    count = 100 if quick else 200
    spectrum = shapes.laplacian(name).components[0].spectrum(count, progress)
    k = np.arange(1, count + 1)
    values = spectrum.eigenvalues[:count]
    area = float(shapes.laplacian(name).components[0].areas.sum())
    slope = _exponent(k[9:], values[9:])
    ratio = values[-1] * area / (4 * np.pi * count)
    series = (Series("eigenvalues", k, values), Series("4πk / area", k, 4 * np.pi * k / area))
    return [Chart("eigenvalues", "k", "eigenvalue", series, log_x=True, log_y=True)], [
        Claim(
            "Eigenvalues grow like k.",
            f"Fitted exponent over k = 10 to {count}: {slope:.2f}; the last over 4πk / area: {ratio:.2f}.",
            0.8 <= slope <= 1.25,
        )
    ]


def refinement(quick: bool, progress: Progress) -> tuple[list[Table], list[Chart], list[Claim]]:
    """Antipodes of finer and finer spheres: commute-time grows without bound, biharmonic distance converges."""
    rows = []
    levels = range(2, 5 if quick else 7)
    for times in levels:
        laplacian = Laplacian(icosphere(times))
        # Antipodes of the icosahedron, whose vertices all levels share.
        far = int(np.argmin(laplacian.surface.vertices[:12] @ laplacian.surface.vertices[0]))
        commute = distance(laplacian, "commute-time").between(0, far)
        biharmonic = distance(laplacian, "biharmonic").between(0, far)
        rows.append((len(laplacian.surface.vertices), commute, commute**2, biharmonic))
        progress((times - 1) / len(levels), "finer spheres")
    n = np.array([row[0] for row in rows])
    slope = float(np.polyfit(np.log(n), [row[2] for row in rows], 1)[0])
    moved = abs(rows[-1][3] - rows[-2][3]) / rows[-1][3]
    chart = Chart(
        "commute-time under refinement",
        "vertices",
        "squared distance of antipodes",
        (
            Series("commute-time", n, np.array([row[2] for row in rows])),
            Series("biharmonic", n, np.array([row[3] ** 2 for row in rows])),
        ),
        log_x=True,
    )
    columns = ("vertices", "commute-time", "commute-time squared", "biharmonic")
    return (
        [Table("refinement", columns, tuple(rows))],
        [chart],
        [
            Claim(
                "Commute-time distance cannot be defined on surfaces: it diverges.",
                f"Its square between antipodes of a sphere grows by {slope:.4f} per e-fold of N; the logarithmic "
                f"singularity of the Green's function gives 1/(2π) = {1 / (2 * np.pi):.4f}.",
                abs(slope * 2 * np.pi - 1) < 0.1,
            ),
            Claim(
                "Biharmonic distance is defined on surfaces: it converges.",
                f"It changes by {percent(moved)} at the last refinement; at {rows[-1][0]:,} vertices it is "
                f"{rows[-1][3]:.5f}, on the unit sphere {_antipodes():.5f}.",
                moved < 0.01,
            ),
        ],
    )


def conformal(quick: bool, progress: Progress) -> tuple[list[Table], list[Claim]]:
    """Two conformally equivalent spheres: commute-time distance is the same on both, biharmonic is not."""
    sphere = icosphere(4 if quick else 5)
    pair = [Laplacian(s) for s in (sphere, moebius(sphere, STRETCH))]
    points = np.random.default_rng(0).choice(len(sphere.vertices), 200, replace=False)
    rows = []
    for label in ("commute-time", "biharmonic"):
        one, two = (distance(laplacian, label).pairwise(points) for laplacian in pair)
        apart = one > 0
        change = np.abs(two[apart] / one[apart] - 1)
        rows.append((label, float(change.mean()), float(change.max())))
        progress(len(rows) / 2, "conformally equivalent spheres")
    return [Table("conformal", ("distance", "mean relative change", "largest relative change"), tuple(rows))], [
        Claim(
            "Commute-time distance is the same on every two conformally equivalent surfaces; biharmonic is not.",
            f"A sphere and its image under a Moebius transformation (stretch {STRETCH:g}), mean change over all pairs "
            f"of 200 points: commute-time {percent(rows[0][1])}, biharmonic {percent(rows[1][1])}.",
            rows[0][1] < 0.02 < rows[1][1],
        )
    ]


def _antipodes() -> float:
    """Biharmonic distance of antipodes of the unit sphere, d^2 = sum_l (2l + 1) / (4 pi) (2 - 2 P_l(-1)) / (l(l+1))^2.

    P_l(-1) is 1 for even l and -1 for odd ones.
    """
    degree = np.arange(1, 200_001, 2, dtype=float)
    return float(np.sqrt((4 * (2 * degree + 1) / (4 * np.pi) / (degree * (degree + 1)) ** 2).sum()))


def _exponent(x: Sequence[float] | np.ndarray, y: Sequence[float] | np.ndarray) -> float:
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])
