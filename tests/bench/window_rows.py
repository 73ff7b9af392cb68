"""Rows 10 and 12 to 14: the session without a window, the start, and the real window on the display there is."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from bihdist_core.distances.distance_types import Spec
from tests.qt.events import ROUNDS
from tests.qt.parts import parts
from tests.silent_view import SilentView

from .case import EXACT, main_case
from .child import in_window_child
from .meshes import bumpy_sphere
from .size import Size
from .table import Line, compared
from .timing import alternate, timed

ROOT = Path(__file__).resolve().parents[2]
COMPARED = Spec.of("biharmonic"), Spec.of("geodesic", method="heat"), Spec.of("diffusion")
PATIENCE = 600.0
"""Seconds after which something has gone wrong."""
TICK_MS = 2
"""How often the window's thread is asked for a sign of life."""
CLICK_BOUND = 1.1
STILL = 0.3
"""Seconds after which nothing that a click has begun is still to be drawn."""


# ---------------------------------------------------------------------- the session, without drawing
def click(size: Size) -> Iterator[Line]:
    """Biharmonic, heat geodesic and diffusion, asked for at once as a click does."""
    from app.document.document import comparison
    from app.document.edits import move_source
    from app.session.session import Session

    case = main_case(size)
    view = SilentView()
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
            ("first picture", 5.5, ["-m", "app", "view", size.sample, "--screenshot", picture], True),
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
    """A click on a place whose answers are kept, up to the screen; and what it and pointing have drawn."""
    if not has_display():
        yield Line(13, "click to three panels painted", bound=CLICK_BOUND, note="skipped: there is no display")
        return
    ours, peer, ratio, drawn, drawn_by_pointing, hit, vertices = in_window_child(size, _drawing, size)
    yield Line(
        13,
        f"click to three panels painted, {vertices:,}",
        ours,
        peer,
        ratio,
        bound=CLICK_BOUND,
        note="answers kept; peer: the same three pictures drawn",
    )
    yield Line(13, "pictures drawn for a click", value=drawn, bound=3, note="three panels; the most of all clicks")
    yield Line(
        13,
        f"pictures drawn while pointing at {size.pointed} places",
        value=drawn_by_pointing,
        bound=0,
        note=f"{hit} of them on the surface",
    )


def stalls(size: Size) -> Iterator[Line]:
    if not has_display():
        yield Line(14, "longest stall of the window", bound=0.06, note="skipped: there is no display")
        return
    # Once: it lasts a minute or more, in which the window's thread is asked thousands of times.
    longest, picture, vertices = in_window_child(size, _stalls, size)
    yield Line(
        14,
        f"longest stall of the window in s, set-up at {vertices:,}",
        ours=longest,
        value=longest,
        bound=0.06,
        note=f"until it is known how accurate all fields are; drawing by VTK ({picture:.2f} s at most) not counted",
    )


def _drawing(size: Size) -> tuple[float, float, float, int, int, int, int]:
    """Seconds of a click, of three pictures, and their ratio; pictures for a click, for pointing; places; vertices."""
    from app.qt.panels.events import Click

    vertices, faces = bumpy_sphere(size.window[0])
    with mesh_file(vertices, faces) as path, _window(path) as (application, window):
        _wait(application, lambda: window.session.is_complete)
        offscreen, panels = window.grid.offscreen, window.grid.panels
        view, paints = panels[0].view, _Paints([panel.view for panel in panels])
        places = [_place(view, 0.5 + x, 0.5) for x in (-0.1, 0.1)]
        for place in places:
            view.happened.emit(Click(view.pick(place)))
            _wait(application, lambda: window.session.is_complete)
        _wait_until_still(application, window)
        turn = iter(range(10_000))

        def click() -> None:
            paints.begin()
            view.happened.emit(Click(view.pick(places[next(turn) % 2])))
            _wait(application, paints.are_done)

        def draw() -> None:
            for panel in panels:
                offscreen.picture(panel.view.scene, panel.view.pixels)

        def pictures_of(work: Callable[[], None]) -> int:
            before = offscreen.pictures
            work()
            _wait_until_still(application, window)
            return offscreen.pictures - before

        click()
        result = alternate(click, draw, 3 * size.rounds, size.repeat)
        _wait_until_still(application, window)
        drawn = max(pictures_of(click) for _ in range(4))
        hit: set[int | None] = set()
        drawn_by_pointing = pictures_of(lambda: hit.update(_point(application, window, view, size.pointed)))
    return result.our_time, result.peer_time, result.ratio, drawn, drawn_by_pointing, len(hit - {None}), len(vertices)


