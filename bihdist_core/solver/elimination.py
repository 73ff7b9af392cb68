"""The numeric factorization: eliminate the fronts of a branch, bottom up, with dual numbers where areas are given.

With the pivots' block F, the rows below them R and the rest Q of a front,
    K = F^-1    N = -R K    Schur complement S = Q + N R^T, added into the parent's front.
Every quantity X of the matrix L carries its derivative along L + t A, since d/dt (L + t A)^-1 = -G A G with
G = L^-1.  K1 and N1 are minus the derivatives of K and N, so that all that follows adds up to +G A G:
    K1 = K F1 K    N1 = (R1 + N F1) K    S1 = Q1 + X + X^T,  X = (R1 + N F1 / 2) N^T.

What is computed with these later is computed with the complex numbers K + i K1 and N + i N1: if A is scaled so far
down that its square is lost in rounding, complex arithmetic is the arithmetic of derivatives to the last digit
("complex step"; Squire and Trapp 1998), and one product does the work of three.
"""

from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sp

from ..arrays import ComplexArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from .elimination_tree import Branch, EliminationTree, Stack
from .worker_threads import Job

SINGULAR = 1e-14
"""A pivot below this share of its diagonal entry is nothing but rounding."""
STIFF = 3e-2
"""If one falls below this share, K has lost digits that matter: beside a degenerate face, of height h, rows have
entries of size 1 / h, and what K lacks comes back in S = Q + N R^T magnified by as much once more."""


@dataclass
class Block:
    """What is kept of a stack: K, K1 (b, c, c), N (b, m, c) and M = N + i N1; K1 and M are empty without areas."""

    K: FloatArray
    N: FloatArray
    K1: FloatArray = field(default_factory=lambda: np.zeros(0))
    M: ComplexArray = field(default_factory=lambda: np.zeros(0, complex))

    @property
    def nbytes(self) -> int:
        """Bytes of its matrices."""
        return self.K.nbytes + self.N.nbytes + self.K1.nbytes + self.M.nbytes


@dataclass(frozen=True)
class Entries:
    """The entries of a matrix below its diagonal, ordered by the stack they belong to.

    near, far (e,): their vertices, the one in the front first; value (e,); starts: where each stack's begin.
    diagonal (n,); areas (n,), scaled as the matrix, or None.
    """

    near: IntArray
    far: IntArray
    value: FloatArray
    starts: IntArray
    diagonal: FloatArray
    areas: FloatArray | None


Schur = list[tuple[Stack, list[FloatArray]]]
"""Stacks with their Schur complements (b, m, m), and the derivatives of these if there are areas."""


def entries_by_stack(tree: EliminationTree, matrix: sp.csr_matrix, areas: FloatArray | None) -> Entries:
    """The entries of the (n, n) matrix, of which only the diagonal and what is below it are read."""
    low = sp.tril(matrix, -1, format="coo")
    keep = low.data != 0
    i, j, value = low.row[keep].astype(np.int64), low.col[keep].astype(np.int64), low.data[keep]
    # An entry belongs to the front of its deeper end, which has the larger number.
    swap = tree.node[i] < tree.node[j]
    i, j = np.where(swap, j, i), np.where(swap, i, j)
    stack = tree.stack_of[tree.node[i]]
    order = np.argsort(stack.astype(np.uint16) if len(tree.stacks) <= 1 << 16 else stack, kind="stable")
    starts = np.searchsorted(stack[order], np.arange(len(tree.stacks) + 1))
    return Entries(i[order], j[order], value[order], starts, matrix.diagonal(), areas)


def eliminate_branch(
    tree: EliminationTree, branch: Branch, below: Schur, entries: Entries, blocks: list[Block | None], job: Job
) -> Schur:
    """Fill in the blocks of a branch's stacks; takes and empties the Schur complements below it, returns its own."""
    dual = entries.areas is not None
    start = entries.starts[branch.stacks[0].index]
    positions = _positions(tree, branch, entries)
    diagonals = _diagonals(branch, entries)
    for level in reversed(branch.levels):
        # With children all fronts of the level are needed at once; leaves are made one stack at a time.
        whole: list[FloatArray] = []
        if below:
            whole = [np.zeros(level.size) for _ in range(1 + dual)]
            _add_children(tree, whole, below, job)
        done: Schur = []
        for stack in level.stacks:
            b, c, m = stack.shape
            window = slice(stack.base, stack.base + stack.size)
            fronts = [buffer[window] for buffer in whole] or [np.zeros(stack.size)]
            lo, hi = entries.starts[stack.index : stack.index + 2]
            for position in positions:
                fronts[0][position[lo - start : hi - start] - stack.base] += entries.value[lo:hi]
            F = [front.reshape(b, c + m, c + m) for front in fronts]
            k = np.arange(c)
            for front, diagonal in zip(F, diagonals, strict=False):
                front[:, k, k] += diagonal[stack.span].reshape(b, c)
            leaf_areas = diagonals[1][stack.span].reshape(b, c) if dual and not whole else None
            block, schur = _eliminate(F, c, leaf_areas, diagonals[0][stack.span].reshape(b, c))
            blocks[stack.index] = block
            done.append((stack, schur))
            job.advance(stack.work)
        below = done
    return below


