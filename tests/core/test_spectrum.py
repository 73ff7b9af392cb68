"""Laws of the eigenpairs, through a direct solve that has nothing to do with the library's own factor."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from bihdist_core.operators import stiffness, vertex_areas
from bihdist_core.spectrum import Spectrum, smallest_eigenpairs
from bihdist_core.surface import Surface

from ..dense_reference import full_spectrum
from ..shapes import bumpy, sphere


@dataclass(frozen=True, eq=False)
class Problem:
    stiffness: sp.csr_matrix
    areas: np.ndarray
    solve: Callable[[np.ndarray], np.ndarray]

    def pairs(self, count: int, **options: object) -> Spectrum:
        return smallest_eigenpairs(self.stiffness, self.areas, self.solve, count, **options)  # type: ignore[arg-type]

    def residuals(self, s: Spectrum) -> np.ndarray:
        x = s.eigenvectors
        r = self.stiffness @ x - self.areas[:, None] * x * s.eigenvalues
        return np.sqrt((r**2 / self.areas[:, None]).sum(axis=0)) / s.eigenvalues

    def products(self, x: np.ndarray) -> np.ndarray:
        return x.T @ (self.areas[:, None] * x)


def problem(surface: Surface) -> Problem:
    matrix, areas = stiffness(surface), vertex_areas(surface)
    factor = splu(matrix[1:, 1:].tocsc())

    def solve(b: np.ndarray) -> np.ndarray:
        x = np.zeros_like(b)
        x[1:] = factor.solve(np.ascontiguousarray(b[1:]))
        return x

    return Problem(matrix, areas, solve)


@cache
def bumpy_problem() -> Problem:
    return problem(bumpy(1500))


@cache
def bumpy_reference() -> tuple[np.ndarray, np.ndarray]:
    return full_spectrum(bumpy(1500))


def needle() -> Surface:
    """A tube 10,000 times as long as wide."""
    around, along = 6, 500
    k = np.arange(around * (along + 1))
    turn = 2 * np.pi * k / around
    vertices = np.stack([k // around * 0.2, 0.01 * np.cos(turn), 0.01 * np.sin(turn)], 1)
    a = np.arange(around * along)
    b = a // around * around + (a + 1) % around
    faces = np.concatenate([np.stack([a, b, b + around], 1), np.stack([a, b + around, a + around], 1)])
    return Surface(vertices, faces, "needle")


def with_tiny_faces() -> Surface:
    """A bumpy sphere shrunk towards one of its vertices: edges there are 10,000 times shorter than elsewhere."""
    s = bumpy(1500)
    offset = s.vertices - s.vertices[0]
    distance = np.linalg.norm(offset, axis=1)
    shrink = np.minimum(1, 1e-4 + (distance / 0.5) ** 4)
    return Surface(s.vertices[0] + offset * shrink[:, None], s.faces, "tiny faces")


def brush() -> Surface:
    """A sphere with 45 equal long spikes: its lowest 45 eigenvalues lie close together."""
    ball = sphere(600)
    faces, vertices, used = [list(f) for f in ball.faces], [ball.vertices], np.zeros(600, bool)
    rooms, k, n = 0, -1, 600
    while rooms < 45:
        k += 1
        if used[ball.faces[k]].any():
            continue
        used[ball.faces[np.isin(ball.faces, ball.faces[k]).any(axis=1)]] = True
        rooms += 1
        ring, centre = list(ball.faces[k]), ball.vertices[ball.faces[k]].mean(axis=0)
        corner = ball.vertices[ball.faces[0]] - ball.vertices[ball.faces[0]].mean(axis=0)
        for j in range(1, 13):
            new = [n, n + 1, n + 2]
            n += 3
            vertices.append(centre * (1 + 0.3 * j) + 0.3 * corner)
            for q in range(3):
                a, b, c, d = ring[q], ring[(q + 1) % 3], new[(q + 1) % 3], new[q]
                faces += [[a, b, c], [a, c, d]]
            ring = new
        faces.append(ring)
    return Surface(np.concatenate(vertices), np.array(faces), "brush")


# Dense reference matrices lose eps * largest / smallest eigenvalue, 1e-16 * 1e4 to 1e5 on the plain shapes.
EQUAL = 1e-10


@pytest.mark.parametrize(("count", "tolerance"), [(1, 1e-8), (10, 1e-4), (60, 1e-8), (200, 1e-8), (200, 1e-4)])
def test_laws_on_a_shape_without_symmetry(count: int, tolerance: float) -> None:
    p = bumpy_problem()
    s = p.pairs(count, tolerance=tolerance)
    assert s.eigenvalues.shape == (count,)
    assert s.eigenvectors.shape == (len(p.areas), count)
    assert (np.diff(s.eigenvalues) > 0).all()
    assert p.residuals(s).max() <= 2 * tolerance
    # The residuals reported are those measured, up to rounding of about eps * largest / smallest eigenvalue.
    np.testing.assert_allclose(s.residuals, p.residuals(s), rtol=1e-6, atol=1e-11)
    np.testing.assert_allclose(p.products(s.eigenvectors), np.eye(count), atol=1e-12)
    np.testing.assert_allclose(p.areas @ s.eigenvectors, 0, atol=1e-12)
    # Eigenvalues are off by the square of the residual, divided by a relative gap of 1 / count or so.
    np.testing.assert_allclose(s.eigenvalues, bumpy_reference()[0][:count], rtol=max(EQUAL, 1e4 * tolerance**2))
