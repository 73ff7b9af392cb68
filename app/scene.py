"""Drawing: a surface with a field on it, isolines, marks and a colour bar, into any VTK renderer.

The window's panels and the headless figures both draw with this.  Isolines are painted by the fragment shader: the
field crosses the surface as a vertex attribute, and a fragment is white where it is within half a line's width of a
multiple of the step, measured in pixels.  Lines so drawn have the same width everywhere and cost no geometry.
"""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkTextActor

from bihdist_core import Surface

from .style import PAPER, Colour, Style

UNDEFINED = -1.0
"""Stands for NaN in the scalars: distances are never negative, and the shader needs a number."""

_DECLARE = "//VTK::PositionVC::Dec"
_PASS_ON = "//VTK::PositionVC::Impl"
_LIT = "//VTK::Light::Impl"
_PAINT = """//VTK::Light::Impl
  float steps = isolineValue / isolineStep;
  float perPixel = fwidth(steps);
  float fromLine = abs(fract(steps - 0.5) - 0.5) / max(perPixel, 1e-12);
  float paint = 1.0 - smoothstep(isolineHalfWidth - 0.6, isolineHalfWidth + 0.6, fromLine);
  paint *= 1.0 - smoothstep(0.25, 0.5, perPixel);  // fade where lines would merge
  paint *= step(0.5, steps);                       // none at the source itself, none where undefined
  fragOutput0.rgb = mix(fragOutput0.rgb, isolineColour, paint);
"""


def drawable(surface: Surface) -> vtkPolyData:
    """The surface with point normals, in the surface's vertex ids.  Safe to call on a background thread."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(surface.vertices, deep=True))
    sides = np.empty((len(surface.faces), 4), np.int64)
    sides[:, 0], sides[:, 1:] = 3, surface.faces
    cells = vtkCellArray()
    cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(sides.ravel(), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.NonManifoldTraversalOff()
    normals.Update()
    mesh.GetPointData().SetNormals(normals.GetOutput().GetPointData().GetNormals())
    mesh.ComputeBounds()
    return mesh


class PanelScene:
    """One surface with one field in one renderer.  `scale`: device pixels per pixel of the style's widths."""

    def __init__(self, renderer: vtkRenderer, style: Style = PAPER, scale: float = 1.0) -> None:
        self.renderer = renderer
        self.style = style
        self.scale = scale
        self._table = _lookup_table(style)
        self._values: np.ndarray | None = None
        self._range = (0.0, 1.0)
        self._isolines = 20
        self._actor = vtkActor()
        self._mapper = vtkPolyDataMapper()
        self._paint_isolines()
        self._actor.VisibilityOff()
        self._source = _mark(renderer, style.source, style.marker_size * scale)
        self._pointer = _mark(renderer, style.pointer, 0.7 * style.marker_size * scale)
        self._bar = _colour_bar(self._table, style, scale)
        self._bar.VisibilityOff()
        self._unit = _text(style.quiet_text, 12 * scale)
        self._unit.GetTextProperty().SetVerticalJustificationToBottom()
        place = self._unit.GetPositionCoordinate()
        place.SetCoordinateSystemToNormalizedViewport()
        place.SetValue(0.5, 0.008)
        self.heading = _text(style.text, 17 * scale, bold=True)
        self.hint = _text(style.quiet_text, 13 * scale)
        renderer.SetBackground(*style.background)
        for actor in (self._actor, self._bar, self._unit, self.heading, self.hint):
            renderer.AddActor(actor)
        _light(renderer)

    # ------------------------------------------------------------------ the surface and its field
    def show_surface(self, mesh: vtkPolyData) -> None:
        """Show a surface made by `drawable`, without a field yet."""
        own = vtkPolyData()
        own.ShallowCopy(mesh)
        self._values = np.full(mesh.GetNumberOfPoints(), UNDEFINED, np.float32)
        self._array = numpy_to_vtk(self._values)
        self._array.SetName("distance")
        own.GetPointData().AddArray(self._array)
        self._mapper.SetInputData(own)
        self._mapper.MapDataArrayToVertexAttribute(
            "isolineAttribute", "distance", vtkDataObject.FIELD_ASSOCIATION_POINTS, -1
        )
        self._actor.VisibilityOn()
        self._bar.VisibilityOff()
        self._unit.SetInput("")
        self.mark_source(None)
        self.mark_pointer(None)

    def show_field(self, field: np.ndarray, unit: str = "", maximum: float | None = None) -> None:
        """Colour the surface by a field (n,), 0 to `maximum` (the field's own if not given); NaN is grey."""
        top = float(np.nanmax(field)) if maximum is None else maximum
        self._values[:] = np.where(np.isnan(field), UNDEFINED, field / top if top > 0 else 0)
        self._array.Modified()
        self._range = (0.0, top)
        self._bar.VisibilityOn()
        self._label_bar()
        self._unit.SetInput(unit)

    def show_isolines(self, count: int) -> None:
        """So many equal steps from 0 to the maximum; 0 for no lines."""
        self._isolines = count
        self._uniforms.SetUniformf("isolineStep", 1 / count if count else 1e9)

    def set_scale(self, scale: float) -> None:
        """Device pixels per pixel have changed."""
        self.scale = scale
        self._uniforms.SetUniformf("isolineHalfWidth", self.style.isoline_width / 2 * scale)

    def write_heading(self, heading: str, hint: str = "") -> None:
        """Name the panel, at its top; the window has its own headings."""
        self.heading.SetInput(heading)
        self.hint.SetInput(hint)
        width, height = self.renderer.GetSize()
        self.heading.SetPosition(width / 2, height - 10 * self.scale)
        self.hint.SetPosition(width / 2, height - 34 * self.scale)

    # ------------------------------------------------------------------ marks
    def mark_source(self, position: np.ndarray | None) -> None:
        _move(self._source, position)

    def mark_pointer(self, position: np.ndarray | None) -> None:
        _move(self._pointer, position)

    # ------------------------------------------------------------------ how it is made
    def _paint_isolines(self) -> None:
        mapper, actor = self._mapper, self._actor
        mapper.SetLookupTable(self._table)
        mapper.UseLookupTableScalarRangeOn()
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("distance")
        # Colours are looked up per pixel, not blended between the vertices' colours.
        mapper.InterpolateScalarsBeforeMappingOn()
        actor.SetMapper(mapper)
        surface = actor.GetProperty()
        surface.SetInterpolationToGouraud()
        surface.SetAmbient(0.26)
        surface.SetDiffuse(0.80)
        surface.SetSpecular(0.06)
        surface.SetSpecularPower(20)
        shader = actor.GetShaderProperty()
        shader.AddVertexShaderReplacement(
            _DECLARE, True, f"{_DECLARE}\nin float isolineAttribute;\nout float isolineValue;\n", False
        )
        shader.AddVertexShaderReplacement(_PASS_ON, True, f"{_PASS_ON}\nisolineValue = isolineAttribute;\n", False)
        shader.AddFragmentShaderReplacement(_DECLARE, True, f"{_DECLARE}\nin float isolineValue;\n", False)
        shader.AddFragmentShaderReplacement(_LIT, False, _PAINT, False)
        self._uniforms = shader.GetFragmentCustomUniforms()
        self._uniforms.SetUniform3f("isolineColour", self.style.isoline)
        self.show_isolines(self._isolines)
        self.set_scale(self.scale)

    def _label_bar(self) -> None:
        table = vtkLookupTable()
        table.DeepCopy(self._table)
        table.SetRange(*self._range)
        table.UseBelowRangeColorOff()
        self._bar.SetLookupTable(table)


