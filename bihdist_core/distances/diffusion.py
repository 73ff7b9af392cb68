"""The diffusion distance (paper, Eq. 1, with its normalised time t <- t / (2 lambda_1)).

Few eigenpairs have a weight at large times, and they give it. At others it is a rational function of the Laplacian: the
best approximations of exp(-x) have few poles, and those for some times that lie near each other serve all times between
(see `rational`), so that another time costs no more than other weights.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..expected_time import expected_seconds
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike
from ..progress import Progress, part
from ..scalars import real_number
from ..solver.shifted import COMPLEX, INVERTED
from ..solver.spectrum import Spectrum, eigenpair_work
from ..solver.worker_threads import WORKERS
from ..sources.pieces import Pieces
from .accuracy import Perturbation
from .distance import Distance
from .rational import EXPONENTIAL, RationalFunction, Weight
from .resolvent import ResolventDistance, changes_by_reading, fitted_to
from .spectral import SpectralDistance
from .tails import Cloud, biharmonic_squares, tail_lengths

LABEL = "diffusion, t = {:g}"
FIRST_EIGENPAIRS = 16
LONGEST_TIME = 700.0
"""From here on the first weight, exp(-t), is no number any more."""
TOLERANCE = 1e-7
"""Of the maximum: how exact distances are by eigenpairs."""
LONG_TIME = 2.0
"""From here on eigenpairs are taken: their number is small, and weights fall below the error of rational functions."""
SMALL, MODERATE, FEW = 400, 20_000, 96
"""All eigenpairs of so few vertices are found at once, and of so many vertices so many eigenpairs in half a second;
rounding leaves them more digits of the smallest distances."""
WEIGHED = 32.0
"""Eigenvalues, times t / lambda_1, with a weight that counts."""
WORTH = 2.0
"""By how many times eigenpairs have to be faster to be taken."""
STEP = 4.0
"""Poles for times so many times apart serve all those between."""
SHORTEST = 1e-17
"""Shorter times, times the largest eigenvalue, are none."""
CLOSE = 1e-10
"""The error at which poles serve: that of exp(-x), times x."""
COARSE = 1e-2
"""The same, of poles that serve meanwhile."""
STEEPEST = {power: power**power * np.exp(-power) for power in (2, 3)}
"""The largest x^2 exp(-x) and x^3 exp(-x), by the power."""
MOST_EIGENPAIRS = 3000
"""More eigenpairs than this are not computed: at 100,000 vertices they fill 2.4 GB."""
USUAL_EIGENPAIRS = 100
"""For t = 1 on most meshes; progress begins with them."""
EIGENVALUE_STEP = 1.02
"""By what fraction of the largest eigenvalue at a time it is tried how many more would do."""


class DiffusionDistance(Distance):
    """The diffusion distance at a time t, exact; unit 1 / length.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose eigenpairs and factors distances share.
    t : float
        The normalised time, positive and at most 700: the paper's time is t / (2 lambda_1), with the first eigenvalue
        of the component.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Raises
    ------
    ParameterError
        If `t` is out of range.

    Notes
    -----
    d(i, j)^2 = sum_k exp(-t lambda_k / lambda_1) (phi_k(i) - phi_k(j))^2 (paper, Eq. 1).  Where few eigenpairs have a
    weight they are summed; else the sum of all is a rational function of the Laplacian, whose columns are solves with
    eight shifted matrices, and whose diagonal is that of their inverses.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> for t in (1, 0.1):
    ...     print(f"t = {t}: farthest {bihdist.DiffusionDistance(sphere, t=t).from_source(0).max():.3f}")
    t = 1: farthest 0.599
    t = 0.1: farthest 1.855
    """

    length_power = -1.0
    is_quadratic = True

    def __init__(self, laplacian: Laplacian | MeshLike, t: float = 1.0, progress: Progress | None = None) -> None:
        self.t, self.label = checked_time(t), LABEL.format(t)
        super().__init__(laplacian)
        by_eigenpairs = is_faster_by_eigenpairs(self.laplacian.components[0], self.t, part(progress, 0, 0.3))
        way = EigenpairDiffusion if by_eigenpairs else PoleDiffusion
        self._way: EigenpairDiffusion | PoleDiffusion = way(self.laplacian, self.t, part(progress, 0.3, 1))

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Compute the eigenpairs or factors of a component, if that is not done.

        Parameters
        ----------
        component : Component
            A component of `laplacian`.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> both = pyvista.Icosphere(nsub=2) + pyvista.Icosphere(nsub=1, center=(3, 0, 0))
        >>> distance = bihdist.DiffusionDistance(both)  # prepared on the larger component
        >>> distance.prepare(distance.laplacian.components[1])
        >>> round(distance.between(162, 163), 3)
        0.589
        """
        self._way.prepare(component, progress)

    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        return self._way.compute_columns(component, index, progress)

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        return self._way._pairwise(component, index, progress)

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        return self._way._of_pairs(component, i, j, digits, progress)

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        return self._way._from_pieces(component, pieces, progress)

    def _of_places(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        return self._way._of_places(u, v, progress)

    def _accuracy_of(
        self, components: Sequence[int], pieces: Sequence[Pieces] = (), progress: Progress | None = None
    ) -> float | None:
        return self._way._accuracy_of(components, pieces, progress)

    def has_error_estimate(self, component: int, pieces: Sequence[Pieces] = ()) -> bool:
        return self._way.has_error_estimate(component, pieces)


def checked_time(t: float) -> float:
    """Return a normalised time; ParameterError for one that is out of range."""
    if not 0 < real_number(t, "The diffusion time t") <= LONGEST_TIME:
        raise ParameterError(f"The diffusion time t is {t:g}; it must be positive, and at most {LONGEST_TIME:g}.")
    return float(t)


def expected_count(component: Component, t: float) -> int:
    """Return about how many eigenpairs have a weight at a time, rather too many."""
    first, area = float(component.spectrum(1).eigenvalues[0]), float(component.areas.sum())
    # By Weyl's law, as many as 4 pi k / area is less than the largest that counts.
    return int(min(area * first / (4 * np.pi) * (WEIGHED / t), len(component.areas))) + FIRST_EIGENPAIRS


def is_faster_by_eigenpairs(component: Component, t: float, progress: Progress | None) -> bool:
    """Return whether the eigenpairs that have a weight at a time are expected to take less time than poles."""
    component.spectrum(1, progress)
    count, n = expected_count(component, t), len(component.areas)
    there = max(FIRST_EIGENPAIRS, component.eigenpairs_there)
    if t >= LONG_TIME or count <= there or n <= (MODERATE if count <= FEW else SMALL):
        return True
    if served(component, t / float(component.spectrum(1).eigenvalues[0])):
        return False
    eigenpairs = expected_seconds("eigenpairs", eigenpair_work(n, count, component.factor().nbytes), WORKERS)
    multiplications = component.tree().layout.work * len(EXPONENTIAL) * INVERTED * COMPLEX
    # Poles serve other times, too.
    return WORTH * eigenpairs < expected_seconds("factor", multiplications, WORKERS)


def coarse_diffusion(laplacian: Laplacian, t: float) -> Distance | None:
    """Return the diffusion distance at a time t as well as what is there already gives it at once; None if there is
    nothing to begin with, or no need."""
    component = laplacian.components[0]
    if not component.eigenpairs_there or t >= LONG_TIME or expected_count(component, t) <= component.eigenpairs_there:
        return None
    if served(component, t / float(component.spectrum(1).eigenvalues[0])):
        return None
    coarse = CoarseDiffusion(laplacian, t) if component.resolvents.sets else None
    return coarse if coarse is not None and coarse.is_fit else FewEigenpairs(laplacian, t)


class PoleDiffusion(ResolventDistance):
    """The diffusion distance at a time t by a rational function of the Laplacian; see `DiffusionDistance`."""

    length_power = -1.0

    def __init__(self, laplacian: Laplacian, t: float, progress: Progress | None = None) -> None:
        self.t, self.label = t, LABEL.format(t)
        super().__init__(laplacian, progress)

    def _weight(self, component: Component) -> Weight:
        return exponential(self._time(component))

    def _time(self, component: Component) -> float:
        """Return the time in the units of 1 / lambda, or one as short on this spectrum."""
        return max(self.t / float(component.spectrum(1).eigenvalues[0]), SHORTEST / component.largest_eigenvalue)

    def _function(self, component: Component, progress: Progress | None) -> RationalFunction:
        time = self._time(component)
        function = served(component, time)
        while function is None:
            next_one = next_time(component, time)
            component.resolvents.add(tuple(z / next_one for z in EXPONENTIAL), progress)
            function = served(component, time)
        return function

    def _bounded(self, component: Component) -> RationalFunction:
        # What the first eigenvalue is off by scales the time.
        function, time = self._rational(component), self._time(component)
        first, vector = 1 / (time / self.t), component.spectrum(1).eigenvectors[:, :1]
        rounding, springs = Perturbation(component).of(vector)
        change = float((rounding + springs)[0]) / first
        for stiffness, areas in changes_by_reading(component):
            change += abs(float(vector[:, 0] @ (stiffness @ vector[:, 0] - first * areas * vector[:, 0]))) / first
        by_either = [change * STEEPEST[3] / time**2, 0], [0, change * STEEPEST[2] / time]
        return replace(function, bounds=np.concatenate([function.bounds + each for each in by_either]))


class CoarseDiffusion(PoleDiffusion):
    """The diffusion distance at a time t by poles for other times."""

    def __init__(self, laplacian: Laplacian, t: float) -> None:
        super().__init__(laplacian, t)
        self.label += ", coarse"

    def _function(self, component: Component, progress: Progress | None) -> RationalFunction:
        time = self._time(component)
        poles = [pole for some in sets_there(component).values() for pole in some]
        return fitted_to(component, exponential(time), poles, lambda x: 1 / (1 / time + x))

    @property
    def is_fit(self) -> bool:
        """Whether the poles give more than a few eigenpairs would."""
        component = self.laplacian.components[0]
        return bool(self._time(component) * self._rational(component).bounds[0, 1] < COARSE)


def exponential(time: float) -> Weight:
    """Return exp(-time x)."""

    def f(x: FloatArray) -> FloatArray:
        weights: FloatArray = np.exp(-time * x)
        return weights

    return f


def sets_there(component: Component) -> dict[float, tuple[complex, ...]]:
    """Return the poles that a component has for some times, in the units of 1 / lambda."""
    sets = [poles for poles in component.resolvents.sets if len(poles) == len(EXPONENTIAL)]
    pairs = [((EXPONENTIAL[0] / poles[0]).real, poles) for poles in sets]
    return {time: poles for time, poles in pairs if np.allclose(np.array(poles) * time, EXPONENTIAL)}


def next_time(component: Component, time: float) -> float:
    """Return the time for which poles are to be added to serve a time: itself, or so that all between are served,
    too."""
    there = np.array(list(sets_there(component)))
    steps = np.log(time / there) / np.log(STEP)
    if not len(there) or np.abs(steps).min() > 1 or np.abs(steps).min() < 1e-6:
        return time
    nearest = int(np.abs(steps).argmin())
    return float(there[nearest] * STEP ** np.sign(steps[nearest]))


def served(component: Component, time: float) -> RationalFunction | None:
    """Return the function for a time by the poles that there are; None if they do not serve it."""
    sets = sets_there(component)
    poles = [pole for each, some in sets.items() if abs(np.log(time / each)) <= 1.01 * np.log(STEP) for pole in some]
    function = fitted_to(component, exponential(time), poles, lambda x: 1 / (1 / time + x))
    return function if poles and time * function.bounds[0, 1] <= CLOSE else None


class EigenpairDiffusion(SpectralDistance):
    """The diffusion distance at a time t by as many eigenpairs as are proven to be enough; see `DiffusionDistance`."""

    length_power = -1.0

    def __init__(
        self,
        laplacian: Laplacian | MeshLike,
        t: float = 1.0,
        progress: Progress | None = None,
    ) -> None:
        super().__init__(laplacian)
        self.t, self.label = t, LABEL.format(t)
        self._used: Memo[int, tuple[Spectrum, FloatArray]] = Memo()
        self.prepare(self.laplacian.components[0], progress)

    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, FloatArray]:
        if component.index not in self._used:
            # With the diagonal of C, which tells what is left out.
            component.check_room_for(FIRST_EIGENPAIRS)
            factored = component.share_of_factor(USUAL_EIGENPAIRS)
            component.factor(part(progress, 0, factored), diagonals=True)
            spectrum, count = self._enough(component, part(progress, factored, 1))
            self._used[component.index] = spectrum, self._roots(spectrum.eigenvalues)[:count] ** 2
        return self._used[component.index]

    def _enough(self, component: Component, progress: Progress) -> tuple[Spectrum, int]:
        """Eigenpairs, and how many of them are proven to be enough; at least the first batch, which is there anyway."""
        most, least = component.most_eigenpairs, FIRST_EIGENPAIRS - 1
        done = 0.2
        spectrum = component.spectrum(FIRST_EIGENPAIRS, part(progress, 0, done))
        if most <= FIRST_EIGENPAIRS:
            return spectrum, most
        cloud = Cloud(component, spectrum.eigenvectors[:, :least] * self._roots(spectrum.eigenvalues)[:least])
        # Where numbers end, the estimate of the accuracy says so.
        with np.errstate(all="ignore"):
            while True:
                have = len(spectrum.eigenvalues)
                trial = _Trial(component, spectrum, cloud, self.t)
                count = least + bisect_left(range(least, have), True, key=lambda k: trial.share(k) <= TOLERANCE)
                if count < have or have == most:
                    return spectrum, count
                needed = min(trial.needed(), most)
                if needed > MOST_EIGENPAIRS:
                    raise ParameterError(
                        f"Diffusion with t = {self.t:g} needs about {needed:.3g} eigenpairs here; at most "
                        f"{MOST_EIGENPAIRS} are computed. Choose a larger t."
                    )
                # Few meshes need a third batch.
                before, done = done, 0.1 * done + 0.9
                spectrum = component.spectrum(int(needed), part(progress, before, done))

    def _roots(self, eigenvalues: FloatArray) -> FloatArray:
        """Return (k,) the roots of the weights."""
        roots: FloatArray = np.exp(-self.t / 2 * (eigenvalues / eigenvalues[0]))
        return roots

    def _slopes(self, eigenvalues: FloatArray) -> FloatArray:
        # The weights depend on the first eigenvalue too.
        slopes: FloatArray = 2 * self.t * eigenvalues / eigenvalues[0]
        return slopes

    def _left_out(self, component: Component, next_value: float, tails: FloatArray) -> FloatArray:
        if next_value == np.inf:
            return np.zeros(len(tails))
        return _largest(self.t, next_value, component.spectrum(1).eigenvalues[0]) * tails


