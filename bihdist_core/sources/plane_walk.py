"""Walks from one place to another across faces, where a plane upright on the surface cuts it."""

import numpy as np

from ..arrays import FloatArray
from ..errors import ParameterError
from ..surface import Surface
from .edge_faces import edge_faces
from .source import SurfacePoint

FURTHEST = 10
"""A way may be so many times as long as the straight line."""
PLANES = 12
"""So many planes through two places are tried."""

Step = tuple[int, FloatArray, FloatArray]
"""A face, and the weights (3,) of where the way enters and leaves it."""


class PlaneWalk:
    """Ways on one surface."""

    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._edges = edge_faces(surface)

    def between(self, start: SurfacePoint, stop: SurfacePoint) -> list[Step] | None:
        """Return the shorter of the ways in the plane through both that is upright on the surface.

        Where there is none, or only one that is far longer than the straight line, the shortest in other planes; None
        if these have none either.
        """
        p, q = self._position(start), self._position(stop)
        first, last = self._faces_at(start), self._faces_at(stop)
        if common := sorted(set(first) & set(last)):
            face = common[0]
            return [(face, self._weights(start, face), self._weights(stop, face))]
        straight = q - p
        axis = straight / max(float(np.linalg.norm(straight)), 1e-300)
        upright = self._normal(first) + self._normal(last)
        upright = upright - axis * (axis @ upright)
        if not np.linalg.norm(upright) > 1e-6:
            upright = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
        across = np.cross(axis, upright)
        if way := self._in_plane(start, stop, first, last, across)[0]:
            return way
        turns = np.pi * np.arange(1, PLANES) / PLANES
        ways = [self._in_plane(start, stop, first, last, np.cos(t) * across + np.sin(t) * upright) for t in turns]
        return min(ways, key=lambda each: each[1])[0]

    def _in_plane(
        self, start: SurfacePoint, stop: SurfacePoint, first: list[int], last: list[int], normal: FloatArray
    ) -> tuple[list[Step] | None, float]:
        """Return the shortest way in a plane with this normal, and its length."""
        p, q = self._position(start), self._position(stop)
        heights = _Heights(self._surface.vertices, p, normal)
        shortest, length = None, FURTHEST * float(np.linalg.norm(q - p))
        for face in first:
            for k in range(3):
                way, far = self._way(start, stop, face, k, set(last), heights, length)
                if way is not None and far < length:
                    shortest, length = way, far
        return shortest, length if shortest else np.inf

    def _way(
        self,
        start: SurfacePoint,
        stop: SurfacePoint,
        face: int,
        corner: int,
        last: set[int],
        heights: "_Heights",
        most: float,
    ) -> tuple[list[Step] | None, float]:
        """Out of a face over the side from a corner to the next, and on until a face of the end is met; how far."""
        faces, steps, at = self._surface.faces, [], self._weights(start, face)
        # A corner in the plane is on one side of it, so that each face is cut along two sides or not at all.
        seen, far = {face}, 0.0
        while far <= most:
            i, j = faces[face, corner], faces[face, (corner + 1) % 3]
            if (heights[i] >= 0) == (heights[j] >= 0):
                break
            share = heights[i] / (heights[i] - heights[j])
            out = np.zeros(3)
            out[corner], out[(corner + 1) % 3] = 1 - share, share
            steps.append((face, at, out))
            far += self._length(steps[-1])
            beside = [other for other in self._edges.at(i, j) if other != face]
            if len(beside) != 1 or beside[0] in seen:
                break  # a boundary, an edge of several faces, or all the way round
            face = beside[0]
            seen.add(face)
            at = np.where(faces[face] == i, 1 - share, np.where(faces[face] == j, share, 0.0))
            if face in last:
                steps.append((face, at, self._weights(stop, face)))
                return steps, far + self._length(steps[-1])
            corner = next(
                k
                for k in range(3)
                if (heights[faces[face, k]] >= 0) != (heights[faces[face, (k + 1) % 3]] >= 0)
                and {faces[face, k], faces[face, (k + 1) % 3]} != {i, j}
            )
        return None, far

    def _faces_at(self, place: SurfacePoint) -> list[int]:
        """Return the faces that hold a place: one, two at an edge, all around a vertex."""
        corners = self._surface.faces[place.face][np.array(place.weights) > 0]
        if len(corners) == 3:
            return [place.face]
        if len(corners) == 2:
            return self._edges.at(*corners)
        return [int(face) for face in np.flatnonzero((self._surface.faces == corners[0]).any(axis=1))]

    def _weights(self, place: SurfacePoint, face: int) -> FloatArray:
        """Return (3,) the weights of a place in a face that holds it."""
        weights = np.zeros(3)
        for corner, weight in zip(self._surface.faces[place.face], place.weights, strict=True):
            if weight > 0:
                weights[self._surface.faces[face] == corner] = weight
        return weights

    def _position(self, place: SurfacePoint) -> FloatArray:
        position: FloatArray = np.array(place.weights) @ self._surface.vertices[self._surface.faces[place.face]]
        return position

    def _normal(self, faces: list[int]) -> FloatArray:
        a, b, c = self._surface.vertices[self._surface.faces[faces]].swapaxes(0, 1)
        normal = np.cross(b - a, c - a).sum(axis=0)
        unit: FloatArray = normal / max(float(np.linalg.norm(normal)), 1e-300)
        return unit

    def _length(self, step: Step) -> float:
        face, start, stop = step
        return float(np.linalg.norm((stop - start) @ self._surface.vertices[self._surface.faces[face]]))


class _Heights(dict[int, float]):
    """Heights of vertices over a plane, found when they are asked for, as a way meets few of a surface's."""

    def __init__(self, vertices: FloatArray, point: FloatArray, normal: FloatArray) -> None:
        self._vertices, self._point, self._normal = vertices, point, normal

    def __missing__(self, vertex: int) -> float:
        height = self[vertex] = float((self._vertices[vertex] - self._point) @ self._normal)
        return height


def joined(walk: PlaneWalk, start: SurfacePoint, stop: SurfacePoint, name: str) -> list[Step]:
    """Return the way between two places; ParameterError, with the name of the way, if there is none."""
    way = walk.between(start, stop)
    if way is None:
        raise ParameterError(
            f"{name} (faces {start.face} and {stop.face}) cannot be joined in a plane on the surface; give points "
            "between them."
        )
    return way
