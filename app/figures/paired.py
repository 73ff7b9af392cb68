"""Pairs of corresponding points in a figure: drops on both surfaces, and where the next would be, dashed."""

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Panel
from ..document.pairing import pair_words, waiting_point
from ..document.predicting import predicts_in
from ..drawing.style import PINS, WAITING
from ..session.opened import Opened
from ..session.paired import candidate_in, paired_on
from .description import Mark


def pair_marks(document: Document, panel: Panel, opened: Opened, answer: Answer) -> list[Mark]:
    """Those on a panel's surface, and the best candidate of its answer."""
    marks = []
    for each in paired_on(document, panel.surface, opened):
        colour = WAITING if each.is_waiting else PINS[each.pair.colour]
        marks.append(Mark(each.vertex, number=each.number, colour=colour, name=f"Point {each.number}"))
    found = candidate_in(document, panel, answer)
    if found is not None:
        words, name = f"{found.vertex}, {100 * found.share:.1f} %", f"The candidate for point {found.number}"
        marks.append(Mark(found.vertex, text=words, number=found.number, colour=WAITING, name=name, is_candidate=True))
    return marks


def plain_heading(document: Document, panel: Panel, opened: Opened, answer: Answer) -> tuple[str, str] | None:
    """What stands over a panel that predicts nothing now: the name of its surface, and what waits there.

    None where it does, and where it is said why it cannot.
    """
    if not predicts_in(panel) or answer.field is not None or answer.failure:
        return None
    waiting = waiting_point(document)
    is_here = waiting is not None and waiting.surface == panel.surface
    return opened.surface.name, pair_words(document, panel.surface)[0] if is_here else ""
