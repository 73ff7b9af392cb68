"""The real window in the hands of a script, with a pointer (xdotool); it makes pictures of the screen."""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from qtpy import QtCore, QtGui

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 300.0
STILL = 0.3


@dataclass(frozen=True)
class Look:
    """A theme in a window of a size in logical pixels, each of them `scale` device pixels."""

    theme: str
    width: int
    height: int
    scale: float = 1

    @property
    def word(self) -> str:
        return f"{self.theme}-{self.width}x{self.height}" + (f"@{self.scale:g}" if self.scale > 1 else "")


def drive_elsewhere(look: Look, module: str, words: Sequence[object], margin: int = 0) -> None:
    """Run `python -m module words` on a screen of its own (Xvfb), which the look fills but for a margin in pixels."""
    width, height = (round(side * look.scale) + margin for side in (look.width, look.height))
    command = ["xvfb-run", "-a", "-s", f"-screen 0 {width}x{height}x24 -dpi 96", sys.executable, "-m", module]
    with tempfile.TemporaryDirectory() as home:
        scale = {"QT_SCALE_FACTOR": str(look.scale)} if look.scale > 1 else {}
        env = {**os.environ, **scale, "XDG_DATA_HOME": home}
        subprocess.run([*command, *map(str, words)], cwd=ROOT, check=True, env=env)


class Driver:
    """A window in the hands of a script, with a pointer.

    out: a folder for its pictures, made if it is not there.  closed, bounded: meshes for scenes that need a boundary or
    none, as paths or names of samples.
    """

    def __init__(self, look: Look, out: Path, closed: str = "beast", bounded: str = "scan") -> None:
        from app.document.document import COMPARISON, comparison
        from app.qt.application import application
        from app.qt.look.look import LOOK
        from app.qt.main_window import MainWindow

        self.look, self._out, self._count = look, out, 0
        self.closed, self.bounded = closed, bounded
        self._out.mkdir(parents=True, exist_ok=True)
        self.application = application()
        LOOK.choose(look.theme)
        self.window = MainWindow(comparison("", COMPARISON))
        self.window.move(0, 0)
        self.window.resize(look.width, look.height)
        self.window.show()
        self.spin(0.1)
        self.window.build_panels()

    def spin(self, seconds: float = STILL) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.application.processEvents()
            time.sleep(0.005)

    def until(self, condition: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end:
                self.shot("not ready")
                raise RuntimeError("The window did not get ready.")
            self.spin(0.02)

    def complete(self) -> None:
        self.until(lambda: self.window.session.is_complete and not self.window.session.progress)
        self.spin()

    def open(self, path: object) -> None:
        self.window.context.open(str(path))
        self.until(lambda: not self.window.session.is_opening)
        self.complete()

    def shot(self, name: str) -> None:
        """What is on the screen now."""
        self.spin()
        self._count += 1
        self.screen_picture().save(str(self._out / f"{self._count:02}_{name.replace(' ', '_')}.png"))

    def screen_picture(self) -> "QtGui.QPixmap":
        """What is on the screen, without the pointer."""
        return self.application.primaryScreen().grabWindow(0)

    def on_screen(self, at: "QtCore.QPoint") -> tuple[int, int]:
        """A place of the screen as the pointer counts, in device pixels."""
        return round(at.x() * self.look.scale), round(at.y() * self.look.scale)

    @staticmethod
    def tool(*words: object) -> None:
        subprocess.run(["xdotool", *map(str, words)], check=True)

    def pointer(self, *words: object) -> None:
        self.tool(*words)
        self.spin(0.2)

    def point(self, panel: int, x: float, y: float) -> None:
        """To a place of a view, as shares of its width and height."""
        from qtpy import QtCore

        view = self.window.grid.panels[panel].view
        at = view.mapToGlobal(QtCore.QPoint(round(x * view.width()), round(y * view.height())))
        self.pointer("mousemove", *self.on_screen(at))

    def point_at_surface(self, panel: int = 0) -> None:
        """To the surface, where it is met first on the way from the middle."""
        from qtpy import QtCore

        view = self.window.grid.panels[panel].view
        for step in range(40):
            x, y = 0.5 + 0.011 * step * (-1) ** step, 0.5 + 0.007 * step
            if view.pick(QtCore.QPoint(round(x * view.width()), round(y * view.height()))) is not None:
                self.point(panel, x, y)
                return

    def close_dialogs(self) -> None:
        from qtpy import QtWidgets

        for each in self.application.topLevelWidgets():
            if isinstance(each, QtWidgets.QDialog | QtWidgets.QMenu) and each.isVisible():
                each.close()
        self.spin(0.1)

    def shot_while(self, act: Callable[[], object], name: str) -> None:
        """Of what stays open until it is answered."""
        from qtpy import QtCore

        def look() -> None:
            self.shot(name)
            self.close_dialogs()

        QtCore.QTimer.singleShot(400, look)
        act()

    def with_menu(self, button: str, name: str) -> None:
        menu = self.window.tool_bar.buttons[button].menu()
        from qtpy import QtCore

        menu.popup(
            self.window.tool_bar.buttons[button].mapToGlobal(
                QtCore.QPoint(0, self.window.tool_bar.buttons[button].height())
            )
        )
        self.shot(name)
        menu.hide()
