"""Rounds of local edits of a triangle mesh: split long edges, collapse short ones, flip badly placed ones.

Each round edits many places at once; where two edits would touch, the better one goes first and the other waits for
the next round.  Lengths are measured against the wanted edge length there, `wanted(points) -> (n,)`.  Vertices marked
in `fixed` (n,) bool stay where they are.
"""

from collections.abc import Callable

import numpy as np

from .fields import unit
from .triangles import adjacency, best_at_vertices, edge_lengths, edges_and_sides, face_normals, used_only

WorkOrder = Callable[[np.ndarray], np.ndarray]

LONG, SHORT = 4 / 3, 0.8
"""Split above, collapse below these multiples of the wanted length: a split edge is never short at once."""


def split_long(
    points: np.ndarray, faces: np.ndarray, fixed: np.ndarray, wanted: WorkOrder
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Halve each inner edge that is too long and the longest of both its faces."""
    edges, sides = edges_and_sides(faces)
    inner = sides[:, 1] >= 0
    length = edge_lengths(points, edges) / wanted(points[edges].mean(axis=1))
    face = sides // 3
    longest = np.zeros(len(faces))
    np.maximum.at(longest, face[:, 0], length)
    np.maximum.at(longest, face[inner, 1], length[inner])
    chosen = inner & (length > LONG) & (length >= longest[face].max(axis=1))
    middle = len(points) + np.arange(chosen.sum())
    faces, new_faces = faces.copy(), []
    for half_edge in sides[chosen].T:
        f, k = np.divmod(half_edge, 3)
        tip, start, end = (faces[f, (k + s) % 3] for s in range(3))
        new_faces.append(np.stack([tip, middle, end], 1))
        faces[f] = np.stack([tip, start, middle], 1)
    points = np.r_[points, points[edges[chosen]].mean(axis=1)]
    return points, np.concatenate([faces, *new_faces]), np.r_[fixed, np.zeros(len(middle), bool)]


def collapse_short(
    points: np.ndarray, faces: np.ndarray, fixed: np.ndarray, wanted: WorkOrder, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Draw the ends of short inner edges together, where that folds nothing and keeps the surface's shape."""
    n = len(points)
    edges, sides = edges_and_sides(faces)
    length = edge_lengths(points, edges) / wanted(points[edges].mean(axis=1))
    valence = np.bincount(edges.ravel(), minlength=n)
    chosen = np.flatnonzero((length < SHORT) & (sides[:, 1] >= 0) & ~fixed[edges].all(axis=1))
    opposite = faces.ravel()[sides[chosen]]
    chosen = chosen[(valence[opposite] > 4).all(axis=1) & (valence[edges[chosen]].sum(axis=1) < 14)]
    if not len(chosen):
        return points, faces, fixed
    # No two collapses within two rings of each other; the random part keeps the order from following the grid.
    rank = length[chosen] + 0.4 * rng.random(len(chosen))
    first = best_at_vertices(edges[chosen], rank, n)
    for _ in range(2):
        first = np.minimum(first, best_at_vertices(edges, first[edges].min(axis=1), n))
    chosen = chosen[(rank[:, None] <= first[edges[chosen]]).all(axis=1)]
    # Link condition: exactly the two opposite vertices neighbour both ends, or the surface would pinch.
    near = adjacency(edges, n)
    common = np.asarray(near[edges[chosen, 0]].multiply(near[edges[chosen, 1]]).sum(axis=1)).ravel()
    stays, goes = edges[chosen[common == 2]].T
    stays, goes = np.where(fixed[goes], goes, stays), np.where(fixed[goes], stays, goes)
    target = np.where(fixed[stays][:, None], points[stays], (points[stays] + points[goes]) / 2)
    keep = ~_spoils(points, faces, stays, goes, target, wanted)
    moved = points.copy()
    moved[stays[keep]] = target[keep]
    new = np.arange(n)
    new[goes[keep]] = stays[keep]
    faces = new[faces]
    proper = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return used_only(moved, faces[proper], fixed)


def _spoils(
    points: np.ndarray, faces: np.ndarray, stays: np.ndarray, goes: np.ndarray, target: np.ndarray, wanted: WorkOrder
) -> np.ndarray:
    """(k,) whether a collapse would turn a surviving face by more than 60 degrees or leave it too long."""
    moved, of_vertex = points.copy(), np.full(len(points), -1)
    for end in (stays, goes):
        moved[end] = target
        of_vertex[end] = np.arange(len(stays))
    touched = of_vertex[faces]
    survives = np.flatnonzero((touched >= 0).sum(axis=1) == 1)
    corners = moved[faces[survives]]
    before, after = (unit(face_normals(x, faces[survives])) for x in (points, moved))
    turned = (before * after).sum(axis=1) < 0.5
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    out = np.zeros(len(stays), bool)
    out[touched[survives].max(axis=1)[turned | (longest > 1.5 * wanted(corners.mean(axis=1)))]] = True
    return out


def flip(points: np.ndarray, faces: np.ndarray, rng: np.random.Generator, by_angle: bool) -> np.ndarray:
    """Flip inner edges: `by_angle` towards Delaunay, otherwise towards six edges at each vertex (four on a rim)."""
    n = len(points)
    edges, sides = edges_and_sides(faces)
    valence = np.bincount(edges.ravel(), minlength=n)
    rim = np.zeros(n, bool)
    rim[edges[sides[:, 1] < 0]] = True
    known = edges[:, 0] * n + edges[:, 1]
    sides = sides[sides[:, 1] >= 0]
    # The two faces are (c, a, b) and (d, b, a); flipped, (c, a, d) and (d, b, c).
    c, d = faces.ravel()[sides].T
    f, k = np.divmod(sides[:, 0], 3)
    a, b = faces[f, (k + 1) % 3], faces[f, (k + 2) % 3]
    if by_angle:
        gain = _angle(points, c, a, b) + _angle(points, d, a, b) - np.pi - 1e-3
    else:
        ideal = np.where(rim, 4, 6)

        def excess(v: np.ndarray, change: int) -> np.ndarray:
            return (valence[v] + change - ideal[v]) ** 2

        gain = sum(excess(v, 0) for v in (a, b, c, d)) - sum(excess(v, -1) for v in (a, b))
        gain = gain - sum(excess(v, 1) for v in (c, d)) - 0.1
    quads = np.stack([a, b, c, d], 1)
    better = (gain > 0) & (valence[a] > 3) & (valence[b] > 3)
    better &= ~np.isin(np.minimum(c, d) * n + np.maximum(c, d), known)
    i = np.flatnonzero(better)
    before = unit(face_normals(points, quads[i][:, [2, 0, 1]]) + face_normals(points, quads[i][:, [3, 1, 0]]))
    for corners in ([2, 0, 3], [3, 1, 2]):
        stays_flat = (unit(face_normals(points, quads[i][:, corners])) * before).sum(axis=1) > 0.5
        i, before = i[stays_flat], before[stays_flat]
    if not len(i):
        return faces
    rank = gain[i] + 1e-3 * rng.random(len(i))
    first = best_at_vertices(quads[i], rank, n, np.maximum, -1)
    i = i[(rank[:, None] >= first[quads[i]]).all(axis=1)]
    faces = faces.copy()
    faces[sides[i, 0] // 3] = quads[i][:, [2, 0, 3]]
    faces[sides[i, 1] // 3] = quads[i][:, [3, 1, 2]]
    return faces


def _angle(points: np.ndarray, at: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """(k,) angles, radians."""
    left, right = unit(points[a] - points[at]), unit(points[b] - points[at])
    return np.arccos(np.clip((left * right).sum(axis=1), -1, 1))
