"""`python -m tests.qt.random_actions SEED COUNT FOLDER`: the real window under random hands. Prints JSON.

Pointer and keys are real (xdotool).  A process of its own, whose memory is the window's.
"""

import json
import os
import random
import subprocess
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

QUANTITIES = (
    "biharmonic",
    "geodesic(method=dijkstra)",
    "diffusion(t=1/4)",
    "diffusion",
    "truncated(k=20)",
    "commute-time",
    "biharmonic - geodesic(method=heat)",
    "raw diffusion - commute-time",
)
DIALOGS_OF_FILES = {"open", "save", "save as", "screenshot", "quit"}
SYMS = {
    "+": "plus",
    "=": "equal",
    "-": "minus",
    "[": "bracketleft",
    "]": "bracketright",
    ",": "comma",
    "Esc": "Escape",
}
SLACK = 0.002
"""Share of pixels that may differ from those of a window that was never touched: its numbers come in another order."""

STUCK = 2.0
"""Seconds after which whatever has a loop of its own is told Escape."""


class Hands:
    """The window, a pointer and keys."""

    def __init__(self, seed: int, folder: Path) -> None:
        from app.document.document import COMPARISON, comparison
        from app.qt.application import application
        from app.qt.main_window import MainWindow
        from tests.shapes import bumpy, torus, two_pieces

        self.chance = random.Random(seed)
        self.errors: list[str] = []
        sys.excepthook = lambda *error: self.errors.append("".join(traceback.format_exception(*error)))
        self.application = application()
        self.window = self.new_window(MainWindow, comparison("", COMPARISON))
        self.window.move(20, 20)
        self.screen = self.application.primaryScreen().geometry()
        self.meshes = [_written(mesh, folder) for mesh in (bumpy(800), torus(40, 20), two_pieces(), bumpy(1500, 1))]
        self.widest = 0
        self.rss: list[float] = []
        self.done: list[str] = []
        self.freed: list[str] = []
        self.times: dict[str, float] = {}
        self._alive = time.monotonic()
        from qtpy import QtCore

        self._watch = QtCore.QTimer(interval=200)
        self._watch.timeout.connect(self._free)
        self._watch.start()

    @staticmethod
    def new_window(kind: type, document: object) -> object:
        window = kind(document)
        window.quiet, window.remembers = True, False
        window.show()
        window.build_panels()
        return window

    # ------------------------------------------------------------------ time
    def spin(self, seconds: float = 0.0) -> None:
        end = time.monotonic() + seconds
        while True:
            self._alive = time.monotonic()
            self.application.processEvents()
            if time.monotonic() >= end:
                break
            time.sleep(0.002)

    def until(self, condition: Callable[[], bool], seconds: float = 60) -> bool:
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                return False
            self.spin(0.01)
        return True

    def settle(self) -> bool:
        """Until all is answered and painted."""
        session = self.window.session
        is_there = self.until(lambda: not session.is_opening and session.is_complete and not session.progress)
        self.spin(0.5)
        return is_there

    def _free(self) -> None:
        """Out of loops that Qt runs by itself (a modal dialog), which no step of ours can end."""
        if time.monotonic() - self._alive > STUCK:
            self._alive = time.monotonic()
            for widget in (self.application.activePopupWidget(), self.application.activeModalWidget()):
                if widget is not None:
                    self.freed.append(f"{type(widget).__name__} after {self.done[-3:]}")
                    widget.close()

    # ------------------------------------------------------------------ hands
    def tool(self, *words: object) -> None:
        """xdotool, while the window goes on working."""
        process = subprocess.Popen(["xdotool", *map(str, words)])
        while process.poll() is None:
            self.spin(0.002)
        self.spin(0.01)

    def key(self, keys: str) -> None:
        self.window.activateWindow()
        *modifiers, key = keys.replace("++", "+plus").split("+") if keys != "+" else ["plus"]
        words = [*(modifier.lower() for modifier in modifiers), SYMS.get(key, key.lower() if len(key) == 1 else key)]
        self.tool("key", "--clearmodifiers", "+".join(words))

    def place(self, widget: object | None = None) -> tuple[int, int]:
        """Somewhere in a widget, in a view if None."""
        from qtpy import QtCore

        widget = widget or self.chance.choice(self.window.grid.panels).view
        x, y = self.chance.random(), self.chance.random()
        if self.chance.random() < 0.6:  # more often near the middle, where the surface is
            x, y = 0.25 + x / 2, 0.25 + y / 2
        at = widget.mapToGlobal(QtCore.QPoint(int(x * widget.width()), int(y * widget.height())))
        return at.x(), at.y()

    def panel(self) -> int:
        return self.chance.choice(self.window.session.document.panels).id

    # ------------------------------------------------------------------ actions
    def move(self) -> None:
        self.tool("mousemove", *self.place(self.window if self.chance.random() < 0.3 else None))

    def click(self) -> None:
        self.tool("mousemove", *self.place(), "click", 1)

    def double_click(self) -> None:
        self.tool("mousemove", *self.place(), "click", "--repeat", 2, "--delay", 20, 1)

    def drag(self) -> None:
        (x, y), (to_x, to_y) = self.place(), self.place()
        steps = [("mousemove", x + (to_x - x) * k // 5, y + (to_y - y) * k // 5, "sleep", 0.01) for k in range(1, 6)]
        shift = self.chance.random() < 0.2
        button = self.chance.choice([1, 1, 2, 3])
        words = ["mousemove", x, y, *(("keydown", "shift") if shift else ()), "mousedown", button]
        words += [word for step in steps for word in step]
        self.tool(*words, "mouseup", button, *(("keyup", "shift") if shift else ()))

    def drag_mark(self) -> None:
        """That of the source, where it is."""
        from qtpy import QtCore

        panel = self.chance.choice(self.window.grid.panels)
        if panel.view.source is None:
            return
        at = panel.view.place_of(panel.view.source)
        at = panel.view.mapToGlobal(QtCore.QPoint(round(at.x() - 0.5), round(at.y() - 0.5)))
        x, y = at.x(), at.y()
        to_x, to_y = self.place(panel.view)
        words = ["mousemove", x, y, "mousedown", 1]
        for k in range(1, 6):
            words += ["mousemove", x + (to_x - x) * k // 5, y + (to_y - y) * k // 5, "sleep", 0.01]
        self.tool(*words, "mouseup", 1)

    def wheel(self) -> None:
        self.tool("mousemove", *self.place(), "click", "--repeat", self.chance.randint(1, 4), "--delay", 5,
                  self.chance.choice([4, 5]))  # fmt: skip

    def press_key(self) -> None:
        from app.qt.actions import ALL

        keys = [key for act in ALL if act.word not in DIALOGS_OF_FILES for key in act.keys]
        key = self.chance.choice(keys)
        self.done[-1] += f" {key}"
        self.key(key)
        if key == "G":
            for digit in str(self.chance.randint(0, 1200)):
                self.tool("key", digit)
            self.tool("key", self.chance.choice(["Return", "Escape", "Tab"]))
        self.shut()

    def shut(self) -> None:
        """What is open over the window."""
        for _ in range(6):
            if self.open_windows():
                self.tool("key", "Escape")
                self.spin(0.03)
        for widget in self.open_windows():
            # Without a window manager a dialog that is not modal may have no keys.
            widget.close()

    def open_windows(self) -> list:
        from qtpy import QtCore, QtWidgets

        def is_over(widget: QtWidgets.QWidget) -> bool:
            is_pop_up = widget.windowType() == QtCore.Qt.WindowType.Popup
            return widget.isVisible() and (is_pop_up or isinstance(widget, QtWidgets.QDialog))

        return [widget for widget in self.application.topLevelWidgets() if is_over(widget)]

    def menu(self) -> None:
        """By the right button; sometimes something is chosen."""
        self.tool("mousemove", *self.place(), "click", 3)
        if self.chance.random() < 0.4:
            self.tool("key", "--delay", 8, *["Down"] * self.chance.randint(1, 6), "Return")
        self.shut()

    def head_menu(self) -> None:
        """A control of a head is clicked, and the keys choose; menus of buttons have a loop of their own meanwhile."""
        head = self.chance.choice(self.window.grid.panels).head
        inside = [head.name, head.more, head.info, *head.controls]
        words = ["mousemove", *self.place(self.chance.choice([w for w in inside if w.isVisible()])), "click", 1]
        if self.chance.random() < 0.7:
            words += ["sleep", 0.05, "key", "--delay", 8, *["Down"] * self.chance.randint(1, 9), "Return"]
        self.tool(*words, "sleep", 0.05, "key", "--delay", 20, "Escape", "Escape", "Escape")
        self.shut()

    def resize(self) -> None:
        self.window.resize(self.chance.randint(640, 1500), self.chance.randint(480, 950))
        self.spin(0.02)

    def choose(self) -> None:
        from app.document.quantities import quantity

        self.window.gestures.choose(self.panel(), quantity(self.chance.choice(QUANTITIES)))

    def isolines(self) -> None:
        self.window.menus.isolines.actions()[self.chance.randrange(5)].trigger()

    def range(self) -> None:
        self.window.choices.range(self.chance.choice(["own", "shared"]))

    def style(self) -> None:
        self.window.choices.style(self.chance.choice(["paper", "uniform", "lines", "dark"]))

    def theme(self) -> None:
        self.window.choices.theme(self.chance.choice(["light", "dark", "desktop"]))

    def edit_panels(self) -> None:
        from app.document.edits import PANEL_EDITS

        self.window.choices.edit_panel(self.panel(), self.chance.choice([*PANEL_EDITS, "Remove it"]))

    def undo(self) -> None:
        for _ in range(self.chance.randint(1, 4)):
            self.key(self.chance.choice(["Ctrl+Z", "Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+Y"]))

    def open(self) -> None:
        self.window.open(self.chance.choice(self.meshes))
        if self.chance.random() < 0.5:
            self.until(lambda: not self.window.session.is_opening)

    CHOICES = (
        (move, 14), (click, 12), (double_click, 2), (drag, 10), (drag_mark, 5), (wheel, 7), (press_key, 24),
        (menu, 6), (head_menu, 6), (resize, 5), (choose, 6), (isolines, 3), (range, 3), (style, 3), (theme, 3),
        (edit_panels, 6), (undo, 6), (open, 2),
    )  # fmt: skip

    def act(self) -> None:
        (action,) = self.chance.choices([a for a, _ in self.CHOICES], [weight for _, weight in self.CHOICES])
        self.done.append(action.__name__)
        begin = time.monotonic()
        action(self)
        self.times[action.__name__] = self.times.get(action.__name__, 0) + time.monotonic() - begin
        self.spin(self.chance.choice([0, 0, 0.02, 0.1]))
        self.widest = max(self.widest, self.window.width())
        self.rss.append(_rss())

    def warm_up(self) -> None:
        """What is made once and kept: as many panels as there can be, and the largest pictures."""
        from app.document.edits import MOST_ADDED

        session, size = self.window.session, self.window.size()
        self.window.resize(1500, 950)
        count = len(session.document.panels)
        for _ in range(MOST_ADDED - count):
            self.window.choices.add_panel()
        self.until(lambda: session.is_complete)
        self.spin(0.1)
        while len(session.document.panels) > count:
            self.window.choices.edit_panel(session.document.panels[-1].id, "Remove it")
        self.window.resize(size)
        self.spin(0.1)

    # ------------------------------------------------------------------ what is there in the end
    def faults(self) -> list[str]:
        """What the panels show and should not."""
        if self.window.isFullScreen():
            self.window.toggle_full_screen()
        self.window.actions_by_word["live"].setChecked(False)
        self.window.gestures.set_live(False)
        self.window.guide.end_tour()
        self.shut()
        self.tool("mousemove", self.screen.width() - 2, self.screen.height() - 2)
        self.window.session.show(self.window.session.document)  # what was stopped is asked again
        if not self.settle():
            return [f"never complete: {self.window.session.progress}, {self.done[-10:]}"]
        return [*self._untrue(), *self._stale()]

    def _untrue(self) -> list[str]:
        from app.qt.look.canvas import canvas_style
        from app.qt.look.look import LOOK
        from app.qt.panels.quantity_menu import quantity_name
        from app.session.questions import questions, vertex_at

        window, found = self.window, []
        session, document = window.session, window.session.document
        asked = questions(document)
        if [panel.id for panel in window.grid.panels] != [panel.id for panel in document.panels]:
            found.append("other panels than the document's")
        for panel in document.panels:
            widget, shown = window.grid.panel(panel.id), session.shown[panel.id]
            answer, reading = widget.answer, widget.bar._reading
            top = window.grid._maximum(panel.id) or answer.maximum
            facts = {
                "answer": answer is shown.answer and shown.asked == asked[panel.id] and not shown.is_preview,
                "head": widget.head.shows == panel.shows and widget.head.name.text() == quantity_name(panel.shows),
                "style": widget.view.scene.style == canvas_style(window.page.style, LOOK.theme),
                "source": widget.source == _start(panel, document, session, vertex_at),
                "not dimmed": not widget.view._is_dimmed and widget.waiting.isHidden(),
                "maximum": answer.field is None or (reading.maximum == answer.maximum and reading.high == top),
                "unit": answer.field is None or reading.unit == answer.unit,
                "isolines": answer.field is None or len(reading.lines) == len(widget.view.scene.isolines),
            }
            found += [f"panel {panel.id} {panel.shows}: {fact}" for fact, holds in facts.items() if not holds]
        sources = document.sources
        known = vertex_at(sources[0], session.surface) if sources else None
        if window.source_box.text() != ("" if known is None else str(known)):
            found.append(f"the box says {window.source_box.text()!r}, the document {known}")
        if window.windowTitle() != f"{session.surface.name} - Biharmonic distance":
            found.append(f"title {window.windowTitle()}")
        if window.status.counts.text.split()[0].replace(",", "") != str(len(session.surface.vertices)):
            found.append(f"counts {window.status.counts.text}")
        if window.status.vertex.text:
            found.append(f"still pointed at {window.status.vertex.text}")
        return found

    def _stale(self) -> list[str]:
        """Pictures that are others when all is drawn again, shown again, or shown in a new window."""
        window, found = self.window, []
        before = self.pictures(window)
        window.grid.redraw()
        found += _differing("drawn again", before, self.pictures(window))
        window._show_all_again()
        self.spin(0.3)
        found += _differing("shown again", before, self.pictures(window))
        other = self.new_window(type(window), window.session.document)
        other.page = window.page
        other.wear()
        other.resize(window.size())
        other.show_document(window.session.document)
        self.until(lambda: other.session.is_complete)
        self.spin(0.5)
        found += _differing("in a new window", before, self.pictures(other), SLACK)
        if self.kept:
            from PIL import Image

            for name, pictures in (("old", before), ("new", self.pictures(other))):
                for k, picture in enumerate(pictures):
                    Image.fromarray(picture).save(self.kept / f"{name}{k}.png")
            window.grab().save(str(self.kept / "window.png"))
            other.grab().save(str(self.kept / "other.png"))
        other.close()
        return found

    kept: Path | None = Path(os.environ["BIHDIST_KEPT"]) if os.environ.get("BIHDIST_KEPT") else None

    def pictures(self, window: object) -> list[np.ndarray]:
        return [panel.view.shot() for panel in window.grid.panels]


def _start(panel, document, session, vertex_at) -> int | None:
    names = panel.shows.points
    return vertex_at(document.point(names[0]).at, session.surface) if names else None


def _differing(when: str, before: list, after: list, slack: float = 0.0) -> list[str]:
    if [picture.shape for picture in before] != [picture.shape for picture in after]:
        return [f"{when}: sizes {[p.shape for p in before]}, {[p.shape for p in after]}"]
    parts = [float((a != b).any(axis=2).mean()) for a, b in zip(before, after, strict=True)]
    return [f"{when}: panel at {k} differs in {part:.4%}" for k, part in enumerate(parts) if part > slack]


def _rss() -> float:
    """In MB."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def _written(surface, folder: Path) -> str:
    path = folder / f"{surface.name}_{len(surface.vertices)}.off"
    with path.open("w") as out:
        out.write(f"OFF\n{len(surface.vertices)} {len(surface.faces)} 0\n")
        np.savetxt(out, surface.vertices, fmt="%.17g")
        np.savetxt(out, np.column_stack([np.full(len(surface.faces), 3), surface.faces]), fmt="%d")
    return str(path)


def main() -> None:
    seed, count, folder = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    from app.qt.start import share_arenas

    begin = time.monotonic()
    share_arenas()
    hands = Hands(seed, folder)
    for path in (*hands.meshes[1:], hands.meshes[0]):  # what is kept of each is there from the beginning
        hands.window.open(path)
        hands.until(lambda: not hands.window.session.is_opening and hands.window.session.is_complete)
    hands.warm_up()
    for _ in range(count):
        hands.act()
        if len(hands.errors) > 5:
            break
    seconds = time.monotonic() - begin
    try:
        faults = hands.faults()
    except Exception:
        faults = [traceback.format_exc()]
    found = {
        "errors": hands.errors,
        "freed": hands.freed,
        "times": hands.times,
        "faults": faults,
        "widest": hands.widest,
        "screen": hands.screen.width(),
        "rss": hands.rss,
        "seconds": seconds,
        "last": hands.done[-15:],
        "done": hands.done,
        "document": repr(replace(hands.window.session.document)),
    }
    print(json.dumps(found), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
