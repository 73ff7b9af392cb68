"""From a point of the screen to a vertex: a ray, the first face it meets, that face's nearest corner."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from vtkmodules.vtkRenderingCore import vtkRenderer

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray

from .face_blocks import FaceBlocks


@dataclass(frozen=True, eq=False)
class Hit:
    """Where a ray first meets a surface.

    position: (3,) in a face; weights: (3,) of its corners there, which add up to 1; vertex: the corner nearest to it.
    """

    face: int
    weights: FloatArray
    position: FloatArray
    vertex: int


class Picker:
    """Made once for a surface, on any thread; a pick takes about a millisecond."""

    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._blocks = FaceBlocks(surface)

    def pick(self, renderer: vtkRenderer, x: float, y: float) -> Hit | None:
        """Where the surface is met at device pixel (x, y), y up; None beside the surface."""
        hit = self._first_hit(renderer, x, y)
        if hit is None:
            return None
        face, weights, position = hit
        ids = self._surface.faces[face]
        nearest = np.linalg.norm(self._surface.vertices[ids] - position, axis=1).argmin()
        return Hit(face, weights, position, int(ids[nearest]))

    def sees(self, renderer: vtkRenderer, point: FloatArray) -> bool:
        """Whether nothing but faces about it stands before a point (3,) of the surface."""
        hit = self._first_hit(renderer, *pixel_of(renderer, point))
        if hit is None:
            return True  # at a silhouette the way may pass it by
        camera = renderer.GetActiveCamera()
        eye = np.array(camera.GetPosition())
        nearer = np.linalg.norm(point - eye) - np.linalg.norm(hit[2] - eye)
        if camera.GetParallelProjection():
            nearer = (point - hit[2]) @ np.array(camera.GetDirectionOfProjection())
        return bool(nearer <= 2 * self._surface.mean_edge_length)

    def _first_hit(self, renderer: vtkRenderer, x: float, y: float) -> tuple[int, FloatArray, FloatArray] | None:
        ends = []
        for depth in (0.0, 1.0):
            renderer.SetDisplayPoint(x, y, depth)
            renderer.DisplayToWorld()
            *point, weight = renderer.GetWorldPoint()
            if weight == 0:
                return None
            ends.append(np.array(point) / weight)
        return self._blocks.first_hit(*ends)


class LatePicker:
    """A picker that is made when it is needed."""

    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._made: Picker | None = None

    @property
    def _picker(self) -> Picker:
        if self._made is None:
            self._made = Picker(self._surface)
        return self._made

    def pick(self, *where: Any) -> Hit | None:
        """What `Picker.pick` finds, once the picker has been built."""
        return self._picker.pick(*where)

    def sees(self, *where: Any) -> bool:
        """What `Picker.sees` finds, once the picker has been built."""
        return self._picker.sees(*where)


def pixel_of(renderer: vtkRenderer, point: FloatArray) -> tuple[float, float]:
    """Where a point (3,) is drawn: device pixels, y up."""
    renderer.SetWorldPoint([*point, 1.0])
    renderer.WorldToDisplay()
    x, y, _ = renderer.GetDisplayPoint()
    return x, y
