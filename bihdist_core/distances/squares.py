"""Roots of squared distances that were computed as sums of large terms."""

from __future__ import annotations

import numpy as np

from ..arrays import FloatArray
from ..errors import SolverError

ROUNDING = 1e-7
"""Squared distances below zero by less than this share of their terms are rounding; more is a broken operator."""


def root(squares: FloatArray, terms: FloatArray | float) -> FloatArray:
    """Square root of squared distances, computed as sums of `terms` (their size; broadcasts).

    Values below zero by rounding become 0; SolverError if one is further below, or not a number.
    """
    if squares.size and not squares.min() >= -ROUNDING * (terms.max() if isinstance(terms, np.ndarray) else terms):
        worst = float(np.nanmin(squares)) if not np.isnan(squares).all() else float("nan")
        raise SolverError(f"A squared distance came out as {worst:g}: the mesh is too badly shaped for its operator.")
    distances = np.maximum(squares, 0)
    return np.sqrt(distances, out=distances)
