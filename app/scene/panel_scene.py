"""Drawing in the window: a surface with a field on it, by a panel's plotter."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkBoundingBox, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkRenderer

from bihdist_core.arrays import ByteArray, FloatArray

from ..document.looks import Isolines, Shading
from .field_actor import FieldActor, light
from .insets import Insets
from .levels import Levels
from .stand_in import StandIn
from .style import PAPER, Style

if TYPE_CHECKING:
    from .panel_plotter import PanelPlotter


class PanelScene:
    """One surface with one field in the renderer of one plotter.

    scale: device pixels per pixel of the style's widths.  bounds: (x, x, y, y, z, z) of the surface.
    """

    def __init__(self, plotter: "PanelPlotter", style: Style = PAPER, scale: float = 1.0) -> None:
        self.plotter = plotter
        self.renderer: vtkRenderer = plotter.renderer
        self.style = style
        self.scale = scale
        self.bounds: Sequence[float] = (0.0, 1.0, 0.0, 1.0, 0.0, 1.0)
        self.seconds = 0.0  # that the last picture of all of it took
        self._field = FieldActor(style, scale)
        solid = [self._field.actor, self._field.stand_in.actor]
        self._proportion = 1.0
        self.insets = Insets(plotter, solid, self._field, style, scale)
        self.renderer.SetBackground(*style.background)
        plotter.add_own(*solid)
        light(self.renderer)

    @property
    def whole_bounds(self) -> Sequence[float]:
        """(x, x, y, y, z, z) of the surface and of what others have added."""
        box, bounds = vtkBoundingBox(), [0.0] * 6
        box.AddBounds(self.bounds)
        for actor in self.plotter.added:
            box.AddBounds(actor.GetBounds())
        box.GetBounds(bounds)
        return bounds

    @property
    def renderers(self) -> list[vtkRenderer]:
        """The panel's own first, then those of the insets."""
        return [self.renderer, *self.insets.renderers]

    def set_proportion(self, share: float) -> None:
        """Let isolines be of this share of their usual width, see `proportion`."""
        if share != self._proportion:
            self._proportion = share
            self._field.set_scale(self.scale, share)
            self.insets.set_proportion(share)

    def remove(self) -> None:
        """Leave the plotter to another."""
        self.insets.remove()
        self.plotter.remove_own()

    # ------------------------------------------------------------------ the surface and its field
    def show_surface(self, mesh: vtkPolyData, bounds: Sequence[float]) -> None:
        """Show a surface made by `drawable`, without a field yet."""
        self.show_shape(mesh, bounds)
        self._field.show_selected(None)
        self.insets.show((), np.empty((0, 3)))

    def show_shape(self, mesh: vtkPolyData, bounds: Sequence[float]) -> None:
        """The same surface in another shape; its field has to be shown again."""
        self._field.show_surface(mesh)
        self.bounds = bounds

    def show_normals(self, mesh: vtkPolyData) -> None:
        """The same surface and shape with other normals; the field stays."""
        self._field.show_normals(mesh)

    def show_shading(self, shading: Shading) -> None:
        """Whether faces are flat and edges drawn."""
        self._field.show_shading(shading)

    def take_stand_in(self, stand_in: StandIn | None) -> None:
        """What may be drawn instead while the camera moves; after each change of the surface or its normals."""
        self._field.stand_in.take(stand_in)

    def show_stand_in(self, is_shown: bool) -> None:
        """Draw what stands in, if there is anything, or the surface itself again."""
        self._field.show_stand_in(is_shown)

    @property
    def can_stand_in(self) -> bool:
        """Whether a coarser surface can be drawn while the camera moves."""
        return self._field.stand_in.can_stand_in

    @property
    def is_stand_in(self) -> bool:
        """Whether the next picture is of what stands in."""
        return bool(self._field.stand_in.actor.GetVisibility())

    def show_field(
        self, field: FloatArray, maximum: float | None = None, signed: bool = False, has_lines: bool = True
    ) -> None:
        """Colour the surface by a field (n,), see `FieldActor.show_field`."""
        self._field.show_field(field, maximum, signed, has_lines)

    def show_selected(self, colours: ByteArray | None) -> None:
        """Vertices that stand out, see `selected_colours`."""
        self._field.show_selected(colours)

    def show_colours(self, colours: FloatArray) -> None:
        """Colours (n, 3) of its own instead of a field, see `FieldActor.show_colours`."""
        self._field.show_colours(colours)

    def show_bare(self, is_plain: bool = False) -> None:
        """The surface without a field, see `FieldActor.show_bare`."""
        self._field.show_bare(is_plain)

    def show_isolines(self, isolines: Isolines, through: tuple[float, ...] = ()) -> None:
        """These, and one of each value `through`."""
        self._field.show_isolines(isolines, through)

    def show_bands(self, edges: FloatArray) -> None:
        """Where bands end, see `FieldActor.show_bands`."""
        self._field.show_bands(edges)

    @property
    def levels(self) -> Levels:
        """The values that have a line, and how."""
        return self._field.levels

    @property
    def wanted_isolines(self) -> Isolines:
        """What says where isolines are."""
        return self._field.isolines

    @property
    def isolines(self) -> FloatArray:
        """(k,) those values."""
        return self.levels.values

    @property
    def too_many(self) -> str:
        """See `FieldActor.too_many`."""
        return self._field.too_many

    @property
    def mesh(self) -> vtkPolyData:
        """What is drawn."""
        return self._field.mesh

    @property
    def maximum(self) -> float:
        """Where the colours end."""
        return self._field.maximum
