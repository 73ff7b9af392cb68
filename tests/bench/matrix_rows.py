"""Row 29: the diagonal of the inverse of sparse matrices beside solving column by column, and distances of graphs."""

from collections.abc import Callable, Iterator

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import minimum_spanning_tree
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay

from bihdist_core import BiharmonicDistance, Laplacian, diagonal_of_inverse

from . import peers
from .case import difference
from .meshes import bumpy_sphere
from .size import Size
from .table import Line
from .timing import timed

SOLVED = 64
"""Columns that the peer solves; all would take so many times as long as there are."""
MOST = 15.0
"""Seconds that distances of graphs may take."""


def matrices(size: Size) -> Iterator[Line]:
    named = (("mesh", _mesh(size.main)), ("grid in three dimensions", _grid(size.main)), ("roads", _roads(size.main)))
    for name, matrix in named:
        matrix = (matrix + sp.diags_array(matrix.diagonal() * 1e-3)).tocsc()
        n = matrix.shape[0]
        ours, diagonal = timed(lambda m=matrix: diagonal_of_inverse(m))
        at = np.linspace(0, n - 1, SOLVED).astype(int)
        units = np.zeros((n, SOLVED))
        units[at, np.arange(SOLVED)] = 1
        for program, factor in _programs():
            made, solve = timed(lambda m=matrix, f=factor: f(m))
            solved, columns = timed(lambda s=solve, b=units: s(b))
            expected = columns[at, np.arange(SOLVED)]
            peer = made + solved * n / SOLVED
            yield Line(
                29,
                f"diagonal of the inverse, {name}, {n:,}",
                ours,
                peer,
                ours / peer,
                bound=0.05,
                error=difference(diagonal[at], expected, over=expected.max()),
                tolerance=1e-9,
                note=f"peer: factor and all columns by {program}, {SOLVED} of them timed",
            )
    # Short edges are solved for one by one, so that those of a million nodes take minutes.
    for n, work, of in (
        (size.main, "the distances of all edges", BiharmonicDistance.edge_distances),
        (size.graph, "the distances of one node to all", lambda distance: distance.from_source(0)),
    ):
        laplacian = Laplacian.from_matrices(_roads(n), np.ones(n))
        seconds, _ = timed(lambda of=of, made=laplacian: of(BiharmonicDistance(made)))
        yield Line(29, f"{work}, roads, {n:,}", seconds, value=seconds, bound=MOST, note="with the set-up")


def _programs() -> list[tuple[str, Callable[[sp.csc_matrix], Callable[[np.ndarray], np.ndarray]]]]:
    """Those that are installed, or else SciPy's."""
    known = (("cholespy", "CHOLMOD by cholespy", peers.cholmod), ("pypardiso", "PARDISO by pypardiso", peers.pardiso))
    found = [(program, factor) for name, program, factor in known if peers.is_installed(name)]
    return found or [("SuperLU by SciPy", lambda matrix: splu(matrix).solve)]


def _mesh(n: int) -> sp.csr_matrix:
    from bihdist_core import Surface

    stiffness: sp.csr_matrix = Laplacian(Surface(*bumpy_sphere(n))).components[0].stiffness
    return stiffness


def _grid(n: int) -> sp.csr_matrix:
    side = round(n ** (1 / 3))
    path = sp.diags_array([-np.ones(side - 1), -np.ones(side - 1)], offsets=[-1, 1])
    path = path - sp.diags_array(np.asarray(path.sum(axis=1)).ravel())
    one = sp.eye_array(side)
    return sp.csr_matrix(
        sp.kron(sp.kron(path, one), one) + sp.kron(sp.kron(one, path), one) + sp.kron(one, sp.kron(one, path))
    )


def _roads(n: int) -> sp.csr_matrix:
    """A planar graph of random points with 2.8 edges at each, the shorter the heavier, all connected."""
    random = np.random.default_rng(0)
    x = random.random((n, 2))
    corners = Delaunay(x).simplices
    i, j = np.unique(np.sort(corners[:, [[0, 1], [1, 2], [0, 2]]].reshape(-1, 2), axis=1), axis=0).T
    lengths = np.linalg.norm(x[i] - x[j], axis=1)
    tree = minimum_spanning_tree(sp.coo_matrix((lengths, (i, j)), shape=(n, n))).tocoo()
    kept = random.random(len(i)) < 0.14
    pairs = np.unique(np.sort(np.c_[np.r_[tree.row, i[kept]], np.r_[tree.col, j[kept]]], axis=1), axis=0).T
    upper = sp.coo_matrix((1 / np.linalg.norm(x[pairs[0]] - x[pairs[1]], axis=1), pairs), shape=(n, n)).tocsr()
    both = upper + upper.T
    return sp.csr_matrix(sp.diags_array(np.asarray(both.sum(axis=1)).ravel()) - both)
