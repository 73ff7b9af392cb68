"""Distances as roots of squares that are sums of large terms, among them those of G A G (paper, Eq. 4)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import SolverError
from ..kernel.library import library

ROUNDING = 1e-7
"""Squared distances below zero by less than this share of their terms are rounding; more is a broken operator."""


def root(squares: FloatArray, terms: FloatArray | float) -> FloatArray:
    """Return the square root of squared distances, computed as sums of `terms` (their size; broadcasts).

    Values below zero by rounding become 0; SolverError if one is further below, or not a number.
    """
    if squares.size and not squares.min() >= -ROUNDING * (terms.max() if isinstance(terms, np.ndarray) else terms):
        worst = float(np.nanmin(squares)) if not np.isnan(squares).all() else float("nan")
        raise SolverError(f"A squared distance came out as {worst:g}: the mesh is too badly shaped for its operator.")
    distances = np.maximum(squares, 0)
    return np.sqrt(distances, out=distances)


Write = Callable[[AnyArray, slice, FloatArray], IntArray]


def writer_of_distances(
    diagonal: FloatArray, u: FloatArray, area: float, index: IntArray, limit: float, out: FloatArray
) -> Write:
    """Return a function of vertices (r,), a slice of the sources and values (r, k) of G A G, which writes distances to
    out.

    diagonal (n,) of C = G A G - u u^T / area; index (s,) the sources; out (n, s).  It may change the values and returns
    (k,) how many squared distances are below the limit; SolverError where one is negative by more than rounding.
    """
    own, share, largest = diagonal[index], u[index] / area, diagonal.max()

    def compiled(rows: AnyArray, columns: slice, values: FloatArray) -> IntArray:
        near, to = np.zeros(values.shape[1], np.int64), out[:, columns]
        bad = library().bih_distances(
            *values.shape, rows, values.ctypes.data, values.strides[0] // 8, diagonal, u, own[columns], share[columns],
            -ROUNDING * largest, limit, near, to.ctypes.data, to.strides[0] // 8,
        )  # fmt: skip
        return plain(rows, columns, values) if bad else near

    def plain(rows: AnyArray, columns: slice, values: FloatArray) -> IntArray:
        values -= u[rows][:, None] * share[columns]
        values *= -2
        values += diagonal[rows][:, None]
        values += own[columns]
        out[rows, columns] = root(values, largest)
        near: IntArray = np.count_nonzero(values < limit, axis=0)
        return near

    return plain if library() is None else compiled
