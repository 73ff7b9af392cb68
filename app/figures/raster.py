"""Shaded pictures of any size without a window: drawn in tiles, with finer pixels that are averaged afterwards."""

import ctypes
import os
import sys

import numpy as np

from bihdist_core import BihdistError
from bihdist_core.arrays import ByteArray
from bihdist_core.progress import Progress, silent

from ..scene.camera import Projection, see_part
from ..scene.style import Style

FINER = 2
"""Pixels drawn for each pixel of a figure, along each side."""

SAMPLES = 8
"""Of each of these pixels."""

TILE = 1024
"""Pixels of the picture, along each side, that are drawn at once: OpenGL limits a picture's size, and memory does."""

Rectangle = tuple[float, float, float, float]
"""Left, right, bottom and top of a part of a picture, in coordinates that run from -1 to 1 across the whole."""

WHOLE: Rectangle = (-1.0, 1.0, -1.0, 1.0)


class RenderWindow:
    """An off-screen window with one surface in it, which has to be closed; only one thread may use it.

    Parameters
    ----------
    finer
        Number of pixels drawn along each side of a pixel of the picture.
    samples
        Number of samples of each of these.
    """

    def __init__(self, style: Style, finer: int = FINER, samples: int = SAMPLES) -> None:
        check_offscreen()
        from vtkmodules.vtkRenderingCore import vtkRenderer

        from ..scene.field_actor import FieldActor, light
        from ..scene.offscreen_renderer import offscreen_window

        self._finer, self._samples = finer, samples
        self._window = offscreen_window()
        self.shown = FieldActor(style)
        self._renderer = vtkRenderer()
        self._renderer.SetBackground(0, 0, 0)
        self._renderer.SetBackgroundAlpha(0)
        self._renderer.AddActor(self.shown.actor)
        light(self._renderer)
        self._window.SetAlphaBitPlanes(True)
        self._window.AddRenderer(self._renderer)

    def close(self) -> None:
        """Give back what the graphics library holds."""
        self._window.Finalize()

    def shade(
        self,
        projection: Projection,
        size: tuple[int, int],
        scale: float,
        part: Rectangle = WHOLE,
        progress: Progress | None = None,
    ) -> ByteArray:
        """Return a transparent picture (height, width, 4) uint8 of what is shown, with premultiplied alpha.

        Parameters
        ----------
        size
            Width and height in pixels.
        scale
            Pixels per pixel of the style's line widths.
        part
            Part of the view.
        """
        report = progress or silent
        width, height = size
        # What is blended by depth has no samples, but more pixels instead.
        is_translucent = self.shown.opacity < 1
        finer = self._finer * (2 if is_translucent and self._samples else 1)
        self._window.SetMultiSamples(0 if is_translucent else self._samples)
        self.shown.set_scale(scale * finer)
        # Of equal size, so that the window keeps its own.
        tile = tuple(-(-side // -(-side // TILE)) for side in size)
        across, down = (-(-side // step) for side, step in zip(size, tile, strict=True))
        picture = np.zeros((down * tile[1], across * tile[0], 4), np.uint8)
        self._window.SetSize(tile[0] * finer, tile[1] * finer)
        left, right, bottom, top = part
        per_x, per_y = (right - left) / width, (top - bottom) / height
        for row in range(down):
            for column in range(across):
                report((row * across + column) / (across * down), "drawing")
                x, y = column * tile[0], row * tile[1]
                seen = (
                    left + x * per_x,
                    left + (x + tile[0]) * per_x,
                    top - (y + tile[1]) * per_y,
                    top - y * per_y,
                )
                if projection.meets(seen):
                    # From below, as OpenGL counts.
                    self.shown.set_origin(x * finer, -(y + tile[1]) * finer)
                    picture[y : y + tile[1], x : x + tile[0]] = self._draw(projection, seen, finer)
        report(1.0, "drawing")
        return picture[:height, :width]

    def _draw(self, projection: Projection, part: Rectangle, finer: int) -> ByteArray:
        """Draw one tile, `finer` along each side, averaged down to the picture's pixels."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

        camera = self._renderer.GetActiveCamera()
        camera.SetPosition(*projection.position)
        camera.SetFocalPoint(*(projection.position - projection.view[2, :3]))
        camera.SetViewUp(*projection.view[1, :3])
        camera.SetParallelProjection(projection.is_parallel)
        see_part(camera, projection.matrix, part)
        self._window.Render()
        width, height = self._window.GetSize()
        read = vtkUnsignedCharArray()
        self._window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, read, 0)
        fine = vtk_to_numpy(read).reshape(height, width, 4)
        total = np.full((height // finer, width // finer, 4), finer**2 // 2, np.uint16)
        for row in range(finer):
            for column in range(finer):
                total += fine[row::finer, column::finer]
        return (total // finer**2).astype(np.uint8)[::-1]


def check_offscreen() -> None:
    """Raise BihdistError, with what to install, where the libraries that draw without a screen are missing.

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
