"""Picking: a ray from a point of the screen, the first face it meets, that face's nearest corner."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray
from bihdist_core.tetrahedra import SolidBoundary

from .clipping import ClipPlane, is_kept
from .face_blocks import FaceBlocks


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
