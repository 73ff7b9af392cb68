"""The biharmonic distance, exact (paper, Eqs. 4 and 9)."""

from __future__ import annotations

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray, unit_columns
from ..laplacian import Component
from ..progress import Progress, part
from ..solver.tall import point_distances
from .biharmonic_accuracy import MOST_NEAR, accuracy_of_fields, recomputed_below
from .distance import FactoredDistance
from .embedding import Embedding, biharmonic_embedding
from .pair_questions import by_source
from .squares import root, writer_of_distances

SMALL_SET_VERTICES = 64
PAIRS_PER_FIELD = 1.4
"""For how many pairs a solve each costs as much as a field: 1.4 to 1.9 from 2,500 to 40,000 vertices."""
SWEEP_FRACTION = 0.8
"""The fraction of the progress of fields that the sweep through the factor takes, before such pairs."""


class BiharmonicDistance(FactoredDistance):
    """The exact biharmonic distance, with all eigenpairs; unit length.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose factor distances share; or vertices (n, 3).
    faces : (m, 3) array_like of int, optional
        The faces, if `laplacian` is vertices.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Notes
    -----
    d(i, j)^2 = C_ii + C_jj - 2 C_ij, with the Green's function C of the biharmonic operator (paper, Eqs. 4 and 9).  A
    field is one sweep through the factor; the diagonal of C is computed once, by selected inversion.  Pairs use the
    half-order form, which is free of cancellation: solve L y = e_i - e_j and centre y by area; d is its norm by
    area.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
    >>> distance.from_source(0).shape, round(distance.between(0, 1), 3)
    ((642,), 0.466)
    >>> larger = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3, radius=10))
    >>> round(larger.between(0, 1), 3)  # in the mesh's unit of length
    4.661
    """

    label = "biharmonic, exact"
    length_power = 1.0

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Compute the diagonal of the Green's function on a component, if that is not done.

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
        >>> distance = bihdist.BiharmonicDistance(both)  # prepared on the larger component
        >>> distance.prepare(distance.laplacian.components[1])
        >>> round(distance.between(162, 163), 3)
        0.497
        """
        component.biharmonic_diagonal(progress)

    def embedding(
        self, k: int | None = None, tolerance: float | None = None, progress: Progress | None = None
    ) -> Embedding:
        """Embed the vertices in a Euclidean space, whose distances are biharmonic within a bound.

        Parameters
        ----------
        k : int, optional
            The number of coordinates.
        tolerance : float, optional
            The bound, unit length, instead of `k`.  It falls like 1 / sqrt(k): half of it takes four times as many
            coordinates.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        Embedding
            The points, and the length of what each leaves out.

        Raises
        ------
        ParameterError
            Unless one of `k` and `tolerance` is given and is positive.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> points = distance.embedding(k=20)
        >>> points.points.shape, round(points.bound, 2)
        ((642, 20), 0.15)
        """
        return biharmonic_embedding(self.laplacian, k, tolerance, progress)

    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        diagonal, limit = component.biharmonic_diagonal(), recomputed_below(component) ** 2
        found = np.empty((len(diagonal), len(index)))
        write = writer_of_distances(diagonal, component.u, component.areas.sum(), index, limit, found)
        near = np.zeros(len(index), np.int64)

        def finish(rows: AnyArray, columns: slice, values: FloatArray) -> None:
            near[columns] += write(rows, columns, values)

        component.factor(diagonals=True).each_sandwich_piece(index, finish, part(progress, 0, SWEEP_FRACTION))
        # The source itself is near.
        for column in np.flatnonzero(near > 1):
            field, source = found[:, column], index[column]
            beside = np.flatnonzero(field < np.sqrt(limit))
            beside = beside[beside != source]
            beside = beside[np.argsort(field[beside], kind="stable")[:MOST_NEAR]]
            if len(beside):
                done = SWEEP_FRACTION + (1 - SWEEP_FRACTION) * column / len(index)
                step = part(progress, done, done + (1 - SWEEP_FRACTION) / len(index))
                step(0.0, self.label)
                half = self._points(component, np.append(source, beside), step)
                field[beside] = np.linalg.norm(half[:, 1:] - half[:, :1], axis=0)
        return found

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        if len(index) > SMALL_SET_VERTICES:
            return super()._pairwise(component, index, progress)
        points = self._points(component, index, progress).T
        return point_distances(points, points)

    def _points(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        """Return (m, k) points, in columns, whose distances are those of the local vertices `index` (k,)."""
        return _half_order(component, component.solve(unit_columns(len(component.vertices), index), progress))

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        among, place = np.unique(np.stack([i, j]), return_inverse=True)
        if len(among) <= min(len(i), SMALL_SET_VERTICES):
            return self._pairwise(component, among, progress)[tuple(place.reshape(2, -1))]
        if digits == "field" and PAIRS_PER_FIELD * len(np.unique(by_source(i, j)[0])) < len(i):
            return super()._of_pairs(component, i, j, digits, progress)
        distances = np.empty(len(i))
        for start in range(0, len(i), SMALL_SET_VERTICES):
            some = slice(start, start + SMALL_SET_VERTICES)
            step = part(progress, start / len(i), min(1.0, (start + SMALL_SET_VERTICES) / len(i)))
            step(0.0, self.label)
            b = np.zeros((len(component.vertices), len(i[some])))
            each = np.arange(b.shape[1])
            b[i[some], each] += 1
            b[j[some], each] -= 1
            distances[some] = np.linalg.norm(_half_order(component, component.solve(b, step)), axis=0)
        return distances

    def _at_edges(self, component: Component, progress: Progress) -> FloatArray:
        (i, j), largest = component.edges, component.biharmonic_diagonal().max()
        distances = root(component.biharmonic_squares(), largest)
        near = np.flatnonzero(distances < recomputed_below(component))
        distances[near] = self._of_pairs(component, i[near], j[near], "all", progress)
        return distances

    def _estimated_accuracy(self, component: Component, progress: Progress) -> float:
        return accuracy_of_fields(component)


def _half_order(component: Component, y: FloatArray) -> FloatArray:
    """Return (m, k) A^1/2 (y - mean by area), whose norms are distances."""
    half = component.centred(y)
    half *= np.sqrt(component.areas)[:, None]
    return half
