"""The regions of the pins, divided in the background where the document says so, and drawn on the panels."""

from qtpy import QtCore

from ...qt.context import Context
from .division import Divided, Dividing, regions_questions


class RegionFindings(QtCore.QObject):
    """changed: other regions of a panel, or none, by its id."""

    changed = QtCore.Signal(int)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._dividing = Dividing(context.post, self._show)
        context.document_changed.connect(self.document_changed)
        context.panels_cleared.connect(self.show_again)
        context.closed.connect(self._dividing.close)

    def document_changed(self, _: object = None) -> None:
        """Ask for the regions of what is shown now."""
        session = self._context.session
        if session.surface is None:
            return
        asked = {}
        for id, question in regions_questions(session.document).items():
            loaded = session.loaded(session.document.panel(id).surface)
            if loaded is not None:
                asked[id] = (question, loaded)
        self._dividing.ask(asked)

    def show_again(self) -> None:
        """The panels have forgotten what was drawn on them."""
        for panel in self._context.grid.panels:
            self._show(panel.id)

    def divided(self, panel: int) -> Divided | None:
        """The regions that a panel shows."""
        return self._dividing.divided(panel)

    def is_divided(self, panel: int) -> bool:
        """Whether these are the regions of where the pins are now."""
        return self._dividing.is_answered(panel)

    @property
    def is_complete(self) -> bool:
        """Whether there is nothing more to be found out."""
        return self._dividing.is_complete

    def _show(self, panel: int) -> None:
        if any(shown.id == panel for shown in self._context.grid.panels):
            self._context.show_found(panel, Divided, self._dividing.divided(panel))
        self.changed.emit(panel)
