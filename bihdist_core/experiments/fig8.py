"""Figure 8: the truncation error of biharmonic distance from its first K eigenvectors, K = 1 to 200, over random pairs.

The paper: log10(|error| / max d), largest and mean over 200,000 random pairs of a mesh of 5K vertices; "the error
bound is (generally) linear in 1/K".
"""

import numpy as np

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..laplacian import Laplacian
from ..progress import Progress, part
from ..surface import Surface
from .measures import percent
from .result import Chart, Claim, Result, Series, Table
from .shapes import Shapes, distance
from .verdicts import RESAMPLES, Estimate, estimate, exponent

TITLE = "Truncation error of the first K eigenvectors"
PAIRS, COUNT, K = 200_000, 5_000, 200
FITTED_FROM = 20
WORST = 32
"""The pairs with the largest errors for each K: that none of them is in a resample has a chance of e^-32."""
RESOLVED = 0.1
"""An eigenvalue is resolved if linear elements get it right within this: to first order they are off by λh²/12."""


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
    k, resolved = min(K, most), resolved_by(surface)
    spectrum = laplacian.components[0].spectrum(k, part(progress, 0.5, 0.8))
    ks = np.arange(1, k + 1)
    weighted = spectrum.eigenvectors[:, :k] / spectrum.eigenvalues[:k]

    def errors(some: IntArray, squares: FloatArray) -> FloatArray:
        found: FloatArray = np.abs(np.sqrt(squares) - exact[some]) / largest
        return found

    every, squares, worst = np.arange(count), np.zeros(count), list[IntArray]()
    curves = {"largest": np.empty(k), "mean": np.empty(k)}
    for q in range(k):
        squares += (weighted[i, q] - weighted[j, q]) ** 2
        error = errors(every, squares)
        curves["largest"][q], curves["mean"][q] = error.max(), error.mean()
        worst.append(np.argpartition(error, -WORST)[-WORST:])
        part(progress, 0.8, 1)((q + 1) / k, "truncation errors")
    numbers, failure = dict[str, Estimate](), ""
    if k < K or resolved < K:
        # With all eigenpairs there is no error, and no power of K that it falls by.
        failure = (
            f"It is judged over the first {K} eigenpairs; the mesh with {len(surface.vertices):,} vertices has "
            f"{most:,} and by Weyl's law resolves {resolved:,}."
        )
    else:
        some = np.unique(np.concatenate(worst))
        of_some = errors(some[:, None], np.cumsum((weighted[i[some]] - weighted[j[some]]) ** 2, axis=1))
        numbers = {
            "exponent of K, largest error": _resampled(ks[FITTED_FROM - 1 :], of_some[:, FITTED_FROM - 1 :], count)
        }
    return Result(
        "fig8",
        TITLE,
        f"{count:,} random pairs of different vertices (seed 0) of a mesh of {len(surface.vertices):,} vertices; the "
        f"largest distance is that of all its pairs. The exponent is fitted to log error against log K from K = "
        f"{FITTED_FROM}, its interval by resampling the pairs. An error that falls like 1/K has the exponent -1, and "
        "one that falls faster keeps to the bound. A number K is judged if the mesh resolves so many eigenpairs: their "
        f"eigenvalues 4πk / area (Weyl), times the square of the mean edge over 12, are at most {RESOLVED:g}.",
        {name: surface},
        charts=(
            Chart(
                "truncation error",
                "K",
                "log10(error / largest distance)",
                tuple(Series(label, ks, np.log10(curve)) for label, curve in curves.items()),
            ),
            Chart(
                "truncation error against 1/K",
                "1/K",
                "error / largest distance",
                tuple(Series(label, 1 / ks, curve) for label, curve in curves.items()),
                log_x=True,
                log_y=True,
            ),
        ),
        tables=(
            Table(
                "truncation errors",
                ("K", *curves),
                tuple(
                    (int(q), *(float(curve[q - 1]) for curve in curves.values()))
                    for q in (1, 10, 50, 100, 150, 200)
                    if q <= k
                ),
            ),
        ),
        claims=(
            Claim(
                "fig8-1",
                numbers,
                f"With {k} eigenvectors the largest error is {percent(curves['largest'][-1])}, the mean "
                f"{percent(curves['mean'][-1])}.",
                failure=failure,
            ),
        ),
    )


def resolved_by(surface: Surface) -> int:
    """Return how many eigenpairs a mesh resolves, by Weyl's law."""
    area = float(surface.face_areas.sum())
    return int(12 * RESOLVED * area / (4 * np.pi * surface.mean_edge_length**2))


def _resampled(ks: IntArray, errors: FloatArray, count: int) -> Estimate:
    """Return the exponent of the largest error in K (k,), given the errors (m, k) of the worst of `count` pairs.

    A resample has each pair with the chance 1 - 1/e.
    """
    rng = np.random.default_rng(0)
    found = [exponent(ks, errors[rng.random(len(errors)) < 1 - np.exp(-1)].max(axis=0)) for _ in range(RESAMPLES)]
    return estimate(exponent(ks, errors.max(axis=0)), found, count)


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
