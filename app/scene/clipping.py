"""Clip planes: which half of a surface is left, and the cut through a solid."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPlane

from bihdist_core import Surface
from bihdist_core.arrays import BoolArray, FloatArray, IntArray
from bihdist_core.tetrahedra import SolidBoundary

from ..document.looks import Clip


@dataclass(frozen=True)
class ClipPlane:
    """The plane of a clip of one surface.

    Attributes
    ----------
    normal
        Of length 1, towards what is cut away.
    offset
        The plane's distance from the origin along it.
    """

    normal: tuple[float, float, float]
    offset: float

    def depths(self, points: FloatArray) -> FloatArray:
        """Return how far points (n, 3) are from the plane, (n,); negative where they are cut away."""
        depths: FloatArray = self.offset - points @ np.array(self.normal)
        return depths

    def segment(self, start: FloatArray, end: FloatArray) -> tuple[FloatArray, FloatArray] | None:
        """Return the ends (3,) of what is left of a segment; None for nothing."""
        a, b = self.depths(np.stack([start, end])).tolist()
        if a < 0 and b < 0:
            return None
        cut = start + a / (a - b) * (end - start) if (a < 0) != (b < 0) else start
        return cut if a < 0 else start, cut if b < 0 else end

    @property
    def for_vtk(self) -> vtkPlane:
        """The plane for a mapper, which draws what its normal points to."""
        plane = vtkPlane()
        plane.SetNormal(*(-part for part in self.normal))
        plane.SetOrigin(*(self.offset * part for part in self.normal))
        return plane


def clip_plane(clip: Clip | None, surface: Surface) -> ClipPlane | None:
    """Return the plane of a clip of a surface; None for no clip."""
    if clip is None:
        return None
    largest = max(map(abs, clip.normal))
    x, y, z = (part / largest for part in clip.normal)
    length = float(np.sqrt(x * x + y * y + z * z))
    normal = x / length, y / length, z / length
    along = surface.vertices[surface.component_of_vertex >= 0] @ np.array(normal)
    low, high = float(along.min()), float(along.max())
    return ClipPlane(normal, low + clip.kept * (high - low))


def is_kept(plane: ClipPlane | None, points: FloatArray) -> BoolArray:
    """Return whether points (n, 3) are left, (n,)."""
    return np.ones(len(points), bool) if plane is None else plane.depths(points) >= 0


def lines_cut_away(plane: ClipPlane | None, lines: Iterable[tuple[str, FloatArray]]) -> list[str]:
    """Return the names of lines, points (k, 3) each, of which nothing is left; "" names none."""
    left: dict[str, bool] = {}
    for name, points in lines:
        left[name] = left.get(name, False) or bool(is_kept(plane, points).any())
    return [name for name, is_left in left.items() if name and not is_left]


INWARDS = 1e-4
"""By this share of the extent a cut lies within what is left, so that it is not clipped itself."""


@dataclass(frozen=True, eq=False)
class Cut:
    """Where a plane cuts tetrahedra.

    Attributes
    ----------
    points, ends, weights
        (k, 3) places on edges, the vertices (k, 2) of these, and the weight (k,) of the second.
    faces
        (m, 3) triangles between them, whose normals point to what is cut away.
    normal
        (3,) that of all of them.
    """

    points: FloatArray
    ends: IntArray
    weights: FloatArray
    faces: IntArray
    normal: FloatArray

    def at_points(self, values: FloatArray, undefined: float) -> FloatArray:
        """Return a field (n,) at the points (k,)."""
        a, b = values[self.ends].T
        between: FloatArray = np.where((a == undefined) | (b == undefined), undefined, a + self.weights * (b - a))
        return between


def cut_through(surface: Surface, plane: ClipPlane | None) -> Cut | None:
    """Return where a plane cuts the solid that a surface bounds; None for no plane, or a surface of no solid."""
    if plane is None or not isinstance(surface, SolidBoundary):
        return None
    depths, x, normal = plane.depths(surface.vertices), surface.vertices, np.array(plane.normal)
    is_left = depths >= 0
    cells = surface.tetrahedra[is_left[surface.tetrahedra].any(axis=1) & ~is_left[surface.tetrahedra].all(axis=1)]
    # Corners that are left come first.
    cells = np.take_along_axis(cells, np.argsort(~is_left[cells], axis=1, kind="stable"), axis=1)
    count = is_left[cells].sum(axis=1)
    ways = {1: ((0, 1), (0, 2), (0, 3)), 3: ((0, 3), (1, 3), (2, 3)), 2: ((0, 2), (0, 3), (1, 3), (1, 2))}
    corners = []
    for some, way in ways.items():
        around = cells[count == some][:, way]
        corners += [around[:, [0, k, k + 1]] for k in range(1, len(way) - 1)]
    pairs = np.concatenate(corners).reshape(-1, 2)
    ends, number = np.unique(pairs, axis=0, return_inverse=True)
    a, b = depths[ends].T
    weights = a / (a - b)
    points = x[ends[:, 0]] + weights[:, None] * (x[ends[:, 1]] - x[ends[:, 0]])
    faces = number.reshape(-1, 3)
    p, q, r = (points[faces[:, k]] for k in range(3))
    turned = np.cross(q - p, r - p) @ normal < 0
    faces[turned] = faces[turned][:, ::-1]
    return Cut(points - INWARDS * float(np.ptp(x, axis=0).max()) * normal, ends, weights, faces, normal)
