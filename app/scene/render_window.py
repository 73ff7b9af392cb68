"""The windows, off the screen, in which VTK draws."""

import ctypes
import os
import sys
from contextlib import suppress

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the window below is abstract without it)
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkRenderingCore import vtkRenderWindow

from bihdist_core import BihdistError

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
