"""Picking: a ray from a point of the screen, the first face it meets, found in blocks of faces, and its corner."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from bihdist_core import Surface
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.tetrahedra import SolidBoundary

from .clipping import ClipPlane, is_kept

BLOCK = 128
"""Faces in a block: looking at all boxes of a million faces then costs about as much as looking into those that a
way passes through, some twenty."""
CELL_BITS = 10
"""The longest side of the surface is divided into two to this power cells; neighbours are sorted by cell."""
BLOCKS_AT_ONCE = 128
"""So that the temporary arrays stay in the processor's cache."""
SLACK = 1e-13
"""Share of the largest coordinate by which boxes are widened: some hundred times the rounding."""


class FaceBlocks:
    """The blocks of a surface's faces; made once, asked often (a millisecond or two on a million faces)."""

    def __init__(self, surface: Surface) -> None:
        self._faces = surface.faces
        self._x = np.ascontiguousarray(surface.vertices.T)
        order = _along_a_curve(self._x, surface.faces)
        # The last block is filled up with copies of one face.
        self._blocks = np.append(order, np.repeat(order[-1], -len(order) % BLOCK)).reshape(-1, BLOCK)
        self._centres, self._halves = self._boxes()
        self._largest = float(np.abs(self._centres).max() + self._halves.max())

    def first_hit(self, start: FloatArray, end: FloatArray) -> tuple[int, FloatArray, FloatArray] | None:
        """Return the first face on the way from start (3,) to end (3,), the weights (3,) of its corners, and the place.

        None if there is none.  No way slips through between two faces with a common edge, as both decide by the same
        numbers.
        Faces seen edge-on are not met.
        """
        length = float(np.linalg.norm(end - start))
        if length == 0:
            return None
        along = (end - start) / length
        across = _across(along)
        slack = SLACK * (self._largest + np.abs(start).max())
        offset = across @ (self._centres - start[:, None])
        near = (np.abs(offset) <= np.abs(across) @ self._halves + slack).all(axis=0)
        faces = self._blocks[near].ravel()
        corners = self._faces[faces].T
        local = self._x[:, corners] - start[:, None, None]
        # In the plane across the way, which is the origin there.  Written out, so that a vertex is rounded alike in
        # all its faces.
        p, q, depth = (a[0] * local[0] + a[1] * local[1] + a[2] * local[2] for a in (*across, along))
        sides = np.stack([p[i] * q[j] - q[i] * p[j] for i, j in ((1, 2), (2, 0), (0, 1))])
        total = sides.sum(axis=0)
        inside = np.flatnonzero(((sides >= 0).all(axis=0) | (sides <= 0).all(axis=0)) & (total != 0))
        weights = sides[:, inside] / total[inside]
        depth = (weights * depth[:, inside]).sum(axis=0)
        reached = np.flatnonzero((depth >= 0) & (depth <= length))
        if not len(reached):
            return None
        first = reached[depth[reached].argmin()]
        face = int(faces[inside[first]])
        return face, weights[:, first], self._x[:, self._faces[face]] @ weights[:, first]

    def sees(self, eye: FloatArray, point: FloatArray, slack: float) -> bool:
        """Return whether an eye (3,) sees a point (3,) of the surface; faces within `slack` of that hide nothing."""
        hit = self.first_hit(eye, point)
        return hit is None or bool(np.linalg.norm(hit[2] - point) <= slack)

    def _boxes(self) -> tuple[FloatArray, FloatArray]:
        """Return the centres (3, b) of the blocks' boxes, and halves (3, b) of their sides."""
        low, high = np.empty((3, len(self._blocks))), np.empty((3, len(self._blocks)))
        for begin in range(0, len(self._blocks), BLOCKS_AT_ONCE):
            part = slice(begin, begin + BLOCKS_AT_ONCE)
            corners = self._faces[self._blocks[part]].reshape(-1, 3 * BLOCK)
            for axis in range(3):
                x = self._x[axis].take(corners)
                low[axis, part], high[axis, part] = x.min(axis=1), x.max(axis=1)
        return (low + high) / 2, (high - low) / 2


def _along_a_curve(x: FloatArray, faces: IntArray) -> IntArray:
    """Return the faces (m,) in the order of their first corners' cells along Morton's curve; x is (3, n)."""
    first = x.take(faces[:, 0], axis=1)
    low = first.min(axis=1)
    longest = float((first.max(axis=1) - low).max()) or 1.0
    last = (1 << CELL_BITS) - 1
    cells = [((x - start) / longest * last).astype(np.int64) for x, start in zip(first, low, strict=True)]
    # Sorting whole numbers that end in the face is several times faster than sorting places.
    bits = 63 - 3 * CELL_BITS
    key = z_order(cells, CELL_BITS).astype(np.int64) << bits | np.arange(len(faces))
    key.sort()
    return key & ((1 << bits) - 1)


