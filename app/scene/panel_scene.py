"""Drawing in the window: a surface with a field on it, by a panel's plotter."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkBoundingBox, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkRenderer

from .field_actor import FieldActor, light
from .insets import Insets
from .style import PAPER, Style

if TYPE_CHECKING:
    from .panel_plotter import PanelPlotter


class PanelScene:
    """One surface with one field in the renderer of one plotter.

    `field_actor` draws the surface; `scale` is device pixels per pixel of the style's widths, and `bounds` are
    (x, x, y, y, z, z) of the surface.
    """

    def __init__(self, plotter: "PanelPlotter", style: Style = PAPER, scale: float = 1.0) -> None:
        self.plotter = plotter
        self.renderer: vtkRenderer = plotter.renderer
        self.style = style
        self.scale = scale
        self.bounds: Sequence[float] = (0.0, 1.0, 0.0, 1.0, 0.0, 1.0)
        self.seconds = 0.0  # that the last picture of all of it took
        self.field_actor = FieldActor(style, scale)
        solid = [self.field_actor.actor, self.field_actor.stand_in.actor]
        self._proportion = 1.0
        self.insets = Insets(plotter, solid, self.field_actor, style, scale)
        self.renderer.SetBackground(*style.background)
        plotter.add_own(*solid)
        light(self.renderer)

    @property
    def whole_bounds(self) -> Sequence[float]:
        """The bounds (x, x, y, y, z, z) of the surface and of what others have added."""
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
            self.field_actor.set_scale(self.scale, share)
            self.insets.set_proportion(share)

    def remove(self) -> None:
        """Leave the plotter to another."""
        self.insets.remove()
        self.plotter.remove_own()

    # ------------------------------------------------------------------ the surface and its field
    def show_surface(self, mesh: vtkPolyData, bounds: Sequence[float]) -> None:
        """Show a surface made by `drawable`, without a field yet."""
        self.show_shape(mesh, bounds)
        self.field_actor.show_selected(None)
        self.insets.show((), np.empty((0, 3)))

    def show_shape(self, mesh: vtkPolyData, bounds: Sequence[float]) -> None:
        """Show the surface in another shape; its field has to be shown again."""
        self.field_actor.show_surface(mesh)
        self.bounds = bounds


USUAL = 400.0
"""Pixels, at scale 1, of the shorter side of a view from which on lines and marks have the size that a style says."""

LEAST = 0.6
"""Least fraction of that size, as white lines must still be seen."""


def proportion(width: float, height: float) -> float:
    """Return the share of their usual size that lines and marks have in a view of so many logical pixels."""
    return max(min(width, height, USUAL) / USUAL, LEAST)
