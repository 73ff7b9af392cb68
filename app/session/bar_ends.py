"""Where the colour bars of a document's panels end."""

from collections.abc import Callable, Mapping

import numpy as np

from bihdist_core.distances.answers import Answer

from ..document.changing import partner
from ..document.document import Document
from .answering import Shown
from .opened import Opened


def bar_end(
    document: Document, shown: Mapping[int, Shown], id: int, opened: Callable[[str], Opened | None]
) -> float | None:
    """Of a panel, by its id and by what all of them show; None for the field's own maximum.

    opened: as in `own_end`.
    """
    if document.range == "shares":
        return None
    if document.range == "own":
        return own_end(document, {other: each.answer for other, each in shown.items()}, id, opened)
    unit = shown[id].answer.unit
    ends = [
        document.panel(other).maximum or shown[other].answer.maximum
        for other in shown
        if shown[other].answer.unit == unit
    ]
    return max(ends)


def own_end(
    document: Document, answers: Mapping[int, Answer], id: int, opened: Callable[[str], Opened | None]
) -> float | None:
    """The same where each panel has its own: what a distance is before and after a change has one end.

    That is of vertices that are there before, and of these alone: a thin handle may be far from everything else.
    opened: a surface by its name in the document.
    """
    panel = document.panel(id)
    other = partner(document, panel) if panel.maximum is None else None
    if other is None or id not in answers or other.id not in answers:
        return panel.maximum
    if other.maximum is not None:
        return None  # one that was typed is meant for its panel alone
    return max(_old_maximum(answers[each.id], opened(each.surface)) for each in (panel, other)) or None


def _old_maximum(answer: Answer, opened: Opened | None) -> float:
    """At the vertices that the surface has from what it is made from."""
    if answer.field is None or opened is None or opened.origin is None:
        return answer.maximum
    return float(np.nanmax(answer.field[opened.ids >= 0], initial=0.0))


def ends_with(document: Document, shown: Mapping[int, Shown], id: int) -> list[int]:
    """The panels, by their ids, whose bars may end elsewhere when a panel shows another answer; itself, too."""
    if document.range == "shared":
        return list(shown)
    other = partner(document, document.panel(id)) if document.range == "own" else None
    return [id] if other is None or other.id not in shown else [id, other.id]
