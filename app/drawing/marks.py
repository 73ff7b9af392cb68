"""Marked points of a surface: balls of constant size on the screen, with a dark rim that shows on every colour."""

from collections.abc import Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from .style import Colour

DOT = 0.6
"""Of a mark's size: that of a point which an isoline passes through."""

_LIT = "//VTK::Light::Impl"
_RIM = """//VTK::Light::Impl
  fragOutput0.rgb = mix(rimColour, fragOutput0.rgb, smoothstep(0.45, 0.65, normalVCVSOutput.z));
"""
"""A ball is a disc of the shader's: towards its edge the normal turns away from the eye."""


class Marks:
    """Points in colours of their own, hidden until there are any.  size: pixels across; rim: its colour, if any."""

    def __init__(self, size: float, rim: Colour | None = None) -> None:
        self.actor = vtkActor()
        mapper = vtkPolyDataMapper()
        mapper.SetColorModeToDirectScalars()
        self.actor.SetMapper(mapper)
        look = self.actor.GetProperty()
        look.SetPointSize(size)
        look.RenderPointsAsSpheresOn()
        look.SetAmbient(0.45)
        look.SetDiffuse(0.6)
        if rim is not None:
            shader = self.actor.GetShaderProperty()
            shader.AddFragmentShaderReplacement(_LIT, False, _RIM, False)
            shader.GetFragmentCustomUniforms().SetUniform3f("rimColour", rim)
        self.actor.VisibilityOff()

    def show(self, positions: np.ndarray, colours: Sequence[Colour] | np.ndarray) -> None:
        """Mark these positions (k, 3), each in a colour."""
        self.actor.SetVisibility(len(positions) > 0)
        if not len(positions):
            return
        points, cells, marked = vtkPoints(), vtkCellArray(), vtkPolyData()
        for number, position in enumerate(positions):
            points.InsertNextPoint(*position)
            cells.InsertNextCell(1, [number])
        marked.SetPoints(points)
        marked.SetVerts(cells)
        shades = np.round(255 * np.asarray(colours, float).reshape(-1, 3)).astype(np.uint8)
        marked.GetPointData().SetScalars(numpy_to_vtk(shades, deep=True))
        self.actor.GetMapper().SetInputData(marked)

    def show_one(self, position: np.ndarray | None, colour: Colour) -> None:
        """Mark one place (3,), or none."""
        self.show(np.empty((0, 3)) if position is None else position[None], [] if position is None else [colour])
