"""Where the insets of a panel stand: in corners of its view, or beside the shape where they would hide much of it."""

from __future__ import annotations

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.arrays import AnyArray, FloatArray

from ..scene.corners import SIDE, chosen_corners, corner_boxes, cover, source_box
from .boxes import Box
from .description import Figure
from .framing import Framed, Seen, places

GAP = 4.0

HIDDEN = 0.02
"""The share of an inset that may lie on the shape, before it gets room of its own."""


def insets_of(
    figure: Figure, panel: int, surface: Surface, area: Box, part: Seen | None, scale: float
) -> tuple[Box, tuple[Box, ...]]:
    """The box left to the first view of a panel with zooms, of all its area, and the boxes of the insets."""
    each = figure.panels[panel]
    side = SIDE * min(area.width, area.height)
    is_free = all(zoom.corner == "auto" for zoom in each.zooms)
    if figure.is_moving and is_free:
        return _beside(figure, panel, surface, area, part, scale)
    view = _View(figure, panel, surface, area, part)
    names, hidden = view.corners(side, area)
    boxes = [view.box(name, side, area) for name in names]
    if hidden > HIDDEN and is_free:
        return _beside(figure, panel, surface, area, part, scale)
    return area, tuple(box.snapped(scale) for box in boxes)


def source_of(framed: Framed, surface: Surface, vertex: int, side: float, factor: float, view: Box) -> Box:
    """What an inset of this side shows of the page, inside its view; ParameterError if its vertex is not there."""
    x, y = framed.places(surface.vertices[[vertex]])[0]
    if not view.holds(x, y):
        raise ParameterError(f"Vertex {vertex} is outside the picture, so it cannot be enlarged.")
    shown = side / factor
    # At the edge of a view the vertex is not in the middle, and no frame stands on a colour bar.
    left = min(max(x - shown / 2, view.x), max(view.right - shown, view.x))
    top = min(max(y - shown / 2, view.y), max(view.bottom - shown, view.y))
    return Box(left, top, shown, shown)


class _View:
    """The first view of a panel, in pixels from its lower left corner as corners are chosen in."""

    def __init__(self, figure: Figure, panel: int, surface: Surface, box: Box, part: Seen | None) -> None:
        self._box = box
        each = figure.panels[panel]
        self._zooms = each.zooms
        framed = Framed(each.views[0], each, surface, box, part)
        self._surface = self._turned(framed.places(places(surface)))
        self._marks = self._turned(framed.places(surface.vertices[[m.vertex for m in each.marks]]))
        self._targets = self._turned(framed.places(surface.vertices[[z.vertex for z in each.zooms]]))

    def corners(self, side: float, area: Box) -> tuple[list[str], float]:
        """The corner of each zoom, and the largest share that one of their insets lies on the shape or a mark."""
        boxes = corner_boxes((area.width, area.height), side, GAP)
        sources = [source_box(t, side, z) for t, z in zip(self._targets, self._zooms, strict=True)]
        names = chosen_corners(self._zooms, boxes, sources, self._surface, self._marks)
        worst = max(cover(boxes[name], self._surface) for name in names)
        if len(set(names)) < len(names):
            worst = 1.0
        return names, worst

    def box(self, name: str, side: float, area: Box) -> Box:
        """The corner of this name on the page."""
        left, right, bottom, top = corner_boxes((area.width, area.height), side, GAP)[name]
        return Box(area.x + left, area.bottom - top, right - left, top - bottom)

    def _turned(self, points: FloatArray) -> AnyArray:
        return np.column_stack([points[:, 0] - self._box.x, self._box.bottom - points[:, 1]])


def _beside(
    figure: Figure, panel: int, surface: Surface, area: Box, part: Seen | None, scale: float
) -> tuple[Box, tuple[Box, ...]]:
    """Insets in a strip at the right of the view, or under it if the shape is larger then."""
    each = figure.panels[panel]
    count = len(each.zooms)
    aspect = part.aspect if part else _aspect(figure, panel, surface)
    if figure.is_moving:  # the same for all of its pictures
        aspect = area.width / area.height / 2
    best: tuple[float, Box, list[Box]] | None = None
    for is_right in (True, False):
        long, short = (area.height, area.width) if is_right else (area.width, area.height)
        side = min(SIDE * min(area.width, area.height), (long - GAP * (count - 1)) / count, 0.45 * short)
        rest = short - side - 2 * GAP
        box = Box(area.x, area.y, rest, area.height) if is_right else Box(area.x, area.y, area.width, rest)
        size = min(box.width / aspect, box.height)
        if best is None or size > best[0]:
            step = side + GAP + max((long - count * side - GAP * (count - 1)) / (count + 1), 0) * (count > 1)
            start = (long - (count - 1) * step - side) / 2
            if is_right:
                found = [Box(area.right - side - 1, area.y + start + k * step, side, side) for k in range(count)]
            else:
                found = [Box(area.x + start + k * step, area.bottom - side - 1, side, side) for k in range(count)]
            best = size, box, found
    assert best is not None  # one of two
    _, box, found = best
    box = box.snapped(scale)
    if figure.is_moving:
        return box, tuple(each.snapped(scale) for each in found)
    framed = Framed(each.views[0], each, surface, box, part)
    targets = framed.places(surface.vertices[[z.vertex for z in each.zooms]])
    # In the order of their places, so that the lines that join them do not cross.
    axis = 1 if len(found) > 1 and found[0].x == found[1].x else 0
    order = np.argsort(np.argsort(targets[:, axis], kind="stable"), kind="stable")
    return box, tuple(found[k].snapped(scale) for k in order)


def _aspect(figure: Figure, panel: int, surface: Surface) -> float:
    from .framing import seen

    each = figure.panels[panel]
    return seen(each.views[0], each, surface).aspect
