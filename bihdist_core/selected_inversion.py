"""The diagonals of G = L^-1 and of G A G without their other entries: Takahashi's selected inversion, dual.

Top down each front gets the blocks Z of G and H of G A G on its own rows (1: pivots, 2: boundary), of which the
boundary's are part of its parent's.  With K, N, K1, N1 of the elimination:
    Z12 = N Z22              Z11 = K + N Z21
    H12 = N1 Z22 + N H22     H11 = K1 + N1 Z21 + N H21.
"""

import numpy as np

from .elimination import Block
from .elimination_tree import Branch, EliminationTree
from .worker_threads import Job


def invert_branch(
    tree: EliminationTree,
    branch: Branch,
    above: list[np.ndarray],
    blocks: list[Block],
    diagonals: tuple[np.ndarray, np.ndarray],
    job: Job,
) -> list[np.ndarray]:
    """Fill in diag(G) and diag(G A G), (n,) each, at the branch's vertices; returns Z, H of its lowest level.

    above: Z and H of the level above the branch, each the level's fronts one after the other.
    """
    own = [np.zeros(branch.end), np.zeros(branch.end)]
    for depth, level in enumerate(branch.levels, branch.first):
        leaf = depth == tree.depth
        here = [np.empty(0 if leaf else level.size) for _ in range(2)]
        for stack in level.stacks:
            b, c, m = stack.shape
            block = blocks[stack.index]
            K, N, K1, N1 = block.K, block.N, block.K1, block.N1
            if depth:
                at = tree.parent_positions(stack, slice(None))
                Z22, H22 = (buffer.take(at, mode="clip") for buffer in above)
                del at
            else:
                Z22 = H22 = np.zeros((b, m, m))
            Z12 = N @ Z22
            H12 = N1 @ Z22
            H12 += N @ H22
            if leaf:
                diagonal = np.einsum("bii->bi", K) + _row_dots(N, Z12)
                sandwich = np.einsum("bii->bi", K1) + _row_dots(N1, Z12) + _row_dots(N, H12)
            else:
                window = slice(stack.base, stack.base + stack.size)
                Z, H = (buffer[window].reshape(b, c + m, c + m) for buffer in here)
                Z21, H21 = Z12.swapaxes(1, 2), H12.swapaxes(1, 2)
                Z[:, c:, c:], Z[:, :c, c:], Z[:, c:, :c] = Z22, Z12, Z21
                H[:, c:, c:], H[:, :c, c:], H[:, c:, :c] = H22, H12, H21
                Z[:, :c, :c] = K + N @ Z21
                H[:, :c, :c] = K1 + N1 @ Z21 + N @ H21
                diagonal, sandwich = (np.einsum("bii->bi", x[:, :c, :c]) for x in (Z, H))
            own[0][stack.span], own[1][stack.span] = diagonal.ravel(), sandwich.ravel()
            job.advance(stack.work)
        above = here
    for diagonal, mine in zip(diagonals, own, strict=True):
        diagonal[branch.vertices] = mine[branch.places]
    return above


def _row_dots(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """(b, c): the product of the same row of x and y, both (b, c, m)."""
    return np.einsum("bcm,bcm->bc", x, y)
