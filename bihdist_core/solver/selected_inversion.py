"""The diagonals of G = L^-1 and of G A G without their other entries: Takahashi's selected inversion.

Top down each front gets the block Z of G on its own rows (1: pivots, 2: boundary), of which the boundary's is part
of its parent's.  With K and N of the elimination:
    Z21 = Z22 N    Z11 = K + N^T Z21.
In complex numbers (see `elimination`) the imaginary parts of all that are those of G A G.
"""

import numpy as np

from ..arrays import AnyArray, ComplexArray
from .elimination import Block
from .elimination_tree import Branch, EliminationTree
from .worker_threads import Job


def invert_branch(
    tree: EliminationTree,
    branch: Branch,
    above: AnyArray,
    blocks: list[Block],
    diagonal: ComplexArray,
    job: Job,
) -> AnyArray:
    """Fill in diag(G) + i diag(G A G), (n,), at the branch's vertices; returns Z of its lowest level.

    above: Z of the level above the branch, the level's fronts one after the other.
    """
    own = np.zeros(branch.end, complex)
    for depth, level in enumerate(branch.levels, branch.first):
        leaf = depth == tree.depth
        here = np.empty(0 if leaf else level.size, complex)
        for stack in level.stacks:
            b, c, m = stack.shape
            block = blocks[stack.index]
            M, Mt = block.M, block.M.swapaxes(1, 2)
            Z22 = np.zeros((b, m, m), complex)
            if depth:
                above.take(tree.parent_positions(stack, slice(None)), out=Z22, mode="clip")
            Z21 = Z22 @ M
            if leaf:
                Z21 *= M
                mine = Z21.sum(axis=1)
                mine += _diagonal(block.K) + 1j * _diagonal(block.K1)
            else:
                Z = here[stack.base : stack.base + stack.size].reshape(b, c + m, c + m)
                Z[:, c:, c:], Z[:, :c, c:], Z[:, c:, :c] = Z22, Z21.swapaxes(1, 2), Z21
                Z11 = Mt @ Z21
                Z11.real += block.K
                Z11.imag += block.K1
                Z[:, :c, :c] = Z11
                mine = _diagonal(Z11)
            own[stack.span] = mine.ravel()
            job.advance(stack.work)
        above = here
    diagonal[branch.vertices] = own[branch.places]
    return above


def _diagonal(x: AnyArray) -> AnyArray:
    """(b, c) of x (b, c, c)."""
    diagonal: AnyArray = np.einsum("bii->bi", x)
    return diagonal
