"""A module that serves in a process of its own: what it imports may hold the interpreter lock, or crash.

The process runs a plain script with pipes: unlike multiprocessing's "spawn" it never imports the user's main program
again, so scripts need no `if __name__ == "__main__"`.  It can be killed at any time.
"""

import io
import os
import pickle
import subprocess
import sys
import threading
import weakref
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import BinaryIO, TypeAlias, cast

import numpy as np

from .progress import Progress, silent

THREAD_VARIABLES = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS", "LP_NUM_THREADS")

DIED_REASON = "the process that computes it died"
"""The reason for a missing answer where the process gave none."""

SERVER_SCRIPT = Path(__file__).with_name("_served_child.py")
"""The script that calls `serve(requests, answers)` of the module whose name it reads first."""

Piece: TypeAlias = bytes | memoryview
Pieces: TypeAlias = Sequence[Piece]
"""Bytes that are not put together, which would hold up other threads."""

ANSWER, WRONG, REPORT = 0, 1, 2
"""What a process sends: an answer, what is wrong instead of one, and before either any number of reports."""


def _framed(pieces: Pieces) -> list[Piece]:
    """Put the number of bytes before them, as int64."""
    return [sum(memoryview(piece).nbytes for piece in pieces).to_bytes(8, sys.byteorder), *pieces]


def read_request(requests: BinaryIO) -> bytes:
    """Read a request in the process; nothing if the other side has ended."""
    count = int.from_bytes(requests.read(8), sys.byteorder)
    content = requests.read(count)
    return content if len(content) == count else b""


def send(answers: BinaryIO, status: int, pieces: Pieces) -> None:
    """Write an answer of the process, from any of its threads but one at a time."""
    for piece in (status.to_bytes(8, sys.byteorder), *_framed(pieces)):
        answers.write(piece)
    answers.flush()


def send_report(answers: BinaryIO, fraction: float, text: str) -> None:
    """Write how far the process is."""
    send(answers, REPORT, [pickle.dumps((fraction, text))])


class ChildProcess:
    """A process in which a module serves, and the pipes to and from it.

    Its `serve(requests, answers)` takes each request by `read_request`, may `send_report`, and sends an `ANSWER`, or
    as `WRONG` a text in UTF-8 that says what is wrong. Nobody asks before the last answer has come; the process ends
    with this object.

    Parameters
    ----------
    module : str
        The full name of the module.
    threads : int or None
        How many threads its BLAS and software OpenGL may use, as many as they like if None.
    """

    def __init__(self, module: str, threads: int | None = 1) -> None:
        # Sent with the first request, by its thread: a pipe holds 64 kB and the process reads once it has started.
        self._unsent = _framed([module.encode()])
        self.process = subprocess.Popen(
            [sys.executable, str(SERVER_SCRIPT), *(p or os.getcwd() for p in sys.path if isinstance(p, str))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # Unbuffered files have no lock that a thread could still hold when the interpreter exits.
            bufsize=0,
            # BLAS threads cost start-up time and memory.
            env={**os.environ, **({} if threads is None else dict.fromkeys(THREAD_VARIABLES, str(threads)))},
            # No console window flashes up on Windows.
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._readers: list[threading.Thread] = []
        # Who ends the process while another thread asks waits for a reader that has started, or comes before it.
        self._starting = threading.Lock()
        self.end = weakref.finalize(self, _end, self.process, self._readers, self._starting)

    def ask(self, request: Pieces, report: Progress = silent) -> "SimpleQueue[memoryview | str]":
        """Send a request and return a queue that will hold the answer, or a text that says why there is none.

        `report` is called with each report, on a thread of its own.
        """
        answers: SimpleQueue[memoryview | str] = SimpleQueue()
        message = [*self._unsent, *_framed(request)]
        self._unsent = []
        # A thread per request, as pipes cannot be waited for with a time limit on Windows; a daemon, as it must not
        # keep the interpreter alive.  It holds the process, not this object, which may be collected meanwhile.
        reader = threading.Thread(target=_converse, args=(self.process, message, answers, report), daemon=True)
        with self._starting:
            self._readers[:] = [reader]
            reader.start()
        return answers

    def stop(self) -> None:
        """Let it know that nothing more is asked, and its answer not needed; a script that notices ends by itself."""
        with suppress(OSError):
            cast(io.FileIO, self.process.stdin).close()


def _converse(
    process: subprocess.Popen[bytes], message: Pieces, answers: "SimpleQueue[memoryview | str]", report: Progress
) -> None:
    requests, replies = cast(io.FileIO, process.stdin), cast(io.FileIO, process.stdout)
    try:
        for piece in message:
            rest = memoryview(piece)
            while len(rest):
                rest = rest[requests.write(rest) :]
        while True:
            status, count = (int.from_bytes(_read(replies, 8), sys.byteorder) for _ in range(2))
            content = _read(replies, count)
            if status != REPORT:
                break
            report(*pickle.loads(content))
        answers.put(bytes(content).decode() if status == WRONG else content)
    except (OSError, ValueError, EOFError):
        answers.put(DIED_REASON)


def _read(pipe: io.FileIO, count: int) -> memoryview:
    # A bytearray would be cleared first, for which other threads stand still: a tenth of a second for 200 MB.
    content = rest = np.empty(count, np.uint8).data
    while len(rest):
        got = pipe.readinto(rest)
        if not got:
            raise EOFError
        rest = rest[got:]
    return content


def _end(process: subprocess.Popen[bytes], readers: list[threading.Thread], starting: threading.Lock) -> None:
    """Kill, and wait so that no zombie is left; a killed process takes no time to end, nor does its reader."""
    process.kill()
    process.wait()
    with starting:
        for reader in readers:
            reader.join(timeout=1)
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                pipe.close()
