"""All marks of a panel: those of what it shows, and those of every tool."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from bihdist_core import PointCloud, Surface
from bihdist_core.analysis.chains import chains
from bihdist_core.analysis.label_borders import label_borders
from bihdist_core.distances.answers import Answer
from bihdist_core.sources.pieces import Pieces, pieces_of
from bihdist_core.sources.source import BoundaryLoop, Curve, Source, SurfacePoint
from bihdist_core.sources.words import short_words_of

from ..document.document import Document, Panel
from ..document.on_surface import SOURCE, Hidden
from ..document.source_edits import members_of
from ..document.tools import tools
from ..drawing.glyphs import DOT, LABELS, LARGEST, SWATCH
from ..session.isoline_points import IsolinePoint, passed
from ..session.loaded_mesh import LoadedMesh
from ..session.questions import source_at
from .primitives import AreaMark, Caption, LegendRow, LineMark, PointMark, SurfaceMark


def field_marks(document: Document, panel: Panel, loaded: LoadedMesh, answer: Answer) -> list[SurfaceMark]:
    """Return dots on isolines through points, marks where the field starts, borders of labels, and the largest of a
    difference."""
    return [
        *isoline_points(passed(document, panel.surface, loaded, answer), answer),
        *starts(document, panel, loaded.surface),
        *_label_lines(loaded.surface, answer),
        *largest(answer),
    ]


def isoline_points(points: Sequence[IsolinePoint], answer: Answer) -> list[PointMark]:
    """Return a dot on each isoline through a point; see `scene.levels` on the values that have a line."""
    low = -answer.maximum if answer.is_signed else 0.0
    found = [p for p in points if low < p.value < answer.maximum]
    return [PointMark(p.vertices[0], DOT, corners=p.vertices, weights=p.weights) for p in found]


def starts(document: Document, panel: Panel, surface: Surface) -> list[PointMark | LineMark]:
    """Mark where the field of a panel starts: by discs, which can be dragged, and by lines along loops and curves."""
    names = () if SOURCE in document[Hidden].hidden else panel.shows.points
    sources = [source_at(document.point(name).at, surface) for name in names]
    points = [point for source in sources for point in _source_points(source, surface)]
    return [*points, *_source_lines(sources, surface)]


def _source_points(start: Source, surface: Surface) -> list[PointMark]:
    """Return a disc for each vertex and each place in a face."""
    marks = []
    points = pieces_of(start, surface).points
    for face, corners, weights in zip(points.faces.tolist(), points.corners, points.start, strict=True):
        vertex = int(corners[weights.argmax()])
        if weights.max() == 1:
            marks.append(PointMark(vertex, is_handle=True))
            continue
        place = SurfacePoint(face, tuple(weights.tolist()))
        name, ids = f"The place {short_words_of(place)}", tuple(corners.tolist())
        marks.append(PointMark(vertex, corners=ids, weights=place.weights, name=name, is_handle=True))
    return marks


def _source_lines(sources: Sequence[Source], surface: Surface) -> list[LineMark]:
    """Return the lines of boundary loops and curves."""
    members = dict.fromkeys(member for source in sources for member in members_of(source))
    return [
        line
        for member in members
        if isinstance(member, BoundaryLoop | Curve)
        for line in source_lines(pieces_of(member, surface), _line_in_words(member))
    ]


def _line_in_words(member: BoundaryLoop | Curve) -> str:
    if isinstance(member, BoundaryLoop):
        return f"Boundary loop {member.number}"
    return f"The {'closed ' if member.closed else ''}curve of {len(member.places):,} points"


def source_lines(pieces: Pieces, name: str = "") -> list[LineMark]:
    """Return the lines that the parts of lines among some pieces make, one after another, each with this name."""
    lines = pieces.lines
    corners = np.concatenate([lines.corners, lines.corners])
    weights = np.concatenate([lines.start, lines.stop])
    numbers: dict[tuple[tuple[int, float], ...], int] = {}
    places: list[int] = []
    of = []
    for row, (ids, shares) in enumerate(zip(corners.tolist(), weights.tolist(), strict=True)):
        key = tuple(sorted((id, share) for id, share in zip(ids, shares, strict=True) if share > 0))
        if key not in numbers:
            numbers[key] = len(places)
            places.append(row)
        of.append(numbers[key])
    segments = np.array(of, np.int64).reshape(2, -1).T
    segments = segments[segments[:, 0] != segments[:, 1]]
    found = chains(segments) if len(segments) else []
    at = np.array(places, np.int64)
    return [LineMark(corners[at[ids]], weights[at[ids]], closed, name=name) for ids, closed in found]


def _label_lines(surface: Surface, answer: Answer) -> list[LineMark]:
    """Return the borders between labels; the discs of a point cloud have none."""
    if answer.labels is None or isinstance(surface, PointCloud):
        return []
    labels = np.where(np.isnan(answer.labels.values), -1, answer.labels.values).astype(np.int64)
    return [LineMark(*border, LABELS) for border in label_borders(labels, surface.faces)]


def label_rows(answer: Answer, most: int) -> list[LegendRow]:
    """Return what the colours of labels stand for, of those that most vertices have, in the order of their table."""
    labels = answer.labels
    if labels is None or labels.colours is None:
        return []
    order = np.argsort(-labels.counts, kind="stable")[:most]
    colours = ["#" + "".join(f"{round(255 * part):02x}" for part in colour) for colour in labels.colours.tolist()]
    there = sorted(k for k in order.tolist() if labels.counts[k])
    return [LegendRow(SWATCH, labels.names[k], colours[k]) for k in there]


def largest(answer: Answer) -> list[PointMark | LegendRow]:
    """Return a mark at the largest difference with its value, and what it stands for."""
    vertex = answer.largest
    if vertex is None or answer.field is None:
        return []
    value, percent = float(answer.field[vertex]), " %" if answer.scale == 100 else ""
    mark = PointMark(vertex, LARGEST, "largest", f"{value:+.3g}{percent} at {vertex}".replace("-", "−"))
    return [mark, LegendRow(LARGEST, "largest difference" if answer.signs else "largest magnitude", "largest")]


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
