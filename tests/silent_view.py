"""A session's view that shows nothing: one for all tests and measurements without a window."""

import queue
import time
from collections.abc import Callable
from contextlib import suppress

from tests.waiting import PATIENCE


class SilentView:
    """Its queue `posted` takes what the session posts; `run_until` runs that, as a window's event loop would."""

    def __init__(self) -> None:
        self.posted: queue.Queue[Callable[[], None]] = queue.Queue()

    def document_changed(self, before: object) -> None: ...
    def answer_changed(self, panel: int) -> None: ...
    def error_estimate_changed(self, panel: int) -> None: ...
    def progress_changed(self) -> None: ...

    def failed(self, message: str) -> None:
        raise AssertionError(message)

    def run_until(self, is_done: Callable[[], bool]) -> None:
        end = time.monotonic() + PATIENCE
        while not is_done():
            assert time.monotonic() < end, "waited in vain"
            with suppress(queue.Empty):
                self.posted.get(timeout=0.02)()
