"""All marks of a panel: those of what it shows, and those of every tool."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from bihdist_core.distances.answers import Answer

from ..document.document import Document, Panel
from ..document.on_surface import Hidden
from ..document.tools import tools
from ..session.loaded_mesh import LoadedMesh
from .field_marks import field_marks
from .primitives import AreaMark, Caption, PointMark, SurfaceMark

Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class MarkedPanel:
    """The input of marks: a panel of a document, and its answer.

    Attributes
    ----------
    surfaces
        The document's surfaces by their names, the panel's among them.
    found
        What has been found beside the window's thread, by its type; None for figures, where it is found at once.
    """

    document: Document
    panel: Panel
    surfaces: Mapping[str, LoadedMesh]
    answer: Answer
    found: Mapping[type, Any] | None = None

    @property
    def is_for_figure(self) -> bool:
        """True if marks that take a while are waited for."""
        return self.found is None

    def find(self, kind: type[Found], made: Callable[[], Found | None]) -> Found | None:
        """Find the value of a type, None if it is still on its way; for a figure, the result of `made`."""
        return made() if self.found is None else self.found.get(kind)

    @property
    def loaded(self) -> LoadedMesh:
        """The panel's surface."""
        return self.surfaces[self.panel.surface]


def marks_of_tools(marked: MarkedPanel) -> dict[str, list[SurfaceMark]]:
    """Return the marks of each tool, by its word, without those that the document hides."""
    hidden, found = marked.document[Hidden], {}
    for tool in tools():
        if tool.marks:
            marks: list[SurfaceMark] = tool.load(tool.marks)(marked)
            if hidden.hidden and tool.items:
                words = [item.word for item in tool.load(tool.items)(marked.document)]
                marks = [mark for mark in marks if not hidden.hides(words, _name(mark)) or isinstance(mark, Caption)]
            found[tool.word] = marks
    return found


def _name(mark: SurfaceMark) -> str:
    """Return the name by which a mark is hidden among those of its tool."""
    return mark.point if isinstance(mark, PointMark) else mark.name if isinstance(mark, AreaMark) else ""


def marks_of(marked: MarkedPanel) -> list[SurfaceMark]:
    """Return all marks in the order in which points lie on each other; what a tool marks may take a while."""
    found = field_marks(marked.document, marked.panel, marked.loaded, marked.answer)
    for marks in marks_of_tools(marked).values():
        found += marks
    return sorted(found, key=lambda mark: mark.glyph.rank if isinstance(mark, PointMark) else 0)
