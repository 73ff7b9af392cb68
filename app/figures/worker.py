"""A process that stays alive and draws: it is asked one thing after another, and is sent each large array only once.

A window asks it for previews and for files, a movie asks several for its frames.  It ends with whoever started it.
"""

import io
import pickle
import threading
from collections.abc import Callable
from queue import SimpleQueue
from typing import Any, BinaryIO

import numpy as np

from bihdist_core import BihdistError, Cancelled, Surface
from bihdist_core.child_process import ANSWER, DIED, REPORT, SERVED, WRONG, ChildProcess, framed, send, unframed
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.progress import Progress, silent

LARGE = 1 << 15
"""Bytes from which an array is sent once and then named."""

GONE = "The process that draws ended without a word; perhaps there is not enough memory, or no OpenGL."

Ended = Callable[[str | None], None]
"""Called with nothing when the file is there, otherwise with the sentence why not; "" if it was cancelled."""


class Worker:
    """Only one thread may ask at a time; any may `stop` or `close`.

    threads: how many its numerical libraries and software OpenGL may use, as many as they like if None.
    """

    def __init__(self, threads: int | None = None) -> None:
        self._sent: dict[int, Any] = {}
        self._child = ChildProcess(SERVED, framed(__name__.encode()), threads)

    def ask(self, function: Callable[..., Any], *arguments: Any, progress: Progress | None = None) -> Any:
        """What the function makes of the arguments there; all three must pickle.  BihdistError if it cannot.

        progress: if there is one, the function gets one, too, as an argument of that name; it is called from another
        thread.
        """
        file = io.BytesIO()
        sender = _Sender(file, self._sent)
        sender.dump((function, arguments, progress is not None))
        # What this does not need is not needed any more, here and there.
        self._sent = sender.used
        report = progress or silent
        answer = self._child.ask(framed(file.getbuffer()), lambda told: report(*pickle.loads(told))).get()
        if isinstance(answer, str):
            raise BihdistError(GONE if answer == DIED else answer)
        return pickle.loads(answer)

    def stop(self) -> None:
        """Cancel what it does, as soon as that tells of its progress; no half file is left.  Then it ends."""
        self._child.stop()

    def close(self) -> None:
        """End it, whatever it does."""
        self._child.end()


class FigureJob:
    """Runs `work(progress=...)`, a function that can be pickled, in a process of its own.

    Both functions are called on threads of the job's.
    """

    def __init__(self, work: Callable[..., object], progress: Progress, ended: Ended) -> None:
        self._cancelled = False
        self._worker = Worker()
        self._thread = threading.Thread(target=self._run, args=(work, progress, ended), name="figure", daemon=True)
        self._thread.start()

    def cancel(self) -> None:
        """Stop; what was at the path stays, and no half file is left."""
        self._cancelled = True
        self._worker.stop()

    @property
    def is_running(self) -> bool:
        """Whether the figure is still being drawn."""
        return self._thread.is_alive()

    def wait(self, timeout: float | None = None) -> None:
        """Wait until the figure is drawn, at most so many seconds; None for any time."""
        self._thread.join(timeout)

    def _run(self, work: Callable[..., object], progress: Progress, ended: Ended) -> None:
        message: str | None = GONE
        try:
            self._worker.ask(work, progress=progress)
            message = None
        except Exception as error:
            message = "" if self._cancelled else failure_in_words(error)
        finally:  # whatever happens, somebody waits for the end
            self._worker.close()
            ended(message)


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
    """known: the things received before; used: those of them, old and new, in what is read now."""

    def __init__(self, content: bytes, known: dict[int, Any]) -> None:
        super().__init__(io.BytesIO(content))
        self._known = known
        self.used: dict[int, Any] = {}

    def persistent_load(self, name: tuple[int, bytes | None]) -> Any:
        key, content = name
        if content is not None:
            self.used[key] = pickle.loads(content)
        elif key not in self.used:
            self.used[key] = self._known[key]
        return self.used[key]


def failure_sentence(error: BaseException) -> str:
    """What is said of something that could not be drawn."""
    if isinstance(error, BihdistError):
        return " ".join(str(error).split())
    if isinstance(error, MemoryError):
        return "There is not enough memory for a picture of this size."
    words = " ".join(str(error).split())
    return f"The picture could not be drawn ({type(error).__name__}{': ' if words else ''}{words[:200]})."


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """What the process does: questions come in, answers and progress go out, until its input ends."""
    questions: SimpleQueue[bytes] = SimpleQueue()
    has_ended = threading.Event()
    threading.Thread(target=_listen, args=(requests, questions, has_ended), daemon=True).start()

    def progress(fraction: float, text: str) -> None:
        if has_ended.is_set():
            raise Cancelled("The drawing was cancelled.")
        send(answers, REPORT, [pickle.dumps((fraction, text))])

    known: dict[int, Any] = {}
    while content := questions.get():
        try:
            receiver = _Receiver(content, known)
            function, arguments, tells = receiver.load()
            known = receiver.used
            result = pickle.dumps(
                function(*arguments, **({"progress": progress} if tells else {})), pickle.HIGHEST_PROTOCOL
            )
            status = ANSWER
            del function, arguments, receiver
        except BaseException as error:  # also what would end the process, which says nothing by itself
            status, result = WRONG, failure_sentence(error).encode(errors="replace")
        try:
            send(answers, status, [result])
        except OSError:  # nobody listens any more
            return


def _listen(requests: BinaryIO, questions: "SimpleQueue[bytes]", has_ended: threading.Event) -> None:
    while content := unframed(requests):
        questions.put(content)
    has_ended.set()
    questions.put(b"")
