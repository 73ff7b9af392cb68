"""`python -m tests.qt.random_moments SEED COUNT SIZE FOLDER`: work begun in the real window, Esc in the midst of it.

Then the window is clicked, changed, undone, given another mesh or closed at once, and has to show what is asked then.
SIZE: about how many vertices the meshes have that take a while.  Prints JSON: what is wrong, how long the window let
one wait, and what went on at Esc.
"""

import faulthandler
import json
import os
import sys
import time
import traceback
from collections import Counter
from pathlib import Path

import numpy as np

from app.document.quantities import DistanceFrom, quantity
from app.document.settings import THEME
from app.qt.start import set_up_allocation
from app.session.questions import source_at, vertex_at
from bihdist_core import Laplacian, Surface, write_mesh
from bihdist_core.distances.answers import Distances
from tests.core.mesh_samples import freesurfer, gltf, gltf_parts, stl_binary
from tests.qt.parts import parts
from tests.shapes import bumpy, grid, torus

from .hands import Hands

LONG = ("diffusion", "diffusion(t=1/4)", "truncated(k=60)", "geodesic(method=exact)", "geodesic(method=heat)")
SHORT = ("biharmonic", "geodesic(method=dijkstra)", "commute-time")
LONGEST = 1.5
"""Seconds from the beginning of work to Esc, at most."""
AFTERWARDS = 0.3
"""Seconds after Esc in which the window has to answer at every moment, too."""
MOST_PANELS = 4
PATIENCE = 120.0
SAME = 1e-6
"""Of the maximum, by which fields may differ that are found in another order."""
IDLE, BUSY = 1.0, 0.05
"""Seconds that a window is left alone, and the share of a processor that is too much then."""
TOLD_AFTER = 0.4
"""Seconds without an answer of the window after which it is written down what it is at."""


