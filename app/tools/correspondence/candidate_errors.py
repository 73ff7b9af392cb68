"""Crosses where the point that waits for its partner belongs, and at the candidates how far they are from there.

Found beside the window's thread, wherever panels predict and it is known what is right.
"""

from collections.abc import Iterator

from qtpy import QtCore

from bihdist_core.progress import Progress

from ...qt.background import Background
from ...qt.context import Context
from .candidate_judgement import CandidatesAsked, CandidatesJudged, CandidatesJudging, candidates_asked
from .pair_locations import candidate_in
from .prediction import predicts_in


class CandidateErrors(QtCore.QObject):
    """judged: what is shown, None for nothing."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self.judged: CandidatesJudged | None = None
        self._asked: CandidatesAsked | None = None
        self._judging = CandidatesJudging()
        self._background: Background | None = None  # once something predicts
        context.document_changed.connect(self.document_changed)
        context.answer_changed.connect(self.answer_changed)
        context.panels_cleared.connect(self.show_again)

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
            self.judged = None if self.judged is None else CandidatesJudged(self.judged.places, {})
        else:
            self.judged = None
        self._asked = asked
        self._ask(asked)
        self._show()

    def answer_changed(self, _: int) -> None:
        """Ask for the errors of other candidates."""
        self.document_changed()

    def show_again(self) -> None:
        """The panels have forgotten what was drawn on them."""
        self._show()

    # ------------------------------------------------------------------ asking
    def _wanted(self) -> CandidatesAsked | None:
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
            shown = session.shown.get(panel.id)
            found = candidate_in(document, panel, None if shown is None else shown.answer)
            if found is not None and session.is_answered(panel.id):
                candidates[panel.id] = found.vertex
        return candidates_asked(document, first, second, candidates)

    def _ask(self, asked: CandidatesAsked | None) -> None:
        if self._background is None:
            self._background = self._context.background("candidate errors", self._judge)
            self._background.answered.connect(self._take)
        self._background.ask(asked)

    def _judge(self, asked: CandidatesAsked, progress: Progress) -> Iterator[CandidatesJudged]:
        yield from self._judging.judge(asked, progress)

    def _take(self, asked: CandidatesAsked, judged: CandidatesJudged) -> None:
        before = self.judged
        if judged.errors or before is None or before.places != judged.places:
            self.judged = judged
            self._show()

    def _show(self) -> None:
        document, judged = self._context.document, self.judged
        there = {panel.id: panel for panel in document.panels}
        for panel in self._context.grid.panels:
            shown = there.get(panel.id)
            is_here = shown is not None and shown.surface == self._surface_name() and predicts_in(shown)
            self._context.grid.marks.show_found(panel.id, CandidatesJudged, judged if is_here else None)

    def _surface_name(self) -> str:
        """Of the candidates."""
        document, asked = self._context.document, self._asked
        if asked is None or len(document.surfaces) < 2:
            return ""
        return document.surfaces[1 if asked.is_on_first else 0].name
