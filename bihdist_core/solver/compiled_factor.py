"""A factor by the compiled kernel: its blocks, and solves with them; `kernel/kernel.h` has the algebra."""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..kernel import library as kernel
from ..kernel.library import at, check_stopped, library, rows_of
from ..machine_memory import MEMORY_ADVICE, check_memory
from .compiled_tree import PAD, CompiledTree, padded
from .worker_threads import WORKERS, Arena, Job, Run, Workspaces

PADDING = 8
"""Numbers after the end of an array that the kernel may read."""

NEVER = ctypes.byref(kernel.Watch())
"""The watch of short work, which nobody stops."""


class Blocks:
    """Blocks of fronts that tasks hand to each other, each kept until it is released as often as it is used.

    Attributes
    ----------
    address : (fronts,) ndarray
        The address of the block of each front, 0 where there is none.
    """

    def __init__(self, fronts: int, arena: Arena) -> None:
        self.address = np.zeros(fronts, np.uintp)
        self._arena = arena
        self._held: dict[int, tuple[FloatArray, list[None]]] = {}

    def take(self, front: int, size: int, uses: int) -> None:
        """Room for the block of a front, of `size` numbers."""
        part = self._arena.take(size + PADDING)
        self.address[front] = part.ctypes.data
        self._held[front] = part, [None] * uses

    def release(self, front: int) -> None:
        """End one of its uses."""
        part, uses = self._held[front]
        uses.pop()  # at once, whatever other threads do
        if not uses:
            self._arena.release(part)


