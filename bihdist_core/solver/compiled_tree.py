"""The elimination tree of the compiled kernel: its fronts, where everything lies, and what can be done side by side.

Fronts are numbered in postorder, so that a subtree is a range of them; `kernel/kernel.h` says what the arrays are.
"""

import ctypes
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError
from ..kernel.library import (
    ASYMMETRIC,
    NO_ROOM,
    TREE_ARRAYS,
    Region,
    Rows,
    Tree,
    at,
    check_stopped,
    library,
    rows_of,
)
from ..progress import Progress, part
from .worker_threads import Job

PAD = 4
"""Rows of dense blocks are padded to so many numbers."""
TASKS = 8
"""A subtree of more than the TASKS-th part of the whole work is not one task."""
CUT_ALONE = 20_000
"""Smaller graphs are dissected by one thread."""
CUTS = 3
"""Cuts of larger graphs before the pieces are dissected side by side."""


class CompiledTree:
    """The elimination tree of a pattern (n, n), by rows as `canonical` makes them; x (n, 3), finite.

    Raises ParameterError if the pattern is not symmetric.
    """

    vertices: npt.NDArray[np.int32]
    place: npt.NDArray[np.int32]
    first: npt.NDArray[np.int32]
    children: npt.NDArray[np.int32]
    parent: npt.NDArray[np.int32]
    bound: IntArray
    rows: npt.NDArray[np.int32]
    up: npt.NDArray[np.int32]
    pivot_block: IntArray
    row_block: IntArray
    stack: IntArray
    inverse: IntArray
    top: npt.NDArray[np.uint8]
    rank: npt.NDArray[np.int32]

    factor_size: list[int]
    """Numbers of all K and of all N, without derivatives."""
    work: int
    """The work of an elimination, in the unit of `Job.advance`."""
    blocks_room: int
    """Numbers of all that tasks hand to each other, with derivatives."""
    longest_row: int
    """Numbers of the longest row of a front, with its padding."""
    tasks: list[tuple[int, int]]
    """The first front and the last of each group that is eliminated as one."""
    after: list[list[int]]
    before: list[list[int]]
    """The numbers of the tasks that come before each, bottom up and top down."""

    def __init__(self, pattern: sp.csr_matrix, x: FloatArray, progress: Progress | None = None) -> None:
        self.n = len(x)
        matrix = rows_of(pattern.indptr, pattern.indices)
        self.vertices, self.place = np.empty((2, self.n), np.int32)
        dissection = np.empty(library().bih_dissection_room(self.n, pattern.nnz), np.uint8)
        if self._is_small:
            self._lay_out(matrix, *self._dissect_alone(matrix, x, dissection))
        else:
            self._lay_out(matrix, *self._dissect(matrix, x, dissection, part(progress, 0, 0.8)))
        if progress is not None:
            progress(1.0, "Laying out the factor")

    @cached_property
    def struct(self) -> Tree:
        """The tree as the compiled kernel has it."""
        return Tree(self.n, len(self.parent), *(at(getattr(self, name)) for name in TREE_ARRAYS))

    @property
    def _is_small(self) -> bool:
        """True if one thread does all of it, and nobody hears of its progress."""
        return self.n <= CUT_ALONE // 4

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "struct"}

    @property
    def sizes(self) -> tuple[IntArray, IntArray]:
        """The numbers of pivots (fronts,) and of boundary rows (fronts,) of each front."""
        return np.diff(self.first).astype(np.int64), np.diff(self.bound)

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        return sum(getattr(self, name).nbytes for name in ("order", *TREE_ARRAYS))

    @cached_property
    def branches(self) -> list[tuple[int, int]]:
        """The subtrees below the top, siblings as one: first and last front of each."""
        merged: list[tuple[int, int]] = []
        for first, last in self.tasks:
            if not self.top[last]:
                begin = merged.pop()[0] if merged and merged[-1][1] + 1 == first else first
                merged.append((begin, last))
        return merged

    @cached_property
    def tops(self) -> list[int]:
        """The fronts above the branches, in postorder."""
        return [int(q) for q in np.flatnonzero(self.top)]

    @cached_property
    def order(self) -> IntArray:
        """The `vertices` (n,) as NumPy takes indices at once, which gathers in half the time."""
        return self.vertices.astype(np.intp)

    @cached_property
    def top_places(self) -> IntArray:
        """The places (r,) of their pivots."""
        if len(self.tasks) == 1:
            return np.empty(0, np.int64)
        return np.array([p for q in self.tops for p in range(self.first[q], self.first[q + 1])], np.int64)

    def workspace(self, width: int) -> FloatArray:
        """Return the workspace for sweeps of so many columns."""
        return np.empty((self.longest_row + 2 * PAD) * width + 2 * PAD)

    # ------------------------------------------------------------------ ordering
    def _dissect_alone(self, matrix: Rows, x: FloatArray, dissection: AnyArray) -> tuple[AnyArray, AnyArray]:
        """Fills in `vertices` and `place`; (fronts,) one past the last pivot of each front, and (fronts, 2) how many
        fronts its children's subtrees have."""
        last, subtrees = np.empty(2 * self.n + 1, np.int32), np.empty((2 * self.n + 1, 2), np.int32)
        found = library().bih_order(ctypes.byref(matrix), x, dissection, self.vertices, self.place, last, subtrees)
        count = _checked_symmetric(found)
        return last[:count], subtrees[:count]

    def _dissect(
        self, matrix: Rows, x: FloatArray, dissection: AnyArray, progress: Progress
    ) -> tuple[AnyArray, AnyArray]:
        """Do what `_dissect_alone` does, in several threads."""
        lib, n = library(), self.n
        edges = _checked_symmetric(lib.bih_begin_dissection(ctypes.byref(matrix), x, dissection))
        job = Job(progress, "Ordering the vertices", n)

        def cut(region: Region) -> list[Region]:
            halves = (Region * 2)()
            return list(halves) if lib.bih_cut(dissection, ctypes.byref(region), halves) else []

        def dissect(region: Region) -> tuple[AnyArray, AnyArray]:
            most = 2 * (region.hi - region.lo) + 1
            last, subtrees = np.empty(most, np.int32), np.empty((most, 2), np.int32)
            count = check_stopped(
                lib.bih_dissect(dissection, ctypes.byref(region), 0, last, subtrees, ctypes.byref(job.watch))
            )
            return last[:count], subtrees[:count]

        # Cut a few times, level by level; then dissect what there is by then.
        root = _Cut(Region(0, n, 0, edges))
        leaves = [root]
        for _ in range(CUTS if n > CUT_ALONE else 0):
            for leaf, halves in zip(leaves, job.run(lambda leaf: cut(leaf.region), leaves), strict=True):
                leaf.halves = [_Cut(half) for half in halves]
            leaves = [half for leaf in leaves for half in leaf.halves or [leaf]]
        for leaf, fronts in zip(leaves, job.run(lambda leaf: dissect(leaf.region), leaves), strict=True):
            leaf.fronts = fronts
        lib.bih_end_dissection(dissection, self.vertices, self.place)
        return root.all_fronts()

    # ------------------------------------------------------------------ layout
    def _lay_out(self, matrix: Rows, last: AnyArray, subtrees: AnyArray) -> None:
        n, count = self.n, len(last)
        self.first, self.children, self.parent = (np.empty(k, np.int32) for k in (count + 1, (count, 2), count))
        self.bound, self.pivot_block, self.row_block, self.stack, self.inverse = np.empty((5, count + 1), np.int64)
        self.top, self.rank, work = np.empty(count, np.uint8), np.empty(n, np.int32), np.empty(3 * n, np.int32)
        totals, tasks = np.empty(5, np.int64), 0 if self._is_small else TASKS
        room, found = 6 * n + 64, NO_ROOM
        self.rows = self.up = np.empty(0, np.int32)
        struct = self.struct
        while found == NO_ROOM:
            room *= 2
            rows, up = np.empty((2, room), np.int32)
            struct.rows, struct.up = at(rows), at(up)
            found = library().bih_lay_out(
                ctypes.byref(matrix), ctypes.byref(struct), last, subtrees, tasks, room, work, totals
            )
        self.rows, self.up = rows[:found].copy(), up[:found].copy()
        struct.rows, struct.up = at(self.rows), at(self.up)
        *self.factor_size, self.work, self.blocks_room, self.longest_row = totals.tolist()
        if not tasks:
            self.tasks, self.after, self.before = [(0, count - 1)], [[]], [[]]
            return
        top, parent = self.top, self.parent
        task = [int(q) for q in np.flatnonzero(top | (parent < 0) | (top[parent] > 0))]
        number = {q: k for k, q in enumerate(task)}
        self.tasks = [(q if top[q] else self._first_below(q), q) for q in task]
        self.after = [[number[int(d)] for d in self.children[q]] if top[q] else [] for q in task]
        self.before = [[number[int(parent[q])]] if parent[q] >= 0 else [] for q in task]

    def _first_below(self, front: int) -> int:
        """Return the first front of a subtree."""
        while (child := self.children[front, 0]) >= 0:
            front = int(child)
        return front


class _Cut:
    """A region of the graph, in halves or with its fronts."""

    def __init__(self, region: Region) -> None:
        self.region = region
        self.halves: list[_Cut] = []
        self.fronts: tuple[AnyArray, AnyArray] = np.empty(0), np.empty(0)

    def all_fronts(self) -> tuple[AnyArray, AnyArray]:
        """Return the fronts of the halves, and the separator's."""
        if not self.halves:
            return self.fronts
        (one, one_subtrees), (other, other_subtrees) = (half.all_fronts() for half in self.halves)
        own = np.array([[len(one), len(other)]], np.int32)
        last = np.concatenate([one, other, np.array([self.region.hi], np.int32)])
        return last, np.concatenate([one_subtrees, other_subtrees, own])


def _checked_symmetric(found: int) -> int:
    if found == ASYMMETRIC:
        raise ParameterError("The sparsity pattern of the matrix is not symmetric.")
    return found


def padded(count: int) -> int:
    """Rounded up to a multiple of PAD."""
    return -(-count // PAD) * PAD
