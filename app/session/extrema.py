"""The extrema of what panels show, away from where it starts: the same in the window and in figures."""

from weakref import WeakKeyDictionary

from bihdist_core import BihdistError, Surface
from bihdist_core.analysis.quality import OtherExtrema, other_extrema
from bihdist_core.distances.answers import Answer

from .questions import Question


def extrema_of(question: Question, surface: Surface, answer: Answer) -> OtherExtrema | None:
    """Of an answer to a question; None where there is no field, or nothing but one value.  Found once."""
    if answer.field is None:
        return None
    if answer not in _found:
        try:
            _found[answer] = other_extrema(surface, answer.field, question.start(answer.field, surface))
        except BihdistError:
            _found[answer] = None
    return _found[answer]


_found: WeakKeyDictionary[Answer, OtherExtrema | None] = WeakKeyDictionary()