class CompiledFactor:
    """The factor of a matrix as `canonical` makes it.

    `areas` (n,) is a diagonal A, along which there are derivatives; if `is_complex` the matrix is matrix + i A instead.
    `inverted` says whether `diagonals` will be asked for, as always with areas.

    Raises SolverError if the matrix is not positive definite or, with imaginary parts, singular; ParameterError if it
    has an entry outside the pattern.
    """

    def __init__(
        self,
        tree: CompiledTree,
        matrix: sp.csr_matrix,
        areas: FloatArray | None,
        job: Job,
        inverted: bool = False,
        is_complex: bool = False,
    ) -> None:
        self.tree = tree
        self._areas = None if areas is None else areas.take(tree.order)
        second = kernel.SINGLE if areas is None else kernel.IMAGINARY if is_complex else kernel.DERIVATIVE
        self._second = second
        self._inverted = inverted = inverted or areas is not None
        # Derivatives stand beside all blocks before those of leaves.
        sizes = [
            size + (0, int(block[-1]), size)[second] + PADDING
            for size, block in zip(tree.factor_size, (tree.pivot_block, tree.row_block), strict=True)
        ]
        self._diagonals: tuple[FloatArray, FloatArray] | None = None
        self._arena: Arena | None = None
        if len(tree.tasks) == 1 and job.is_silent:
            room = library().bih_factor_room(ctypes.byref(tree.struct), second, inverted)
            self._take_memory(sizes, room)
            self._factor_alone(matrix, room)
            return
        rooms = [max(self._elimination_room(q), self._inversion_room(q) if inverted else 0) for q in tree.tasks]
        handed = tree.blocks_room if second or inverted else tree.blocks_room // 2
        room = handed + min(WORKERS, len(rooms)) * max(rooms)
        self._take_memory(sizes, room)
        arena = Arena(room)
        self._eliminate(matrix, arena, job)
        self._arena = arena if inverted else None

    @property
    def nbytes(self) -> int:
        """Bytes of its blocks."""
        return self._pivots.nbytes + self._boundaries.nbytes

    @cached_property
    def _struct(self) -> kernel.Factor:
        blocks = at(self._areas), at(self._pivots), at(self._boundaries)
        return kernel.Factor(ctypes.pointer(self.tree.struct), *blocks, self._second)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_struct"}

    def _take_memory(self, sizes: list[int], room: int) -> None:
        """Take memory for the arrays of the factor, of these sizes, if `room` more doubles are free to make it in."""
        check_memory(8.0 * (sum(sizes) + room), f"The factor for {self.tree.n:,} vertices", MEMORY_ADVICE)
        self._pivots, self._boundaries = map(np.empty, sizes)

    def _factor_alone(self, matrix: sp.csr_matrix, room: int) -> None:
        """Factor by one call, diagonals included."""
        lib, where = library(), np.empty(2, np.int64)
        rows = rows_of(matrix.indptr, matrix.indices, matrix.data)
        if self._inverted:
            self._diagonals = np.empty(self.tree.n), np.empty(self.tree.n)
        both, work = self._diagonals or (None, None), np.empty(room)
        _check(lib.bih_factor(ctypes.byref(self._struct), ctypes.byref(rows), work, *both, where), where)

    def _elimination_room(self, task: tuple[int, int]) -> int:
        room = np.empty(3, np.int64)
        library().bih_elimination_room(ctypes.byref(self.tree.struct), self._second, *task, room)
        return int(room[2])

    def _inversion_room(self, task: tuple[int, int]) -> int:
        room = np.empty(2, np.int64)
        library().bih_inversion_room(ctypes.byref(self.tree.struct), *task, room)
        return int(room[1])

    def _eliminate(self, matrix: sp.csr_matrix, arena: Arena, job: Job) -> None:
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        rows = rows_of(matrix.indptr, matrix.indices, matrix.data)
        schur = Blocks(len(tree.parent), arena)

        def eliminate(task: tuple[int, int]) -> None:
            where, q = np.zeros(2, np.int64), task[1]
            m = int(tree.bound[q + 1] - tree.bound[q])
            schur.take(q, (2 if self._second else 1) * m * padded(m), 1)
            with arena.of(self._elimination_room(task)) as work:
                status = lib.bih_eliminate(
                    factor, ctypes.byref(rows), *task, schur.address, work, where, ctypes.byref(job.watch)
                )
            _check(status, where)
            if tree.top[q]:
                for child in tree.children[q]:
                    schur.release(child)

        job.run(eliminate, tree.tasks, tree.after)

    def diagonals(self, job: Job, pattern: sp.csr_matrix | None = None) -> tuple[FloatArray, FloatArray]:
        """Return (n,) diag(G) and (n,) diag(G A G), or its imaginary part.

        With a pattern that is part of the tree's, entries (e,) there instead, not of derivatives, and those left of the
        diagonal in elimination order are 0.
        """
        if self._diagonals is not None and pattern is None:
            found, self._diagonals = self._diagonals, None
            return found
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        arena, self._arena, wanted = self._arena, None, None
        if arena is None:
            rooms = [self._inversion_room(task) for task in tree.tasks]
            room = tree.blocks_room + min(WORKERS, len(rooms)) * max(rooms)
            check_memory(8.0 * room, f"The inverse for {tree.n:,} vertices", MEMORY_ADVICE)
            arena = Arena(room)
        if pattern is not None:
            entries = np.zeros((2, pattern.nnz))
            rows = rows_of(pattern.indptr, pattern.indices)
            wanted = ctypes.byref(kernel.Entries(rows, at(entries[0]), at(entries[1]) if self._second else None))
        diagonals, inverse = np.empty((2, tree.n)), Blocks(len(tree.parent), arena)

        def invert(task: tuple[int, int]) -> None:
            q = task[1]
            if tree.top[q]:
                s = int(tree.first[q + 1] - tree.first[q] + tree.bound[q + 1] - tree.bound[q])
                inverse.take(q, 2 * s * padded(s), 2)
            with arena.of(self._inversion_room(task)) as work:
                watch = ctypes.byref(job.watch)
                check_stopped(lib.bih_invert(factor, *task, inverse.address, work, *diagonals, wanted, watch))
            if tree.parent[q] >= 0:
                inverse.release(tree.parent[q])

        job.run(invert, tree.tasks, tree.before)
        first, second = diagonals if pattern is None else entries
        return first, second

    def solve(self, b: FloatArray, out: FloatArray, run: Run, workspaces: Workspaces) -> None:
        """out (n, k) = matrix^-1 b, b (n, k): every task up to the top, the top up and down, and every task down.

        Both may be columns of wider arrays by rows.
        """
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        columns, top = b.shape[1], tree.top_places
        width, struct = _width(columns), ctypes.byref(tree.struct)

        with workspaces.of(tree.n * width) as x:
            if len(tree.tasks) == 1:
                sides = b.ctypes.data, b.strides[0] // 8, out.ctypes.data, out.strides[0] // 8
                lib.bih_solve(factor, columns, width, *sides, x, tree.workspace(width))
                return
            x = x.reshape(tree.n, width)

            def take(task: tuple[int, int]) -> None:
                lib.bih_take_rows(struct, *self._places(task), columns, width, b.ctypes.data, b.strides[0] // 8, x)

            def up(task: tuple[int, int]) -> FloatArray:
                above, end = np.zeros((len(top), width)), int(tree.first[task[1] + 1])
                take(task)
                lib.bih_sweep_up(factor, *task, end, width, x, above, tree.workspace(width), NEVER)
                return above

            def down(task: tuple[int, int]) -> None:
                lib.bih_sweep_down(factor, *task, width, x, tree.workspace(width), NEVER)
                lib.bih_put_rows(struct, *self._places(task), columns, width, x, out.ctypes.data, out.strides[0] // 8)

            for q in tree.tops:
                take((q, q))
            for above in run(up, tree.branches):
                x[top] += above
            for q in tree.tops:
                lib.bih_sweep_up(factor, q, q, tree.n, width, x, None, tree.workspace(width), NEVER)
            for q in reversed(tree.tops):
                down((q, q))
            run(down, tree.branches)

    def _places(self, task: tuple[int, int]) -> tuple[int, int]:
        """Return the first place of a task's pivots, and the first after them."""
        return int(self.tree.first[task[0]]), int(self.tree.first[task[1] + 1])

    def each_sandwich_piece(
        self, index: IntArray, run: Run, receive: Callable[[AnyArray, FloatArray], None], workspaces: Workspaces
    ) -> None:
        """Compute the columns `index` (k,) of G A G in pieces: receive(vertices (r,), values (r, k)), which it may
        change."""
        width, tree = _width(len(index)), self.tree
        count = np.empty(len(tree.parent), np.int32)
        with workspaces.of(tree.n * 2 * width) as xy:
            xy = xy.reshape(tree.n, 2 * width)
            self._send_units(index, xy, count)

            def receive_second(rows: AnyArray, both: FloatArray) -> None:
                # One column is taken from between those of G, among which arithmetic is slow.
                values = both[:, width : width + len(index)]
                receive(rows, values.copy() if width == 1 else values)

            self._sweep_down(run, receive_second, xy, count)

    def complex_columns(self, index: IntArray, run: Run, out: AnyArray, workspaces: Workspaces) -> None:
        """out (n, k) complex: the columns `index` (k,) of the inverse of matrix + i A."""
        count = np.empty(len(self.tree.parent), np.int32)
        with self._complex(out, run, count, workspaces) as xy:
            self._send_units(index, xy, count)

    def complex_solve(self, b: AnyArray, run: Run, out: AnyArray, workspaces: Workspaces) -> None:
        """out (n, k) complex: the inverse of matrix + i A times b (n, k), real or complex."""
        tree, count = self.tree, np.full(len(self.tree.parent), 2, np.int32)
        with self._complex(out, run, count, workspaces) as xy:
            width, columns = xy.shape[1] // 2, b.shape[1]
            xy[:] = 0
            ordered = b[tree.order]
            xy[:, :columns], xy[:, width : width + columns] = ordered.real, ordered.imag
            library().bih_sweep_up_both(ctypes.byref(self._struct), width, xy, count, tree.workspace(2 * width))

    @contextmanager
    def _complex(self, out: AnyArray, run: Run, count: AnyArray, workspaces: Workspaces) -> Iterator[FloatArray]:
        """Yield room for pairs of real and imaginary parts, to be swept up; then they are swept down, to `out`."""
        width, columns = _width(out.shape[1]), out.shape[1]

        def put(rows: AnyArray, both: FloatArray) -> None:
            out.real[rows], out.imag[rows] = both[:, :columns], both[:, width : width + columns]

        with workspaces.of(self.tree.n * 2 * width) as xy:
            yield xy.reshape(self.tree.n, 2 * width)
            self._sweep_down(run, put, xy.reshape(self.tree.n, 2 * width), count)

    def _send_units(self, index: IntArray, xy: FloatArray, count: AnyArray) -> None:
        tree, width = self.tree, xy.shape[1] // 2
        given = tree.place[index], len(index), width, xy, count, tree.workspace(2 * width)
        library().bih_send_units(ctypes.byref(self._struct), *given)

    def _sweep_down(
        self, run: Run, receive: Callable[[AnyArray, FloatArray], None], xy: FloatArray, count: AnyArray
    ) -> None:
        lib, tree, factor = library(), self.tree, ctypes.byref(self._struct)
        width = xy.shape[1] // 2

        def down(task: tuple[int, int]) -> None:
            lib.bih_sweep_down_both(factor, *task, width, xy, count, tree.workspace(2 * width), NEVER)

        def finish(task: tuple[int, int]) -> None:
            down(task)
            places = slice(tree.first[task[0]], tree.first[task[1] + 1])
            receive(tree.order[places], xy[places])

        for q in reversed(tree.tops):
            down((q, q))
        if len(tree.top_places):
            # A copy: those below need it as it is.
            receive(tree.order[tree.top_places], xy[tree.top_places])
        run(finish, tree.branches)


def _check(status: int, where: IntArray) -> None:
    """Raise the error of an elimination's status; `where` is the entry that it is about."""
    if status == kernel.NOT_POSITIVE:
        raise SolverError("The matrix is not positive definite to working accuracy, so it cannot be factored.")
    if status == kernel.OUTSIDE:
        raise ParameterError(f"The entry ({where[0]}, {where[1]}) is outside the pattern of the tree.")
    check_stopped(status)


def _width(columns: int) -> int:
    """Round a number of columns up to what the kernel stores side by side."""
    return 1 if columns == 1 else -(-columns // PAD) * PAD
