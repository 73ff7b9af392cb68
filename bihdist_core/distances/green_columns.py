"""Biharmonic distances from columns of G A G, in one pass by the compiled kernel (paper, Eq. 4)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..kernel.library import library
from .squares import ROUNDING, root

Write = Callable[[AnyArray, slice, FloatArray], IntArray]


def writer_of_distances(
    diagonal: FloatArray, u: FloatArray, area: float, index: IntArray, limit: float, out: FloatArray
) -> Write:
    """A function of vertices (r,), a slice of the sources and values (r, k) of G A G, which writes distances to out.

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
