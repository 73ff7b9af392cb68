"""Our own two worker threads, for work on independent parts of one array problem.

NumPy's products, sorts and gathers release the interpreter lock, so two parts really run side by side.  What is
computed never depends on which thread does it, nor on how many there are.
"""

import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_EXCEPTION, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from typing import TypeVar

import numpy as np

from ..errors import Cancelled
from ..progress import Progress, silent

Item = TypeVar("Item")
Result = TypeVar("Result")

WORKERS = 2
REPORT_SECONDS = 0.1


_alone: ContextVar[bool] = ContextVar("alone", default=False)


@contextmanager
def without_workers() -> Iterator[None]:
    """Within it everything is done by the thread that asks, for programs that are themselves one of many processes."""
    before = _alone.set(True)
    try:
        yield
    finally:
        _alone.reset(before)


def is_alone() -> bool:
    """Whether that is so."""
    return _alone.get()


@cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(WORKERS, thread_name_prefix="bihdist")


def _quietly(function: Callable[[Item], Result], item: Item) -> Result:
    # Overflow shows in the results, which are checked; a warning per product would help nobody.
    with np.errstate(all="ignore"):
        return function(item)


def side_by_side(function: Callable[[Item], Result], items: Sequence[Item]) -> list[Result]:
    """[function(item) for item in items], over two threads, one of them the caller's.

    For short work.  If the workers are busy with something else the caller does all of it, so that a long
    construction elsewhere delays nothing.
    """
    results: dict[int, Result] = {}
    waiting = iter(range(len(items)))
    lock = threading.Lock()

    def take() -> int | None:
        with lock:
            return next(waiting, None)

    def lane() -> None:
        try:
            while (k := take()) is not None:
                results[k] = _quietly(function, items[k])
        finally:
            # After an error nobody takes another item; otherwise there is none left.
            with lock:
                list(waiting)

    if len(items) < 2 or _alone.get():
        lane()
    else:
        helper = _pool().submit(lane)
        try:
            lane()
        finally:
            if not helper.cancel():
                wait([helper])
        if not helper.cancelled():
            helper.result()
    return [results[k] for k in range(len(items))]


class Job:
    """Long work in the worker threads, while the thread that asked for it reports progress and may stop it.

    work: how much there is to do in all, in any unit; `advance` counts it.
    """

    def __init__(self, progress: Progress | None, text: str, work: float) -> None:
        self._progress = None if progress is silent else progress
        self._text, self._work = text, max(work, 1e-300)
        self._lock = threading.Lock()
        self._done = 0.0
        self._stopped = False
        self._reported = time.monotonic()

    def advance(self, work: float) -> None:
        """Workers call this after every small piece of work; raises Cancelled once the job is to stop."""
        if self._stopped:
            raise Cancelled("The work was stopped.")
        with self._lock:
            self._done += work

    def report(self) -> None:
        """Tell the progress how far the work is, unless that was done a moment ago."""
        if self._progress is not None and time.monotonic() - self._reported >= REPORT_SECONDS:
            self._reported = time.monotonic()
            self._progress(min(1.0, self._done / self._work), self._text)

    def finish(self) -> None:
        """Tell the progress that all is done."""
        if self._progress is not None:
            self._progress(1.0, self._text)

    def run(self, function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
        """[function(item) for item in items] in the workers; their first error, or the progress', ends all of it."""
        items = list(items)
        if _alone.get() or (self._progress is None and len(items) == 1):
            results = []
            for item in items:
                results.append(_quietly(function, item))
                self.report()
            return results
        futures: list[Future[Result]] = [_pool().submit(_quietly, function, item) for item in items]
        try:
            pending = set(futures)
            while pending:
                done, pending = wait(pending, REPORT_SECONDS, FIRST_EXCEPTION)
                for future in done:
                    future.result()
                self.report()
            return [future.result() for future in futures]
        finally:
            # After an error nothing may be left running; after success there is nothing to stop.
            if any(not future.done() for future in futures):
                self._stopped = True
                for future in futures:
                    future.cancel()
                wait(futures)
