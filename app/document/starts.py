"""Starts of fields as one line says them: in words, and a curve by a file that it is saved in."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bihdist_core.errors import ParameterError
from bihdist_core.sources.source import Curve, Source
from bihdist_core.sources.words import words_of

from .document import Document
from .source_edits import members_of


@dataclass(frozen=True)
class Starts:
    """The start of a field."""

    at: Source

    def words(self, files: Mapping[Curve, str]) -> str:
        """Return the source as an option says it; ParameterError if a curve has no file."""
        if any(curve not in files for curve in curves_of(self.at)):
            raise ParameterError("A source is a curve, which a line names by its file; save it first.")
        return words_of(self.at, files)


def as_argument(value: Any, files: Mapping[Curve, str]) -> Any:
    """Return a value as Python writes it: words for sources that are no vertex."""
    if isinstance(value, list):
        return [as_argument(each, files) for each in value]
    if isinstance(value, Starts):
        return value.at if isinstance(value.at, int) else value.words(files)
    return value


def curves_in(document: Document) -> list[Curve]:
    """Return the curves that fields start from, each once: a line needs a file of each."""
    return list(dict.fromkeys(curve for at in document.sources for curve in curves_of(at)))


def curves_of(at: Source | None) -> list[Curve]:
    """Return the curves among the members of a source."""
    return [member for member in members_of(at) if isinstance(member, Curve)]
