"""Ends of the colour bars of a document's panels."""

from collections.abc import Callable, Mapping

import numpy as np

from bihdist_core.distances.answers import Answer

from ..document.derived_surfaces import partner
from ..document.document import Document
from .answering import Shown
from .loaded_mesh import LoadedMesh


def bar_end(
    document: Document, shown: Mapping[int, Shown], id: int, loaded: Callable[[str], LoadedMesh | None]
) -> float | None:
    """Return the end of a panel's colour bar, by what all panels show; None for the field's own maximum.

    `loaded` returns a surface by its name in the document.
    """
    answers = {other: each.answer for other, each in shown.items()}
    answer = answers[id]
    if document.range == "own":
        return own_end(document, answers, id, loaded)
    if not is_shared(document, answer):
        return None
    kind = (answer.unit, answer.signs is None)
    ends = [
        typed_end(document, other, each) or each.maximum
        for other, each in answers.items()
        if (each.unit, each.signs is None) == kind
    ]
    return max(ends)


def is_shared(document: Document, answer: Answer) -> bool:
    """Return whether all panels of the unit end alike; differences do, too, where distances are in fractions."""
    return document.range == "shared" or (document.range == "fraction" and answer.signs is not None)


def typed_end(document: Document, id: int, answer: Answer) -> float | None:
    """Return the end that the user typed for a panel's colour bar, in the unit of its answer; None for none."""
    end = document.panel(id).maximum
    return None if end is None else end * answer.scale


def own_end(
    document: Document, answers: Mapping[int, Answer], id: int, loaded: Callable[[str], LoadedMesh | None]
) -> float | None:
    """Return the end of a panel's colour bar if each panel has its own end.

    A distance before and after a change has one end: that of the vertices that are there before, and of these alone, as
    a thin handle may be far from everything else. `loaded` returns a surface by its name in the document.
    """
    panel = document.panel(id)
    other = partner(document, panel) if panel.maximum is None else None
    if id not in answers:
        return panel.maximum
    if other is None or other.id not in answers:
        return typed_end(document, id, answers[id])
    if other.maximum is not None:
        return None  # one that was typed is meant for its panel alone
    return max(_old_maximum(answers[each.id], loaded(each.surface)) for each in (panel, other)) or None


def _old_maximum(answer: Answer, loaded: LoadedMesh | None) -> float:
    """At the vertices that the surface has from what it is made from."""
    if answer.field is None or loaded is None or loaded.origin is None:
        return answer.maximum
    return float(np.nanmax(answer.field[loaded.ids >= 0], initial=0.0))


def ends_with(document: Document, shown: Mapping[int, Shown], id: int) -> list[int]:
    """Return the panels, by their ids, whose bars may end elsewhere when a panel shows another answer; itself, too."""
    if is_shared(document, shown[id].answer):
        return list(shown)
    other = partner(document, document.panel(id)) if document.range == "own" else None
    return [id] if other is None or other.id not in shown else [id, other.id]
