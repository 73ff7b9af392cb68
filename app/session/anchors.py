"""The anchors of a document: where they are, and what their colours say."""

import math

from bihdist_core.distances.answers import Answer

from ..document.anchors import Anchors
from ..document.document import Document
from .loaded_mesh import LoadedMesh
from .questions import vertex_at


def anchors_on(document: Document, surface: str, loaded: LoadedMesh) -> list[tuple[int, float | None]]:
    """The vertices of those on a surface of the document, with their values."""
    points = [(anchor, document.point(anchor.point)) for anchor in document[Anchors].anchors]
    return [(vertex_at(p.at, loaded.surface), a.value) for a, p in points if p.surface == surface]


def anchor_value(value: float | None, vertex: int, answer: Answer | None) -> float:
    """An anchor without a value of its own has the field's there; NaN where that is undefined."""
    if value is not None:
        return value
    return math.nan if answer is None or answer.field is None else float(answer.field[vertex])
