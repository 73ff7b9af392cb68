"""The names and colours of what users mark."""

from collections.abc import Iterable
from typing import Protocol

from bihdist_core.errors import ParameterError

MARK_COLOURS = 10
"""How many colours there are for marks."""

LONGEST_NAME = 60


class Coloured(Protocol):
    @property
    def colour(self) -> int:
        """Number of the colour in `PINS`."""


def check_name(name: str, what: str) -> None:
    """ParameterError for a name with more than LONGEST_NAME characters, or some that cannot be printed."""
    if name and (not name.isprintable() or len(name) > LONGEST_NAME or name != name.strip()):
        raise ParameterError(f"The name of a {what} has up to {LONGEST_NAME} printable characters, not {name[:80]!r}.")


def check_colour(colour: int) -> None:
    """ParameterError for a number that is none of MARK_COLOURS."""
    if not 0 <= colour < MARK_COLOURS:
        raise ParameterError(f"Colours are numbered from 0 to {MARK_COLOURS - 1}, not {colour}.")


def next_colour(marks: Iterable[Coloured]) -> int:
    """Return the first of the colours that fewest of the marks have."""
    counts = [0] * MARK_COLOURS
    for mark in marks:
        counts[mark.colour] += 1
    return counts.index(min(counts))
