"""The docks of the window: made when first opened, shown as the document says."""

from qtpy import QtCore, QtWidgets

from ...document.document import DockPlaces, Document
from ...document.tools import docked_tools
from ..context import Context
from ..files.session_actions import SessionFile
from ..held_keys import HeldKeys
from .instrument import Dock, Instrument

NARROW = 1_100
"""Width of the window, in logical pixels, below which the docks at the right are tabs."""

AREAS = {
    "right": QtCore.Qt.DockWidgetArea.RightDockWidgetArea,
    "below": QtCore.Qt.DockWidgetArea.BottomDockWidgetArea,
}
WIDTH, WIDER, HEIGHT = 340, 390, 220
"""Initial width of docks at the right, in a wide window, and initial height of docks below, in logical pixels."""

LEAST_SHARE = 0.4
"""Initial fraction of the height that each of two docks above each other has at least."""

WIDE = 1_500
"""Width of the window from which on docks are wider."""

STACKED = 2
"""Number of docks above each other at the right; more are tabs of the lowest."""


class Docks:
    """Keeps the instruments, tells them what changes, and lets menus say which are open."""

    def __init__(self, context: Context) -> None:
        self._context, self._main = context, context.widget
        self._docks: dict[str, Dock] = {}
        self._shown: Document | None = None
        self._main.setDockNestingEnabled(True)
        self._main.setTabPosition(QtCore.Qt.DockWidgetArea.RightDockWidgetArea, QtWidgets.QTabWidget.TabPosition.North)
        for corner, area in (
            (QtCore.Qt.Corner.BottomRightCorner, AREAS["right"]),
            (QtCore.Qt.Corner.TopRightCorner, AREAS["right"]),
        ):
            self._main.setCorner(corner, area)
        session_file = context[SessionFile]
        session_file.dock_places = self.places
        session_file.docks_placed.connect(self.restore)
        context.document_changed.connect(self.document_changed)
        context.answer_changed.connect(self.answer_changed)
        context.panels_cleared.connect(self.show_again)
        context.pointed.connect(self.pointed)

    # ------------------------------------------------------------------ open and close
    def toggle(self, word: str) -> None:
        """Open the dock of a tool, or close it."""
        document = self._context.document
        if word in document.docks:
            self.close(word)
        else:
            self._keep((*document.docks, word))
            if word in self._docks:
                self._docks[word].raise_()
                self._instrument(word).on_opened()

    def close(self, word: str) -> None:
        """Close a dock as the user does, which also ends its tool."""
        was_open = word in self._context.document.docks
        self._keep(tuple(each for each in self._context.document.docks if each != word))
        if was_open and word in self._docks:
            self._instrument(word).leave()

    def show_stopped(self) -> None:
        """Tell open docks that the user has cancelled a computation."""
        for instrument in self._open():
            instrument.show_stopped()

    def close_all(self) -> None:
        """End all instruments, as the window closes."""
        for dock in self._docks.values():
            dock.content.end()
            dock.hide()

    def _keep(self, docks: tuple[str, ...]) -> None:
        before = self._context.document
        self._context.session.set_fields(docks=docks)
        self._context.document_changed.emit(before)

    # ------------------------------------------------------------------ what is told
    def document_changed(self, _: object = None) -> None:
        """Open the docks that the document lists, and show it in them."""
        document, known = self._context.document, docked_tools()
        wanted = [word for word in document.docks if word in known and self._context.session.loaded() is not None]
        for word in wanted:
            dock = self._docks.get(word) or self._new(word)
            was_open = not dock.isHidden()
            if not was_open:
                self._place(dock)
            self._instrument(word).show_document(document, self._shown if was_open else None)
        for word, dock in self._docks.items():
            if word not in wanted and not dock.isHidden():
                dock.hide()
                self._instrument(word).show_closed()
        self._shown = document
        for word in known:
            self._context.actions[f"dock {word}"].setChecked(word in wanted)

    def answer_changed(self, panel: int) -> None:
        """Show another answer of a panel in all open docks."""
        for instrument in self._open():
            instrument.show_answer(panel)

    def show_again(self) -> None:
        """Draw again from open docks what the panels have lost."""
        for instrument in self._open():
            instrument.show_again()

    def pointed(self, vertex: int | None, surface: str) -> None:
        """Tell open docks the vertex under the pointer; those of other surfaces that there is none."""
        for instrument in self._open():
            instrument.show_pointed(vertex if surface == instrument.pointed_surface else None)

    def _open(self) -> list[Instrument]:
        return [self._instrument(word) for word, dock in self._docks.items() if not dock.isHidden()]

    def _instrument(self, word: str) -> Instrument:
        instrument: Instrument = self._docks[word].content
        return instrument

    # ------------------------------------------------------------------ where they are
    def places(self) -> DockPlaces | None:
        """Return the places of open docks; None if none are open."""
        main = self._main
        if not self._open():
            return None
        return DockPlaces(main.width(), main.height(), bytes(main.saveState().toBase64()).decode())

    def restore(self, places: DockPlaces | None) -> None:
        """Restore the places of open docks, unless the width of the window calls for tabs or for none."""
        main = self._main
        if places is None or (places.width < NARROW) != (main.width() < NARROW):
            return
        main.restoreState(QtCore.QByteArray.fromBase64(places.state.encode()))
        for word, dock in self._docks.items():
            dock.setVisible(word in self._context.document.docks)

    def _new(self, word: str) -> Dock:
        tool = docked_tools()[word]
        instrument = tool.load(tool.dock)(self._context)
        dock = Dock(word, tool.title, instrument, self._main)
        for widget in reversed(instrument.beside_title):
            dock.head.add(widget, after_title=True)
        for widget in instrument.head:
            dock.head.add(widget)
        instrument.note_changed.connect(dock.head.say)
        for button in dock.findChildren(QtWidgets.QAbstractButton):
            # Its outline is for keys.
            button.setFocusPolicy(QtCore.Qt.FocusPolicy.TabFocus)
        dock.wants_closed.connect(self.close)
        dock.topLevelChanged.connect(lambda floats: self._context[HeldKeys].watch(dock) if floats else None)
        dock.hide()
        self._docks[word] = dock
        return dock

    def _place(self, dock: Dock) -> None:
        """Place a dock where it was, at first at the end of its area, or as a tab where there is no room."""
        main, area = self._main, AREAS[dock.content.area]
        above: Dock | None = None
        is_new = main.dockWidgetArea(dock) == QtCore.Qt.DockWidgetArea.NoDockWidgetArea
        if is_new:
            main.addDockWidget(area, dock)
        placed = [
            other
            for other in self._docks.values()
            if other is not dock and not other.isFloating()
            if main.dockWidgetArea(other) == main.dockWidgetArea(dock)
        ]
        others = [other for other in placed if not other.isHidden()]
        is_right = main.dockWidgetArea(dock) != AREAS["below"]
        most = STACKED if is_right and main.width() >= NARROW else 1
        if not dock.isFloating() and self._apart(others) >= most and not self._is_tab(dock, others):
            main.tabifyDockWidget(others[-1], dock)
        elif is_new and is_right and others:
            above = others[-1]
        if is_new:
            way = QtCore.Qt.Orientation.Horizontal if is_right else QtCore.Qt.Orientation.Vertical
            usual = (WIDER if main.width() >= WIDE else WIDTH) if is_right else HEIGHT
            # As the user has made those that are there, or have been.
            known = [other.width() if is_right else other.height() for other in others or placed]
            main.resizeDocks([dock], [known[-1] if known else usual], way)
        room = 0 if above is None else above.height()
        dock.show()
        dock.raise_()
        if above is not None:
            # As much as the new one wants, but each has a good part of it.
            wanted = min(max(dock.sizeHint().height(), round(LEAST_SHARE * room)), round((1 - LEAST_SHARE) * room))
            main.resizeDocks([above, dock], [room - wanted, wanted], QtCore.Qt.Orientation.Vertical)

    def _apart(self, docks: list[Dock]) -> int:
        """Return the number of places that docks take; tabs take one together."""
        firsts = [dock for k, dock in enumerate(docks) if not self._is_tab(dock, docks[:k])]
        return len(firsts)

    def _is_tab(self, dock: Dock, others: list[Dock]) -> bool:
        """Return whether a dock is a tab beside one of the others."""
        beside = self._main.tabifiedDockWidgets(dock)
        return any(other in beside for other in others)
