"""The parts of an experiment: one that cannot be done is noted with the reason, and the others go on."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ParamSpec, TypeVar

from ..errors import BihdistError, Cancelled, OutputError

P = ParamSpec("P")
T = TypeVar("T")


@dataclass(frozen=True)
class NotDone:
    """A part of an experiment that could not be done, and why, in a sentence."""

    part: str
    reason: str

    def __str__(self) -> str:
        return f"{self.part}: {self.reason}"


class Parts:
    """Does parts of an experiment one by one, and notes in `not_done` those that fail."""

    def __init__(self) -> None:
        self.not_done: list[NotDone] = []

    def do(self, name: str, work: Callable[P, T], *arguments: P.args, **named: P.kwargs) -> T | None:
        """Do a part of the work, and return its result, or None where it fails.

        Raises Cancelled, and OutputError, which concern all parts.
        """
        try:
            return work(*arguments, **named)
        except (Cancelled, OutputError):
            raise
        except Exception as error:  # a mesh of anybody's may break anything, and the other parts are still wanted
            self.note(name, reason_of(error))
            return None

    def note(self, name: str, reason: str) -> None:
        """Note that a part is not done, and why; once for all parts of that name that fail for that reason."""
        missing = NotDone(name, reason)
        if missing not in self.not_done:
            self.not_done.append(missing)

    def why(self, *names: str) -> str:
        """Return the reasons why parts of these names are not done, each once; "" if none of them failed."""
        return " ".join(dict.fromkeys(each.reason for each in self.not_done if each.part in names))


def reason_of(error: Exception) -> str:
    """Say in a sentence why something failed."""
    if isinstance(error, BihdistError):
        return str(error)
    if isinstance(error, MemoryError):
        return "There was not enough memory."
    return f"An unexpected error, {type(error).__name__}: {error}."
