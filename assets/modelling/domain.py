"""The sample `domain`: a flat domain with corridors, notches and a hole, at z = 0."""

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from .triangles import face_normals, incidence, used_only

EDGE = 0.0197

OUTLINE = [
    (0, 0),
    (0.95, 0),
    (0.95, 0.85),
    (1.07, 0.85),
    (1.07, 0),
    (2.1, 0),
    (2.1, 0.42),
    (1.5, 0.42),
    (1.5, 0.54),
    (2.1, 0.54),
    (2.1, 1.4),
    (0.62, 1.4),
    (0.62, 0.38),
    (0.50, 0.38),
    (0.50, 1.4),
    (0, 1.4),
]
"""Corners, anticlockwise."""

TRIES = 12
"""Candidates for each new point; the more, the more even the points."""


def domain(edge: float = EDGE) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) points and (m, 3) faces of edge length about `edge`, facing up, with no lattice to be seen inside."""
    loops = [np.array(OUTLINE, float), _hole(edge)]
    segments = np.concatenate([np.stack([loop, np.roll(loop, -1, axis=0)], 1) for loop in loops])
    rim = np.concatenate([_divided(start, end, edge) for start, end in segments])
    plane = np.concatenate([rim, _scattered(segments, rim, edge)])
    for turn in range(80):
        faces = _triangles(plane, segments)
        if turn < 79:
            plane = _relaxed(plane, faces, len(rim))
    points = np.c_[plane, np.zeros(len(plane))]
    down = face_normals(points, faces)[:, 2] < 0
    faces[down] = faces[down][:, ::-1]
    return used_only(points, faces)


def _hole(edge: float) -> np.ndarray:
    """(k, 2) an egg-shaped hole, clockwise."""
    angle = np.linspace(0, 2 * np.pi, round(2 * np.pi * 0.2 / edge), endpoint=False)
    return np.stack([1.62 + 0.19 * np.cos(angle), 0.97 - 0.19 * np.sin(angle) * (1 + 0.3 * np.cos(angle))], 1)


def _divided(start: np.ndarray, end: np.ndarray, edge: float) -> np.ndarray:
    """(k, 2) evenly spaced points from `start` to just before `end`."""
    count = max(1, round(np.linalg.norm(end - start) / edge))
    return start + np.linspace(0, 1, count, endpoint=False)[:, None] * (end - start)


def _scattered(segments: np.ndarray, rim: np.ndarray, edge: float) -> np.ndarray:
    """(k, 2) random inner points, no two much closer than an edge (dart throwing in rounds)."""
    rng = np.random.default_rng(0)
    low, high = rim.min(axis=0), rim.max(axis=0)
    points = rim
    for _ in range(TRIES):
        darts = rng.uniform(low, high, (4 * int(np.prod((high - low) / edge)), 2))
        darts = darts[inside(darts, segments)]
        darts = darts[cKDTree(points).query(darts)[0] > 0.76 * edge]
        # Of darts close together the first stays.
        pairs = cKDTree(darts).query_pairs(0.76 * edge, output_type="ndarray")
        pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
        keep = np.ones(len(darts), bool)
        for first, second in pairs.tolist():
            if keep[first]:
                keep[second] = False
        points = np.concatenate([points, darts[keep]])
    return points[len(rim) :]


def inside(points: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """(n,) whether a ray from each point to the right crosses the outline an odd number of times."""
    out = np.zeros(len(points), bool)
    for (x0, y0), (x1, y1) in segments:
        if y0 != y1:
            crosses = (y0 > points[:, 1]) != (y1 > points[:, 1])
            out ^= crosses & (points[:, 0] < (x1 - x0) * (points[:, 1] - y0) / (y1 - y0) + x0)
    return out


def _triangles(plane: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """(m, 3) Delaunay triangles inside the outline."""
    faces = Delaunay(plane).simplices.astype(np.int64)
    return faces[inside(plane[faces].mean(axis=1), segments)]


def _relaxed(plane: np.ndarray, faces: np.ndarray, fixed: int) -> np.ndarray:
    """All but the first `fixed` points moved most of the way to the middle of their triangles."""
    area = np.abs(np.linalg.det(plane[faces[:, 1:]] - plane[faces[:, :1]]))
    around = incidence(faces, len(plane))
    middle = (around @ (plane[faces].mean(axis=1) * area[:, None])) / (around @ area)[:, None]
    moved = plane.copy()
    moved[fixed:] += 0.9 * (middle - plane)[fixed:]
    return moved
