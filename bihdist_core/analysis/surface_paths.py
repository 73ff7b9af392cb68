"""Paths on a surface: polylines of which each piece lies in one face, so that fields can be read along them exactly."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.exact_geodesic import FacePath
from ..errors import ParameterError
from ..sources.splitting import Split
from ..surface import Surface
from .places import Places, weighted

NO_WAY = 1e-13
"""Pieces of a path that are shorter than this, in mean edge lengths, are left out."""


@dataclass(frozen=True, eq=False)
class SurfacePath:
    """A polyline of k points on a surface; piece i, from point i to the next, lies in one face.

    points: (k, 3).  faces: (k - 1,) the faces of the pieces; corners: (k - 1, 3) their vertices; begins, ends:
    (k - 1, 3) the weights of both ends of each piece at them, at least 0 and 1 in sum.  knots: (j,) which of the points
    are the places the path was led through.  method, label: how it was made, as a word and in words.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> path = bihdist.GeodesicPaths(plane).path([0, 9])
    >>> round(path.length, 3), path.arcs.round(3).tolist()
    (1.031, [0.0, 0.258, 0.344, 0.515, 0.687, 0.773, 1.031])
    """

    points: FloatArray
    faces: IntArray
    corners: IntArray
    begins: FloatArray
    ends: FloatArray
    knots: IntArray
    method: str
    label: str

    @cached_property
    def arcs(self) -> FloatArray:
        """(k,) length along the path up to each point.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 5])
        >>> path.arcs.round(3).tolist()  # up to each edge that is crossed
        [0.0, 0.559, 1.118]
        """
        return np.append(0, np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1)))

    @property
    def length(self) -> float:
        """Length of the path, unit length.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 24])
        >>> round(path.length, 3)  # the diagonal of the unit square
        1.414
        """
        return float(self.arcs[-1])

    @property
    def places(self) -> Places:
        """The k points as places.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 5])
        >>> places = path.places
        >>> places.faces.tolist(), (places.weights[0]).round(3).tolist()
        ([0, 3, 3], [1.0, 0.0, 0.0])
        """
        faces, corners = (np.append(a, a[-1:], axis=0) for a in (self.faces, self.corners))
        return Places(faces, corners, np.append(self.begins, self.ends[-1:], axis=0))

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """(k,) or (k, d): values (n,) or (n, d) at the vertices, linear on each face, at the points of the path.

        Between two points they change linearly with arc length, so this is the whole profile.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 5])
        >>> path.along(plane.points[:, 0]).round(3).tolist()
        [-0.5, 0.0, 0.5]
        """
        return self.places.values(field)

    def at(self, arcs: npt.ArrayLike) -> Places:
        """The places (q,) at lengths (q,) along the path; those before its start or past its end are its ends.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 8])
        >>> middle = path.at([path.length / 2])
        >>> middle.values(plane.points).round(6).tolist()
        [[0.0, 0.0, 0.0]]
        """
        s = np.clip(np.array(arcs, np.float64, ndmin=1), 0, self.length)
        piece = np.clip(np.searchsorted(self.arcs, s, side="right") - 1, 0, len(self.faces) - 1)
        span = self.arcs[piece + 1] - self.arcs[piece]
        t = np.divide(s - self.arcs[piece], span, out=np.zeros(len(s)), where=span > 0)[:, None]
        return Places(self.faces[piece], self.corners[piece], (1 - t) * self.begins[piece] + t * self.ends[piece])


@dataclass(frozen=True, eq=False)
class Crossings:
    """A path by the edges that it meets.

    ends (k, 2), t (k,): point i is (1 - t) x_a + t x_b with a, b = ends[i]; at a vertex, a and b are equal.  faces (k -
    1,): the face between each point and the next.
    """

    ends: IntArray
    t: FloatArray
    faces: IntArray

    def points(self, x: FloatArray) -> FloatArray:
        """(k, 3) the points, among vertices x (n, 3)."""
        return (1 - self.t)[:, None] * x[self.ends[:, 0]] + self.t[:, None] * x[self.ends[:, 1]]


def assembled(split: Split, parts: Sequence[Crossings], method: str, label: str) -> SurfacePath:
    """The path of several parts on a split surface, each begun where the last ended, as a path on the whole surface."""
    faces = np.concatenate([part.faces for part in parts])
    begins, ends = (
        np.concatenate([_weights(split.surface, part, end) for part in parts])
        for end in (slice(None, -1), slice(1, None))
    )
    begins, ends = (split.weights_in_parents(faces, w) for w in (begins, ends))
    parents = split.parents[faces]
    knots = np.append(0, np.cumsum([len(part.faces) for part in parts]))
    # Points inside a face that is whole are ends of pieces only where it was split.
    inner = (begins[1:] > 0).all(axis=1) & (parents[1:] == parents[:-1])
    inner[knots[1:-1] - 1] = False
    first = np.append(True, ~inner)
    last = np.append(~inner, True)
    number = np.append(np.cumsum(first) - 1, first.sum())
    parents, begins, ends = parents[first], begins[first], ends[last]
    corners = split.whole.faces[parents]
    x = split.whole.vertices
    points = np.append(weighted(x, corners, begins), weighted(x, corners[-1:], ends[-1:]), axis=0)
    return SurfacePath(points, parents, corners, begins, ends, number[knots], method, label)


def _weights(surface: Surface, part: Crossings, which: slice) -> FloatArray:
    corners, ends, t = surface.faces[part.faces], part.ends[which], part.t[which, None]
    is_vertex = (ends[:, :1] == ends[:, 1:]) & (corners == ends[:, :1])
    return np.where(is_vertex, 1.0, np.where(corners == ends[:, :1], 1 - t, np.where(corners == ends[:, 1:], t, 0)))


def in_faces(surface: Surface, parts: Sequence[FacePath], method: str, label: str) -> SurfacePath:
    """The path of several parts, each begun where the last ended."""
    x, moving = surface.vertices, []
    for part in parts:
        corners = surface.faces[part.faces]
        way = weighted(x, corners, part.ends) - weighted(x, corners, part.begins)
        moves = np.linalg.norm(way, axis=1) > NO_WAY * surface.mean_edge_length
        moves[0] |= not moves.any()
        moving.append(moves)
    faces, begins, ends = (
        np.concatenate([getattr(part, name)[moves] for part, moves in zip(parts, moving, strict=True)])
        for name in ("faces", "begins", "ends")
    )
    corners = surface.faces[faces]
    points = np.append(weighted(x, corners, begins), weighted(x, corners[-1:], ends[-1:]), axis=0)
    knots = np.append(0, np.cumsum([moves.sum() for moves in moving]))
    return SurfacePath(points, faces, corners, begins, ends, knots, method, label)


class Stars:
    """The faces around each vertex."""

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        corner = surface.faces.ravel()
        self._faces = np.argsort(corner, kind="stable") // 3
        self._first = np.append(0, np.cumsum(np.bincount(corner, minlength=len(surface.vertices))))

    def __getitem__(self, vertex: int) -> IntArray:
        """The faces (k,) of a vertex."""
        return self._faces[self._first[vertex] : self._first[vertex + 1]]

    def common(self, ends: IntArray) -> IntArray:
        """(k - 1,) a face that holds both points of each piece, whose points are on edges `ends` (k, 2)."""
        faces = []
        for a, b in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True):
            shared = set.intersection(*(set(self[v].tolist()) for v in {*a, *b}))
            if not shared:
                raise ParameterError(f"Vertices {sorted({*a, *b})} are in no common face.")
            faces.append(min(shared))
        return np.array(faces, np.int64)
