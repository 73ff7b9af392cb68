"""The boundaries of the regions of pins."""

from bihdist_core.analysis.region_boundaries import Boundary, region_boundaries

from ...marks.line_looks import BOUNDARY
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import LineMark
from ...session.regions import regions_of, regions_questions


def marks(marked: MarkedPanel) -> list[LineMark]:
    """Where the panel shows them."""
    question = regions_questions(marked.document).get(marked.panel.id)
    if question is None or marked.answer.field is None:
        return []
    regions = regions_of(question, marked.loaded)
    return [boundary_mark(curve) for curve in region_boundaries(marked.loaded.surface, regions)]


def boundary_mark(curve: Boundary) -> LineMark:
    return LineMark(curve.corners, curve.weights, curve.closed, BOUNDARY)
