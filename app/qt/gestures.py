"""Gestures on the panels: each event goes to the gesture of the tool that is on."""

from qtpy import QtCore, QtWidgets

from ..document.document import Document, content
from ..document.tools import tools
from ..drawing.numbers import coordinates
from ..scene.picking import Hit
from .choices import IsolineChoices
from .context import Context
from .dragging import Dragging
from .files.field_files import FieldFiles, save_isolines
from .gesture import Gesture
from .held_keys import HeldKeys
from .panels.events import Click, Hover, MarkClick, MarkDrag, MarkRelease, MenuWanted, SecondClick
from .snapping import Snapping

CLOSER = 2.0
"""By how much "zoom in here" enlarges."""

REST_MS = 200
"""How long the pointer has to be still for what it leads to have arrived."""


class Gestures(QtCore.QObject):
    """Passes the events of the pointer on to the gestures; `is_live` says whether the source follows the pointer."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context, self._grid = context, context.grid
        self._dragging = context[Dragging]
        made = [context[tool.load(tool.gesture)] for tool in tools() if tool.gesture]
        self._all: list[Gesture] = sorted(made, key=lambda gesture: gesture.turn)
        self.is_live = False
        self._has_followed = False  # what is led, since the pointer leads it
        self._rest_soon = QtCore.QTimer(self, singleShot=True, interval=REST_MS, timeout=self._release)
        events = self._grid.events
        self._clicked: Document | None = None  # what the last click made of the document
        events.on(Click, self._click)
        events.on(SecondClick, lambda panel, _: self._take_back_click())
        events.on(MarkClick, self._click_mark)
        events.on(MarkDrag, self._drag)
        events.on(MarkRelease, lambda panel, mark: self._release(mark.tool))
        events.on(Hover, lambda panel, hover: self._hover(panel, hover.hit))
        events.on(MenuWanted, self._open_menu)
        context[HeldKeys].live_key_up.connect(self._live_key_up)

    def begin(self) -> None:
        """Start on another surface."""
        self._context.hit = None
        self._dragging.is_on = False
        self._rest_soon.stop()
        for gesture in self._all:
            gesture.begin()

    def _on(self, panel: int) -> Gesture:
        """Return the gesture of the tool that is on in a panel."""
        return next(gesture for gesture in self._all if gesture.is_on(panel))

    def _of(self, tool: str) -> list[Gesture]:
        """Return the gestures of a pin marker's tool; with "" those without a tool."""
        return [gesture for gesture in self._all if gesture.tool == tool]

    # ------------------------------------------------------------------ clicks and drags
    def _click(self, panel: int, click: Click) -> None:
        if click.is_plain:
            self._context.picked.emit(panel, click.hit)
        before = self._context.document
        next(gesture for gesture in self._all if gesture.takes(panel, click)).click(panel, click)
        after = self._context.document
        self._clicked = after if content(after) != content(before) else None

    def _take_back_click(self) -> None:
        """A double click only centres the view: its first click is undone, unless something else was done since."""
        if self._clicked is not None and self._clicked == self._context.document:
            self._context.session.take_back()

    def _click_mark(self, panel: int, mark: MarkClick) -> None:
        for gesture in self._of(mark.tool):
            gesture.click_mark(panel, mark.number, mark.has_ctrl)

    def _drag(self, panel: int, mark: MarkDrag) -> None:
        if not mark.tool:
            self._dragging.is_on = True
        for gesture in self._of(mark.tool) if mark.tool else [self._on(panel)]:
            gesture.drag(panel, mark.number, mark.hit)

    def _release(self, tool: str = "") -> None:
        """End a drag: ask for every final answer, and say which panels are late."""
        if not tool:
            self._rest_soon.stop()
            self._dragging.is_on = False
        for gesture in self._of(tool):
            gesture.release()
        self._context.session.show(self._context.document)

    # ------------------------------------------------------------------ the keys
    def cancel(self) -> bool:
        """Return the pointer to its usual work; False if it did that already."""
        if any(gesture.cancel() for gesture in self._all if gesture.turn):
            return True
        if self.is_live:
            self._context.actions["live"].trigger()
            return True
        return any(gesture.cancel() for gesture in self._all if not gesture.turn)

    def remove_chosen(self) -> None:
        """Remove the highlighted mark."""
        any(gesture.remove_chosen() for gesture in reversed(self._all))

    def accept(self) -> None:
        """Accept what is proposed."""
        for gesture in self._all:
            gesture.accept()

    def set_live(self, is_live: bool) -> None:
        """Let the source follow the pointer, or no longer."""
        if self.is_live and not is_live:
            self._release()
        self.is_live, self._has_followed = is_live, False

    def _live_key_up(self) -> None:
        """A key that was held while the source followed ends that; one that was tapped does not."""
        if self.is_live and self._has_followed:
            self._context.actions["live"].trigger()

    # ------------------------------------------------------------------ the pointer
    @property
    def hovered(self) -> int | None:
        """The vertex under the pointer."""
        return None if self._context.hit is None else self._context.hit.vertex

    def _hover(self, panel: int, hit: Hit | None) -> None:
        context, pointing = self._context, self._grid.pointing
        before, last, last_in = self.hovered, context.hit, context.hit_in
        context.hit, context.hit_in = hit, panel
        vertex = self.hovered
        is_beside = vertex is None and before is None and not pointing.is_on
        if context.session.loaded() is None or is_beside:
            return
        if not self._grid.has(panel):  # it has gone from under the pointer
            context.hit = None
            pointing.leave()
            context.pointed.emit(None, "")
            context.status.show_place(None)
            return
        pointing.show(panel, vertex)
        widget, surface = self._grid.panel(panel), context.session.mesh(panel).surface
        context.pointed.emit(vertex, widget.surface)
        position = None if vertex is None else surface.vertices[vertex]
        context.status.show_place(vertex, position, surface, widget.head.letter)
        gesture, snapping = self._on(panel), context[Snapping]
        at, was = (None if each is None else snapping.at(panel, each) for each in (hit, last))
        is_elsewhere = last is None or panel != last_in or at != was
        if self.is_live and gesture.follows and hit is not None and is_elsewhere:
            self._dragging.is_on = self._has_followed = True
            self._dragging.begin()
            gesture.follow(panel, hit)
            self._rest_soon.start()

    def centre_here(self) -> None:
        """Centre what is under the pointer, and turn about it."""
        if self._context.hit is not None:
            self._grid.panel(self._context.hit_in).view.centre(self._context.hit.position)

    def zoom_here(self) -> None:
        """Centre and enlarge what is under the pointer."""
        if self._context.hit is not None:
            self._zoom_to(self._context.hit_in, self._context.hit)

    def _zoom_to(self, panel: int, hit: Hit) -> None:
        view = self._grid.panel(panel).view
        view.centre(hit.position)
        view.zoom(CLOSER)

    # ------------------------------------------------------------------ the menu
    def _open_menu(self, panel: int, wanted: MenuWanted) -> None:
        """Open the menu of a place on the surface, or of the view beside it."""
        context, actions, hit = self._context, self._context.actions, wanted.hit
        menu = QtWidgets.QMenu(context.widget)
        if hit is not None:
            self._grid.pointing.show(panel, hit.vertex)
            self._on(panel).offer(menu, panel, hit)
        for gesture in self._all:
            gesture.offer_always(menu, panel, hit, wanted.where)
        menu.addSeparator()
        if hit is not None:
            self._offer_place(menu, panel, hit)
        else:
            for words in (("reset", "view before", "view after"), ("undo", "redo", "add panel")):
                menu.addActions([actions[word] for word in words])
                menu.addSeparator()
            menu.addAction("Save field…", lambda: context[FieldFiles].save(panel))
        menu.aboutToHide.connect(menu.deleteLater)
        menu.popup(wanted.where)

    def _offer_place(self, menu: QtWidgets.QMenu, panel: int, hit: Hit) -> None:
        context, view, vertex = self._context, self._grid.panel(panel).view, hit.vertex
        isolines = context[IsolineChoices]
        menu.addAction("Isoline through here", lambda: isolines.pass_through(panel, vertex))
        if context.document.isolines.through:
            menu.addAction("Remove isolines through points", isolines.pass_through_none)
        menu.addAction("Save isolines…", lambda: save_isolines(context, panel))
        menu.addAction("Save field…", lambda: context[FieldFiles].save(panel))
        menu.addSeparator()
        menu.addAction("Centre view here\tC", lambda: view.centre(hit.position))
        menu.addAction("Zoom in here\tZ", lambda: self._zoom_to(panel, hit))
        menu.addSeparator()
        noun = context.session.mesh(panel).surface.nouns[0]
        menu.addAction(f"Copy {noun} id {vertex}", lambda: _copy(str(vertex)))
        menu.addAction("Copy position", lambda: _copy(" ".join(map(repr, self._place(panel, vertex)))))
        menu.addAction("Copy values", lambda: _copy(self._values(panel, vertex)))

    def _place(self, panel: int, vertex: int) -> list[float]:
        place: list[float] = self._context.session.mesh(panel).surface.vertices[vertex].tolist()
        return place

    def _values(self, id: int, vertex: int) -> str:
        """Return the values of all panels of the same surface at a vertex, a line each."""
        surface = self._context.session.mesh(id).surface
        place = coordinates(self._place(id, vertex), surface.mean_edge_length)
        name = self._grid.panel(id).surface
        lines = [panel.words_at(vertex) for panel in self._grid.panels if panel.surface == name]
        return "\n".join([f"{surface.nouns[0]} {vertex} at {place}", *lines])


def _copy(text: str) -> None:
    QtWidgets.QApplication.clipboard().setText(text)
