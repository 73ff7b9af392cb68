"""The elimination tree: in which order the vertices of a sparse symmetric matrix are eliminated, and in which fronts.

The tree of a nested dissection is the elimination tree.  Each of its nodes is a front, a dense block: it eliminates its
own vertices, its pivots, and touches some vertices of its ancestors, its boundary.
"""

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..expected_time import Expected
from ..kernel.library import library
from ..progress import Progress
from .compiled_tree import CompiledTree
from .plain import PlainTree
from .worker_threads import WORKERS


class EliminationTree:
    """Order and layout for all matrices with one sparsity pattern.

    Parameters
    ----------
    pattern : (n, n) sparse matrix
        Symmetric; only the places of its entries off the diagonal matter.
    coordinates : (n, 3) ndarray
        Finite, used for the ordering only.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Raises
    ------
    ParameterError
        If the shapes do not fit, the pattern is not symmetric or a coordinate is not finite.
    """

    def __init__(self, pattern: sp.spmatrix, coordinates: FloatArray, progress: Progress | None = None) -> None:
        x, matrix = _checked_coordinates(pattern, coordinates), canonical(pattern)
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
