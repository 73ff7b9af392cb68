"""The layout of a sparse Cholesky-like factor: which dense fronts there are and where everything lies.

The tree of the nested dissection is the elimination tree.  Node f is one dense "front": it eliminates its own
vertices, its pivots, and touches some vertices of its ancestors, its boundary.  Fronts of one level do not touch
each other, so those of like size are padded, stacked, and handled by one NumPy call on 3-D arrays; only levels and
stacks are looped over in Python.  The top of the tree is small; the branches under it are independent.

Sizes: n vertices; a stack has b fronts with c pivots and m boundary vertices, s = c + m.  The last boundary vertex
of a front is always a dummy.  A branch's vectors have the places of the top first, then its own, stack by stack with
the padding in place, so that the pivots of a stack are a slice, and at the end one dummy place.  Padded rows and
the dummy hold zeros.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..progress import Progress, part
from .blas import one_blas_thread
from .ordering import nested_dissection
from .worker_threads import Job

LEAF = 40
"""Most vertices a leaf of the tree has, on the average; they get at least half of it."""
SPLIT = 1
"""There are 2**SPLIT branches, worked on side by side."""
LIKE = 1.2
"""Fronts whose sizes differ by at most this factor share a stack."""
PASSES, CALLS = 10, 5e6
"""What the passes over each number of a front, and the calls for a stack, cost: as much as so many operations."""
STACK = 1 << 21
"""Most numbers in one stack of fronts (16 MiB): it should be done in a moment, for progress and cancelling."""


@dataclass(eq=False)
class Stack:
    """Fronts of one level with like sizes, those that are left children (even numbers) first.

    index: its number in the tree; nodes (b,); left: how many left children; pivots c; boundary m;
    base: where its fronts (b, s, s) start in its level's buffer; span: the places of its b * c pivots;
    bound (b, m): the places of its boundary; up (b, m): where its boundary is in the parents' fronts.
    """

    index: int
    nodes: IntArray
    left: int
    pivots: int
    boundary: int
    base: int
    span: slice
    bound: IntArray
    up: IntArray

    @property
    def shape(self) -> tuple[int, int, int]:
        """(b, c, m)."""
        return len(self.nodes), self.pivots, self.boundary

    @property
    def size(self) -> int:
        """How many numbers its fronts have."""
        return len(self.nodes) * (self.pivots + self.boundary) ** 2

    @property
    def work(self) -> float:
        """About how many operations its elimination takes."""
        return float(_work(*self.shape))


@dataclass
class Level:
    """The stacks of one level of a branch; size: how many numbers all their fronts have.

    touched (t,): the places that lie on their boundaries; gather (t, sum of b * m): sums what they send there.
    """

    stacks: list[Stack] = field(default_factory=list)
    size: int = 0
    touched: IntArray = field(default_factory=lambda: np.zeros(0, np.int64))
    gather: sp.csr_matrix = None


@dataclass
class Branch:
    """The fronts under one tree node, `root`, on the levels first to last - 1.

    above: how many places of its vectors belong to the top; end: the dummy's place; vertices (k,), places (k,): its
    own vertices and where they lie; keys: front * (n + 1) + vertex for each boundary vertex of each front, ascending,
    and one for the dummy.
    """

    root: int
    first: int
    last: int
    above: int = 0
    end: int = 0
    levels: list[Level] = field(default_factory=list)
    vertices: IntArray = field(default_factory=lambda: np.zeros(0, np.int64))
    places: IntArray = field(default_factory=lambda: np.zeros(0, np.int64))
    keys: IntArray = field(default_factory=lambda: np.zeros(0, np.int64))

    def nodes(self, level: int) -> tuple[int, int]:
        """First node on a level, and one past the last."""
        return self.root << level - self.first, self.root + 1 << level - self.first

    @property
    def stacks(self) -> list[Stack]:
        """Top down."""
        return [stack for level in self.levels for stack in level.stacks]


class EliminationTree:
    """Order and layout for all matrices with one sparsity pattern.

    pattern: (n, n) sparse, symmetric; only where it has entries matters, and its diagonal does not.
    coordinates: (n, 3), finite, used for the ordering only.  Raises ParameterError if the shapes do not fit, the
    pattern is not symmetric or a coordinate is not finite.
    """

    def __init__(self, pattern: sp.spmatrix, coordinates: FloatArray, progress: Progress | None = None) -> None:
        coordinates = _checked_coordinates(pattern, coordinates)
        self.n = n = len(coordinates)
        self.depth = max(0, int(np.ceil(np.log2(max(n, 1) / LEAF))))
        split = SPLIT if self.depth > SPLIT + 2 else 0
        i, j = _edges(pattern)
        with one_blas_thread():
            # Vertex n is the dummy.
            self.node = np.r_[nested_dissection(i, j, coordinates, self.depth, split, part(progress, 0, 0.7)), 0]
            fronts = 2 << self.depth
            self._order = np.argsort(self.node[:n], kind="stable")
            self._pivots = np.bincount(self.node[:n], minlength=fronts)
            self._first = np.cumsum(self._pivots) - self._pivots
            self.slot = np.empty(n + 1, np.int64)
            """(n + 1,) which of its front's pivots a vertex is."""
            self.slot[self._order] = np.arange(n) - self._first[self.node[self._order]]
            self.slot[n] = 0
            # Of each front: how many boundary vertices, and where they start in its branch's keys; c and s; where it
            # starts in its level's buffer; where its pivots start in its branch's vectors; its stack, and which of it.
            (
                self._bounds,
                self.key_start,
                self.width,
                self.size,
                self.offset,
                self.corner,
                self.stack_of,
                self.member,
            ) = np.zeros((8, fronts), np.int64)
            self.place = np.zeros(n + 1, np.int64)
            """(n + 1,) of each vertex in its branch's vectors."""
            self.top = Branch(1, 0, split)
            self.branches = [Branch(root, split, self.depth + 1) for root in range(1 << split, 2 << split)]
            self._build(i, j, part(progress, 0.7, 1))
        del self._order, self._pivots, self._first, self._bounds

    @property
    def parts(self) -> list[Branch]:
        """The top, then the branches."""
        return [self.top, *self.branches]

    def part_of(self, front: int) -> int:
        """Which of `parts` a front belongs to."""
        depth = front.bit_length() - 1
        first = self.top.last
        return 0 if depth < first else (front >> depth - first) - (1 << first) + 1

    @property
    def nbytes(self) -> int:
        """How many bytes its large arrays take."""
        return 8 * (2 * sum(s.bound.size + s.up.size for p in self.parts for s in p.stacks) + 3 * self.n)

    # ------------------------------------------------------------------ building
    def _build(self, i: IntArray, j: IntArray, progress: Progress) -> None:
        n, node = self.n, self.node
        outside = node[i] != node[j]
        i, j = i[outside], j[outside]
        # Each edge that leaves a front, in the front of its deeper end.
        near = np.where(node[i] > node[j], node[i] * (n + 1) + j, node[j] * (n + 1) + i)
        near.sort()
        job = Job(progress, "Laying out the factor", 2 * (self.depth + 1) * (len(self.branches) + 1))
        nothing = np.zeros(0, np.int64)
        below = job.run(lambda branch: self._reach(branch, near, nothing, job), self.branches)
        self._reach(self.top, near, np.concatenate(below), job)
        self._lay_out(self.top, job)
        job.run(lambda branch: self._lay_out(branch, job), self.branches)
        job.finish()
        for index, stack in enumerate(stack for part_ in self.parts for stack in part_.stacks):
            stack.index = index
            self.stack_of[stack.nodes] = index
            self.member[stack.nodes] = np.arange(len(stack.nodes))
        self.stacks = [stack for part_ in self.parts for stack in part_.stacks]

    def _reach(self, branch: Branch, near: IntArray, below: IntArray, job: Job) -> IntArray:
        """Bottom up: a front's boundary is what its pivots' edges and its children's boundaries reach above it."""
        n, keys = self.n, [below[:0]]
        for level in range(branch.last - 1, branch.first - 1, -1):
            parent, vertex = below // (n + 1) >> 1, below % (n + 1)
            lo, hi = np.searchsorted(near, np.array(branch.nodes(level)) * (n + 1))
            below = _sorted_once(np.r_[near[lo:hi], (parent * (n + 1) + vertex)[self.node[vertex] != parent]])
            keys.append(below)
            job.advance(1)
        # Upper levels have smaller numbers, so all of it ascends; the last key is the dummy's, in no front.
        branch.keys = np.concatenate([*keys[::-1], [(2 << self.depth) * (n + 1) + n]])
        front, start, count = np.unique(branch.keys[:-1] // (n + 1), return_index=True, return_counts=True)
        self.key_start[front], self._bounds[front] = start, count
        return below

    def _lay_out(self, branch: Branch, job: Job) -> None:
        """Top down: stack the fronts of a branch and say where everything is."""
        branch.above = branch.end = 0 if branch is self.top else self.top.end
        vertices = [self._order[:0]]
        for depth in range(branch.first, branch.last):
            lo, hi = branch.nodes(depth)
            vertices.append(self._order[self._first[lo] : self._first[hi - 1] + self._pivots[hi - 1]])
            parent_keys = (self.top if depth == branch.first else branch).keys
            nodes = np.arange(lo, hi)
            level = Level()
            for like in _alike(nodes, self._pivots[nodes], self._bounds[nodes]):
                self._add_stack(branch, level, like, parent_keys, root=depth == 0)
            own = vertices[-1]
            self.place[own] = self.corner[self.node[own]] + self.slot[own]
            branch.levels.append(level)
            job.advance(1)
        branch.vertices = np.concatenate(vertices)
        branch.places = self.place[branch.vertices]
        for level in branch.levels:
            for stack in level.stacks:
                # Until now it held vertices; the dummy's place was not known before.
                stack.bound[:] = np.where(stack.bound == self.n, branch.end, self.place[stack.bound])
            _add_gather(level)

    def _add_stack(self, branch: Branch, level: Level, nodes: IntArray, parent_keys: IntArray, root: bool) -> None:
        n = self.n
        c, m = max(1, int(self._pivots[nodes].max())), int(self._bounds[nodes].max()) + 1
        take = np.where(np.arange(m) < self._bounds[nodes, None], self.key_start[nodes, None] + np.arange(m), -1)
        bound = branch.keys[take] % (n + 1)
        up = np.zeros_like(bound)
        if not root:
            parent = nodes[:, None] >> 1
            inner = np.searchsorted(parent_keys, parent * (n + 1) + bound) - self.key_start[parent] + self.width[parent]
            up = np.where(self.node[bound] == parent, self.slot[bound], inner)
            up = np.where(bound == n, self.size[parent] - 1, up)
        stop = branch.end + len(nodes) * c
        left = int((nodes & 1 == 0).sum())
        stack = Stack(0, nodes, left, c, m, level.size, slice(branch.end, stop), bound, up)
        self.corner[nodes] = np.arange(branch.end, stop, c)
        self.width[nodes], self.size[nodes] = c, c + m
        self.offset[nodes] = level.size + np.arange(len(nodes)) * (c + m) ** 2
        branch.end = stop
        level.size += stack.size
        level.stacks.append(stack)

    def parent_positions(self, stack: Stack, half: slice) -> IntArray:
        """(h, m, m): where the boundary blocks of the stack's fronts `half` lie in the buffer of the parents' level."""
        parent, up = stack.nodes[half, None, None] >> 1, stack.up[half]
        positions: IntArray = self.offset[parent] + up[:, :, None] * self.size[parent] + up[:, None, :]
        return positions


def _add_gather(level: Level) -> None:
    bound = np.concatenate([stack.bound.ravel() for stack in level.stacks])
    level.touched, row = np.unique(bound, return_inverse=True)
    order = np.argsort(row.ravel(), kind="stable")
    starts = np.r_[0, np.cumsum(np.bincount(row.ravel(), minlength=len(level.touched)))]
    shape = len(level.touched), len(bound)
    level.gather = sp.csr_matrix((np.ones(len(bound)), order, starts), shape=shape)


def _work(b: Any, c: Any, m: Any) -> Any:
    """About how many operations stacks of b fronts with c pivots and m boundary vertices cost."""
    return b * (c + m) ** 2.0 * (c + 0.1 * m + PASSES) + CALLS


def _alike(nodes: IntArray, pivots: IntArray, bounds: IntArray) -> Iterator[IntArray]:
    """The nodes in groups of like sizes, in each the left children first.

    Two groups become one as long as that saves more calls than it costs padding.
    """
    bucket = np.ceil(np.log(np.stack([np.maximum(pivots, 1), bounds + 1])) / np.log(LIKE)).astype(np.int64)
    _, group = np.unique(bucket[0] * 1000 + bucket[1], return_inverse=True)
    count = np.bincount(group)
    c, m = np.ones_like(count), np.ones_like(count)
    np.maximum.at(c, group, pivots)
    np.maximum.at(m, group, bounds + 1)
    work = _work(count, c, m)

    def saved(some: Any) -> FloatArray:
        """(k, groups) by joining each of `some` with each group."""
        one = np.arange(len(count))[some, None]
        gains = work[one] + work - _work(count[one] + count, np.maximum(c[one], c), np.maximum(m[one], m))
        return np.where(one == np.arange(len(count)), -np.inf, gains)

    gains = saved(slice(None))
    while gains.max(initial=0) > 0:
        one, other = divmod(int(gains.argmax()), len(count))
        group[group == other] = one
        count[one] += count[other]
        c[one], m[one] = max(c[one], c[other]), max(m[one], m[other])
        work[one], work[other] = _work(count[one], c[one], m[one]), -np.inf
        gains[other] = gains[:, other] = -np.inf
        gains[one] = gains[:, one] = saved([one])[0]
    for label in np.flatnonzero(work > 0):
        members = nodes[group == label]
        most = max(1, STACK // int(c[label] + m[label]) ** 2)
        for some in np.array_split(members, -(-len(members) // most)):
            yield some[np.argsort(some & 1, kind="stable")]


def _sorted_once(keys: IntArray) -> IntArray:
    """np.unique, which for whole numbers is several times slower than sorting them."""
    keys = np.sort(keys)
    unique: IntArray = keys[np.r_[True, keys[1:] != keys[:-1]][: len(keys)]]
    return unique


def _edges(pattern: sp.spmatrix) -> tuple[IntArray, IntArray]:
    """(e,), (e,): the ends of the edges, each once."""
    rows = sp.csr_matrix(pattern, copy=True)
    rows.sum_duplicates()
    columns = rows.tocsc()
    if not (np.array_equal(rows.indptr, columns.indptr) and np.array_equal(rows.indices, columns.indices)):
        raise ParameterError("The sparsity pattern of the matrix is not symmetric.")
    row = np.repeat(np.arange(rows.shape[0]), np.diff(rows.indptr))
    low = row > rows.indices
    return row[low], rows.indices[low].astype(np.int64)


def _checked_coordinates(pattern: sp.spmatrix, coordinates: FloatArray) -> FloatArray:
    coordinates = np.asarray(coordinates, np.float64)
    n = pattern.shape[0]
    if pattern.shape != (n, n) or coordinates.shape != (n, 3):
        raise ParameterError(
            f"A pattern of shape {pattern.shape} and coordinates of shape {coordinates.shape} do not fit; "
            "they must be (n, n) and (n, 3)."
        )
    if not np.isfinite(coordinates).all():
        raise ParameterError("The coordinates must be finite numbers.")
    return coordinates
