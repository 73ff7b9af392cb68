"""Pairs of corresponding points: pins on both surfaces, and where the next would be."""

from weakref import WeakKeyDictionary

from bihdist_core.distances.answers import Answer

from ...marks.glyphs import CANDIDATE, CROSS, PIN
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import LegendRow, PointMark
from ...scene.style import PINS, WAITING
from .candidate_judgement import CandidatesJudged, CandidatesJudging, candidates_asked
from .maps import Maps, Truth
from .pair_locations import LocatedPairPoint, candidate_in, located_pair_points


def marks(marked: MarkedPanel) -> list[PointMark | LegendRow]:
    """The points on a panel's surface, and the best candidate of its answer with where the point belongs."""
    document, panel = marked.document, marked.panel
    found: list[PointMark | LegendRow] = [
        pair_mark(each) for each in located_pair_points(document, panel.surface, marked.loaded)
    ]
    candidate = candidate_in(document, panel, marked.answer)
    judged = marked.find(CandidatesJudged, lambda: None if candidate is None else _judged(marked, candidate.vertex))
    if judged is not None and judged.places:
        name = "The place where the point belongs"
        if candidate is not None:
            name = f"The place where point {candidate.number} belongs"
        found += [*(PointMark(vertex, CROSS, name=name) for vertex in judged.places), LegendRow(CROSS, "truth")]
    if candidate is not None:
        off = None if judged is None else judged.errors.get(panel.id)
        aside = f"{100 * candidate.share:.1f} %" if off is None else f"{100 * off:.1f} % off"
        name, text = f"The candidate for point {candidate.number}", str(candidate.vertex)
        found.append(PointMark(candidate.vertex, CANDIDATE, WAITING, text, candidate.number, name=name, aside=aside))
        found.append(LegendRow(CANDIDATE, "candidate"))
    return found


def pair_mark(located: LocatedPairPoint) -> PointMark:
    """A pin marker at one point of a pair."""
    colour = WAITING if located.is_waiting else PINS[located.pair.colour]
    return PointMark(
        located.vertex, PIN, colour, number=located.number, name=f"Point {located.number}", point=located.point
    )


def _judged(marked: MarkedPanel, vertex: int) -> CandidatesJudged:
    """Where the point belongs, and how far the candidate is from there, as far as that is known; found once."""
    document, known = marked.document, _found.setdefault(marked.answer, {})
    truth = document[Maps].truth
    if truth not in known:
        known[truth] = CandidatesJudged((), {})
        one, two = (marked.loaded.standing_beside(mesh) for mesh in document.surfaces[:2])
        asked = None
        if one is not None and two is not None:
            asked = candidates_asked(document, one, two, {marked.panel.id: vertex})
        for judged in () if asked is None else CandidatesJudging().judge(asked):
            known[truth] = judged
    return known[truth]


_found: WeakKeyDictionary[Answer, dict[Truth, CandidatesJudged]] = WeakKeyDictionary()
