"""The commute-time distance, exact on the mesh (paper, Eqs. 2 and 3; it has no continuous counterpart)."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray, IntArray, unit_columns
from ..laplacian import Component
from ..progress import Progress, part
from .accuracy import accuracy_of_resistances
from .distance import FactoredDistance
from .squares import root

NEAR = 0.4
"""Below this fraction of the maximum it shows what springs of degenerate faces lack (a fraction FLAT of the square)."""
MOST_NEAR, MOST_SPRINGS = 128, 256
"""So many distances are corrected at most, with so many springs: many more lie so near only where all are far apart."""


class CommuteTimeDistance(FactoredDistance):
    """The exact commute-time distance, with all eigenpairs; no unit.

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
    d(i, j)^2 = G_ii + G_jj - 2 G_ij with the Green's function G of the stiffness matrix (paper, Eqs. 2 and 3).  On ever
    finer meshes of one surface it grows without limit.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> for nsub in (2, 3, 4):  # grows with every refinement: on a surface it has no limit
    ...     distance = bihdist.CommuteTimeDistance(pyvista.Icosphere(nsub=nsub))
    ...     print(f"{distance.between(0, 1):.3f}")
    1.081
    1.184
    1.277
    """

    label = "commute-time, exact"
    length_power = 0.0

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Factor the stiffness matrix of a component, with the inverse's diagonal, if that is not done.

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
        >>> distance = bihdist.CommuteTimeDistance(both)  # prepared on the larger component
        >>> distance.prepare(distance.laplacian.components[1])
        >>> round(distance.between(162, 163), 3)
        0.974
        """
        component.factor(progress, diagonals=True)

    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        diagonal = component.green_diagonal()
        b = unit_columns(len(diagonal), index)
        solved = 0.5 if component.flat.lack.any() else 1.0
        squares = diagonal[:, None] + diagonal[index] - 2 * component.solve(b, part(progress, 0, solved))
        distances = root(squares, diagonal.max())
        if solved < 1:
            for column, source in enumerate(index):
                done = solved + (1 - solved) * column / len(index)
                step = part(progress, done, done + (1 - solved) / len(index))
                self._with_exact_springs(component, int(source), distances[:, column], step)
        return distances

    def _with_exact_springs(self, component: Component, source: int, field: FloatArray, progress: Progress) -> None:
        """Put exact springs in place for the smallest distances (m,), where those of degenerate faces show most.

        By the formula of Sherman, Morrison and Woodbury, as G with few springs more.
        """
        near = np.flatnonzero(field < NEAR * field.max())
        near = near[near != source]
        near = near[np.argsort(field[near], kind="stable")[:MOST_NEAR]]
        touches = np.isin(component.flat.vertices, np.append(near, source)).any(axis=0)
        beside = np.flatnonzero(touches & (component.flat.lack > 0))[:MOST_SPRINGS]
        if not (len(near) and len(beside)):
            return
        g, slack = component.flat.select(beside).missing_springs()
        b = np.zeros((len(field), len(near)))
        b[source] = 1
        b[near, np.arange(len(near))] = -1
        y, by_springs = component.solve(b, part(progress, 0, 0.5)), component.solve(g, part(progress, 0.5, 1))
        moved = g.T @ y
        exact = np.einsum("ij,ij->j", b, y) - np.einsum(
            "ij,ij->j", moved, np.linalg.lstsq(np.diag(slack) + g.T @ by_springs, moved, rcond=None)[0]
        )
        field[near] = np.sqrt(np.maximum(exact, 0))

    def _at_edges(self, component: Component, progress: Progress) -> FloatArray:
        return root(component.commute_time_squares(), component.green_diagonal().max())

    def _estimated_accuracy(self, component: Component, progress: Progress) -> float:
        return accuracy_of_resistances(component, lambda index: self.compute_columns(component, index, None), NEAR)
