"""Paths on a surface: polylines of which each piece lies in one face, so that fields can be read along them exactly."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..sources.splitting import Split
from ..surface import Surface
from .places import Places, weighted

OFF = 1e-4
"""Points of a path may be so far from the mesh's edges, in mean edge lengths, before they are put there."""
CORNER = 1e-9
"""Closer than this share of an edge to its end, a point is that vertex."""


@dataclass(frozen=True, eq=False)
class SurfacePath:
    """A polyline of k points on a surface; piece i, from point i to the next, lies in one face.

    points: (k, 3).  faces: (k - 1,) the faces of the pieces; corners: (k - 1, 3) their vertices; begins, ends:
    (k - 1, 3) the weights of both ends of each piece at them, at least 0 and 1 in sum.  knots: (j,) which of the points
    are the places the path was led through.  method, label: how it was made, as a word and in words.
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
        """(k,) length along the path up to each point."""
        return np.append(0, np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1)))

    @property
    def length(self) -> float:
        """Length of the path, unit length."""
        return float(self.arcs[-1])

    @property
    def places(self) -> Places:
        """The k points as places."""
        faces, corners = (np.append(a, a[-1:], axis=0) for a in (self.faces, self.corners))
        return Places(faces, corners, np.append(self.begins, self.ends[-1:], axis=0))

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """(k,) or (k, d): values (n,) or (n, d) at the vertices, linear on each face, at the points of the path.

        Between two points they change linearly with arc length, so this is the whole profile.
        """
        return self.places.values(field)

    def at(self, arcs: npt.ArrayLike) -> Places:
        """The places (q,) at lengths (q,) along the path; those before its start or past its end are its ends."""
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

    def followed(self, polyline: FloatArray, start: int, stop: int) -> Crossings:
        """The crossings of a polyline (k, 3) of points near edges, two in a row in one face, between two vertices.

        SolverError where the polyline leaves the surface.
        """
        x, triangles = self.surface.vertices, self.surface.faces
        tolerance = OFF * self.surface.mean_edge_length
        # Beside degenerate faces the ends may be reached through a side in the same place.
        q, around, faces = np.concatenate([polyline[:1], polyline, polyline[-1:]]), self[start], []
        for k in range(len(q) - 1):
            if k == len(q) - 2:
                around = np.intersect1d(around, self[stop])
                if not len(around):
                    raise SolverError(f"A path from vertex {start} to {stop} left the surface {self.surface.name}.")
            corners = triangles[around]
            a, b = x[corners], x[corners[:, [1, 2, 0]]]
            off = _apart(a, b, q[k : k + 2])
            both = off.min(axis=1).max(axis=1)
            best = int(both.argmin())
            if not both[best] <= tolerance:
                raise SolverError(f"A path from vertex {start} to {stop} left the surface {self.surface.name}.")
            faces.append(int(around[best]))
            side = int(off[best, :, 1].argmin())
            around = np.concatenate([self[int(corners[best, (side + end) % 3])] for end in (0, 1)])
        found = self._crossings(q, np.array(faces, np.int64), start, stop, tolerance)
        length, expected = (float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in (found.points(x), q))
        if not abs(length - expected) <= OFF * expected:
            raise SolverError(f"A path from vertex {start} to {stop} was not found again on {self.surface.name}.")
        return found

    def _crossings(self, q: FloatArray, faces: IntArray, start: int, stop: int, tolerance: float) -> Crossings:
        x, triangles = self.surface.vertices, self.surface.faces
        at, parameters = [(start, start)], [0.0]
        for k in range(1, len(q) - 1):
            before, after = triangles[faces[k - 1]], triangles[faces[k]]
            shared = before[np.isin(before, after)]
            sides = [(shared[i - 1], shared[i]) for i in range(len(shared))][: 3 if len(shared) == 3 else 1]
            a, b = (x[[side[end] for side in sides]][None] for end in (0, 1))
            best = int(_apart(a, b, q[k : k + 1])[0, :, 0].argmin())
            i, j = (int(v) for v in sides[best])
            share = float(_foot(x[i], x[j], q[k]))
            i, j, share = (i, i, 0.0) if share < CORNER else (j, j, 0.0) if share > 1 - CORNER else (i, j, share)
            if not np.linalg.norm((1 - share) * x[i] + share * x[j] - q[k]) <= tolerance:
                raise SolverError(f"A path from vertex {start} to {stop} left the surface {self.surface.name}.")
            at.append((i, j))
            parameters.append(share)
        ends, t = np.array([*at, (stop, stop)]), np.array([*parameters, 0.0])
        moves = (ends[1:] != ends[:-1]).any(axis=1) | (t[1:] != t[:-1])
        distinct = np.append(True, moves)
        return Crossings(ends[distinct], t[distinct], faces[moves])


def _foot(a: FloatArray, b: FloatArray, q: FloatArray) -> FloatArray:
    """Parameter, 0 to 1, of the point of the segments ab nearest to q; along the last axis."""
    side = b - a
    square = (side * side).sum(axis=-1)
    parameter: FloatArray = np.clip(((q - a) * side).sum(axis=-1) / np.where(square > 0, square, 1), 0, 1)
    return parameter


def _apart(a: FloatArray, b: FloatArray, q: FloatArray) -> FloatArray:
    """(f, s, p) distances of points q (p, 3) from segments a, b (f, s, 3)."""
    a, b = a[:, :, None], b[:, :, None]
    t = _foot(a, b, q)[..., None]
    distance: FloatArray = np.linalg.norm((1 - t) * a + t * b - q, axis=-1)
    return distance
