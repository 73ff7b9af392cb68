"""A lane: one background thread that works on the latest request and forgets the ones before."""

import os
import sys
import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

from bihdist_core import Cancelled
from bihdist_core.progress import Progress
from bihdist_core.unexpected import note_unexpected

Request = TypeVar("Request")

REPORTS_PER_SECOND = 20
QUIET_SECONDS = 0.15
"""Work shorter than this is not reported: it would only flicker."""
NICE = 10
"""Niceness of a lane and of the threads it starts, which leave the window's thread and drawing the processor."""


class LatestRequestWorker(Generic[Request]):
    """Runs `work(request, worker)` for the latest request on a thread of its own, which starts with the first.

    Work that takes long calls `worker.progress(is_wanted)` for its progress callback: it forwards reports to
    `report(fraction, text)` and raises Cancelled as soon as `is_wanted(latest request)` is false. Exceptions other than
    Cancelled go to `failed(request, exception)`. `report` and `failed` are called on the worker's thread.

    With `leaves`, the next request is worked on at once, on a new thread, when the present work is no longer wanted;
    that work ends on the old thread when it asks next, and is not heard of any more. Two threads may work at a time
    then.
    """

    def __init__(
        self,
        name: str,
        work: Callable[[Request, "LatestRequestWorker[Request]"], None],
        report: Callable[[float | None, str], None] = lambda fraction, text: None,
        failed: Callable[[Request, Exception], None] = lambda request, error: None,
        leaves: bool = False,
    ) -> None:
        self._name, self._leaves = name, leaves
        self._work, self._report, self._failed = work, report, failed
        self._changed = threading.Condition()
        self._latest: Request | None = None
        self._serial = self._taken = 0
        self._closed = self._is_working = False
        self._is_wanted: Callable[[Request], bool] | None = None  # of what goes on, as it asked last
        self._thread: threading.Thread | None = None  # once something is asked for
        self._threads: list[threading.Thread] = []

    def submit(self, request: Request | None) -> None:
        """Make this the latest request; None cancels what is going on."""
        with self._changed:
            self._latest = request
            self._serial += 1
            is_left = self._leaves and self._is_working and not self._goes_on_for(request)
            is_first = self._thread is None and request is not None
            if (is_first or is_left) and not self._closed:
                self._start()
            self._changed.notify_all()

    def _goes_on_for(self, request: Request | None) -> bool:
        return request is not None and (self._is_wanted is None or self._is_wanted(request))

    def _start(self) -> None:
        """Let a fresh thread do what is wanted from now on."""
        self._is_working = False
        self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
        self._threads = [*(thread for thread in self._threads if thread.is_alive()), self._thread]
        self._thread.start()

    def progress(self, is_wanted: Callable[[Request], bool], quiet: float = QUIET_SECONDS) -> Progress:
        """Return a progress callback for this worker's work (see the class), silent for the first `quiet` seconds."""
        last = time.monotonic() + quiet - 1 / REPORTS_PER_SECOND
        mine = threading.current_thread()
        with self._changed:
            if self._thread is mine:
                self._is_wanted = self._is_wanted or is_wanted

        def report(fraction: float, text: str) -> None:
            nonlocal last
            # Nobody gives the work up between the question and the report.
            with self._changed:
                latest = self._latest
                if self._closed or self._thread is not mine or latest is None or not is_wanted(latest):
                    raise Cancelled("A newer request came.")
                self._is_wanted = is_wanted
                now = time.monotonic()
                if now - last >= 1 / REPORTS_PER_SECOND:
                    last = now
                    self._report(fraction, text)

        return report

    def end(self) -> None:
        """Stop the work and, soon, the thread."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def close(self, timeout: float = 5.0) -> None:
        """End the work, and wait for the threads."""
        self.end()
        until = time.monotonic() + timeout
        for thread in self._threads:
            thread.join(max(until - time.monotonic(), 0))

    def _run(self) -> None:
        # Elsewhere Python cannot do this for a single thread.
        if sys.platform == "linux":
            os.nice(NICE)
        mine = threading.current_thread()
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._taken < self._serial)
                if self._closed:
                    return
                self._taken, request = self._serial, self._latest
                self._is_working, self._is_wanted = request is not None, None
            error = None if request is None else self._error_of(request)
            with self._changed:
                if self._thread is not mine:
                    return
                self._is_working = False
                if error is not None and request is not None:
                    _told(self._failed, request, error)
                # Another request may be waiting already; then its reports follow at once.
                _told(self._report, None, "")

    def _error_of(self, request: Request) -> Exception | None:
        """Do the work; what went wrong."""
        try:
            self._work(request, self)
        except Cancelled:
            return None
        except Exception as error:
            note_unexpected(error)
            return error
        return None


def _told(tell: Callable[..., object], *what: object) -> None:
    """Tell somebody; what goes wrong there is noted, and costs no lane."""
    try:
        tell(*what)
    except Exception as error:
        note_unexpected(error)
