"""The values of fields at the points that have an isoline through them."""

import numpy as np

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Place, Point
from .opened import Opened
from .questions import vertex_at


def values_through(document: Document, surface: str, opened: Opened, answer: Answer | None) -> tuple[float, ...]:
    """Of an answer's field, at the points of its surface; NaN where it is undefined, nothing where there is none."""
    if answer is None or answer.field is None:
        return ()
    points = [document.point(name) for name in document.isolines.through]
    return tuple(value_at(point, opened, answer.field) for point in points if point.surface == surface)


def value_at(point: Point, opened: Opened, field: np.ndarray) -> float:
    """Of a field (n,) at a point, linear in a face."""
    vertex = vertex_at(point.at, opened.surface)  # also refuses a face that is not there
    if isinstance(point.at, Place):
        return float(field[opened.surface.faces[point.at.face]] @ point.at.weights)
    return float(field[vertex])