def _lookup_table(style: Style) -> vtkLookupTable:
    colours = style.colours()
    table = vtkLookupTable()
    table.SetNumberOfTableValues(len(colours))
    for k, colour in enumerate(colours):
        table.SetTableValue(k, *colour, 1)
    table.SetRange(0, 1)
    table.SetBelowRangeColor(*style.undefined, 1)
    table.UseBelowRangeColorOn()
    return table


def _mark(renderer: vtkRenderer, colour: Colour, size: float) -> vtkActor:
    """A ball of constant size on the screen, hidden until moved somewhere."""
    actor = vtkActor()
    actor.SetMapper(vtkPolyDataMapper())
    look = actor.GetProperty()
    look.SetColor(colour)
    look.SetPointSize(size)
    look.RenderPointsAsSpheresOn()
    look.SetAmbient(0.45)
    look.SetDiffuse(0.6)
    actor.VisibilityOff()
    renderer.AddActor(actor)
    return actor


def _move(mark: vtkActor, position: np.ndarray | None) -> None:
    mark.SetVisibility(position is not None)
    if position is not None:
        points, cells, point = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.InsertNextPoint(*position)
        cells.InsertNextCell(1, [0])
        point.SetPoints(points)
        point.SetVerts(cells)
        mark.GetMapper().SetInputData(point)


def _colour_bar(table: vtkLookupTable, style: Style, scale: float) -> vtkScalarBarActor:
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetOrientationToHorizontal()
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("{:.3g}")
    bar.SetMaximumNumberOfColors(256)
    bar.UnconstrainedFontSizeOn()
    bar.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    bar.SetPosition(0.2, 0.04)
    bar.SetWidth(0.6)
    bar.SetHeight(0.075)
    bar.SetBarRatio(0.3)
    bar.DrawTickLabelsOn()
    text = bar.GetLabelTextProperty()
    text.SetColor(style.text)
    text.SetFontSize(round(12 * scale))
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()
    return bar


def _text(colour: Colour, size: float, bold: bool = False) -> vtkTextActor:
    """A line of text centred at the top of the panel; empty at first."""
    actor = vtkTextActor()
    look = actor.GetTextProperty()
    look.SetColor(colour)
    look.SetFontSize(round(size))
    look.SetBold(bold)
    look.SetJustificationToCentered()
    look.SetVerticalJustificationToTop()
    return actor


def _light(renderer: vtkRenderer) -> None:
    """A key light from the upper left of the camera and a weak fill, so that form reads without dark sides."""
    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    for position, intensity in [((-0.5, 0.6, 1.0), 0.85), ((0.8, -0.2, 0.7), 0.42)]:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(*position)
        light.SetFocalPoint(0, 0, 0)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
