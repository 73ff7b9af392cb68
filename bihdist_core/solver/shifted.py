"""Factors of L - z A for a shift z that is negative or complex, with the diagonal of the inverse.

L is symmetric and positive semi-definite and A a diagonal of areas, so that no such z is an eigenvalue of A^-1 L.
"""

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray, IntArray, unit_columns
from ..expected_time import Expected
from ..progress import Progress
from .compiled_factor import CompiledFactor
from .compiled_tree import CompiledTree
from .elimination_tree import EliminationTree, canonical
from .factor import WIDE, on_both_sides
from .plain import PlainFactor
from .worker_threads import WORKERS, Job, Run, Workspaces, in_turn, side_by_side

Work = Callable[[slice, Run, AnyArray, Workspaces], None]
"""Puts some columns into an array, in a way of running tasks, with workspaces."""

INVERTED, COMPLEX = 2, 4
"""How much more an elimination costs with the diagonal of the inverse, and with complex numbers."""


class ShiftedFactor:
    """The factor of L - z A on an elimination tree; usable from several threads.

    Parameters
    ----------
    tree : EliminationTree
        The order and layout, made for the pattern of L.
    stiffness : (n, n) sparse matrix
        L.
    areas : (n,) ndarray
        The diagonal of A, at least 0.
    shift : complex
        z, negative or with an imaginary part.
    progress : callable, optional
        Called from the calling thread only.

    Attributes
    ----------
    diagonal : (n,) ndarray
        The diagonal of (L - z A)^-1; real where z is.

    Raises
    ------
    SolverError
        If the matrix is singular to working accuracy.
    """

    def __init__(
        self,
        tree: EliminationTree,
        stiffness: sp.csr_matrix,
        areas: FloatArray,
        shift: complex,
        progress: Progress | None = None,
        inverted: bool = True,
    ) -> None:
        self.tree, self.shift = tree, complex(shift)
        self._is_complex = self.shift.imag != 0
        layout = tree.layout
        is_compiled = isinstance(layout, CompiledTree)
        times = (INVERTED if inverted else 1) * (COMPLEX if self._is_complex else 1)
        kind, cores = ("factor", WORKERS) if is_compiled else ("plain factor", 1)
        with Expected(kind, layout.work * times, cores, progress) as it:
            job = Job(it.progress, "Factoring the shifted matrix", layout.work * (1 + inverted))
            imaginary = -self.shift.imag * areas if self._is_complex else None
            self._blocks: CompiledFactor | PlainFactor
            if isinstance(layout, CompiledTree):
                matrix = _with_diagonal(stiffness, -self.shift.real * areas)
                given = layout, canonical(matrix), imaginary, job
                self._blocks = CompiledFactor(*given, inverted=inverted, is_complex=self._is_complex)
            else:
                shift = self.shift if self._is_complex else self.shift.real
                self._blocks = PlainFactor(layout, _with_diagonal(stiffness, -shift * areas), None, job)
            if inverted:
                self.diagonal = self._diagonal(job)
            job.finish()

    def _diagonal(self, job: Job) -> AnyArray:
        diagonal, second = self._blocks.diagonals(job)
        if self._is_complex and isinstance(self._blocks, CompiledFactor):
            return diagonal + 1j * second
        return diagonal

    def inverse_entries(self, pattern: sp.csr_matrix) -> AnyArray:
        """Return the entries (e,) of (L - z A)^-1 on a symmetric pattern within the tree's, as `canonical` makes it."""
        values, second = self._blocks.diagonals(Job(None, "", 1), pattern)
        if self._is_complex and isinstance(self._blocks, CompiledFactor):
            return on_both_sides(self.tree, pattern, values + 1j * second)
        return on_both_sides(self.tree, pattern, values)

    @property
    def nbytes(self) -> int:
        """Bytes of the factor, without the tree and the diagonal."""
        return self._blocks.nbytes

    def columns(self, index: IntArray) -> AnyArray:
        """Return (n, k): the columns `index` (k,) of (L - z A)^-1; real where z is."""
        if self._is_complex and isinstance(self._blocks, CompiledFactor):
            blocks = self._blocks
            return self._in_slices(
                len(index), lambda some, run, out, room: blocks.complex_columns(index[some], run, out, room)
            )
        return self.solve(unit_columns(self.tree.n, index))

    def solve(self, b: AnyArray) -> AnyArray:
        """(L - z A)^-1 b for b (n, k); real where z and b are."""
        blocks = self._blocks
        if isinstance(blocks, CompiledFactor) and not self._is_complex:
            if np.iscomplexobj(b):
                return self.solve(b.real.copy()) + 1j * self.solve(b.imag.copy())
            b = np.ascontiguousarray(b)
            return self._in_slices(b.shape[1], lambda some, run, out, room: blocks.solve(b[:, some], out, run, room))
        if isinstance(blocks, CompiledFactor):
            return self._in_slices(
                b.shape[1], lambda some, run, out, room: blocks.complex_solve(b[:, some], run, out, room)
            )
        out = np.empty(b.shape, complex if self._is_complex else b.dtype)
        blocks.solve(b, out, in_turn, Workspaces())
        return out

    def _in_slices(self, count: int, work: Work) -> AnyArray:
        """Return (n, count) out of the columns that work(some, run, out, workspaces) computes."""
        result = np.empty((self.tree.n, count), complex if self._is_complex else float)
        workspaces = Workspaces()
        if count <= WIDE:
            work(slice(0, count), side_by_side, result, workspaces)
        else:
            starts = [slice(start, start + WIDE) for start in range(0, count, WIDE)]
            side_by_side(lambda some: work(some, in_turn, result[:, some], workspaces), starts)
        return result


def _with_diagonal(matrix: sp.csr_matrix, diagonal: AnyArray) -> sp.csr_matrix:
    """Return the sum of a matrix and a diagonal."""
    return sp.csr_matrix(matrix + sp.diags(diagonal, format="csr"))
