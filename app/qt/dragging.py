"""Something that fields follow, on its way: a source, a point that a tool has marked, or a parameter's slider."""

import time
from collections import deque
from time import monotonic

from bihdist_core.counts import counted

from ..session.session import Session
from .context import Context
from .status_bar import StatusBar


class Dragging:
    """The drag that is going on in a window, if any.

    Attributes
    ----------
    is_on
        Whether something is held, so that panels that are a moment behind say nothing of it.
    rate
        The rate at which fields follow.
    begun
        The time at which it began to move, by the monotonic clock; 0 while it rests.
    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self.is_on, self.begun = False, 0.0
        self.rate = LiveRate(context.session, context.status)

    def begin(self, keeps_steps: bool = True) -> None:
        """Start a drag, unless one goes on; isolines keep their steps meanwhile where what moves is a source."""
        self.begun = self.begun or monotonic()
        self.rate.begin()
        self._context.grid.marks.keep_steps(keeps_steps)

    def end(self) -> None:
        """End the drag."""
        self.begun = 0.0
        self.rate.end()
        self._context.grid.marks.keep_steps(False)


SPAN = 1.0
"""Seconds that are counted over."""

SAY_EVERY = 0.25


class LiveRate:
    """How many answers a second are shown while the source follows the pointer, for the status bar."""

    def __init__(self, session: Session, status: StatusBar) -> None:
        self._session, self._status = session, status
        self._shown: deque[float] = deque()
        self._begun = self._told = 0.0
        self._is_going = False

    def begin(self) -> None:
        """Start counting, unless it has begun."""
        if not self._is_going:
            self._is_going, self._begun = True, time.monotonic()
            self._shown.clear()

    def note(self) -> None:
        """Count a field that a panel shows."""
        if not self._is_going:
            return
        now = time.monotonic()
        self._shown.append(now)
        if now - self._told > SAY_EVERY and now - self._begun > SAY_EVERY:
            self._told = now
            self._status.show_rate(self._words(now))

    def end(self) -> None:
        """Stop counting."""
        if self._is_going:
            self._is_going = False
            self._status.show_rate("")

    def _words(self, now: float) -> str:
        while self._shown and now - self._shown[0] > SPAN:
            self._shown.popleft()
        rate = len(self._shown) / min(now - self._begun, SPAN)
        shown = self._session.shown.values()
        quick = dict.fromkeys(each.answer.label for each in shown if each.is_preview)
        ending = f"; {', '.join(quick)}" if quick else ""
        return f"Live: {counted(round(rate), 'field')} a second{ending}"
