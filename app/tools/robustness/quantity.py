"""What a change of the mesh does to a distance, as what a panel can show."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bihdist_core.distances.kinds import Spec

from ...document.json_values import record, text
from ...document.quantities import FromPoint, Quantity, kind_name, read_spec

if TYPE_CHECKING:
    from ...document.document import Document
    from .answers import ChangeQuestion

CHANGE = "change of "
"""What the words of a change begin with."""


@dataclass(frozen=True)
class ChangeOf(FromPoint):
    """How a distance differs on a changed surface from what it was before, each as a fraction of its maximum.

    At the vertices that both have.  point: on the changed surface.
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
        return f"Change of {kind_name(self.spec.kind).lower()}"

    @property
    def short_heading(self) -> str:
        return f"Δ {kind_name(self.spec.kind).lower()}"

    @property
    def hint(self) -> str:
        return "positive where it is larger after the change, negative where it was before"

    def question(self, document: "Document", surface: str) -> "ChangeQuestion":
        """What has to be answered to show how a distance differs on the changed surface."""
        from .answers import ChangeQuestion

        return ChangeQuestion(document.mesh(surface), document.areas, self.spec, document.point(self.point).at)

    def to_json(self) -> dict[str, Any]:
        return {"change": self.spec.in_full, "from": self.point}

    @classmethod
    def from_json(cls, data: dict[str, Any], where: str) -> Quantity | None:
        if "change" not in data:
            return None
        values = record(data, where, {"change": read_spec, "from": text})
        return cls(values["change"], values["from"])

    @classmethod
    def from_words(cls, words: str, point: str, parameters: Mapping[str, object]) -> Quantity | None:
        return cls(Spec.parse(words.removeprefix(CHANGE), **parameters), point) if words.startswith(CHANGE) else None
