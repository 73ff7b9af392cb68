"""The entry point, which turns Ctrl-C during loading, and closed or full standard streams, into one-line messages."""

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
    """Run the command line and return its exit status."""
    try:
        with _ended_by_interruption():
            _open_streams()
            from .main import main
        try:
            return main()
        finally:
            sys.stdout.flush()
    except KeyboardInterrupt:
        # Before the command line starts, or after it ends.
        _say("interrupted.")
        return INTERRUPTED
    except OSError as error:
        # Errors of files have a name; this one is of a stream.
        if error.errno not in UNWRITTEN or error.filename:
            raise
        # Python would flush again at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        if error.errno == errno.EPIPE:
            return 0  # the reader has closed the pipe
        reason = "it is closed" if error.errno == errno.EBADF else error.strerror
        _say(f"standard output could not be written: {reason}.")
        return WRONG


@contextmanager
def _ended_by_interruption() -> "Iterator[None]":
    """End the process on Ctrl-C while modules are imported, where an exception would print a traceback."""
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
    """Open the null device in place of closed standard streams, whose numbers the next open files would get."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        try:
            os.fstat(number)
        except OSError:
            # Writing to this read-only standard output fails, as it should.
            there = os.open(os.devnull, os.O_WRONLY if name == "stderr" else os.O_RDONLY)
            if there != number:
                os.dup2(there, number)
                os.close(there)
            os.set_inheritable(number, True)
        if getattr(sys, name) is None:
            mode = "r" if name == "stdin" else "w"
            stream = open(number, mode, encoding="utf-8", errors="backslashreplace", closefd=False)  # noqa: SIM115
            setattr(sys, name, stream)
