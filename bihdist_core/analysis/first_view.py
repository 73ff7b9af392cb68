"""First view of a surface and first source of a field: on its outside, and seen from there."""

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..surface import Surface
from .upright import axes_of, scattered
from .view_directions import FIRST_VIEWS, OBLIQUE_VIEWS

PREFERRED = {"home": 1.5, "high": 1.15}
"""The factor by which another view must show more."""

FEET, ANKLES = (0.0, 0.03), (0.05, 0.12)
"""Where feet and ankles of a standing figure are, as fractions of its height."""

TOES = 0.03
"""How far feet reach forward from the ankles, as a fraction of the height, at least."""

TALL = 0.95
"""How high a standing figure is, as a fraction of its width, at least: arms may be stretched out."""

SAMPLES = 20_000
"""Places on the faces that stand for the whole."""

CELLS = 64
"""Cells along each side of a picture; some five places fall into each cell that the shape covers."""

INSIDE = 0.3
"""The weight of the inside, as a fraction of that of the outside."""

SLOPE = 0.2
"""The tangent of half the angle that the shape fills."""

WELL_SEEN = 0.3
"""The least cosine of the angle between the normal of what is well seen and the way to the camera."""

EQUAL = 1e-6
"""Heights that differ by less than this fraction of the component's are equal."""

MOST_TRIED = 200
"""Vertices, from the top down, of which one is looked for that nothing hides."""


@dataclass(frozen=True)
class FirstLook:
    """The name of a view among FIRST_VIEWS, and a source vertex that is seen in it."""

    view: str
    source: int


def first_look(surface: Surface, up: str = "y") -> FirstLook:
    """Choose the view that shows most of the outside with a long outline, and a source that is seen in it.

    `up` is an axis. The order of the corners tells the outside; where most of what is seen from all sides is inside,
    the normals point inwards. What a view shows is the area seen, the inside counted less, times the outline's length.
    Home is left only for a view that shows half as much again; a standing figure whose feet point to the back is seen
    from there.

    The source is the highest vertex of the component with the largest area, if it is seen; otherwise the highest of
    those that are well seen. Of equally high ones it is the first, or if that faces away, the one that faces the camera
    most.
    """
    surface = surface.shape
    areas = surface.face_areas
    of_face = surface.component_of_vertex[surface.faces[:, 0]]
    ids = np.flatnonzero(surface.component_of_vertex == np.bincount(of_face, areas).argmax())
    heights = surface.vertices[ids] @ axes_of(up)[:, 1]
    highest = int(ids[heights.argmax()])
    if not areas.sum() > 0 or is_flat(surface.vertices[surface.component_of_vertex >= 0]):
        return FirstLook("home", highest)
    places, faces = scattered(surface, SAMPLES)
    sights = [_Sight(surface, places, faces, axes_of(up), OBLIQUE_VIEWS[name]) for name in FIRST_VIEWS]
    outside, inside = np.array([sight.areas for sight in sights]).T
    outwards = 1.0
    # The last view is from above; the others go all round, so that none of the sides counts twice.
    if inside[:-1].sum() > outside[:-1].sum():
        outside, inside, outwards = inside, outside, -1.0
    # Of a sheet with one side about half of what is seen is inside, from wherever.
    side = "-back" if _faces_back(places @ axes_of(up)) else ""
    preferred = {f"{name}{side}": factor for name, factor in PREFERRED.items()}
    # What sticks out is told by the length of the outline: legs side by side, not one before the other.
    shown = (outside + INSIDE * inside) * [
        sight.outline * preferred.get(name, 1.0) for name, sight in zip(FIRST_VIEWS, sights, strict=True)
    ]
    best = int(shown.argmax())
    return FirstLook(FIRST_VIEWS[best], sights[best].source_among(ids, heights, outwards))


def _faces_back(places: FloatArray) -> bool:
    """Return whether the feet of a standing figure point to the back, by places (k, 3): right, up and to the front."""
    low, extents = places.min(axis=0), np.ptp(places, axis=0)
    if extents[1] < TALL * max(extents[0], extents[2]):
        return False
    heights = (places[:, 1] - low[1]) / extents[1]
    parts = [places[(heights >= start) & (heights < end)] for start, end in (FEET, ANKLES)]
    if not all(len(part) for part in parts):
        return False
    feet, ankles = (part.mean(axis=0) for part in parts)
    right, _, front = (feet - ankles) / extents[1]
    # A foot to the side is a step, or no foot.
    return bool(front < -TOES and abs(right) < -front / 2)


def is_flat(points: FloatArray) -> bool:
    """Return whether points (n, 3) lie in a plane of constant z."""
    # Column by column, which is several times faster than along the short axis.
    extents = [np.ptp(column) for column in points.T]
    return bool(extents[2] <= 1e-6 * max(extents))


