"""Which parts of curves on a surface are seen: hidden lines removed exactly, not by the pixels of a picture."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray

from ..drawing.shapes import Box
from ..scene.camera import Projection, SeenNow
from ..scene.levels import Levels
from ..scene.line_clipping import Line, clipped
from ..scene.line_labels import Contour
from .occlusion import Occlusion

SHORTEST = 0.25
"""Pixels: shorter pieces are as their neighbours are."""

TOLERANCE = 1e-7
"""Fraction of the surface's extent: what stands before a point by less does not hide it."""

NEAREST = 1e-3
"""Fraction of the largest depth: what is nearer to the eye's plane hides nothing."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve on the surface.

    Attributes
    ----------
    points
        (k, 3) points whose neighbours share a face.
    edges
        (k, 2) vertices of the mesh edge that each lies on, or (k, 3) of the face.
    """

    points: FloatArray
    edges: IntArray
    closed: bool = False


class HiddenLineRemoval:
    """A surface as a camera sees it in a picture; pixels are real numbers, y down.

    Parameters
    ----------
    size
        Width and height of the picture in pixels.
    outward
        (m, 3) faces, wound as seen from outside, whose insides show no curves; None to show them on both sides.
    """

    def __init__(
        self,
        surface: Surface,
        projection: Projection | SeenNow,
        size: tuple[float, float],
        outward: IntArray | None = None,
    ) -> None:
        self.surface = surface
        self._projection = projection
        self._size = size
        extent = np.ptp(surface.vertices[np.unique(surface.faces)], axis=0)
        self.extent = float(np.linalg.norm(extent))
        self.at = self.pixels(surface.vertices)
        self.occlusion = Occlusion(*self._before_the_eye())
        self._backs = None if outward is None else self._face_keys(outward[self._from_inside(outward)])

    def pixels(self, points: FloatArray) -> FloatArray:
        """Return x and y in pixels, and the distance along the line of sight, (n, 3)."""
        x, y, depth = self._projection(points).T
        width, height = self._size
        return np.column_stack([(x + 1) / 2 * width, (1 - y) / 2 * height, depth])

    def sees(self, point: FloatArray) -> bool:
        """Return whether nothing stands before a point (3,) of the surface."""
        at = self.lifted(self.pixels(point[None]))[0]
        return bool(self.occlusion.nearest(at[None, :2])[0] <= at[2])

    def covers(self, points: FloatArray) -> BoolArray:
        """Return whether points (k, 2) of the picture are on the shape, (k,)."""
        return np.isfinite(self.occlusion.nearest(points))

    def visible(self, curves: Iterable[Curve]) -> list[list[Line]]:
        """Return the visible parts of each curve, in the picture and about it."""
        whole = list(curves)
        kept = [(k, part) for k, curve in enumerate(whole) for part in self._before_the_camera(curve)]
        result: list[list[Line]] = [[] for _ in whole]
        if not kept:
            return result
        curves = [part for _, part in kept]
        rings = [np.append(np.arange(len(c.points)), [0] if c.closed else []).astype(int) for c in curves]
        at = self.pixels(np.concatenate([c.points[r] for c, r in zip(curves, rings, strict=True)]))
        edges = np.concatenate([c.edges[r] for c, r in zip(curves, rings, strict=True)])
        stops = np.cumsum([len(r) for r in rings])
        segments = np.setdiff1d(np.arange(len(at) - 1), stops - 1)
        hidden, start, stop = self._hidden(at, segments, np.concatenate([edges[segments], edges[segments + 1]], axis=1))
        length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(at[:, :2], axis=0), axis=1)))
        step = length[hidden + 1] - length[hidden]
        bounds = np.stack([length[hidden] + start * step, length[hidden] + stop * step], 1)
        for (k, curve), end in zip(kept, stops, strict=True):
            first = end - len(curve.points) - curve.closed
            inside = np.s_[np.searchsorted(hidden, first) : np.searchsorted(hidden, end - 1)]
            result[k] += self._about(_parts(at[first:end, :2], length[first:end], bounds[inside], curve.closed))
        return result

    def outlined(self, curves: Iterable[Curve]) -> list[Line]:
        """Return curves in the picture, seen or not."""
        parts = [part for curve in curves for part in self._before_the_camera(curve)]
        return self._about((self.pixels(part.points)[:, :2], part.closed) for part in parts)

    def _about(self, lines: Iterable[Line]) -> list[Line]:
        """Cut lines to the picture and as much around it as it is wide and high.

        Where a surface passes beside the eye they go on for millions of pixels.
        """
        width, height = self._size
        return [part for line in lines for part in clipped(line, Box(-width, -height, 3 * width, 3 * height))]

    def _hidden(self, at: FloatArray, segments: IntArray, on: IntArray) -> tuple[AnyArray, ...]:
        """Return segments (k,), in order, and from where to where (k,) in the picture, 0 to 1, each is hidden.

        Segment s goes from place s to place s + 1 of places (n, 3) in pixels; `on` is as `Occlusion.intervals` takes
        it.
        """
        lifted = self.lifted(at)
        hidden, start, stop = self.occlusion.intervals(np.stack([lifted[segments], lifted[segments + 1]], 1), on)
        if self._backs is not None:
            ids = np.sort(on, axis=1)
            is_new = np.append(np.ones((len(ids), 1), bool), ids[:, 1:] != ids[:, :-1], axis=1)
            in_face = np.flatnonzero(is_new.sum(axis=1) == 3)
            keys = self._face_keys(ids[in_face][is_new[in_face]].reshape(-1, 3))
            inside = in_face[np.isin(keys, self._backs)]
            others = ~np.isin(hidden, inside)
            hidden = np.append(hidden[others], inside)
            start = np.append(start[others], np.zeros(len(inside)))
            stop = np.append(stop[others], np.ones(len(inside)))
            order = np.argsort(hidden, kind="stable")
            hidden, start, stop = hidden[order], start[order], stop[order]
        return segments[hidden], start, stop

    def _from_inside(self, outward: IntArray) -> BoolArray:
        """Return whether faces show their inside, (m,); pixels have y down, which turns them round."""
        a, b, c = (self.at[outward[:, k], :2] for k in range(3))
        u, v = b - a, c - a
        return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0

    def _face_keys(self, faces: IntArray) -> AnyArray:
        """Return a number for each face (m,), whatever the order of its vertices."""
        low, middle, high = np.sort(faces, axis=1).astype(np.uint64).T
        count = np.uint64(len(self.surface.vertices))
        keys: AnyArray = (low * count + middle) * count + high  # of more than 2.6 million vertices some might share one
        return keys

    def lifted(self, at: FloatArray) -> FloatArray:
        """Return x, y and nearness (k, 3) of places (k, 3) in pixels, moved towards the eye by the tolerance."""
        return self._near(at - [0, 0, TOLERANCE * self.extent])

    def depth(self, near: FloatArray) -> FloatArray:
        """Return the distance along the line of sight (k,) from nearness (k,); inf where nothing is seen."""
        with np.errstate(divide="ignore"):
            return np.where(np.isneginf(near), np.inf, 1 / near if self._projection.matrix[3, 2] else -near)

    def _near(self, at: FloatArray) -> FloatArray:
        """Return x, y and nearness (k, 3) of places with x, y and depth; NaN behind the camera."""
        depth = at[:, 2]
        # Seen in perspective, it is 1 / depth that is linear in the picture.
        near = 1 / np.where(depth > 0, depth, np.nan) if self._projection.matrix[3, 2] else -depth
        return np.column_stack([at[:, :2], near])

    def _before_the_eye(self) -> tuple[FloatArray, IntArray]:
        """Return x, y and nearness of the faces' corners (t, 3, 3), and their ids (t, 3).

        Faces that pass the eye are cut.
        """
        faces, depth = self.surface.faces, self.at[:, 2]
        least = NEAREST * max(float(depth.max(initial=0.0)), 1e-300)
        ahead = depth[faces] > least
        whole, count = self._near(self.at)[faces], ahead.sum(axis=1)
        found, ids = [whole[count == 3]], [faces[count == 3]]
        for several, lone in ((1, True), (2, False)):
            face = faces[count == several]
            if not len(face):
                continue
            # The one corner that is on its own side of the eye, and where the two sides from it pass the least depth.
            first = (ahead[count == several] == lone).argmax(axis=1)
            tip, left, right = (face[np.arange(len(face)), (first + k) % 3] for k in range(3))
            x = self.surface.vertices
            cuts = []
            for end in (left, right):
                share = (depth[tip] - least) / (depth[tip] - depth[end])
                cuts.append(self._near(self.pixels(x[tip] + share[:, None] * (x[end] - x[tip]))))
            a, b, c = (self._near(self.at[id]) for id in (tip, left, right))
            pieces = [(a, *cuts)] if lone else [(cuts[0], b, c), (cuts[0], c, cuts[1])]
            found += [np.stack(piece, 1) for piece in pieces]
            ids += [face] * len(pieces)
        return np.concatenate(found), np.concatenate(ids)

    def _before_the_camera(self, curve: Curve) -> list[Curve]:
        """Return the curve, or what is left of it without the points behind the camera."""
        before = self.pixels(curve.points)[:, 2] > 0
        if before.all():
            return [curve]
        ends = np.flatnonzero(np.diff(np.concatenate([[0], before.astype(int), [0]])))
        return [Curve(curve.points[a:b], curve.edges[a:b]) for a, b in ends.reshape(-1, 2) if b - a >= 2]