class MomentHands(Hands):
    """Each moment is work that is begun, Esc, and something else."""

    def __init__(self, seed: int, folder: Path, size: int) -> None:
        super().__init__(seed, folder)
        self.large = _large_meshes(folder, size)
        self.faults: list[str] = []
        self.waits: list[tuple[float, str]] = []
        self.phases: Counter[str] = Counter()
        self._known: dict[str, Distances] = {}
        self._diary = (folder / "stalls.txt").open("w")
        self._listen()

    def _listen(self) -> None:
        self.window.refused.connect(lambda words: self.faults.append(f"refused: {words}"))

    def spin(self, seconds: float = 0.0) -> None:
        faulthandler.dump_traceback_later(TOLD_AFTER, file=self._diary)
        super().spin(seconds)
        faulthandler.cancel_dump_traceback_later()

    # ------------------------------------------------------------------ what is begun
    def read(self) -> None:
        self.window.context.open(self.chance.choice(self.large))

    def read_beside(self) -> None:
        self.window.session.open_second_mesh(self.chance.choice(self.large))

    def repair(self) -> None:
        """A cut, and sometimes the way back of it."""
        session, context = self.window.session, self.window.context
        if context.active is None:
            return  # nothing is open
        shown = session.document.panel(context.active.id)
        if session.document.mesh(shown.surface).repairs.cut:
            parts(self.window).repairs.put_back()
            return
        mask = np.ones(len(session.mesh(shown.id).surface.vertices), int)
        mask[: self.chance.randrange(1, len(mask) // 3)] = 0
        path = self.folder / f"mask {self.chance.randrange(10)}.npy"
        np.save(path, mask)
        parts(self.window).repairs.cut(str(path))

    def set_up(self) -> None:
        """A mesh is there, and what it takes for distances is not."""
        self.read()
        self.until(lambda: not self.window.session.is_opening)

    def solve(self) -> None:
        for _ in range(self.chance.randint(1, 8)):
            self.click()

    def choose_long(self) -> None:
        parts(self.window).choices.choose(self.panel(), quantity(self.chance.choice(LONG)))

    def paint(self) -> None:
        choices, surface = parts(self.window).choices, self.window.session.mesh().surface
        way = self.chance.choice(["style", "theme", "size", "through", "shading"])
        if way == "style":
            choices.style(self.chance.choice(["paper", "uniform", "lines", "dark"]))
        elif way == "theme":
            choices.set(THEME, self.chance.choice(["light", "dark"]))
        elif way == "size":
            self.window.resize(self.chance.randint(640, 1500), self.chance.randint(480, 950))
        elif way == "through":
            corners = surface.faces.ravel().tolist()
            parts(self.window).isolines.pass_through(self.panel(), self.chance.choice(corners))
        else:
            self.window.actions_by_word["show_edges"].trigger()

    BEGINNINGS = (read, read, read_beside, repair, set_up, solve, choose_long, choose_long, paint)

    # ------------------------------------------------------------------ what follows
    def click(self) -> None:
        """Somewhere in a panel, as near its middle as the surface is met; the source has to go there."""
        from qtpy import QtCore, QtTest

        session = self.window.session
        panel = self.chance.choice(self.window.grid.panels)
        for _ in range(30):
            x, y = (0.5 + 0.3 * self.chance.uniform(-1, 1) for _ in range(2))
            at = QtCore.QPoint(round(x * panel.view.width()), round(y * panel.view.height()))
            hit = panel.view.pick(at)
            over = panel.view.over.points.standing_at(QtCore.QPointF(at))
            if hit is not None and over is None and panel.view.mark_at(at) < 0:  # a mark is taken hold of, and stays
                break
        else:
            return
        QtTest.QTest.mouseClick(panel.view, QtCore.Qt.MouseButton.LeftButton, pos=at)
        document = session.document
        names = document.panel(panel.id).shows.points
        known = vertex_at(document.point(names[0]).at, session.mesh(panel.id).surface) if names else hit.vertex
        corners = session.mesh(panel.id).surface.faces
        if known != hit.vertex and not (np.isin(corners, [known, hit.vertex]).sum(axis=1) == 2).any():
            shown = session.document.panel(panel.id)
            self.faults.append(f"a click at vertex {hit.vertex}, {at} puts the source of {shown} at {known}: {hit}")

    def change(self) -> None:
        parts(self.window).choices.choose(self.panel(), quantity(self.chance.choice(SHORT)))

    def undo(self) -> None:
        for _ in range(self.chance.randint(1, 4)):
            self.window.actions_by_word[self.chance.choice(["undo", "undo", "redo"])].trigger()

    def edit_panels(self) -> None:
        words = ["Duplicate panel", "Remove panel", "Move panel right"]
        count = len(self.window.session.document.panels)
        parts(self.window).choices.edit_panel(self.panel(), self.chance.choice(words[count >= MOST_PANELS :]))

    def open(self) -> None:
        self.window.context.open(self.chance.choice(self.meshes))

    def shut_window(self) -> None:
        """While all goes on; another window opens a mesh."""
        from app.document.document import COMPARISON, comparison

        begin, own = time.monotonic(), time.thread_time()
        self.window.close()
        self.spin()
        self._wait_of(begin, own, "the window is closed")
        self.window.deleteLater()
        self.window = self.new_window(type(self.window), comparison("", COMPARISON))
        self._listen()
        self.open()

    FOLLOWING = (click, click, change, undo, edit_panels, open, shut_window)

    # ------------------------------------------------------------------ a moment
    def moment(self) -> None:
        """Begin something, press Esc, do something else, and look whether all is as it was asked for."""
        begun, then = self.chance.choice(self.BEGINNINGS), self.chance.choice(self.FOLLOWING)
        self.done.append(f"{begun.__name__}, {then.__name__}")
        begun(self)
        self._escape(time.monotonic() + LONGEST * self.chance.random() ** 2)
        if then is not MomentHands.shut_window and self.chance.random() < 0.3:
            begun(self)  # again, and what follows comes at some moment of it
            self.spin(self.chance.choice([0, 0.05, 0.4]))
        then(self)
        self.spin()
        self._look()

    def _escape(self, moment: float) -> None:
        """Press Esc then, which the window may be too busy to see; how long it takes until it answers."""
        from qtpy import QtCore, QtTest

        own = time.thread_time()
        while time.monotonic() < moment:
            own = time.thread_time()
            self.spin()
        going = " and ".join(sorted({words.partition(":")[0] for _, words in self.window.session.progress.values()}))
        self.phases[going or "nothing"] += 1
        QtTest.QTest.keyClick(self.window, QtCore.Qt.Key.Key_Escape)
        self.spin()
        self.spin()
        self._wait_of(moment, own, f"Esc in {self.done[-1]}: {going}")
        last = time.monotonic()
        while last < moment + AFTERWARDS:
            own = time.thread_time()
            self.spin()
            self._wait_of(last, own, f"after Esc in {self.done[-1]}: {going}")
            last = time.monotonic()

    def _wait_of(self, begin: float, own: float, words: str) -> None:
        """begin, own: when it began, by the clock and by the processor time of the window's thread."""
        seconds, own = time.monotonic() - begin, time.thread_time() - own
        words = f"{words} ({own:.2f} s of processor time)"
        self.waits.append((round(seconds, 3), words))
        if seconds > TOLD_AFTER:
            print(f"-- {seconds:.2f} s: {words}\n", file=self._diary, flush=True)

    def _look(self) -> None:
        """Once a click more is answered, each panel shows the field of a surface that nobody has worked on."""
        session, choices = self.window.session, parts(self.window).choices
        self.until(lambda: not session.is_opening, PATIENCE)
        for id in [panel.id for panel in session.document.panels][MOST_PANELS:]:
            choices.edit_panel(id, "Remove panel")
        for panel in session.document.panels:
            if str(panel.shows) not in SHORT:
                choices.choose(panel.id, quantity(self.chance.choice(SHORT)))
        self.spin(0.02)
        if session.loaded() is not None:
            self.click()
        if not self.until(lambda: session.is_complete and not session.progress, PATIENCE):
            self.faults.append(f"never complete: {session.progress}, {session.document.surfaces}")
            return
        document = session.document
        for panel in document.panels:
            shown, surface = session.shown[panel.id].answer, session.mesh(panel.id).surface
            if not isinstance(panel.shows, DistanceFrom):
                continue
            source = source_at(document.point(panel.shows.point).at, surface)
            field = self._distances(document.mesh(panel.surface), surface).answer(panel.shows.spec, source).field
            if shown.field is None or np.shape(field) != shown.field.shape:
                self.faults.append(f"panel {panel.id} shows {shown.failure or 'a field of another mesh'}")
            elif not np.allclose(shown.field, field, rtol=0, atol=SAME * np.nanmax(field), equal_nan=True):
                self.faults.append(f"panel {panel.id} shows another field than {panel.shows} from {source}")
            if self.window.grid.panel(panel.id).answer is not shown:
                self.faults.append(f"panel {panel.id} shows something old")

    def rest(self) -> None:
        """Let Qt wait for what does not come, and see what that costs."""
        from qtpy import QtCore

        shares: list[float] = []
        while not shares or (shares[-1] > BUSY and len(shares) < 10):  # what has been given up may still end
            loop, begin = QtCore.QEventLoop(), time.process_time()
            QtCore.QTimer.singleShot(round(1000 * IDLE), loop.quit)
            loop.exec()
            shares.append((time.process_time() - begin) / IDLE)
        if shares[-1] > BUSY:
            self.faults.append(f"a window at rest takes {shares[-1]:.0%} of a processor")

    def _distances(self, mesh: object, surface: Surface) -> Distances:
        """Those of a copy of a surface, which is a mesh's."""
        name = f"{mesh.path} {mesh.repairs}"
        if name not in self._known:
            while len(self._known) > 5:
                del self._known[next(iter(self._known))]
            self._known[name] = Distances(Laplacian(Surface(surface.vertices.copy(), surface.faces.copy())))
        return self._known[name]


def _large_meshes(folder: Path, size: int) -> list[str]:
    """Paths of meshes whose reading, set-up and fields take a while each, in several formats."""
    side = round(size**0.5)
    round_one, flat, ring = bumpy(size), grid(side, side), torus(3 * side // 2, 2 * side // 3)
    for name, surface in (("a.off", round_one), ("a.obj", flat), ("a.ply", ring)):
        write_mesh(folder / name, surface)
    (folder / "a.stl").write_bytes(stl_binary(flat.vertices, flat.faces))
    (folder / "lh.white").write_bytes(freesurfer(ring.vertices, ring.faces))
    (folder / "a.gltf").write_bytes(gltf(*gltf_parts(flat.vertices, flat.faces, "<u4")))
    return [str(folder / name) for name in ("a.off", "a.obj", "a.ply", "a.stl", "lh.white", "a.gltf")]


def main() -> None:
    seed, count, size, folder = *map(int, sys.argv[1:4]), Path(sys.argv[4])
    set_up_allocation()
    hands = MomentHands(seed, folder, size)
    hands.open()
    hands.until(lambda: hands.window.session.is_complete, PATIENCE)
    try:
        for _ in range(count):
            hands.moment()
            if len(hands.errors) + len(hands.faults) > 5:
                break
        hands.rest()
    except Exception:
        hands.errors.append(traceback.format_exc())
    found = {
        "errors": hands.errors,
        "faults": hands.faults,
        "waits": sorted(hands.waits, reverse=True)[:20],
        "phases": hands.phases,
        "done": hands.done,
    }
    print(json.dumps(found), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
