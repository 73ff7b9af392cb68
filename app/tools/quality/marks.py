"""Extrema of fields."""

from weakref import WeakKeyDictionary

from bihdist_core import BihdistError
from bihdist_core.analysis.other_extrema import OtherExtrema, other_extrema
from bihdist_core.distances.answers import Answer

from ...marks.glyphs import TRIANGLE_DOWN, TRIANGLE_UP
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...session.questions import questions


def marks(marked: MarkedPanel) -> list[PointMark]:
    """Minima and maxima away from where the field starts, where the document says so."""
    found = marked.find(OtherExtrema, lambda: _extrema(marked))
    if found is None:
        return []
    minima = [PointMark(vertex, TRIANGLE_DOWN) for vertex in found.minima.tolist()]
    return minima + [PointMark(vertex, TRIANGLE_UP) for vertex in found.maxima.tolist()]


def _extrema(marked: MarkedPanel) -> OtherExtrema | None:
    """Those for a figure, found once for each answer; None where the document marks none, and of a constant field."""
    document, answer, surface = marked.document, marked.answer, marked.loaded.surface
    if not document.extrema or answer.field is None:
        return None
    if answer not in _found:
        question = questions(document)[marked.panel.id]
        try:
            _found[answer] = other_extrema(surface, answer.field, question.start(answer.field, surface))
        except BihdistError:
            _found[answer] = None
    return _found[answer]


_found: WeakKeyDictionary[Answer, OtherExtrema | None] = WeakKeyDictionary()
