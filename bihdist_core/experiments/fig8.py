"""Figure 8: the error of biharmonic distance from its first K eigenvectors, K = 1 to 200, over random pairs.

The paper: log10(|error| / max d), largest and mean over 200,000 random pairs of a mesh of 5K vertices; "the error
bound is (generally) linear in 1/K".
"""

import numpy as np

from ..distances.distance import Distance
from ..laplacian import Laplacian
from ..progress import Progress, part
from .measures import percent
from .result import Chart, Claim, Result, Series, Table
from .shapes import Shapes, distance

TITLE = "Error of the first K eigenvectors"
PAIRS, COUNT, K = 200_000, 5_000, 200
FITTED_FROM = 20


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Errors at 200,000 random pairs of a 5,000 vertex mesh (quick: 20,000 pairs of 1,500 vertices)."""
    (name,) = shapes.names("figure")
    n, count = (1_500, 20_000) if quick else (COUNT, PAIRS)
    surface = shapes.sized(name, min(n, len(shapes[name].vertices)), part(progress, 0, 0.1))
    laplacian = Laplacian(surface)
    biharmonic = distance(laplacian, "biharmonic", part(progress, 0.1, 0.2))
    i, j, exact, largest = _pairs(biharmonic, count, part(progress, 0.2, 0.5))
    k = min(K, len(surface.vertices) - 1)
    spectrum = laplacian.components[0].spectrum(k, part(progress, 0.5, 0.8))
    worst, mean = np.zeros(k), np.zeros(k)
    squares = np.zeros(len(exact))
    for q in range(k):
        phi = spectrum.eigenvectors[:, q]
        squares += (phi[i] - phi[j]) ** 2 / spectrum.eigenvalues[q] ** 2
        error = np.abs(np.sqrt(squares) - exact) / largest
        worst[q], mean[q] = error.max(), error.mean()
        part(progress, 0.8, 1)((q + 1) / k, "errors")
    ks = np.arange(1, k + 1)
    fitted = slice(min(FITTED_FROM, k // 2) - 1, k)
    slope = {label: float(np.polyfit(np.log(ks[fitted]), np.log(e[fitted]), 1)[0]) for label, e in _named(worst, mean)}
    return Result(
        "fig8",
        TITLE,
        f"{count:,} random pairs of different vertices (seed 0) of a mesh of {len(surface.vertices):,} vertices; the "
        f"largest distance is that of all its pairs. Slopes are fitted to log error against log K from K = "
        f"{FITTED_FROM}; an error linear in 1/K has the slope -1.",
        {name: surface},
        charts=(
            Chart(
                "error of K eigenvectors",
                "K",
                "log10(error / largest distance)",
                (Series("largest", ks, np.log10(worst)), Series("mean", ks, np.log10(mean))),
            ),
            Chart(
                "error against 1/K",
                "1/K",
                "error / largest distance",
                (Series("largest", 1 / ks, worst), Series("mean", 1 / ks, mean)),
                log_x=True,
                log_y=True,
            ),
        ),
        tables=(
            Table(
                "errors",
                ("K", "largest", "mean"),
                tuple((int(q), float(worst[q - 1]), float(mean[q - 1])) for q in (1, 10, 50, 100, 150, 200) if q <= k),
            ),
            Table("slopes", ("curve", "slope"), tuple(slope.items())),
        ),
        claims=(
            Claim(
                "The error is about linear in 1/K.",
                f"Slope of log error against log K: largest {slope['largest']:.2f}, mean {slope['mean']:.2f}; "
                f"with {k} eigenvectors the largest error is {percent(worst[-1])}, the mean {percent(mean[-1])}.",
                -1.5 <= slope["largest"] <= -0.75 and slope["mean"] <= -0.75,
            ),
        ),
    )


def _named(worst: np.ndarray, mean: np.ndarray) -> tuple[tuple[str, np.ndarray], ...]:
    return ("largest", worst), ("mean", mean)


def _pairs(distance: Distance, count: int, progress: Progress) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """(count,) first and second vertices of random pairs and their distances, and the largest of all pairs."""
    n = len(distance.surface.vertices)
    rng = np.random.default_rng(0)
    i = np.sort(rng.integers(n, size=count))
    j = (i + rng.integers(1, n, size=count)) % n
    exact, largest = np.empty(count), 0.0
    for start in range(0, n, 256):
        stop = min(start + 256, n)
        fields = distance.from_sources(np.arange(start, stop))
        mine = slice(*np.searchsorted(i, [start, stop]))
        exact[mine] = fields[j[mine], i[mine] - start]
        largest = max(largest, float(fields.max()))
        progress(stop / n, "exact distances")
    return i, j, exact, largest
