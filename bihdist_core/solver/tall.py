"""Products of tall arrays (many rows, few columns) in row chunks on our own worker threads; for use inside
`blas.one_blas_thread`.

Where a product has few results it is np.dot's: np.matmul would keep the interpreter lock meanwhile.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar

import numpy as np
import scipy.sparse as sp

from ..arrays import FloatArray, IntArray
from ..progress import Progress, silent
from .worker_threads import Job, side_by_side

Result = TypeVar("Result")

Blocks = Sequence[FloatArray]
"""Columns of a tall array, (n, k) each."""

ROWS = 1024
"""Rows multiplied at a time: enough to keep a core busy, few enough to stay in its cache."""

PAIR_NUMBERS = 1 << 20
"""Coordinates of pairs of points that are gathered at a time."""


def gram(blocks: Blocks, y: FloatArray, weights: FloatArray) -> FloatArray:
    """Return (j, k) products x^T diag(weights) y of x (n, j), in blocks of columns, and y (n, k)."""

    def one(rows: slice) -> Any:
        weighted = weights[rows, None] * y[rows]
        return np.concatenate([np.dot(x[rows].T, weighted) for x in blocks])

    product: FloatArray = sum(over_rows(one, len(y)))
    return product


def own_gram(x: FloatArray, weights: FloatArray) -> FloatArray:
    """Return (k, k) products x^T diag(weights) x of x (n, k), weights of at least 0: half the work."""
    root = np.sqrt(weights)

    def one(rows: slice) -> Any:
        weighted = root[rows, None] * x[rows]
        return np.dot(weighted.T, weighted)

    product: FloatArray = sum(over_rows(one, len(x)))
    return product


def multiply(blocks: Blocks, c: FloatArray) -> FloatArray:
    """Return (n, k) product of x (n, j), in blocks of columns, and c (j, k)."""
    out = np.empty((len(blocks[0]), c.shape[1]))

    over_rows(lambda rows: np.matmul(_joined(blocks, rows), c, out=out[rows]), len(out))
    return out


def subtract(y: FloatArray, blocks: Blocks, c: FloatArray) -> None:
    """y -= x c, in place; y (n, k), x (n, j) in blocks of columns, c (j, k)."""

    def one(rows: slice) -> None:
        part = y[rows]
        for x, each in _with_rows(blocks, c):
            part -= x[rows] @ each

    over_rows(one, len(y))


def centre(x: FloatArray, weights: FloatArray) -> None:
    """Make the mean, weighted by weights (n,), of each column of x (n, k) zero, in place."""
    mean = sum(over_rows(lambda rows: np.dot(weights[rows], x[rows]), len(x))) / weights.sum()

    def one(rows: slice) -> None:
        x[rows] -= mean

    over_rows(one, len(x))


def recombine(blocks: list[FloatArray], c: FloatArray) -> list[FloatArray]:
    """Blocks of the columns of x c; x (n, j), in blocks of columns whose memory is used again, c (j, k), k <= j."""
    k = c.shape[1]
    kept = [x for x, each in _with_rows(blocks, np.arange(sum(x.shape[1] for x in blocks))) if each[0] < max(k, 1)]

    def one(rows: slice) -> None:
        mixed = _joined(blocks, rows) @ c
        first = 0
        for x in kept:
            some = mixed[:, first : first + x.shape[1]]
            x[rows, : some.shape[1]] = some
            first += x.shape[1]

    over_rows(one, len(blocks[0]))
    left = k - sum(x.shape[1] for x in kept[:-1])
    return [*kept[:-1], np.ascontiguousarray(kept[-1][:, :left])]


def _joined(blocks: Blocks, rows: slice) -> FloatArray:
    """Return some rows of x."""
    return blocks[0][rows] if len(blocks) == 1 else np.concatenate([x[rows] for x in blocks], axis=1)


def _with_rows(blocks: Blocks, c: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Yield each block with the rows of c (j, ...) that belong to its columns."""
    first = 0
    for x in blocks:
        yield x, c[first : first + x.shape[1]]
        first += x.shape[1]


def point_distances(x: FloatArray, y: FloatArray, progress: Progress | None = None) -> FloatArray:
    """Return (n, j) Euclidean distances of points x (n, k) from points y (j, k), of their differences: nothing
    cancels."""
    out, job = np.empty((len(x), len(y))), Job(progress, "Measuring points", len(x) * len(y))

    def one(rows: slice) -> None:
        for column, point in enumerate(y):
            apart = x[rows] - point
            np.sqrt(np.einsum("ij,ij->i", apart, apart), out=out[rows, column])
            job.advance(len(apart))

    chunks = chunks_of(len(x))
    if progress in (None, silent):
        side_by_side(one, chunks)
    else:
        job.run(one, chunks)
    return out


def pair_distances(points: FloatArray, i: IntArray, j: IntArray, progress: Progress | None = None) -> FloatArray:
    """Return (q,) Euclidean distances of q pairs of points i, j (q,) of the points (n, k)."""
    out, step = np.empty(len(i)), max(1, PAIR_NUMBERS // max(1, points.shape[1]))
    for start in range(0, len(i), step):
        (progress or silent)(start / len(i), "Measuring pairs of points")
        some = slice(start, start + step)
        apart = points[i[some]] - points[j[some]]
        np.sqrt(np.einsum("ij,ij->i", apart, apart), out=out[some])
    return out


def sparse_rows(matrix: sp.csr_matrix, rows: slice) -> sp.csr_matrix:
    """Return some rows of a sparse matrix, sharing its memory."""
    first, last = matrix.indptr[rows.start], matrix.indptr[rows.stop]
    parts = (matrix.data[first:last], matrix.indices[first:last], matrix.indptr[rows.start : rows.stop + 1] - first)
    return sp.csr_matrix(parts, shape=(rows.stop - rows.start, matrix.shape[1]))


def over_rows(work: Callable[[slice], Result], n: int) -> list[Result]:
    """Do `work` for each chunk of n rows, and return the results in order."""
    return side_by_side(work, chunks_of(n))


def chunks_of(n: int) -> list[slice]:
    """n rows in chunks."""
    return [slice(first, min(first + ROWS, n)) for first in range(0, n, ROWS)]
