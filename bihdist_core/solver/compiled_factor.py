"""A factor by the compiled kernel: its blocks, and solves with them; `kernel/kernel.h` has the algebra."""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cached_property
from queue import Empty, SimpleQueue
from typing import Any

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..kernel import library as kernel
from ..kernel.library import at, check_stopped, library, rows_of
from .compiled_tree import CompiledTree
from .worker_threads import Job, Run

PADDING = 8
"""Numbers after the end of an array that the kernel may read."""

NEVER = ctypes.byref(kernel.Watch())
"""The watch of short work, which nobody stops."""


class CompiledFactor:
    """The factor of a matrix as `canonical` makes it; areas: (n,), for what needs derivatives.

    Raises SolverError if the matrix is not positive definite, ParameterError if it has an entry outside the pattern.
    """

    def __init__(self, tree: CompiledTree, matrix: sp.csr_matrix, areas: FloatArray | None, job: Job) -> None:
        self.tree = tree
        self._dual = areas is not None
        parts = 1 + self._dual
        self._pivots = np.empty(parts * tree.factor_size[0] + PADDING)
        self._boundaries = np.empty(parts * tree.factor_size[1] + PADDING)
        self._shared = np.empty(tree.shared_room + PADDING)
        self._eliminate(matrix, areas, job)

    @property
    def nbytes(self) -> int:
        """How many bytes its blocks take."""
        return self._pivots.nbytes + self._boundaries.nbytes

    @cached_property
    def _struct(self) -> kernel.Factor:
        return kernel.Factor(ctypes.pointer(self.tree.struct), int(self._dual), at(self._pivots), at(self._boundaries))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_struct"}

    def _eliminate(self, matrix: sp.csr_matrix, areas: FloatArray | None, job: Job) -> None:
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        rows = rows_of(matrix.indptr, matrix.indices, matrix.data)

        workspaces = _Workspaces()

        def eliminate(task: tuple[int, int]) -> None:
            room, where = np.zeros(3, np.int64), np.zeros(2, np.int64)
            lib.bih_elimination_room(ctypes.byref(tree.struct), int(self._dual), *task, room)
            with workspaces.of(room[2]) as work:
                status = lib.bih_eliminate(
                    factor, ctypes.byref(rows), areas, *task, self._shared, work, where, ctypes.byref(job.watch)
                )
            if status == kernel.NOT_POSITIVE:
                raise SolverError("The matrix is not positive definite to working accuracy, so it cannot be factored.")
            if status == kernel.OUTSIDE:
                raise ParameterError(f"The entry ({where[0]}, {where[1]}) is outside the pattern of the tree.")
            check_stopped(status)

        job.run(eliminate, tree.tasks, tree.after)

    def diagonals(self, job: Job) -> tuple[FloatArray, FloatArray]:
        """(n,) diag(G) and (n,) diag(G A G); to be called once, after the elimination."""
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        diagonals, workspaces = np.empty((2, tree.n)), _Workspaces()

        def invert(task: tuple[int, int]) -> None:
            room = np.zeros(2, np.int64)
            lib.bih_inversion_room(ctypes.byref(tree.struct), *task, room)
            with workspaces.of(room[1]) as work:
                check_stopped(lib.bih_invert(factor, *task, self._shared, work, *diagonals, ctypes.byref(job.watch)))

        job.run(invert, tree.tasks, tree.before)
        self._shared = np.empty(0)
        return diagonals[0], diagonals[1]

    def solve(self, b: FloatArray, run: Run) -> FloatArray:
        """(n, k) matrix^-1 b, b (n, k): every task up to the top, the top up and down, and every task down."""
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        k, top = b.shape[1], tree.top_places
        x = b[tree.vertices]

        def up(task: tuple[int, int]) -> FloatArray:
            above = np.zeros((len(top), k))
            end = int(tree.first[task[1] + 1])
            work = self._workspace(task, k)
            lib.bih_sweep_up(factor, *task, end, k, x, above, work, NEVER)
            return above

        def down(task: tuple[int, int]) -> None:
            lib.bih_sweep_down(factor, *task, k, x, self._workspace(task, k), NEVER)

        branches, tops = tree.branches, tree.tops
        for above in run(up, branches):
            x[top] += above
        for q in tops:
            lib.bih_sweep_up(factor, q, q, tree.n, k, x, None, self._workspace((q, q), k), NEVER)
        for q in reversed(tops):
            down((q, q))
        run(down, branches)
        result = np.empty_like(x)
        result[tree.vertices] = x
        return result

    def _workspace(self, task: tuple[int, int], k: int) -> FloatArray:
        return np.empty(library().bih_sweep_room(ctypes.byref(self.tree.struct), *task, k))

    def each_sandwich_piece(self, index: IntArray, run: Run, receive: Callable[[IntArray, FloatArray], None]) -> None:
        """The columns `index` (k,) of G A G in pieces: receive(vertices (r,), values (r, k)), which it may keep."""
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        places, k = tree.place[index], len(index)
        x, y = np.zeros((2, tree.n, k))
        on = np.zeros(len(tree.parent), np.uint8)
        front = (np.searchsorted(tree.first, places, side="right") - 1).astype(np.int32)
        lib.bih_send_units(factor, front, places, k, x, y, on)

        def down(task: tuple[int, int]) -> FloatArray:
            lib.bih_sweep_down_both(factor, *task, k, x, y, on, self._workspace(task, 2 * k), NEVER)
            piece: FloatArray = y[tree.first[task[0]] : tree.first[task[1] + 1]]
            return piece

        def finish(task: tuple[int, int], piece: FloatArray) -> None:
            receive(tree.vertices[tree.first[task[0]] : tree.first[task[1] + 1]], piece)

        for q in reversed(tree.tops):
            finish((q, q), down((q, q)).copy())  # those below need it as it is
        run(lambda task: finish(task, down(task)), tree.branches)


class _Workspaces:
    """Arrays for the tasks that run at the same time, each used again: memory that is touched first costs more."""

    def __init__(self) -> None:
        self._free: SimpleQueue[FloatArray] = SimpleQueue()

    @contextmanager
    def of(self, size: int) -> Iterator[FloatArray]:
        """One of at least so many numbers."""
        try:
            work = self._free.get_nowait()
        except Empty:
            work = np.empty(0)
        if len(work) < size:
            work = np.empty(size)
        yield work
        self._free.put(work)
