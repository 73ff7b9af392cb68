"""The signals that end a command: Ctrl-C, and SIGTERM, which clusters send at the end of a job's time."""

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

GRACE_S = 10.0
"""Seconds in which what was ended writes down what it has, and is not ended again."""


class Terminated(KeyboardInterrupt):
    """SIGTERM: whatever is under way ends as it does by Ctrl-C."""


def status_of(error: KeyboardInterrupt) -> int:
    """Return the exit status of shells, 128 and the signal's number."""
    return 128 + (signal.SIGTERM if isinstance(error, Terminated) else signal.SIGINT)


def words_of(error: KeyboardInterrupt) -> str:
    """Say how a command was ended."""
    return "ended by SIGTERM" if isinstance(error, Terminated) else "interrupted"


@contextmanager
def termination_raised(clock: Callable[[], float] = time.monotonic) -> Iterator[None]:
    """Let SIGTERM raise Terminated on the main thread, and ignore another one soon after, while that is handled.

    A handler that is there already stays.
    """
    is_free = signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    if not is_free or threading.current_thread() is not threading.main_thread():
        yield
        return

    last = -math.inf

    def end(number: int, frame: object) -> None:
        nonlocal last
        now = clock()
        if now - last >= GRACE_S:
            last = now
            raise Terminated

    signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
