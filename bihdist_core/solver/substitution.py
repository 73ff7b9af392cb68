"""Solves with a finished factor: sweeps up and down the branches of the tree.

x is a branch's vector, (end + 1, k): k columns in the order of its places.  Up: x[boundary] += N x[pivots].
Down: x[pivots] = K x[pivots] + N^T x[boundary].  In complex numbers (see `elimination`) the same sweeps turn a unit
vector into a column of G = L^-1 and one of G A G at once, as its real and its imaginary part.

A single column is bound by memory: each number of the factor is read once.  So it pays to have few, large stacks,
which keep NumPy's calls long, and to let go of the interpreter lock in each of them.

`run` says how to treat the branches: one after the other, or side by side.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np

from ..arrays import AnyArray, ComplexArray, FloatArray, IntArray
from .elimination import Block
from .elimination_tree import Branch, EliminationTree

NARROW = 4
"""Up to this many columns, one matrix-vector product each is faster than a matrix product."""

FEW = 3
"""So many entries of a right-hand side that are not 0 are eliminated one by one."""

HELD = 500
"""NumPy's stacked products keep the interpreter lock if they have no more results than this ..."""
LONG = 1 << 13
"""... which matters if each of them reads as many numbers as this."""

PIECE = 1 << 16
"""How many numbers are worked on at a time where they should stay in the cache."""

Receive = Callable[[IntArray, FloatArray], None]
Started = dict[int, list[tuple[int, int, ComplexArray]]]
"""By stack: which of its fronts, which column, and (c,) complex, what the sweep up brought to its pivots."""


class Run(Protocol):
    """[function(item) for item in items], somehow."""

    def __call__(self, function: Any, items: Any, /) -> list[Any]: ...


def solve_into(result: FloatArray, tree: EliminationTree, blocks: Sequence[Block], b: FloatArray, run: Run) -> None:
    """result (n, k) = L^-1 b, b (n, k)."""
    top, k = tree.top, b.shape[1]

    def up(branch: Branch) -> FloatArray:
        x, own = np.zeros((branch.end + 1, k)), b[branch.vertices]
        x[branch.places] = own
        filled = branch.vertices[np.flatnonzero(own.any(axis=1))]
        if len(filled) <= FEW:
            _sweep_up_paths(tree, branch, blocks, filled, x)
        else:
            _sweep_up(branch, blocks, x)
        return x

    def down(branch: Branch, x: FloatArray) -> None:
        x[: branch.above] = whole[: branch.above]
        _sweep_down(branch, blocks, x)
        result[branch.vertices] = x[branch.places]

    vectors = run(up, tree.branches)
    whole = np.zeros((top.end + 1, k))
    whole[top.places] = b[top.vertices]
    for branch, x in zip(tree.branches, vectors, strict=True):
        whole[: branch.above] += x[: branch.above]
    _sweep_up(top, blocks, whole)
    down(top, whole)
    run(lambda p: down(tree.branches[p], vectors[p]), range(len(vectors)))


