"""The sample `scan`: a mesh damaged as a raw scan is: noise, a missing foot, ragged holes of many sizes."""

import numpy as np
from scipy.spatial import cKDTree

from .fields import unit
from .triangles import best_at_vertices, edge_lengths, edges_and_sides, face_normals, incidence, without_pinches

HOLES = 25

RAGGED = 0.2
"""Standard deviation of a hole's radius along its rim, in the person's edge lengths."""

NOISE = 0.12
"""Standard deviation of the shift along the normal, in lengths of the shortest edge there."""


def damaged(points: np.ndarray, faces: np.ndarray, edge: float) -> tuple[np.ndarray, np.ndarray]:
    """The person's mesh, damaged; the face is spared."""
    rng = np.random.default_rng(7)
    face_normal = face_normals(points, faces)
    normal = unit(incidence(faces, len(points)) @ face_normal)
    edges = edges_and_sides(faces)[0]
    shortest = best_at_vertices(edges, edge_lengths(points, edges), len(points))
    points = points + normal * shortest[:, None] * rng.normal(0, NOISE, (len(points), 1))
    middle = points[faces].mean(axis=1)
    gone = _foot(middle, rng)
    for seed, radius in zip(_spread_seeds(middle, rng), np.geomspace(4.2, 1.1, HOLES) * edge, strict=True):
        # A hole stays on its side of thin parts.
        same_side = unit(face_normal) @ unit(face_normal[seed]) > -0.1
        ragged = np.linalg.norm(middle - middle[seed], axis=1) + rng.normal(0, RAGGED * edge, len(faces))
        gone |= same_side & (ragged < radius)
    return without_pinches(points, faces[~gone])


def _foot(middle: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """(m,) faces of the left foot, below a slanted, ragged line."""
    ragged = middle[:, 2] + 0.25 * middle[:, 1] + rng.normal(0, 0.008, len(middle))
    return (middle[:, 0] > 0.03) & (ragged < 0.13)


def _spread_seeds(middle: np.ndarray, rng: np.random.Generator) -> list[int]:
    """Faces far from each other: each the farthest of a dozen random ones from those before."""
    allowed = np.flatnonzero((middle[:, 2] < 1.52) | (middle[:, 1] > 0.02))
    seeds = [int(rng.choice(allowed))]
    while len(seeds) < HOLES:
        tried = rng.choice(allowed, size=12)
        seeds.append(int(tried[cKDTree(middle[seeds]).query(middle[tried])[0].argmax()]))
    return seeds
