"""All marks of a panel: those of what it shows, and those of every tool."""

from collections.abc import Mapping
from dataclasses import dataclass

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Panel
from ..document.tools import tools
from ..session.loaded_mesh import LoadedMesh
from .field_marks import field_marks
from .primitives import PointMark, SurfaceMark


@dataclass(frozen=True, eq=False)
class MarkedPanel:
    """What marks are made of: a panel of a document, and its answer.

    surfaces: of the document, by their names; the panel's is there.
    """

    document: Document
    panel: Panel
    surfaces: Mapping[str, LoadedMesh]
    answer: Answer

    @property
    def loaded(self) -> LoadedMesh:
        """The panel's surface."""
        return self.surfaces[self.panel.surface]


def marks_of(marked: MarkedPanel) -> list[SurfaceMark]:
    """In the order in which points lie on each other; what a tool's `marks` finds may take a while."""
    found = field_marks(marked.document, marked.panel, marked.loaded, marked.answer)
    for tool in tools():
        if tool.marks:
            found += tool.load(tool.marks)(marked)
    return sorted(found, key=lambda mark: mark.glyph.rank if isinstance(mark, PointMark) else 0)
