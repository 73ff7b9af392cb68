"""The regions of the pins, divided in the background where the document says so, and drawn on the panels."""

from qtpy import QtCore

from ...qt.context import Context
from .division import Divided, Dividing, regions_questions


class RegionFindings(QtCore.QObject):
    """Asks `dividing` for the regions of what is shown; `changed` is emitted with a panel's id when it has others."""

    changed = QtCore.Signal(int)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.dividing = Dividing(context.post, self._show)
        context.document_changed.connect(self.document_changed)
        context.panels_cleared.connect(self.show_again)
        context.closed.connect(self.dividing.close)

    def document_changed(self, _: object = None) -> None:
        """Ask for the regions of what is shown now."""
        session = self._context.session
        if session.loaded() is None:
            return
        asked = {}
        for id, question in regions_questions(session.document).items():
            loaded = session.loaded(session.document.panel(id).surface)
            if loaded is not None:
                asked[id] = (question, loaded)
        self.dividing.ask(asked)

    def show_again(self) -> None:
        """Draw the regions again on panels that were cleared."""
        for panel in self._context.grid.panels:
            self._show(panel.id)

    def _show(self, panel: int) -> None:
        if any(shown.id == panel for shown in self._context.grid.panels):
            self._context.show_found(panel, Divided, self.dividing.divided(panel))
        self.changed.emit(panel)
