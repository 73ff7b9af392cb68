"""The boundaries of the regions of pins."""

from bihdist_core.analysis.region_boundaries import region_boundaries

from ...drawing.glyphs import BOUNDARY
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import LineMark
from .division import Divided, regions_of, regions_questions


def marks(marked: MarkedPanel) -> list[LineMark]:
    """Return the boundaries of the regions, if the panel shows them."""
    divided = marked.find(Divided, lambda: _divided(marked))
    curves = () if divided is None else divided.boundaries
    return [LineMark(curve.corners, curve.weights, curve.closed, BOUNDARY) for curve in curves]


def _divided(marked: MarkedPanel) -> Divided | None:
    question = regions_questions(marked.document).get(marked.panel.id)
    if question is None or marked.answer.field is None:
        return None
    regions = regions_of(question, marked.loaded)
    return Divided(question, regions, tuple(region_boundaries(marked.loaded.surface, regions)))
