"""Selections: vertices of a surface under a name; pure edits of them."""

from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, replace

from bihdist_core.applications.changes import Runs
from bihdist_core.arrays import IntArray
from bihdist_core.errors import ParameterError

from ..document import Document, check_unique, free_names
from ..part import MARK_COLOURS, Part, check_colour, check_name, next_colour
from ..runs import ids_of, runs_of


@dataclass(frozen=True)
class Selection:
    """Vertices of a surface under a name, in one of MARK_COLOURS."""

    name: str
    runs: Runs
    colour: int = 0
    surface: str = "A"

    def __post_init__(self) -> None:
        check_name(self.name, "selection")
        check_colour(self.colour)
        ends = [end for run in self.runs for end in run]
        apart = all(a[1] + 1 < b[0] for a, b in zip(self.runs[:-1], self.runs[1:], strict=True))
        if ends != sorted(ends) or (ends and ends[0] < 0) or not apart:
            raise ParameterError("A selection is a list of increasing, separate ranges of vertex ids.")


@dataclass(frozen=True)
class Selections(Part):
    """The selections of a document.

    Attributes
    ----------
    selections
        The selections, in their order.
    """

    selections: tuple[Selection, ...] = ()

    @property
    def surfaces(self) -> tuple[str, ...]:
        return tuple(each.surface for each in self.selections)

    def check(self, document: Document) -> None:
        check_unique([each.name for each in self.selections], "selection")

    def without_surfaces(self, document: Document, surfaces: Set[str]) -> Document:
        return document.with_part(Selections(tuple(each for each in self.selections if each.surface not in surfaces)))

    def with_vertices(self, surface: str, vertices: IntArray) -> "Selections":
        moved = (
            replace(each, runs=runs_of(vertices[ids_of(each.runs)])) if each.surface == surface else each
            for each in self.selections
        )
        return Selections(tuple(moved))

    def work(self, document: Document) -> Mapping[str, Iterable[object]]:
        return {"selections": self.selections}


def select(document: Document, name: str, vertices: IntArray, surface: str = "A") -> Document:
    """Return the document with vertices (k,) as the selection of a name, which none at all remove."""
    before = document[Selections].selections
    if not len(vertices):
        return without_selection(document, name)
    old = next((each for each in before if each.name == name), None)
    if old is None:
        new = Selection(name, runs_of(vertices), next_colour(before), surface)
        return document.with_part(Selections((*before, new)))
    new = Selection(name, runs_of(vertices), old.colour, surface)
    return document.with_part(Selections(tuple(new if each is old else each for each in before)))


def without_selection(document: Document, name: str) -> Document:
    """Remove the selection of a name."""
    others = (each for each in document[Selections].selections if each.name != name)
    return document.with_part(Selections(tuple(others)))


def change_selection(document: Document, name: str, new_name: str | None = None, colour: int | None = None) -> Document:
    """Change the name or colour of a selection; ParameterError for an empty name and for that of another."""
    if name not in [each.name for each in document[Selections].selections]:
        raise ParameterError(f"There is no selection {name!r}.")
    wanted = name if new_name is None else new_name.strip()
    if not wanted:
        raise ParameterError("A selection needs a name.")
    changed = (
        replace(each, name=wanted, colour=each.colour if colour is None else colour) if each.name == name else each
        for each in document[Selections].selections
    )
    return document.with_part(Selections(tuple(changed)))


def select_instead(document: Document, chosen: Iterable[Runs], surface: str = "A") -> Document:
    """Replace all selections by these."""
    found = list(chosen)
    names = free_names("selection", len(found), [])
    selections = [
        Selection(name, runs, k % MARK_COLOURS, surface)
        for k, (name, runs) in enumerate(zip(names, found, strict=True))
    ]
    return document.with_part(Selections(tuple(selections)))
