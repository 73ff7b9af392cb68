"""Our own worker threads, for work on independent parts of one array problem.

The compiled kernel and NumPy's products, sorts and gathers release the interpreter lock, so that parts really run side
by side.  What is computed never depends on which thread does it, nor on how many there are.
"""

import os
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from queue import Empty, SimpleQueue
from typing import Any, TypeVar

import numpy as np

from ..arrays import FloatArray
from ..errors import Cancelled
from ..kernel.library import Watch
from ..progress import Progress, silent

Item = TypeVar("Item")
Result = TypeVar("Result")

WORKERS = min(16, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
"""As many as there are cores for this process."""
REPORT_SECONDS = 0.1
CACHE_LINE = 8
"""Numbers in a line of the cache."""


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
    """Return whether this thread works alone."""
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

    others = 0 if _alone.get() else min(len(items), WORKERS) - 1
    lanes = [_pool().submit(lane) for _ in range(others)]
    try:
        lane()
    finally:
        lanes = [other for other in lanes if not other.cancel()]
        wait(lanes)
    while lanes:
        # Without a name: a future refers to its error, whose traceback refers to all that this frame does.
        lanes.pop(0).result()
    return [results[k] for k in range(len(items))]


Run = Callable[[Callable[[Any], Any], Any], list[Any]]
"""[function(item) for item in items], somehow: `in_turn` or `side_by_side`."""


def in_turn(function: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """[function(item) for item in items]."""
    return [function(item) for item in items]


class Job:
    """Long work in the worker threads, while the thread that asked for it reports progress and may stop it.

    `work` is how much there is to do in all, in any unit. `watch` is for functions of the compiled kernel, which
    count it there and look whether they are to stop; others call `advance`.
    """

    def __init__(self, progress: Progress | None, text: str, work: float) -> None:
        self._progress = None if progress is silent else progress
        self._text, self._work = text, max(work, 1e-300)
        self._reported = time.monotonic()
        self.watch = Watch()

    @property
    def is_silent(self) -> bool:
        """True if nobody hears of its progress, so that nobody stops it either."""
        return self._progress is None

    def advance(self, work: int) -> None:
        """Count a piece of work; raises Cancelled once the job is to stop."""
        if self.watch.stop:
            raise Cancelled("The work was stopped.")
        self.watch.done += work

    def report(self) -> None:
        """Tell the progress how far the work is, unless that was done a moment ago."""
        if self._progress is not None and time.monotonic() - self._reported >= REPORT_SECONDS:
            self._reported = time.monotonic()
            self._progress(min(1.0, self.watch.done / self._work), self._text)

    def finish(self) -> None:
        """Tell the progress that all is done."""
        if self._progress is not None:
            self._progress(1.0, self._text)

    def run(
        self, function: Callable[[Item], Result], items: Iterable[Item], after: Sequence[Sequence[int]] | None = None
    ) -> list[Result]:
        """Return [function(item) for item in items], run in the workers.

        The first error, theirs or the progress', ends all of it. `after` holds for each item the numbers of those that
        come before it; without it they are independent. A single item, if there is no progress, and all of them within
        `without_workers`, are done by the calling thread.
        """
        items = list(items)
        here = _alone.get() or (self._progress is None and len(items) == 1)
        if here and len(items) == 1:
            done = [_quietly(function, items[0])]
            self.report()
            return done
        missing = [len(before) for before in after] if after else [0] * len(items)
        followers: list[list[int]] = [[] for _ in items]
        for k, before in enumerate(after or ()):
            for other in before:
                followers[other].append(k)
        ready = [k for k, count in enumerate(missing) if not count]
        results: dict[int, Result] = {}
        pending: dict[Future[Result], int] = {}

        def finished(k: int, result: Result) -> None:
            results[k] = result
            for follower in followers[k]:
                missing[follower] -= 1
                if not missing[follower]:
                    ready.append(follower)

        try:
            while ready or pending:
                while ready:
                    k = ready.pop(0)
                    if here:
                        finished(k, _quietly(function, items[k]))
                        self.report()
                    else:
                        pending[_pool().submit(_quietly, function, items[k])] = k
                if pending:
                    for future in wait(pending, REPORT_SECONDS, FIRST_COMPLETED).done:
                        k = pending.pop(future)
                        try:
                            finished(k, future.result())
                        finally:
                            # It refers to its error, whose traceback refers to all that this frame does.
                            del future
                    self.report()
        finally:
            # After an error nothing may be left running; after success there is nothing to stop.
            if pending:
                self.watch.stop = 1
                for future in pending:
                    future.cancel()
                wait(pending)
        return [results[k] for k in range(len(items))]


class Arena:
    """Room for `size` numbers, of which tasks that run at the same time take parts, the lowest first.

    So little of it is touched as goes: memory that is touched first costs more than most work in it.
    """

    def __init__(self, size: int) -> None:
        self._numbers = np.empty(size)
        self._taken: dict[int, int] = {}  # where each part begins and ends
        self._lock = threading.Lock()

    def take(self, size: int) -> FloatArray:
        """Return (size,) numbers, of any value, until they are released."""
        with self._lock:
            start = 0
            for begin, end in sorted(self._taken.items()):
                if begin - start >= size:
                    break
                start = end
            if start + size > len(self._numbers):
                return np.empty(size)  # what is free lies in pieces
            self._taken[start] = start + -(-size // CACHE_LINE) * CACHE_LINE
        return self._numbers[start : start + size]

    def release(self, part: FloatArray) -> None:
        """Let others have it."""
        with self._lock:
            self._taken.pop((part.ctypes.data - self._numbers.ctypes.data) // part.itemsize, None)

    @contextmanager
    def of(self, size: int) -> Iterator[FloatArray]:
        """Yield (size,) numbers within it."""
        part = self.take(size)
        try:
            yield part
        finally:
            self.release(part)


class Workspaces:
    """Arrays for tasks that run at the same time, each used again: memory that is touched first costs more."""

    def __init__(self) -> None:
        self._free: SimpleQueue[FloatArray] = SimpleQueue()

    @contextmanager
    def of(self, size: int) -> Iterator[FloatArray]:
        """Yield (size,) numbers, of any value."""
        try:
            work = self._free.get_nowait()
        except Empty:
            work = np.empty(0)
        if len(work) < size:
            work = np.empty(size)
        yield work[:size]
        self._free.put(work)
