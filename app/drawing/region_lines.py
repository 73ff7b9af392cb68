"""Boundaries of regions on a surface: dark lines with a light rim, which show on every colour, hidden by what is before
them."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from .line_actors import NEARER, line_actor
from .style import Colour

WIDTH, RIM = 2.0, 4.5
"""Pixels, at scale 1, of the lines, and of them with their rims."""


class RegionLines:
    """Segments, hidden until there are any.  Two actors: the rims are painted first."""

    def __init__(self, scale: float, line: Colour, rim: Colour) -> None:
        self._lines = vtkPolyData()
        self.actors = (line_actor(rim, RIM * scale, NEARER[0]), line_actor(line, WIDTH * scale, NEARER[1]))
        for actor in self.actors:
            actor.GetMapper().SetInputData(self._lines)
            actor.VisibilityOff()

    def show(self, segments: np.ndarray) -> None:
        """These segments (s, 2, 3)."""
        count = len(segments)
        for actor in self.actors:
            actor.SetVisibility(count > 0)
        if not count:
            return
        points, cells = vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(np.ascontiguousarray(segments.reshape(-1, 3)), deep=True))
        cells.SetData(2, numpy_to_vtkIdTypeArray(np.arange(2 * count, dtype=np.int64), deep=True))
        self._lines.SetPoints(points)
        self._lines.SetLines(cells)
        self._lines.Modified()
