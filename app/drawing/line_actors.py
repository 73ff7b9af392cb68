"""How the window draws lines that a source consists of: in its colour with a dark rim, on the surface."""

from collections.abc import Sequence

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from .source_lines import RIM, WIDTH
from .style import Style

_PLACED = "//VTK::PositionVC::Impl"
_NEARER = """//VTK::PositionVC::Impl
  gl_Position.z -= NEARER * gl_Position.w;
"""
NEARER = (0.0012, 0.0014)
"""By which share of all depth lines are drawn before the surface they lie on: below others, and on them."""

_LIT = "//VTK::Light::Impl"
_RIM = """//VTK::Light::Impl
  fragOutput0.rgb = mix(rimColour, ambientColorUniform, smoothstep(0.62, 0.80, lenZ));
"""
"""A tube is a band of the shader's, as high as `lenZ` from its middle to its edges, however the line slants."""


class SourceLineActor:
    """Lines, hidden until there are any, and where the surface is before them.

    scale: device pixels per pixel.
    """

    def __init__(self, style: Style, scale: float) -> None:
        self.actor = line_actor(style.source, (WIDTH + 2 * RIM) * scale, NEARER[1])
        look = self.actor.GetProperty()
        look.RenderLinesAsTubesOn()  # plain lines have no edges, and are thinner the more they slant
        look.LightingOn()  # which has that shader
        shader = self.actor.GetShaderProperty()
        shader.AddFragmentShaderReplacement(_LIT, False, _RIM, False)
        shader.GetFragmentCustomUniforms().SetUniform3f("rimColour", style.mark_edge)

    def show(self, lines: Sequence[tuple[np.ndarray, bool]]) -> None:
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
        self.actor.GetMapper().SetInputData(drawn)


def _without_specks(points: np.ndarray) -> np.ndarray:
    """Points (k, 3) of a line without most of those that are next to another: tubes so short have no direction."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    least = 0.2 * float(np.median(steps)) if len(steps) else 0.0
    far = np.append(True, steps >= least)
    far[-1] = True
    return points[far]


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
