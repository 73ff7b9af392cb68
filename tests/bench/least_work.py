"""What must be done at least: the bytes and operations that the machine's own limits are asked for."""

from bihdist_core.solver.elimination_tree import EliminationTree


def column_bytes(tree: EliminationTree) -> float:
    """Bytes of the factor that one column needs: N and N1 of every front."""
    c, m = tree.sizes
    return float(16 * (c * m).sum())


def operations(tree: EliminationTree) -> float:
    """Floating-point operations of the dual elimination and inversion."""
    c, m = (size.astype(float) for size in tree.sizes)
    up = 2 * c**3 + 2 * 2 * c**3 + 3 * 2 * c**2 * m + 2 * 2 * c * m**2
    down = 3 * 2 * c * m**2 + 3 * 2 * c**2 * m
    return float((up + down).sum())
