"""What is seen of points on a surface, the slow, obvious way: a ray from each to the eye, against every face."""

import numpy as np

from bihdist_core import Surface

OWN = 1e-7
"""Of the way to the eye: nearer than this to the point, a face is the point's own."""


def seen_by_rays(surface: Surface, eye: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(k,) whether points (k, 3) on the surface are seen from the eye (3,) (Möller and Trumbore, 1997)."""
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    one, other, arm = b - a, c - a, eye - a
    normal, across, first = np.cross(one, other), np.cross(arm, one), np.cross(other, arm)
    height = (across * other).sum(axis=1)
    seen = np.empty(len(points), bool)
    for rows in np.array_split(np.arange(len(points)), max(len(points) * len(a) // 4_000_000, 1)):
        way = points[rows] - eye
        with np.errstate(divide="ignore", invalid="ignore"):
            steep = -way @ normal.T
            u, v, t = way @ first.T / steep, way @ across.T / steep, height / steep
            hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & (t < 1 - OWN)
        seen[rows] = ~hit.any(axis=1)
    return seen
