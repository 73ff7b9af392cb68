"""The panels of an experiment as figures, drawn by the same code as everybody's figures."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bihdist_core import Surface
from bihdist_core.arrays import FloatArray
from bihdist_core.experiments import Mark as ExperimentMark, Panel, Result
from bihdist_core.experiments.result import MARKS

from ..document.camera import Camera, View
from ..document.looks import Isolines
from ..drawing.glyphs import BALL, CROSS, DIAMOND, DISC, PIN, TRIANGLE_DOWN, TRIANGLE_UP
from ..figures.description import Entry
from ..figures.draw import Figure, FigurePanel
from ..figures.framing import seen
from ..figures.size import Size
from ..marks.primitives import PointMark
from ..scene.camera import directions, outwards_at
from ..scene.picking import FaceBlocks
from ..scene.style import PAPER

ACROSS, ACROSS_NARROW = {1: 4, 2: 3}, {1: 6, 2: 3}
"""Panels side by side at most, by how many views they have; of shapes higher than wide there may be more."""

RELIEF = 0.6
"""Height of a height field, as a share of the domain's extent."""

WIDTH, FINER = 1160, 2
"""Pixels of the page that a picture takes, and how many of its own it has for each."""

ALONE, TEXT = 280, 8.0
"""Pixels of the page that one view takes at most, and the size of labels in points."""

STYLE = replace(PAPER, marker_size=1.5 * PAPER.marker_size)
"""Views are small, and their marks are to be found."""

SIDES = ("front", "back", "left", "right", "top", "bottom")

BROAD = 0.7
"""A view is broad if the shape takes at least this share of what it takes in the broadest."""

CLOSE_UP_RADII = 5.0
"""The distance of the camera of a close-up, in radii of what it shows."""

ANCHOR, TARGET, CANDIDATE = "#262B33", "#E0162B", "#FFC400"
"""Colours of marks that are told apart by their shapes as well."""

WORDS = {
    "source": "source",
    "anchor": "landmarks",
    "target": "the point to match",
    "candidate": "its match",
    "place": "ground truth",
    "minimum": "local minimum",
    "maximum": "local maximum",
}


def rows_of(result: Result) -> dict[str, list[Panel]]:
    """Return the panels of each row, by its name, in order of their first ones."""
    rows: dict[str, list[Panel]] = {}
    for panel in result.panels:
        rows.setdefault(panel.row, []).append(panel)
    return rows


def name_of(result: Result, row: str) -> str:
    """Return the name of the file of a row's picture, without extension."""
    return "-".join(word for word in (result.id, plain_name(row)) if word)


def figure_of(result: Result, panels: Sequence[Panel], up: str = "y") -> Figure:
    """Return the figure of a row of panels with the axis `up` in all of them."""
    side = _side(result, panels, up)
    shown = [_panel(result, panel, up, side) for panel in panels]
    views = max(len(panel.views) for panel in shown)
    columns = _columns(shown, views, any("source" in panel.views for panel in panels))
    size = Size(FINER * min(WIDTH, columns * views * ALONE), dpi=FINER * 96)
    return Figure(
        tuple(shown),
        columns,
        size,
        legend=_legend(panels),
        style=STYLE,
        crop=True,
        text=TEXT,
        dashes_all=False,
    )


