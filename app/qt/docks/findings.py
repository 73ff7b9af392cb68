"""What is found out in the background about what the panels show, and drawn on them: extrema while the dock of quality
is open or the document says so, those of interpolants beside the dock of anchors, and regions of the pins where the
document says so."""

from collections.abc import Callable
from contextlib import suppress

from qtpy import QtCore

from bihdist_core.analysis.quality import OtherExtrema

from ...document.document import Panel
from ...session.quality import Found, Quality
from ...session.questions import Question, are_about_the_same, questions
from ...session.regions import Divided, Dividing, regions_questions
from ..context import Context

REST_MS = 150
"""Fields that follow each other faster, as in a drag, are not judged."""


class Findings(QtCore.QObject):
    """quality_changed: more is known of some panel, or less; regions_changed: of a panel."""

    quality_changed = QtCore.Signal()
    regions_changed = QtCore.Signal(int)
    _posted = QtCore.Signal(object)

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._quality: Quality | None = None  # once the dock has been opened
        self._dividing = Dividing(self.post, self._show_regions)
        self._is_closed = False
        self._posted.connect(self._run)
        self._rest = QtCore.QTimer(self, singleShot=True, interval=REST_MS)
        self._rest.timeout.connect(self._ask_quality)
        context.document_changed.connect(self.document_changed)
        context.answer_changed.connect(self.answer_changed)
        context.panels_cleared.connect(self.show_again)
        context.closed.connect(self.close)

    # ------------------------------------------------------------------ what is told
    def document_changed(self, _: object = None) -> None:
        """Ask for regions and extrema of what is shown now."""
        session = self._context.session
        if session.surface is None or self._is_closed:
            return
        asked = {}
        for id, question in regions_questions(session.document).items():
            loaded = session.loaded(session.document.panel(id).surface)
            if loaded is not None:
                asked[id] = (question, loaded)
        self._dividing.ask(asked)
        self._quality_wanted()

    def answer_changed(self, _: int) -> None:
        """Ask for the extrema of another answer."""
        self._quality_wanted()

    def show_again(self) -> None:
        """The panels have forgotten what was drawn on them."""
        for panel in self._context.grid.panels:
            self._show_regions(panel.id)
        self._show_extrema()

    def close(self) -> None:
        """Nothing more is found out."""
        self._is_closed = True
        self._rest.stop()
        self._dividing.close()
        if self._quality is not None:
            self._quality.close()

    # ------------------------------------------------------------------ what is known
    def found(self, panel: int) -> Found:
        """Of the answer that a panel shows; nothing of one that is not final."""
        question = self._judged_question(panel)
        return Found() if question is None or self._quality is None else self._quality.found(question)

    def divided(self, panel: int) -> Divided | None:
        """The regions that a panel shows."""
        return self._dividing.divided(panel)

    def is_divided(self, panel: int) -> bool:
        """Whether these are the regions of where the pins are now."""
        return self._dividing.is_answered(panel)

    @property
    def is_complete(self) -> bool:
        """Whether there is nothing more to be found out."""
        if self._rest.isActive() or not self._dividing.is_complete:
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
        has_anchors = "anchors" in document.docks and panel.shows.interpolates
        return self._is_judging or ((document.extrema or has_anchors) and self._is_there)

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

    # ------------------------------------------------------------------ quality
    def _quality_wanted(self) -> None:
        if self._is_marking:
            self._rest.start()
        self._show_extrema()
        self.quality_changed.emit()

    def _ask_quality(self) -> None:
        if not self._is_marking:
            if self._quality is not None:
                self._quality.ask({})
            return
        if self._quality is None:
            self._quality = Quality(self.post, self._judged)
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

    def _judged(self) -> None:
        self._show_extrema()
        self.quality_changed.emit()

    def _show_extrema(self) -> None:
        marked = {panel.id for panel in self._context.document.panels if self._is_marked(panel)}
        for panel in self._context.grid.panels:
            extrema = self.found(panel.id).extrema if panel.id in marked else None
            self._context.grid.marks.show_found(panel.id, OtherExtrema, extrema)

    # ------------------------------------------------------------------ regions
    def _show_regions(self, panel: int) -> None:
        divided = self._dividing.divided(panel)
        if any(shown.id == panel for shown in self._context.grid.panels):
            self._context.grid.marks.show_found(panel, Divided, divided)
        self.regions_changed.emit(panel)

    # ------------------------------------------------------------------ threads
    def post(self, function: Callable[[], None]) -> None:
        """Run a function on the window's thread, unless the window is closed by then."""
        with suppress(RuntimeError):  # the window may be gone
            self._posted.emit(function)

    def _run(self, function: Callable[[], None]) -> None:
        if not self._is_closed:
            function()
