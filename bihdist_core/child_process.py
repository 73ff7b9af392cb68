"""A script that works in a process of its own: what it imports may hold the interpreter lock, or crash.

It is a plain script with pipes: unlike multiprocessing's "spawn" it never imports the user's main program again, so
scripts need no `if __name__ == "__main__"`.  It can be killed at any time.
"""

import io
import os
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from typing import BinaryIO, cast

import numpy as np

LIMITS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS", "LP_NUM_THREADS")

DIED = "the process that computes it died"
"""Why there is no answer, where the process does not say it."""

SERVED = Path(__file__).with_name("_served_child.py")
"""The script that calls `serve(requests, answers)` of a module of ours, whose name `framed` is what it reads first."""

ANSWER, WRONG, REPORT = 0, 1, 2
"""What a process sends: an answer, what is wrong instead of one, and before either any number of reports."""


def framed(content: bytes | memoryview) -> bytes:
    """A number of bytes as int64, and these; `unframed` reads them."""
    return len(content).to_bytes(8, sys.byteorder) + content


def unframed(requests: BinaryIO) -> bytes:
    """What was `framed`; nothing if the other side has ended."""
    count = int.from_bytes(requests.read(8), sys.byteorder)
    content = requests.read(count)
    return content if len(content) == count else b""


def send(answers: BinaryIO, status: int, pieces: Sequence[bytes | memoryview]) -> None:
    """What a process answers, from any of its threads but one at a time."""
    count = sum(memoryview(piece).nbytes for piece in pieces)
    answers.write(status.to_bytes(8, sys.byteorder) + count.to_bytes(8, sys.byteorder))
    for piece in pieces:
        answers.write(piece)
    answers.flush()


class ChildProcess:
    """A script in a process of its own, and the pipes to and from it.

    The script is started with the parent's import path as arguments, reads `first` and then requests, and answers each
    with two int64, `ANSWER` (or `WRONG`) and a number of bytes, and as many bytes: the answer, or a text in UTF-8 that
    says what is wrong; a `REPORT` before it is no answer.  Nobody asks before the last answer has come; the process
    ends with this object.

    threads: how many its BLAS and software OpenGL may use, as many as they like if None.
    """

    def __init__(self, script: Path, first: bytes, threads: int | None = 1) -> None:
        # Sent with the first request, by its thread: a pipe holds 64 kB and the process reads once it has started.
        self._unsent = first
        self.process = subprocess.Popen(
            [sys.executable, str(script), *(p or os.getcwd() for p in sys.path if isinstance(p, str))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # Unbuffered files have no lock that a thread could still hold when the interpreter exits.
            bufsize=0,
            # BLAS threads cost start-up time and memory.
            env={**os.environ, **({} if threads is None else dict.fromkeys(LIMITS, str(threads)))},
            # No console window flashes up on Windows.
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._readers: list[threading.Thread] = []
        # Who ends the process while another thread asks waits for a reader that has started, or comes before it.
        self._starting = threading.Lock()
        self.end = weakref.finalize(self, _end, self.process, self._readers, self._starting)

    def ask(
        self, request: bytes | Sequence[bytes | memoryview], report: Callable[[memoryview], object] = lambda told: None
    ) -> "SimpleQueue[memoryview | str]":
        """A queue that will hold the answer, or a text that says why there is none.

        request: in one piece or in several, which are not put together: that would hold up other threads.
        report: takes each report, on a thread of its own.
        """
        answers: SimpleQueue[memoryview | str] = SimpleQueue()
        message = [self._unsent, *([request] if isinstance(request, bytes) else request)]
        self._unsent = b""
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
    process: subprocess.Popen[bytes],
    message: Sequence[bytes | memoryview],
    answers: "SimpleQueue[memoryview | str]",
    report: Callable[[memoryview], object],
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
            report(content)
        answers.put(bytes(content).decode() if status == WRONG else content)
    except (OSError, ValueError, EOFError):
        answers.put(DIED)


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
