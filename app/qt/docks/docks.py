"""The docks of the window: made when first opened, shown as the document says."""

from qtpy import QtCore, QtWidgets

from ...document.docks import DockPlaces
from ...document.document import Document
from ...document.tools import docked_tools
from ..context import Context
from ..files.session_actions import SessionFile
from ..held_keys import HeldKeys
from .dock import Dock
from .instrument import Instrument

NARROW = 1_100
"""Logical pixels of the window's width under which the docks at the right are tabs of one."""

AREAS = {
    "right": QtCore.Qt.DockWidgetArea.RightDockWidgetArea,
    "below": QtCore.Qt.DockWidgetArea.BottomDockWidgetArea,
}
WIDTH, WIDER, HEIGHT = 320, 390, 220
"""Of docks at the right, where there is room for panels and where there is much of it, and below, at first."""

LEAST_SHARE = 0.4
"""Of the height of two docks above each other, at first."""

WIDE = 1_500
"""Of the window, from which on there is much room."""

STACKED = 2
"""So many docks stand on one another at the right; more are tabs of the lowest."""


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
        """By the user, to whom what it is about is no longer of interest."""
        was_open = word in self._context.document.docks
        self._keep(tuple(each for each in self._context.document.docks if each != word))
        if was_open and word in self._docks:
            self._instrument(word).leave()

    def show_stopped(self) -> None:
        """The user has stopped what went on."""
        for instrument in self._open():
            instrument.show_stopped()

    def close_all(self) -> None:
        """The window closes."""
        for dock in self._docks.values():
            dock.content.end()
            dock.hide()

    def _keep(self, docks: tuple[str, ...]) -> None:
        before = self._context.document
        self._context.session.keep_open(docks)
        self._context.document_changed.emit(before)

    # ------------------------------------------------------------------ what is told
    def document_changed(self, _: object = None) -> None:
        """Show what the document says, in the docks that it says."""
        document, known = self._context.document, docked_tools()
        wanted = [word for word in document.docks if word in known and self._context.session.surface is not None]
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
        """Let all open docks show another answer of a panel."""
        for instrument in self._open():
            instrument.show_answer(panel)

    def show_again(self) -> None:
        """The panels have forgotten what was drawn on them."""
        for instrument in self._open():
            instrument.show_again()

    def pointed(self, vertex: int | None, surface: str) -> None:
        """The pointer is at a vertex of a surface; of others instruments are told that it has left."""
        for instrument in self._open():
            instrument.show_pointed(vertex if surface == instrument.pointed_surface else None)

    def _open(self) -> list[Instrument]:
        return [self._instrument(word) for word, dock in self._docks.items() if not dock.isHidden()]

    def _instrument(self, word: str) -> Instrument:
        instrument: Instrument = self._docks[word].content
        return instrument

    # ------------------------------------------------------------------ where they are
    def places(self) -> DockPlaces | None:
        """Of those that are open; None if none are."""
        main = self._main
        if not self._open():
            return None
        return DockPlaces(main.width(), main.height(), bytes(main.saveState().toBase64()).decode())

    def restore(self, places: DockPlaces | None) -> None:
        """Put those that are open where they were, unless they were tabs of one and now need not be, or the reverse."""
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
        for widget in reversed(instrument.title_widgets()):
            dock.head.add(widget, after_title=True)
        for widget in instrument.head_widgets():
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
        """Where it was, or at first at the end of its area; a tab where there are enough beside each other."""
        main, area = self._main, AREAS[dock.content.area]
        above: Dock | None = None
        is_new = main.dockWidgetArea(dock) == QtCore.Qt.DockWidgetArea.NoDockWidgetArea
        if is_new:
            main.addDockWidget(area, dock)
        others = [
            other
            for other in self._docks.values()
            if other is not dock and not (other.isHidden() or other.isFloating())
            if main.dockWidgetArea(other) == main.dockWidgetArea(dock)
        ]
        is_right = main.dockWidgetArea(dock) != AREAS["below"]
        most = STACKED if is_right and main.width() >= NARROW else 1
        if not dock.isFloating() and self._apart(others) >= most and not self._is_tab(dock, others):
            main.tabifyDockWidget(others[-1], dock)
        elif is_new and is_right and others:
            above = others[-1]
        if is_new:
            way = QtCore.Qt.Orientation.Horizontal if is_right else QtCore.Qt.Orientation.Vertical
            main.resizeDocks([dock], [(WIDER if main.width() >= WIDE else WIDTH) if is_right else HEIGHT], way)
        room = 0 if above is None else above.height()
        dock.show()
        dock.raise_()
        if above is not None:
            # As much as the new one wants, but each has a good part of it.
            wanted = min(max(dock.sizeHint().height(), round(LEAST_SHARE * room)), round((1 - LEAST_SHARE) * room))
            main.resizeDocks([above, dock], [room - wanted, wanted], QtCore.Qt.Orientation.Vertical)

    def _apart(self, docks: list[Dock]) -> int:
        """How many places they take: tabs of each other take one."""
        firsts = [dock for k, dock in enumerate(docks) if not self._is_tab(dock, docks[:k])]
        return len(firsts)

    def _is_tab(self, dock: Dock, others: list[Dock]) -> bool:
        """Whether it shares its place with one of the others."""
        beside = self._main.tabifiedDockWidgets(dock)
        return any(other in beside for other in others)
