"""The commute-time distance, exact on the mesh (paper, Eqs. 2 and 3; it has no continuous counterpart)."""

import numpy as np

from .distance import Distance, root
from .laplacian import Component, Laplacian
from .progress import Progress
from .surface import Surface


class CommuteTimeDistance(Distance):
    """d(i, j)^2 = G_ii + G_jj - 2 G_ij with the Green's function G of the stiffness matrix; no unit."""

    label = "commute-time, exact"
    length_power = 0.0

    def __init__(self, laplacian: Laplacian | Surface, progress: Progress | None = None) -> None:
        super().__init__(laplacian)
        self.prepare(self.laplacian.components[0], progress)

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        component.factor(progress, diagonals=True)

    def _columns(self, component: Component, index: np.ndarray, progress: Progress | None) -> np.ndarray:
        diagonal = component.green_diagonal()
        b = np.zeros((len(diagonal), len(index)))
        b[index, np.arange(len(index))] = 1
        squares = diagonal[:, None] + diagonal[index] - 2 * component.solve(b)
        return root(squares, diagonal.max())
