"""The extrema of what panels show, away from where it starts: the same in the window and in figures."""

from weakref import WeakKeyDictionary

import numpy as np

from bihdist_core import BihdistError, Surface
from bihdist_core.analysis.quality import OtherExtrema, apparent_source, other_extrema
from bihdist_core.distances.answers import Answer
from bihdist_core.sources.source import Source, SourceSet

from ..document.sourcing import members_of
from .questions import (
    ChangeQuestion,
    DifferenceQuestion,
    DistanceQuestion,
    FieldQuestion,
    InterpolantQuestion,
    PredictionQuestion,
    Question,
    source_at,
    vertex_at,
)


def start_of(question: Question, field: np.ndarray, surface: Surface) -> Source | None:
    """Where a field (n,), the answer to a question, starts: all that the distances it is made of do.

    A field from Python starts where it seems to, if anywhere.  VertexError or ParameterError for a source that is not
    on this surface.
    """
    if isinstance(question, FieldQuestion):
        return apparent_source(field)
    if isinstance(question, PredictionQuestion):
        return apparent_source(field)
    if isinstance(question, InterpolantQuestion):
        return SourceSet(tuple(vertex_at(at, surface) for at, _ in question.anchors))
    parts = (question.minuend, question.subtrahend) if isinstance(question, DifferenceQuestion) else (question,)
    starts = [source_at(each.at, surface) for each in parts if isinstance(each, DistanceQuestion | ChangeQuestion)]
    members = tuple(dict.fromkeys(member for start in starts for member in members_of(start)))
    return SourceSet(members) if len(members) > 1 else next(iter(members), None)


def extrema_of(question: Question, surface: Surface, answer: Answer) -> OtherExtrema | None:
    """Of an answer to a question; None where there is no field, or nothing but one value.  Found once."""
    if answer.field is None:
        return None
    if answer not in _found:
        try:
            _found[answer] = other_extrema(surface, answer.field, start_of(question, answer.field, surface))
        except BihdistError:
            _found[answer] = None
    return _found[answer]


_found: WeakKeyDictionary[Answer, OtherExtrema | None] = WeakKeyDictionary()
