"""All marks of a panel: those of what it shows, and those of every tool."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Panel
from ..document.tools import tools
from ..session.loaded_mesh import LoadedMesh
from .field_marks import field_marks
from .primitives import PointMark, SurfaceMark

Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class MarkedPanel:
    """What marks are made of: a panel of a document, and its answer.

    surfaces: of the document, by their names; the panel's is there.  found: what others have found beside the window's
    thread, by its type; None if nobody has, and all is found at once, as for figures.
    """

    document: Document
    panel: Panel
    surfaces: Mapping[str, LoadedMesh]
    answer: Answer
    found: Mapping[type, Any] | None = None

    @property
    def is_for_figure(self) -> bool:
        """Whether what takes a while is waited for."""
        return self.found is None

    def find(self, kind: type[Found], made: Callable[[], Found | None]) -> Found | None:
        """What has been found of a type, None if it is still on its way; for a figure, `made` is called for it."""
        return made() if self.found is None else self.found.get(kind)

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
