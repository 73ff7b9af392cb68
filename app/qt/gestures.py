"""What the mouse and the keys mean on the panels.  `window` is the main window."""

from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtWidgets

from bihdist_core.sources.source import Source

from ..document.edits import move_source
from ..document.perturbation_edits import show_in_row
from ..document.quantities import Quantity
from .anchor_gestures import AnchorGestures
from .docks.isoline_files import save_isolines
from .look.numbers import number
from .pair_gestures import PairGestures
from .pin_gestures import PinGestures
from .source_gestures import SourceGestures

if TYPE_CHECKING:
    from ..scene.picking import Hit

CLOSER = 2.0
"""By how much "zoom to it" enlarges."""

REST_MS = 200
"""How long the pointer has to be still for a live source to have arrived."""

LEAST_TOWARDS = 0.3
"""Cosine of the angle between a direction and an edge that still leads there."""


class Gestures:
    """See the module.

    is_live: whether the source follows the pointer; sources: what else is done to it; pins: the same of pins.
    """

    def __init__(self, window) -> None:
        self._window = window
        self._grid = grid = window.grid
        self._met: Hit | None = None  # what is under the pointer
        self._met_in = -1  # in which panel
        self.is_live = self.is_dragging = False
        self._has_followed = False  # the source, since it became live
        self.sources = SourceGestures(window)
        self.pins = PinGestures(window, self.sources)
        self.anchors, self.pairs = AnchorGestures(window), PairGestures(window)
        self._rest_soon = QtCore.QTimer(window, singleShot=True, interval=REST_MS)
        self._rest_soon.timeout.connect(self._release)
        self._stepped_soon = QtCore.QTimer(window, singleShot=True, interval=REST_MS)
        self._stepped_soon.timeout.connect(self._stepped)
        grid.clicked.connect(self._click)
        grid.dragged.connect(self._drag)
        grid.released.connect(self._release)
        grid.hovered.connect(self._hover)
        window.held_keys.live_key_up.connect(self._live_key_up)
        grid.menu_wanted.connect(self._open_menu)

    def begin(self) -> None:
        """Another surface is there."""
        self._met = None
        self.is_dragging = False
        self._rest_soon.stop()
        self._stepped_soon.stop()
        self.sources.begin()

    @property
    def hovered(self) -> int | None:
        """The vertex under the pointer."""
        return None if self._met is None else self._met.vertex

    # ------------------------------------------------------------------ the source
    def _click(self, panel: int, hit: "Hit") -> None:
        self._window.picked.emit(panel, hit)
        if self._window.docks.picking.is_on:
            self._window.docks.picking.take(panel, hit.vertex)
        elif self.anchors.are_meant(panel):
            self.anchors.put(panel, hit)
        elif self.pairs.are_meant(panel):
            self.pairs.put(panel, hit)
        else:
            self._move(panel, self.sources.at(panel, hit))

    def _move(self, panel: int, at: Source, **how: object) -> None:
        session = self._window.session
        session.show(move_source(session.document, panel, at), **how)

    def _drag(self, panel: int, mark: int, hit: "Hit") -> None:
        self.is_dragging = True
        (self.anchors if self.anchors.are_meant(panel) else self.sources).drag(panel, mark, hit)

    def _release(self) -> None:
        """The source has arrived: now all is answered, and what is late is said to be."""
        self._rest_soon.stop()
        self.is_dragging = False
        self.sources.rest()
        self.anchors.rest()
        self._window.session.show(self._window.session.document)

    def set_live(self, is_live: bool) -> None:
        """Let the source follow the pointer, or no longer."""
        if self.is_live and not is_live:
            self._release()
        self.is_live, self._has_followed = is_live, False

    def _live_key_up(self) -> None:
        """A key that was held while the source followed ends that; one that was tapped does not."""
        if self.is_live and self._has_followed:
            self._window.actions_by_word["live"].trigger()

    def step_source(self, right: int, up: int) -> None:
        """Along the edge that leads most nearly to where a direction of the screen points."""
        session, id = self._window.session, self._grid.active
        sources = session.document.panel(id).shows.points if id >= 0 else ()
        surface = session.surface_in(id)
        if surface is None or not sources:
            return
        panel = self._grid.panel(id)
        vertex = panel.source
        if vertex is None:
            return
        faces = surface.faces[(surface.faces == vertex).any(axis=1)]
        others = np.setdiff1d(faces, [vertex])
        at = panel.view.place_of(panel.positions[vertex])
        ways = []
        for other in others:
            place = panel.view.place_of(panel.positions[other])
            ways.append((place.x() - at.x(), at.y() - place.y()))
        ways = np.array(ways)
        towards = ways @ (right, up) / np.maximum(np.linalg.norm(ways, axis=1), 1e-9)
        if towards.max() > LEAST_TOWARDS:
            # Held, the key is a drag: stand-ins will do.
            is_held = self._stepped_soon.isActive()
            self._move(id, int(others[towards.argmax()]), key=f"steps in {id}", live=is_held)
            if is_held:
                self.sources.set_off()
            self._stepped_soon.start()

    def _stepped(self) -> None:
        """The last of several steps along edges was taken."""
        self.sources.rest()
        self._window.session.show(self._window.session.document, key=f"steps in {self._grid.active}")

    def remove_chosen(self) -> None:
        """The pair or the anchor that stands out."""
        if not self.pairs.remove_chosen():
            self.anchors.remove_chosen()

    # ------------------------------------------------------------------ the pointer
    def _hover(self, panel: int, hit: "Hit | None") -> None:
        window = self._window
        before, last, last_in = self.hovered, self._met, self._met_in
        self._met, self._met_in = hit, panel
        vertex = self.hovered
        is_beside = vertex is None and before is None and not self._grid.pointing.is_on
        if window.session.surface is None or is_beside:
            return
        if not self._grid.has(panel):  # it has gone from under the pointer
            self._met = None
            self._grid.pointing.leave()
            window.docks.pointed(None, "")
            window.status.show_place(None, None)
            return
        self._grid.pointing.show(panel, vertex)
        surface = window.session.surface_in(panel)
        window.docks.pointed(vertex, self._grid.panel(panel).surface)
        window.status.show_place(vertex, None if vertex is None else surface.vertices[vertex], self._letter(panel))
        is_led = self.is_live and not self.anchors.are_meant(panel)
        is_elsewhere = last is None or panel != last_in or self._at(panel, hit) != self._at(panel, last)
        if is_led and hit is not None and is_elsewhere:
            self.is_dragging = self._has_followed = True
            self.sources.set_off()
            if self.pairs.are_meant(panel):
                self.pairs.follow(panel, hit)
            else:
                self._move(panel, self.sources.at(panel, hit), key="live", live=True)
            self._rest_soon.start()

    def _at(self, panel: int, hit: "Hit | None") -> Source | None:
        return None if hit is None else self.sources.at(panel, hit)

    def _letter(self, panel: int) -> str:
        """Of the surface of a panel, where there are two."""
        return self._grid.panel(panel).head.letter

    def centre_here(self) -> None:
        """What is under the pointer comes into the middle, and is turned about."""
        if self._met is not None:
            self._grid.panel(self._met_in).view.centre(self._met.position)

    def zoom_here(self) -> None:
        """What is under the pointer, in the middle and larger."""
        if self._met is not None:
            self._zoom_to(self._met_in, self._met)

    def _zoom_to(self, panel: int, hit: "Hit") -> None:
        view = self._grid.panel(panel).view
        view.centre(hit.position)
        view.zoom(CLOSER)

    # ------------------------------------------------------------------ what is chosen
    def choose(self, panel: int, shows: Quantity) -> None:
        """Another quantity is a step; the values that a slider passes are one."""
        session = self._window.session
        before = session.document.panel(panel).shows
        words = [tuple(part.word for part in each.parts) for each in (before, shows)]
        key = f"{words[0]} in {panel}" if words[0] == words[1] else ""
        session.show(show_in_row(session.document, panel, shows), key)

    def _open_menu(self, panel: int, hit: "Hit | None", where: QtCore.QPoint) -> None:
        """On the surface: what can be done with the place; beside it, with the view."""
        window, actions = self._window, self._window.actions_by_word
        menu = QtWidgets.QMenu(window)
        if hit is not None:
            view, vertex = self._grid.panel(panel).view, hit.vertex
            self._grid.pointing.show(panel, vertex)
            if self.anchors.are_meant(panel):
                self.anchors.offer(menu, panel, hit)
            elif self.pairs.are_meant(panel):
                self.pairs.offer(menu, panel, hit)
            else:
                menu.addAction("Source here\tClick", lambda: self._click(panel, hit))
                self.sources.offer(menu, panel, hit)
            self.pins.offer(menu, panel, hit, where)
            menu.addSeparator()
            menu.addAction("Isoline through here", lambda: window.choices.isoline.pass_through(panel, vertex))
            if window.session.document.isolines.through:
                menu.addAction("Remove isolines through points", window.choices.isoline.pass_through_none)
            menu.addAction("Save isolines…", lambda: save_isolines(window, panel))
            menu.addAction("Save field…", lambda: window.field_files.save(panel))
            menu.addSeparator()
            menu.addAction("Centre the view here\tC", lambda: view.centre(hit.position))
            menu.addAction("Zoom to it\tZ", lambda: self._zoom_to(panel, hit))
            menu.addSeparator()
            menu.addAction(f"Copy vertex id {vertex}", lambda: _copy(str(vertex)))
            menu.addAction("Copy position", lambda: _copy(" ".join(f"{x:.9g}" for x in self._place(panel, vertex))))
            menu.addAction("Copy values", lambda: _copy(self._values(panel, vertex)))
        else:
            self.pins.offer(menu, panel, None, where)
            menu.addSeparator()
            for word in ("reset", "view before", "view after"):
                menu.addAction(actions[word])
            menu.addSeparator()
            for word in ("undo", "redo", "add panel"):
                menu.addAction(actions[word])
            menu.addSeparator()
            menu.addAction("Save field…", lambda: window.field_files.save(panel))
        menu.aboutToHide.connect(menu.deleteLater)
        menu.popup(where)

    def _place(self, panel: int, vertex: int) -> np.ndarray:
        return self._window.session.surface_in(panel).vertices[vertex]

    def _values(self, id: int, vertex: int) -> str:
        """What every panel of the same surface has there."""
        place = " ".join(number(x) for x in self._place(id, vertex))
        name = self._grid.panel(id).surface
        said = [panel.said_of(vertex) for panel in self._grid.panels if panel.surface == name]
        return "\n".join([f"vertex {vertex} at {place}", *said])


def _copy(text: str) -> None:
    QtWidgets.QApplication.clipboard().setText(text)
