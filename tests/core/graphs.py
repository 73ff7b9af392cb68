"""Matrices of graphs of all kinds, with places (n, 3) of their vertices, for tests of the factor."""

import numpy as np
import scipy.sparse as sp


def laplacian(n, i, j, weight=None):
    weight = np.ones(len(i)) if weight is None else weight
    upper = sp.coo_matrix((weight, (i, j)), shape=(n, n)).tocsr()
    upper = upper + upper.T
    return (sp.diags(np.asarray(upper.sum(1)).ravel()) - upper).tocsr()


def pinned(matrix, pins=(0,)):
    """Rows and columns `pins` replaced by the identity's."""
    keep = np.ones(matrix.shape[0])
    keep[list(pins)] = 0
    inner = (sp.diags(keep) @ matrix @ sp.diags(keep)).tocsr()
    inner.eliminate_zeros()
    return (inner + sp.diags(1 - keep)).tocsr()


def grid(rows, columns, seed=0):
    ids = np.arange(rows * columns).reshape(rows, columns)
    i = np.r_[ids[:, :-1].ravel(), ids[:-1].ravel(), ids[:-1, :-1].ravel()]
    j = np.r_[ids[:, 1:].ravel(), ids[1:].ravel(), ids[1:, 1:].ravel()]
    y, x = np.divmod(np.arange(rows * columns), columns)
    weight = np.random.default_rng(seed).uniform(0.2, 2, len(i))
    return pinned(laplacian(rows * columns, i, j, weight)), np.stack([x, y, np.sin(x / 3)], 1)


def random_spd(n, per_vertex, seed=0):
    rng = np.random.default_rng(seed)
    i, j = rng.integers(n, size=(2, per_vertex * n))
    weight = rng.normal(size=len(i))[i != j]
    i, j = i[i != j], j[i != j]
    off = sp.coo_matrix((weight, (i, j)), shape=(n, n)).tocsr()
    off = off + off.T
    return (off + sp.diags(np.asarray(abs(off).sum(1)).ravel() + 0.1)).tocsr(), rng.normal(size=(n, 3))


def path(n):
    return pinned(laplacian(n, np.arange(n - 1), np.arange(1, n)), (n // 2,)), np.c_[np.arange(n), np.zeros((n, 2))]


def star(n):
    hub = laplacian(n, np.zeros(n - 1, int), np.arange(1, n))
    return pinned(hub, (1,)), np.random.default_rng(0).normal(size=(n, 3))


def islands():
    """Two grids, three single vertices and a pin in each."""
    one, x = grid(12, 15)
    two, y = grid(9, 20, seed=1)
    return sp.block_diag([one, sp.identity(3), two], format="csr"), np.concatenate([x, np.zeros((3, 3)), y])


def complete(n):
    i, j = np.triu_indices(n, 1)
    return pinned(laplacian(n, i, j)), np.random.default_rng(0).normal(size=(n, 3))


def moved(shape, change):
    matrix, x = shape
    return matrix, change(x.astype(float))


def identity(n):
    return sp.identity(n, format="csr") * 3.0, np.random.default_rng(0).normal(size=(n, 3))


SHAPES = {
    "n = 0": identity(0),
    "n = 1": identity(1),
    "n = 2": path(2),
    "n = 3": path(3),
    "small grid": grid(5, 6),
    "grid": grid(25, 35),
    "strip": grid(3, 300),
    "path": path(600),
    "star": star(700),
    "islands": islands(),
    "complete": complete(150),
    "isolated": identity(500),
    "random sparse": random_spd(600, 1),
    "random dense": random_spd(300, 8),
    "one place": moved(grid(20, 30), lambda x: 0 * x),
    "two places": moved(grid(20, 30), lambda x: np.round(x / 30)),
    "huge": moved(grid(20, 30), lambda x: x * 1e150),
    "tiny": moved(grid(20, 30), lambda x: x * 1e-150),
}
