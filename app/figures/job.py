"""Drawing in a process of its own, so that a window neither waits nor shares its OpenGL with the drawing."""

import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import BinaryIO

from bihdist_core import Cancelled
from bihdist_core.progress import Progress

from .worker import GONE, failure_sentence

Ended = Callable[[str | None], None]
"""Called with nothing when the file is there, otherwise with the sentence why not; "" if it was cancelled."""


class FigureJob:
    """Runs `work(progress=...)`, a function that can be pickled, in another process.

    Both functions are called on a thread of the job's.
    """

    def __init__(self, work: Callable[..., None], progress: Progress, ended: Ended) -> None:
        self._progress, self._ended = progress, ended
        self._cancelled = False
        # The package is called app in a checkout and otherwise when installed; it is found where this one was.
        paths = os.pathsep.join(p or os.getcwd() for p in sys.path)
        self._process = subprocess.Popen(
            [sys.executable, "-m", __name__],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": paths},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._work = pickle.dumps(work)
        self._thread = threading.Thread(target=self._follow, name="figure", daemon=True)
        self._thread.start()

    def cancel(self) -> None:
        """Stop; what was at the path stays, and no half file is left."""
        self._cancelled = True
        with suppress(OSError):
            self._process.stdin.close()

    @property
    def is_running(self) -> bool:
        return self._thread.is_alive()

    def wait(self, timeout: float | None = None) -> None:
        self._thread.join(timeout)

    def _follow(self) -> None:
        message: str | None = GONE
        try:
            message = self._said()
        finally:  # whatever happens, somebody waits for the end
            self._process.stdout.close()
            with suppress(OSError):
                self._process.stdin.close()
            self._process.wait()
            self._ended("" if self._cancelled and message is not None else message)

    def _said(self) -> str | None:
        """What the process says of its end; of its progress meanwhile."""
        message: str | None = GONE
        with suppress(OSError, ValueError):  # it ended, or was cancelled; what it says tells which
            self._process.stdin.write(len(self._work).to_bytes(8, "little") + self._work)
            self._process.stdin.flush()
        for line in self._process.stdout:
            kind, _, text = line.decode("utf-8", "replace").rstrip("\r\n").partition(" ")
            if kind == "progress":
                share, _, words = text.partition(" ")
                self._progress(float(share), words)
            elif kind == "done":
                message = None
            elif kind == "failed":
                message = text or GONE
        return message


def main() -> None:
    """The process: the work comes in, lines of progress go out; it stops when its input is closed."""
    out = os.fdopen(os.dup(sys.stdout.fileno()), "wb", buffering=0)
    # What a library prints must not be taken for progress.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    incoming = sys.stdin.buffer
    size = int.from_bytes(incoming.read(8), "little")
    content = incoming.read(size)
    if not size or len(content) < size:
        return
    closed = threading.Event()
    threading.Thread(target=_wait_for_end, args=(incoming, closed), daemon=True).start()

    def progress(fraction: float, text: str) -> None:
        if closed.is_set():
            raise Cancelled("The drawing was cancelled.")
        out.write(f"progress {fraction:.4f} {' '.join(text.split())}\n".encode(errors="replace"))

    try:
        work: Callable[..., None] = pickle.loads(content)
        work(progress=progress)
        out.write(b"done\n")
    except BaseException as error:  # also what would end the process, which says nothing by itself
        with suppress(OSError):  # nobody listens any more
            out.write(f"failed {failure_sentence(error)}\n".encode(errors="replace"))


def _wait_for_end(incoming: BinaryIO, closed: threading.Event) -> None:
    incoming.read(1)
    closed.set()


if __name__ == "__main__":
    main()
    # A thread still reads the input; the interpreter would wait for its lock.
    sys.stderr.flush()
    os._exit(0)
