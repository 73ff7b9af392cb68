"""The anchors of a document: where they are."""

from ..document.anchors import Anchors
from ..document.document import Document
from .loaded_mesh import LoadedMesh
from .questions import vertex_at


def anchors_on(document: Document, surface: str, loaded: LoadedMesh) -> list[tuple[int, float | None]]:
    """The vertices of those on a surface of the document, with their values."""
    points = [(anchor, document.point(anchor.point)) for anchor in document[Anchors].anchors]
    return [(vertex_at(p.at, loaded.surface), a.value) for a, p in points if p.surface == surface]
