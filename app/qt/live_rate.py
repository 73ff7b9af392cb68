"""How many fields a second follow the source while it moves, in the status bar."""

import time
from collections import deque

from ..session.session import Session
from .status_bar import StatusBar

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
        """The source begins to move; nothing while it does."""
        if not self._is_going:
            self._is_going, self._begun = True, time.monotonic()
            self._shown.clear()

    def note(self) -> None:
        """A panel shows another field."""
        if not self._is_going:
            return
        now = time.monotonic()
        self._shown.append(now)
        if now - self._told > SAY_EVERY and now - self._begun > SAY_EVERY:
            self._told = now
            self._status.show_rate(self._words(now))

    def end(self) -> None:
        """It rests."""
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
        return f"Live: {rate:.0f} fields a second{ending}"
