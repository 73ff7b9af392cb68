"""The values of fields at the points that have an isoline through them."""

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Place, Point
from .opened import Opened
from .questions import vertex_at


def values_through(document: Document, surface: str, opened: Opened, answer: Answer | None) -> tuple[float, ...]:
    """Of an answer's field, at the points of its surface; NaN where it is undefined, nothing where there is none."""
    points = [document.point(name) for name in document.isolines.through]
    if answer is None or answer.field is None:
        return ()
    return tuple(value_at(point, opened, answer) for point in points if point.surface == surface)


def value_at(point: Point, opened: Opened, answer: Answer) -> float:
    """Of an answer's field at a point, linear in a face."""
    if isinstance(point.at, Place):
        vertex_at(point.at, opened.surface)  # refuses a face that is not there
        return float(answer.field[opened.surface.faces[point.at.face]] @ point.at.weights)
    return float(answer.field[vertex_at(point.at, opened.surface)])
