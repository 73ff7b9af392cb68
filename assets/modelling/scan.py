"""The sample `scan`: a mesh damaged as a raw scan is: noise, a missing foot, ragged holes of many sizes."""

import numpy as np
from scipy.spatial import cKDTree

from .fields import unit
from .triangles import best_at_vertices, edge_lengths, edges_and_sides, face_normals, incidence, without_pinches

HOLES = 25

RAGGED = 0.2
"""Standard deviation of a hole's radius along its rim, in lengths of the edges there."""

NOISE = 0.12
"""Standard deviation of the shift along the normal, in lengths of the shortest edge there."""


def damaged(points: np.ndarray, faces: np.ndarray, edge: float) -> tuple[np.ndarray, np.ndarray]:
    """The person's mesh, damaged; face and fingers are spared."""
    rng = np.random.default_rng(7)
    face_normal = face_normals(points, faces)
    normal = unit(incidence(faces, len(points)) @ face_normal)
    edges = edges_and_sides(faces)[0]
    shortest = best_at_vertices(edges, edge_lengths(points, edges), len(points))
    points = points + normal * shortest[:, None] * rng.normal(0, NOISE, (len(points), 1))
    middle = points[faces].mean(axis=1)
    size = 1.1 * shortest[faces].mean(axis=1)
    gone = _foot(middle, size, rng)
    for seed, radius in zip(_spread_seeds(middle, rng), np.geomspace(4.2, 1.1, HOLES) * edge, strict=True):
        # A hole stays on its side of thin parts.
        same_side = unit(face_normal) @ unit(face_normal[seed]) > -0.1
        ragged = np.linalg.norm(middle - middle[seed], axis=1) + RAGGED * size * rng.normal(0, 1, len(faces))
        gone |= same_side & (ragged < radius)
    return without_pinches(points, faces[~gone])


def _foot(middle: np.ndarray, size: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(m,) faces of the left foot, below a slanted, ragged line."""
    ragged = middle[:, 2] + 0.25 * middle[:, 1] + 2 * RAGGED * size * rng.normal(0, 1, len(middle))
    return (middle[:, 0] > 0.03) & (ragged < 0.13)


def _spread_seeds(middle: np.ndarray, rng: np.random.Generator) -> list[int]:
    """Faces far from each other: each the farthest of a dozen random ones from those before."""
    x, y, z = middle.T
    # Not on the face and the fingers, nor where the foot is missing.
    allowed = np.flatnonzero(((z < 1.52) | (y > 0.02)) & (np.abs(x) < 0.50) & ((z > 0.25) | (x < 0)))
    seeds = [int(rng.choice(allowed))]
    while len(seeds) < HOLES:
        tried = rng.choice(allowed, size=12)
        seeds.append(int(tried[cKDTree(middle[seeds]).query(middle[tried])[0].argmax()]))
    return seeds
