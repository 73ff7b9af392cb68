"""Headless figures: the window's comparison as a picture, with no Qt and no screen."""

import ctypes
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bihdist_core import BihdistError, Surface

from .camera import Margins, place_camera
from .scene import PanelScene, drawable
from .style import PAPER, Style

PANEL_SIZE = (560, 640)
MARGINS = Margins(top=0.12, bottom=0.13)


@dataclass(frozen=True, eq=False)
class FigurePanel:
    """One panel of a figure: a field (n,) with NaN where undefined, and the words above it."""

    field: np.ndarray
    heading: str
    hint: str = ""
    unit: str = ""


def draw_comparison(
    surface: Surface,
    panels: Sequence[FigurePanel],
    source: int,
    *,
    isolines: int = 20,
    panel_size: tuple[int, int] = PANEL_SIZE,
    scale: float = 1.0,
    view: str = "home",
    style: Style = PAPER,
) -> np.ndarray:
    """(height, width, 3) uint8 picture: the panels side by side, from the same camera.

    panel_size: pixels of each panel at scale 1; `scale` multiplies it, lines and text included.
    Raises BihdistError where nothing can be drawn off screen.
    """
    check_offscreen()
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        # VTK would otherwise try an X server first, and complain that there is none.
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    import pyvista

    width, height = (round(side * scale) for side in panel_size)
    plotter = pyvista.Plotter(
        off_screen=True, shape=(1, len(panels)), border=False, window_size=(width * len(panels), height)
    )
    try:
        plotter.render_window.SetMultiSamples(8)
        mesh = drawable(surface)
        camera = plotter.renderers[0].GetActiveCamera()
        shown = surface.vertices[surface.component_of_vertex >= 0]
        place_camera(camera, shown, width / height, view, MARGINS)
        for renderer, panel in zip(plotter.renderers, panels, strict=True):
            scene = PanelScene(renderer, style, scale)
            scene.show_surface(mesh)
            scene.show_field(panel.field, panel.unit)
            scene.show_isolines(isolines)
            scene.mark_source(surface.vertices[source])
            scene.write_heading(panel.heading, panel.hint)
            renderer.SetActiveCamera(camera)
            renderer.camera_set = True
        # One picture of all renderers; pyvista would otherwise reset cameras at the first render.
        plotter.show(auto_close=False, interactive=False)
        return np.array(plotter.screenshot(return_img=True))[..., :3]
    finally:
        plotter.close()


def check_offscreen() -> None:
    """BihdistError, with what to install, where the libraries that draw without a screen are missing.

    Without them VTK does not raise but ends the process.
    """
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        for library in ("libEGL.so.1", "libGL.so.1"):
            try:
                ctypes.CDLL(library)
            except OSError:
                raise BihdistError(
                    f"Drawing needs {library}, which is not installed; on Debian or Ubuntu: "
                    "apt-get install libegl1 libgl1"
                ) from None
