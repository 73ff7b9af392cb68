"""The biharmonic distance, exact (paper, Eqs. 4 and 9)."""

import numpy as np

from .distance import Distance, root
from .laplacian import Component, Laplacian
from .progress import Progress
from .surface import Surface
from .tall import point_distances

SMALL_SET = 64


class BiharmonicDistance(Distance):
    """d(i, j)^2 = C_ii + C_jj - 2 C_ij with the Green's function C of the biharmonic operator; unit length.

    One to all costs one sweep through the factor, with the diagonal of C computed once by selected inversion.  Pairs
    use the half-order form, free of cancellation: solve L y = e_i - e_j, centre y by area, d = |y|_A.
    """

    label = "biharmonic, exact"
    length_power = 1.0

    def __init__(self, laplacian: Laplacian | Surface, progress: Progress | None = None) -> None:
        super().__init__(laplacian)
        self.prepare(self.laplacian.components[0], progress)

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        component.biharmonic_diagonal(progress)

    def _columns(self, component: Component, index: np.ndarray, progress: Progress | None) -> np.ndarray:
        diagonal = component.biharmonic_diagonal()
        distances, largest = np.empty((len(diagonal), len(index))), diagonal.max()

        def finish(rows: np.ndarray, columns: slice, values: np.ndarray) -> None:
            values *= -2
            values += diagonal[rows, None]
            values += diagonal[index[columns]]
            distances[rows, columns] = root(values, largest)

        component.each_biharmonic_piece(index, finish)
        return distances

    def _pairwise(self, component: Component, index: np.ndarray) -> np.ndarray:
        b = np.zeros((len(component.vertices), len(index)))
        b[index, np.arange(len(index))] = 1
        half = component.centred(component.solve(b)) * np.sqrt(component.areas)[:, None]
        if len(index) <= SMALL_SET:
            return point_distances(half.T, half.T)
        green = half.T @ half
        squares = np.diag(green) + np.diag(green)[:, None] - 2 * green
        return root(squares, green.max())
