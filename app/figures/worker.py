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
from bihdist_core.child_process import ANSWER, DIED_REASON, WRONG, ChildProcess, read_request, send, send_report
from bihdist_core.distances.answers import failure_in_words
from bihdist_core.progress import Progress, silent

LARGE = 1 << 15
"""Bytes from which an array is sent once and then named."""

GONE = "The drawing process ended unexpectedly; perhaps there is not enough memory, or no OpenGL."

Ended = Callable[[str | None], None]
"""Called with nothing when the file is there, otherwise with the sentence why not; "" if it was cancelled."""


class Worker:
    """A process that draws what it is asked for; one thread may ask at a time, any may `stop` or `close` it.

    Parameters
    ----------
    threads
        Number of threads of its numerical libraries and software OpenGL; None for as many as they like.
    """

    def __init__(self, threads: int | None = None) -> None:
        self._sent: dict[int, Any] = {}
        self._child = ChildProcess(__name__, threads)

    def ask(self, function: Callable[..., Any], *arguments: Any, progress: Progress | None = None) -> Any:
        """Call a function in the process and return its result; all must pickle.

        Parameters
        ----------
        progress
            Passed on to the function as an argument of that name, if given; it is called from another thread.

        Raises
        ------
        BihdistError
            If the function fails, or the process ends.
        """
        file = io.BytesIO()
        sender = _Sender(file, self._sent)
        sender.dump((function, arguments, progress is not None))
        # What this does not need is not needed any more, here and there.
        self._sent = sender.used
        answer = self._child.ask([file.getbuffer()], progress or silent).get()
        if isinstance(answer, str):
            raise BihdistError(GONE if answer == DIED_REASON else answer)
        return pickle.loads(answer)

    def stop(self) -> None:
        """Cancel the work at its next progress report, leaving no partial file, and end the process."""
        self._child.stop()

    def close(self) -> None:
        """End the process, whatever it does."""
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
        """True while the figure is being drawn."""
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
    """Pickles a request, and only names surfaces and large arrays that have been sent before.

    Attributes
    ----------
    used
        What is named or sent in this request, by id.
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
    """Reads what was sent, with the things that were received before (`known`, of which `used` are in use now)."""

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
    """Return a sentence on something that could not be drawn."""
    if isinstance(error, BihdistError):
        return " ".join(str(error).split())
    if isinstance(error, MemoryError):
        return "There is not enough memory for a picture of this size."
    words = " ".join(str(error).split())
    return f"The picture could not be drawn ({type(error).__name__}{': ' if words else ''}{words[:200]})."


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """Answer questions, with progress, until the input of the process ends."""
    questions: SimpleQueue[bytes] = SimpleQueue()
    has_ended = threading.Event()
    threading.Thread(target=_listen, args=(requests, questions, has_ended), daemon=True).start()

    def progress(fraction: float, text: str) -> None:
        if has_ended.is_set():
            raise Cancelled("The drawing was cancelled.")
        send_report(answers, fraction, text)

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
    while content := read_request(requests):
        questions.put(content)
    has_ended.set()
    questions.put(b"")
