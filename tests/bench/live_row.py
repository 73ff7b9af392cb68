"""Row 19: the fields that follow a source which is dragged, as the session computes them, without painting.

The source moves on when every panel has followed, and after 16 ms in any case, as a pointer does: what is measured is
how fast fields are computed, also where that is faster than pointers move.
"""

import queue
import time
from collections.abc import Iterator

from bihdist_core.distances.distance_types import FRAME_VERTICES, Spec
from tests.silent_view import SilentView

from .child import in_window_child
from .drag_row import EVERY
from .meshes import bumpy_sphere
from .peers import heat_solver
from .size import Size
from .table import Line
from .timing import timed
from .window_rows import PATIENCE, mesh_file

LIVE_BOUND = 1.5
"""A field of the three, by how much longer it may take than a heat solve of potpourri3d on its own."""

MESSAGES = 0.004
"""Seconds beside that at any size, for messages between threads: next to nothing beside a solve at 50,000 vertices,
but at 4,000 a solve takes one thousandth."""

LIVE = Spec.of("biharmonic"), Spec.of("geodesic"), Spec.of("diffusion")
"""What a window opens with; the geodesic distance is approximate as long as the source moves."""


def live(size: Size) -> Iterator[Line]:
    """Seconds from one field to the next while three panels follow, beside one heat solve."""
    for count in size.live:
        for name in ("vertices", "places"):
            fields, seconds, peer = in_window_child(size, _live, count, name == "places", size.seconds)
            yield Line(
                19,
                f"a field in a live drag over {name}, {count:,}",
                seconds / max(fields, 1),
                peer,
                seconds / max(fields, 1) / peer,
                bound=round(LIVE_BOUND + MESSAGES / peer, 1),
                note=f"{fields / seconds:.0f} fields a second in three panels; peer: one heat solve",
            )


def _live(count: int, in_faces: bool, wanted: float) -> tuple[int, float, float]:
    """Fields shown, in how many seconds (about as many as wanted), and the seconds of a heat solve."""
    from app.document.document import comparison
    from app.document.edits import move_source
    from app.session.session import Session
    from bihdist_core import SurfacePoint

    view = SilentView()
    session = Session(view, view.posted.put)
    vertices, faces = bumpy_sphere(count)
    with mesh_file(vertices, faces) as path:
        session.show(comparison(path, LIVE, (0,)))
        while session.loaded() is None or not session.shown.keys() >= {0, 2}:
            view.posted.get(timeout=PATIENCE)()
    session.show(move_source(session.document, 0, 7), live=True)
    while 1 not in session.shown or (count > FRAME_VERTICES and "approximate" not in session.shown[1].answer.label):
        view.posted.get(timeout=PATIENCE)()  # the approximate one is made ready
    shown: list[int] = []
    view.answer_changed = shown.append  # type: ignore[method-assign]
    begun, move = time.perf_counter(), 0
    while time.perf_counter() < begun + wanted:
        move += 1
        at = SurfacePoint.of(10 + move, 0.25, 0.5) if in_faces else 10 + move
        session.show(move_source(session.document, 0, at), key="drag", live=True)
        _until_followed(view, shown, len(shown) + len(LIVE))
    seconds = time.perf_counter() - begun
    session.close()
    solver = heat_solver(vertices, faces)
    solver.compute_distance(0)
    solves = sorted(timed(lambda: solver.compute_distance(5))[0] for _ in range(5))
    return len(shown), seconds, solves[2]


def _until_followed(view: SilentView, shown: list[int], count: int) -> None:
    """What is posted, until so many fields are shown or a pointer would move on."""
    end = time.perf_counter() + EVERY
    while len(shown) < count and (left := end - time.perf_counter()) > 0:
        try:
            view.posted.get(timeout=left)()
        except queue.Empty:
            return
