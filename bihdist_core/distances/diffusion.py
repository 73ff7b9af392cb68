"""The diffusion distance (paper, Eq. 1, with its normalised time t <- t / (2 lambda_1))."""

from __future__ import annotations

from bisect import bisect_left

import numpy as np

from ..arrays import FloatArray
from ..errors import ParameterError
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike
from ..progress import Progress, part
from ..scalars import real_number
from ..solver.spectrum import Spectrum
from ..sources.pieces import pieces_of
from ..sources.source import Source, checked_source
from .spectral import SpectralDistance
from .tails import Cloud, biharmonic_squares, bound_from_pieces, tail_lengths

FIRST_EIGENPAIRS = 16
LONGEST_TIME = 700.0
"""From here on the first weight, exp(-t), is no number any more."""
TOLERANCE, COARSEST_TOLERANCE = 1e-7, 1e-4
"""Of the maximum: how exact distances are if nothing else is asked for, and if that takes too many eigenpairs."""
MOST_EIGENPAIRS = 3000
"""More eigenpairs than this are not computed: at 100,000 vertices they fill 2.4 GB."""
USUAL_EIGENPAIRS = 100
"""For t = 1 on most meshes; progress begins with them."""
EIGENVALUE_STEP = 1.02
"""By what fraction of the largest eigenvalue at a time it is tried how many more would do."""


