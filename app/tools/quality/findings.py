"""The quality of what panels show, found out in the background while the dock is open, and the extrema that are marked:
those of all panels then and where the document says so, otherwise those of quantities that ask for it."""

from qtpy import QtCore

from bihdist_core.analysis.other_extrema import OtherExtrema

from ...document.document import Panel
from ...qt.context import Context
from ...session.questions import Question, are_about_the_same, questions
from .judgement import Found, Quality

REST_MS = 150
"""Fields that follow each other faster, as in a drag, are not judged."""


class QualityFindings(QtCore.QObject):
    """changed: more is known of some panel, or less."""

    changed = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._quality: Quality | None = None  # once something is marked
        self._is_closed = False
        self._rest = QtCore.QTimer(self, singleShot=True, interval=REST_MS)
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
        """Nothing more is found out."""
        self._is_closed = True
        self._rest.stop()
        if self._quality is not None:
            self._quality.close()

    # ------------------------------------------------------------------ what is known
    def found(self, panel: int) -> Found:
        """Of the answer that a panel shows; nothing of one that is not final."""
        question = self._judged_question(panel)
        return Found() if question is None or self._quality is None else self._quality.found(question)

    @property
    def is_complete(self) -> bool:
        """Whether there is nothing more to be found out."""
        if self._rest.isActive():
            return False
        panels = self._context.document.panels
        judged = [panel.id for panel in panels if self._is_marked(panel) and self._judged_question(panel.id)]
        if self._is_judging:
            return all(self.found(id).is_complete for id in judged)
        return all(self.found(id).extrema or self.found(id).failure for id in judged)

    @property
    def _is_judging(self) -> bool:
        return "quality" in self._context.document.docks and self._is_there

    @property
    def _is_marking(self) -> bool:
        return any(self._is_marked(panel) for panel in self._context.document.panels)

    def _is_marked(self, panel: Panel) -> bool:
        """Whether the extrema of what a panel shows are drawn there."""
        document = self._context.document
        is_asked_for = document.extrema or panel.shows.marks_extrema(document)
        return self._is_judging or (is_asked_for and self._is_there)

    @property
    def _is_there(self) -> bool:
        return self._context.session.surface is not None and not self._is_closed

    def _judged_question(self, panel: int) -> Question | None:
        """That which a panel shows the answer to."""
        session = self._context.session
        shown = session.shown.get(panel)
        if shown is None or not session.is_answered(panel) or shown.answer.field is None:
            return None
        return shown.asked

    # ------------------------------------------------------------------ what is asked, and shown
    def _want(self) -> None:
        if self._is_marking:
            self._rest.start()
        self._tell()

    def _ask(self) -> None:
        if not self._is_marking:
            if self._quality is not None:
                self._quality.ask({})
            return
        if self._quality is None:
            self._quality = Quality(self._context.post, self._tell)
        session, asked, on_its_way = self._context.session, {}, {}
        now = questions(session.document)
        for panel in session.document.panels:
            question, loaded = self._judged_question(panel.id), session.loaded(panel.surface)
            shown = session.shown.get(panel.id)
            if loaded is None or shown is None or not self._is_marked(panel):
                continue
            if question is not None:
                asked[question] = (loaded, shown.answer)
            elif are_about_the_same(shown.asked, now[panel.id]):
                on_its_way[now[panel.id]] = loaded
        self._quality.ask(asked, not self._is_judging, on_its_way)

    def _tell(self) -> None:
        self._show_extrema()
        self.changed.emit()

    def _show_extrema(self) -> None:
        marked = {panel.id for panel in self._context.document.panels if self._is_marked(panel)}
        for panel in self._context.grid.panels:
            extrema = self.found(panel.id).extrema if panel.id in marked else None
            self._context.show_found(panel.id, OtherExtrema, extrema)
