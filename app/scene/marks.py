"""Marked points of a surface: balls or rings of constant size on the screen, which show on every colour."""

from collections.abc import Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from bihdist_core.arrays import FloatArray

from .style import Colour

DOT = 0.6
"""Of a mark's size: that of a point which an isoline passes through."""

_LIT = "//VTK::Light::Impl"
_RIM = """//VTK::Light::Impl
  fragOutput0.rgb = mix(rimColour, fragOutput0.rgb, smoothstep(0.45, 0.65, normalVCVSOutput.z));
"""
"""A ball is a disc of the shader's: towards its edge the normal turns away from the eye."""

_RING = """//VTK::Light::Impl
  float toEye = normalVCVSOutput.z;
  fragOutput0.rgb = mix(vec3(1.0), rimColour, smoothstep(0.48, 0.62, toEye) - smoothstep(0.83, 0.90, toEye));
"""
"""A dark ring on a white disc, which is its halo, too."""


class Marks:
    """Points in colours of their own, hidden until there are any.

    size: pixels across; rim: its colour, if any; are_rings: in that of the rim, with a white halo.
    """

    def __init__(self, size: float, rim: Colour | None = None, are_rings: bool = False) -> None:
        self.actor, self._size = vtkActor(), size
        self._mapper = vtkPolyDataMapper()
        self._mapper.SetColorModeToDirectScalars()
        self.actor.SetMapper(self._mapper)
        look = self.actor.GetProperty()
        look.SetPointSize(size)
        look.RenderPointsAsSpheresOn()
        look.SetAmbient(0.45)
        look.SetDiffuse(0.6)
        if rim is not None:
            shader = self.actor.GetShaderProperty()
            shader.AddFragmentShaderReplacement(_LIT, False, _RING if are_rings else _RIM, False)
            shader.GetFragmentCustomUniforms().SetUniform3f("rimColour", rim)
        self.actor.VisibilityOff()

    def set_proportion(self, share: float) -> None:
        """Be of this share of the size."""
        self.actor.GetProperty().SetPointSize(self._size * share)

    def show(self, positions: FloatArray, colours: Sequence[Colour] | FloatArray) -> None:
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
        self._mapper.SetInputData(marked)

    def show_one(self, position: FloatArray | None, colour: Colour) -> None:
        """Mark one place (3,), or none."""
        self.show(np.empty((0, 3)) if position is None else position[None], [] if position is None else [colour])
