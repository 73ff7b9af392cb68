"""Pairs of corresponding points in a figure: drops on both surfaces, and where the next would be, dashed."""

from weakref import WeakKeyDictionary

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Panel
from ..document.maps import Maps, Truth
from ..document.pairs import pair_words, waiting_point
from ..document.prediction import predicts_in
from ..marks.glyphs import CANDIDATE, CROSS, PIN
from ..marks.primitives import PointMark
from ..scene.style import PINS, WAITING
from ..session.candidate_errors import CandidatesJudged, CandidatesJudging, candidates_asked
from ..session.loaded_mesh import LoadedMesh
from ..session.pair_locations import candidate_in, located_pair_points


def pair_marks(document: Document, panel: Panel, loaded: LoadedMesh, answer: Answer) -> list[PointMark]:
    """Those on a panel's surface, and the best candidate of its answer."""
    marks = []
    for each in located_pair_points(document, panel.surface, loaded):
        colour = WAITING if each.is_waiting else PINS[each.pair.colour]
        marks.append(PointMark(each.vertex, PIN, number=each.number, colour=colour, name=f"Point {each.number}"))
    found = candidate_in(document, panel, answer)
    if found is not None:
        judged = _judged(document, panel, loaded, answer, found.vertex)
        name = f"The place where point {found.number} belongs"
        marks += [PointMark(vertex, CROSS, name=name) for vertex in judged.places]
        off = judged.errors.get(panel.id)
        said = f"{100 * found.share:.1f} %" if off is None else f"{100 * off:.1f} % off"
        words, name = f"{found.vertex}, {said}", f"The candidate for point {found.number}"
        marks.append(PointMark(found.vertex, CANDIDATE, WAITING, words, found.number, name=name))
    return marks


def _judged(document: Document, panel: Panel, loaded: LoadedMesh, answer: Answer, vertex: int) -> CandidatesJudged:
    """Where the point belongs, and how far the candidate is from there, as far as that is known; found once."""
    known = _found.setdefault(answer, {})
    if document[Maps].truth not in known:
        known[document[Maps].truth] = CandidatesJudged((), {})
        one, two = (loaded.standing_beside(mesh) for mesh in document.surfaces[:2])
        asked = None if one is None or two is None else candidates_asked(document, one, two, {panel.id: vertex})
        for judged in () if asked is None else CandidatesJudging().judge(asked):
            known[document[Maps].truth] = judged
    return known[document[Maps].truth]


_found: WeakKeyDictionary[Answer, dict[Truth, CandidatesJudged]] = WeakKeyDictionary()


def plain_heading(document: Document, panel: Panel, loaded: LoadedMesh, answer: Answer) -> tuple[str, str] | None:
    """What stands over a panel that predicts nothing now: the name of its surface, and what waits there.

    None where it does, and where it is said why it cannot.
    """
    if not predicts_in(panel) or answer.field is not None or answer.failure:
        return None
    waiting = waiting_point(document)
    is_here = waiting is not None and waiting.surface == panel.surface
    return loaded.surface.name, pair_words(document, panel.surface)[0] if is_here else ""
