"""Row 16: three panels of a large surface while the camera moves, with what stands in for it and without."""

from collections.abc import Iterator

import numpy as np

from .child import in_window_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line
from .timing import alternate
from .window_rows import _wait, _wait_a_while, _window, has_display, mesh_file

MOVING_BOUND = 0.5
LOOKS_ALIKE = 0.02
"""Mean difference of two pictures, as a share of white."""


def moving(size: Size) -> Iterator[Line]:
    if not has_display():
        yield Line(16, "camera moved, three panels painted", bound=MOVING_BOUND, note="skipped: there is no display")
        return
    ours, peer, ratio, difference, vertices, points = in_window_child(size, _moving, size)
    yield Line(
        16,
        f"camera moved, three panels painted, {vertices:,}",
        ours,
        peer,
        ratio,
        bound=MOVING_BOUND,
        error=difference,
        tolerance=LOOKS_ALIKE,
        note=f"{points:,} points stand in; peer: the surface itself; error: of the picture, in mean"
        if points
        else "nothing stands in for so few",
    )


def _moving(size: Size) -> tuple[float, float, float, float, int, int]:
    """Seconds of a frame with and without, their ratio, the pictures' difference; vertices, and points that stand in.

    The field is a distance in space: nothing is solved.
    """
    from app.scene import moves

    with mesh_file(*bumpy_sphere(size.moving)) as path, _window(path) as (application, window):
        _wait(application, lambda: window.session.loaded() is not None)
        window.session.cancel()
        _wait_a_while(application, 0.5)
        x = window.session.mesh().surface.vertices
        panels, grid = window.grid.panels, window.grid
        for panel in panels:
            panel.view.scene.field_actor.show_field(np.linalg.norm(x - x[0], axis=1))
            panel.show_waiting(None)
            panel.view.over.say("")
        grid.redraw()
        _wait_a_while(application, 0.5)
        view = panels[0].view

        def frame(fluent: float) -> None:
            grid.motion.fluent = fluent
            moves.turn(view.camera, 3, 1, (view.width(), view.height()))
            view.moved.emit()
            for panel in panels:
                panel.view.offscreen.begin()  # or it would wait for what else there is to do
                panel.view.repaint()

        def quick() -> None:
            frame(0.0)

        def full() -> None:
            grid.motion.stop()
            frame(np.inf)

        quick()
        standing = view._drawing[..., :3].astype(float)
        difference = float(np.abs(standing - view.shot()).mean()) / 255
        full()
        result = alternate(quick, full, size.rounds, size.repeat)
        stands = view.scene.field_actor.stand_in.actor.GetMapper().GetInput().GetNumberOfPoints()
    return result.our_time, result.peer_time, result.ratio, difference, len(x), stands
