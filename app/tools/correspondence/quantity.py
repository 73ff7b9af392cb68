"""The prediction of a point of the other surface, as a quantity of panels."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bihdist_core.distances.distance_types import Spec

from ...document import edits
from ...document.document import Document, Panel
from ...document.json_values import record
from ...document.quantities import ByDistance, Choice, Quantity, read_spec
from .pairs import show_instead, sides

PREDICTION = "prediction by "
"""The beginning of the words of a prediction."""


@dataclass(frozen=True)
class Prediction(ByDistance):
    """The misfit of each vertex to the point without a partner, by a distance (paper, section 5.2).

    It follows from the document's pairs and starts nowhere.
    """

    spec: Spec
    relates_surfaces = True
    done = "predicted"

    @property
    def before(self) -> str:
        return PREDICTION

    @property
    def heading(self) -> str:
        return "Prediction"

    @property
    def hint(self) -> str:
        return "least where distances from the pairs are most like those of the point"

    @classmethod
    def choice_by(cls, spec: Spec, has_other: bool) -> Choice | None:
        tip = "Where points of the other mesh are on this one"
        return Choice("Prediction by this distance", tip, cls(spec)) if has_other else None

    def to_json(self) -> dict[str, Any]:
        return {"prediction": self.spec.canonical}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        return cls(record(data, where, {"prediction": read_spec})["prediction"]) if "prediction" in data else None

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return cls(Spec.parse(words.removeprefix(PREDICTION), **parameters)) if words.startswith(PREDICTION) else None


def predict(document: Document) -> Document:
    """Show the first surface in one panel, and the second in a panel for each distance that was shown, which
    predicts by it.

    Raises ParameterError without a second surface.
    """
    first, second = sides(document)
    found = [spec for panel in document.panels for spec in panel.shows.specs]
    specs = list(dict.fromkeys(found))[: edits.MOST_ADDED - 1] or [Spec.of("biharmonic")]
    wanted = [(first, Prediction(specs[0])), *((second, Prediction(spec)) for spec in specs)]
    return show_instead(document, wanted)


def predicts(document: Document) -> bool:
    """Return whether a panel shows a prediction."""
    return any(predicts_in(panel) for panel in document.panels)


def predicts_in(panel: Panel) -> bool:
    """Return whether a panel shows a prediction."""
    return isinstance(panel.shows, Prediction)


def show_distances(document: Document) -> Document:
    """Let every panel of a prediction show its distance again, from where the others start."""
    return edits.show_distances(document, predicts_in)