class DiffusionDistance(SpectralDistance):
    """The diffusion distance at a time t; unit 1 / length.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose eigenpairs distances share.
    t : float
        The normalised time, positive and at most 700: the paper's time is t / (2 lambda_1), with the first eigenvalue
        of the component.
    tolerance : float, optional
        How far a distance of two vertices may be off because eigenpairs are left out, as a fraction of its field's
        maximum; the sum takes as many as are proven to be enough.  None means 1e-7, or where that takes more than 3,000
        eigenpairs what these give, down to 1e-4.  From places in faces, curves and sets it may be more (`bound`).
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Raises
    ------
    ParameterError
        If `t` or `tolerance` is out of range, or needs more than 3,000 eigenpairs.

    Notes
    -----
    d(i, j)^2 = sum_k exp(-t lambda_k / lambda_1) (phi_k(i) - phi_k(j))^2 (paper, Eq. 1).

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> for t in (1, 0.1):
    ...     distance = bihdist.DiffusionDistance(sphere, t=t)
    ...     farthest = distance.from_source(0).max()
    ...     print(f"t = {t}: {distance.pair_count(0)} eigenpairs, farthest {farthest:.3f}")
    t = 1: 48 eigenpairs, farthest 0.599
    t = 0.1: 641 eigenpairs, farthest 1.855
    """

    length_power = -1.0

    def __init__(
        self,
        laplacian: Laplacian | MeshLike,
        t: float = 1.0,
        tolerance: float | None = None,
        progress: Progress | None = None,
    ) -> None:
        if not 0 < real_number(t, "The diffusion time t") <= LONGEST_TIME:
            raise ParameterError(f"The diffusion time t is {t:g}; it must be positive, and at most {LONGEST_TIME:g}.")
        if tolerance is not None and not 0 < real_number(tolerance, "The tolerance") < 1:
            raise ParameterError(f"The tolerance is {tolerance:g}; it must lie between 0 and 1.")
        super().__init__(laplacian)
        self.t, self.tolerance = float(t), TOLERANCE if tolerance is None else float(tolerance)
        self._coarsest = COARSEST_TOLERANCE if tolerance is None else self.tolerance
        self.label = f"diffusion, t = {t:g}"
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
                count = least + bisect_left(range(least, have), True, key=lambda k: trial.share(k) <= self.tolerance)
                if count < have or have == most:
                    return spectrum, count
                needed, at_worst = (min(trial.needed(each), most) for each in (self.tolerance, self._coarsest))
                # From the first few it can only be guessed.
                if at_worst > (have if have >= MOST_EIGENPAIRS else 1.5 * MOST_EIGENPAIRS):
                    raise ParameterError(
                        f"Diffusion with t = {self.t:g} to a tolerance of {self._coarsest:g} needs about "
                        f"{at_worst:.3g} eigenpairs here; at most {MOST_EIGENPAIRS} are computed. Choose a larger t or "
                        "tolerance."
                    )
                if have >= MOST_EIGENPAIRS:
                    return spectrum, have - 1
                # Few meshes need a third batch.
                before, done = done, 0.1 * done + 0.9
                spectrum = component.spectrum(int(min(needed, MOST_EIGENPAIRS)), part(progress, before, done))

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

    def pair_count(self, vertex: int) -> int:
        """Return the number of eigenpairs that the sum has on the component of a vertex.

        Parameters
        ----------
        vertex : int
            A vertex id.

        Returns
        -------
        int
            The number of eigenpairs, without the constant.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> for tolerance in (1e-2, 1e-4):
        ...     print(bihdist.DiffusionDistance(sphere, 1, tolerance).pair_count(0))
        15
        35
        """
        return int(self.points(self.laplacian.component_of(vertex)).shape[1])

    def bound(self, source: Source | str) -> FloatArray:
        """Bound the error of `from_source(source)` that is made by leaving eigenpairs out.

        Parameters
        ----------
        source : int, str or Source
            As of `from_source`.

        Returns
        -------
        (n,) float64 ndarray
            1 / unit length, NaN in other components.

        Raises
        ------
        VertexError, ParameterError
            As of `from_source`.

        Notes
        -----
        With s_x^2 = C_xx - sum_{k <= K} phi_k(x)^2 / lambda_k^2, C centred, and m the largest w lambda^2 there is from
        the first omitted eigenvalue on, at most tail = m (s_x + s_y)^2 is left out of d^2.  So d is too small by at
        most sqrt(d^2 + tail) - d, which is no more than sqrt(tail) and tail / 2 d.

        Of a place in a face with the weights b at the corners, all functions being linear there, what is left out is
        b's combination of that at the corners.  Seen from y it is no longer than sqrt(m) sum b_i (s_i + s_y), where
        y's own weight does not count.  From a curve or a set the distance is that from the nearest place, for which
        the same holds with the largest s.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> distance = bihdist.DiffusionDistance(sphere, t=1, tolerance=1e-3)
        >>> for source in (0, "f12:0.5,0.3"):
        ...     print(bool(distance.bound(source).max() <= 1e-3 * distance.from_source(source).max()))
        True
        True
        """
        pieces = pieces_of(checked_source(source), self.surface)
        bound = np.full(len(self.surface.vertices), np.nan)
        field = self.from_pieces(pieces)
        for component, mine, _ in self._by_component(pieces.corners[:, 0]):
            left_out = self._left_out(component, self._next(component), self._tails(component))
            given = field[component.vertices], component.local(pieces.corners[mine]), pieces.select(mine), left_out
            bound[component.vertices] = bound_from_pieces(self.points(component), *given, np.zeros(len(left_out)))
        return bound


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

    def needed(self, tolerance: float) -> float:
        """Return about how many eigenpairs bring that below a tolerance."""
        have, last = len(self._spectrum.eigenvalues), self._spectrum.eigenvalues[-1]
        tails = self._tails(have - 1)
        # By Weyl's law, lambda_k ~ 4 pi k / area, so that tails fall like lambda^(-1/2).
        steps = bisect_left(
            range(2000),
            True,
            key=lambda k: self._share(tails * EIGENVALUE_STEP ** (-k / 2), last * EIGENVALUE_STEP**k) <= tolerance,
        )
        return 1.05 * have * EIGENVALUE_STEP**steps + 4 if steps else have


def _largest(t: float, eigenvalue: float, first: float) -> float:
    """Return the largest sqrt(weight) lambda of any lambda that is at least an eigenvalue."""
    exponent = max(t * (eigenvalue / first), 2)
    return float(first / t * exponent * np.exp(-exponent / 2))
