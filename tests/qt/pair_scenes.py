"""What there is to see of correspondence, for the contact sheet: two poses of one shape, by mouse and keys."""

import numpy as np

from .driver import Driver
from .pointer import close_docks, dock_of, place_on, point_near, to_panels

PAIRED = 8
"""Vertices of both poses that are pairs before any is clicked, far apart."""


def far_apart(places: np.ndarray) -> list[int]:
    """So many of places (n, 3)."""
    chosen = [0]
    while len(chosen) < PAIRED:
        away = np.linalg.norm(places[:, None] - places[chosen], axis=2).min(axis=1)
        chosen.append(int(away.argmax()))
    return chosen


def correspondence(d: Driver) -> None:
    """The tool with one mesh, then pairs on two: by hand, from the prediction, and what goes wrong."""
    from app.document.second_mesh_edits import close_second_mesh
    from app.samples import mesh_path
    from app.tools.correspondence.pairs import add_pairs

    d.open(mesh_path("beast"))
    dock, session = dock_of(d, "pairs", "m"), d.window.session
    d.shot("correspondence with one mesh")
    session.open_second_mesh(mesh_path("beast_pose2"))
    d.until(lambda: len(session.document.surfaces) == 2 and not session.is_opening)
    d.complete()
    d.pointer("mousemove", *place_on(d, dock.start, 0.5, 0.5), "click", 1)
    d.complete()
    d.shot("no pairs yet")
    for panel in (0, 1):
        point_near(d, panel, 0.5, 0.4)
        d.pointer("click", 1)
        d.complete()
        d.shot(f"a pair at {'AB'[panel]}")
    session.undo()
    session.undo()
    session.show(
        add_pairs(session.document, [(vertex, vertex) for vertex in far_apart(session.mesh().surface.vertices)])
    )
    d.complete()
    point_near(d, 0, 0.6, 0.5)
    d.pointer("click", 1)
    d.complete()
    d.spin(2.0)
    d.shot("a prediction")
    d.point_at_surface(1)
    d.shot("the misfit at the pointer")
    row = list(dock.rows.values())[2]
    d.pointer("mousemove", *place_on(d, row, 0.5, 0.5), "click", 1)
    d.shot("a pair stands out")
    to_panels(d)
    d.pointer("key", "Return")
    d.complete()
    d.shot("accepted")
    point_near(d, 1, 0.4, 0.6)
    d.pointer("click", 1)
    d.complete()
    d.shot("the other way round")
    d.pointer("key", "Escape")
    d.complete()
    close_docks(d)
    session.show(close_second_mesh(session.document))
    d.complete()
