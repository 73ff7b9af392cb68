"""A panel as those who know PyVista know it: its renderer, and `add_mesh`, `add_points`, `remove_actor` and the like.

Imported with the first panel that has something to draw, not before: PyVista takes a while.
"""

from collections.abc import Callable, Mapping
from typing import Any

import pyvista
from pyvista import plotting
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkRenderingCore import vtkProp, vtkProp3D, vtkRenderWindow

from bihdist_core.arrays import AnyArray

from .drawable import copies_of, vertex_faces


def mesh_of(drawn: vtkPolyData, fields: Mapping[str, AnyArray]) -> pyvista.PolyData:
    """Return a copy of a surface as it is drawn, with fields (n,) as arrays by their names; vertex k is point k."""
    points = vtk_to_numpy(drawn.GetPoints().GetData())
    vertices = points[: len(points) - len(copies_of(drawn))].copy()
    mesh: pyvista.PolyData = pyvista.PolyData.from_regular_faces(vertices, vertex_faces(drawn).astype(int, copy=False))
    for name, field in fields.items():
        mesh.point_data.set_array(field, name, deep_copy=True)
    return mesh


class PanelPlotter(pyvista.BasePlotter):
    """Draws into a panel of the window; what is added turns with its surface and stands in its pictures.

    `render` has the panel drawn again, as do `add_mesh` and its like; the camera stays where it is.  `clear` removes
    what was added, and leaves the panel's own surface and marks.
    """

    def __init__(self, window: vtkRenderWindow, redraw: Callable[[], None]) -> None:
        # Neither the lights nor the theme that somebody has chosen for plotters of PyVista's.
        super().__init__(border=False, lighting="none", theme=pyvista.themes.Theme())
        self.ren_win = window
        self.redraw = redraw
        self._own: list[vtkProp] = []
        # `pyvista.close_all` is not meant for the window's; PyVista has no option for a plotter it is not to know of.
        plotting._ALL_PLOTTERS.pop(self._id_name, None)
        renderer = self.renderer
        renderer.UseFXAAOn()
        renderer.DrawOff()
        # To find out what is out of sight VTK would go over all vertices, and here nothing ever is.
        renderer.GetCullers().RemoveAllItems()
        window.AddRenderer(renderer)

    def look_through(self, camera: pyvista.Camera) -> None:
        """See what this camera sees, which several panels share."""
        self.renderer.camera = camera

    def render(self) -> None:
        """Have the panel drawn again, once, when the window is painted next."""
        self.redraw()

    @property
    def added(self) -> list[vtkProp3D]:
        """The actors that others have put beside the surface, but not on the picture, such as a scalar bar."""
        return [actor for actor in self._others() if isinstance(actor, vtkProp3D)]

    def _others(self) -> list[vtkProp]:
        return [actor for actor in self.renderer.GetViewProps() if actor not in self._own]

    def remove_actor(self, actor: Any, *arguments: Any, **options: Any) -> bool:  # type: ignore[override]
        """Remove what was added: an actor, its name, or a list of such.

        ValueError for one of the panel's own, such as its surface.
        """
        actors = self.actors
        for each in actor if isinstance(actor, list | tuple) else [actor]:
            if actors.get(each, each) in self._own:
                raise ValueError("This actor is the panel's own, and stays; only what was added can be removed.")
        return bool(super().remove_actor(actor, *arguments, **options))

    def clear_actors(self) -> None:
        """Remove what was added."""
        self.remove_actor(self._others(), reset_camera=False, render=False)
        self.render()

    def clear(self) -> None:
        """Remove what was added, with its scalar bars."""
        self.clear_actors()
        self.scalar_bars.clear()

    def close(self) -> None:
        """Remove what was added: the panel is closed with the window."""
        self.clear()

    def leave(self) -> None:
        """Draw no more, as the window is closed."""
        self.redraw, self.ren_win = lambda: None, None
        super().close()

    def add_actor(self, *arguments: Any, **options: Any) -> Any:  # type: ignore[override]
        """Add an actor as PyVista does, but leave the camera where it is."""
        options["reset_camera"] = bool(options.get("reset_camera"))
        return super().add_actor(*arguments, **options)

    def add_own(self, *actors: vtkProp) -> None:
        """Draw these, which nobody is to remove."""
        for actor in actors:
            self._own.append(actor)
            self.renderer.AddActor(actor)

    def remove_own(self) -> None:
        """Let others take the place of the panel's own actors; what was added stays."""
        while self._own:
            self.renderer.RemoveActor(self._own.pop())
