"""What the window says while something is computed: in the panel that waits for it, and on meshes being read."""

from math import nan
from time import monotonic

from qtpy import QtCore

from ..document.document import Document
from ..session.time_left import TimeLeft
from .context import Context
from .dragging import Dragging

PROGRESS_MS = 200
"""How often progress is shown at most."""

QUIET_MS = 150
"""What takes less is not spoken of: it would flicker."""

WAITING = (nan, "Waiting")


class ProgressDisplay(QtCore.QObject):
    """shown: what goes on has been told."""

    shown = QtCore.Signal()
    opening = QtCore.Signal(str)  # the first mesh is being read: how far that is, in words
    nothing_open = QtCore.Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._is_late = False
        self._left: dict[int, TimeLeft] = {}
        self._show_soon = QtCore.QTimer(self, singleShot=True, interval=PROGRESS_MS, timeout=self.show)
        self._late_soon = QtCore.QTimer(self, singleShot=True, interval=QUIET_MS, timeout=self._be_late)

    def expect(self, before: Document) -> None:
        """Something new may have been asked; before: what was shown."""
        session = self._context.session
        if session.is_complete:
            for panel in session.document.panels:
                self.note(panel.id)  # what was stopped may not be asked any more
            return
        self._is_late = False
        self._late_soon.start()
        names = {panel.id: [part.word for part in panel.shows.parts] for panel in before.panels}
        for panel in session.document.panels:
            words = [part.word for part in panel.shows.parts]
            if names.get(panel.id, words) != words and not session.is_answered(panel.id):
                # Never an old field under a new name.
                self._context.grid.panel(panel.id).show_waiting(WAITING)

    def retry(self, id: int) -> None:
        """Let what was stopped in a panel be computed again."""
        self._context.grid.panel(id).show_waiting(WAITING, is_old=not self._context.session.is_quick_look(id))
        self._context.session.retry(id)

    def progress_changed(self) -> None:
        """Show the progress soon, or its end at once."""
        if not self._context.session.progress:
            self.show()
        elif not self._show_soon.isActive():
            self._show_soon.start()

    def end(self) -> None:
        """There is nothing to wait for."""
        self._show_soon.stop()
        self._late_soon.stop()

    def _be_late(self) -> None:
        self._is_late = True
        self.show()

    def show(self) -> None:
        """Show how far each panel's work is, and opening a file."""
        self._show_soon.stop()
        context = self._context
        load, session = self._load, context.session
        context.status.show_progress(_sentence(*load) if load is not None else "")
        if session.surface is not None:
            for panel in session.document.panels if context.is_built else ():
                self.note(panel.id)
        elif session.is_opening:
            self.opening.emit(_sentence(*load) if load is not None else "Opening…")
        elif context.is_built:
            self.nothing_open.emit()
        self.shown.emit()

    @property
    def _load(self) -> tuple[float, str] | None:
        """How far the reading of meshes is, and what is being done; None where nothing is."""
        load = self._context.session.progress.get("load")
        return load if load is not None and load[1] else None

    def stop(self, id: int) -> None:
        """What a panel waits for is no longer wanted."""
        session = self._context.session
        session.cancel(None if session.document.panel(id).surface in session.replaced else id)
        self.show()

    def note(self, id: int) -> None:
        """Say in a panel what it is waiting for."""
        context, session = self._context, self._context.session
        panel, shown = context.grid.panel(id), session.shown.get(id)
        is_answered = session.is_answered(id)
        fraction, text = session.progress.get(id, (nan, ""))
        if self._load is not None and session.document.panel(id).surface in session.replaced:
            fraction, text = self._load
            panel.show_waiting((fraction, words_of(text)))
        elif session.is_stopped_at(id) and not is_answered:
            panel.show_stopped(shown, is_old=not session.is_quick_look(id))
        elif is_answered or (shown is not None and shown.is_preview and not self._is_other(id)):
            # A quick look, which the exact answer follows, or one whose accuracy is being found out.
            words = "Checking the accuracy" if is_answered else "A quick look; the exact one follows"
            panel.show_waiting((fraction, words) if text else None, is_old=False)
        elif context[Dragging].is_on and shown is not None:
            panel.show_waiting(None)  # it is a moment behind, all the time
        elif text or self._is_late:
            panel.show_waiting((fraction, self._words(id, fraction, text)) if text else WAITING)

    def _words(self, id: int, fraction: float, text: str) -> str:
        """What is being done in a panel, and for how long, where that is known and long."""
        left = self._left.setdefault(id, TimeLeft()).words(fraction, text, monotonic())
        return f"{words_of(text)}, {left}" if left else words_of(text)

    def _is_other(self, id: int) -> bool:
        """Whether what a panel shows is not what it is asked for now."""
        shown, document = self._context.session.shown[id], self._context.document
        return [str(spec) for spec in shown.asked.specs] != [str(spec) for spec in document.panel(id).shows.specs]


def words_of(text: str) -> str:
    """What is being done, in a word or two for the user: what stands before the colon."""
    word = text.partition(":")[0].strip()
    return f"{word[:1].upper()}{word[1:]}"


def _sentence(fraction: float, text: str) -> str:
    return f"{words_of(text)}, {fraction:.0%}".replace("%", " %")
