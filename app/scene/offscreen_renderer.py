"""The one OpenGL window, off the screen, in which all panels of a window are drawn, one after the other.

What is drawn comes out as an array, so that the toolkit can put anything over it without drawing it again; and panels
that show the same surface share its vertices in the graphics memory, and the compiled shaders.
"""

import ctypes
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the window below is abstract without it)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkLogger, vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkRenderWindow

from bihdist_core import BihdistError
from bihdist_core.arrays import ByteArray, FloatArray

from .camera import stand_back
from .panel_scene import PanelScene
from .style import PAPER, Style

if TYPE_CHECKING:
    from .panel_plotter import PanelPlotter

LAST_RESORT = "vtkOSOpenGLRenderWindow"
"""What VTK makes where no driver draws; without the library that this calls, it ends the process."""
OSMESA = ("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")


def offscreen_window() -> vtkRenderWindow:
    """Return a window off the screen; BihdistError, with what to install, where there is no OpenGL for it."""
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        # VTK would otherwise try an X server first, and complain that there is none.
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
    before = vtkLogger.GetCurrentVerbosityCutoff()
    # Each way that it tries in vain would be a warning.
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)
    # Not that of a `pyvista.Plotter`, which first opens another to see whether it can: a third of a second.
    window = vtkRenderWindow()
    vtkLogger.SetStderrVerbosity(before)
    if window.GetClassName() == LAST_RESORT and not _has_osmesa():
        raise BihdistError(
            "Drawing needs OpenGL, and no driver is there, not even one without a graphics card; on Debian or Ubuntu: "
            "apt-get install libgl1-mesa-dri libegl1"
        )
    window.SetOffScreenRendering(True)
    return window


def _has_osmesa() -> bool:
    for name in OSMESA:
        with suppress(OSError):
            ctypes.CDLL(name)
            return True
    return False


class OffscreenRenderer:
    """An off-screen window, made and used on one thread; raises BihdistError where there is no OpenGL.

    Attributes
    ----------
    pictures
        Number of pictures that have been drawn.
    seconds
        Time that has taken since `begin`.
    """

    def __init__(self) -> None:
        self.pictures = 0
        self.seconds = 0.0
        self._window = offscreen_window()
        # Multisampling costs three times on software rendering, which is what a screen without OpenGL gets; smoothing
        # the picture afterwards (FXAA) is nearly free.
        self._window.SetMultiSamples(0)
        self._scenes: list[PanelScene] = []
        self._read = vtkUnsignedCharArray()

    def new_plotter(self, redraw: Callable[[], None] = lambda: None) -> "PanelPlotter":
        """Return a panel's plotter, which calls `redraw` when something was added to it or removed."""
        from .panel_plotter import PanelPlotter  # with the first panel: the window opens before PyVista is imported

        return PanelPlotter(self._window, redraw)

    def new_scene(self, style: Style = PAPER, scale: float = 1.0, plotter: "PanelPlotter | None" = None) -> PanelScene:
        """Return a scene that is drawn here until it is removed, by a plotter of its own if none is given."""
        scene = PanelScene(plotter or self.new_plotter(), style, scale)
        self._scenes.append(scene)
        return scene

    def remove(self, scene: PanelScene) -> None:
        """Draw a scene no longer; its plotter is left for another, with what others have added to it."""
        scene.remove()
        self._scenes.remove(scene)

    def fit(self, size: tuple[int, int]) -> None:
        """Let the pictures have this width and height in pixels from now on."""
        if tuple(self._window.GetSize()) != size:
            self._window.SetSize(*size)

    def begin(self) -> None:
        """Count the time that pictures take from here."""
        self.seconds = 0.0

    def picture(self, scene: PanelScene, size: tuple[int, int]) -> ByteArray:
        """Draw a scene and return its picture (height, width, 4) uint8, upright."""
        self.fit(size)
        for other in self._scenes:
            for renderer in other.renderers:
                renderer.DrawOff()
        scene.renderer.DrawOn()
        bounds = scene.whole_bounds
        stand_back(scene.renderer.GetActiveCamera(), bounds)
        scene.renderer.ResetCameraClippingRange(*bounds)
        start = perf_counter()
        self._window.Render()
        self.pictures += 1
        width, height = size
        self._window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, self._read, 0)
        took = perf_counter() - start
        self.seconds += took
        if not scene.field_actor.stand_in.is_shown:
            scene.seconds = took
        picture = np.ascontiguousarray(vtk_to_numpy(self._read).reshape(height, width, 4)[::-1])
        picture[..., 3] = 255  # what smoothing leaves there means nothing
        return picture

    def depths(self) -> FloatArray:
        """Return the depths (height, width) of the last picture, upright: 0 nearest to the camera, 1 for nothing."""
        width, height = self._window.GetSize()
        read = vtkFloatArray()
        self._window.GetZbufferData(0, 0, width - 1, height - 1, read)
        depths: FloatArray = vtk_to_numpy(read).reshape(height, width)[::-1]
        return depths

    def close(self) -> None:
        """Give back what the graphics have."""
        for scene in tuple(self._scenes):
            self.remove(scene)
            scene.plotter.leave()
        self._window.Finalize()
