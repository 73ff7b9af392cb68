"""The points that have an isoline through them, and the values of fields there."""

from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer
from bihdist_core.sources.source import SurfacePoint

from ..document.document import Document, Point
from .loaded_mesh import LoadedMesh
from .questions import vertex_at


@dataclass(frozen=True)
class IsolinePoint:
    """Where a line passes: vertices of one face with weights that add up to 1; value: the field's, NaN for none."""

    vertices: tuple[int, ...]
    weights: tuple[float, ...]
    value: float

    def of(self, field: FloatArray) -> FloatArray:
        """A field (n,) or positions (n, 3) there, linear in the face."""
        value: FloatArray = np.array(self.weights) @ field[list(self.vertices)]
        return value


def passed(document: Document, surface: str, loaded: LoadedMesh, answer: Answer | None) -> tuple[IsolinePoint, ...]:
    """The points of a surface, with the values of an answer's field; none where that has none."""
    if answer is None or answer.field is None:
        return ()
    points = [document.point(name) for name in document.isolines.through]
    return tuple(_passed(point, loaded, answer.field) for point in points if point.surface == surface)


def _passed(point: Point, loaded: LoadedMesh, field: FloatArray) -> IsolinePoint:
    vertex = vertex_at(point.at, loaded.surface)  # also refuses a face that is not there
    if isinstance(point.at, SurfacePoint):
        corners = loaded.surface.faces[point.at.face]
        return IsolinePoint(tuple(corners.tolist()), point.at.weights, float(field[corners] @ point.at.weights))
    return IsolinePoint((vertex,), (1.0,), float(field[vertex]))
