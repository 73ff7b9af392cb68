"""What random hands do with the instruments: pins, brushes, drawn and typed sources, and all that is in docks."""

from dataclasses import replace

from app.document.on_surface import clear_surface, hide, is_hidden, remove_items, surface_items
from app.document.shared_parts.pins import Pins
from app.document.tools import docked_tools
from app.tools.correspondence.maps import Maps
from app.tools.correspondence.pairs import Pairs
from app.tools.profile.part import Profile
from app.tools.regions.part import DividedPanels
from tests.qt.parts import parts

from .hands import Hands

SOURCES = ("12+40", "f3:0.2,0.5", "loop:0", "5+f9:0.3,0.3", "7", "f1:2,2", "nowhere")
ASKING = ("save", "read", "…")
"""Buttons and menus whose words hold this ask for a file."""


class InstrumentHands(Hands):
    def pin(self) -> None:
        self._click_with("shift")

    def add_source(self) -> None:
        self._click_with("ctrl")

    def _click_with(self, key: str) -> None:
        self.tool("mousemove", *self.place(), "keydown", key, "click", 1, "keyup", key)

    def brush(self) -> None:
        """With the key held, or Ctrl besides."""
        keys = ["b", *(["ctrl"] if self.chance.random() < 0.3 else [])]
        self.window.activateWindow()
        self._drag([word for key in keys for word in ("keydown", key)], [w for key in keys for w in ("keyup", key)])

    def live(self) -> None:
        """The source follows the pointer, for a while."""
        self.key("L")
        for _ in range(4):
            self.tool("mousemove", *self.place())
        self.key("L")

    def draw_source(self) -> None:
        self.window.actions_by_word["draw source"].trigger()
        self._drag([], [])
        self.key("Esc")
        if parts(self.window).sources.is_drawing:
            self.window.actions_by_word["draw source"].trigger()

    def _drag(self, before: list, after: list) -> None:
        (x, y), (to_x, to_y) = self.place(), self.place()
        self.tool("mousemove", x, y, *before, "mousedown", 1)
        for k in range(1, 7):
            self.tool("mousemove", x + (to_x - x) * k // 6, y + (to_y - y) * k // 6)
        self.tool("mouseup", 1, *after)

    def type_source(self) -> None:
        text = self.chance.choice(SOURCES)
        self.key("G")
        self.tool("type", "--delay", 4, text)
        self.tool("key", self.chance.choice(["Return", "Escape"]), "key", "Escape")

    # ------------------------------------------------------------------ docks
    def _dock(self):
        """One that is open, or is now."""
        docks = parts(self.window).docks
        loaded = self.window.session.document.docks
        if not loaded or (len(loaded) < 3 and self.chance.random() < 0.5):
            docks.toggle(self.chance.choice([word for word in docked_tools() if word not in loaded]))
            self.spin(0.05)
        loaded = self.window.session.document.docks
        return docks._docks[self.chance.choice(loaded)] if loaded else None

    def toggle_dock(self) -> None:
        parts(self.window).docks.toggle(self.chance.choice(list(docked_tools())))

    def in_dock(self) -> None:
        """The pointer goes somewhere in a dock, and clicks, drags or turns the wheel there."""
        from qtpy import QtCore, QtWidgets

        dock = self._dock()
        if dock is None or not dock.isVisible():
            return
        dock.raise_()
        x, y = self.place(dock)
        self.done[-1] += f" {dock.word}"
        at = dock.mapFromGlobal(QtCore.QPoint(x, y))
        under = dock.childAt(at)
        said = f"{under.toolTip()} {under.accessibleName()} {getattr(under, 'text', str)()}".lower() if under else ""
        way = self.chance.choice(["click", "click", "move", "drag", "wheel", "right"])
        self.tool("mousemove", x, y)
        if way == "drag" and not isinstance(under, QtWidgets.QAbstractButton):
            to_x, to_y = self.place(dock)
            corners = [("mousemove", *corner, "sleep", 0.02) for corner in ((to_x, y), (to_x, to_y), (x, to_y))]
            # In one go: a row that is dragged has a loop of its own, which ends with the button.
            self.tool("mousedown", 1, *(word for corner in corners for word in corner), "mouseup", 1)
        elif way == "wheel":
            self.tool("click", self.chance.choice([4, 5]))
        elif way in ("click", "right") and not any(word in said for word in ASKING):
            # A menu has a loop of its own meanwhile.
            self.tool("click", 1 if way == "click" else 3, "sleep", 0.05, "key", "--delay", 20, "Escape", "Escape")
        self.shut()

    def dock_menu(self) -> None:
        """Something of the menus in a dock, but what asks for a file."""
        from qtpy import QtWidgets

        dock = self._dock()
        if dock is None:
            return
        found = [menu for menu in dock.findChildren(QtWidgets.QMenu) if menu.isEnabled()]
        if not found:
            return
        menu = self.chance.choice(found)
        menu.aboutToShow.emit()
        actions = [a for a in menu.actions() if a.isEnabled() and a.text() and not a.menu() and "…" not in a.text()]
        if actions:
            action = self.chance.choice(actions)
            self.done[-1] += f" {dock.word}: {action.text()}"
            action.trigger()
        self.shut()

    def move_dock(self) -> None:
        from qtpy import QtCore

        dock = self._dock()
        if dock is None:
            return
        areas, way = QtCore.Qt.DockWidgetArea, self.chance.choice(["float", "left", "right", "below", "size"])
        if way == "float":
            dock.setFloating(not dock.isFloating())
        elif way == "size":
            self.window.resizeDocks([dock], [self.chance.randint(150, 500)], QtCore.Qt.Orientation.Horizontal)
        else:
            dock.setFloating(False)
            area = {"left": areas.LeftDockWidgetArea, "right": areas.RightDockWidgetArea}
            self.window.addDockWidget(area.get(way, areas.BottomDockWidgetArea), dock)
            dock.show()

    def profile(self) -> None:
        from app.tools.profile.part import WAYS

        session = self.window.session
        document = session.document
        names = [pin.point for pin in document[Pins].pins]
        points = tuple(self.chance.sample(names, 2)) if len(names) > 1 and self.chance.random() < 0.5 else ()
        across = (1.0, 0.2, 0.1) if self.chance.random() < 0.5 else None
        profile = replace(document[Profile], points=points, way=self.chance.choice(WAYS), across=across)
        session.show(document.with_part(profile))

    def regions(self) -> None:
        from app.tools.regions.part import show_regions

        session = self.window.session
        if len(session.document[Pins].pins) > 1:
            panel = self.panel()
            session.show(show_regions(session.document, panel, panel not in session.document[DividedPanels].regions))

    def on_the_surface(self) -> None:
        """An eye or a bin of the list; everything goes only now and then."""
        session = self.window.session
        document = session.document
        items = surface_items(document)
        if items and session.loaded() is not None:
            item = self.chance.choice([each for group in items for each in (group, *group.members)])
            if self.chance.random() < 0.05:
                session.show(clear_surface(document))
            elif item.word and self.chance.random() < 0.7:
                session.show(hide(document, item, not is_hidden(document, item)))
            else:
                session.show(remove_items(document, [item]))

    def farthest(self) -> None:
        dock = self._dock() and parts(self.window).docks._docks.get("regions")
        if dock is not None and not dock.isHidden():
            dock.content.sampler.count.setValue(self.chance.randint(2, 6))
            if dock.content.sampler.pin.isEnabled():
                dock.content.sampler.pin.click()

    def interpolate(self) -> None:
        """Interpolants, or distances again; then a click is an anchor."""
        docks = parts(self.window).docks
        if "anchors" not in self.window.session.document.docks:
            docks.toggle("anchors")
            self.spin(0.05)
        dock = docks._docks["anchors"].content
        if dock.start.isVisible():
            dock.begin()
        elif self.chance.random() < 0.15:
            dock.end_tool()
        for _ in range(self.chance.randint(1, 3)):
            self.tool("mousemove", *self.place(), "click", 1)

    def in_anchors(self) -> None:
        """A row of the list: its eye, slider and keys, samples, and the panels' Delete."""
        docks = parts(self.window).docks
        dock = docks._docks["anchors"].content if "anchors" in docks._docks else None
        if dock is None or not dock.rows or not dock.isVisible():
            return
        row = self.chance.choice(list(dock.rows.values()))
        way = self.chance.choice(["eye", "keys", "slide", "samples", "delete"])
        self.done[-1] += f" {way}"
        if way == "eye":
            row.eye.activated.emit()
        elif way == "keys":
            row.slider.setFocus()
            self.tool("key", self.chance.choice(["Down", "Up", "Left", "Right", "Delete"]))
        elif way == "slide":
            row.slider.setValue(self.chance.randint(0, row.slider.maximum()))
        elif way == "samples":
            dock.samples.count.setValue(self.chance.randint(1, 3))
            dock.samples.add_them()
        else:
            self.window.grid.focus()
            self.tool("key", "Delete")

    def perturb_mesh(self) -> None:
        """Noise, holes, fewer vertices, a stroke that cuts; or as it was."""
        docks = parts(self.window).docks
        if "robustness" not in self.window.session.document.docks:
            docks.toggle("robustness")
            self.spin(0.05)
        dock = docks._docks["robustness"].content
        way = self.chance.choice(["noise", "vertices", "holes", "radius", "seed", "cut", "remove"])
        self.done[-1] += f" {way}"
        if not dock._controls.isEnabled():
            return
        if way in ("noise", "vertices", "holes", "radius"):
            slider = getattr(dock, way).slider
            for _ in range(self.chance.randint(1, 3)):
                slider.setValue(self.chance.randint(0, slider.maximum()))
                self.spin(0.05)
        elif way == "seed":
            dock.another.click()
        elif way == "cut":
            dock.cut.button.click()
            self._drag([], [])
            self.key("Esc")
        else:
            dock.remove()

    def correspond(self) -> None:
        """A second mesh with the tool, or the first alone again; then clicks are points of pairs."""
        session, docks = self.window.session, parts(self.window).docks
        if len(session.document.surfaces) < 2:
            session.open_second_mesh(self.chance.choice(self.meshes[:2]))
            self.until(lambda: not session.is_opening)
        elif self.chance.random() < 0.3:
            session.close_second_mesh()
            return
        if "pairs" not in session.document.docks:
            docks.toggle("pairs")
            self.spin(0.05)
        dock = docks._docks["pairs"].content
        if dock.start.isVisible():
            dock.begin()
        for _ in range(self.chance.randint(2, 4)):
            self.tool("mousemove", *self.place(), "click", 1)

    def in_pairs(self) -> None:
        """A row of the list, a drop, and the keys of the tool."""
        docks, document = parts(self.window).docks, self.window.session.document
        dock = docks._docks["pairs"].content if "pairs" in docks._docks else None
        if dock is None or not document[Pairs].pairs or not dock.isVisible():
            return
        way = self.chance.choice(["accept", "give up", "delete", "keys", "drop", "more"])
        self.done[-1] += f" {way}"
        if way in ("accept", "give up", "delete"):
            self.window.grid.focus()
            self.tool("key", {"accept": "Return", "give up": "Escape", "delete": "Delete"}[way])
        elif way == "keys":
            self.chance.choice(list(dock.rows.values())).setFocus()
            self.tool("key", self.chance.choice(["Down", "Up", "Delete"]))
        elif way == "drop":
            self._drag_drop()
        else:
            from app.tools.correspondence.pairs import add_pairs

            ids = [(self.chance.randrange(700), self.chance.randrange(700)) for _ in range(3)]
            self.window.session.show(add_pairs(document, ids))

    def _drag_drop(self) -> None:
        """One of a pair, by its head, where it is seen."""
        from qtpy import QtCore

        view = self.chance.choice(self.window.grid.panels).view
        seen = view.over.points.standing("pairs")
        if not seen:
            return
        _, (x, y) = self.chance.choice(seen)
        at = view.mapToGlobal(QtCore.QPoint(round(x), round(y) - 16))
        if not self.is_over(view, at):
            return
        to_x, to_y = self.place(view)
        words = ["mousemove", at.x(), at.y(), "mousedown", 1]
        for k in range(1, 6):
            words += ["mousemove", at.x() + (to_x - at.x()) * k // 5, at.y() + (to_y - at.y()) * k // 5, "sleep", 0.01]
        self.tool(*words, "mouseup", 1)

    def in_maps(self) -> None:
        """The section of errors: what is right, full maps, the map of a file, the chart."""
        docks, document = parts(self.window).docks, self.window.session.document
        dock = docks._docks["pairs"].content if "pairs" in docks._docks else None
        if dock is None or not dock.isVisible() or not dock.errors.isVisible():
            return
        section, truth = dock.errors, dock.errors.truth
        way = self.chance.choice(["map", "truth", "samples", "file", "partners", "mirror", "chart"])
        self.done[-1] += f" {way}"
        if way == "map" and section.full.isEnabled():
            section.full.click()
        elif way == "truth":
            truth._choose(word=self.chance.choice(["auto", "none"]), file=None)
        elif way == "samples":
            truth._choose(samples=self.chance.choice([5, 40]))
        elif way in ("file", "partners"):
            # Of the wrong length now and then.
            count = len(section.asked.one.surface.vertices) if section.asked is not None else 3
            path = self.folder / f"map{self.chance.randrange(3)}.txt"
            path.write_text("".join(f"{self.chance.randint(-1, 700)}\n" for _ in range(count)))
            take = truth.take_partners if way == "partners" else self.chance.choice([truth.take, truth.take_map])
            take(str(path))
        elif way == "mirror" and document[Maps].truth.partners is not None:
            section.mirror.click()
        elif way == "chart" and section.chart.isVisible():
            at = section.chart.mapToGlobal(section.chart.rect().center())
            self.tool("mousemove", at.x(), at.y())

    INSTRUMENTS = (
        (pin, 8), (add_source, 5), (brush, 4), (live, 2), (draw_source, 3), (type_source, 3), (toggle_dock, 5),
        (in_dock, 14), (dock_menu, 6), (move_dock, 4), (profile, 4), (regions, 3), (farthest, 2),
        (on_the_surface, 5),
        (interpolate, 4), (in_anchors, 5), (perturb_mesh, 5), (correspond, 5), (in_pairs, 8),
        (in_maps, 7),
    )  # fmt: skip
