"""How long work will still take, by how far it has come since it began."""

from bihdist_core.expected_time import LONG_S, duration_in, duration_words

BEGUN_S = 3.0
"""Seconds after which something can be said by what has been done."""


class TimeLeft:
    """The time left of one piece of work after the other; a fraction done that falls begins the next."""

    def __init__(self) -> None:
        self._first: tuple[float, float] | None = None
        self._last = 0.0

    def words(self, fraction: float, text: str, now: float) -> str:
        """ "about 40 s left" of work of which this share is done at a time in seconds; "" where that is not known.

        Before it is known, "about 40 s" where the text of the progress says what is expected.
        """
        if self._first is None or fraction < self._last:
            self._first = (fraction, now)
        self._last = fraction
        first, begun = self._first
        passed, done = now - begun, fraction - first
        if passed < BEGUN_S or done <= 0:
            return duration_in(text)
        left = passed * (1 - fraction) / done
        return f"{duration_words(left)} left" if left >= LONG_S else ""