def _positions(tree: EliminationTree, branch: Branch, entries: Entries) -> tuple[IntArray, IntArray]:
    """Where the branch's entries lie in their levels' buffers, below the diagonal and above it."""
    lo, hi = entries.starts[branch.stacks[0].index], entries.starts[branch.stacks[-1].index + 1]
    near, far = entries.near[lo:hi], entries.far[lo:hi]
    front = tree.node[near]
    key = front * (tree.n + 1) + far
    at = np.searchsorted(branch.keys, key)
    inside = tree.node[far] == front
    missing = np.flatnonzero(~inside & (branch.keys[at] != key))
    if len(missing):
        i, j = near[missing[0]], far[missing[0]]
        raise ParameterError(f"The matrix has an entry at ({i}, {j}), which its elimination tree has no place for.")
    row = np.where(inside, tree.slot[far], at - tree.key_start[front] + tree.width[front])
    column, size, offset = tree.slot[near], tree.size[front], tree.offset[front]
    return offset + row * size + column, offset + column * size + row


def _diagonals(branch: Branch, entries: Entries) -> list[FloatArray]:
    """The matrix' diagonal, and the areas if given, at the branch's places; a padded pivot is a 1 on the diagonal."""
    diagonals = [np.ones(branch.end)]
    diagonals[0][branch.places] = entries.diagonal[branch.vertices]
    if entries.areas is not None:
        diagonals.append(np.zeros(branch.end))
        diagonals[1][branch.places] = entries.areas[branch.vertices]
    return diagonals


def _add_children(tree: EliminationTree, buffers: list[FloatArray], below: Schur, job: Job) -> None:
    """Add the Schur complements to the parents' fronts and let go of them."""
    # A front has one child of each hand, so within one hand no position comes twice; what the left children find is
    # still zero, so they are just stored.
    for stack, schur in below:
        half = slice(0, stack.left)
        at = tree.parent_positions(stack, half)
        for buffer, S in zip(buffers, schur, strict=True):
            buffer[at] = S[half]
        job.advance(0)
    while below:
        stack, schur = below.pop()
        half = slice(stack.left, None)
        at = tree.parent_positions(stack, half)
        for buffer, S in zip(buffers, schur, strict=True):
            old = buffer.take(at, mode="clip")
            old += S[half]
            buffer[at] = old
        job.advance(0)


def _eliminate(
    F: list[FloatArray], c: int, leaf_areas: FloatArray | None, scale: FloatArray
) -> tuple[Block, list[FloatArray]]:
    """Eliminate the first c rows of the fronts F[0] (b, s, s), with their derivatives F[1] or, of leaves, diag(areas).

    scale (b, c): the matrix' diagonal there.  Raises SolverError if a pivot block is not positive definite.
    """
    P, R, Q = F[0][:, :c, :c], F[0][:, c:, :c], F[0][:, c:, c:]
    K, is_stiff = _inverse(P, scale)
    N = R @ K
    np.negative(N, out=N)
    if is_stiff:
        # One step of iterative refinement: N P = -R then holds to rounding, as after a solve with a Cholesky factor.
        N -= (R + N @ P) @ K
    S = N @ R.swapaxes(1, 2)
    S += Q
    if leaf_areas is not None:
        T = leaf_areas[:, :, None] * K
        N1 = N @ T
        X = (N * (0.5 * leaf_areas[:, None, :])) @ N.swapaxes(1, 2)
        X += X.swapaxes(1, 2).copy()
        return Block(K, N, K @ T, _complex(N, N1)), [S, X]
    if len(F) == 1:
        return Block(K, N), [S]
    T, U = F[1][:, :c, :c] @ K, N @ F[1][:, :c, :c]
    U += F[1][:, c:, :c]
    N1 = U @ K
    U += F[1][:, c:, :c]
    U *= 0.5
    X = U @ N.swapaxes(1, 2)
    X += X.swapaxes(1, 2).copy()
    X += F[1][:, c:, c:]
    return Block(K, N, K @ T, _complex(N, N1)), [S, X]


def _complex(real: FloatArray, imaginary: FloatArray) -> ComplexArray:
    result = np.empty(real.shape, complex)
    result.real, result.imag = real, imaginary
    return result


def _inverse(F: FloatArray, scale: FloatArray) -> tuple[FloatArray, bool]:
    """(b, c, c) inverses, and whether they have lost digits.

    The Cholesky factor costs a tenth of them and tells both that and what is not positive definite.
    """
    try:
        root = np.einsum("bii->bi", np.linalg.cholesky(F))
        left = (root**2 / scale).min()
        if left > SINGULAR:
            return np.linalg.inv(F).astype(float, copy=False), bool(left < STIFF)
    except np.linalg.LinAlgError:
        pass
    raise SolverError("The matrix is not positive definite to working accuracy, so it cannot be factored.")
