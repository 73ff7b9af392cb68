"""Progress reports: any callable `progress(fraction, text)`; raising `Cancelled` from it stops the work."""

from collections.abc import Callable

Progress = Callable[[float, str], None]
"""Called with the share done so far, 0 to 1, and what is being done."""


def silent(fraction: float, text: str) -> None:
    """The progress nobody watches."""


def part(progress: Progress | None, start: float, stop: float) -> Progress:
    """The progress of one step of a longer work: its 0 to 1 becomes start to stop of the whole."""
    if progress is None:
        return silent
    return lambda fraction, text: progress(start + (stop - start) * fraction, text)
