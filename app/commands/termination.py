"""What ends a command from outside: Ctrl-C, and SIGTERM, which clusters send at the end of a job's time."""

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

GRACE = 10.0
"""Seconds in which what was ended writes down what it has, and is not ended again."""


class Terminated(KeyboardInterrupt):
    """SIGTERM: whatever is under way ends as it does by Ctrl-C."""


def status_of(error: KeyboardInterrupt) -> int:
    """The exit status, as shells have it: 128 and the signal's number."""
    return 128 + (signal.SIGTERM if isinstance(error, Terminated) else signal.SIGINT)


def words_of(error: KeyboardInterrupt) -> str:
    """What has ended a command."""
    return "ended by SIGTERM" if isinstance(error, Terminated) else "interrupted"


@contextmanager
def termination_raised(clock: Callable[[], float] = time.monotonic) -> Iterator[None]:
    """SIGTERM raises Terminated on the main thread, and another one soon after, while that is dealt with, nothing.

    Where somebody else listens for it already, it is theirs.
    """
    is_free = signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    if not is_free or threading.current_thread() is not threading.main_thread():
        yield
        return

    last = -math.inf

    def end(number: int, frame: object) -> None:
        nonlocal last
        now = clock()
        if now - last >= GRACE:
            last = now
            raise Terminated

    signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
