"""Pairs of corresponding points: pins on both surfaces, and where the next would be."""

from weakref import WeakKeyDictionary

from bihdist_core.distances.answers import Answer

from ...drawing.glyphs import CANDIDATE, CROSS, PIN
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import Caption, LegendRow, PointMark
from ...scene.style import PINS, WAITING
from .answers import Candidate, LocatedPairPoint, candidate_in, colours_words, located_pair_points
from .candidate_errors import CandidateErrors, CandidateErrorWorker, candidate_request
from .maps import Maps, Truth
from .pairs import pair_words, waiting_point
from .quantity import predicts_in


def marks(marked: MarkedPanel) -> list[PointMark | LegendRow | Caption]:
    """Return the points on a panel's surface, and the best candidate of its answer with where the point belongs."""
    document, panel = marked.document, marked.panel
    candidate = candidate_in(document, panel, marked.answer)
    found: list[PointMark | LegendRow | Caption] = [
        *(pair_mark(each) for each in located_pair_points(document, panel.surface, marked.loaded)),
        _caption(marked, candidate),
    ]
    errors = marked.find(
        CandidateErrors, lambda: None if candidate is None else _candidate_errors(marked, candidate.vertex)
    )
    if errors is not None and errors.places:
        name = "The place where the point belongs"
        if candidate is not None:
            name = f"The place where point {candidate.number} belongs"
        found += [*(PointMark(vertex, CROSS, name=name) for vertex in errors.places), LegendRow(CROSS, "truth")]
    if candidate is not None:
        off = None if errors is None else errors.errors.get(panel.id)
        aside = f"{100 * candidate.share:.1f} %" if off is None else f"{100 * off:.1f} % off"
        name, text = f"The candidate for point {candidate.number}", str(candidate.vertex)
        found.append(PointMark(candidate.vertex, CANDIDATE, WAITING, text, candidate.number, name=name, aside=aside))
        found.append(LegendRow(CANDIDATE, "candidate"))
    return found


def _caption(marked: MarkedPanel, candidate: Candidate | None) -> Caption:
    """Return the caption of a panel: the misfit of the candidate, the next step, or the meaning of the colours."""
    document, panel, answer = marked.document, marked.panel, marked.answer
    if candidate is not None:
        return Caption(value=candidate.misfit, unit="misfit of the best")
    if not predicts_in(panel) or answer.failure:
        return Caption(colours_words(answer))
    sentence, name = pair_words(document, panel.surface), marked.loaded.surface.name
    if marked.is_for_figure:
        waiting = waiting_point(document)
        is_here = waiting is not None and waiting.surface == panel.surface
        return Caption(sentence if is_here else ("",), plain=name)
    others = document.panels_of(panel.surface)
    is_alone = sum(map(predicts_in, others)) == 1
    return Caption(sentence if others[0] == panel else ("",), plain=name if is_alone else "")


def pair_mark(located: LocatedPairPoint) -> PointMark:
    """Return a pin marker at one point of a pair."""
    colour = WAITING if located.is_waiting else PINS[located.pair.colour]
    return PointMark(
        located.vertex, PIN, colour, number=located.number, name=f"Point {located.number}", point=located.point
    )


def _candidate_errors(marked: MarkedPanel, vertex: int) -> CandidateErrors:
    """Return the errors of the candidate, found once for each answer."""
    document, known = marked.document, _found.setdefault(marked.answer, {})
    truth = document[Maps].truth
    if truth not in known:
        known[truth] = CandidateErrors((), {})
        one, two = (marked.loaded.shown_with(mesh) for mesh in document.surfaces[:2])
        asked = None
        if one is not None and two is not None:
            asked = candidate_request(document, one, two, {marked.panel.id: vertex})
        for found in () if asked is None else CandidateErrorWorker().errors(asked):
            known[truth] = found
    return known[truth]


_found: WeakKeyDictionary[Answer, dict[Truth, CandidateErrors]] = WeakKeyDictionary()