def sandwich_columns(
    tree: EliminationTree, blocks: Sequence[Block], index: IntArray, run: Run, receive: Receive
) -> None:
    """The columns `index` (k,) of L^-1 A L^-1, in pieces: receive(vertices (r,), values (r, k)) gets to keep them.

    A piece is small, so that what the receiver makes of it is made in the cache; it may be called from two threads.
    """
    k = len(index)
    started: Started = defaultdict(list)
    for column, vertex in enumerate(index):
        _sweep_up_unit(tree, blocks, int(vertex), column, started)
    whole = np.empty((tree.top.end + 1, k), complex)

    def down(part: Branch, x: ComplexArray) -> None:
        x[: part.above] = whole[: part.above]
        x[-1] = 0
        _sweep_down_started(part, blocks, started, x)
        rows = max(1, PIECE // k)
        for start in range(0, len(part.vertices), rows):
            some = slice(start, start + rows)
            receive(part.vertices[some], x.take(part.places[some], axis=0, mode="clip").imag)

    down(tree.top, whole)
    run(lambda branch: down(branch, np.empty((branch.end + 1, k), complex)), tree.branches)


def _sweep_up_unit(tree: EliminationTree, blocks: Sequence[Block], vertex: int, column: int, started: Started) -> None:
    """Eliminate a one at `vertex`, and note in `started` what comes to the pivots: only from its front to the root is
    there anything to do."""
    front = int(tree.node[vertex])
    # The places of the top come first in every part's vectors, so this one reaches up to the root.
    x = np.zeros(tree.parts[tree.part_of(front)].end + 1, complex)
    x[tree.place[vertex]] = 1
    while front:
        stack, k = tree.stacks[tree.stack_of[front]], tree.member[front]
        start = tree.corner[front]
        pivots = x[start : start + stack.pivots]
        started[stack.index].append((k, column, pivots))
        # Several padded rows share the dummy's place, but all of them send zeros.
        x[stack.bound[k]] += blocks[stack.index].M[k] @ pivots
        front >>= 1


def _sweep_up(branch: Branch, blocks: Sequence[Block], x: FloatArray) -> None:
    k = x.shape[1]
    for level in reversed(branch.levels):
        sent = np.empty((level.gather.shape[1], k))
        at = 0
        for stack in level.stacks:
            b, c, m = stack.shape
            out = sent[at : at + b * m].reshape(b, m, k)
            _multiply(blocks[stack.index].N, x[stack.span].reshape(b, c, k), out)
            at += b * m
        x[level.touched] += level.gather @ sent


def _sweep_up_paths(
    tree: EliminationTree, branch: Branch, blocks: Sequence[Block], vertices: IntArray, x: FloatArray
) -> None:
    """The same where x is 0 but at a few vertices: their fronts and those above have all there is to do."""
    fronts = {front >> up for front in tree.node[vertices].tolist() for up in range(front.bit_length() - branch.first)}
    for front in sorted(fronts, reverse=True):
        stack, k = tree.stacks[tree.stack_of[front]], tree.member[front]
        pivots = x[tree.corner[front] : tree.corner[front] + stack.pivots]
        # Several padded rows share the dummy's place, but all of them send zeros.
        x[stack.bound[k]] += blocks[stack.index].N[k] @ pivots


def _sweep_down(branch: Branch, blocks: Sequence[Block], x: FloatArray) -> None:
    k = x.shape[1]
    for stack in branch.stacks:
        b, c, _ = stack.shape
        block = blocks[stack.index]
        pivots = x[stack.span].reshape(b, c, k)
        result = _multiply(block.K, pivots)
        result += _multiply(block.N.swapaxes(1, 2), x.take(stack.bound, axis=0, mode="clip"))
        pivots[:] = result


def _sweep_down_started(branch: Branch, blocks: Sequence[Block], started: Started, x: ComplexArray) -> None:
    k = x.shape[1]
    for stack in branch.stacks:
        b, c, m = stack.shape
        block = blocks[stack.index]
        Mt = block.M.swapaxes(1, 2)
        pivots = x[stack.span].reshape(b, c, k)
        some = max(1, PIECE // (k * m))
        for start in range(0, b, some):
            part = slice(start, start + some)
            _multiply(Mt[part], x.take(stack.bound[part], axis=0, mode="clip"), pivots[part])
        for front, column, first in started.get(stack.index, ()):
            # (K + i K1) first, without the product of the two imaginary parts, which is nothing.
            K, K1, real, imaginary = block.K[front], block.K1[front], first.real.copy(), first.imag.copy()
            pivots[front, :, column].real += K @ real
            pivots[front, :, column].imag += K @ imaginary + K1 @ real


def _multiply(N: AnyArray, x: AnyArray, out: AnyArray | None = None) -> AnyArray:
    """N @ x for stacks N (b, r, s) and x (b, s, k)."""
    (b, r, s), k = N.shape, x.shape[2]
    if k == 1 and b * r <= HELD and r * s >= LONG:
        result: AnyArray = np.empty((b, r, 1)) if out is None else out
        for front in range(b):
            np.dot(N[front], x[front, :, 0], out=result[front, :, 0])
        return result
    if k == 1 or k > NARROW:
        return np.matmul(N, x, out=out)
    # Product by product, so that a front is still in the cache for its next column.
    result = np.matmul(N[:, None], x.swapaxes(1, 2)[..., None])[..., 0].swapaxes(1, 2)
    if out is None:
        return result
    out[:] = result
    return out
