"""Distances that are sums over eigenpairs: d(i, j)^2 = sum_k w_k (phi_k(i) - phi_k(j))^2."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike
from ..progress import Progress, part
from ..solver.spectrum import Spectrum
from ..solver.tall import pair_distances, point_distances
from ..sources.pieces import Pieces
from .accuracy import RELATIVE_ROUNDING, SAFETY_FACTOR, Perturbation, SolveErrors, rounded_up
from .distance import Distance
from .tails import (
    Cloud,
    biharmonic_squares,
    bound_from_pieces,
    bound_of_pairs,
    tail_lengths,
)

CLEAR_GAP = 1e-3
"""Eigenvalues this far apart, as a share of themselves, are clearly two."""
LOWEST_PAIRS = 8
"""So many eigenpairs from the first on, of which rounding changes the largest share, and among all, are looked at."""

MOST_PENDING = 8
"""Number of fields from places at which their bounds are computed, even if the accuracy is not asked for."""

Bound = Callable[[FloatArray, FloatArray], float]
"""From bounds (m,) on the lengths that coordinates lack and are displaced by, a fraction by which something is off."""


class SpectralDistance(Distance):
    """A distance between points with the coordinates sqrt(w_k) phi_k that stand for the vertices."""

    is_quadratic = True

    def __init__(self, laplacian: Laplacian | MeshLike) -> None:
        super().__init__(laplacian)
        self._points: Memo[int, FloatArray] = Memo()
        self._lengths: Memo[int, tuple[FloatArray, FloatArray]] = Memo()
        self._asked_off: Memo[int, float] = Memo()
        self._pending: Memo[int, list[Bound]] = Memo()

    @abstractmethod
    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, FloatArray]:
        """Eigenpairs of a component, one more than are used if there is one, and the weights (k,) of those used."""

    @abstractmethod
    def _slopes(self, eigenvalues: FloatArray) -> FloatArray:
        """Return (k,) by what share a weight changes at most, over the share by which the eigenvalues change."""

    @abstractmethod
    def _left_out(self, component: Component, next_value: float, tails: FloatArray) -> FloatArray:
        """Return (m,) bounds on the lengths of the coordinates that the sum should have beside those used.

        `next_value` is the first eigenvalue not used, or less; `tails` (m,) are the lengths of the rest
        of 1 / lambda^2.
        """

    def _is_cut(self) -> bool:
        """Return whether weights end at once, so that it matters which eigenpairs are the first."""
        return False

    def points(self, component: Component, progress: Progress | None = None) -> FloatArray:
        """Return the points that stand for a component's vertices: the eigenvectors times the roots of their weights.

        Parameters
        ----------
        component : Component
            A component of `laplacian`, with m vertices.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (m, k) float64 ndarray
            Distances are those of these points, in the distance's unit.
        """
        if component.index not in self._points:
            spectrum, weights = self._weighted(component, progress)
            self._points[component.index] = spectrum.eigenvectors[:, : len(weights)] * np.sqrt(weights)
        return self._points[component.index]

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Compute the eigenpairs of a component, if that is not done.

        Parameters
        ----------
        component : Component
            A component of `laplacian`.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        """
        self.points(component, progress)

    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        points = self.points(component)
        return point_distances(points, points[index], progress)

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        points = self.points(component)[index]
        return point_distances(points, points, progress)

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        return pair_distances(self.points(component), i, j, progress)

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        field = super()._from_pieces(component, pieces, progress)
        self._note(component, partial(self._off_from, component, pieces, field))
        return field

    def _of_places(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        found = super()._of_places(u, v, progress)
        corners = np.concatenate([u.corners, v.corners], axis=1)
        for component, mine, _ in self._by_component(u.corners[:, 0]):
            mine = mine[np.isfinite(found[mine])]
            if len(mine):
                weights = np.concatenate([u.start[mine], -v.start[mine]], axis=1)
                given = component, component.local(corners[mine]), weights, found[mine]
                self._note(component, partial(self._off_between, *given))
        return found

    def _note(self, component: Component, off: Bound) -> None:
        """Take into account what does not start from one vertex, as soon as the bounds on coordinates are known."""
        with self._pending.lock:
            self._pending.setdefault(component.index, []).append(off)
            if component.index in self._lengths or len(self._pending[component.index]) == MOST_PENDING:
                self._off_so_far(component)

    def _off_so_far(self, component: Component) -> float:
        """Return by what fraction of its maximum a field was off at most that did not start from one vertex."""
        with self._pending.lock:
            off = [each(*self._lengths_on(component)) for each in self._pending.pop(component.index, [])]
            self._asked_off[component.index] = found = max([0.0, *off, self._asked_off.get(component.index, 0.0)])
            return found

    def _off_between(
        self,
        component: Component,
        corners: IntArray,
        weights: FloatArray,
        distances: FloatArray,
        left_out: FloatArray,
        errors: FloatArray,
    ) -> float:
        """Return by what fraction of a field's maximum distances (k,) of places may be off, see `bound_of_pairs`."""
        bound = bound_of_pairs(corners, weights, distances, left_out, errors)
        # The mean square, by area, of the distances from a place: its own and that of all points.
        points, areas = self.points(component), component.areas
        squares = np.square(np.einsum("kc,kcj->kj", weights[:, :3], points[corners[:, :3]])).sum(axis=1)
        squares += areas @ np.square(points).sum(axis=1) / areas.sum()
        return float((bound / np.sqrt(squares)).max())

    def _off_from(
        self, component: Component, pieces: Pieces, field: FloatArray, left_out: FloatArray, errors: FloatArray
    ) -> float:
        """Return by what fraction of its maximum a field (m,) from some pieces may be off, see `bound_from_pieces`."""
        top = float(field.max())
        if not top > 0:
            return 0.0
        local = component.local(pieces.corners)
        with np.errstate(all="ignore"):
            bound = bound_from_pieces(self.points(component), field, local, pieces, left_out, errors)
        return float(bound.max() / top)

    def _fields_from(self, pieces: Sequence[Pieces]) -> Iterator[tuple[Component, Pieces, FloatArray]]:
        """Yield the components that sources have a part in, with these parts, and their fields (m,)."""
        for each in pieces:
            for component, mine, _ in self._by_component(each.corners[:, 0]):
                some = each.select(mine)
                yield component, some, super()._from_pieces(component, some, None)

    def _accuracy_of(
        self, components: Sequence[int], pieces: Sequence[Pieces] = (), progress: Progress | None = None
    ) -> float | None:
        accuracy = super()._accuracy_of(components, (), progress)
        assert accuracy is not None
        if not pieces:
            return max([accuracy, *(self._off_so_far(self.laplacian.components[index]) for index in components)])
        off = [self._off_from(*given, *self._lengths_on(given[0])) for given in self._fields_from(pieces)]
        return max([accuracy, *off])

    def _lengths_on(self, component: Component) -> tuple[FloatArray, FloatArray]:
        """Return (m,) the lengths of the coordinates that points lack, and by which they may be displaced."""
        if component.index not in self._lengths:
            with np.errstate(all="ignore"):
                left_out = self._left_out(component, self._next(component), self._tails(component))
                self._lengths[component.index] = left_out, self._errors(component)
        return self._lengths[component.index]

    def _estimated_accuracy(self, component: Component, progress: Progress) -> float:
        return Cloud(component, self.points(component)).worst(*self._lengths_on(component))

    def _next(self, component: Component) -> float:
        """Return the first eigenvalue not used, less what it may be wrong by; infinite if there is none."""
        spectrum, weights = self._weighted(component, None)
        if len(weights) == component.most_eigenpairs:
            return np.inf
        return float(spectrum.eigenvalues[len(weights)] * (1 - spectrum.residuals[len(weights)]))

    def _tails(self, component: Component) -> FloatArray:
        """Return (m,) bounds on the lengths of all phi_k / lambda_k not used."""
        spectrum, weights = self._weighted(component, None)
        count = len(weights)
        if count == component.most_eigenpairs:
            return np.zeros(len(component.areas))
        vectors, values = spectrum.eigenvectors[:, :count], spectrum.eigenvalues[:count]
        # Residuals are orthogonal to what is used, so that they take from the tails in proportion to these.
        slack = 2 * np.abs(vectors) @ (spectrum.residuals[:count] / values)
        return tail_lengths(biharmonic_squares(component), vectors, 1 / values) + slack

    def _errors(self, component: Component) -> FloatArray:
        """Return (m,) lengths: for what is wrong with the eigenpairs used, distances are off by at most the sum of two.

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
        """Return by what fraction rounding and degenerate faces change the eigenvalues; the residuals (count,) with
        that; and (m,) by how much they displace vertices, those without an area too, which no residual measures.

        `root` (count,) are the roots of the weights.
        """
        count = len(root)
        values, residuals = spectrum.eigenvalues[:count], spectrum.residuals[:count]
        perturbation = Perturbation(component)
        few = np.unique([*range(min(LOWEST_PAIRS, count)), *np.linspace(0, count - 1, LOWEST_PAIRS, dtype=int)])
        some = spectrum.eigenvectors[:, few]
        # Beside degenerate faces residuals are large by rounding, and stiff: G makes little of them.
        loads = component.areas[:, None] * some * values[few]
        again = component.centred(component.solve(loads))
        missed = np.sqrt(component.areas @ (again - some) ** 2)
        # What rounding makes of the energy of eigenvectors, and the factor of their values, differs by this.
        differ = np.abs(np.einsum("ij,i,ij->j", some, component.areas, again) - 1)
        change = float((sum(perturbation.of(some)) / values[few] + SAFETY_FACTOR * differ).max())
        seen = SAFETY_FACTOR * float((missed / np.maximum(residuals[few], 1e-300)).max())
        off = component.centred(SolveErrors(component, RELATIVE_ROUNDING).off(loads))
        return change, residuals * min(1.0, seen) + change, SAFETY_FACTOR * np.linalg.norm(root[few] * off, axis=1)


class TruncatedBiharmonicDistance(SpectralDistance):
    """The biharmonic distance from its first k eigenpairs; unit length.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose eigenpairs distances share.
    k : int
        The number of eigenpairs; a component with fewer uses all it has.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Notes
    -----
    d(i, j)^2 = sum_{k <= K} (phi_k(i) - phi_k(j))^2 / lambda_k^2 (paper, Eq. 11).  Its error falls about like 1 / K;
    `BiharmonicDistance` is exact and, for one source, faster.

    Examples
    --------
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

    length_power = 1.0

    def __init__(self, laplacian: Laplacian | MeshLike, k: int = 200, progress: Progress | None = None) -> None:
        super().__init__(laplacian)
        self.k = checked_count(k)
        self.laplacian.check_eigenpairs(self.k, int(self.laplacian.eigenpair_counts.max()))
        self.label = f"biharmonic, {self.k:,} eigenpairs"
        self.prepare(self.laplacian.components[0], progress)

    def _weighted(self, component: Component, progress: Progress | None) -> tuple[Spectrum, FloatArray]:
        # With the diagonal of C, which tells what is left out; one more tells how clearly those used are set off.
        component.check_room_for(self.k + 1)
        factored = component.share_of_factor(self.k + 1)
        component.factor(part(progress, 0, factored), diagonals=True)
        spectrum = component.spectrum(self.k + 1, part(progress, factored, 1))
        return spectrum, spectrum.eigenvalues[: self.k] ** -2

    def _slopes(self, eigenvalues: FloatArray) -> FloatArray:
        return np.full(len(eigenvalues), 2.0)

    def _advice(self, components: Sequence[int]) -> str:
        for component in (self.laplacian.components[index] for index in components):
            values = component.spectrum(self.k + 1).eigenvalues[: self.k + 1]
            gaps = np.diff(values) / values[1:]
            if len(values) > self.k and gaps[-1] < CLEAR_GAP:
                clear = np.flatnonzero(gaps >= CLEAR_GAP) + 1
                choose = f"; choose another k, such as {clear[-1]}" if len(clear) else ""
                return (
                    f"Eigenvalues {self.k} and {self.k + 1} differ by {gaps[-1]:.0e} of themselves only, so it is "
                    f"not clear which eigenpairs are the first {self.k}{choose}."
                )
        return super()._advice(components)

    def beyond(self, components: Sequence[int] | None = None, pieces: Sequence[Pieces] = ()) -> float:
        """Bound how far fields may be from the sum of all eigenpairs, the biharmonic distance.

        Parameters
        ----------
        components : sequence of int, optional
            The components that the fields are on; those that were asked about if None.
        pieces : sequence of Pieces
            What the fields start from, where they do not all start from vertices.

        Returns
        -------
        float
            As a fraction of each field's maximum; a proven bound.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> [round(bihdist.TruncatedBiharmonicDistance(sphere, k).beyond(), 2) for k in (10, 100)]
        [1.21, 0.09]
        """
        shares = []
        fields = list(self._fields_from(pieces))
        for index in self._asked_components(components):
            component = self.laplacian.components[index]
            lengths = self._tails(component), self._lengths_on(component)[1]
            shares.append(Cloud(component, self.points(component)).worst(*lengths))
            shares += [self._off_from(*given, *lengths) for given in fields if given[0] is component]
        return max(shares)

    def _accuracy_text(self, accuracy: float, components: Sequence[int], pieces: Sequence[Pieces] = ()) -> str:
        sentence = super()._accuracy_text(accuracy, components)
        if all(self.k >= self.laplacian.components[index].most_eigenpairs for index in components):
            return sentence
        with np.errstate(all="ignore"):
            beyond = rounded_up(self.beyond(components, pieces))
        return f"{sentence} as a sum of {self.k:,} eigenpairs; all of them would change it by at most {beyond}"

    def _left_out(self, component: Component, next_value: float, tails: FloatArray) -> FloatArray:
        # What is asked for is the sum of the first.
        return np.zeros(len(tails))

    def _is_cut(self) -> bool:
        return True


def checked_count(k: int) -> int:
    """k as an int; ParameterError unless it is a whole number of at least 1."""
    if isinstance(k, bool) or not isinstance(k, (int, np.integer)) or k < 1:
        raise ParameterError(f"k is {k!r}; the number of eigenpairs must be a whole number of at least 1.")
    return int(k)
