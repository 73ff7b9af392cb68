"""What keeps tests from depending on how busy the machine is: how long they wait, and what slow work says meanwhile."""

import re
import time
from collections.abc import Callable

PATIENCE = 600
"""Seconds after which what a test waits for is taken not to come: far longer than it takes on a busy machine."""

PROGRESS = re.compile(r"bihdist: (\d+% .*|under way|\d+ of \d+ done, others under way)\n")
"""A line of progress, which a command says every ten seconds where it is slow."""


def until(is_so: Callable[[], bool]) -> None:
    """Wait until something is so."""
    end = time.monotonic() + PATIENCE
    while not is_so():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.005)


def without_progress(said: str) -> str:
    """Return what a command has said on standard error, but for lines of progress."""
    return PROGRESS.sub("", said)
