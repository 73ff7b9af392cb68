"""The elimination tree: in which order the vertices of a sparse symmetric matrix are eliminated, and in which fronts.

The tree of a nested dissection is the elimination tree.  Each of its nodes is a front, a dense block: it eliminates its
own vertices, its pivots, and touches some vertices of its ancestors, its boundary.
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import breadth_first_order

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..expected_time import Expected
from ..kernel.library import library
from ..progress import Progress
from .compiled_tree import CompiledTree
from .plain import PlainTree
from .worker_threads import WORKERS

LANDMARKS = 12
"""Vertices from which steps are counted, where vertices have no coordinates."""


class EliminationTree:
    """Order and layout for all matrices with one sparsity pattern.

    Parameters
    ----------
    pattern : (n, n) sparse matrix
        Symmetric; only the places of its entries off the diagonal matter.
    coordinates : (n, 3) ndarray
        Finite, used for the ordering only; all the same where there are none, for an order that costs about as much.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Raises
    ------
    ParameterError
        If the shapes do not fit, the pattern is not symmetric or a coordinate is not finite.
    """

    def __init__(self, pattern: sp.spmatrix, coordinates: FloatArray, progress: Progress | None = None) -> None:
        x, matrix = _checked_coordinates(pattern, coordinates), canonical(pattern)
        if len(x) > LANDMARKS and (x == x[0]).all():
            x = landmark_coordinates(matrix)
        kind, cores = ("ordering", WORKERS) if library() else ("plain ordering", 1)
        with Expected(kind, len(x), cores, progress) as it:
            self.layout: CompiledTree | PlainTree = (
                CompiledTree(matrix, x, it.progress) if library() else PlainTree(matrix, _unit_box(x), it.progress)
            )
        self.n = self.layout.n

    @property
    def sizes(self) -> tuple[IntArray, IntArray]:
        """The numbers of pivots (fronts,) and of boundary rows (fronts,) of each front."""
        return self.layout.sizes

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        return self.layout.nbytes


def canonical(matrix: sp.spmatrix) -> sp.csr_matrix:
    """Return a float64 matrix by rows with int32 indices, ascending and each once; the argument stays as it is."""
    is_one = isinstance(matrix, sp.csr_matrix) and matrix.dtype == np.float64
    rows = matrix if is_one else sp.csr_matrix(matrix, dtype=np.float64)
    if not rows.has_canonical_format:
        rows = rows.copy()
        rows.sum_duplicates()
    if rows.indices.dtype != np.int32 or rows.indptr.dtype != np.int32:
        if rows.nnz >= 1 << 31:
            raise ParameterError(f"A matrix of {rows.nnz:,} entries is too large.")
        parts = (rows.data, rows.indices.astype(np.int32), rows.indptr.astype(np.int32))
        rows = sp.csr_matrix(parts, shape=rows.shape, copy=False)
    return rows


def _unit_box(x: FloatArray) -> FloatArray:
    """x (n, k), moved and scaled as a whole into [-1, 1], where no square of them over- or underflows."""
    if not len(x):
        return x
    x = x - x.mean(axis=0) if np.abs(x).max() < 1e300 else x / 4 - (x / 4).mean(axis=0)
    largest = np.abs(x).max()
    return np.ascontiguousarray(x / largest if largest > 0 else x)


def _checked_coordinates(pattern: sp.spmatrix, coordinates: FloatArray) -> FloatArray:
    coordinates = np.ascontiguousarray(coordinates, np.float64)
    n = pattern.shape[0]
    if pattern.shape != (n, n) or coordinates.shape != (n, 3):
        raise ParameterError(
            f"A pattern of shape {pattern.shape} and coordinates of shape {coordinates.shape} do not fit; "
            "they must be (n, n) and (n, 3)."
        )
    if not np.isfinite(coordinates).all():
        raise ParameterError("The coordinates must be finite numbers.")
    return coordinates


def landmark_coordinates(matrix: sp.csr_matrix) -> FloatArray:
    """Return (n, 3) coordinates of vertices: principal components of their numbers of steps from landmarks, each the
    farthest from those before (pivot multidimensional scaling).

    Elimination in an order by these costs about what it costs by true coordinates.
    """
    n = matrix.shape[0]
    steps = np.zeros((n, LANDMARKS))
    nearest, landmark = np.full(n, np.inf), int(_steps_from(matrix, 0).argmax())
    for column in steps.T:
        column[:] = _steps_from(matrix, landmark)
        np.minimum(nearest, column, out=nearest)
        landmark = int(nearest.argmax())
    steps -= steps.mean(axis=0)
    vectors = np.linalg.eigh(steps.T @ steps)[1]
    coordinates: FloatArray = steps @ vectors[:, :-4:-1]
    return coordinates


def _steps_from(matrix: sp.csr_matrix, vertex: int) -> FloatArray:
    """Return (n,) the numbers of steps from a vertex, 2 n to those of other components."""
    order, before = breadth_first_order(matrix, vertex)
    n = matrix.shape[0]
    steps, ahead = np.zeros(n), np.where(before < 0, np.arange(n), before)
    steps[order[1:]] = 1
    # Twice as far at a time: each knows the steps to a vertex before it, and that one's.
    while (ahead[order] != vertex).any():
        steps += steps[ahead]
        ahead = ahead[ahead]
    found = np.full(n, 2.0 * n)
    found[order] = steps[order]
    return found
