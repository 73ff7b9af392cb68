"""What must be done at least: the bytes and operations that the machine's own limits are asked for."""

import numpy as np

from bihdist_core.solver.elimination_tree import EliminationTree


def column_bytes(tree: EliminationTree) -> float:
    """Bytes of the factor that one column needs: N and N1 of every front, but of leaves N and K."""
    c, m, leaf = _sizes(tree)
    return float(8 * (c * np.where(leaf, m + c, 2 * m)).sum())


def operations(tree: EliminationTree) -> float:
    """Floating-point operations of the dual elimination and inversion."""
    c, m, leaf = _sizes(tree)
    up = 2 * c**3 + 3 * 2 * c**2 * m + 2 * 2 * c * m**2 + 2 * 2 * c**3
    down = 3 * 2 * c * m**2 + 3 * 2 * c**2 * m
    up_leaf = c**3 + 2 * c**2 * m + 2 * c * m**2
    down_leaf = 2 * 2 * c * m**2 + c**2 * m
    return float(np.where(leaf, up_leaf + down_leaf, up + down).sum())


def _sizes(tree: EliminationTree) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(fronts,) each: pivots, boundary rows, and whether a front has no children."""
    c, m = (size.astype(float) for size in tree.sizes)
    return c, m, tree.layout.children[:, 0] < 0
