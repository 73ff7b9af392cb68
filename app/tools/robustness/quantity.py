"""The change of a distance on a perturbed mesh, as a quantity of panels."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from bihdist_core.distances.distance_types import Spec

from ...document.json_values import record, text
from ...document.quantities import FromPoint, Quantity, kind_name, read_spec

CHANGE = "change of "
"""The beginning of the words of a change."""


@dataclass(frozen=True)
class DistanceChange(FromPoint):
    """How a distance differs on a perturbed surface from what it was before, each as a fraction of its maximum.

    It is defined at the vertices that both have; `point` is on the perturbed surface.
    """

    spec: Spec
    point: str = "source"
    compares_meshes = True
    in_percent = True

    @property
    def before(self) -> str:
        return CHANGE

    @property
    def heading(self) -> str:
        return f"Change of {kind_name(self.spec.distance_type).lower()}"

    @property
    def short_heading(self) -> str:
        return f"Δ {kind_name(self.spec.distance_type).lower()}"

    @property
    def hint(self) -> str:
        return "positive where it is larger after the change, negative where it is smaller"

    def to_json(self) -> dict[str, Any]:
        return {"change": self.spec.canonical, "from": self.point}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "change" not in data:
            return None
        values = record(data, where, {"change": read_spec, "from": text})
        return cls(values["change"], values["from"])

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return cls(Spec.parse(words.removeprefix(CHANGE), **parameters), point) if words.startswith(CHANGE) else None