class _Sight:
    """The part of a surface that a camera sees which has all of it in a square picture.

    `places` (k, 3) are points on `faces` (k,), `axes` those of `axes_of`, `direction` is one of OBLIQUE_VIEWS.
    """

    def __init__(
        self,
        surface: Surface,
        places: FloatArray,
        faces: IntArray,
        axes: FloatArray,
        direction: tuple[float, float, float],
    ) -> None:
        self._surface = surface
        back = axes @ np.array(direction)
        back /= np.linalg.norm(back)
        right = np.cross(axes[:, 1], back)
        right /= np.linalg.norm(right)
        self._frame = np.stack([right, np.cross(back, right), back], axis=1)
        middle = (places.min(axis=0) + places.max(axis=0)) / 2
        local = (places - middle) @ self._frame
        distance = float((np.abs(local[:, :2]).max(axis=1) / SLOPE + local[:, 2]).max())
        self._eye = middle + distance * back
        x, y, depth = self._seen(places)
        cells = _cells(x, y)
        order = np.lexsort((depth, cells))
        nearest = order[np.append(True, np.diff(cells[order]) > 0)]
        self._nearest = np.full(CELLS * CELLS, np.inf)
        self._nearest[cells[nearest]] = depth[nearest]
        is_outside = _facing(surface, faces[nearest], self._eye) > 0
        side = 2 * SLOPE * distance / CELLS
        self.areas = side**2 * is_outside.sum(), side**2 * (~is_outside).sum()  # seen of the outside and the inside
        # Of four cells at once, or a cell that by chance no place falls into would be a hole.
        is_covered = np.pad(np.isfinite(self._nearest).reshape(CELLS // 2, 2, CELLS // 2, 2).any(axis=(1, 3)), 1)
        self.outline = 2 * side * sum(np.diff(is_covered, axis=axis).sum() for axis in (0, 1))  # length, with holes

    def source_among(self, ids: IntArray, heights: FloatArray, outwards: float) -> int:
        """Return the source among vertices (k,) with heights (k,); `outwards` is -1 where normals point inwards."""
        first, level = int(heights.argmax()), EQUAL * float(np.ptp(heights))
        as_high = np.flatnonzero(heights >= heights[first] - level)
        facing = outwards * self._vertices_facing(ids[as_high])
        if facing[np.searchsorted(as_high, first)] < 0:
            first = int(as_high[facing.argmax()])
        if self._is_seen(int(ids[first]), outwards):
            return int(ids[first])
        some = self._may_be_seen(ids)
        others, heights = ids[some], heights[some]
        well = outwards * self._vertices_facing(others) >= WELL_SEEN
        others = others[well][np.argsort(-heights[well], kind="stable")][:MOST_TRIED]
        return next((int(vertex) for vertex in others if self._is_seen(int(vertex), outwards)), int(ids[first]))

    def _seen(self, points: FloatArray) -> FloatArray:
        """Return (3, k) where points (k, 3) are in the picture, -SLOPE to SLOPE, and how far away."""
        right, up, back = ((points - self._eye) @ self._frame).T
        return np.stack([right / -back, up / -back, -back])

    def _vertices_facing(self, ids: IntArray) -> FloatArray:
        """Return (k,) the cosine of the angle between the normal of vertices (k,) and the way to the camera."""
        vertices, faces = self._surface.vertices, self._surface.faces
        is_asked = np.zeros(len(vertices), bool)
        is_asked[ids] = True
        faces = faces[is_asked[faces].any(axis=1)]
        a, b, c = vertices[faces].transpose(1, 0, 2)
        normals = [
            np.bincount(faces.ravel(), np.repeat(each, 3), len(vertices))[ids] for each in np.cross(b - a, c - a).T
        ]
        way = (self._eye - vertices[ids]).T
        lengths = np.linalg.norm(normals, axis=0) * np.linalg.norm(way, axis=0)
        cosines: FloatArray = (normals * way).sum(axis=0) / np.maximum(lengths, 1e-300)
        return cosines

    def _may_be_seen(self, ids: IntArray) -> BoolArray:
        """Return (k,) which vertices (k,) are no more than a few cells behind what is seen there."""
        x, y, depth = self._seen(self._surface.vertices[ids])
        is_near: BoolArray = depth <= self._nearest[_cells(x, y)] + 6 * SLOPE * depth / CELLS
        return is_near

    def _is_seen(self, vertex: int, outwards: float) -> bool:
        """Return whether no face is before a vertex, and one at it turns its outside to the camera."""
        vertices, faces = self._surface.vertices, self._surface.faces
        # Of all faces only those are looked at through which an upright plane through the eye and the vertex goes.
        across = np.cross(self._frame[:, 1], vertices[vertex] - self._eye)
        aside = (vertices @ across < vertices[vertex] @ across)[faces].sum(axis=1)
        at = np.flatnonzero((faces == vertex).any(axis=1))
        if not (outwards * _facing(self._surface, at, self._eye) > 0).any():
            return False
        some = faces[(aside > 0) & (aside < 3)]
        some = some[(some != vertex).all(axis=1)]
        x, y, depth = self._seen(vertices[vertex][None])[:, 0]
        u, v, depths = self._seen(vertices[some.ravel()]).reshape(3, -1, 3) - [[[x]], [[y]], [[0.0]]]
        weights = np.stack([u[:, k - 2] * v[:, k - 1] - u[:, k - 1] * v[:, k - 2] for k in range(3)], axis=1)
        total = weights.sum(axis=1)
        is_around = ((weights >= 0).all(axis=1) | (weights <= 0).all(axis=1)) & (total != 0)
        # The reciprocal of the depth is linear in the picture.
        there = total[is_around] / (weights[is_around] / depths[is_around]).sum(axis=1)
        return bool((there >= depth * (1 - 1e-6)).all())


def _cells(x: FloatArray, y: FloatArray) -> IntArray:
    """Return (k,) the cell of the picture that places are seen in."""
    column, row = (np.clip((along / SLOPE + 1) / 2 * CELLS, 0, CELLS - 1) for along in (x, y))
    return CELLS * row.astype(np.int64) + column.astype(np.int64)


def _facing(surface: Surface, faces: IntArray, eye: FloatArray) -> FloatArray:
    """Return (k,) positive where faces (k,) turn to a camera the side from which their corners go round to the left."""
    a, b, c = surface.vertices[surface.faces[faces]].transpose(1, 0, 2)
    towards: FloatArray = np.einsum("ij,ij->i", np.cross(b - a, c - a), eye - a)
    return towards
