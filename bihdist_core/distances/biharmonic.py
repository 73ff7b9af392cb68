"""The biharmonic distance, exact (paper, Eqs. 4 and 9)."""

from __future__ import annotations

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..laplacian import Component
from ..progress import Progress, part
from ..solver.tall import point_distances
from ..surface import FLAT
from .accuracy import accuracy_of_pairs
from .embedding import Embedding, biharmonic_embedding
from .factored import FactoredDistance
from .green_columns import writer_of_distances
from .pair_questions import by_source

SMALL_SET = 64
PAIRS_PER_FIELD = 1.4
"""For how many pairs a solve each costs as much as a field: 1.4 to 1.9 from 2,500 to 40,000 vertices."""
NEAR, NEAR_BY_HEIGHT, MOST_NEAR = 1e-5, 1e-9, 16
"""Distances below this fraction of the maximum, or, on a mesh with thin faces, the second over the height of the
thinnest, are computed again as pairs, up to so many of them: there a difference of the Green's function has few digits
left."""
SWEEP = 0.8
"""What share of the progress of fields the sweep through the factor is, before such pairs."""


class BiharmonicDistance(FactoredDistance):
    """The exact biharmonic distance, with all eigenpairs; unit length.

    d(i, j)^2 = C_ii + C_jj - 2 C_ij, with the Green's function C of the biharmonic operator (paper, Eqs. 4 and 9).  One
    to all costs one sweep through the factor, with the diagonal of C computed once by selected inversion.  Pairs
    use the half-order form, free of cancellation: solve L y = e_i - e_j, centre y by area, d = |y|_A.

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
        """Points of a Euclidean space whose distances are the biharmonic ones within a bound, for trees and indices.

        k: how many coordinates; tolerance: the bound, unit length, instead.  The bound falls like 1 / sqrt(k): half of
        it takes four times as many coordinates.  Raises ParameterError unless one of the two is given, and for a bad
        number.

        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> points = distance.embedding(k=20)
        >>> points.points.shape, round(points.bound, 2)
        ((642, 20), 0.15)
        """
        return biharmonic_embedding(self.laplacian, k, tolerance, progress)

    def _columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        diagonal = component.biharmonic_diagonal()
        largest, found = diagonal.max(), np.empty((len(diagonal), len(index)))
        limit = max(NEAR, NEAR_BY_HEIGHT / max(component.surface.face_heights.min(), FLAT)) ** 2 * largest
        write = writer_of_distances(diagonal, component.u, component.areas.sum(), index, limit, found)
        near = np.zeros(len(index), np.int64)

        def finish(rows: AnyArray, columns: slice, values: FloatArray) -> None:
            near[columns] += write(rows, columns, values)

        component.factor(diagonals=True).each_sandwich_piece(index, finish, part(progress, 0, SWEEP))
        # The source itself is near.
        for column in np.flatnonzero(near > 1):
            field, source = found[:, column], index[column]
            beside = np.flatnonzero(field < np.sqrt(limit))
            beside = beside[beside != source]
            beside = beside[np.argsort(field[beside], kind="stable")[:MOST_NEAR]]
            if len(beside):
                done = SWEEP + (1 - SWEEP) * column / len(index)
                step = part(progress, done, done + (1 - SWEEP) / len(index))
                step(0.0, self.label)
                field[beside] = self._pairwise(component, np.append(source, beside), step)[0, 1:]
        return found

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        if len(index) > SMALL_SET:
            return super()._pairwise(component, index, progress)
        b = np.zeros((len(component.vertices), len(index)))
        b[index, np.arange(len(index))] = 1
        half = _half_order(component, component.solve(b, progress))
        return point_distances(half.T, half.T)

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        among, place = np.unique(np.stack([i, j]), return_inverse=True)
        if len(among) <= min(len(i), SMALL_SET):
            return self._pairwise(component, among, progress)[tuple(place.reshape(2, -1))]
        if digits == "field" and PAIRS_PER_FIELD * len(np.unique(by_source(i, j)[0])) < len(i):
            return super()._of_pairs(component, i, j, digits, progress)
        distances = np.empty(len(i))
        for start in range(0, len(i), SMALL_SET):
            some = slice(start, start + SMALL_SET)
            step = part(progress, start / len(i), min(1.0, (start + SMALL_SET) / len(i)))
            step(0.0, self.label)
            b = np.zeros((len(component.vertices), len(i[some])))
            each = np.arange(b.shape[1])
            b[i[some], each] += 1
            b[j[some], each] -= 1
            distances[some] = np.linalg.norm(_half_order(component, component.solve(b, step)), axis=0)
        return distances

    def _estimated_accuracy(self, component: Component) -> float:
        def squares(b: FloatArray, y: FloatArray) -> FloatArray:
            half = _half_order(component, y)
            products: FloatArray = np.einsum("ij,ij->j", half, half)
            return products

        def adjoint(y: FloatArray) -> FloatArray:
            return component.solve(component.areas[:, None] * component.centred(y))

        return accuracy_of_pairs(component, lambda index: self._columns(component, index, None), squares, adjoint, 2)


def _half_order(component: Component, y: FloatArray) -> FloatArray:
    """(m, k) A^1/2 (y - mean by area), whose norms are distances."""
    half = component.centred(y)
    half *= np.sqrt(component.areas)[:, None]
    return half
