"""A surface with vertices at given places: faces are divided there, and its shape stays what it is."""

from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..surface import Surface
from .edge_faces import EdgeFaces

SNAP = 1e-6
"""A weight below this is 0: the place belongs to the edge or the corner opposite, as thinner faces help nobody."""


@dataclass(frozen=True, eq=False)
class Split:
    """A surface with vertices at some places; its shape stays, and so do lengths and linear fields.

    Attributes
    ----------
    whole : Surface
        The surface before.
    surface : Surface
        The divided surface: the vertices of the whole one first, then one for each place that is none of them.
    vertices : (k,) ndarray
        The vertices at the places.
    parents : (m,) ndarray
        The face of the whole surface that each face is part of; divided faces come last.
    corners : (p, 3, 3) ndarray
        The weights of the corners of these in their parents.
    """

    whole: Surface
    surface: Surface
    vertices: IntArray
    parents: IntArray
    corners: FloatArray

    def weights_in_parents(self, faces: IntArray, weights: FloatArray) -> FloatArray:
        """Return (k, 3) weights in the faces `parents[faces]` of places with weights (k, 3) in faces (k,) of this
        surface."""
        part = faces - (len(self.parents) - len(self.corners))
        found = weights.copy()
        divided = np.flatnonzero(part >= 0)
        found[divided] = np.einsum("kc,kcd->kd", weights[divided], self.corners[part[divided]])
        return found


def split_at(surface: Surface, faces: IntArray, weights: FloatArray, snap: float = SNAP) -> Split:
    """Return the surface divided so that the places in faces (k,), with weights (k, 3), are vertices.

    A point in a face divides it in three, one on an edge the faces at that edge in two each. Weights below `snap` are
    0. Points of one line come best one after another, its ends first: then the line consists of edges.
    """
    division = _Division(surface, snap)
    return division.result(np.array([division.put(*each) for each in zip(faces.tolist(), weights, strict=True)]))


class _Division:
    """A surface while it is divided.

    `_parts` holds the parts of each face that is divided, as vertices and the weights (3, 3) of these in the face.
    """

    def __init__(self, surface: Surface, snap: float) -> None:
        self._surface, self._snap = surface, snap
        self._new: list[FloatArray] = []
        self._parts: dict[int, list[tuple[list[int], FloatArray]]] = {}
        self._edges = EdgeFaces(surface)

    def result(self, vertices: IntArray) -> Split:
        old = self._surface
        whole = np.delete(np.arange(len(old.faces)), list(self._parts))
        if not self._parts:
            return Split(old, old, vertices, whole, np.empty((0, 3, 3)))
        parts = [(face, *each) for face, of_face in self._parts.items() for each in of_face]
        parents, faces, corners = (np.array(each) for each in zip(*parts, strict=True))
        divided = Surface(
            np.concatenate([old.vertices, self._new]), np.concatenate([old.faces[whole], faces]), old.name
        )
        return Split(old, divided, vertices, np.concatenate([whole, parents]), corners)

    def put(self, face: int, weights: FloatArray) -> int:
        """Return the vertex at a place, new if there is none."""
        weights = np.where(weights < self._snap, 0, weights)
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

    def _divide(self, face: int, at: FloatArray, vertex: int) -> int | None:
        """Divide the parts of a face that hold a place; the vertex that is there already, if any."""
        parts = self._parts.get(face) or [(self._surface.faces[face].tolist(), np.eye(3))]
        divided: list[tuple[list[int], FloatArray]] = []
        for ids, where in parts:
            inside = np.linalg.solve(where.T, at)
            inside[np.abs(inside) < self._snap] = 0
            if (inside < 0).any():
                divided.append((ids, where))
                continue
            used = np.flatnonzero(inside)
            if len(used) == 1:
                return int(ids[used[0]])
            for k in used:
                moved, there = list(ids), where.copy()
                moved[k], there[k] = vertex, at
                divided.append((moved, there))
        self._parts[face] = divided
        return None
