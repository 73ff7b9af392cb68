"""Figure 8: the error of biharmonic distance from its first K eigenvectors, K = 1 to 200, over random pairs.

The paper: log10(|error| / max d), largest and mean over 200,000 random pairs of a mesh of 5K vertices; "the error
bound is (generally) linear in 1/K".
"""

import numpy as np

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..laplacian import Laplacian
from ..progress import Progress, part
from .measures import percent
from .result import Chart, Claim, Result, Series, Table
from .shapes import Shapes, distance
from .verdicts import Estimate, mean_estimate

TITLE = "Error of the first K eigenvectors"
PAIRS, COUNT, K = 200_000, 5_000, 200
FITTED_FROM = 20


BATCHES = 25
"""The pairs in random groups, each of which gives exponents of its own: their spread is that of the choice of pairs."""


def compute(shapes: Shapes, quick: bool = False, progress: Progress | None = None) -> Result:
    """Measure errors at 200,000 random pairs of a 5,000 vertex mesh (quick: 20,000 pairs of 1,500 vertices)."""
    (name,) = shapes.names("figure")
    n, count = (1_500, 20_000) if quick else (COUNT, PAIRS)
    surface = shapes.at_most(name, n, part(progress, 0, 0.1))
    laplacian = Laplacian(surface)
    biharmonic = distance(laplacian, "biharmonic", part(progress, 0.1, 0.2))
    i, j, exact, largest = _pairs(biharmonic, count, part(progress, 0.2, 0.5))
    most = laplacian.components[0].most_eigenpairs
    if most < 1:
        raise ParameterError(f"{name} has no eigenpair besides the constant.")
    k = min(K, most)
    spectrum = laplacian.components[0].spectrum(k, part(progress, 0.5, 0.8))
    # The pairs are in the order of their first vertices.
    batch = np.random.default_rng(1).permutation(count) % BATCHES
    order = np.argsort(batch, kind="stable")
    ends = np.searchsorted(batch[order], np.arange(BATCHES))
    worst, mean = np.zeros((2, k, BATCHES))
    squares = np.zeros(len(exact))
    for q in range(k):
        phi = spectrum.eigenvectors[:, q]
        squares += (phi[i] - phi[j]) ** 2 / spectrum.eigenvalues[q] ** 2
        error = (np.abs(np.sqrt(squares) - exact) / largest)[order]
        worst[q], mean[q] = np.maximum.reduceat(error, ends), np.add.reduceat(error, ends) / np.bincount(batch)
        part(progress, 0.8, 1)((q + 1) / k, "errors")
    curves = {"largest": worst.max(axis=1), "mean": mean @ np.bincount(batch) / count}
    ks = np.arange(1, k + 1)
    fitted = slice(FITTED_FROM - 1, k)
    # With all eigenpairs there is no error, and no power of K that it falls by.
    judged = (("largest", worst), ("mean", mean)) if k == K else ()
    exponents = {label: exponent_of(ks[fitted], every[fitted]) for label, every in judged}
    return Result(
        "fig8",
        TITLE,
        f"{count:,} random pairs of different vertices (seed 0) of a mesh of {len(surface.vertices):,} vertices; the "
        f"largest distance is that of all its pairs. Exponents are fitted to log error against log K from K = "
        f"{FITTED_FROM}, in {BATCHES} random groups of pairs, of which the mean and its interval are judged; an error "
        "linear in 1/K has the exponent -1.",
        {name: surface},
        charts=(
            Chart(
                "error of K eigenvectors",
                "K",
                "log10(error / largest distance)",
                tuple(Series(label, ks, np.log10(curve)) for label, curve in curves.items()),
            ),
            Chart(
                "error against 1/K",
                "1/K",
                "error / largest distance",
                tuple(Series(label, 1 / ks, curve) for label, curve in curves.items()),
                log_x=True,
                log_y=True,
            ),
        ),
        tables=(
            Table(
                "errors",
                ("K", *curves),
                tuple(
                    (int(q), *(float(curve[q - 1]) for curve in curves.values()))
                    for q in (1, 10, 50, 100, 150, 200)
                    if q <= k
                ),
            ),
            *([_slopes(exponents)] if exponents else []),
        ),
        claims=(
            Claim(
                "fig8-1",
                {f"exponent of K, {label} error": found for label, found in exponents.items()},
                f"With {k} eigenvectors the largest error is {percent(curves['largest'][-1])}, the mean "
                f"{percent(curves['mean'][-1])}.",
                failure="" if k == K else f"It is judged over the first {K} eigenpairs, and {name} has {most}.",
            ),
        ),
    )


def _slopes(exponents: dict[str, Estimate]) -> Table:
    rows = tuple((label, found.value, found.low, found.high) for label, found in exponents.items())
    return Table("slopes", ("curve", "slope", "low", "high"), rows)


def exponent_of(ks: IntArray, errors: FloatArray) -> Estimate:
    """Return the mean exponent of errors (k, m) against numbers (k,), over groups (m,), with its interval."""
    x = np.log(ks) - np.log(ks).mean()
    return mean_estimate(x @ np.log(errors) / (x @ x))


def _pairs(distance: Distance, count: int, progress: Progress) -> tuple[IntArray, IntArray, FloatArray, float]:
    """Return (count,) first and second vertices of random pairs and their distances, and the largest of all pairs."""
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
