"""The circle on a panel that shows geodesic distance."""

from dataclasses import dataclass

import numpy as np
from bihdist.document.document import Document, Panel

from bihdist_core import Surface
from bihdist_core.analysis.bands import band
from bihdist_core.analysis.isoline_tracing import Isoline, isolines

from .part import Circle


@dataclass(frozen=True, eq=False)
class Measured:
    """radius, length: in the mesh's unit; area: in its square.  curves: the circle, perhaps in several pieces."""

    radius: float
    length: float
    area: float
    curves: list[Isoline]


def vertex_in(document: Document, panel: Panel) -> int | None:
    """The vertex that the circle goes through, where a panel shows one."""
    name = document[Circle].through
    if not name or not panel.shows.is_distance or panel.shows.specs[0].word != "geodesic":
        return None
    point = document.point(name)
    return point.at if point.surface == panel.surface else None


def measured(surface: Surface, field: np.ndarray, vertex: int) -> Measured:
    """Of the distances (n,) from the middle of the circle; VertexError for a vertex that there is not."""
    surface.check_vertex(vertex)
    radius = float(field[vertex])
    curves = isolines(surface, field, radius)
    return Measured(radius, sum(curve.length for curve in curves), band(surface, field, high=radius).area, curves)
