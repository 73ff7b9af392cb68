"""A tool of another package, found by its entry point, adds a dock and a gesture; nothing of ours knows it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.shapes import bumpy

pytest.importorskip("qtpy")

ROOT = Path(__file__).parents[2]

PACKAGE = {
    "ball_tool/__init__.py": """
from app.document.tools import Tool

TOOL = Tool(
    __name__, "ball", title="Ball", text="Vertices near a place", key="Ctrl+J", icon="info",
    dock="dock:BallDock", gesture="gestures:BallGestures",
)
""",
    "ball_tool/gestures.py": """
import numpy as np
from qtpy import QtCore

from app.qt.gesture import Gesture


class BallGestures(Gesture):
    found = QtCore.Signal(int)

    def is_on(self, panel):
        return "ball" in self.context.document.docks

    def click(self, panel, click):
        surface = self.context.session.surface_in(panel)
        away = np.linalg.norm(surface.vertices - click.hit.position, axis=1)
        self.found.emit(int((away < 0.5).sum()))
        self.context.tell("Counted")

    def offer(self, menu, panel, hit):
        menu.addAction("Count here")

    def put_down(self):
        return self.is_on(0) and not self.found.emit(0)
""",
    "ball_tool/dock.py": """
from qtpy import QtWidgets

from app.qt.docks.instrument import Instrument
from app.qt.docks.plain import fill

from .gestures import BallGestures


class BallDock(Instrument):
    word, title = "ball", "Ball"

    def __init__(self, context):
        super().__init__(context)
        self.count = QtWidgets.QLabel("0")
        fill(self, self.count)
        context[BallGestures].found.connect(lambda count: self.count.setText(str(count)))
""",
    "ball_tool-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: ball-tool\nVersion: 1\n",
    "ball_tool-1.dist-info/entry_points.txt": "[bihdist.tools]\nball = ball_tool:TOOL\n",
}

PROGRAM = """
import sys
import numpy as np
from app.qt.application import application, run_until
app = application()
from app.document.document import comparison
from app.qt.main_window import MainWindow
from app.qt.panels.events import Click, MenuWanted
from ball_tool.dock import BallDock
from qtpy import QtCore, QtWidgets

window = MainWindow(comparison(sys.argv[1]))
window.context.quiet, window.context.remembers = True, False
window.show()
window.build_panels()
window.open(sys.argv[1], 5)
run_until(lambda: window.session.is_complete)


def click():
    view = window.grid.panels[0].view
    places = (QtCore.QPoint(view.width() * x // 20, view.height() // 2) for x in range(1, 20))
    hit = next(hit for place in places if (hit := view.pick(place)))
    view.happened.emit(Click(hit))
    return hit


action = window.actions_by_word["dock ball"]
assert action.text() == "Vertices near a place" and action in window.menuBar().actions()[4].menu().actions()
action.trigger()
(dock,) = window.findChildren(BallDock)
hit = click()
near = int((np.linalg.norm(window.session.surface.vertices - hit.position, axis=1) < 0.5).sum())
assert near and dock.count.text() == str(near)
assert window.session.document.point("source").at == 5, "the click was not meant for the source"
assert window.status.message.text == "Counted"
window.grid.panels[0].view.happened.emit(MenuWanted(hit, QtCore.QPoint(5, 5)))
menu = QtWidgets.QApplication.activePopupWidget()
assert menu.actions()[0].text() == "Count here"
menu.close()
window.cancel()
assert dock.count.text() == "0"
action.trigger()
assert click().vertex == window.session.document.point("source").at
run_until(lambda: window.session.is_complete)
window.close()
print("done")
"""


def test_a_tool_of_another_package_adds_a_dock_and_what_a_click_means(application, mesh_file, tmp_path):
    for name, text in PACKAGE.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), str(tmp_path)])}
    command = [sys.executable, "-c", PROGRAM, str(mesh_file(bumpy(300)))]
    ran = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=tmp_path, timeout=300)
    assert (ran.returncode, ran.stdout) == (0, "done\n"), ran.stderr
