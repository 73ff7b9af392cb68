"""Unexpected errors from any thread, shown to the user with details to copy."""

import logging
import sys
import threading
import time
from collections.abc import Callable
from functools import partial

from qtpy import QtCore

from bihdist_core import Cancelled
from bihdist_core.unexpected import LOG, note_unexpected

from .context import Context
from .pages.messages import Message, tell

STORM_S = 2.0
"""Seconds within which the same error, say of painting, is not shown again."""


class UnexpectedErrors(QtCore.QObject):
    """Shows unexpected errors of any thread in its window, while that is open."""

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._context = context
        self._known: dict[str, tuple[str, float]] = {}
        self.message: Message | None = None
        self._handler = _Handler(self._note)
        LOG.addHandler(self._handler)
        context.closed.connect(self._leave)

    def are_telling(self, sentence: str) -> bool:
        """Return whether a sentence belongs to an error that is shown here."""
        return sentence in self._known

    def _note(self, sentence: str, details: str) -> None:
        """Take an error from any thread."""
        last = self._known.get(sentence, ("", -STORM_S))[1]
        self._known[sentence] = details, time.monotonic()
        if time.monotonic() - last >= STORM_S:
            # Not from within what has failed, which may be painting.
            self._context.post(lambda: QtCore.QTimer.singleShot(0, partial(self._tell, sentence, details)))

    def _tell(self, sentence: str, details: str) -> None:
        context = self._context
        if context.is_closed:
            return
        context.refused.emit(sentence)
        if not context.quiet and self.message is None:
            self.message = tell(context.widget, sentence, details)
            self.message.finished.connect(self._forget)

    def _forget(self) -> None:
        self.message = None

    def _leave(self) -> None:
        LOG.removeHandler(self._handler)


class _Handler(logging.Handler):
    def __init__(self, note: Callable[[str, str], None]) -> None:
        super().__init__()
        self._note_it = note

    def emit(self, record: logging.LogRecord) -> None:
        details = logging.Formatter().formatException(record.exc_info) if record.exc_info else ""
        self._note_it(record.getMessage(), details)


def take_all_exceptions() -> None:
    """Let exceptions of slots and threads, which nobody can catch, come here, too.

    PyQt5 ends the process on an exception in a slot unless there is a hook.
    """
    printed = sys.excepthook

    def hook(kind: type[BaseException], error: BaseException, trace: object) -> None:
        if isinstance(error, Cancelled):
            return  # nobody wants it any more
        printed(kind, error, trace)  # type: ignore[arg-type]
        if isinstance(error, Exception):
            note_unexpected(error)

    sys.excepthook = hook
    threading.excepthook = lambda of: (
        None if of.exc_value is None else hook(of.exc_type, of.exc_value, of.exc_traceback)
    )
