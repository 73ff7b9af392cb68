"""Spheres for the claims: finer and finer ones, and conformally equivalent ones."""

from itertools import combinations

import numpy as np

from ..applications.resizing import refined
from ..surface import Surface


def icosphere(times: int) -> Surface:
    """The unit sphere: an icosahedron refined `times` times, 10 * 4^times + 2 vertices; coarser vertices keep ids."""
    g = (1 + 5**0.5) / 2
    x = np.array([[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0]], float)
    x = np.concatenate([x, np.roll(x, 1, axis=1), np.roll(x, 2, axis=1)])
    # Neighbours are at distance 2; a face is three mutual neighbours.
    near = np.isclose(np.linalg.norm(x[:, None] - x, axis=2), 2)
    faces = [f for f in combinations(range(12), 3) if near[np.ix_(f, f)].sum() == 6]
    turned = [f if np.linalg.det(x[list(f)]) > 0 else f[::-1] for f in faces]
    sphere = Surface(x / np.linalg.norm(x[0]), np.array(turned), "sphere")
    for _ in range(times):
        finer = refined(sphere)
        x = finer.vertices
        sphere = Surface(x / np.linalg.norm(x, axis=1, keepdims=True), finer.faces, "sphere")
    return sphere


def moebius(sphere: Surface, stretch: float) -> Surface:
    """The unit sphere after a Moebius transformation: stereographic projection from +z, times `stretch`, and back."""
    x, y, z = sphere.vertices.T
    # With the plane point (x, y) / (1 - z): back again its height is (r^2 - 1) / (r^2 + 1), written without division
    # by 1 - z, which is 0 at the pole.
    up, down = stretch**2 * (1 + z), 1 - z
    total = up + down
    return Surface(np.stack([2 * stretch * x / total, 2 * stretch * y / total, (up - down) / total], 1), sphere.faces)
