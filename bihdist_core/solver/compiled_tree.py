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
    Dissection,
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
"""How often larger ones are cut before the pieces are dissected side by side."""


class CompiledTree:
    """The elimination tree of a pattern (n, n), by rows as `canonical` makes them; x (n, 3), in [-1, 1].

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

    def __init__(self, pattern: sp.csr_matrix, x: FloatArray, progress: Progress | None = None) -> None:
        self.n = len(x)
        matrix = rows_of(pattern.indptr, pattern.indices)
        if library().bih_check_symmetric(ctypes.byref(matrix), np.empty(self.n, np.int32)) == ASYMMETRIC:
            raise ParameterError("The sparsity pattern of the matrix is not symmetric.")
        last, subtrees = self._dissect(matrix, x, part(progress, 0, 0.8))
        self._link(last, subtrees)
        self._lay_out(matrix)
        if progress is not None:
            progress(1.0, "Laying out the factor")

    @cached_property
    def struct(self) -> Tree:
        """The tree as the compiled kernel has it."""
        return Tree(self.n, len(self.parent), *(at(getattr(self, name)) for name in TREE_ARRAYS))

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "struct"}

    @property
    def sizes(self) -> tuple[IntArray, IntArray]:
        """(fronts,), (fronts,): how many pivots and how many boundary rows each front has."""
        return np.diff(self.first).astype(np.int64), np.diff(self.bound)

    @property
    def nbytes(self) -> int:
        """How many bytes its arrays take."""
        return sum(getattr(self, name).nbytes for name in TREE_ARRAYS)

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
        """(n,) `vertices` as NumPy takes indices at once, which gathers in half the time."""
        return self.vertices.astype(np.intp)

    @cached_property
    def top_places(self) -> IntArray:
        """(r,) the places of their pivots."""
        return np.flatnonzero(np.repeat(self.top, self.sizes[0]))

    # ------------------------------------------------------------------ ordering
    def _dissect(self, matrix: Rows, x: FloatArray, progress: Progress) -> tuple[AnyArray, AnyArray]:
        """Fills in `vertices` and `place`; (fronts,) one past the last pivot of each front, and (fronts, 2) how many
        fronts its children's subtrees have."""
        lib, n, entries = library(), self.n, _entries(matrix)
        numbers, region, bins, band, reached = np.empty((5, n), np.int32)
        charts, key = np.empty((7, n), np.float32), np.empty(n, np.float32)
        start, index = np.zeros(n + 1, np.int32), np.empty(entries, np.int32)
        lib.bih_number_graph(ctypes.byref(matrix), x, numbers, bins, start, index, charts, band, reached, key)
        vertices, flow, side = np.empty(n, np.int32), np.empty(8 * n, np.int32), np.empty(n, np.uint8)
        edges, spare = np.empty((2, entries), np.int32)
        workspace = (charts, vertices, edges, spare, region, bins, band, reached, flow, key, side)
        dissection = ctypes.byref(Dissection(rows_of(start, index), *(at(array) for array in workspace)))
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
        root = _Cut(Region(0, n, 0, lib.bih_begin_dissection(dissection)))
        leaves = [root]
        for _ in range(CUTS if n > CUT_ALONE else 0):
            for leaf, halves in zip(leaves, job.run(lambda leaf: cut(leaf.region), leaves), strict=True):
                leaf.halves = [_Cut(half) for half in halves]
            leaves = [half for leaf in leaves for half in leaf.halves or [leaf]]
        for leaf, fronts in zip(leaves, job.run(lambda leaf: dissect(leaf.region), leaves), strict=True):
            leaf.fronts = fronts
        self.vertices = numbers[vertices]
        self.place = np.empty(n, np.int32)
        self.place[self.vertices] = np.arange(n, dtype=np.int32)
        return root.all_fronts()

    # ------------------------------------------------------------------ layout
    def _link(self, last: AnyArray, subtrees: AnyArray) -> None:
        count = len(last)
        self.first = np.concatenate([[0], last]).astype(np.int32)
        self.children = np.full((count, 2), -1, np.int32)
        self.parent = np.full(count, -1, np.int32)
        inner = np.flatnonzero(subtrees[:, 0])
        self.children[inner, 1] = inner - 1
        self.children[inner, 0] = inner - 1 - subtrees[inner, 1]
        self.parent[self.children[inner]] = inner[:, None]
        self._begin = np.arange(count) - subtrees.sum(axis=1)

    def _lay_out(self, matrix: Rows) -> None:
        lib, n, count = library(), self.n, len(self.parent)
        self.bound = np.zeros(count + 1, np.int64)
        for name in ("pivot_block", "row_block", "stack", "inverse"):
            setattr(self, name, np.zeros(count + 1, np.int64))
        self.top, self.rank, scratch = np.zeros(count, np.uint8), np.zeros(n, np.int32), np.empty(n, np.int32)
        room = 12 * n + 64
        while True:
            self.rows = self.up = np.empty(room, np.int32)
            tree = Tree(n, count, *(at(getattr(self, name)) for name in TREE_ARRAYS))
            found = lib.bih_boundaries(ctypes.byref(matrix), ctypes.byref(tree), self.bound, self.rows, room, scratch)
            if found != NO_ROOM:
                break
            room *= 2
        self.rows, self.up = self.rows[:found].copy(), np.empty(found, np.int32)
        c, m = self.sizes
        cp, mp, sp_ = padded(c), padded(m), padded(c + m)
        # The last front comes first, as in a sweep down.
        self.pivot_block[:-1], self.row_block[:-1] = _from_the_end(c * cp), _from_the_end(c * mp)
        self.factor_size = int((c * cp).sum()), int((c * mp).sum())
        total = np.concatenate([[0], np.cumsum(c * (c + m) ** 2)])
        self.work = float(total[-1])
        inside = total[1:] - total[self._begin]
        top = (self.children[:, 0] >= 0) & (inside * TASKS > total[-1]) & (self.n > CUT_ALONE // 4)
        task = top | (self.parent < 0) | top[self.parent]
        self.top = top.astype(np.uint8)
        self.blocks_room = int(2 * max((m * mp)[task].sum(), ((c + m) * sp_)[top].sum()))
        """Doubles of all that tasks hand to each other, with derivatives."""
        self.rank[:] = np.cumsum(np.repeat(top, c)) - 1
        tasks = np.flatnonzero(task)
        self.tasks = [(int(q if top[q] else self._begin[q]), int(q)) for q in tasks]
        number = {int(q): k for k, q in enumerate(tasks)}
        self.after = [[number[int(d)] for d in self.children[q]] if top[q] else [] for q in tasks]
        self.before = [[number[int(self.parent[q])]] if self.parent[q] >= 0 else [] for q in tasks]
        struct = self.struct
        lib.bih_stack(ctypes.byref(struct), self.stack, self.inverse)
        lib.bih_places_in_parents(ctypes.byref(struct), self.up, scratch)


class _Cut:
    """A region of the graph, in halves or with its fronts."""

    def __init__(self, region: Region) -> None:
        self.region = region
        self.halves: list[_Cut] = []
        self.fronts: tuple[AnyArray, AnyArray] = np.empty(0), np.empty(0)

    def all_fronts(self) -> tuple[AnyArray, AnyArray]:
        """Those of the halves, and the separator's."""
        if not self.halves:
            return self.fronts
        (one, one_subtrees), (other, other_subtrees) = (half.all_fronts() for half in self.halves)
        own = np.array([[len(one), len(other)]], np.int32)
        last = np.concatenate([one, other, np.array([self.region.hi], np.int32)])
        return last, np.concatenate([one_subtrees, other_subtrees, own])


def padded(count: Any) -> Any:
    """Rounded up to a multiple of PAD."""
    return -(-count // PAD) * PAD


def _from_the_end(sizes: IntArray) -> IntArray:
    """Where each part starts if the last comes first."""
    return np.cumsum(sizes[::-1])[::-1] - sizes


def _entries(matrix: Rows) -> int:
    return int(ctypes.cast(matrix.start, ctypes.POINTER(ctypes.c_int32))[matrix.n])
