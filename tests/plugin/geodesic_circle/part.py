"""What the tool adds to documents: the point that the circle goes through."""

from collections.abc import Set
from dataclasses import dataclass

from bihdist.document.document import Document
from bihdist.document.edits import put_point, show_dock
from bihdist.document.part import Part

POINT = "circle"


@dataclass(frozen=True)
class Circle(Part):
    """through: the name of a point, "" for no circle."""

    key = "circle"

    through: str = ""

    @property
    def points(self) -> tuple[str, ...]:
        return (self.through,) if self.through else ()

    def without_points(self, points: Set[str]) -> "Circle":
        return Circle() if self.through in points else self


def with_circle(document: Document, vertex: int, surface: str) -> Document:
    """The document with the circle through a vertex of a surface, and the dock that says how long it is."""
    document = put_point(document, POINT, vertex, surface)
    return show_dock(document.with_part(Circle(POINT)), "circle")
