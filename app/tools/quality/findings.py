"""The quality of what panels show, found out in the background while the dock is open, and the extrema that are marked:
those of all panels then and where the document says so, otherwise those of quantities that ask for it."""

from qtpy import QtCore

from bihdist_core.analysis.persistence import OtherExtrema

from ...document.document import Panel
from ...qt.context import Context
from ...session.questions import Question, are_about_the_same, questions
from .quality_worker import KnownQuality, QualityWorker

SETTLE_MS = 150
"""Fields that follow each other faster, as in a drag, are not measured."""


class QualityFindings(QtCore.QObject):
    """The quality of what panels show; `changed` is emitted when more is known, or less."""

    changed = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._quality = QualityWorker(context.post, self._tell)
        self._is_closed = False
        self._rest = QtCore.QTimer(self, singleShot=True, interval=SETTLE_MS)
        self._rest.timeout.connect(self._ask)
        context.document_changed.connect(self.document_changed)
        context.answer_changed.connect(self.answer_changed)
        context.panels_cleared.connect(self._show_extrema)
        context.closed.connect(self.close)

    # ------------------------------------------------------------------ what is told
    def document_changed(self, _: object = None) -> None:
        """Ask for the quality of what is shown now."""
        if self._is_there:
            self._want()

    def answer_changed(self, _: int) -> None:
        """Ask for the quality of another answer."""
        self._want()

    def close(self) -> None:
        """Stop measuring."""
        self._is_closed = True
        self._rest.stop()
        self._quality.close()

    # ------------------------------------------------------------------ what is known
    def found(self, panel: int) -> KnownQuality:
        """Return the quality of a panel's answer, as far as it is known; nothing while that is not final."""
        question = self._answered_question(panel)
        return KnownQuality() if question is None else self._quality.found(question)

    @property
    def is_complete(self) -> bool:
        """Return whether everything is known."""
        if self._rest.isActive():
            return False
        panels = self._context.document.panels
        measured = [panel.id for panel in panels if self._is_marked(panel) and self._answered_question(panel.id)]
        if self._is_measuring:
            return all(self.found(id).is_complete for id in measured)
        return all(self.found(id).extrema or self.found(id).failure for id in measured)

    @property
    def _is_measuring(self) -> bool:
        return "quality" in self._context.document.docks and self._is_there

    @property
    def _is_marking(self) -> bool:
        return any(self._is_marked(panel) for panel in self._context.document.panels)

    def _is_marked(self, panel: Panel) -> bool:
        """Return whether the extrema of a panel are drawn."""
        document = self._context.document
        is_asked_for = document.extrema or panel.shows.marks_extrema(document)
        return self._is_measuring or (is_asked_for and self._is_there)

    @property
    def _is_there(self) -> bool:
        return self._context.session.loaded() is not None and not self._is_closed

    def _answered_question(self, panel: int) -> Question | None:
        """Return the question whose answer a panel shows."""
        session = self._context.session
        shown = session.shown.get(panel)
        if shown is None or not session.is_answered(panel) or shown.answer.field is None:
            return None
        return shown.question

    # ------------------------------------------------------------------ what is asked, and shown
    def _want(self) -> None:
        if self._is_marking:
            self._rest.start()
        self._tell()

    def _ask(self) -> None:
        if not self._is_marking:
            self._quality.ask({})
            return
        session, asked, on_its_way = self._context.session, {}, {}
        now = questions(session.document)
        for panel in session.document.panels:
            question, loaded = self._answered_question(panel.id), session.loaded(panel.surface)
            shown = session.shown.get(panel.id)
            if loaded is None or shown is None or not self._is_marked(panel):
                continue
            if question is not None:
                asked[question] = (loaded, shown.answer)
            elif are_about_the_same(shown.question, now[panel.id]):
                on_its_way[now[panel.id]] = loaded
        self._quality.ask(asked, not self._is_measuring, on_its_way)

    def _tell(self) -> None:
        self._show_extrema()
        self.changed.emit()

    def _show_extrema(self) -> None:
        marked = {panel.id for panel in self._context.document.panels if self._is_marked(panel)}
        for panel in self._context.grid.panels:
            extrema = self.found(panel.id).extrema if panel.id in marked else None
            self._context.show_found(panel.id, OtherExtrema, extrema)
