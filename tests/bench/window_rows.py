"""Rows 10 and 12 to 14: the session without a window, the start, and the real window on the display there is."""

import os
import queue
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core.distances.kinds import Spec

from .case import EXACT, main_case
from .child import in_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line, compared
from .timing import alternate

ROOT = Path(__file__).resolve().parents[2]
COMPARED = Spec.of("biharmonic"), Spec.of("geodesic", method="heat"), Spec.of("diffusion")
PATIENCE = 600.0
"""Seconds after which something has gone wrong."""
TICK_MS = 2
"""How often the window's thread is asked for a sign of life."""


# ---------------------------------------------------------------------- the session, without drawing
class Viewless:
    """The side of a window that a session talks to, with nothing behind it."""

    def __init__(self) -> None:
        self.posted: queue.Queue[Callable[[], None]] = queue.Queue()

    def document_changed(self, before: Any) -> None: ...
    def answer_changed(self, panel: int) -> None: ...
    def certificate_changed(self, panel: int) -> None: ...
    def progress_changed(self) -> None: ...

    def failed(self, message: str) -> None:
        raise RuntimeError(message)


def click(size: Size) -> Iterator[Line]:
    """Biharmonic, heat geodesic and diffusion, asked for at once as a click does."""
    from app.document.document import comparison
    from app.document.edits import move_source
    from app.session.session import Session

    case = main_case(size)
    view = Viewless()
    session = Session(view, view.posted.put)

    def answered() -> None:
        while not session.is_complete:
            view.posted.get(timeout=PATIENCE)()

    # Each once: what has been asked before is kept.
    sources = iter(np.random.default_rng(1).permutation(len(case.arrays[0])))

    def ask(source: int | None = None) -> None:
        session.show(move_source(session.document, 0, int(next(sources)) if source is None else source))
        answered()

    try:
        with mesh_file(*case.arrays) as path:
            session.show(comparison(path, COMPARED, (case.source,)))
            answered()
        ask()
        peer = case.heat_peer
        result = alternate(ask, lambda: peer.compute_distance(case.source), 3 * size.rounds, size.repeat)
        ask(case.source)
        values = session.shown[0].answer.field[case.targets]
    finally:
        session.close()
    yield compared(
        10,
        f"click to three fields, {len(case.arrays[0]):,}",
        result,
        bound=0.8,
        error=case.error(values),
        tolerance=EXACT,
        note="peer: one potpourri3d heat solve",
    )


# ---------------------------------------------------------------------- the start
IMPORT = "from bihdist_core import BiharmonicDistance"
FIRST_PAINT = """
import os, sys
from app.qt import main_window
main_window.MainWindow.paintEvent = lambda self, event: os._exit(0)
from app.main import main
sys.exit(main(sys.argv[1:]) or 1)
"""


def start(size: Size) -> Iterator[Line]:
    with tempfile.TemporaryDirectory() as folder:
        picture = str(Path(folder, "window.png"))
        programs = [
            ("bihdist --version", 0.3, ["-m", "app", "--version"], False),
            ("import bihdist_core", 1.0, ["-c", "import bihdist_core"], False),
            # Names are imported when they are asked for; this is what a program waits for in fact.
            (IMPORT, 1.0, ["-c", IMPORT], False),
            ("window shown", 2.5, ["-c", FIRST_PAINT, "view", size.sample], True),
            ("first picture", 10.0, ["-m", "app", "view", size.sample, "--screenshot", picture], True),
        ]
        for name, bound, arguments, needs_display in programs:
            if needs_display and not has_display():
                yield Line(12, name, bound=bound, note="skipped: there is no display")
                continue
            result = alternate(
                lambda arguments=arguments: _python(*arguments), lambda: _python("-c", "import pyvista"), size.rounds
            )
            yield Line(
                12, name, result.our_time, result.peer_time, result.ratio, bound=bound, note="peer: import pyvista"
            )


def _python(*arguments: str) -> None:
    subprocess.run([sys.executable, *arguments], cwd=ROOT, check=True, stdout=subprocess.DEVNULL, timeout=PATIENCE)


def has_display() -> bool:
    return not sys.platform.startswith("linux") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


# ---------------------------------------------------------------------- the window
def drawing(size: Size) -> Iterator[Line]:
    if not has_display():
        yield Line(13, "three new fields painted", bound=1.3, note="skipped: there is no display")
        return
    ours, peer, ratio, vertices = in_child(_drawing, size)
    yield Line(
        13,
        f"three new fields painted, {vertices:,}",
        ours,
        peer,
        ratio,
        bound=1.3,
        note="peer: one render of the same three panels",
    )


