"""How long work will still take, by how far it has come since it began."""

BEGUN_S, LONG_S = 3.0, 10.0
"""Seconds after which something can be said, and from which on it is worth saying."""


class TimeLeft:
    """Of one piece of work after the other: a share done that falls is the beginning of the next."""

    def __init__(self) -> None:
        self._first: tuple[float, float] | None = None
        self._last = 0.0

    def words(self, fraction: float, now: float) -> str:
        """ "about 40 s left" of work of which this share is done at a time in seconds; "" while that is not known."""
        if self._first is None or fraction < self._last:
            self._first = (fraction, now)
        self._last = fraction
        first, begun = self._first
        passed, done = now - begun, fraction - first
        if passed < BEGUN_S or done <= 0:
            return ""
        left = passed * (1 - fraction) / done
        if left < LONG_S:
            return ""
        # In steps that do not flicker.
        return f"about {round(left, -1):.0f} s left" if left < 95 else f"about {left / 60:.0f} min left"
