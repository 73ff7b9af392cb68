"""Distances the slow and obvious way: dense matrices, the paper's formulas as printed, one connected component."""

from fractions import Fraction

import numpy as np
import scipy.linalg

from bihdist_core import Surface
from bihdist_core.operators import stiffness, vertex_areas
from bihdist_core.solver.blas import one_blas_thread


def operators(surface: Surface, areas: str = "voronoi") -> tuple[np.ndarray, np.ndarray]:
    """Dense stiffness (n, n) and areas (n,)."""
    return stiffness(surface).toarray(), vertex_areas(surface, areas)


def from_green(g: np.ndarray) -> np.ndarray:
    """(n, n) distances from a Green's function (Eq. 9)."""
    d = np.diag(g)
    squares = d[:, None] + d - 2 * g
    np.fill_diagonal(squares, 0)
    return np.sqrt(np.maximum(squares, 0))


def biharmonic_pseudo_inverse(surface: Surface, areas: str = "voronoi") -> np.ndarray:
    """(n, n) distances from the pseudo-inverse of L A^-1 L (paper, Eq. 8 and Theorem 3)."""
    stiff, area = operators(surface, areas)
    return from_green(np.linalg.pinv(stiff @ (stiff / area[:, None]), rcond=1e-13, hermitian=True))


def biharmonic_inverse(surface: Surface, areas: str = "voronoi") -> np.ndarray:
    """(n, n) distances from the centred inverse of the stiffness matrix: better conditioned, and faster."""
    stiff, area = operators(surface, areas)
    green = np.zeros_like(stiff)
    with one_blas_thread():
        green[1:, 1:] = scipy.linalg.inv(stiff[1:, 1:])
        half = (green - area @ green / area.sum()) * np.sqrt(area)[:, None]
        return from_green(half.T @ half)


def commute_time_pseudo_inverse(surface: Surface) -> np.ndarray:
    """(n, n) distances from the pseudo-inverse of L (paper, Eq. 3)."""
    return from_green(np.linalg.pinv(operators(surface)[0], rcond=1e-13, hermitian=True))


def full_spectrum(surface: Surface, areas: str = "voronoi") -> tuple[np.ndarray, np.ndarray]:
    """All eigenvalues (n - 1,) and eigenvectors (n, n - 1) but the constant."""
    stiff, area = operators(surface, areas)
    with one_blas_thread():
        values, vectors = scipy.linalg.eigh(stiff, np.diag(area))
    return values[1:], vectors[:, 1:]


def spectral(weights: np.ndarray, vectors: np.ndarray, sources: np.ndarray) -> np.ndarray:
    """(n, k) distances sqrt(sum_k w_k (phi_k(x) - phi_k(y))^2)."""
    points = vectors * np.sqrt(weights)
    return np.stack([np.linalg.norm(points - points[s], axis=1) for s in sources], 1)


def biharmonic_rational(surface: Surface, i: int, j: int) -> float:
    """One distance in rational arithmetic, for small surfaces: L y = e_i - e_j, centred by area, |y|_A."""
    stiff, area = operators(surface)
    n = len(area)
    a = [Fraction(float(x)) for x in area]
    # Vertex 0 is pinned; the last column is the right-hand side.
    rows = [[*map(Fraction, map(float, stiff[k, 1:])), Fraction((k == i) - (k == j))] for k in range(1, n)]
    for p in range(n - 1):
        for q in range(p + 1, n - 1):
            if rows[q][p]:
                ratio = rows[q][p] / rows[p][p]
                rows[q] = [x - ratio * y for x, y in zip(rows[q], rows[p], strict=True)]
    y = [Fraction(0)] * n
    for p in reversed(range(n - 1)):
        y[p + 1] = (rows[p][-1] - sum(rows[p][q] * y[q + 1] for q in range(p + 1, n - 1))) / rows[p][p]
    mean = sum(p * q for p, q in zip(a, y, strict=True)) / sum(a)
    return float(sum(p * (q - mean) ** 2 for p, q in zip(a, y, strict=True))) ** 0.5
