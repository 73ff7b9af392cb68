"""Solves with a finished factor: sweeps up and down the branches of the tree.

x is a branch's vector, (end + 1, k): k columns in the order of its places.  Up: x[boundary] += N^T x[pivots].
Down: x[pivots] = K x[pivots] + N x[boundary].  The dual sweep carries the columns' derivatives as k more columns:
with G = L^-1 it turns a unit vector into a column of G and one of G A G at once.

`run` says how to treat the branches: one after the other, or side by side.
"""

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from .elimination import Block
from .elimination_tree import Branch, EliminationTree

NARROW = 4
"""Up to this many columns, one matrix-vector product each is faster than a matrix product."""


class Run(Protocol):
    """[function(item) for item in items], somehow."""

    def __call__(self, function: Any, items: Any, /) -> list[Any]: ...


def solve_into(result: np.ndarray, tree: EliminationTree, blocks: Sequence[Block], b: np.ndarray, run: Run) -> None:
    """result (n, k) = L^-1 b, b (n, k)."""
    top, k = tree.top, b.shape[1]

    def up(branch: Branch) -> np.ndarray:
        x = np.zeros((branch.end + 1, k))
        x[branch.places] = b[branch.vertices]
        _sweep_up(branch, blocks, x)
        return x

    def down(branch: Branch, x: np.ndarray) -> None:
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


def sandwich_into(
    result: np.ndarray, tree: EliminationTree, blocks: Sequence[Block], index: np.ndarray, run: Run
) -> None:
    """result (n, k) = the columns `index` (k,) of L^-1 A L^-1."""
    k = len(index)
    vectors = [np.zeros((part.end + 1, 2 * k)) for part in tree.parts]
    for column, vertex in enumerate(index):
        _sweep_up_unit(tree, blocks, int(vertex), [x[:, column::k] for x in vectors])

    def down(p: int) -> None:
        part, x = tree.parts[p], vectors[p]
        x[: part.above] = vectors[0][: part.above]
        _sweep_down_dual(part, blocks, x)
        result[part.vertices] = x[part.places, k:]

    down(0)
    run(down, range(1, len(vectors)))


def _sweep_up_unit(tree: EliminationTree, blocks: Sequence[Block], vertex: int, vectors: list[np.ndarray]) -> None:
    """Eliminate a one at `vertex`, and its derivative, and apply K and K1: only from its front to the root is there
    anything to do.  vectors: 2 columns for each part of the tree."""
    path = []
    front = int(tree.node[vertex])
    home = tree.part_of(front)
    vectors[home][tree.place[vertex], 0] = 1
    while front:
        if home and not tree.part_of(front):
            above = tree.parts[home].above
            vectors[0][:above] += vectors[home][:above]
            home = 0
        stack, k = tree.stacks[tree.stack_of[front]], tree.member[front]
        block = blocks[stack.index]
        start = tree.corner[front]
        pivots = vectors[home][start : start + stack.pivots]
        path.append((pivots, block.K[k], block.K1[k]))
        sent = block.N[k].T @ pivots
        sent[:, 1] += block.N1[k].T @ pivots[:, 0]
        # Several padded rows share the dummy's place, but all of them send zeros.
        vectors[home][stack.bound[k]] += sent
        front >>= 1
    for pivots, K, K1 in path:
        applied = K @ pivots
        applied[:, 1] += K1 @ pivots[:, 0]
        pivots[:] = applied


def _sweep_up(branch: Branch, blocks: Sequence[Block], x: np.ndarray) -> None:
    k = x.shape[1]
    for level in reversed(branch.levels):
        sent = np.empty((level.gather.shape[1], k))
        at = 0
        for stack in level.stacks:
            b, c, m = stack.shape
            out = sent[at : at + b * m].reshape(b, m, k)
            _multiply(blocks[stack.index].N.swapaxes(1, 2), x[stack.span].reshape(b, c, k), out)
            at += b * m
        x[level.touched] += level.gather @ sent


def _sweep_down(branch: Branch, blocks: Sequence[Block], x: np.ndarray) -> None:
    k = x.shape[1]
    for stack in branch.stacks:
        b, c, _ = stack.shape
        block = blocks[stack.index]
        pivots = x[stack.span].reshape(b, c, k)
        result = _multiply(block.K, pivots)
        result += _multiply(block.N, x.take(stack.bound, axis=0, mode="clip"))
        pivots[:] = result


def _sweep_down_dual(branch: Branch, blocks: Sequence[Block], x: np.ndarray) -> None:
    k = x.shape[1] // 2
    for stack in branch.stacks:
        b, c, _ = stack.shape
        block = blocks[stack.index]
        above = x.take(stack.bound, axis=0, mode="clip")
        pivots = x[stack.span].reshape(b, c, 2 * k)
        pivots += _multiply(block.N, above)
        pivots[:, :, k:] += _multiply(block.N1, above[:, :, :k])


def _multiply(N: np.ndarray, x: np.ndarray, out: np.ndarray | None = None) -> np.ndarray:
    """N @ x for stacks N (b, c, m) and x (b, m, k)."""
    k = x.shape[2]
    if k == 1 or k > NARROW:
        return np.matmul(N, x, out=out)
    # Product by product, so that a front is still in the cache for its next column.
    result = np.matmul(N[:, None], x.swapaxes(1, 2)[..., None])[..., 0].swapaxes(1, 2)
    if out is None:
        return result
    out[:] = result
    return out
