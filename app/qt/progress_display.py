"""Progress of fields, in the panels that wait for them, and of meshes that are read."""

from math import nan
from time import monotonic

from qtpy import QtCore

from bihdist_core.counts import counted

from ..document.document import Document
from ..drawing.numbers import progress_share
from ..session.answering import Shown
from ..session.questions import Question
from ..session.time_left import TimeLeft
from .context import Context
from .dragging import Dragging

PROGRESS_MS = 200
"""Shortest interval at which progress is shown."""

QUIET_MS = 150
"""Time before progress is shown, so that it does not flicker."""

BEHIND = 0.25
"""Seconds for a field from which on a panel is pale while the source moves."""

WAITING = (nan, "Waiting")
CHECKING = "Checking the accuracy"


class ProgressDisplay(QtCore.QObject):
    """Shows the progress of all that is being computed; `shown` is emitted once it has been shown."""

    shown = QtCore.Signal()
    opening = QtCore.Signal(str)  # the first mesh is being read: how far that is, in words
    nothing_open = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._is_late = False
        self._left: dict[int, TimeLeft] = {}
        self._asked: dict[int, Question] = {}  # by panels: those whose answers are timed
        self._asked_at = 0.0
        # By panels: what was shown last while the source moved, since when, and whether it was late.
        self._followed: dict[int, tuple[Shown, float, bool]] = {}
        self._show_soon = QtCore.QTimer(self, singleShot=True, interval=PROGRESS_MS, timeout=self.show)
        self._late_soon = QtCore.QTimer(self, singleShot=True, interval=QUIET_MS, timeout=self._be_late)

    def expect(self, before: Document) -> None:
        """Take note of new questions, in place of those of the document before."""
        session = self._context.session
        if session.loaded() is None:
            self.show()
            return
        asked = {id: each for id, each in session.questions.items() if not session.is_answered(id)}
        if not asked.items() <= self._asked.items():
            self._asked_at = monotonic()
            self._context.status.show_time("")
        self._asked = asked
        if session.is_complete:
            for panel in session.document.panels:
                self.note(panel.id)  # what was stopped may not be asked any more
            return
        self._is_late = False
        self._late_soon.start()
        if self._context[Dragging].is_on:
            for panel in session.document.panels:
                self.note(panel.id)
        else:
            self._followed.clear()
        names = {panel.id: [part.word for part in panel.shows.parts] for panel in before.panels}
        for panel in session.document.panels:
            words = [part.word for part in panel.shows.parts]
            if names.get(panel.id, words) != words and not session.is_answered(panel.id):
                # Never an old field under a new name.
                self._context.grid.panel(panel.id).show_waiting(WAITING)

    def retry(self, id: int) -> None:
        """Compute again what was stopped in a panel."""
        self._context.grid.panel(id).show_waiting(WAITING, is_old=not self._context.session.is_preview(id))
        self._asked, self._asked_at = {each: self._asked[each] for each in self._asked if each == id}, monotonic()
        self._context.session.retry(id)

    def progress_changed(self) -> None:
        """Show the progress soon, or its end at once."""
        if not self._context.session.progress:
            self.show()
        elif not self._show_soon.isActive():
            self._show_soon.start()

    def end(self) -> None:
        """Show no more progress, as the window closes."""
        self._show_soon.stop()
        self._late_soon.stop()

    def _be_late(self) -> None:
        self._is_late = True
        self.show()

    def show(self) -> None:
        """Show the progress of each panel, and of opening a file."""
        self._show_soon.stop()
        context = self._context
        load, session = self._load, context.session
        context.status.show_progress(_sentence(*load) if load is not None else self._checking)
        if session.loaded() is not None:
            for panel in session.document.panels if context.is_built else ():
                self.note(panel.id)
        elif session.is_opening:
            self.opening.emit(_sentence(*load) if load is not None else "Opening…")
        elif context.is_built:
            self.nothing_open.emit()
        self.shown.emit()

    @property
    def _load(self) -> tuple[float, str] | None:
        """Return the progress of reading meshes; None if none are read."""
        load = self._context.session.progress.get("load")
        return load if load is not None and load[1] else None

    @property
    def _checking(self) -> str:
        """Return the progress of checking the accuracy of fields; empty once it is known."""
        session = self._context.session
        fractions = [
            session.progress[panel.id][0]
            for panel in session.document.panels
            if panel.id in session.progress and session.is_answered(panel.id)
        ]
        return _sentence(min(fractions), CHECKING) if fractions and min(fractions) < 1 else ""

    def stop(self, id: int) -> None:
        """Cancel what a panel waits for."""
        session = self._context.session
        session.cancel(None if session.document.panel(id).surface in session.replaced else id)
        self.show()

    def _show_time(self) -> None:
        """Show how long the last fields took, once all are there."""
        session, asked = self._context.session, self._asked
        if asked and all(session.is_answered(id) for id in asked):
            seconds, self._asked = monotonic() - self._asked_at, {}
            took = f"{1000 * seconds:.0f} ms" if seconds < 1 else f"{seconds:.3g} s"
            self._context.status.show_time(f"{counted(len(asked), 'field')} in {took}")

    def note(self, id: int) -> None:
        """Show in a panel what it waits for."""
        context, session = self._context, self._context.session
        self._show_time()
        panel, shown = context.grid.panel(id), session.shown.get(id)
        is_answered = session.is_answered(id)
        fraction, text = session.progress.get(id, (nan, ""))
        if self._load is not None and session.document.panel(id).surface in session.replaced:
            fraction, text = self._load
            panel.show_waiting((fraction, words_of(text)))
        elif session.is_stopped_at(id) and not is_answered:
            panel.show_stopped(shown, is_old=not session.is_preview(id))
        elif is_answered:
            panel.show_waiting(None)  # what is found out of its accuracy is in the status bar
        elif shown is not None and shown.is_preview and not self._is_other(id):
            words = "A preview; the exact field follows"
            panel.show_waiting((fraction, words) if text else None, is_old=False)
        elif context[Dragging].is_on and shown is not None:
            panel.show_behind(self._is_behind(id, shown))
        elif text or self._is_late:
            panel.show_waiting((fraction, self._words(id, fraction, text)) if text else WAITING)

    def _is_behind(self, id: int, shown: Shown) -> bool:
        """Return whether a panel's fields follow the moving source too slowly to be shown as if they were its own."""
        now = monotonic()
        last, since, was_slow = self._followed.get(id, (None, 0.0, False))
        since = max(since, self._context[Dragging].begun)
        if last is not shown:
            was_slow = now - since > BEHIND
            self._followed[id], since = (shown, now, was_slow), now
        return was_slow or now - since > BEHIND

    def _words(self, id: int, fraction: float, text: str) -> str:
        """Return a sentence on the work for a panel, with the time left where that is known and long."""
        left = self._left.setdefault(id, TimeLeft()).words(fraction, text, monotonic())
        return f"{words_of(text)}, {left}" if left else words_of(text)

    def _is_other(self, id: int) -> bool:
        """Return whether a panel shows an old field."""
        shown, document = self._context.session.shown[id], self._context.document
        return [str(spec) for spec in shown.question.specs] != [str(spec) for spec in document.panel(id).shows.specs]


def words_of(text: str) -> str:
    """Return the words before the colon of a progress text."""
    word = text.partition(":")[0].strip()
    return f"{word[:1].upper()}{word[1:]}"


def _sentence(fraction: float, text: str) -> str:
    share = progress_share(fraction)
    return f"{words_of(text)}, {share}" if share else f"{words_of(text)}…"
