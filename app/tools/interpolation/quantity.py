"""Values at anchors, interpolated by a distance, as what a panel can show."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from bihdist_core.distances.distance_types import Spec

from ...document.document import Document
from ...document.edits import show_distances as distances_again
from ...document.json_values import flag, record
from ...document.quantities import ByDistance, Choice, Quantity, read_spec

INTERPOLANT, TOTAL = "interpolant by ", "weights by "
"""The beginnings of the words of an interpolant and of a sum of weights."""


@dataclass(frozen=True)
class Interpolant(ByDistance):
    """The values of the document's anchors, interpolated by a distance (paper, section 5.2); it starts nowhere.

    With `total` it is the sum of the anchors' weights instead.
    """

    spec: Spec
    total: bool = False
    done = "interpolated"

    def marks_extrema(self, document: Document) -> bool:
        """Return whether the extrema are marked, which a good interpolant has only at anchors: while the dock is
        open."""
        return not self.total and "anchors" in document.docks

    @property
    def before(self) -> str:
        return TOTAL if self.total else INTERPOLANT

    @property
    def heading(self) -> str:
        return "Weights" if self.total else "Interpolant"

    @property
    def hint(self) -> str:
        if self.total:
            return "how far the anchors' influence reaches, as the logarithm of the sum of their weights"
        return "no extrema but at the anchors, and at tips of the shape without one"

    @property
    def choices(self) -> tuple[Choice, ...]:
        words = {
            False: ("Interpolant", "Values at anchors, interpolated"),
            True: ("Sum of weights", "How far the anchors' influence reaches"),
        }
        return tuple(Choice(*words[total], replace(self, total=total), total == self.total) for total in words)

    @classmethod
    def choice_by(cls, spec: Spec, has_other: bool) -> Choice:
        return Choice("Interpolant by this distance", "Values at anchors, interpolated", cls(spec))

    def to_json(self) -> dict[str, Any]:
        return {"interpolant": self.spec.canonical, **({"total": True} if self.total else {})}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "interpolant" not in data:
            return None
        values = record(data, where, {"interpolant": read_spec, "total": flag}, {"interpolant"})
        return cls(values["interpolant"], values.get("total", False))

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        for total, before in ((False, INTERPOLANT), (True, TOTAL)):
            if words.startswith(before):
                return cls(Spec.parse(words.removeprefix(before), **parameters), total)
        return None


def interpolants(shows: Quantity) -> list["Interpolant"]:
    """Return the interpolants and sums of weights among the parts of a quantity."""
    return [part for part in shows.parts if isinstance(part, Interpolant)]


def interpolated(shows: Quantity) -> Interpolant | None:
    """Return the interpolant that a panel shows by itself; None for another quantity, and for a sum of weights."""
    return shows if isinstance(shows, Interpolant) and not shows.total else None


def interpolate(document: Document) -> Document:
    """Let every panel of a distance show the interpolant by it, with one range of colours."""
    return replace(
        document,
        range="shared" if document.range == "own" else document.range,
        panels=tuple(
            replace(panel, shows=Interpolant(panel.shows.specs[0]), maximum=None) if panel.shows.is_distance else panel
            for panel in document.panels
        ),
    )


def show_distances(document: Document) -> Document:
    """Let every panel of an interpolant show its distance, from where the others start."""
    document = distances_again(document, lambda panel: isinstance(panel.shows, Interpolant))
    return replace(document, range="own" if document.range == "shared" else document.range)
