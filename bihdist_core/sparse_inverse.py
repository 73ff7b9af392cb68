"""Entries of the inverse of a sparse symmetric positive definite matrix, without the rest of it."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from .arrays import FloatArray, real_numbers
from .errors import ParameterError
from .progress import Progress, part
from .solver.elimination_tree import EliminationTree, canonical
from .solver.factor import Factor

CHECKED = 8
"""Columns that the error is found in."""
SAFETY_FACTOR = 6
"""By how much it may be exceeded in others."""
ROUNDING = 1e-9
"""What two entries that should be the same may differ by, as a share of the larger diagonal entry."""


class SparseFactor:
    """The factor of a sparse symmetric positive definite matrix: solutions, and parts of the inverse.

    Parameters
    ----------
    matrix : (n, n) sparse matrix
        Symmetric and positive definite.
    positions : (n, 3) array_like, optional
        Where the rows are, if they are anywhere; they help to find a good order of elimination.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Raises
    ------
    ParameterError
        If the matrix is not square, not symmetric or not real.
    SolverError
        If it is not positive definite to working accuracy.
    NotEnoughMemory
        If the factor would fill more than there is; found before it is begun.

    Notes
    -----
    Selected inversion (Takahashi, Fagan and Chen 1973): all entries of the inverse on the factor's own pattern cost
    about as much as the factor.

    Examples
    --------
    >>> import bihdist, numpy, scipy.sparse
    >>> matrix = scipy.sparse.diags_array([-1, 2.5, -1], offsets=[-1, 0, 1], shape=(1000, 1000)).tocsr()
    >>> factor = bihdist.SparseFactor(matrix)
    >>> x = factor.solve(numpy.ones(1000))
    >>> float(abs(matrix @ x - 1).max()) < 1e-12
    True
    """

    def __init__(
        self, matrix: sp.spmatrix, positions: npt.ArrayLike | None = None, progress: Progress | None = None
    ) -> None:
        self._matrix = checked_symmetric(matrix, "The matrix")
        places = np.zeros((len(self._matrix.indptr) - 1, 3)) if positions is None else positions
        tree = EliminationTree(self._matrix, real_numbers(places, "Positions"), part(progress, 0, 0.2))
        self._factor = Factor(tree, self._matrix, progress=part(progress, 0.2, 1))

    @property
    def nbytes(self) -> int:
        """Bytes of the factor.

        Examples
        --------
        >>> import bihdist, scipy.sparse
        >>> bihdist.SparseFactor(scipy.sparse.identity(100)).nbytes < 100_000
        True
        """
        return self._factor.nbytes

    def solve(self, b: npt.ArrayLike, progress: Progress | None = None) -> FloatArray:
        """Return the solution of matrix x = b.

        Parameters
        ----------
        b : (n,) or (n, k) array_like
            Right-hand sides.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n,) or (n, k) ndarray
            The solutions.

        Raises
        ------
        ParameterError
            For another shape, or numbers that are not finite.

        Examples
        --------
        >>> import bihdist, scipy.sparse
        >>> bihdist.SparseFactor(2 * scipy.sparse.identity(3)).solve([2, 4, 6]).tolist()
        [1.0, 2.0, 3.0]
        """
        return self._factor.solve(b, progress)

    def diagonal_of_inverse(self, progress: Progress | None = None) -> FloatArray:
        """Return the diagonal of the inverse.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n,) ndarray
            In 1 / the unit of the matrix.

        Examples
        --------
        >>> import bihdist, scipy.sparse
        >>> matrix = scipy.sparse.csr_matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])
        >>> bihdist.SparseFactor(matrix).diagonal_of_inverse().round(12).tolist()
        [0.75, 1.0, 0.75]
        """
        return self._factor.inverse_diagonal(progress)

    def inverse_on_pattern(self, progress: Progress | None = None) -> sp.csr_matrix:
        """Return the entries of the inverse where the matrix has entries.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n, n) sparse matrix
            With the pattern of the matrix, in 1 / its unit.

        Examples
        --------
        >>> import bihdist, scipy.sparse
        >>> matrix = scipy.sparse.csr_matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])
        >>> bihdist.SparseFactor(matrix).inverse_on_pattern().toarray().round(12).tolist()
        [[0.75, 0.5, 0.0], [0.5, 1.0, 0.5], [0.0, 0.5, 0.75]]
        """
        values = self._factor.inverse_entries(self._matrix, progress)
        return sp.csr_matrix((values, self._matrix.indices, self._matrix.indptr), shape=self._matrix.shape)

    def error_of(self, diagonal: npt.ArrayLike) -> float:
        """Return about how far the diagonal of the inverse is off, relative to each of its entries.

        Parameters
        ----------
        diagonal : (n,) array_like
            As `diagonal_of_inverse` returns it.

        Returns
        -------
        float
            Six times the largest that is found in some columns, which are solved for and refined.

        Examples
        --------
        >>> import bihdist, scipy.sparse
        >>> factor = bihdist.SparseFactor(scipy.sparse.csr_matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]]))
        >>> bool(factor.error_of(factor.diagonal_of_inverse()) < 1e-12)
        True
        """
        found = real_numbers(diagonal, "The diagonal")
        spread = np.linspace(0, len(found) - 1, CHECKED - 2).astype(np.int64)
        rows = np.unique([int(found.argmax()), int(found.argmin()), *spread])
        b = np.zeros((len(found), len(rows)))
        b[rows, np.arange(len(rows))] = 1
        x = self.solve(b)
        x += self.solve(b - self._matrix @ x)
        return (
            SAFETY_FACTOR * float(np.abs(1 - found[rows] / x[rows, np.arange(len(rows))]).max()) + np.finfo(float).eps
        )


def diagonal_of_inverse(
    matrix: sp.spmatrix, positions: npt.ArrayLike | None = None, progress: Progress | None = None
) -> FloatArray:
    """Compute the diagonal of the inverse of a sparse symmetric positive definite matrix.

    Parameters
    ----------
    matrix : (n, n) sparse matrix
        Symmetric and positive definite.
    positions : (n, 3) array_like, optional
        Where the rows are.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    (n,) ndarray
        In 1 / the unit of the matrix.

    Raises
    ------
    ParameterError, SolverError, NotEnoughMemory
        As `SparseFactor` raises them.

    Examples
    --------
    >>> import bihdist, scipy.sparse
    >>> bihdist.diagonal_of_inverse(scipy.sparse.csr_matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])).round(12).tolist()
    [0.75, 1.0, 0.75]
    """
    factor = SparseFactor(matrix, positions, part(progress, 0, 0.5))
    return factor.diagonal_of_inverse(part(progress, 0.5, 1))


def inverse_on_pattern(
    matrix: sp.spmatrix, positions: npt.ArrayLike | None = None, progress: Progress | None = None
) -> sp.csr_matrix:
    """Compute the entries of the inverse of a sparse symmetric positive definite matrix where it has entries itself.

    Parameters
    ----------
    matrix : (n, n) sparse matrix
        Symmetric and positive definite.
    positions : (n, 3) array_like, optional
        Where the rows are.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    (n, n) sparse matrix
        With the pattern of the matrix, in 1 / its unit.

    Raises
    ------
    ParameterError, SolverError, NotEnoughMemory
        As `SparseFactor` raises them.

    Examples
    --------
    >>> import bihdist, scipy.sparse
    >>> matrix = scipy.sparse.csr_matrix([[2, -1, 0], [-1, 2, -1], [0, -1, 2]])
    >>> bihdist.inverse_on_pattern(matrix).toarray().round(12).tolist()
    [[0.75, 0.5, 0.0], [0.5, 1.0, 0.5], [0.0, 0.5, 0.75]]
    """
    factor = SparseFactor(matrix, positions, part(progress, 0, 0.5))
    return factor.inverse_on_pattern(part(progress, 0.5, 1))


def checked_symmetric(matrix: sp.spmatrix, what: str) -> sp.csr_matrix:
    """Return a matrix by rows, as symmetric as rounding leaves it; ParameterError, which begins with `what`, for a
    matrix that is not square, real, finite and symmetric."""
    if not sp.issparse(matrix) and not (isinstance(matrix, np.ndarray) and matrix.ndim == 2):
        raise ParameterError(f"{what} is to be a sparse (n, n) matrix, not {type(matrix).__name__}.")
    n = matrix.shape[0]
    if matrix.shape != (n, n) or not n:
        raise ParameterError(f"{what} is to be square, and its shape is {matrix.shape}.")
    if matrix.dtype.kind not in "biuf":
        raise ParameterError(f"{what} has entries of the type {matrix.dtype}; they are to be real numbers.")
    rows = canonical(sp.csr_matrix(matrix))
    if not np.isfinite(rows.data).all():
        raise ParameterError(f"{what} has entries that are not finite.")
    largest, apart = np.abs(rows.diagonal()), abs(rows - rows.T).tocoo()
    wrong = np.flatnonzero(apart.data > ROUNDING * np.maximum(largest[apart.row], largest[apart.col]))
    if len(wrong):
        i, j = int(apart.row[wrong[0]]), int(apart.col[wrong[0]])
        raise ParameterError(
            f"{what} is to be symmetric, and its entry ({i}, {j}) is {rows[i, j]:g}, but ({j}, {i}) is {rows[j, i]:g}."
        )
    return canonical((rows + rows.T) / 2) if apart.nnz else rows
