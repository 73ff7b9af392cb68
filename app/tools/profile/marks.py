"""The path of the profile."""

from bihdist_core import BihdistError
from bihdist_core.analysis.places import Places

from ...drawing.glyphs import PATH
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import LineMark, Remark
from .part import shows_path
from .paths import path_of


def marks(marked: MarkedPanel) -> list[LineMark | Remark]:
    """Return the path on panels of its surface, or a sentence that says why there is none."""
    try:
        path = marked.find(Places, lambda: _path(marked))
    except BihdistError as error:
        return [Remark(f"No path is drawn: {error}")]
    return [] if path is None else [LineMark(path.corners, path.weights, look=PATH)]


def _path(marked: MarkedPanel) -> Places | None:
    if not shows_path(marked.document):
        return None
    surface, path = path_of(marked.document, marked.surfaces)
    return path.places if surface == marked.panel.surface else None
