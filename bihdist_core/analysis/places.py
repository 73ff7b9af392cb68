"""Places on a surface: vertices, or points in faces given by barycentric weights; and the surface split at them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..errors import ParameterError
from ..surface import Surface

Place = int | Sequence[float]
"""A vertex id, or (face, b0, b1): a point of a face by the weights of its first two corners; the third's is the
rest."""

ON_SIDE = 1e-12
"""A weight below this is 0: the place is on a side of its face, or in a corner."""


@dataclass(frozen=True, eq=False)
class Places:
    """k places on a surface: faces (k,), the ids of their corners (k, 3), and weights (k, 3), at least 0, of sum 1."""

    faces: np.ndarray
    corners: np.ndarray
    weights: np.ndarray

    @classmethod
    def of(cls, surface: Surface, places: Sequence[Place]) -> "Places":
        """Vertex ids and points in faces, checked.

        Raises VertexError for a bad vertex; ParameterError for a face that does not exist, or weights that are not
        three numbers of at least 0 and of sum 1.
        """
        if not len(places):
            raise ParameterError("No places were given; at least one is needed.")
        found = [_checked(surface, place) for place in places]
        faces = np.array([face for face, _ in found], np.int64)
        return cls(faces, surface.faces[faces], np.array([weights for _, weights in found]))

    def __len__(self) -> int:
        return len(self.faces)

    def values(self, field: npt.ArrayLike) -> np.ndarray:
        """(k,) or (k, d): values (n,) or (n, d) at the vertices, interpolated linearly."""
        return weighted(np.asarray(field), self.corners, self.weights)


def weighted(at: np.ndarray, corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(k,) or (k, d): sums over corners (k, 3) of values `at` them; those of weight 0 do not count, finite or not."""
    w = weights.reshape(*weights.shape, *(1,) * (at.ndim - 1))
    return (w * np.where(w > 0, at[corners], 0)).sum(axis=1)


def _checked(surface: Surface, place: Place) -> tuple[int, np.ndarray]:
    if np.ndim(place) == 0:
        vertex = surface.check_vertex(place)  # type: ignore[arg-type]
        face = int(np.flatnonzero((surface.faces == vertex).any(axis=1))[0])
        return face, (surface.faces[face] == vertex).astype(np.float64)
    words = np.asarray(place, np.float64)
    m = len(surface.faces)
    if words.shape not in ((3,), (4,)) or not np.isfinite(words).all():
        raise ParameterError(f"{place!r} is no place; one is a vertex id, or (face, b0, b1), or (face, b0, b1, b2).")
    if not 0 <= words[0] < m or words[0] % 1:
        raise ParameterError(f"{surface.name} has no face {words[0]:g}; faces run from 0 to {m - 1}.")
    weights = words[1:] if len(words) == 4 else np.append(words[1:], 1 - words[1] - words[2])
    if (weights < -ON_SIDE).any() or abs(weights.sum() - 1) > 1e-9:
        raise ParameterError(
            f"The weights of a place in face {words[0]:g} are {', '.join(f'{w:g}' for w in weights)}; "
            "they must be at least 0, with the sum 1."
        )
    weights = np.where(weights <= ON_SIDE, 0, weights)
    return int(words[0]), weights / weights.sum()


@dataclass(frozen=True, eq=False)
class Split:
    """A surface with vertices at some places; the same shape, so that lengths and linear fields are the same.

    surface: the vertices of the whole one first, then one for each place that is none of them.  vertices (k,): those at
    the places.  parents (m,): the face of the whole surface each face is part of.  corners, weights (q, 3): each new
    vertex as a place among the vertices of the whole surface.
    """

    whole: Surface
    surface: Surface
    vertices: np.ndarray
    parents: np.ndarray
    corners: np.ndarray
    weights: np.ndarray

    def weights_in_parents(self, faces: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """(k, 3) weights in the faces `parents[faces]` of places with weights (k, 3) in faces (k,) of this surface."""
        n, into = len(self.whole.vertices), self.whole.faces[self.parents[faces]]
        found = np.zeros((len(faces), 3))
        for c in range(3):
            vertex, share = self.surface.faces[faces, c], weights[:, c, None]
            old = vertex < n
            found += np.where(old[:, None] & (into == vertex[:, None]), share, 0)
            new = np.flatnonzero(~old)
            for k in range(3):
                corner, weight = (a[vertex[new] - n, k, None] for a in (self.corners, self.weights))
                found[new] += np.where(into[new] == corner, share[new] * weight, 0)
        return found


def split_at(surface: Surface, places: Places) -> Split:
    """The surface with its faces divided so that each place is a vertex."""
    n, pieces = len(surface.vertices), dict[int, list[tuple[int, ...]]]()
    new: list[tuple[np.ndarray, np.ndarray]] = []
    vertices = []
    for face, corners, weights in zip(places.faces.tolist(), places.corners, places.weights, strict=True):
        support = np.flatnonzero(weights)
        if len(support) == 1:
            vertices.append(int(corners[support[0]]))
            continue
        point = _over(surface.faces[face], corners, weights)
        same = [k for k, (c, w) in enumerate(new) if np.allclose(_over(surface.faces[face], c, w), point, 0, 1e-12)]
        if same:
            vertices.append(n + same[0])
            continue
        vertex = n + len(new)
        new.append((corners, weights))
        vertices.append(vertex)
        # Through a side, all its faces are split.
        around = (
            [face]
            if len(support) == 3
            else np.flatnonzero(np.isin(surface.faces, corners[support]).sum(axis=1) == 2).tolist()
        )
        for parent in around:
            triangles = pieces.get(parent, [tuple(surface.faces[parent].tolist())])
            at = _over(surface.faces[parent], corners, weights)
            pieces[parent] = [
                t for triangle in triangles for t in _divided(triangle, vertex, surface.faces[parent], at, n, new)
            ]
    whole = np.arange(len(surface.faces))
    if not new:
        nothing = np.empty((0, 3))
        return Split(surface, surface, np.array(vertices, np.int64), whole, nothing.astype(np.int64), nothing)
    kept = np.delete(whole, list(pieces))
    parents = np.concatenate([kept, *(np.full(len(t), f) for f, t in pieces.items())]).astype(np.int64)
    faces = np.concatenate([surface.faces[kept], *(np.array(t) for t in pieces.values())])
    corners = np.array([c for c, _ in new], np.int64).reshape(-1, 3)
    weights = np.array([w for _, w in new])
    points = np.concatenate([surface.vertices, weighted(surface.vertices, corners, weights)])
    return Split(surface, Surface(points, faces, surface.name), np.array(vertices, np.int64), parents, corners, weights)


def _over(face: np.ndarray, corners: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(3,) the weights of a place at the corners of another face that it lies in; less than 1 in sum if it does not."""
    return np.where(face[:, None] == corners, weights, 0).sum(axis=1)


def _divided(
    triangle: tuple[int, ...],
    vertex: int,
    face: np.ndarray,
    at: np.ndarray,
    n: int,
    new: list[tuple[np.ndarray, np.ndarray]],
) -> list[tuple[int, ...]]:
    """A part of a face, divided at a new vertex whose weights in the face are `at`, if that lies in it."""
    rows = [_over(face, *new[v - n]) if v >= n else (face == v).astype(np.float64) for v in triangle]
    inside = np.linalg.solve(np.array(rows).T, at)
    if inside.min() < -1e-9:
        return [triangle]
    return [(triangle[k], triangle[(k + 1) % 3], vertex) for k in range(3) if inside[(k + 2) % 3] > 1e-9]
