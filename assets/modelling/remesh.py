"""From a rough mesh of a field's zero surface to near-uniform, well-shaped triangles on it.

The loop of Botsch and Kobbelt (2004): edit towards the wanted edge length, move each vertex to the middle of its
faces, and bring it back to the surface, which here is known exactly: it is where the field is zero.
"""

import numpy as np
from scipy.spatial import cKDTree

from .edits import WorkOrder, collapse_short, flip, split_long
from .fields import Field, unit
from .triangles import adjacency, corner_angles, edges_and_sides, face_normals, incidence, without_pinches

TETRAHEDRON = np.array([[1, -1, -1], [-1, -1, 1], [-1, 1, -1], [1, 1, 1.0]])
"""Four offsets whose weighted field values give the gradient at the cost of four evaluations."""

THIN = 30
"""Degrees; late in the loop, faces with a smaller angle are collapsed away."""


def remesh(
    points: np.ndarray,
    faces: np.ndarray,
    field: Field,
    wanted: WorkOrder,
    edge: float,
    rounds: int = 40,
    polish: int = 25,
) -> tuple[np.ndarray, np.ndarray]:
    """Remeshed (n, 3) points and (m, 3) faces; `wanted(points)` is the edge length there, `edge` a typical one."""
    rng = np.random.default_rng(0)
    fixed = np.zeros(len(points), bool)
    for turn in range(rounds):
        for _ in range(2):
            points, faces, fixed = split_long(points, faces, fixed, wanted)
        for _ in range(3):
            points, faces, fixed = collapse_short(points, faces, fixed, wanted, rng)
        for _ in range(2):
            faces = flip(points, faces, rng, by_angle=False)
        if turn % 3 == 2 or turn > rounds - 6:
            points = relax(points, faces, fixed, field, wanted, edge)
    for turn in range(polish):
        for _ in range(2):
            faces = flip(points, faces, rng, by_angle=turn > 5)
        points = relax(points, faces, fixed, field, wanted, edge)
        thin = corner_angles(points, faces).min(axis=1) < THIN
        if turn in (6, 12, 18) and thin.any():
            around = cKDTree(points[np.unique(faces[thin])])
            longer = _longer_near(around, wanted, 0.7 * edge)
            points, faces, fixed = collapse_short(points, faces, fixed, longer, rng)
    return to_surface(points, field, fixed, edge, steps=2), faces


def relax(
    points: np.ndarray, faces: np.ndarray, fixed: np.ndarray, field: Field, wanted: WorkOrder, edge: float
) -> np.ndarray:
    """Each vertex moved along the surface most of the way to the weighted middle of its faces."""
    normals, middle = face_normals(points, faces), points[faces].mean(axis=1)
    # Polygonising can leave faces of no area, which must not weigh nothing where a vertex has no others.
    weight = np.linalg.norm(normals, axis=1) / wanted(middle) ** 3 + 1e-9
    around = incidence(faces, len(points))
    move = (around @ (middle * weight[:, None])) / (around @ weight)[:, None] - points
    normal = unit(around @ normals)
    move -= normal * (move * normal).sum(axis=1, keepdims=True)
    return to_surface(points + 0.8 * np.where(fixed[:, None], 0, move), field, fixed, edge, steps=1)


def to_surface(points: np.ndarray, field: Field, fixed: np.ndarray, edge: float, steps: int) -> np.ndarray:
    """Newton steps, at most half an edge each, of the free vertices to the zero surface of the field."""
    points, p, reach = points.copy(), points[~fixed], 1e-3 * edge + 1e-4
    for _ in range(steps):
        values = [field(p + reach * corner) for corner in TETRAHEDRON]
        gradient = sum(v[:, None] * corner for v, corner in zip(values, TETRAHEDRON, strict=True)) / (4 * reach)
        step = -sum(values)[:, None] / 4 * gradient / np.maximum((gradient**2).sum(axis=1), 0.05)[:, None]
        p = p + step * np.minimum(1, 0.5 * edge / (np.linalg.norm(step, axis=1, keepdims=True) + 1e-30))
    points[~fixed] = p
    return points


def cut_open(
    points: np.ndarray, faces: np.ndarray, field: Field, wanted: WorkOrder, edge: float, height: float, rounds: int = 40
) -> tuple[np.ndarray, np.ndarray]:
    """Remove what lies below z = `height` and settle the rim as a smooth curve on that plane."""
    points, faces = without_pinches(points, faces[(points[faces][:, :, 2] > height).all(axis=1)])
    for turn in range(rounds):
        last = turn >= rounds - 8
        edges, sides = edges_and_sides(faces)
        rim_edges = edges[sides[:, 1] < 0]
        rim = np.unique(rim_edges)
        points = points.copy()
        points[rim] += 0.5 * ((adjacency(rim_edges, len(points)) @ points)[rim] / 2 - points[rim])
        points[rim, 2] += (1 if last else 0.3) * (height - points[rim, 2])
        on_rim = np.zeros(len(points), bool)
        on_rim[rim] = True
        points = to_surface(points, field, ~on_rim, edge, steps=1)
        if last:
            points[rim, 2] = height
        points = relax(points, faces, on_rim, field, wanted, edge)
        faces = flip(points, faces, np.random.default_rng(turn), by_angle=turn > 10)
    return points, faces


def _longer_near(places: cKDTree, wanted: WorkOrder, radius: float) -> WorkOrder:
    """Edges wanted a little longer near the places, and elsewhere so short that none is collapsed."""
    return lambda p: np.where(places.query(p)[0] < radius, 1.15, 0.7) * wanted(p)
