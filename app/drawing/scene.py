"""Drawing in the window: a surface with a field on it, marks and a colour bar, in a panel's renderer."""

import textwrap
from collections.abc import Sequence

import numpy as np
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkTextActor

from .field_actor import FieldActor, drawable, light
from .insets import Insets
from .marks import Marks
from .style import PAPER, Colour, Style

__all__ = ["PanelScene", "drawable"]


BAR_TOP = 0.14
"""The share of the view, from below, that the colour bar takes."""

BACKING = 0.85
"""Opacity of what is behind the colour bar and its words."""


class PanelScene:
    """One surface with one field in one renderer.  `scale`: device pixels per pixel of the style's widths."""

    def __init__(self, renderer: vtkRenderer, style: Style = PAPER, scale: float = 1.0) -> None:
        self.renderer = renderer
        self.style = style
        self.scale = scale
        self._field = FieldActor(style, scale)
        self._source = Marks(style.marker_size * scale, style.mark_edge)
        self._largest = Marks(0.8 * style.marker_size * scale, style.mark_edge)
        self._pointer = Marks(0.7 * style.marker_size * scale, style.mark_edge)
        self._anchored = Marks(style.marker_size * scale, style.mark_edge)
        solid = [self._field.actor, *(m.actor for m in (self._source, self._largest, self._pointer, self._anchored))]
        self.insets = Insets(renderer, solid, style, scale, BAR_TOP)
        self._bar = _colour_bar(self._field.table, style, scale)
        self._bar.VisibilityOff()
        self._unit = _text(style.quiet_text, 12 * scale)
        self._unit.GetTextProperty().SetVerticalJustificationToBottom()
        self._unit.GetTextProperty().SetBackgroundColor(*style.background)
        self._unit.GetTextProperty().SetBackgroundOpacity(BACKING)
        place = self._unit.GetPositionCoordinate()
        place.SetCoordinateSystemToNormalizedViewport()
        place.SetValue(0.5, 0.008)
        renderer.SetBackground(*style.background)
        # To find out what is out of sight VTK would go over all vertices, and here nothing ever is.
        renderer.GetCullers().RemoveAllItems()
        self._failure = _text(style.text, 13 * scale)
        self._failure.GetTextProperty().SetVerticalJustificationToCentered()
        self._failure.GetTextProperty().SetLineSpacing(1.3)
        self._failure.GetTextProperty().SetBackgroundColor(*style.background)
        self._failure.GetTextProperty().SetBackgroundOpacity(BACKING)
        place = self._failure.GetPositionCoordinate()
        place.SetCoordinateSystemToNormalizedViewport()
        place.SetValue(0.5, 0.5)
        for actor in (*solid, self._bar, self._unit, self._failure):
            renderer.AddActor(actor)
        light(renderer)

    def remove(self) -> None:
        """Leave the renderer to another."""
        self.insets.remove()
        self.renderer.RemoveAllViewProps()

    # ------------------------------------------------------------------ the surface and its field
    def show_surface(self, mesh: vtkPolyData) -> None:
        """Show a surface made by `drawable`, without a field yet."""
        self._field.show_surface(mesh)
        self._bar.VisibilityOff()
        self._unit.SetInput("")
        self._failure.SetInput("")
        self.mark_source(None)
        self.mark_largest(None)
        self.mark_pointer(None)
        self.mark_anchors(np.empty((0, 3)), [])
        self.insets.show((), np.empty((0, 3)))

    def show_shape(self, mesh: vtkPolyData) -> None:
        """The same surface in another shape; its field has to be shown again."""
        self._field.show_surface(mesh)

    def show_field(self, field: np.ndarray, unit: str = "", maximum: float | None = None, signed: bool = False) -> None:
        """Colour the surface by a field (n,), see `FieldActor.show_field`."""
        self._field.show_field(field, maximum, signed)
        self._failure.SetInput("")
        self._bar.VisibilityOn()
        self._label_bar()
        self._unit.SetInput(unit)

    def show_failure(self, words: str) -> None:
        """Show the bare surface, and on it why it has no field; again when the panel has another width."""
        self._field.show_bare()
        self._bar.VisibilityOff()
        self._unit.SetInput("")
        letters = 0.8 * self.renderer.GetSize()[0] / (7 * self.scale)
        self._failure.SetInput(textwrap.fill(words, max(16, int(letters))))

    def show_isolines(self, count: int) -> None:
        """So many equal steps from 0 to the maximum; 0 for no lines."""
        self._field.show_isolines(count)

    # ------------------------------------------------------------------ marks
    def mark_source(self, position: np.ndarray | None) -> None:
        self._source.show_one(position, self.style.source)

    def mark_largest(self, position: np.ndarray | None) -> None:
        """Where a signed field is largest."""
        self._largest.show_one(position, self.style.largest)

    def mark_pointer(self, position: np.ndarray | None) -> None:
        self._pointer.show_one(position, self.style.pointer)

    def mark_anchors(self, positions: np.ndarray, values: Sequence[float]) -> None:
        """Positions (k, 3), each filled with the colour of a value, grey where that is NaN."""
        top, signed = self._field.maximum, self._field.is_signed
        self._anchored.show(positions, [self.style.colour_of(value, top, signed) for value in values])

    # ------------------------------------------------------------------ how it is made
    def _label_bar(self) -> None:
        table = vtkLookupTable()
        table.DeepCopy(self._field.table)
        table.SetRange(-self._field.maximum if self._field.is_signed else 0.0, self._field.maximum)
        table.UseBelowRangeColorOff()
        self._bar.SetLookupTable(table)


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
    # To be read where the surface reaches behind it.
    bar.DrawBackgroundOn()
    bar.GetBackgroundProperty().SetColor(*style.background)
    bar.GetBackgroundProperty().SetOpacity(BACKING)
    text = bar.GetLabelTextProperty()
    text.SetColor(style.text)
    text.SetFontSize(round(12 * scale))
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()
    return bar


def _text(colour: Colour, size: float, bold: bool = False) -> vtkTextActor:
    """A centred line of text; empty at first."""
    actor = vtkTextActor()
    look = actor.GetTextProperty()
    look.SetColor(colour)
    look.SetFontSize(round(size))
    look.SetBold(bold)
    look.SetJustificationToCentered()
    look.SetVerticalJustificationToTop()
    return actor
