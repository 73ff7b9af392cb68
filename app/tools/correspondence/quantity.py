"""Where a point of the other surface is predicted, as what a panel can show."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bihdist_core.distances.kinds import Spec

from ...document.document import Document
from ...document.json_values import record
from ...document.quantities import ByDistance, Choice, Quantity, read_spec

if TYPE_CHECKING:
    from .prediction_answers import PredictionQuestion

PREDICTION = "prediction by "
"""What the words of a prediction begin with."""


@dataclass(frozen=True)
class Prediction(ByDistance):
    """How badly each vertex fits the point that waits for its partner, by a distance (paper, section 5.2).

    From the document's pairs; it starts nowhere.  Nothing where no point of the other surface waits.
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
        tip = "Where points of the other mesh are on this one, by this distance"
        return Choice("Prediction by it", tip, cls(spec)) if has_other else None

    def question(self, document: Document, surface: str) -> "PredictionQuestion":
        """What has to be answered to predict the partner of the next point."""
        from .prediction_answers import prediction_question

        return prediction_question(document, surface, self.spec)

    def to_json(self) -> dict[str, Any]:
        return {"prediction": self.spec.in_full}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        return cls(record(data, where, {"prediction": read_spec})["prediction"]) if "prediction" in data else None

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return cls(Spec.parse(words.removeprefix(PREDICTION), **parameters)) if words.startswith(PREDICTION) else None
