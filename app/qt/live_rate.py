"""How many fields a second follow the source while it moves, in the status bar.  `window` is the main window."""

import time
from collections import deque

SPAN = 1.0
"""Seconds that are counted over."""

SAY_EVERY = 0.25


class LiveRate:
    """See the module."""

    def __init__(self, window) -> None:
        self._window = window
        self._shown: deque[float] = deque()
        self._begun = self._said = 0.0
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
        if now - self._said > SAY_EVERY and now - self._begun > SAY_EVERY:
            self._said = now
            self._window.status.show_rate(self._words(now))

    def end(self) -> None:
        """It rests."""
        if self._is_going:
            self._is_going = False
            self._window.status.show_rate("")

    def _words(self, now: float) -> str:
        while self._shown and now - self._shown[0] > SPAN:
            self._shown.popleft()
        rate = len(self._shown) / min(now - self._begun, SPAN)
        shown = self._window.session.shown.values()
        quick = dict.fromkeys(each.answer.label for each in shown if each.is_preview)
        ending = f"; {', '.join(quick)}, until it rests" if quick else ""
        return f"Live: {rate:.0f} fields a second{ending}"
