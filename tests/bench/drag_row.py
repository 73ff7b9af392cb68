"""Row 15: a source that is dragged over the surface, without painting."""

import queue
import subprocess
import time
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from bihdist_core.distances.kinds import Spec

from .child import in_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line
from .window_rows import COMPARED, PATIENCE, Viewless, mesh_file

MOVES, EVERY = 188, 0.016
"""A move every 16 ms for three seconds."""


def drag(size: Size) -> Iterator[Line]:
    """How many answers are computed for nothing, and how many processes exact geodesic panels start."""
    large, small = size.drag
    computed, shown, older, _ = in_child(_drag, large, COMPARED)
    yield Line(
        15,
        f"answers lost in a drag, {large:,}",
        value=1 - shown / computed,
        bound=0.1,
        note=f"{shown} of {computed} shown, {older} older than the one before; {MOVES} moves in 3 s",
    )
    computed, shown, older, started = in_child(_drag, small, (Spec.of("geodesic", method="exact"),))
    yield Line(
        15,
        f"processes started in a drag, exact geodesic, {small:,}",
        value=started,
        bound=0.5,
        note=f"{shown} of {computed} shown, {older} older than the one before",
    )


def _drag(count: int, specs: tuple[Spec, ...]) -> tuple[int, int, int, int]:
    """Answers computed, shown, and shown though older than the one before; processes started."""
    from app.document.document import comparison
    from app.document.edits import move_source
    from app.session.loaded_mesh import LoadedMesh
    from app.session.session import Session

    view = Viewless()
    session = Session(view, view.posted.put)
    computed: list[int] = []
    shown: list[tuple[int, int]] = []
    started: list[object] = []
    with mesh_file(*bumpy_sphere(count)) as path:
        session.show(comparison(path, specs, (0,)))
        while not session.is_complete:
            view.posted.get(timeout=PATIENCE)()
    answer, popen = LoadedMesh.answer, subprocess.Popen

    def counted(self: LoadedMesh, question: Any, *arguments: Any, **options: Any) -> Any:
        found = answer(self, question, *arguments, **options)
        computed.append(question.at)
        return found

    def loaded(*arguments: Any, **options: Any) -> Any:
        started.append(arguments)
        return popen(*arguments, **options)

    LoadedMesh.answer, subprocess.Popen = counted, loaded  # type: ignore[method-assign,misc]
    view.answer_changed = lambda panel: shown.append((panel, session.shown[panel].serial))  # type: ignore[assignment]
    begun = time.perf_counter()
    for move in range(MOVES):
        session.show(move_source(session.document, 0, 10 + move), key="drag", live=True)
        _run(view, begun + (move + 1) * EVERY)
    _run(view, time.perf_counter() + 2)
    session.close()
    serials = [[serial for panel, serial in shown if panel == id] for id in session.shown]
    older = sum(b < a for each in serials for a, b in pairwise(each))
    return len(computed), len(shown), older, len(started)


def _run(view: Viewless, until: float) -> None:
    """What is posted, until a time of the clock."""
    while (left := until - time.perf_counter()) > 0:
        try:
            view.posted.get(timeout=left)()
        except queue.Empty:
            return
