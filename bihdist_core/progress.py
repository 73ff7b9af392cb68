"""Progress reports: any callable `progress(fraction, text)`; raising `Cancelled` from it stops the work."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Progress = Callable[[float, str], None]
"""Called with the share done so far, 0 to 1, and what is being done."""

REPORT_EVERY = 0.1
"""Seconds between two reports while something is waited for, hence until a cancellation acts."""


def silent(fraction: float, text: str) -> None:
    """The progress nobody watches."""


def part(progress: Progress | None, start: float, stop: float) -> Progress:
    """The progress of one step of a longer work: its 0 to 1 becomes start to stop of the whole."""
    if progress is None or progress is silent:
        return silent
    return lambda fraction, text: progress(start + (stop - start) * fraction, text)


@contextmanager
def turn(lock: "threading.Lock | threading.RLock", progress: Progress | None, waiting: str) -> Iterator[None]:
    """Hold a lock; the progress is told `waiting` while somebody else does, and what it raises ends the waiting."""
    while not lock.acquire(timeout=REPORT_EVERY):
        (progress or silent)(0.0, waiting)
    try:
        yield
    finally:
        lock.release()
