"""What the modelling steps ask of a triangle array: edges, normals, angles, pieces.

`points` are (n, 3), `faces` (m, 3) ids into them.  The side k of a face is the one opposite its corner k, and
3 * face + k is its half-edge.
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .fields import unit


def edges_and_sides(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(e, 2) edges, smaller id first, and (e, 2) the half-edges on them; -1 in the second place on a boundary."""
    ends = np.sort(faces[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2), axis=1)
    key = ends[:, 0] * (faces.max() + 1) + ends[:, 1]
    order = np.argsort(key, kind="stable")
    first = np.flatnonzero(np.r_[True, np.diff(key[order]) > 0])
    count = np.diff(np.r_[first, len(order)])
    second = np.where(count > 1, order[np.minimum(first + 1, len(order) - 1)], -1)
    return ends[order[first]], np.stack([order[first], second], 1)


def edge_lengths(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """(e,) lengths."""
    return np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)


def face_normals(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """(m, 3) outward normals, as long as twice the face's area."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def corner_angles(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """(m, 3) angles, degrees."""
    x = points[faces]
    left, right = unit(np.roll(x, -1, axis=1) - x), unit(np.roll(x, 1, axis=1) - x)
    return np.degrees(np.arccos(np.clip((left * right).sum(axis=2), -1, 1)))


def best_at_vertices(
    groups: np.ndarray, values: np.ndarray, n: int, best: np.ufunc = np.minimum, start: float = np.inf
) -> np.ndarray:
    """(n,) best of the `values` (g,) over the groups (g, k) of vertices that each vertex belongs to."""
    out = np.full(n, start, float)
    for column in groups.T:
        best.at(out, column, values)
    return out


def incidence(faces: np.ndarray, n: int) -> sp.csr_matrix:
    """(n, m) with a 1 where the vertex is a corner of the face."""
    return sp.csr_matrix((np.ones(faces.size), (faces.ravel(), np.repeat(np.arange(len(faces)), 3))), (n, len(faces)))


def adjacency(pairs: np.ndarray, n: int) -> sp.csr_matrix:
    """(n, n) symmetric, with a 1 for each of the (e, 2) pairs."""
    i, j = np.r_[pairs, pairs[:, ::-1]].T
    return sp.csr_matrix((np.ones(len(i)), (i, j)), (n, n))


def used_only(points: np.ndarray, faces: np.ndarray, *more: np.ndarray) -> tuple[np.ndarray, ...]:
    """Points that belong to a face, the faces renumbered, and `more` per-point arrays cut down alike."""
    used, new = np.unique(faces, return_inverse=True)
    return (points[used], new.reshape(faces.shape), *(values[used] for values in more))


def pieces(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) the connected piece of each point, and (k,) the number of points of each piece."""
    label = connected_components(adjacency(edges_and_sides(faces)[0], len(points)), directed=False)[1]
    return label, np.bincount(label)


def largest_component(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The connected piece with the most faces."""
    label = pieces(points, faces)[0][faces[:, 0]]
    return used_only(points, faces[label == np.bincount(label).argmax()])


def without_pinches(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The largest piece, less the faces round vertices where it hangs together by a point only."""
    return largest_component(*unpinched(*largest_component(points, faces)))


def unpinched(points: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All pieces, less the faces round vertices where they hang together by a point only."""
    while True:
        points, faces = used_only(points, faces)
        pinched = _pinched_vertices(faces, len(points))
        if not len(pinched):
            return points, faces
        faces = faces[~np.isin(faces, pinched).any(axis=1)]


def _pinched_vertices(faces: np.ndarray, n: int) -> np.ndarray:
    """Vertices whose faces form more than one fan: corners are joined across each inner edge, then counted."""
    _, sides = edges_and_sides(faces)
    one, other = sides[sides[:, 1] >= 0].T

    def turn(half_edge: np.ndarray, by: int) -> np.ndarray:
        return half_edge // 3 * 3 + (half_edge + by) % 3

    joined = np.stack([np.r_[turn(one, 1), turn(one, 2)], np.r_[turn(other, 2), turn(other, 1)]], 1)
    fan = connected_components(adjacency(joined, faces.size), directed=False)[1]
    vertex_of_fan = np.unique(np.stack([faces.ravel(), fan], 1), axis=0)[:, 0]
    return np.flatnonzero(np.bincount(vertex_of_fan, minlength=n) > 1)
