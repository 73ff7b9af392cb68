"""The points that have an isoline through them, and the values of fields there."""

from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.sources.source import SurfacePoint

from ..document.document import Document, Point
from ..document.on_surface import ISOLINES, Hidden
from .loaded_mesh import LoadedMesh
from .questions import vertex_at


@dataclass(frozen=True)
class IsolinePoint:
    """A point of an isoline: vertices of one face with weights that add up to 1.

    `value` is the field's there, NaN for none.
    """

    vertices: tuple[int, ...]
    weights: tuple[float, ...]
    value: float

    def of(self, field: FloatArray) -> FloatArray:
        """Return a field (n,) or positions (n, 3) there, linear in the face."""
        value: FloatArray = np.array(self.weights) @ field[list(self.vertices)]
        return value


def passed(document: Document, surface: str, loaded: LoadedMesh, answer: Answer | None) -> tuple[IsolinePoint, ...]:
    """Return a surface's points with the values of an answer's field; none where that has none, or they are hidden."""
    if answer is None or answer.field is None or ISOLINES in document[Hidden].hidden:
        return ()
    points = [document.point(name) for name in document.isolines.through]
    return tuple(_passed(point, loaded, answer.field) for point in points if point.surface == surface)


def _passed(point: Point, loaded: LoadedMesh, field: FloatArray) -> IsolinePoint:
    vertex = vertex_at(point.at, loaded.surface)  # also refuses a face that is not there
    if isinstance(point.at, SurfacePoint):
        corners = loaded.surface.faces[point.at.face]
        return IsolinePoint(tuple(corners.tolist()), point.at.weights, float(field[corners] @ point.at.weights))
    return IsolinePoint((vertex,), (1.0,), float(field[vertex]))
