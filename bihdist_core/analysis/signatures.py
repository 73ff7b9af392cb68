"""Signatures: a value at each vertex, sum_k f(lambda_k) phi_k(x)^2, that is the same however a shape is posed.

They are diagonals of functions of the Laplacian.  Those of 1 / lambda^2 come with the factor, exact; others from
rational functions, with all eigenpairs and a bound on the error (see `distances.resolvent`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, unit_columns
from ..distances.accuracy import FINEST_ACCURACY, POOR_ACCURACY, SAFETY_FACTOR, Perturbation
from ..distances.biharmonic import BiharmonicDistance
from ..distances.diffusion import PoleDiffusion, checked_time
from ..distances.distance import unit_of
from ..distances.rational import RationalFunction, Weight
from ..distances.resolvent import SEEN, ResolventDistance, columns_and_moves, fitted_to
from ..distances.tails import biharmonic_squares
from ..errors import ParameterError, SolverError
from ..laplacian import Component, Laplacian, as_laplacian
from ..mesh_like import MeshLike
from ..progress import Progress, part, steps
from ..scalars import real_number

OF_MEANS, OF_SQUARES = 4.0, 9.0
"""The error of a mean squared distance, and of a squared length, in shares of their maxima, if that of distances is
one: with the largest squared length b, distances are at most 2 sqrt(b), and means at most 2 b."""
REACH, STEP, ANGLE, STEEPEST_ANGLE = 5.0, 0.6, 3.0, 1.5
"""Of the poles of a Gaussian of logarithms, in units of its width: how far from its middle there are some, how far
apart, and their angle, of which the last is the most there is.  Then its error is below 1e-8."""


@dataclass(frozen=True, eq=False)
class Signature:
    """A value at each vertex.

    Attributes
    ----------
    values : (n,) float64 ndarray
        NaN at vertices that belong to no face.
    accuracy : float
        By what fraction of the maximum values may be off, estimated on the safe side.
    label : str
        What it is, with its parameters.
    length_power : float
        A surface s times as large has values s ** length_power times as large.
    unit : str
        The unit of the values in words.

    Examples
    --------
    >>> import bihdist
    >>> found = bihdist.centrality(bihdist.sample("hand"))
    >>> found.values.shape, found.length_power, found.accuracy < 1e-8
    ((7569,), 2.0, True)
    """

    values: FloatArray
    accuracy: float
    label: str
    length_power: float
    unit: str


def centrality(laplacian: Laplacian | MeshLike, progress: Progress | None = None) -> Signature:
    """Compute the mean, over the surface, of the squared biharmonic distance from each vertex.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose factor is shared.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    Signature
        Exact; unit length squared.  It is least in the middle of a shape, and largest at its tips.

    Raises
    ------
    SolverError
        If distances may be off by more than a thousandth of their maximum.

    Notes
    -----
    The mean by area over y of d(x, y)^2 = g(x, x) + g(y, y) - 2 g(x, y) is g(x, x) plus the mean of g(y, y), as rows of
    g, the Green's function without a mean, sum to zero: the `biharmonic_kernel_signature` and a constant.

    Examples
    --------
    >>> import bihdist
    >>> hand = bihdist.sample("hand")
    >>> found = bihdist.centrality(hand)
    >>> distances = bihdist.BiharmonicDistance(hand).from_source(12)
    >>> mean = (bihdist.Laplacian(hand).areas * distances**2).sum() / hand.area
    >>> bool(abs(found.values[12] / mean - 1) < 1e-9), found.unit
    (True, 'mesh units^2')
    """
    label = "mean squared biharmonic distance, exact"
    return _exact(laplacian, label, lambda c: c.biharmonic_eccentricity**2, OF_MEANS, progress)


def biharmonic_kernel_signature(laplacian: Laplacian | MeshLike, progress: Progress | None = None) -> Signature:
    """Compute the diagonal of the pseudo-inverse of the squared Laplacian.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose factor is shared.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    Signature
        The sum over all k of phi_k(x)^2 / lambda_k^2, exact; unit length squared.

    Raises
    ------
    SolverError
        If distances may be off by more than a thousandth of their maximum.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> exact = bihdist.biharmonic_kernel_signature(sphere)
    >>> spectrum = bihdist.eigenpairs(sphere, 641)  # all there are
    >>> sums = (spectrum.eigenvectors**2 / spectrum.eigenvalues**2).sum(axis=1)
    >>> round(float(exact.values[0]), 4), round(float(sums[0]), 4)
    (0.0809, 0.0809)
    """
    return _exact(laplacian, "biharmonic kernel signature, exact", biharmonic_squares, OF_SQUARES, progress)


def heat_kernel_signature(
    laplacian: Laplacian | MeshLike, t: float = 1 / 4, progress: Progress | None = None
) -> Signature:
    """Compute how much heat is left at each vertex after a time (Sun, Ovsjanikov and Guibas 2009).

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose factors are shared.
    t : float
        The normalised time, positive and at most 700: that of the diffusion distance, in units of 1 / lambda_1.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    Signature
        1 / area + sum_k exp(-t lambda_k / lambda_1) phi_k(x)^2, with all eigenpairs; unit 1 / length squared.

    Raises
    ------
    ParameterError
        If `t` is out of range.

    Notes
    -----
    The diagonal of a rational function of the Laplacian, by eight factorizations, which the diffusion distance shares.
    What it is off by is bounded by the diagonals of the biharmonic and the commute-time kernel.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> found = bihdist.heat_kernel_signature(pyvista.Icosphere(nsub=3), t=0.1)
    >>> found.label, found.accuracy < 1e-7
    ('heat kernel signature, t = 0.1', True)
    """
    kernel = PoleDiffusion(as_laplacian(laplacian), checked_time(t), part(progress, 0, 0.7))
    return _of_kernel(kernel, f"heat kernel signature, t = {t:g}", 1.0, part(progress, 0.7, 1))


def wave_kernel_signature(
    laplacian: Laplacian | MeshLike, energy: float = 10.0, sigma: float = 0.4, progress: Progress | None = None
) -> Signature:
    """Compute where waves of one energy are, on average over time (Aubry, Schlickewei and Cremers 2011).

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian.
    energy : float
        The energy, positive, in units of the first eigenvalue.
    sigma : float
        By how much the logarithms of the energies vary, above 0.05 and at most 1.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    Signature
        The mean of phi_k(x)^2 with the weights w_k = exp(-ln(lambda_k / (energy lambda_1))^2 / (2 sigma^2)), with all
        eigenpairs; unit 1 / length squared.

    Raises
    ------
    ParameterError
        If `energy` or `sigma` is out of range.
    SolverError
        If no eigenvalue is near the energy.

    Notes
    -----
    The diagonal of a rational function of the Laplacian, by some twenty factorizations; the sum of the weights is that
    of the diagonal by area.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> found = bihdist.wave_kernel_signature(pyvista.Icosphere(nsub=3), energy=20)
    >>> found.label, found.accuracy < 1e-6
    ('wave kernel signature, energy = 20, sigma = 0.4', True)
    """
    if not 0 < real_number(energy, "The energy") < np.inf:
        raise ParameterError(f"The energy is {energy:g}; it must be positive.")
    if not 0.05 < real_number(sigma, "sigma") <= 1:
        raise ParameterError(f"sigma is {sigma:g}; it must be above 0.05 and at most 1.")
    label = f"wave kernel signature, energy = {energy:g}, sigma = {sigma:g}"
    kernel = WaveKernel(as_laplacian(laplacian), float(energy), float(sigma), part(progress, 0, 0.7))
    return _of_kernel(kernel, label, 0.0, part(progress, 0.7, 1))


class WaveKernel(ResolventDistance):
    """The weights of waves about an energy, in units of the first eigenvalue."""

    length_power = -1.0

    def __init__(self, laplacian: Laplacian, energy: float, sigma: float, progress: Progress | None) -> None:
        self.energy, self.sigma, self.label = energy, sigma, "waves"
        super().__init__(laplacian, progress)

    def _middle(self, component: Component) -> float:
        return self.energy * float(component.spectrum(1).eigenvalues[0])

    def _weight(self, component: Component) -> Weight:
        middle = self._middle(component)

        def f(x: FloatArray) -> FloatArray:
            weights: FloatArray = np.exp(-(np.log(x / middle) ** 2) / (2 * self.sigma**2))
            return weights

        return f

    def _function(self, component: Component, progress: Progress | None) -> RationalFunction:
        # On a grid of few widths, so that others of the poles serve other energies, too.
        width = 2.0 ** (np.floor(2 * np.log2(self.sigma)) / 2)
        step, angle, middle = STEP * width, min(ANGLE * width, STEEPEST_ANGLE), self._middle(component)
        ends = (np.log(self.energy) + np.array([-REACH, REACH]) * self.sigma) / step
        grid = np.arange(np.ceil(ends[0]), np.floor(ends[1]) + 1) * step
        poles = tuple((middle / self.energy * np.exp(grid + 1j * angle)).tolist())
        component.resolvents.add(poles, progress)
        return fitted_to(component, self._weight(component), poles, lambda x: 1 / (1 + x / middle))


def _exact(
    laplacian: Laplacian | MeshLike,
    label: str,
    values_of: Callable[[Component], FloatArray],
    per_share: float,
    progress: Progress | None,
) -> Signature:
    distance = BiharmonicDistance(laplacian, progress=part(progress, 0, 0.8))
    estimate = distance.error_estimate(range(len(distance.laplacian.components)), part(progress, 0.8, 1))
    values = np.full(len(distance.surface.vertices), np.nan)
    for component in distance.laplacian.components:
        values[component.vertices] = values_of(component)
    return _signature(distance.laplacian, values, per_share * (estimate.share or FINEST_ACCURACY), label, 2.0)


def _of_kernel(kernel: ResolventDistance, label: str, of_constant: float, progress: Progress | None) -> Signature:
    """Return the diagonal of a kernel in which the constant has a weight; where that is 0, over the sum of weights."""
    laplacian, accuracy = kernel.laplacian, FINEST_ACCURACY
    values = np.full(len(laplacian.surface.vertices), np.nan)
    for step, component in steps(progress, laplacian.components):
        kernel.prepare(component, part(step, 0, 0.7))
        function, areas = kernel._bounded(component), component.areas
        diagonal = kernel._diagonal(component)
        off = _off(component, function, diagonal, part(step, 0.7, 1))
        own = diagonal + (of_constant - _at_zero(function)) / areas.sum()
        # Without a wave near the energy there is nothing, and nothing is accurate.
        with np.errstate(all="ignore"):
            share = off.max() / own.max()
            if not of_constant:
                total = areas @ own
                share += areas @ off / abs(total)
                own = own / total
                component.resolvents.release(function.poles)
        accuracy = float(np.maximum(accuracy, share))
        values[component.vertices] = own
    return _signature(laplacian, values, accuracy, label, -2.0)


def _at_zero(function: RationalFunction) -> float:
    """Return the value at 0 of a sum over poles, which is the weight of the constant."""
    parts = (1 + (pole.imag != 0) for pole in function.poles)
    pairs = zip(parts, function.weights, function.poles, strict=True)
    return float(sum(count * (weight / -pole).real for count, weight, pole in pairs))


def _off(component: Component, function: RationalFunction, diagonal: FloatArray, progress: Progress) -> FloatArray:
    """Return (m,) by how much a diagonal may be off: by the function's own error, and by rounding, at some vertices."""
    total, u = float(component.areas.sum()), component.u
    green = component.green_diagonal() - 2 * u / total + component.areas @ u / total**2
    off = function.off(diagonal, biharmonic_squares(component), np.maximum(green, 0))
    perturbation = Perturbation(component)
    at = np.unique([*perturbation.flattest, *perturbation.shortest, diagonal.argmax(), diagonal.argmin()])
    columns, moved = columns_and_moves(component, function, at, component.solve(unit_columns(len(green), at)), progress)
    rounded = np.abs(columns[at, np.arange(len(at))] - diagonal[at]).max()
    off += SEEN * rounded + SAFETY_FACTOR * moved.max()
    return off


def _signature(laplacian: Laplacian, values: FloatArray, accuracy: float, label: str, length_power: float) -> Signature:
    if not accuracy <= POOR_ACCURACY:
        raise SolverError(
            f"The {label} on {laplacian.surface.name} may be off by more than {POOR_ACCURACY:.0e} of its maximum, so "
            "it is not given."
        )
    values.flags.writeable = False
    length_power -= laplacian.surface.dimension - 2  # squares of eigenfunctions, which are normalised by volume there
    label += laplacian.operator_words
    return Signature(values, accuracy, label, length_power, unit_of(length_power, laplacian.surface))
