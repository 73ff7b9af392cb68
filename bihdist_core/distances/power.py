"""The distances with the weights 1 / lambda^alpha of all eigenpairs (paper, section 6), for any power above 1."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..errors import ParameterError
from ..laplacian import Component, Laplacian
from ..mesh_like import MeshLike
from ..progress import Progress
from ..scalars import real_number
from .rational import RationalFunction, Weight
from .resolvent import ResolventDistance, eigenvalue_range, fitted_to

LABEL = "1/λ^{:g}, exact"
CIRCLE, RADIUS = 4, 0.3
"""So many poles on a half circle around 0, of this radius in first eigenvalues."""
PER_DECADE, FIRST, BEYOND = 3.0, 2.0, 10.0
"""Unless the power is whole: real poles for each factor of 10 of the eigenvalues, from this multiple of minus the first
to this one of minus the last."""
LOCAL = 1e-2
"""How errors at eigenvalues count for powers above 2: like 1 / x^2 up to the first eigenvalue over this, then 1 / x."""


class PowerDistance(ResolventDistance):
    """The family of distances with the weights 1 / lambda^alpha, with all eigenpairs (paper, section 6).

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose factors distances share.
    alpha : float
        The power, above 1, or else the sum diverges on a surface; 2 is the biharmonic distance.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Raises
    ------
    ParameterError
        For an `alpha` out of range.

    Notes
    -----
    d(i, j)^2 = sum_k (phi_k(i) - phi_k(j))^2 / lambda_k^alpha; it scales like length ** (alpha - 1).  The power is the
    integral of 1 / (lambda - z) along a path that comes from minus infinity, goes around 0 and returns, here a sum over
    poles: one set of them serves every power, a few of them every whole one.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> for alpha in (1.5, 2, 3):
    ...     distance = bihdist.PowerDistance(sphere, alpha)
    ...     print(alpha, distance.length_power, round(distance.between(0, 1), 3))
    1.5 0.5 0.644
    2 1.0 0.466
    3 2.0 0.303
    """

    def __init__(self, laplacian: Laplacian | MeshLike, alpha: float = 1.5, progress: Progress | None = None) -> None:
        if not 1 < real_number(alpha, "alpha") < np.inf:
            raise ParameterError(f"alpha is {alpha:g}; the sum of 1 / lambda^alpha needs alpha > 1.")
        self.alpha = float(alpha)
        self.label, self.length_power = LABEL.format(alpha), self.alpha - 1
        super().__init__(laplacian, progress=progress)

    def _weight(self, component: Component) -> Weight:
        return power(self.alpha)

    def _function(self, component: Component, progress: Progress | None) -> RationalFunction:
        (first, last), unit = eigenvalue_range(component)
        poles = [unit * pole for pole in power_poles(self.alpha, first / unit, last / unit)]
        component.resolvents.add(tuple(poles), progress)
        f = power(self.alpha)
        return fitted_to(component, f, poles, f if self.alpha <= 2 else local(first), whole=True)


def power(alpha: float) -> Weight:
    """Return 1 / x^alpha."""

    def f(x: FloatArray) -> FloatArray:
        # The same digits for all x that differ by powers of two.
        mantissa, exponent = np.frexp(x)
        weights: FloatArray = mantissa**-alpha * 2.0 ** (-alpha * exponent)
        return weights

    return f


def power_poles(alpha: float, first: float, last: float) -> list[complex]:
    """Return the poles that serve a power on the eigenvalues from `first` to `last`: first those of whole ones."""
    poles = list[complex]()
    if alpha != 2:
        poles += (RADIUS * first * np.exp(1j * np.pi * (np.arange(CIRCLE) + 0.5) / CIRCLE)).tolist()
    if alpha % 1:
        count = int(np.ceil(PER_DECADE * np.log10(last / first)))
        poles += [complex(-x) for x in np.geomspace(FIRST * first, BEYOND * last, count)]
    return poles


def local(first: float) -> Weight:
    """Return how errors count for powers above 2."""
    return lambda x: x**-2.0 + LOCAL / (first * x)