def contours_seen(sight: HiddenLineRemoval, field: FloatArray, levels: Levels) -> list[Contour]:
    """Return the visible parts of the isolines of a field (n,), in the order of their values."""
    lines = isolines(sight.surface, field, levels.values)
    parts = sight.visible(Curve(line.points, line.edges, line.closed) for line in lines)
    of = np.searchsorted(levels.values, [line.value for line in lines])
    return [
        Contour(line.value, seen, bool(levels.is_bold[k]), bool(levels.is_through[k]))
        for line, seen, k in zip(lines, parts, of, strict=True)
        if seen
    ]


def _parts(at: FloatArray, length: FloatArray, hidden: FloatArray, closed: bool) -> list[Line]:
    """Return the parts of one curve, points (k, 2) at lengths (k,), outside of hidden intervals (m, 2), in order."""
    seen = _outside(hidden, length[0], length[-1])
    if not len(seen):
        return []
    if closed and len(seen) == 1 and seen[0, 0] == length[0] and seen[0, 1] == length[-1]:
        return [(at[:-1], True)]
    parts = [_cut(at, length, start, stop) for start, stop in seen]
    if closed and len(seen) > 1 and seen[0, 0] == length[0] and seen[-1, 1] == length[-1]:
        parts[0] = np.concatenate([parts.pop(), parts[0][1:]])
    return [(part, False) for part in parts]


def _outside(hidden: FloatArray, low: float, high: float) -> FloatArray:
    """Return the gaps that intervals (m, 2) leave between low and high (k, 2); specks join their neighbours."""
    if len(hidden):
        apart = hidden[1:, 0] - hidden[:-1, 1] >= SHORTEST
        hidden = np.stack([hidden[np.append(True, apart), 0], hidden[np.append(apart, True), 1]], 1)
        hidden = hidden[hidden[:, 1] - hidden[:, 0] >= SHORTEST]
    seen = np.stack([np.append(low, hidden[:, 1]), np.append(hidden[:, 0], high)], 1)
    return seen[seen[:, 1] - seen[:, 0] >= SHORTEST] if len(hidden) else seen


def _cut(at: FloatArray, length: FloatArray, start: float, stop: float) -> FloatArray:
    """Return the part (k, 2) of a line from one length to another."""
    inner = length[(length > start) & (length < stop)]
    lengths = np.concatenate([[start], inner, [stop]])
    return np.stack([np.interp(lengths, length, at[:, k]) for k in (0, 1)], 1)
