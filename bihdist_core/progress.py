"""Progress reports: any callable `progress(fraction, text)`; raising `Cancelled` from it stops the work."""

import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from .arrays import IntArray

Item = TypeVar("Item")

Progress = Callable[[float, str], None]
"""Called with the share done so far, 0 to 1, and what is being done."""

REPORT_EVERY_S = 0.1
"""Seconds between two reports while something is waited for, hence until a cancellation acts."""


def silent(fraction: float, text: str) -> None:
    """Report nothing."""


def part(progress: Progress | None, start: float, stop: float) -> Progress:
    """Return the progress of one step of a longer work: its 0 to 1 becomes start to stop of the whole."""
    if progress is None or progress is silent:
        return silent
    return lambda fraction, text: progress(start + (stop - start) * fraction, text)


def steps(progress: Progress | None, items: Iterable[Item]) -> Iterator[tuple[Progress, Item]]:
    """Yield each of some items with the progress of its equal step of the whole work."""
    items = list(items)
    for k, item in enumerate(items):
        yield part(progress, k / len(items), (k + 1) / len(items)), item


def blocks(progress: Progress | None, items: "IntArray", size: int) -> "Iterator[tuple[Progress, int, IntArray]]":
    """Yield the items (k,) in blocks, each with its progress of the whole work and the place of its first item."""
    for start in range(0, len(items), size):
        block = items[start : start + size]
        yield part(progress, start / len(items), (start + len(block)) / len(items)), start, block


@contextmanager
def turn(lock: "threading.Lock | threading.RLock", progress: Progress | None, waiting: str) -> Iterator[None]:
    """Hold a lock; the progress is told `waiting` while somebody else does, and what it raises ends the waiting."""
    while not lock.acquire(timeout=REPORT_EVERY_S):
        (progress or silent)(0.0, waiting)
    try:
        yield
    finally:
        lock.release()
