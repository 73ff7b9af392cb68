"""Row 15: a source that is dragged over the surface, without painting."""

import queue
import subprocess
import time
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from bihdist_core.distances.distance_types import Spec
from tests.silent_view import SilentView

from .child import in_window_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line
from .window_rows import COMPARED, PATIENCE, mesh_file

EVERY = 0.016
"""Seconds from one move to the next, of which there are as many as in three seconds."""


def drag(size: Size) -> Iterator[Line]:
    """How many answers are computed for nothing, and how many processes exact geodesic panels start."""
    large, small = size.drag
    computed, shown, older, _ = in_window_child(size, _drag, large, COMPARED, size.moves)
    yield Line(
        15,
        f"answers lost in a drag, {large:,}",
        value=1 - shown / computed,
        bound=0.1,
        note=f"{shown} of {computed} shown, {older} older than the one before; {size.moves} moves, {EVERY:g} s apart",
    )
    computed, shown, older, started = in_window_child(
        size, _drag, small, (Spec.of("geodesic", method="exact"),), size.moves
    )
    yield Line(
        15,
        f"processes started in a drag, exact geodesic, {small:,}",
        value=started,
        bound=0.5,
        note=f"{shown} of {computed} shown, {older} older than the one before",
    )


def _drag(count: int, specs: tuple[Spec, ...], moves: int) -> tuple[int, int, int, int]:
    """Answers computed, shown, and shown though older than the one before; processes started."""
    from app.document.document import comparison
    from app.document.edits import move_source
    from app.session.questions import DistanceQuestion
    from app.session.session import Session

    view = SilentView()
    session = Session(view, view.posted.put)
    computed: list[int] = []
    shown: list[tuple[int, int]] = []
    started: list[object] = []
    with mesh_file(*bumpy_sphere(count)) as path:
        session.show(comparison(path, specs, (0,)))
        while not session.is_complete:
            view.posted.get(timeout=PATIENCE)()
    answer, popen = DistanceQuestion.answer, subprocess.Popen

    def counted(question: DistanceQuestion, *arguments: Any, **options: Any) -> Any:
        found = answer(question, *arguments, **options)
        computed.append(question.at)
        return found

    def loaded(*arguments: Any, **options: Any) -> Any:
        started.append(arguments)
        return popen(*arguments, **options)

    DistanceQuestion.answer, subprocess.Popen = counted, loaded  # type: ignore[method-assign,misc]
    view.answer_changed = lambda panel: shown.append((panel, session.shown[panel].serial))  # type: ignore[assignment]
    begun = time.perf_counter()
    for move in range(moves):
        session.show(move_source(session.document, 0, 10 + move), key="drag", live=True)
        _run(view, begun + (move + 1) * EVERY)
    _run(view, time.perf_counter() + 2)
    session.close()
    DistanceQuestion.answer, subprocess.Popen = answer, popen  # type: ignore[method-assign,misc]
    serials = [[serial for panel, serial in shown if panel == id] for id in session.shown]
    older = sum(b < a for each in serials for a, b in pairwise(each))
    return len(computed), len(shown), older, len(started)


def _run(view: SilentView, until: float) -> None:
    """What is posted, until a time of the clock."""
    while (left := until - time.perf_counter()) > 0:
        try:
            view.posted.get(timeout=left)()
        except queue.Empty:
            return
