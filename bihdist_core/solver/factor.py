"""Factor of a sparse symmetric positive definite matrix: factor once, solve many, and diagonals of inverses.

With G = matrix^-1 and a diagonal A, the diagonal of G A G costs no more than a few factorizations (paper, Eq. 9 and
10 need it for every vertex): it is minus the derivative of diag((matrix + t A)^-1) at t = 0, and since A is diagonal
that derivative lives on the factor's own pattern.  So everything carries its derivative (see `kernel/kernel.h`).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray
from ..errors import ParameterError, SolverError
from ..expected_time import Expected, expected_seconds
from ..progress import Progress, silent
from .compiled_factor import CompiledFactor
from .compiled_tree import CompiledTree
from .elimination_tree import EliminationTree, canonical
from .plain import PlainFactor
from .worker_threads import WORKERS, Job, Run, Workspaces, in_turn, side_by_side

ReceivePiece = Callable[[AnyArray, slice, FloatArray], None]
"""Takes some rows (r,), a slice of the columns asked for, and the values (r, k) there, which it may overwrite."""

WIDE = 32
"""Columns that are solved for together; more would not stay in the cache."""

FEW = 1 << 16
"""Of fewer vertices as many columns stay in the cache where each has one of G beside it."""

WITH_DIAGONALS = 6
"""The cost with derivatives and diagonals over the cost without."""

USUAL = 50
"""Multiplications of a factor of n vertices, times n^1.5, on round shapes; on long ones a third of them."""

USUAL_BYTES = 1_000
"""Of a factor with its diagonals, for each vertex: 600 to 1,200."""

SMALL = 1 << 23
"""A factor of fewer bytes is read by one thread faster than several begin."""


class Factor:
    """Factor of one matrix on an elimination tree that it may share with others; usable from several threads.

    Parameters
    ----------
    tree : EliminationTree
        The order and layout.
    matrix : (n, n) sparse matrix
        Symmetric and positive definite, with no entry outside the tree's pattern; only the diagonal and one side of it
        are read.
    areas : (n,) array_like, optional
        The diagonal of A, at least 0, needed for `diagonal`, `sandwich_diagonal` and `sandwich_columns`.
    progress : callable, optional
        Called from the calling thread only.

    Raises
    ------
    SolverError
        If the matrix is not positive definite.
    ParameterError
        If shapes or values do not fit.
    """

    def __init__(
        self,
        tree: EliminationTree,
        matrix: sp.spmatrix,
        areas: npt.ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> None:
        matrix, weights = _checked_matrix(tree, matrix), _checked_areas(tree, areas)
        self.tree = tree
        layout = tree.layout
        self._diagonals: tuple[FloatArray, FloatArray] | None = None
        multiplications = layout.work * (1 if weights is None else WITH_DIAGONALS)
        kind, cores = ("factor", WORKERS) if isinstance(layout, CompiledTree) else ("plain factor", 1)
        with Expected(kind, multiplications, cores, progress) as it:
            # The inversion takes about as long as the elimination.
            job = Job(it.progress, "Factoring the matrix", layout.work * (1 + (weights is not None)))
            if isinstance(layout, CompiledTree):
                self._blocks: CompiledFactor | PlainFactor = CompiledFactor(layout, matrix, weights, job)
            else:
                self._blocks = PlainFactor(layout, matrix, weights, job)
            if weights is not None:
                self._diagonals = self._blocks.diagonals(job)
                for diagonal in self._diagonals:
                    _check_result(diagonal)
                    diagonal.flags.writeable = False
            job.finish()

    @property
    def has_diagonals(self) -> bool:
        """True if the factor was made with areas, and so has diagonals."""
        return self._diagonals is not None

    @property
    def diagonal(self) -> FloatArray:
        """The diagonal (n,) of matrix^-1, read-only; SolverError without areas."""
        return self._with_areas()[0]

    @property
    def sandwich_diagonal(self) -> FloatArray:
        """The diagonal (n,) of matrix^-1 A matrix^-1, read-only; SolverError without areas."""
        return self._with_areas()[1]

    def inverse_diagonal(self, progress: Progress | None = None) -> FloatArray:
        """Return the diagonal (n,) of matrix^-1; of a factor without areas."""
        return self._inverse(None, progress)[0]

    def inverse_entries(self, pattern: sp.csr_matrix, progress: Progress | None = None) -> FloatArray:
        """Return the entries (e,) of matrix^-1 on a symmetric pattern within the tree's, as `canonical` makes it."""
        return on_both_sides(self.tree, pattern, self._inverse(pattern, progress)[0])

    def _inverse(self, pattern: sp.csr_matrix | None, progress: Progress | None) -> tuple[FloatArray, FloatArray]:
        is_compiled = isinstance(self.tree.layout, CompiledTree)
        kind, cores = ("factor", WORKERS) if is_compiled else ("plain factor", 1)
        with Expected(kind, self.tree.layout.work, cores, progress) as it:
            job = Job(it.progress, "Inverting the matrix", self.tree.layout.work)
            found = self._blocks.diagonals(job, pattern)
            job.finish()
        _check_result(found[0])
        return found

    @property
    def nbytes(self) -> int:
        """Bytes of the factor, without the tree."""
        return self._blocks.nbytes + sum(d.nbytes for d in self._diagonals or ())

    def solve(self, b: npt.ArrayLike, progress: Progress | None = None) -> FloatArray:
        """matrix^-1 b, in the shape of b: (n,) or (n, k)."""
        b = np.asarray(b, np.float64)
        n = self.tree.n
        if b.ndim not in (1, 2) or len(b) != n:
            raise ParameterError(f"A right-hand side of shape {b.shape} does not fit a matrix of shape ({n}, {n}).")
        if not np.isfinite(b).all():
            raise ParameterError("A right-hand side must have finite numbers only.")
        columns = np.ascontiguousarray(b[:, None] if b.ndim == 1 else b)
        result, workspaces = np.empty(columns.shape), Workspaces()

        def solve(some: slice, run: Run) -> None:
            self._blocks.solve(columns[:, some], result[:, some], run, workspaces)

        self._in_slices(columns.shape[1], WIDE, solve, progress)
        _check_result(result)
        return result.reshape(b.shape)

    def sandwich_columns(self, index: npt.ArrayLike) -> FloatArray:
        """Return (n, k): the columns `index` (k,) of matrix^-1 A matrix^-1, in one sweep down; SolverError without
        areas."""
        result = np.empty((self.tree.n, np.size(index)))

        def keep(rows: AnyArray, columns: slice, values: FloatArray) -> None:
            result[rows, columns] = values

        self.each_sandwich_piece(index, keep)
        return result

    def each_sandwich_piece(
        self, index: npt.ArrayLike, receive: ReceivePiece, progress: Progress | None = None
    ) -> None:
        """Call `receive` with each piece of G A G once, from several threads, without an array for all of it."""
        self._with_areas()
        index, n = np.asarray(index), self.tree.n
        if index.ndim != 1 or (index.size and (index.dtype.kind not in "iu" or index.min() < 0 or index.max() >= n)):
            raise ParameterError(f"Columns are chosen by a list of whole numbers from 0 to {n - 1}, not {index!r}.")

        workspaces = Workspaces()

        def sweep(some: slice, run: Run) -> None:
            def finish(rows: AnyArray, values: FloatArray) -> None:
                _check_result(values)
                receive(rows, some, values)

            self._blocks.each_sandwich_piece(index[some], run, finish, workspaces)

        # Each column comes with one of G.
        self._in_slices(len(index), WIDE if n < FEW else WIDE // 2, sweep, progress)

    def _in_slices(self, count: int, width: int, work: Callable[[slice, Run], None], progress: Progress | None) -> None:
        """work(columns, run) for all columns: a few with the branches side by side, many in slices side by side."""
        if count <= width:
            if count:
                work(slice(0, count), in_turn if self._blocks.nbytes < SMALL else side_by_side)
            return
        starts = range(0, count, width)
        if progress in (None, silent):
            side_by_side(lambda start: work(slice(start, start + width), in_turn), starts)
            return
        job = Job(progress, "Solving", count)

        def one(start: int) -> None:
            work(slice(start, start + width), in_turn)
            job.advance(width)

        job.run(one, starts)

    def _with_areas(self) -> tuple[FloatArray, FloatArray]:
        if self._diagonals is None:
            raise SolverError("This factor was made without areas, which its diagonals and sandwich columns need.")
        return self._diagonals


def share_of_ordering(n: int, diagonals: bool) -> float:
    """Return the tree's fraction of the time that a tree and a factor of n vertices take."""
    return expected_seconds("ordering", n, WORKERS) / usual_seconds(n, diagonals)


def usual_seconds(n: int, diagonals: bool) -> float:
    """Return about how long a tree and a factor of n vertices take, before there is a tree."""
    multiplications = USUAL * n**1.5 * (WITH_DIAGONALS if diagonals else 1)
    return expected_seconds("ordering", n, WORKERS) + expected_seconds("factor", multiplications, WORKERS)


def usual_bytes(n: int) -> int:
    """Return about how many bytes a factor of n vertices with its diagonals holds, before there is a tree."""
    return USUAL_BYTES * n


def _checked_matrix(tree: EliminationTree, matrix: sp.spmatrix) -> sp.csr_matrix:
    if matrix.shape != (tree.n, tree.n):
        raise ParameterError(f"A matrix of shape {matrix.shape} does not fit a tree of {tree.n:,} vertices.")
    matrix = canonical(matrix)
    if not np.isfinite(matrix.data).all():
        raise SolverError("The matrix has entries that are not finite numbers.")
    return matrix


def _checked_areas(tree: EliminationTree, areas: npt.ArrayLike | None) -> FloatArray | None:
    if areas is None:
        return None
    areas = np.asarray(areas, np.float64)
    if areas.shape != (tree.n,) or not (np.isfinite(areas) & (areas >= 0)).all():
        raise ParameterError(f"Areas must be {tree.n} finite numbers of at least 0.")
    return areas


def _check_result(x: FloatArray) -> None:
    if not np.isfinite(x).all():
        raise SolverError("The solution has values that are not finite numbers; its scale is too extreme.")


def on_both_sides(tree: EliminationTree, pattern: sp.csr_matrix, values: AnyArray) -> AnyArray:
    """Return values (e,) on a symmetric pattern; those left of the diagonal in elimination order are missing."""
    places, rows = tree.layout.place, np.repeat(np.arange(tree.n), np.diff(pattern.indptr))
    numbers = sp.csr_matrix((np.arange(pattern.nnz), pattern.indices, pattern.indptr), shape=pattern.shape)
    return np.where(places[pattern.indices] >= places[rows], values, values[numbers.T.tocsr().data])
