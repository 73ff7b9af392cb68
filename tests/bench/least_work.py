"""What must be done at least: the bytes and operations that the machine's own limits are asked for."""

import numpy as np

from bihdist_core.solver.elimination_tree import EliminationTree


def _front_sizes(tree: EliminationTree) -> tuple[np.ndarray, np.ndarray]:
    """Pivots and boundary vertices of each front, padding not counted."""
    pivots = np.bincount(tree.node[: tree.n], minlength=2 << tree.depth)
    bounds = np.zeros(len(pivots), np.int64)
    for part in tree.parts:
        for stack in part.stacks:
            bounds[stack.nodes] = (stack.bound < part.end).sum(axis=1)
    return pivots.astype(float), bounds.astype(float)


def column_bytes(tree: EliminationTree) -> float:
    """Bytes of the factor that one column needs: N and N1 of every front."""
    pivots, bounds = _front_sizes(tree)
    return float(16 * (pivots * bounds).sum())


def operations(tree: EliminationTree) -> float:
    """Floating-point operations of the dual elimination and inversion."""
    c, m = _front_sizes(tree)
    up = 2 * c**3 + 2 * 2 * c**3 + 3 * 2 * c**2 * m + 2 * 2 * c * m**2
    down = 3 * 2 * c * m**2 + 3 * 2 * c**2 * m
    return float((up + down).sum())