class FewEigenpairs(EigenpairDiffusion):
    """The diffusion distance at a time t by the eigenpairs that are there."""

    def __init__(self, laplacian: Laplacian, t: float) -> None:
        super().__init__(laplacian, t)
        self.label += ", coarse"

    def _enough(self, component: Component, progress: Progress) -> tuple[Spectrum, int]:
        spectrum = component.spectrum(FIRST_EIGENPAIRS)
        return spectrum, len(spectrum.eigenvalues)


class _Trial:
    """The error of leaving out all but some eigenpairs; `cloud` is the points of the first, which tell vertices
    apart."""

    def __init__(self, component: Component, spectrum: Spectrum, cloud: Cloud, t: float) -> None:
        self._squares = biharmonic_squares(component)
        self._spectrum, self._cloud, self._t = spectrum, cloud, t

    def _tails(self, count: int) -> FloatArray:
        vectors, values = self._spectrum.eigenvectors[:, :count], self._spectrum.eigenvalues[:count]
        return tail_lengths(self._squares, vectors, 1 / values)

    def _share(self, tails: FloatArray, next_value: float) -> float:
        return self._cloud.worst(_largest(self._t, next_value, self._spectrum.eigenvalues[0]) * tails)

    def share(self, count: int) -> float:
        """Return the fraction of a field's maximum that its distances may be off with so many eigenpairs."""
        return self._share(self._tails(count), self._spectrum.eigenvalues[count])

    def needed(self) -> float:
        """Return about how many eigenpairs bring that below the tolerance."""
        have, last = len(self._spectrum.eigenvalues), self._spectrum.eigenvalues[-1]
        tails = self._tails(have - 1)
        # By Weyl's law, lambda_k ~ 4 pi k / area, so that tails fall like lambda^(-1/2).
        steps = bisect_left(
            range(2000),
            True,
            key=lambda k: self._share(tails * EIGENVALUE_STEP ** (-k / 2), last * EIGENVALUE_STEP**k) <= TOLERANCE,
        )
        return 1.05 * have * EIGENVALUE_STEP**steps + 4 if steps else have


def _largest(t: float, eigenvalue: float, first: float) -> float:
    """Return the largest sqrt(weight) lambda of any lambda that is at least an eigenvalue."""
    exponent = max(t * (eigenvalue / first), 2)
    return float(first / t * exponent * np.exp(-exponent / 2))