class _Paints:
    """Which of some widgets have been painted since `begin`."""

    def __init__(self, widgets: list[Any]) -> None:
        from qtpy import QtCore

        class Filter(QtCore.QObject):
            def eventFilter(_, watched: Any, event: Any) -> bool:
                if event.type() == QtCore.QEvent.Type.Paint:
                    self._missing.discard(watched)
                return False

        self._widgets, self._missing, self._filter = widgets, set(widgets), Filter()
        for widget in widgets:
            widget.installEventFilter(self._filter)

    def begin(self) -> None:
        self._missing = set(self._widgets)

    def are_done(self) -> bool:
        """Asked between events, so that a painting that has begun is over."""
        return not self._missing


def _place(view: Any, x: float, y: float) -> Any:
    """A point of a view, from shares of its width and its height."""
    from qtpy import QtCore

    return QtCore.QPoint(round(x * view.width()), round(y * view.height()))


def _point(application: Any, window: Any, view: Any, count: int) -> Iterator[int | None]:
    """Move the pointer over so many places of a view, without a button; the vertices that are met."""
    from qtpy import QtCore, QtGui

    none = QtCore.Qt.MouseButton.NoButton
    for step in range(count):
        place = _place(view, 0.3 + 0.4 * step / count, 0.4 + 0.2 * (step % 7) / 7)
        here, there = QtCore.QPointF(place), QtCore.QPointF(view.mapToGlobal(place))
        keys = QtCore.Qt.KeyboardModifier.NoModifier
        move = QtGui.QMouseEvent(QtCore.QEvent.Type.MouseMove, here, there, none, none, keys)
        application.sendEvent(view, move)
        application.processEvents()
        yield parts(window).gestures.hovered


def _stalls(size: Size) -> tuple[float, float, int]:
    """The longest time the window's thread did nothing else, less drawing; the longest picture; vertices."""
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
        rendering.watch(window.grid.offscreen)
        timer.start()
        last[0] = time.perf_counter()
        session = window.session

        def is_final(panel: int) -> bool:
            return session.is_answered(panel) and session.shown[panel].answer.is_final

        _wait(application, lambda: all(is_final(panel.id) for panel in session.document.panels))
        timer.stop()
    return max(gaps), rendering.longest, len(vertices)


class _Stopwatch:
    """How long a board has been drawing."""

    def __init__(self) -> None:
        self.longest = self._sum = 0.0

    def watch(self, offscreen: Any) -> None:
        picture = offscreen.picture

        def measured(*how: Any) -> np.ndarray:
            seconds, pixels = timed(lambda: picture(*how))
            self._sum += seconds
            self.longest = max(self.longest, seconds)
            return pixels

        offscreen.picture = measured

    def taken(self) -> float:
        """Seconds since this was asked last."""
        taken, self._sum = self._sum, 0.0
        return taken


@cache
def application() -> Any:
    """Qt's, which is kept: without it what outlives a window is gone, and there could be no second one."""
    os.environ.setdefault("QT_API", "pyqt5")
    from qtpy import QtWidgets

    return QtWidgets.QApplication(["bench"])


@contextmanager
def _window(path: str):
    qt = application()
    from app.document.document import comparison
    from app.qt.main_window import MainWindow
    from app.qt.start import build_panels

    document = comparison(path, COMPARED)
    window = MainWindow(document)
    window.context.quiet, window.context.remembers = True, False
    window.show()
    qt.processEvents()
    build_panels(window)
    # The start page: the start has a row of its own.
    qt.processEvents()
    window.show_document(document)
    try:
        yield qt, window
    finally:
        window.close()
        qt.processEvents()


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


def _wait_until_still(application: Any, window: Any) -> None:
    """Wait until all is answered and drawn, and no picture has come for STILL and so many rounds of events."""
    offscreen, session = window.grid.offscreen, window.session
    drawn, rounds, since = -1, 0, 0.0

    def is_still() -> bool:
        nonlocal drawn, rounds, since
        is_busy = session.progress or not session.is_complete or any(p.view.is_stale for p in window.grid.panels)
        if is_busy or offscreen.pictures != drawn:
            drawn, rounds, since = offscreen.pictures, 0, time.monotonic()
        rounds += 1
        return rounds > ROUNDS * STILL and time.monotonic() - since > STILL

    _wait(application, is_still)


@contextmanager
def mesh_file(vertices: np.ndarray, faces: np.ndarray) -> Iterator[str]:
    from bihdist_core import Surface
    from bihdist_core.formats.field_output import write_fields

    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder, "mesh.ply"))
        write_fields(path, Surface(vertices, faces), {"value": np.zeros(len(vertices))})
        yield path
