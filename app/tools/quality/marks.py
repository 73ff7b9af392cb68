"""Extrema of fields."""

from collections.abc import Iterator
from functools import partial
from weakref import WeakKeyDictionary

from bihdist_core import BihdistError
from bihdist_core.analysis.persistence import OtherExtrema, other_extrema
from bihdist_core.distances.answers import Answer

from ...document.document import Document
from ...document.edits import mark_extrema
from ...document.on_surface import SurfaceItem
from ...drawing.glyphs import TRIANGLE_DOWN, TRIANGLE_UP
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...session.questions import questions


def marks(marked: MarkedPanel) -> list[PointMark]:
    """Return the extrema away from where the field starts, if the document or a dock asks for them."""
    found = marked.find(OtherExtrema, lambda: _extrema(marked))
    if found is None:
        return []
    minima = [PointMark(vertex, TRIANGLE_DOWN) for vertex in found.minima.tolist()]
    return minima + [PointMark(vertex, TRIANGLE_UP) for vertex in found.maxima.tolist()]


def items(document: Document) -> Iterator[SurfaceItem]:
    """Yield the extrema of all panels; those of a dock are removed by closing it."""
    of_docks = "quality" in document.docks or any(panel.shows.marks_extrema(document) for panel in document.panels)
    if document.extrema or of_docks:
        detail = "of all panels" if document.extrema else "while the tool is open"
        remove = partial(mark_extrema, is_shown=False) if document.extrema else None
        yield SurfaceItem("extrema", "Extrema", detail, "triangle", remove, dock="quality")


def _extrema(marked: MarkedPanel) -> OtherExtrema | None:
    """Return the extrema of an answer for a figure, found once; None if the document marks none, and for a constant
    field."""
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
