"""A surface with vertices at given places: faces are divided there, and its shape stays what it is."""

import numpy as np

from ..surface import Surface
from .edge_faces import EdgeFaces
from .pieces import Pieces

SNAP = 1e-6
"""A place whose weights are below this belongs to the edge or the corner opposite: thinner faces help nobody."""


def split_at(surface: Surface, points: Pieces) -> tuple[Surface, np.ndarray]:
    """The surface divided, and (k,) its vertices at the points; the old vertices keep their numbers.

    A point in a face divides it in three, one on an edge the faces at that edge in two each.  Points of one line come
    best one after another, its ends first: then the line consists of edges.
    """
    division = _Division(surface)
    ids = np.array([division.put(*each) for each in zip(points.faces.tolist(), points.start, strict=True)])
    return division.surface(), ids


class _Division:
    """parts: of each face that is divided, its parts, as vertices and the weights (3, 3) of these in the face."""

    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._new: list[np.ndarray] = []
        self._parts: dict[int, list[tuple[list[int], np.ndarray]]] = {}
        self._edges = EdgeFaces(surface)

    def surface(self) -> Surface:
        old, kept = self._surface, np.ones(len(self._surface.faces), bool)
        kept[list(self._parts)] = False
        faces = [old.faces[kept], *(np.array([f for f, _ in parts]) for parts in self._parts.values())]
        return Surface(np.concatenate([old.vertices, *(x[None] for x in self._new)]), np.concatenate(faces), old.name)

    def put(self, face: int, weights: np.ndarray) -> int:
        """The vertex at a place, new if there is none."""
        weights = np.where(weights < SNAP, 0, weights)
        weights = weights / weights.sum()
        corners = self._surface.faces[face]
        used = np.flatnonzero(weights)
        if len(used) == 1:
            return int(corners[used[0]])
        vertex = len(self._surface.vertices) + len(self._new)
        holding = [face] if len(used) == 3 else self._edges.at(*corners[used])
        for other in holding:
            there = np.zeros(3)
            for k in used:
                there[self._surface.faces[other] == corners[k]] = weights[k]
            known = self._divide(other, there, vertex)
            if known is not None:
                return known
        self._new.append(weights @ self._surface.vertices[corners])
        return vertex

    def _divide(self, face: int, at: np.ndarray, vertex: int) -> int | None:
        """Divide the parts of a face that hold a place; the vertex that is there already, if any."""
        parts = self._parts.get(face) or [(self._surface.faces[face].tolist(), np.eye(3))]
        divided: list[tuple[list[int], np.ndarray]] = []
        for ids, where in parts:
            inside = np.linalg.solve(where.T, at)
            inside[np.abs(inside) < SNAP] = 0
            if (inside < 0).any():
                divided.append((ids, where))
                continue
            used = np.flatnonzero(inside)
            if len(used) == 1:
                return ids[used[0]]
            for k in used:
                moved, there = list(ids), where.copy()
                moved[k], there[k] = vertex, at
                divided.append((moved, there))
        self._parts[face] = divided
        return None


def along(pieces: Pieces, spacing: float, surface: Surface) -> Pieces:
    """Points of the pieces, both ends and others between them that are at most so far apart.

    The ends of all come first, see `split_at`.
    """
    start, stop = pieces.positions(surface.vertices)
    counts = np.maximum(np.ceil(np.linalg.norm(stop - start, axis=1) / spacing), 1).astype(int)
    which = np.repeat(np.arange(len(pieces)), counts - 1)
    number = np.arange(len(which)) - np.repeat(np.cumsum(counts - 1) - (counts - 1), counts - 1) + 1
    share = (number / counts[which])[:, None]
    between = pieces.start[which] + share * (pieces.stop[which] - pieces.start[which])
    ends = pieces.ends
    weights = np.concatenate([ends.start, between])
    faces = np.concatenate([ends.faces, pieces.faces[which]])
    corners = np.concatenate([ends.corners, pieces.corners[which]])
    return Pieces(faces, corners, weights, weights, np.zeros(len(faces), bool))
