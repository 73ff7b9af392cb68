"""Pictures of a surface from chosen sides, drawn off screen as the viewer draws them."""

from collections.abc import Sequence

import numpy as np
import pyvista

from app.document.looks import Isolines
from app.scene.camera import MARGIN, aimed, show_camera
from app.scene.drawable import drawable
from app.scene.field_actor import FieldActor, light
from app.scene.style import PAPER
from bihdist_core import Surface


def row(
    surface: Surface,
    sides: Sequence[tuple[float, float, float]],
    field: np.ndarray | None = None,
    size: tuple[int, int] = (400, 440),
    isolines: int = 24,
    scale: float = 1.0,
    up: tuple[float, float, float] = (0, 1, 0),
) -> np.ndarray:
    """(height, width, 3) uint8: the surface from each of the sides, which are directions to the camera.

    `field` (n,) colours it and gives the isolines; without one it is plain clay.  `size` is one picture's, in pixels.
    `up` is an axis; in a view along it the axis before it, y before z, points down.
    """
    width, height = size
    plotter = pyvista.Plotter(
        off_screen=True, shape=(1, len(sides)), border=False, window_size=(width * len(sides), height)
    )
    try:
        plotter.render_window.SetMultiSamples(8)
        mesh = drawable(surface)
        for renderer, side in zip(plotter.renderers, sides, strict=True):
            painted = FieldActor(PAPER, scale)
            painted.show_surface(mesh)
            painted.show_isolines(Isolines(isolines if field is not None else 0))
            if field is not None:
                painted.show_field(field)
            renderer.AddActor(painted.actor)
            renderer.SetBackground(*PAPER.background)
            light(renderer)
            upright = np.array(up) if abs(np.dot(side, up)) < 0.9 * np.linalg.norm(side) else -np.roll(up, 1)
            aspect, back = width / height, np.array(side, float)
            camera = aimed(surface.vertices, aspect, back, upright.astype(float), MARGIN)
            show_camera(renderer.GetActiveCamera(), camera, aspect)
            renderer.camera_set = True
        plotter.show(auto_close=False, interactive=False)
        return np.array(plotter.screenshot(return_img=True))[..., :3]
    finally:
        plotter.close()
