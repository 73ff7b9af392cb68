"""The signals that end a command: Ctrl-C, and SIGTERM, which clusters send at the end of a job's time."""

import _thread
import math
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

GRACE_S = 10.0
"""Seconds in which what was ended writes down what it has, and is not ended again."""

DELAY_S = 0.02
"""Seconds until a signal is tried again where an exception would be lost."""


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

    It and Ctrl-C wait where an exception would be lost. A handler that is there already stays.
    """
    last = -math.inf

    def end(number: int, frame: FrameType | None) -> None:
        nonlocal last
        if _loses_exceptions(frame):
            threading.Timer(DELAY_S, _send, [number]).start()
        elif number == signal.SIGINT:
            raise KeyboardInterrupt
        elif clock() - last >= GRACE_S:
            last = clock()
            raise Terminated

    usual = {signal.SIGTERM: signal.SIG_DFL, signal.SIGINT: signal.default_int_handler}
    if threading.current_thread() is not threading.main_thread():
        usual = {}
    ours = {number: handler for number, handler in usual.items() if signal.getsignal(number) is handler}
    for number in ours:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in ours.items():
            signal.signal(number, handler)


def _send(number: int) -> None:
    if sys.platform == "win32":
        _thread.interrupt_main(number)
    else:
        os.kill(os.getpid(), number)


def _loses_exceptions(frame: FrameType | None) -> bool:
    """Tell whether an exception would be lost: importlib ignores some, and ctypes makes others ArgumentErrors."""
    while frame and frame.f_code.co_name != "from_param" and "<frozen importlib" not in frame.f_code.co_filename:
        frame = frame.f_back
    return frame is not None
