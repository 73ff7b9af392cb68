"""Computations of instruments in the background: only the latest request is computed."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import Any

from qtpy import QtCore

from bihdist_core.distances.answers import failure_in_words
from bihdist_core.progress import Progress

from ..session.latest_request_worker import LatestRequestWorker


def call(request: tuple[Callable[[], object]], progress: Progress) -> Iterator[object]:
    """Compute a request that is a function: yield what it returns."""
    yield request[0]()


class Background(QtCore.QObject):
    """See `Context.background`: `compute(request, progress)` runs for the latest request and yields one answer or more.

    They come as `answered(request, answer)` on the thread of the window, unless something else has been asked for
    meanwhile; what goes wrong comes as `failed(request, sentence)`.  A request is compared by identity.
    """

    answered = QtCore.Signal(object, object)
    failed = QtCore.Signal(object, str)
    progressed = QtCore.Signal(object)  # (share done, words), or None when nothing goes on
    _posted = QtCore.Signal(object)

    def __init__(self, name: str, compute: Callable[[Any, Progress], Iterator[Any]], parent: QtCore.QObject) -> None:
        super().__init__(parent)
        self._compute = compute
        self._latest: Any = None
        self._posted.connect(self._run)
        self._worker: LatestRequestWorker[Any] = LatestRequestWorker(name, self._work, self._report, self._fail)

    def ask(self, request: Any) -> None:
        """Compute a request, in place of the one before; None only cancels that."""
        self._latest = request
        self._worker.submit(request)

    def close(self, waits: bool = True) -> None:
        """End the thread, and wait for it."""
        self._latest = None
        (self._worker.close if waits else self._worker.end)()

    # ------------------------------------------------------------------ on the lane
    def _work(self, request: Any, worker: LatestRequestWorker[Any]) -> None:
        progress = worker.progress(lambda latest: latest is request)
        for answer in self._compute(request, progress):
            progress(0, "")  # Cancelled if nobody wants the rest
            self._post(partial(self._arrive, request, answer))

    def _fail(self, request: Any, error: Exception) -> None:
        self._post(partial(self._tell, request, failure_in_words(error)))

    def _report(self, fraction: float | None, words: str) -> None:
        self._post(lambda: self.progressed.emit(None if fraction is None or not words else (fraction, words)))

    def _post(self, function: Callable[[], None]) -> None:
        with suppress(RuntimeError):  # nobody waited for the thread, and the window is gone
            self._posted.emit(function)

    # ------------------------------------------------------------------ on the window's thread
    @staticmethod
    def _run(function: Callable[[], None]) -> None:
        function()

    def _arrive(self, request: Any, answer: Any) -> None:
        if request is self._latest:
            self.answered.emit(request, answer)

    def _tell(self, request: Any, sentence: str) -> None:
        if request is self._latest:
            self.failed.emit(request, sentence)