def _across(along: FloatArray) -> FloatArray:
    """Return two unit vectors (2, 3) at right angles to a unit vector (3,) and to each other."""
    axis = np.zeros(3)
    axis[np.abs(along).argmin()] = 1
    first = np.cross(along, axis)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(along, first)])


def z_order(cells: Sequence[AnyArray], bits: int) -> AnyArray:
    """Return the numbers (n,) of cells along Morton's curve, in the smallest type that holds them.

    The cells have a whole number (n,) from 0 to 2 ** bits - 1 on each axis.
    """
    count = len(cells)
    dtype = np.min_scalar_type((1 << count * bits) - 1)
    cell = np.arange(1 << bits)
    spread = np.sum([(cell >> bit & 1) << count * bit for bit in range(bits)], axis=0).astype(dtype)
    codes: AnyArray = np.bitwise_or.reduce(
        [spread.take(of_axis) << dtype.type(axis) for axis, of_axis in enumerate(cells)]
    )
    return codes


@dataclass(frozen=True, eq=False)
class Hit:
    """The place where a ray first meets a surface.

    Attributes
    ----------
    weights
        (3,) barycentric weights of the face's corners.
    position
        (3,) the place.
    vertex
        The corner nearest to it.
    """

    face: int
    weights: FloatArray
    position: FloatArray
    vertex: int


class Picker:
    """Finds what is under a point of the screen; a pick takes about a millisecond.

    Where a surface is of points, it finds the nearest of these.
    """

    def __init__(self, surface: Surface) -> None:
        self._surface, self._is_of_points = surface.shape, surface.shape is not surface

    @cached_property
    def blocks(self) -> FaceBlocks:
        """The faces in blocks, made when they are first asked for, on any thread."""
        return FaceBlocks(self._surface)

    def pick(self, renderer: vtkRenderer, x: float, y: float, clip: ClipPlane | None = None) -> Hit | None:
        """Return the hit on what is left of the surface at device pixel (x, y), y up; None beside it.

        The corner is one that is left, too, if there is any.
        """
        ends = _ray(renderer, x, y, clip)
        hit = None if ends is None else self.blocks.first_hit(*ends)
        if ends is None or hit is None or self._is_behind_cut(hit[0], ends, clip):
            return None
        face, weights, position = hit
        ids = self._surface.faces[face]
        corners = self._surface.vertices[ids]
        away = np.linalg.norm(corners - position, axis=1)
        nearest = np.lexsort((away, ~is_kept(clip, corners)))[0]
        if self._is_of_points:
            weights, position = np.eye(3)[nearest], corners[nearest]
        return Hit(face, weights, position, int(ids[nearest]))

    def sees(self, renderer: vtkRenderer, point: FloatArray, clip: ClipPlane | None = None) -> bool:
        """Return whether nothing but faces about it stands before a point (3,) of the surface that is left."""
        if not is_kept(clip, point[None])[0]:
            return False
        ends = _ray(renderer, *pixel_of(renderer, point), clip)
        hit = None if ends is None or clip is None else self.blocks.first_hit(*ends)
        if ends is not None and hit is not None and self._is_behind_cut(hit[0], ends, clip):
            return False
        return ends is None or self.blocks.sees(ends[0], point, 2 * self._surface.mean_edge_length)

    def _is_behind_cut(self, face: int, ends: tuple[FloatArray, FloatArray], clip: ClipPlane | None) -> bool:
        """Return whether the first face on a line of sight is seen from within a solid, which its cut hides."""
        if clip is None or not isinstance(self._surface, SolidBoundary):
            return False
        a, b, c = self._surface.vertices[self._surface.faces[face]]
        return bool(np.cross(b - a, c - a) @ (ends[1] - ends[0]) > 0)


def pixel_of(renderer: vtkRenderer, point: FloatArray) -> tuple[float, float]:
    """Return the device pixel of a point (3,), y up."""
    renderer.SetWorldPoint([*point, 1.0])
    renderer.WorldToDisplay()
    x, y, _ = renderer.GetDisplayPoint()
    return x, y


def _ray(
    renderer: vtkRenderer, x: float, y: float, clip: ClipPlane | None = None
) -> tuple[FloatArray, FloatArray] | None:
    """Return the ends (3,) of the line of sight through a device pixel, the near one first; None if there is none.

    Of one that a plane clips they are those of what is left.
    """
    ends = []
    for depth in (0.0, 1.0):
        renderer.SetDisplayPoint(x, y, depth)
        renderer.DisplayToWorld()
        *point, weight = renderer.GetWorldPoint()
        if weight == 0:
            return None
        ends.append(np.array(point) / weight)
    return (ends[0], ends[1]) if clip is None else clip.segment(ends[0], ends[1])
