"""Distances that are sums over eigenpairs: d(i, j)^2 = sum_k w_k (phi_k(i) - phi_k(j))^2."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike
from ..progress import Progress, part
from ..scalars import real_number
from ..solver.spectrum import Spectrum
from ..solver.tall import pair_distances, point_distances
from .accuracy import ROUNDED, SPARE, Perturbation, rounded_up
from .distance import Distance
from .solve_errors import SolveErrors
from .tails import Cloud, biharmonic_squares, commute_time_squares, tail_lengths

CLEAR = 1e-3
"""Eigenvalues this far apart, as a share of themselves, are clearly two."""
LOWEST = 8
"""So many eigenpairs from the first on, of which rounding changes the largest share, and among all, are looked at."""


class SpectralDistance(Distance):
    """A distance between points with the coordinates sqrt(w_k) phi_k that stand for the vertices."""

    is_quadratic = True

    def __init__(self, laplacian: Laplacian | MeshLike) -> None:
        super().__init__(laplacian)
        self._points: Memo[int, FloatArray] = Memo()

    @abstractmethod
    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, FloatArray]:
        """Eigenpairs of a component, one more than are used if there is one, and the weights (k,) of those used."""

    @abstractmethod
    def _slopes(self, eigenvalues: FloatArray) -> FloatArray:
        """(k,) by what share a weight changes at most, over the share by which the eigenvalues change."""

    @abstractmethod
    def _left_out(self, component: Component, next_value: float, tails: FloatArray) -> FloatArray:
        """(m,) bounds on the lengths of the coordinates that the sum should have beside those used.

        next_value: the first eigenvalue not used, or less; tails (m,): the lengths of what is left of 1 / lambda^2.
        """

    def _is_cut(self) -> bool:
        """Whether weights end at once, so that it matters which eigenpairs are the first."""
        return False

    def points(self, component: Component, progress: Progress | None = None) -> FloatArray:
        """(m, k) the points that stand for a component's vertices."""
        if component.index not in self._points:
            spectrum, weights = self._weighted(component, progress)
            self._points[component.index] = spectrum.eigenvectors[:, : len(weights)] * np.sqrt(weights)
        return self._points[component.index]

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Compute the eigenpairs of a component, if that is not done."""
        self.points(component, progress)

    def _columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        points = self.points(component)
        return point_distances(points, points[index], progress)

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        points = self.points(component)[index]
        return point_distances(points, points, progress)

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        return pair_distances(self.points(component), i, j, progress)

    def _estimated_accuracy(self, component: Component) -> float:
        left_out = self._left_out(component, self._next(component), self._tails(component))
        return Cloud(component, self.points(component)).worst(left_out, self._errors(component))

    def _next(self, component: Component) -> float:
        """The first eigenvalue not used, less what it may be wrong by; infinite if there is none."""
        spectrum, weights = self._weighted(component, None)
        if len(weights) == component.most_eigenpairs:
            return np.inf
        return float(spectrum.eigenvalues[len(weights)] * (1 - spectrum.residuals[len(weights)]))

    def _tails(self, component: Component) -> FloatArray:
        """(m,) bounds on the lengths of all phi_k / lambda_k not used."""
        spectrum, weights = self._weighted(component, None)
        count = len(weights)
        if count == component.most_eigenpairs:
            return np.zeros(len(component.areas))
        vectors, values = spectrum.eigenvectors[:, :count], spectrum.eigenvalues[:count]
        # Residuals are orthogonal to what is used, so that they take from the tails in proportion to these.
        slack = 2 * np.abs(vectors) @ (spectrum.residuals[:count] / values)
        return tail_lengths(biharmonic_squares(component), vectors, 1 / values) + slack

    def _errors(self, component: Component) -> FloatArray:
        """(m,) lengths: for what is wrong with the eigenpairs used, distances are off by at most the sum of two.

        The coordinates are g(Delta) delta_x, with g^2 the weights; those computed are Q g(Lambda) Q^T delta_x.  With R
        = Delta Q - Q Lambda, which is orthogonal to Q, the difference is, to first order in R,
        - g(Delta) (1 - Q Q^T) delta_x, which is left out and not counted here;
        - in the complement, sum_k phi_k(x) g[lambda_k, Delta] r_k, where the divided differences of g are at most
          g_k min(1 / gap, the steepness of g);
        - within Q, the values of g[lambda_k, Delta] r_k at x, each at most its Laplacian's norm times the tail at x.
        What the factor's rounding does to single vertices is added.
        """
        spectrum, weights = self._weighted(component, None)
        count, root = len(weights), np.sqrt(weights)
        values, vectors = spectrum.eigenvalues[:count], spectrum.eigenvectors[:, :count]
        change, missed, off = self._inaccuracies(component, spectrum, root)
        next_value, tails = self._next(component), self._tails(component)
        turned = missed * values / np.maximum(next_value - values, 1e-300)
        turned = np.minimum(turned, 1 if self._is_cut() else missed * self._slopes(values) / 2)
        errors = np.abs(vectors) @ (root * turned)
        errors += tails * np.linalg.norm(root * values * (missed + turned))
        return off + errors + np.sqrt(vectors**2 @ (weights * (self._slopes(values) * change / 2) ** 2))

    def _inaccuracies(
        self, component: Component, spectrum: Spectrum, root: FloatArray
    ) -> tuple[float, FloatArray, FloatArray]:
        """By what share rounding and degenerate faces change the eigenvalues; the residuals (count,) with that; and
        (m,) by how much they displace vertices, those without an area too, which no residual measures.

        root: (count,) of the weights.
        """
        count = len(root)
        values, residuals = spectrum.eigenvalues[:count], spectrum.residuals[:count]
        perturbation = Perturbation(component)
        few = np.unique([*range(min(LOWEST, count)), *np.linspace(0, count - 1, LOWEST, dtype=int)])
        some = spectrum.eigenvectors[:, few]
        # Beside degenerate faces residuals are large by rounding, and stiff: G makes little of them.
        loads = component.areas[:, None] * some * values[few]
        again = component.centred(component.solve(loads))
        missed = np.sqrt(component.areas @ (again - some) ** 2)
        # What rounding makes of the energy of eigenvectors, and the factor of their values, differs by this.
        differ = np.abs(np.einsum("ij,i,ij->j", some, component.areas, again) - 1)
        change = float((sum(perturbation.of(some, some)) / values[few] + SPARE * differ).max())
        seen = SPARE * float((missed / np.maximum(residuals[few], 1e-300)).max())
        off = component.centred(SolveErrors(component, ROUNDED).off(loads))
        return change, residuals * min(1.0, seen) + change, SPARE * np.linalg.norm(root[few] * off, axis=1)


class PowerDistance(SpectralDistance):
    """The family of distances with weights 1 / lambda^alpha, from the first k eigenpairs.

    See section 6 of the paper.

    alpha > 1 (else the sum diverges on a surface); scales like length ** (alpha - 1).  A component with fewer than
    k + 1 vertices uses all its eigenpairs.  Raises ParameterError for another alpha, and if no component has k of them.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> for alpha in (1.5, 2, 3):
    ...     distance = bihdist.PowerDistance(sphere, alpha, k=60)
    ...     print(alpha, distance.length_power, round(distance.between(0, 1), 3))
    1.5 0.5 0.605
    2 1.0 0.462
    3 2.0 0.303
    """

    def __init__(
        self, laplacian: Laplacian | MeshLike, alpha: float = 1.5, k: int = 200, progress: Progress | None = None
    ) -> None:
        if not 1 < real_number(alpha, "alpha") < np.inf:
            raise ParameterError(f"alpha is {alpha:g}; the sum of 1 / lambda^alpha needs alpha > 1.")
        super().__init__(laplacian)
        self.alpha, self.k = float(alpha), checked_count(k)
        self.laplacian.check_eigenpairs(self.k, int(self.laplacian.eigenpair_counts.max()))
        self.label = f"1/λ^{alpha:g}, {self.k:,} eigenpairs"
        self.length_power = self.alpha - 1
        self.prepare(self.laplacian.components[0], progress)

    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, FloatArray]:
        # With the diagonal of C, which tells what is left out; one more tells how clearly those used are set off.
        component.check_room_for(self.k + 1)
        factored = component.share_of_factor(self.k + 1)
        component.factor(part(progress, 0, factored), diagonals=True)
        spectrum = component.spectrum(self.k + 1, part(progress, factored, 1))
        return spectrum, spectrum.eigenvalues[: self.k] ** -self.alpha

    def _slopes(self, eigenvalues: FloatArray) -> FloatArray:
        return np.full(len(eigenvalues), self.alpha)

    def _remedy(self, components: Sequence[int]) -> str:
        for component in (self.laplacian.components[index] for index in components):
            values = component.spectrum(self.k + 1).eigenvalues[: self.k + 1]
            gaps = np.diff(values) / values[1:]
            if len(values) > self.k and gaps[-1] < CLEAR:
                clear = np.flatnonzero(gaps >= CLEAR) + 1
                choose = f"; choose another k, such as {clear[-1]}" if len(clear) else ""
                return (
                    f"Eigenvalues {self.k} and {self.k + 1} differ by {gaps[-1]:.0e} of themselves only, so that it is "
                    f"open which eigenpairs are the first {self.k}{choose}."
                )
        return super()._remedy(components)

    def beyond(self, components: Sequence[int] | None = None) -> float:
        """How far a field may be from the sum of all eigenpairs, as a fraction of its maximum: a proven bound.

        components: their numbers; those that were asked about if there are none.  The sum of all is the biharmonic
        distance for alpha = 2.

        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> [round(bihdist.PowerDistance(sphere, 2.0, k).beyond(), 2) for k in (10, 100)]
        [1.21, 0.09]
        """
        shares = []
        for index in self._those(components):
            component = self.laplacian.components[index]
            tails, next_value = self._tails(component), self._next(component)
            if next_value == np.inf:
                left_out = np.zeros(len(tails))
            elif self.alpha < 2:
                # Hoelder: the sum of 1 / lambda^alpha lies between those of 1 / lambda and 1 / lambda^2.
                spectrum, weights = self._weighted(component, None)
                vectors, values = spectrum.eigenvectors[:, : len(weights)], spectrum.eigenvalues[: len(weights)]
                slower = tail_lengths(commute_time_squares(component), vectors, values**-0.5)
                left_out = slower ** (2 - self.alpha) * tails ** (self.alpha - 1)
            else:
                left_out = next_value ** (1 - self.alpha / 2) * tails
            shares.append(Cloud(component, self.points(component)).worst(left_out, self._errors(component)))
        return max(shares)

    def _said_of(self, accuracy: float, components: Sequence[int]) -> str:
        sentence = super()._said_of(accuracy, components)
        if all(self.k >= self.laplacian.components[index].most_eigenpairs for index in components):
            return sentence
        with np.errstate(all="ignore"):
            beyond = rounded_up(self.beyond(components))
        return f"{sentence} as a sum of {self.k:,} eigenpairs; all of them would change it by at most {beyond}"

    def _left_out(self, component: Component, next_value: float, tails: FloatArray) -> FloatArray:
        # What is asked for is the sum of the first.
        return np.zeros(len(tails))

    def _is_cut(self) -> bool:
        return True


class TruncatedBiharmonicDistance(PowerDistance):
    """The biharmonic distance from its first k eigenpairs; unit length.

    d(i, j)^2 = sum_{k <= K} (phi_k(i) - phi_k(j))^2 / lambda_k^2 (paper, Eq. 11).  Its error falls about
    like 1 / k; `BiharmonicDistance` is exact and, for one source, faster.

    >>> import bihdist, pyvista
    >>> laplacian = bihdist.Laplacian(pyvista.Icosphere(nsub=3))
    >>> exact = bihdist.BiharmonicDistance(laplacian).from_source(0)
    >>> for k in (10, 40, 160):
    ...     truncated = bihdist.TruncatedBiharmonicDistance(laplacian, k).from_source(0)
    ...     print(f"{k}: {abs(truncated - exact).max() / exact.max():.3f} of the maximum")
    10: 0.099 of the maximum
    40: 0.047 of the maximum
    160: 0.027 of the maximum
    """

    def __init__(self, laplacian: Laplacian | MeshLike, k: int = 200, progress: Progress | None = None) -> None:
        super().__init__(laplacian, alpha=2.0, k=k, progress=progress)
        self.label = f"biharmonic, {self.k:,} eigenpairs"


def checked_count(k: int) -> int:
    """k as an int; ParameterError unless it is a whole number of at least 1."""
    if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
        raise ParameterError(f"k is {k!r}; the number of eigenpairs must be a whole number of at least 1.")
    return int(k)
