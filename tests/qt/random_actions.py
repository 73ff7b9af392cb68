"""`python -m tests.qt.random_actions SEED COUNT FOLDER`: the real window under random hands. Prints JSON.

A process of its own, whose memory is the window's.
"""

import json
import os
import sys
import time
import traceback
from dataclasses import replace
from pathlib import Path

import numpy as np

from app.document.quantities import DistanceFrom
from app.document.settings import RANGE, SHADING, THEME
from app.document.tools import docked_tools
from app.qt.panels.quantity_menu import offered_kinds
from bihdist_core.distances.distance_types import Spec
from tests.qt.parts import parts

from .faults import faults
from .hands import rss
from .instrument_actions import InstrumentHands

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
DIALOGS_OF_FILES = {"open", "open beside", "save", "save as", "screenshot", "quit"}


class RandomHands(InstrumentHands):
    """Each of its actions is one of CHOICES."""

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
        if not len(panel.view.handles):
            return
        at = panel.view.place_of(panel.view.handles[0])
        at = panel.view.mapToGlobal(QtCore.QPoint(round(at.x() - 0.5), round(at.y() - 0.5)))
        if not self.is_over(panel.view, at):
            return  # the camera looks past it, or a dock is over it
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
        from app.qt.acts import ALL

        keys = [key for act in ALL if act.word not in DIALOGS_OF_FILES for key in act.keys]
        key = self.chance.choice(keys)
        self.done[-1] += f" {key}"
        self.key(key)
        if key == "G":
            for digit in str(self.chance.randint(0, 1200)):
                self.tool("key", digit)
            self.tool("key", self.chance.choice(["Return", "Escape", "Tab"]))
        self.shut()

    def menu(self) -> None:
        """By the right button; sometimes something is chosen."""
        self.tool("mousemove", *self.place(), "click", 3)
        if self.chance.random() < 0.4:
            downs = ["Down"] * self.chance.randint(1, 6)
            # What asks for a file has a loop of its own meanwhile.
            self.tool("key", "--delay", 8, *downs, "Return", "sleep", 0.2, "key", "--delay", 20, "Escape", "Escape")
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

        parts(self.window).choices.choose(self.panel(), quantity(self.chance.choice(QUANTITIES)))

    # ------------------------------------------------------------------ how it looks
    def isolines(self) -> None:
        choices, document = parts(self.window).isolines, self.window.session.document
        maxima = [shown.answer.maximum for shown in self.window.session.shown.values() if shown.answer.maximum]
        least, most = (min(maxima), max(maxima)) if maxima else (1.0, 1.0)
        way = self.chance.choice(["steps", "spacing", "values", "bold", "labels", "through", "none", "other"])
        if way == "steps":
            self.window.menus.isolines.actions()[self.chance.randrange(5)].trigger()
        elif way == "spacing":
            choices.spacing(f"{most / self.chance.randint(2, 40):.6g}")
        elif way == "values":
            choices.values(" ".join(f"{least * self.chance.random():.6g}" for _ in range(self.chance.randint(1, 5))))
        elif way == "bold":
            self.window.actions_by_word["bold_isolines"].trigger()
        elif way == "labels":
            self.window.actions_by_word["isoline_labels"].trigger()
        elif way == "through" and self.window.session.loaded() is not None:
            panel = self.panel()
            vertex = self.chance.choice(self.window.session.mesh(panel).surface.shape.faces.ravel().tolist())
            choices.pass_through(panel, vertex)
        elif way == "none":
            choices.pass_through_none()
        else:
            choices.steps((document.isolines.count * 7 + 1) % 100)

    def range(self) -> None:
        from app.document.looks import RANGES

        choices, session = parts(self.window).choices, self.window.session
        way = self.chance.choice([*RANGES, "typed", "taken"])
        panel = self.panel()
        if way == "typed":
            own = session.shown[panel].answer.maximum if panel in session.shown else 0.0
            choices.end_at(panel, self.chance.choice([None, (own or 1.0) * self.chance.uniform(0.2, 1.5)]))
        elif way == "taken":
            path = self.folder / "ends.json"
            if not path.exists() and session.loaded() is not None:
                parts(self.window).session_file.save(str(path))
            choices.ends.take(str(path))
        else:
            choices.set(RANGE, way)

    def colours(self) -> None:
        from app.scene.colour_maps import MAPS

        choices = parts(self.window).choices
        way = self.chance.choice(["map", "map", "file", "reversed", "bands"])
        if way == "map":
            choices.colour_map(self.chance.choice(["", *MAPS]))
        elif way == "file":
            path = self.folder / "own.txt"
            path.write_text("0.1 0.1 0.4\n0.9 0.4 0.2\n1 1 0.8\n")
            choices.take_colours(str(path))
        else:
            self.window.actions_by_word["flip_scalars" if way == "reversed" else "bands"].trigger()

    def shading(self) -> None:
        from app.document.looks import NORMALS

        if self.chance.random() < 0.4:
            self.window.actions_by_word["show_edges"].trigger()
        else:
            parts(self.window).choices.set(SHADING, self.chance.choice(NORMALS))

    def camera(self) -> None:
        from bihdist_core.analysis.upright import DIRECTIONS

        views, words = (
            parts(self.window).views,
            ["parallel_projection", "axes", "turntable", "view source", "copy camera"],
        )
        way = self.chance.choice([*words, "paste camera", "up", "up"])
        if way == "up":
            if self.window.session.loaded() is not None:
                views.set_up_axis(self.chance.choice(DIRECTIONS))
        else:
            if way == "paste camera":  # of what was copied before, or no camera at all
                self.window.actions_by_word["copy camera"].trigger()
                self.drag()
            self.window.actions_by_word[way].trigger()

    def export_dialog(self) -> None:
        """LoadedMesh, changed here and there, and closed; what is drawn meanwhile nobody waits for."""
        from app.qt.files.export_dialog import ExportDialog

        self.window.actions_by_word["figure"].trigger()
        self.spin(0.02)
        for dialog in [each for each in self.open_windows() if isinstance(each, ExportDialog)]:
            dialog.size.rows.buttons()[self.chance.randrange(5)].click()
            dialog.kinds.choose(self.chance.choice(["PNG", "PDF", "EPS"]))
            self.chance.choice([dialog.hints, dialog.shared, dialog.both, dialog.transparent, dialog.crop]).click()
            self.spin(self.chance.choice([0, 0.2, 0.5]))
            dialog.copying.emit(self.chance.choice(["command", "python"]), dialog.chosen())
        self.shut()

    def style(self) -> None:
        parts(self.window).choices.style(self.chance.choice(["paper", "uniform", "lines", "dark"]))

    def theme(self) -> None:
        parts(self.window).choices.set(THEME, self.chance.choice(["light", "dark", "desktop"]))

    def edit_panels(self) -> None:
        from app.document.panel_edits import panel_edits

        parts(self.window).choices.edit_panel(self.panel(), self.chance.choice([*panel_edits(), "Remove panel"]))

    def undo(self) -> None:
        for _ in range(self.chance.randint(1, 4)):
            self.key(self.chance.choice(["Ctrl+Z", "Ctrl+Z", "Ctrl+Shift+Z", "Ctrl+Y"]))

    def open(self) -> None:
        self.window.context.open(self.chance.choice(self.meshes))
        if self.chance.random() < 0.5:
            self.until(lambda: not self.window.session.is_opening)

    CHOICES = (
        (move, 14), (click, 12), (double_click, 2), (drag, 10), (drag_mark, 5), (wheel, 7), (press_key, 24),
        (menu, 6), (head_menu, 6), (resize, 5), (choose, 6), (isolines, 6), (range, 5), (colours, 5), (shading, 4),
        (camera, 5), (export_dialog, 2), (style, 3), (theme, 3), (edit_panels, 6), (undo, 6), (open, 2),
        *InstrumentHands.INSTRUMENTS,
    )  # fmt: skip

    def act(self) -> None:
        (action,) = self.chance.choices([a for a, _ in self.CHOICES], [weight for _, weight in self.CHOICES])
        self.done.append(action.__name__)
        begin = time.monotonic()
        action(self)
        self.times[action.__name__] = self.times.get(action.__name__, 0) + time.monotonic() - begin
        self.spin(self.chance.choice([0, 0, 0.02, 0.1]))
        if self.window.session.loaded() is None:  # a key has closed the mesh, and others have nothing to act on
            self.window.session.undo()
            self.until(lambda: self.window.session.loaded() is not None)
        self.widest = max(self.widest, self.window.width())
        self.rss.append(rss())

    def warm_up(self) -> None:
        """What is made once and kept: as many panels as there can be, the largest pictures, and all looks."""
        from app.document.edits import MOST_ADDED

        session, size = self.window.session, self.window.size()
        self.window.resize(1500, 950)
        count = len(session.document.panels)
        for _ in range(MOST_ADDED - count):
            parts(self.window).choices.add_panel()
        self.until(lambda: session.is_complete)
        self.spin(0.1)
        while len(session.document.panels) > count:
            parts(self.window).choices.edit_panel(session.document.panels[-1].id, "Remove panel")
        for word in docked_tools():
            parts(self.window).docks.toggle(word)
            self.spin(0.2)
        self.until(lambda: session.is_complete)
        for word in session.document.docks:
            parts(self.window).docks.close(word)
        self.window.resize(size)
        self.spin(0.1)
        self.try_looks()

    def try_distances(self) -> None:
        """Each distance once, and back to the first: what is prepared for one stays with its mesh."""
        session, choices = self.window.session, parts(self.window).choices
        panel = session.document.panels[0]
        for kind in offered_kinds():
            choices.choose(panel.id, DistanceFrom(Spec.of(kind.word)))
            self.until(lambda: session.is_complete)
        choices.choose(panel.id, panel.shows)
        self.until(lambda: session.is_complete)

    def try_looks(self) -> None:
        """Each look once, and back to the first: graphics drivers compile a program for each and keep it."""
        choices, acts = parts(self.window).choices, self.window.actions_by_word
        switches = (
            acts["show_edges"],
            acts["parallel_projection"],
            acts["axes"],
            acts["bands"],
            acts["isoline_labels"],
        )
        for style in ("uniform", "lines", "dark", "paper"):
            choices.style(style)
            self._try_normals(switches)
        scene, count = self.window.grid.panels[0].view.scene, len(self.window.session.mesh().surface.vertices)
        for has_colours in (False, True):
            if has_colours:
                scene.field_actor.show_colours(np.full((count, 3), 0.5))
            for selected in (np.zeros((count, 4), np.uint8), None):
                scene.field_actor.show_selected(selected)
                self._try_normals(switches[:1] * 2)
        self.try_distances()  # instead of the colours

    def _try_normals(self, switches: tuple) -> None:
        """All ways to shade, with switches on and off."""
        from app.document.looks import NORMALS

        for normals in reversed(NORMALS):  # the first is how it is at the beginning
            parts(self.window).choices.set(SHADING, normals)
            for switch in switches:  # an even number of times in all
                switch.trigger()
                self.spin()
                self.until(lambda: not any(panel.view.is_stale for panel in self.window.grid.panels))


def main() -> None:
    seed, count, folder = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    from app.qt.start import set_up_allocation

    begin = time.monotonic()
    set_up_allocation()
    hands = RandomHands(seed, folder)
    found_there = []
    try:
        for path in (*hands.meshes[1:], hands.meshes[0]):  # what is kept of each is there from the beginning
            hands.window.context.open(path)
            hands.until(lambda: not hands.window.session.is_opening and hands.window.session.is_complete)
            hands.try_distances()
        hands.warm_up()
        for _ in range(count):
            hands.act()
            if len(hands.errors) > 5:
                break
        found_there = faults(hands)
    except Exception:
        found_there.append(traceback.format_exc())
    found = {
        "errors": hands.errors,
        "freed": hands.freed,
        "times": hands.times,
        "faults": found_there,
        "widest": hands.widest,
        "screen": hands.screen.width(),
        "rss": hands.rss,
        "seconds": time.monotonic() - begin,
        "last": hands.done[-15:],
        "done": hands.done,
        "document": repr(replace(hands.window.session.document)),
    }
    print(json.dumps(found), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
