"""Crosses where the point that waits for its partner belongs, and at the candidates how far they are from there.

Found beside the window's thread, wherever panels predict and it is known what is right.
"""

from qtpy import QtCore

from ...qt.context import Context
from .candidate_errors import CandidateErrorRequest, CandidateErrors, CandidateErrorWorker, candidate_request
from .pair_locations import candidate_in
from .quantity import predicts_in


class CandidateFindings(QtCore.QObject):
    """The errors that are shown at the candidates; `found` is None where there are none."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.found: CandidateErrors | None = None
        self._asked: CandidateErrorRequest | None = None
        self._background = context.background("candidate errors", CandidateErrorWorker().errors, self._take)
        context.document_changed.connect(self.document_changed)
        context.answer_changed.connect(self.document_changed)
        context.panels_cleared.connect(self._show)

    # ------------------------------------------------------------------ what is told
    def document_changed(self, _: object = None) -> None:
        """Ask for the errors of the candidates that are shown now."""
        asked, before = self._wanted(), self._asked
        if asked is None and before is None:
            return
        if asked is not None and before is not None and asked.about == before.about:
            if asked.candidates == before.candidates:
                return
            # The place stays; how far others are from there has still to be found.
            self.found = None if self.found is None else CandidateErrors(self.found.places, {})
        else:
            self.found = None
        self._asked = asked
        self._background.ask(asked)
        self._show()

    # ------------------------------------------------------------------ asking
    def _wanted(self) -> CandidateErrorRequest | None:
        session = self._context.session
        document = session.document
        if not any(map(predicts_in, document.panels)):
            return None
        loaded = [session.loaded(mesh.name) for mesh in document.surfaces[:2]]
        first, second = [*loaded, None, None][:2]
        if first is None or second is None:
            return None
        candidates = {}
        for panel in document.panels:
            found = candidate_in(document, panel, session.answer(panel.id))
            if found is not None and session.is_answered(panel.id):
                candidates[panel.id] = found.vertex
        return candidate_request(document, first, second, candidates)

    def _take(self, asked: CandidateErrorRequest, found: CandidateErrors) -> None:
        before = self.found
        if found.errors or before is None or before.places != found.places:
            self.found = found
            self._show()

    def _show(self) -> None:
        document, found = self._context.document, self.found
        there = {panel.id: panel for panel in document.panels}
        for panel in self._context.grid.panels:
            shown = there.get(panel.id)
            is_here = shown is not None and shown.surface == self._surface_name() and predicts_in(shown)
            self._context.grid.marks.show_found(panel.id, CandidateErrors, found if is_here else None)

    def _surface_name(self) -> str:
        """Return the name of the surface of the candidates."""
        document, asked = self._context.document, self._asked
        if asked is None or len(document.surfaces) < 2:
            return ""
        return document.surfaces[1 if asked.is_on_first else 0].name
