"""A pointer and keys, real ones (xdotool), on the real window."""

import os
import random
import subprocess
import sys
import time
import traceback
from collections.abc import Callable
from pathlib import Path

import numpy as np

from .events import ROUNDS

SYMS = {
    "+": "plus",
    "=": "equal",
    "-": "minus",
    "[": "bracketleft",
    "]": "bracketright",
    ",": "comma",
    "Esc": "Escape",
    "Enter": "KP_Enter",
}
STUCK = 2.0
"""Seconds after which whatever has a loop of its own is told Escape."""


class Hands:
    """The window, a pointer and keys."""

    def __init__(self, seed: int, folder: Path) -> None:
        """folder: for meshes, and for all that is written."""
        from app.document.document import COMPARISON, comparison
        from app.qt.application import application
        from app.qt.main_window import MainWindow
        from tests.shapes import bumpy, torus, two_pieces

        self.chance, self.folder = random.Random(seed), folder
        self.errors: list[str] = []
        sys.excepthook = lambda *error: self.errors.append("".join(traceback.format_exception(*error)))
        self.application = application()
        self.window = self.new_window(MainWindow, comparison("", COMPARISON))
        self.window.move(20, 20)
        self.screen = self.application.primaryScreen().geometry()
        self.meshes = [written(mesh, folder) for mesh in (bumpy(800), torus(40, 20), two_pieces(), bumpy(1500, 1))]
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
        window.context.quiet, window.context.remembers = True, False
        window.show()
        window.build_panels()
        return window

    # ------------------------------------------------------------------ time
    def spin(self, seconds: float = 0.0) -> None:
        end, rounds = time.monotonic() + seconds, 0
        while True:
            self._alive = time.monotonic()
            self.application.processEvents()
            rounds += 1
            if time.monotonic() >= end and rounds >= ROUNDS * seconds:
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
        widget = widget or self.chance.choice(self.window.grid.panels).view
        at = self._somewhere(widget)
        for _ in range(20):
            if self.is_over(widget, at):
                return at.x(), at.y()
            at = self._somewhere(widget)
        # Docks leave nothing to be seen of it: the end of the menu bar, where nothing is.
        bar = self.window.menuBar()
        at = bar.mapToGlobal(bar.rect().topRight())
        return at.x() - 2, at.y() + 2

    def is_over(self, widget: object, at: object) -> bool:
        """Whether a place on the screen is seen to be the widget's, and not of a dock that floats over it."""
        from qtpy import QtWidgets

        under = QtWidgets.QApplication.widgetAt(at)
        return under is not None and (under is widget or widget.isAncestorOf(under))

    def _somewhere(self, widget: object) -> object:
        from qtpy import QtCore

        x, y = self.chance.random(), self.chance.random()
        if self.chance.random() < 0.6:  # more often near the middle, where the surface is
            x, y = 0.25 + x / 2, 0.25 + y / 2
        # Only what is seen of it: beside it are the docks, or the page it is scrolled out of.
        seen = widget.visibleRegion().boundingRect() or widget.rect()
        return widget.mapToGlobal(seen.topLeft() + QtCore.QPoint(int(x * seen.width()), int(y * seen.height())))

    def panel(self) -> int:
        return self.chance.choice(self.window.session.document.panels).id

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


def rss() -> float:
    """The memory of this process in MB."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def written(surface, folder: Path) -> str:
    """The path of a mesh file."""
    path = folder / f"{surface.name}_{len(surface.vertices)}.off"
    with path.open("w") as out:
        out.write(f"OFF\n{len(surface.vertices)} {len(surface.faces)} 0\n")
        np.savetxt(out, surface.vertices, fmt="%.17g")
        np.savetxt(out, np.column_stack([np.full(len(surface.faces), 3), surface.faces]), fmt="%d")
    return str(path)
