"""Which parts of curves on a surface are seen: hidden lines removed exactly, not by the pixels of a picture."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from bihdist_core import Surface
from bihdist_core.analysis.chains import chains
from bihdist_core.analysis.isoline_tracing import isolines
from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray

from ..drawing.shapes import Box
from ..scene.camera import Projection, SeenNow
from ..scene.clipping import ClipPlane
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
    clip
        The plane beyond which the surface is cut away.

    Attributes
    ----------
    faces
        (t, 3) of what is left of the surface.
    at
        (k, 3) their corners in pixels, see `pixels`: the surface's vertices, and points where its edges are cut.
    """

    def __init__(
        self,
        surface: Surface,
        projection: Projection | SeenNow,
        size: tuple[float, float],
        outward: IntArray | None = None,
        clip: ClipPlane | None = None,
    ) -> None:
        self.surface, self.clip = surface, clip
        self._projection = projection
        self._size = size
        extent = np.ptp(surface.vertices[np.unique(surface.faces)], axis=0)
        self.extent = float(np.linalg.norm(extent))
        x, self.faces, of = surface.vertices, surface.faces, np.arange(len(surface.faces))
        if clip is not None:
            x, self.faces, of = cut_faces(x, self.faces, of, clip.depths(x))
        self.at = self.pixels(x)
        self.occlusion = Occlusion(*self._before_the_eye(x, of))
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

    def visible(self, curves: Iterable[Curve], is_section: bool = False) -> list[list[Line]]:
        """Return the visible parts of each curve, in the picture and about it; those of a section lie on the plane."""
        whole = list(curves)
        kept = [(k, part) for k, curve in enumerate(whole) for part in self._before_the_camera(curve, is_section)]
        result: list[list[Line]] = [[] for _ in whole]
        if not kept:
            return result
        curves = [part for _, part in kept]
        rings = [np.append(np.arange(len(c.points)), [0] if c.closed else []).astype(int) for c in curves]
        at = self.pixels(np.concatenate([c.points[r] for c, r in zip(curves, rings, strict=True)]))
        edges = np.concatenate([c.edges[r] for c, r in zip(curves, rings, strict=True)])
        stops = np.cumsum([len(r) for r in rings])
        segments = np.setdiff1d(np.arange(len(at) - 1), stops - 1)
        on = np.concatenate([edges[segments], edges[segments + 1]], axis=1)
        hidden, start, stop = self._hidden(at, segments, on, is_section)
        length = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(at[:, :2], axis=0), axis=1)))
        step = length[hidden + 1] - length[hidden]
        bounds = np.stack([length[hidden] + start * step, length[hidden] + stop * step], 1)
        for (k, curve), end in zip(kept, stops, strict=True):
            first = end - len(curve.points) - curve.closed
            inside = np.s_[np.searchsorted(hidden, first) : np.searchsorted(hidden, end - 1)]
            result[k] += self._about(_parts(at[first:end, :2], length[first:end], bounds[inside], curve.closed))
        return result

    def section(self) -> list[Line]:
        """Return the visible parts of the line where the plane cuts the surface."""
        if self.clip is None:
            return []
        lines = isolines(self.surface, self.clip.depths(self.surface.vertices), [0.0])
        curves = [Curve(line.points, line.edges, line.closed) for line in lines]
        return [part for parts in self.visible(curves, is_section=True) for part in parts]

    def along(self, edges: IntArray, beside: IntArray) -> list[Line]:
        """Return the visible parts of edges (k, 2), of which the outside of one of the faces (k, 2) beside is seen."""
        if self._backs is not None:
            is_inside = np.isin(self._face_keys(self.surface.faces[beside.ravel()]), self._backs)
            edges = edges[~is_inside.reshape(-1, 2).all(axis=1)]
        x = self.surface.vertices
        curves = [Curve(x[ids], np.stack([ids, ids], axis=1), closed) for ids, closed in chains(edges)]
        return [part for parts in self.visible(curves) for part in parts]

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

    def _hidden(
        self, at: FloatArray, segments: IntArray, on: IntArray, shows_insides: bool = False
    ) -> tuple[AnyArray, ...]:
        """Return segments (k,), in order, and from where to where (k,) in the picture, 0 to 1, each is hidden.

        Segment s goes from place s to place s + 1 of places (n, 3) in pixels; `on` is as `Occlusion.intervals` takes
        it.
        """
        lifted = self.lifted(at)
        hidden, start, stop = self.occlusion.intervals(np.stack([lifted[segments], lifted[segments + 1]], 1), on)
        if self._backs is not None and not shows_insides:
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

    def _before_the_eye(self, x: FloatArray, of: IntArray) -> tuple[FloatArray, IntArray]:
        """Return x, y and nearness of what is left of the faces, corners (t, 3, 3), and the vertices of these (t, 3).

        Those that pass the eye are cut.

        Parameters
        ----------
        x
            (k, 3) points of which `faces` are.
        of
            (t,) faces of the surface of which these are.
        """
        depth = self.at[:, 2]
        least = NEAREST * max(float(depth.max(initial=0.0)), 1e-300)
        points, faces, of = cut_faces(x, self.faces, of, depth - least)
        near = self._near(self.at if points is x else self.pixels(points))
        return near[faces], self.surface.faces[of]

    def _before_the_camera(self, curve: Curve, is_section: bool = False) -> list[Curve]:
        """Return what is left of the curve, without the points behind the camera."""
        parts = [curve] if self.clip is None or is_section else _cut_curve(curve, self.clip.depths(curve.points))
        return [piece for part in parts for piece in self._ahead(part)]

    def _ahead(self, curve: Curve) -> list[Curve]:
        before = self.pixels(curve.points)[:, 2] > 0
        if before.all():
            return [curve]
        return [Curve(curve.points[a:b], curve.edges[a:b]) for a, b in _runs(before) if b - a >= 2]


