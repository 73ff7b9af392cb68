"""A lane: one background thread that works on the latest request and forgets the ones before."""

import os
import sys
import threading
import time
from collections.abc import Callable
from typing import Generic, TypeVar

from bihdist_core import Cancelled
from bihdist_core.progress import Progress

Request = TypeVar("Request")

REPORTS_PER_SECOND = 20
QUIET_SECONDS = 0.15
"""Work shorter than this is not reported: it would only flicker."""
NICE = 10
"""By how much a lane, and the threads it starts, stand back for the window's thread and for drawing."""


class Lane(Generic[Request]):
    """Runs `work(request, lane)` for the latest request on a thread of its own.

    Work that takes long calls `lane.progress(is_wanted)` for its progress callback: it forwards reports to
    `report(fraction, text)` and raises Cancelled as soon as `is_wanted(latest request)` is false.  Exceptions other
    than Cancelled go to `failed(request, exception)`.  `report` and `failed` are called on the lane's thread.
    """

    def __init__(
        self,
        name: str,
        work: Callable[[Request, "Lane[Request]"], None],
        report: Callable[[float | None, str], None],
        failed: Callable[[Request, Exception], None],
    ) -> None:
        self._work, self._report, self._failed = work, report, failed
        self._changed = threading.Condition()
        self._latest: Request | None = None
        self._serial = self._taken = 0
        self._closed = False
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def submit(self, request: Request | None) -> None:
        """Make this the latest request; None cancels what is going on."""
        with self._changed:
            self._latest = request
            self._serial += 1
            self._changed.notify()

    def progress(self, is_wanted: Callable[[Request], bool], quiet: float = QUIET_SECONDS) -> Progress:
        """A progress callback for the work on this lane (see the class), silent for the first `quiet` seconds."""
        last = time.monotonic() + quiet - 1 / REPORTS_PER_SECOND

        def report(fraction: float, text: str) -> None:
            nonlocal last
            latest = self._latest
            if self._closed or latest is None or not is_wanted(latest):
                raise Cancelled("A newer request came.")
            now = time.monotonic()
            if now - last >= 1 / REPORTS_PER_SECOND:
                last = now
                self._report(fraction, text)

        return report

    def end(self) -> None:
        """Stop the work and, soon, the thread."""
        with self._changed:
            self._closed = True
            self._changed.notify()

    def close(self, timeout: float = 5.0) -> None:
        """The same, and wait for it."""
        self.end()
        self._thread.join(timeout)

    def _run(self) -> None:
        # Elsewhere Python cannot do this for a single thread.
        if sys.platform == "linux":
            os.nice(NICE)
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._taken < self._serial)
                if self._closed:
                    return
                self._taken, request = self._serial, self._latest
            if request is not None:
                try:
                    self._work(request, self)
                except Cancelled:
                    pass
                except Exception as error:
                    self._failed(request, error)
            # Another request may be waiting already; then its reports follow at once.
            self._report(None, "")
