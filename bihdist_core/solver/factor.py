"""Factor of a sparse symmetric positive definite matrix: factor once, solve many, and diagonals of inverses.

With G = matrix^-1 and a diagonal A, the diagonal of G A G costs no more than a few factorizations (paper, Eq. 9 and
10 need it for every vertex): it is minus the derivative of diag((matrix + t A)^-1) at t = 0, and since A is diagonal
that derivative lives on the factor's own pattern.  So everything carries its derivative (see `elimination`).
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..progress import Progress
from .blas import one_blas_thread
from .elimination import Block, eliminate_branch, entries_by_stack
from .elimination_tree import EliminationTree
from .selected_inversion import invert_branch
from .substitution import Run, sandwich_columns, solve_into
from .worker_threads import Job, side_by_side

ReceivePiece = Callable[[IntArray, slice, FloatArray], None]
"""Takes some rows (r,), a slice of the columns asked for, and the values (r, k) there, which it may overwrite."""

TINY = -100
"""Areas are scaled to about 2**TINY of the diagonal: the square of that is lost in rounding whatever the condition,
and is still far from where numbers end."""

WIDE = 32
"""How many columns are solved for together: more would not stay in the cache."""


class Factor:
    """Factor of one matrix on an elimination tree that it may share with others.  Usable from several threads.

    matrix: (n, n) sparse, symmetric positive definite, with no entry outside the tree's pattern; only the diagonal and
    what is below it are read.  areas: (n,), at least 0: the diagonal of A, needed for `diagonal`,
    `sandwich_diagonal` and `sandwich_columns`.  `progress` is called from the calling thread only.

    Raises SolverError if the matrix is not positive definite, ParameterError if shapes or values do not fit.
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
        self._diagonals: tuple[FloatArray, FloatArray] | None = None
        if weights is not None:
            self._scale = _tiny_scale(weights, matrix.diagonal())
            weights = weights * self._scale
        with one_blas_thread():
            # Measured: the inversion and the gathers of an elimination take about as long as each other.
            work = sum(stack.work for stack in tree.stacks) * (1 + (weights is not None))
            job = Job(progress, "Factoring the matrix", work)
            entries = entries_by_stack(tree, matrix, weights)
            blocks: list[Block | None] = [None] * len(tree.stacks)
            schur = job.run(lambda q: eliminate_branch(tree, q, [], entries, blocks, job), tree.branches)
            below = [pair for pairs in schur for pair in pairs]
            del schur
            if tree.top.levels:
                job.run(lambda q: eliminate_branch(tree, q, below, entries, blocks, job), [tree.top])
            self._blocks: list[Block] = [block for block in blocks if block is not None]
            if weights is not None:
                self._diagonals = self._inverted(job)
            job.finish()

    def _inverted(self, job: Job) -> tuple[FloatArray, FloatArray]:
        tree, blocks = self.tree, self._blocks
        result = np.empty(tree.n, complex)
        (above,) = job.run(lambda top: invert_branch(tree, top, np.empty(0), blocks, result, job), [tree.top])
        job.run(lambda branch: invert_branch(tree, branch, above, blocks, result, job), tree.branches)
        with np.errstate(over="ignore"):
            diagonals = result.real.copy(), result.imag / self._scale
        for diagonal in diagonals:
            _check_result(diagonal)
            diagonal.flags.writeable = False
        return diagonals

    @property
    def diagonal(self) -> FloatArray:
        """(n,) diag(matrix^-1), read-only; SolverError without areas."""
        return self._with_areas()[0]

    @property
    def sandwich_diagonal(self) -> FloatArray:
        """(n,) diag(matrix^-1 A matrix^-1), read-only; SolverError without areas."""
        return self._with_areas()[1]

    @property
    def nbytes(self) -> int:
        """How many bytes the factor holds, the tree not counted."""
        return sum(block.nbytes for block in self._blocks) + sum(d.nbytes for d in self._diagonals or ())

    def solve(self, b: npt.ArrayLike) -> FloatArray:
        """matrix^-1 b, in the shape of b: (n,) or (n, k)."""
        b = np.asarray(b, np.float64)
        n = self.tree.n
        if b.ndim not in (1, 2) or len(b) != n:
            raise ParameterError(f"A right-hand side of shape {b.shape} does not fit a matrix of shape ({n}, {n}).")
        if not np.isfinite(b).all():
            raise ParameterError("A right-hand side must have finite numbers only.")
        columns = b[:, None] if b.ndim == 1 else b
        result = np.empty(columns.shape)

        def solve(some: slice, run: Run) -> None:
            solve_into(result[:, some], self.tree, self._blocks, columns[:, some], run)

        with one_blas_thread():
            _in_slices(columns.shape[1], WIDE, solve)
        _check_result(result)
        return result.reshape(b.shape)

    def sandwich_columns(self, index: npt.ArrayLike) -> FloatArray:
        """(n, k): the columns `index` (k,) of matrix^-1 A matrix^-1, in one sweep down; SolverError without areas."""
        result = np.empty((self.tree.n, np.size(index)))

        def keep(rows: IntArray, columns: slice, values: FloatArray) -> None:
            result[rows, columns] = values

        self.each_sandwich_piece(index, keep)
        return result

    def each_sandwich_piece(self, index: npt.ArrayLike, receive: ReceivePiece) -> None:
        """Call `receive` with each piece of G A G once, from several threads, without an array for all of it."""
        self._with_areas()
        index, n = np.asarray(index), self.tree.n
        if index.ndim != 1 or (index.size and (index.dtype.kind not in "iu" or index.min() < 0 or index.max() >= n)):
            raise ParameterError(f"Columns are chosen by a list of whole numbers from 0 to {n - 1}, not {index!r}.")

        def sweep(some: slice, run: Run) -> None:
            def finish(rows: IntArray, values: FloatArray) -> None:
                values = values / self._scale
                _check_result(values)
                receive(rows, some, values)

            sandwich_columns(self.tree, self._blocks, index[some], run, finish)

        with one_blas_thread(), np.errstate(over="ignore"):
            # Complex numbers are twice as large.
            _in_slices(len(index), WIDE // 2, sweep)

    def _with_areas(self) -> tuple[FloatArray, FloatArray]:
        if self._diagonals is None:
            raise SolverError("This factor was made without areas, which its diagonals and sandwich columns need.")
        return self._diagonals


def _in_slices(count: int, width: int, work: Callable[[slice, Run], None]) -> None:
    """work(columns, run) for all columns: a few with the branches side by side, many in slices side by side."""
    if not count:
        return
    if count <= width:
        work(slice(0, count), side_by_side)
    else:
        side_by_side(lambda start: work(slice(start, start + width), _in_turn), range(0, count, width))


def _in_turn(function: Any, items: Any) -> list[Any]:
    return [function(item) for item in items]


def _checked_matrix(tree: EliminationTree, matrix: sp.spmatrix) -> sp.csr_matrix:
    if matrix.shape != (tree.n, tree.n):
        raise ParameterError(f"A matrix of shape {matrix.shape} does not fit a tree of {tree.n:,} vertices.")
    # A copy, since SciPy sums duplicate entries in place.
    matrix = sp.csr_matrix(matrix, dtype=np.float64, copy=True)
    matrix.sum_duplicates()
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


def _tiny_scale(areas: FloatArray, diagonal: FloatArray) -> float:
    """What the areas are multiplied by; a power of two, so that no digit changes."""
    ratio = float(np.max(areas / np.maximum(np.abs(diagonal), 1e-300), initial=0))
    return math.ldexp(1.0, TINY - math.frexp(ratio)[1]) if 0 < ratio < np.inf else 1.0


def _check_result(x: FloatArray) -> None:
    if not np.isfinite(x).all():
        raise SolverError("The solution has values that are not finite numbers; its scale is too extreme.")
