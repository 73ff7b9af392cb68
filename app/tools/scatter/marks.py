"""Selected vertices."""

from ...document.runs import ids_of
from ...document.shared_parts.selections import Selections
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import AreaMark
from ...scene.style import PINS


def marks(marked: MarkedPanel) -> list[AreaMark]:
    """Return the selections of the panel's surface; for a figure, VertexError for a vertex that it does not have."""
    selections = marked.document[Selections].selections
    chosen = [each for each in selections if each.surface == marked.panel.surface and each.runs]
    for each in chosen if marked.is_for_figure else ():
        last = each.runs[-1][1]
        if last >= len(marked.loaded.surface.vertices):
            marked.loaded.surface.check_vertex(last)
    return [AreaMark(ids_of(each.runs), PINS[each.colour], each.name) for each in chosen]
