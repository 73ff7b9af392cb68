"""The program from its first moment to its last: Ctrl-C while it is loaded, and standard streams that are closed or
full, end in a sentence.
"""

import errno
import os
import signal
import sys
from contextlib import contextmanager, suppress

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import NoReturn

INTERRUPTED, WRONG = 130, 2
"""Exit statuses."""

UNWRITTEN = [getattr(errno, name, None) for name in ("ENOSPC", "EBADF", "EIO", "EFBIG", "EDQUOT", "EPIPE")]


def run() -> int:
    """The command line; returns its exit status."""
    try:
        with _ended_by_interruption():
            _open_streams()
            from .main import main
        try:
            return main()
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt:
        # Before the command line has begun, or after its end.
        _say("interrupted.")
        return INTERRUPTED
    except OSError as error:
        # Of files our errors tell, or they have a name.
        if error.errno not in UNWRITTEN or error.filename:
            raise
        # Python would try again at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        if error.errno == errno.EPIPE:
            return 0  # whoever read it has seen enough
        reason = "it is closed" if error.errno == errno.EBADF else error.strerror
        _say(f"standard output could not be written: {reason}.")
        return WRONG


@contextmanager
def _ended_by_interruption() -> "Iterator[None]":
    """While modules are loaded nothing has begun, and an exception anywhere in them would be a page of words."""
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, _end)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(number: int, frame: object) -> "NoReturn":
    _say("interrupted.")
    os._exit(INTERRUPTED)


def _say(sentence: str) -> None:
    with suppress(OSError):
        os.write(2, f"bihdist: {sentence}\n".encode())


def _open_streams() -> None:
    """Streams that are closed get something to stand for them, or the next files that are opened would be they."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        try:
            os.fstat(number)
        except OSError:
            # What is written to a standard output that only reads is refused, as it should be.
            there = os.open(os.devnull, os.O_WRONLY if name == "stderr" else os.O_RDONLY)
            if there != number:
                os.dup2(there, number)
                os.close(there)
            os.set_inheritable(number, True)
        if getattr(sys, name) is None:
            mode = "r" if name == "stdin" else "w"
            stream = open(number, mode, encoding="utf-8", errors="backslashreplace", closefd=False)  # noqa: SIM115
            setattr(sys, name, stream)