def cut_faces(
    x: FloatArray, faces: IntArray, of: IntArray, depths: FloatArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Cut faces (m, 3) of points (n, 3) where depths (n,) are 0.

    Returns the points with those of the cut, what is left of the faces (t, 3), and of which (t,) each is, named by
    `of` (m,).
    """
    is_left = depths[faces] > 0
    count = is_left.sum(axis=1)
    if (count == 3).all():
        return x, faces, of
    # Of each face, the one corner that is on its own side, and the others.
    parted = np.flatnonzero((count == 1) | (count == 2))
    first = (is_left[parted] == (count[parted] == 1)[:, None]).argmax(axis=1)
    tip, left, right = (faces[parted, (first + k) % 3] for k in range(3))
    edges = np.sort(np.concatenate([np.stack([tip, left], 1), np.stack([tip, right], 1)]), axis=1)
    edges, where = np.unique(edges, axis=0, return_inverse=True)
    a, b = edges.T
    share = depths[a] / (depths[a] - depths[b])
    points = np.concatenate([x, x[a] + share[:, None] * (x[b] - x[a])])
    on_left, on_right = len(x) + where.reshape(2, -1)
    is_lone = count[parted] == 1
    pieces = [
        (is_lone, (tip, on_left, on_right)),
        (~is_lone, (on_left, left, right)),
        (~is_lone, (on_left, right, on_right)),
    ]
    found = [faces[count == 3], *(np.stack(corners, 1)[mask] for mask, corners in pieces)]
    kept = [of[count == 3], *(of[parted[mask]] for mask, _ in pieces)]
    return points, np.concatenate(found), np.concatenate(kept)


def _cut_curve(curve: Curve, depths: FloatArray) -> list[Curve]:
    """Return the parts of a curve where depths (k,) are more than 0, up to where they are 0."""
    is_left = depths > 0
    if is_left.all():
        return [curve]
    order = np.arange(len(depths))
    if curve.closed:
        order = np.roll(order, -int(is_left.argmin()))
        order = np.append(order, order[0])
    parts = []
    for start, stop in _runs(is_left[order]):
        # With the neighbours beyond, which come up to the plane; what they lie on says which face the way there is in.
        rows = order[max(start - 1, 0) : stop + 1]
        points = curve.points[rows].copy()
        for end, before in ((0, 1), (-1, -2)):
            if not is_left[rows[end]]:
                share = depths[rows[before]] / (depths[rows[before]] - depths[rows[end]])
                points[end] = points[before] + share * (points[end] - points[before])
        parts.append(Curve(points, curve.edges[rows]))
    return [part for part in parts if len(part.points) >= 2]


def _runs(mask: BoolArray) -> IntArray:
    """Return where each run of True begins, and the index behind its last (k, 2)."""
    bounds: IntArray = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]]))).reshape(-1, 2)
    return bounds


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
