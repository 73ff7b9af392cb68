"""Rational functions that are close to the weights of a distance on a component's spectrum.

A distance d(i, j)^2 = sum_k f(lambda_k) (phi_k(i) - phi_k(j))^2 is known where f is a sum of c_j / (lambda - z_j), of
1 / lambda and of 1 / lambda^2 (see `solver.resolvents`): the last two are the squares of the commute-time and the
biharmonic distance, d_C^2 and d_B^2.  With the error e = r - f of such a sum r, the square is off by
sum_k e(lambda_k) (phi_k(i) - phi_k(j))^2.  So where

    |e(x)| <= s f(x) + a / x^2 + b / x        it is off by no more than        s d^2 + a d_B^2 + b d_C^2,

beside the source as well as far from it.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import AnyArray, FloatArray
from ..solver.blas import one_blas_thread

Weight = Callable[[FloatArray], FloatArray]
"""The weights f of eigenvalues; their shape."""

FITTED, CHECKED = 600, 2400
"""Eigenvalues, evenly spread by their logarithms, at which a sum is fitted, and its error looked at."""
BETWEEN = 1.05
"""By how much the error may be larger between these."""
SPLITS = 6
"""About so many eigenvalues are tried, below which the error is bounded by a / x^2, and above which by b / x."""

EXPONENTIAL = (
    -6.426297 + 1.1947j,
    -5.958367 + 3.589227j,
    -5.003623 + 5.999953j,
    -3.520017 + 8.440746j,
    -1.431151 + 10.931599j,
    1.400617 + 13.505838j,
    5.248999 + 16.230183j,
    10.823478 + 19.288503j,
)
"""Poles above the real axis of the best rational approximation of degree 16 to exp(-x), x >= 0 (Cody, Meinardus and
Varga 1969; by the method of Caratheodory and Fejer, Trefethen, Weideman and Schmelzer 2006)."""


@dataclass(frozen=True, eq=False)
class RationalFunction:
    """The sum r(x) = sum_j c_j / (x - z_j) + c / x + d / x^2, for a pair of poles with the conjugate term, too.

    Attributes
    ----------
    poles : tuple of complex
        The z_j, of complex pairs that above the real axis.
    weights : (p,) ndarray
        The c_j.
    inverse, inverse_square : float
        c and d.
    share : float
        The bound s on the error.
    bounds : (k, 2) ndarray
        Bounds a and b, each pair of which is one.
    """

    poles: tuple[complex, ...]
    weights: AnyArray
    inverse: float
    inverse_square: float
    share: float
    bounds: FloatArray

    def off(self, squares: FloatArray, biharmonic: FloatArray, commute_time: FloatArray) -> FloatArray:
        """Bound the error of squared distances, all of one shape."""
        least = np.full(squares.shape, np.inf)
        for a, b in self.bounds:
            np.minimum(least, a * biharmonic + b * commute_time, out=least)
        off: FloatArray = self.share * squares + least
        return off


def terms(x: FloatArray, poles: Sequence[complex], whole: bool) -> FloatArray:
    """Return (m, k) the real functions of x (m,) that a sum is made of: of each pole, then, if `whole`, 1 / x and
    1 / x^2."""
    z = np.array(poles, complex)
    each = 1 / (x[:, None] - z)
    pair = z.imag != 0
    parts = [np.where(pair, 2, 1) * each.real, -2 * each.imag[:, pair]]
    return np.hstack([*parts, 1 / x[:, None], 1 / x[:, None] ** 2] if whole else parts)


def fitted(
    f: Weight,
    first: float,
    last: float,
    poles: Sequence[complex],
    scale: Weight | None,
    whole: bool = False,
    has_infinite: bool = False,
) -> RationalFunction:
    """Return the sum over some poles that is closest to f on the eigenvalues from `first` to `last`.

    Errors are least in comparison with `scale`, or with f. `whole` admits 1 / x and 1 / x^2. `has_infinite` says
    that there are infinite eigenvalues, too, as vertices without an area have.
    """
    x, checked = (np.geomspace(first, last, count) for count in (FITTED, CHECKED))
    size_of_errors = f(x) if scale is None else scale(x)
    count, pair = len(poles), np.array([pole.imag != 0 for pole in poles], bool)
    # x r(x) at infinity, where it should be 0.
    beyond = np.concatenate([np.where(pair, 2, 1), np.zeros(pair.sum()), [1, 0] if whole else []])
    matrix = np.vstack([terms(x, poles, whole) / size_of_errors[:, None], beyond / (last * size_of_errors[-1])])
    wanted = np.append(f(x) / size_of_errors, 0)
    if not has_infinite:
        matrix, wanted = matrix[:-1], wanted[:-1]
    size = np.linalg.norm(matrix, axis=0)
    # By orthogonal triangles first, which leaves a small system.
    with one_blas_thread():
        q, r = np.linalg.qr(matrix / size)
        solution = np.linalg.lstsq(r, q.T @ wanted, rcond=1e-16)[0] / size
    error = np.abs(terms(checked, poles, whole) @ solution - f(checked)) * BETWEEN
    weights = solution[:count].astype(complex)
    weights[pair] += 1j * solution[count : count + pair.sum()]
    inverse, inverse_square = solution[-2:].tolist() if whole else (0.0, 0.0)
    at_infinity = abs(float(beyond @ solution)) if has_infinite else 0.0
    if scale is None:
        share, bounds = float((error / f(checked)).max()), np.array([[0.0, at_infinity]])
    else:
        share, low, high = 0.0, np.maximum.accumulate(error * checked**2), (error * checked)[::-1]
        high = np.maximum(np.maximum.accumulate(high)[::-1], at_infinity)
        bounds = np.stack([low, np.append(high[1:], at_infinity)], axis=1)[:: CHECKED // SPLITS]
    return RationalFunction(tuple(poles), weights, inverse, inverse_square, share, bounds)
