"""Clip planes: which half of a surface is left."""

from dataclasses import dataclass

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPlane

from bihdist_core import Surface
from bihdist_core.arrays import BoolArray, FloatArray

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
