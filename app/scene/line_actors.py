"""How the window draws lines on the surface, such as a source consists of: in a colour, with a rim."""

from collections.abc import Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from bihdist_core.arrays import FloatArray

from ..marks.line_looks import LineLook
from .style import Style

_PLACED = "//VTK::PositionVC::Impl"
_NEARER = """//VTK::PositionVC::Impl
  gl_Position.z -= NEARER * gl_Position.w;
"""
NEARER = 0.0014
"""By which share of all depth lines are drawn before the surface they lie on."""

LOWER = 0.0001
"""Of all depth, for each rank."""

SOFT = 0.16
"""Of the height of the band, from the rim to the line."""

_LIT = "//VTK::Light::Impl"
_RIM = """//VTK::Light::Impl
  fragOutput0.rgb = mix(rimColour, ambientColorUniform, smoothstep(FROM, TO, lenZ));
"""
"""A tube is a band of the shader's, as high as `lenZ` from its middle to its edges, however the line slants."""


class RimmedLines:
    """Lines of a look with two strokes, hidden until there are any, and where the surface is before them.

    scale: device pixels per pixel.
    """

    def __init__(self, look: LineLook, style: Style, scale: float) -> None:
        rim, line = look.strokes
        self._width = rim.width * scale
        # Of a lower rank they are drawn under others.
        self.actor = line_actor(style.named(line.colour), self._width, NEARER - LOWER * (2 - look.rank))
        drawn = self.actor.GetProperty()
        drawn.RenderLinesAsTubesOn()  # plain lines have no edges, and are thinner the more they slant
        drawn.LightingOn()  # which has that shader
        edge = float(np.sqrt(1 - (line.width / rim.width) ** 2))
        rimmed = _RIM.replace("FROM", f"{edge - SOFT:.4f}").replace("TO", f"{edge:.4f}")
        shader = self.actor.GetShaderProperty()
        shader.AddFragmentShaderReplacement(_LIT, False, rimmed, False)
        shader.GetFragmentCustomUniforms().SetUniform3f("rimColour", style.named(rim.colour))

    def set_proportion(self, share: float) -> None:
        """Be of this share of the width."""
        self.actor.GetProperty().SetLineWidth(self._width * share)

    def show(self, lines: Sequence[tuple[FloatArray, bool]]) -> None:
        """Points (k, 3) of each, and whether the last joins the first."""
        self.actor.SetVisibility(len(lines) > 0)
        if not lines:
            return
        lines = [(_without_specks(at), is_closed) for at, is_closed in lines]
        drawn, cells, points, count = vtkPolyData(), vtkCellArray(), vtkPoints(), 0
        points.SetData(numpy_to_vtk(np.concatenate([at for at, _ in lines]).astype(float), deep=True))
        for at, is_closed in lines:
            ids = [*range(count, count + len(at)), *([count] if is_closed else [])]
            cells.InsertNextCell(len(ids), ids)
            count += len(at)
        drawn.SetPoints(points)
        drawn.SetLines(cells)
        self.actor.GetMapper().SetInputData(drawn)  # type: ignore[attr-defined]  # it is a vtkPolyDataMapper


def _without_specks(points: FloatArray) -> FloatArray:
    """Points (k, 3) of a line without most of those that are next to another: tubes so short have no direction."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    least = 0.2 * float(np.median(steps)) if len(steps) else 0.0
    far = np.append(True, steps >= least)
    far[-1] = True
    kept: FloatArray = points[far]
    return kept


def line_actor(colour: Sequence[float], width: float, nearer: float) -> vtkActor:
    """For lines of a colour, so many device pixels wide, hidden at first; nearer: see NEARER."""
    actor, mapper = vtkActor(), vtkPolyDataMapper()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*colour)
    look.SetLineWidth(width)
    look.LightingOff()
    shader = actor.GetShaderProperty()
    shader.AddVertexShaderReplacement(_PLACED, True, _NEARER.replace("NEARER", str(nearer)), False)
    actor.VisibilityOff()
    return actor
