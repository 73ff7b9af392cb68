"""Parts of documents that tools add: frozen values, each of a type of its own, with names and colours of marks."""

from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Protocol

from bihdist_core.errors import ParameterError

if TYPE_CHECKING:
    from bihdist_core.arrays import IntArray
    from bihdist_core.surface import Surface

    from .document import Document


@dataclass(frozen=True)
class Part:
    """A tool's part of a document, by its defaults as long as nothing is said; subclasses are frozen dataclasses.

    A row of the tools' table names it (`Tool.parts`); `document[Pins]` is the document's part of that type, and
    `document.with_part(pins)` the document with another.  In files its fields stand beside the document's own, or under
    one `key`; their types say how they are read (`form`).
    """

    key: ClassVar[str] = ""

    holds_points: ClassVar[bool] = True
    """Whether the points that it refers to are there for it, and not for others, whose removal it follows."""

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the document's points that it refers to."""
        return ()

    @property
    def surfaces(self) -> tuple[str, ...]:
        """The names of the document's surfaces that it refers to."""
        return ()

    @property
    def has_values(self) -> bool:
        """Return whether what it marks has values, which a figure may show beside the marks."""
        return False

    def check(self, document: "Document") -> None:
        """ParameterError if it does not fit the document; that its points and surfaces are there is known."""

    def without_points(self, points: Set[str]) -> "Part":
        """Return the part without what refers to these points."""
        return self

    def fitted(self, document: "Document") -> "Part":
        """Return the part without references to what the document no longer has."""
        return self

    def renumbered(self, numbers: Mapping[int, int]) -> "Part":
        """Return the part with other ids of panels, by those it has; panels that have none are gone."""
        return self

    def without_surfaces(self, document: "Document", surfaces: Set[str]) -> "Document":
        """The document, which still has these surfaces, without what of this part needs them and is no point there."""
        return document

    def with_vertices(self, surface: str, vertices: "IntArray") -> "Part":
        """Return the part after the vertices of a surface got new ids; `vertices` (n,) has the new id of each."""
        return self

    def with_paths(self, named: Callable[[str], str]) -> "Part":
        """Return the part with other paths of the files that it names."""
        return self

    def check_files(self, surfaces: Mapping[str, "Surface"]) -> None:
        """Raise ParameterError if a file that it names has changed; `surfaces` are by their names in the document."""

    def work(self, document: "Document") -> Mapping[str, Iterable[object]]:
        """Return the work that takes effort to do again, by its name; after a move it is other work."""
        return {}


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
