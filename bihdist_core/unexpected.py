"""Errors that nothing foresaw: each is logged once, with its traceback, to the logger "bihdist".

A window listens there and shows them; elsewhere they are silent, and whoever asked has the sentence.
"""

import logging

from .errors import BihdistError
from .sentences import one_line

LOG = logging.getLogger("bihdist")
LOG.addHandler(logging.NullHandler())  # otherwise Python would print them

SENTENCE = "Unexpected error"


def note_unexpected(error: BaseException) -> None:
    """Log an error, unless it is one that was foreseen, or is logged already."""
    if isinstance(error, BihdistError | MemoryError) or getattr(error, "_is_noted", False):
        return
    error._is_noted = True  # type: ignore[attr-defined]
    LOG.error("%s", unexpected_words(error), exc_info=error)


def unexpected_words(error: BaseException) -> str:
    """Return a sentence that says so, with what Python calls the error."""
    words = str(error)
    return one_line(f"{SENTENCE}: {type(error).__name__}{f': {words}' if words else ''}")