def _columns(panels: Sequence[FigurePanel], views: int, are_pairs: bool) -> int:
    """Return the number of columns for rows as even as possible: four panels of two views are two by two; pairs stay
    together."""
    parts = [seen(view, panel, panel.surface) for panel in panels for view in panel.views]
    is_narrow = all(part.aspect < 1 for part in parts)
    most = (ACROSS_NARROW if is_narrow else ACROSS).get(views, 2)
    if are_pairs:
        return next((n for n in range(most, 1, -1) if n % 2 == len(panels) % n == 0), 2)
    lines = -(-len(panels) // most)
    return -(-len(panels) // lines)


def _panel(result: Result, panel: Panel, up: str, side: str) -> FigurePanel:
    surface = result.surfaces[panel.surface]
    is_relief = panel.style == "height" and panel.field is not None
    field, label = panel.field, ""
    if field is not None and panel.exaggerate != 1:
        # Small values are spread out by the colours, so the bar's numbers are those of the power.
        field, label = np.asarray(field) ** panel.exaggerate, f"cost to the power {panel.exaggerate:g}"
    views: list[View] = []
    for view in panel.views:
        if view != "zoom":
            views.append(side if view == "source" else view)
        elif panel.zoom_vertex is not None and panel.zoom_radius:
            views.append(_close_up(surface, panel.zoom_vertex, panel.zoom_radius, up))
    return FigurePanel(
        surface,
        field,
        panel.heading,
        label=label,
        isolines=Isolines(panel.isoline_count, round=False),
        views=("relief",) if is_relief else tuple(views) or ("front",),
        marks=_marks(panel.marks),
        warp_factor=RELIEF if is_relief else 0.0,
        failure=panel.failure,
        up=up,
    )


def _side(result: Result, panels: Sequence[Panel], up: str) -> str:
    """Return the standard view in which most panels of a row show their first marks, a broad one if possible.

    Of several, it is the one that looks at the first panel's mark most frontally.
    """
    marked = [(result.surfaces[panel.surface], panel.marks[0].vertex) for panel in panels if panel.marks]
    outwards = outwards_at(*marked[0]) if marked else None
    if outwards is None:
        return "front"
    different = dict.fromkeys((id(surface), vertex) for surface, vertex in marked)
    places = [next(each for each in marked if (id(each[0]), each[1]) == key) for key in different]

    used = marked[0][0].vertices
    across = {view: _across(used, *directions(view, up)) for view in SIDES}

    def score(view: str) -> tuple[int, bool, float]:
        towards = directions(view, up)[0]
        seen_in = sum(is_seen(*place, towards) for place in places)
        return seen_in, across[view] >= BROAD * max(across.values()), float(outwards @ towards)

    return max(SIDES, key=score)


def _across(vertices: FloatArray, towards: FloatArray, upright: FloatArray) -> float:
    """Return the area of the rectangle of a shape in a view."""
    return float(np.ptp(vertices @ np.cross(upright, towards)) * np.ptp(vertices @ upright))


def is_seen(surface: Surface, vertex: int, towards: FloatArray) -> bool:
    """Return whether nothing but the faces at a vertex is in the way from it in a direction (3,)."""
    at, size = surface.vertices[vertex], float(np.linalg.norm(np.ptp(surface.vertices, axis=0)))
    far = at + 2 * size / np.linalg.norm(towards) * towards
    return FaceBlocks(surface).sees(far, at, 1e-9 * size)


def _close_up(surface: Surface, vertex: int, radius: float, up: str) -> View:
    """Return the camera that sees a place from outside, and so far around it."""
    outwards = outwards_at(surface, vertex)
    if outwards is None:
        return "front"
    back, upright = directions("source", up, outwards)
    at = surface.vertices[vertex]
    position = at + CLOSE_UP_RADII * radius * back
    return Camera(
        tuple(position.tolist()), tuple(at.tolist()), tuple(upright.tolist()), (1 / CLOSE_UP_RADII, 1 / CLOSE_UP_RADII)
    )


# ---------------------------------------------------------------------- marks
GLYPHS = {
    "source": (DISC, "source"),
    "anchor": (PIN, ANCHOR),
    "target": (BALL, TARGET),
    "candidate": (DIAMOND, CANDIDATE),
    "place": (CROSS, ""),
    "minimum": (TRIANGLE_DOWN, ""),
    "maximum": (TRIANGLE_UP, ""),
}
"""The shape and the colour of each kind."""


def _marks(marks: Sequence[ExperimentMark]) -> tuple[PointMark, ...]:
    """Return the marks of a panel; anchors are numbered in their order."""
    anchors = [mark.vertex for mark in marks if mark.kind == "anchor"]
    return tuple(
        _mark(mark.kind, mark.vertex, anchors.index(mark.vertex) + 1 if mark.kind == "anchor" else None)
        for mark in sorted(marks, key=lambda mark: MARKS.index(mark.kind), reverse=True)
    )


def _mark(kind: str, vertex: int, number: int | None = None) -> PointMark:
    return PointMark(vertex, *GLYPHS[kind], number=number)


def _legend(panels: Sequence[Panel]) -> tuple[Entry, ...]:
    """Explain the marks of panels; marks with words of their own one by one."""
    found: dict[tuple[str, int | None], str] = {}
    for panel in panels:
        anchors = [mark for mark in panel.marks if mark.kind == "anchor"]
        for mark in panel.marks:
            number = anchors.index(mark) + 1 if mark.kind == "anchor" and mark.words else None
            found.setdefault((mark.kind, number), mark.words or WORDS[mark.kind])
    known = sum(mark.kind == "anchor" for mark in panels[0].marks)
    entries = []
    for kind, number in sorted(found, key=lambda key: (MARKS.index(key[0]), key[1] or 0)):
        words = found[kind, number]
        if kind == "anchor" and number is None and known > 1:
            words = f"1 to {known}: {words}"
        entries.append((_mark(kind, 0, (number or 1) if kind == "anchor" else None), words))
    return tuple(entries)


def plain_name(text: str) -> str:
    """Return the characters of a name that a file name can have."""
    return "".join(c if c.isalnum() else "-" for c in text.lower()).strip("-")
