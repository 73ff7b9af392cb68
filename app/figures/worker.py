"""A process that stays alive and draws: it is asked one thing after another, and is sent each large array only once.

A window asks it for previews, a movie asks several for its frames.  It ends with whoever started it.
"""

import io
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any, BinaryIO

import numpy as np

from bihdist_core import BihdistError, Surface

LARGE = 1 << 15
"""Bytes from which an array is sent once and then named."""

GONE = "The process that draws ended without a word; perhaps there is not enough memory, or no OpenGL."


class Worker:
    """Only one thread may ask at a time; any may `close`.

    threads: how many its numerical libraries and software OpenGL may use, as many as they like if None.
    """

    def __init__(self, threads: int | None = None) -> None:
        # The package is called app in a checkout and otherwise when installed; it is found where this one was.
        paths = os.pathsep.join(p or os.getcwd() for p in sys.path)
        limits = {name: str(threads) for name in ("LP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")}
        self._sent: dict[int, Any] = {}
        self._process = subprocess.Popen(
            [sys.executable, "-m", __name__],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": paths, **(limits if threads else {})},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )

    def ask(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """What the function makes of the arguments there; all three must pickle.  BihdistError if it cannot."""
        file = io.BytesIO()
        sender = _Sender(file, self._sent)
        sender.dump((function, arguments))
        # What this does not need is not needed any more, here and there.
        self._sent = sender.used
        try:
            _send(self._process.stdin, file.getbuffer())
            answer = _received(self._process.stdout)
        except (OSError, ValueError):  # its pipe is broken, or closed by `close`
            answer = b""
        if not answer:
            raise BihdistError(GONE)
        is_done, result = pickle.loads(answer)
        if not is_done:
            raise BihdistError(result)
        return result

    def close(self) -> None:
        """End it, whatever it does; it writes no files."""
        self._process.kill()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                pipe.close()


class _Sender(pickle.Pickler):
    """Surfaces and large arrays that have been sent before are only named.

    sent: the things sent so far, by what they are called; used: those of them, old and new, in what is pickled now.
    """

    def __init__(self, file: io.BytesIO, sent: dict[int, Any]) -> None:
        super().__init__(file, pickle.HIGHEST_PROTOCOL)
        self._sent = sent
        self.used: dict[int, Any] = {}

    def persistent_id(self, thing: Any) -> tuple[int, bytes | None] | None:
        if not isinstance(thing, Surface) and not (isinstance(thing, np.ndarray) and thing.nbytes >= LARGE):
            return None
        key = id(thing)
        is_there = self._sent.get(key) is thing or self.used.get(key) is thing
        self.used[key] = thing
        return key, None if is_there else pickle.dumps(thing, pickle.HIGHEST_PROTOCOL)


class _Receiver(pickle.Unpickler):
    def __init__(self, content: bytes, kept: dict[int, Any]) -> None:
        super().__init__(io.BytesIO(content))
        self._kept = kept
        self.used: dict[int, Any] = {}

    def persistent_load(self, name: tuple[int, bytes | None]) -> Any:
        key, content = name
        if content is not None:
            self.used[key] = pickle.loads(content)
        elif key not in self.used:
            self.used[key] = self._kept[key]
        return self.used[key]


def _send(pipe: BinaryIO, content: bytes | memoryview) -> None:
    pipe.write(len(content).to_bytes(8, "little"))
    pipe.write(content)
    pipe.flush()


def _received(pipe: BinaryIO) -> bytes:
    """Nothing if the other side has ended."""
    size = int.from_bytes(pipe.read(8), "little")
    content = pipe.read(size)
    return content if len(content) == size else b""


def failure_sentence(error: BaseException) -> str:
    """What is said of something that could not be drawn."""
    if isinstance(error, BihdistError):
        return " ".join(str(error).split())
    if isinstance(error, MemoryError):
        return "There is not enough memory for a picture of this size."
    words = " ".join(str(error).split())
    return f"The picture could not be drawn ({type(error).__name__}{': ' if words else ''}{words[:200]})."


def main() -> None:
    """The process: questions come in, answers go out, until its input ends."""
    out = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    # What a library prints must not be taken for an answer.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    kept: dict[int, Any] = {}
    while content := _received(sys.stdin.buffer):
        try:
            receiver = _Receiver(content, kept)
            function, arguments = receiver.load()
            kept = receiver.used
            answer = (True, function(*arguments))
            del function, arguments, receiver
        except BaseException as error:
            answer = (False, failure_sentence(error))
        _send(out, pickle.dumps(answer, pickle.HIGHEST_PROTOCOL))


if __name__ == "__main__":
    with suppress(OSError):  # nobody listens any more
        main()
    os._exit(0)  # OpenGL needs no farewell, and what it says at the end helps nobody
