"""Where the colour bars of a document's panels end."""

from collections.abc import Mapping

from ..document.document import Document
from .answering import Shown


def bar_end(document: Document, shown: Mapping[int, Shown], id: int) -> float | None:
    """Of a panel, by its id and by what all of them show; None for the field's own maximum."""
    if document.range == "shares":
        return None
    if document.range == "own":
        return document.panel(id).maximum
    unit = shown[id].answer.unit
    ends = [
        document.panel(other).maximum or shown[other].answer.maximum
        for other in shown
        if shown[other].answer.unit == unit
    ]
    return max(ends)
