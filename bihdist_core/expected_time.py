"""How long work is expected to take: from how much of it there is, and from how fast this process has been so far."""

import time

from .progress import Progress, part, silent

SECONDS = {
    "ordering": 2e-6,
    "plain ordering": 8e-5,
    "factor": 7e-11,
    "plain factor": 6e-10,
    "eigenpairs": 1e-10,
    "windows": 1.6e-7,
    "virtual sources": 5e-7,
}
"""Of an idle core for a unit of each kind of work: vertices to be ordered, multiplications of a factor and of
eigenpairs, windows of exact geodesics and vertices of approximate ones.  A beginning: how fast this machine is and how
busy is found out on the way."""

LONG_S = 10.0
"""Shorter work is not spoken of."""

TELLING_S = 0.1
"""Work that takes so long, and is expected to by SECONDS, tells how fast the machine is: less is mostly beginnings and
ends, and little work that something else held up seems thousands of times as slow as it is."""

_slowness = 1.0
"""How many times as long as SECONDS says the last work took, of whatever kind: what keeps a machine busy slows all."""


def expected_seconds(kind: str, work: float, cores: int = 1) -> float:
    """Return the seconds that units of a kind of work are expected to take on so many cores."""
    return SECONDS[kind] * work / cores * _slowness


class Expected:
    """A piece of long work, while it is done; `done`, to be set where that is another amount, tells of the machine.

    The texts of `progress` say how long all of it is expected to take, where that is long.
    """

    def __init__(self, kind: str, work: float, cores: int, progress: Progress | None) -> None:
        self.done = work
        self._seconds_each, self._begun = SECONDS[kind] / cores, time.monotonic()
        self.progress = _with_duration(part(progress, 0, 1), duration_words(expected_seconds(kind, work, cores)))

    def __enter__(self) -> "Expected":
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        global _slowness
        took, usual = time.monotonic() - self._begun, self._seconds_each * self.done
        if kind is None and min(took, usual) >= TELLING_S:
            _slowness = took / usual


def _with_duration(report: Progress, duration: str) -> Progress:
    """Return the progress, with a duration after the first words of each text; the same where there is nothing to
    add."""
    if not duration or report is silent:
        return report
    return lambda fraction, text: report(fraction, f"{text.partition(':')[0]}: {duration}")


def duration_words(seconds: float) -> str:
    """Return "about 40 s", "about 3 min" or "about 2 h", as exactly as can be guessed; "" for short work."""
    if seconds < LONG_S:
        return ""
    if seconds < 95:
        return f"about {round(seconds, -1):.0f} s"
    return f"about {seconds / 60:.0f} min" if seconds < 95 * 60 else f"about {seconds / 3600:.0f} h"


def duration_in(text: str) -> str:
    """Return the duration in a text of the progress of `Expected`; "" for other texts."""
    detail = text.partition(": ")[2]
    return detail if detail.startswith("about ") else ""