def stalls(size: Size) -> Iterator[Line]:
    if not has_display():
        yield Line(14, "longest stall of the window", bound=0.1, note="skipped: there is no display")
        return
    runs = [in_child(_stalls, size) for _ in range(size.rounds)]
    longest = statistics.median(stall for stall, _, _ in runs)
    yield Line(
        14,
        f"longest stall of the window in s, set-up at {runs[0][2]:,}",
        ours=longest,
        value=longest,
        bound=0.1,
        note=f"VTK's own renders ({max(render for _, render, _ in runs):.2f} s at most) not counted",
    )


def _drawing(size: Size) -> tuple[float, float, float, int]:
    vertices, faces = bumpy_sphere(size.window[0])
    with mesh_file(vertices, faces) as path, _window(path) as (application, window):
        _wait(application, lambda: window.session.is_complete)
        _wait_a_while(application, 0.5)
        session, panels = window.session, window.grid.panels
        painted = [0] * len(panels)
        for index, panel in enumerate(panels):
            panel.interactor.render_window.AddObserver("EndEvent", lambda *_, i=index: _count_up(painted, i))
        from dataclasses import replace

        turn = iter(range(1000))

        def show() -> None:
            before, k = list(painted), next(turn)
            for id, shown in list(session.shown.items()):
                rolled = replace(shown.answer, field=np.roll(shown.answer.field, k))
                session.shown[id] = replace(shown, answer=rolled)
                window.answer_changed(id)
            _wait(application, lambda: all(now > old for now, old in zip(painted, before, strict=True)))

        def render() -> None:
            for panel in panels:
                panel.interactor.render_window.Render()

        show()
        result = alternate(show, render, 3 * size.rounds, size.repeat)
    return result.our_time, result.peer_time, result.ratio, len(vertices)


def _stalls(size: Size) -> tuple[float, float, int]:
    """The longest time the window's thread did nothing else, less renders; the longest render; vertices."""
    from qtpy import QtCore

    vertices, faces = bumpy_sphere(size.window[1])
    with mesh_file(vertices, faces) as path, _window(path) as (application, window):
        rendering = _Stopwatch()
        gaps: list[float] = []
        last = [time.perf_counter()]

        def tick() -> None:
            now = time.perf_counter()
            gaps.append(now - last[0] - rendering.taken())
            last[0] = time.perf_counter()

        timer = QtCore.QTimer(interval=TICK_MS)
        timer.timeout.connect(tick)
        # From the first picture on, for which VTK also compiles its shaders.
        rendering.watch([panel.interactor.render_window for panel in window.grid.panels])
        timer.start()
        last[0] = time.perf_counter()
        _wait(application, lambda: window.session.is_complete)
        timer.stop()
    return max(gaps), rendering.longest, len(vertices)


class _Stopwatch:
    """How long render windows have been rendering."""

    def __init__(self) -> None:
        self.longest = self._sum = self._start = 0.0

    def watch(self, windows: list[Any]) -> None:
        for window in windows:
            window.AddObserver("StartEvent", lambda *_: self._begin())
            window.AddObserver("EndEvent", lambda *_: self._end())

    def taken(self) -> float:
        """Seconds since this was asked last."""
        taken, self._sum = self._sum, 0.0
        return taken

    def _begin(self) -> None:
        self._start = time.perf_counter()

    def _end(self) -> None:
        seconds = time.perf_counter() - self._start
        self._sum += seconds
        self.longest = max(self.longest, seconds)


def _count_up(counts: list[int], index: int) -> None:
    counts[index] += 1


@contextmanager
def _window(path: str):
    os.environ.setdefault("QT_API", "pyqt5")
    from qtpy import QtWidgets

    from app.document.document import comparison
    from app.qt.main_window import MainWindow
    from app.qt.start import build_panels

    application = QtWidgets.QApplication.instance() or QtWidgets.QApplication(["bench"])
    document = comparison(path, COMPARED)
    window = MainWindow(document)
    window.quiet, window.remembers = True, False
    window.show()
    application.processEvents()
    build_panels(window)
    # The first pictures, of nothing: the start has a row of its own.
    application.processEvents()
    window.show_document(document)
    try:
        yield application, window
    finally:
        window.close()
        application.processEvents()


def _wait(application: Any, done: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE
    while not done():
        if time.monotonic() > deadline:
            raise RuntimeError("The window did not get ready.")
        application.processEvents()
        time.sleep(0.0002)


def _wait_a_while(application: Any, seconds: float) -> None:
    start = time.monotonic()
    _wait(application, lambda: time.monotonic() - start > seconds)


@contextmanager
def mesh_file(vertices: np.ndarray, faces: np.ndarray) -> Iterator[str]:
    from bihdist_core import Surface
    from bihdist_core.formats.field_output import write_fields

    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder, "mesh.ply"))
        write_fields(path, Surface(vertices, faces), {"value": np.zeros(len(vertices))})
        yield path
