"""Extrema of fields."""

from bihdist_core.analysis.quality import OtherExtrema

from ...marks.glyphs import TRIANGLE_DOWN, TRIANGLE_UP
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...session.extrema import extrema_of
from ...session.questions import questions


def marks(marked: MarkedPanel) -> list[PointMark]:
    """Minima and maxima away from where the field starts, where the document says so."""
    found = marked.find(OtherExtrema, lambda: _extrema(marked))
    if found is None:
        return []
    minima = [PointMark(vertex, TRIANGLE_DOWN) for vertex in found.minima.tolist()]
    return minima + [PointMark(vertex, TRIANGLE_UP) for vertex in found.maxima.tolist()]


def _extrema(marked: MarkedPanel) -> OtherExtrema | None:
    document = marked.document
    if not document.extrema:
        return None
    return extrema_of(questions(document)[marked.panel.id], marked.loaded.surface, marked.answer)
