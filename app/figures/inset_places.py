"""Places of a panel's insets: in corners of its view, or beside the shape where they would hide much of it."""

from __future__ import annotations

import numpy as np

from bihdist_core import ParameterError, Surface
from bihdist_core.arrays import AnyArray, FloatArray

from ..drawing.shapes import Box
from ..scene.corners import SIDE, chosen_corners, corner_boxes, cover, source_box
from .description import Figure
from .framing import Framed, Seen, places, seen

GAP = 4.0

HIDDEN = 0.02
"""The share of an inset that may lie on the shape, before it gets room of its own."""


def insets_of(
    figure: Figure, panel: int, surface: Surface, area: Box, part: Seen | None, scale: float
) -> tuple[Box, tuple[Box, ...]]:
    """Return the box left to the first view of a panel with insets, of all its area, and the boxes of the insets."""
    each = figure.panels[panel]
    side = SIDE * min(area.width, area.height)
    is_free = all(zoom.corner == "auto" for zoom in each.insets)
    if figure.is_moving and is_free:
        return _beside(figure, panel, surface, area, part, scale)
    framed = Framed(each.views[0], each, surface, area, part)

    def upright(points: FloatArray) -> AnyArray:
        """Return points as corners are chosen in: from the lower left corner of the area, y up."""
        return np.column_stack([points[:, 0] - area.x, area.bottom - points[:, 1]])

    shape = upright(framed.places(places(surface)))
    marks, targets = (
        upright(framed.places(surface.vertices[[mark.vertex for mark in marked]]))
        for marked in (each.marks, each.insets)
    )
    corners = corner_boxes((area.width, area.height), side, GAP)
    sources = [source_box(target, side, inset) for target, inset in zip(targets, each.insets, strict=True)]
    names = chosen_corners(each.insets, corners, sources, shape, marks)
    is_hiding = len(set(names)) < len(names) or max(cover(corners[name], shape) for name in names) > HIDDEN
    if is_hiding and is_free:
        return _beside(figure, panel, surface, area, part, scale)
    found = [corners[name] for name in names]
    boxes = [Box(area.x + left, area.bottom - top, right - left, top - bottom) for left, right, bottom, top in found]
    return area, tuple(box.snapped(scale) for box in boxes)


def source_of(framed: Framed, surface: Surface, vertex: int, side: float, factor: float, view: Box) -> Box:
    """Return the box that an inset of this side shows; raise ParameterError if its vertex is not in the view."""
    x, y = framed.places(surface.vertices[[vertex]])[0]
    if not view.holds(x, y):
        raise ParameterError(f"Vertex {vertex} is outside the picture, so it cannot be enlarged.")
    shown = side / factor
    # At the edge of a view the vertex is not in the middle, and no frame stands on a colour bar.
    left = min(max(x - shown / 2, view.x), max(view.right - shown, view.x))
    top = min(max(y - shown / 2, view.y), max(view.bottom - shown, view.y))
    return Box(left, top, shown, shown)


def _beside(
    figure: Figure, panel: int, surface: Surface, area: Box, part: Seen | None, scale: float
) -> tuple[Box, tuple[Box, ...]]:
    """Place insets in a strip at the right of the view, or under it if the shape is larger then."""
    each = figure.panels[panel]
    count = len(each.insets)
    aspect = (part or seen(each.views[0], each, surface)).aspect
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
    targets = framed.places(surface.vertices[[z.vertex for z in each.insets]])
    # In the order of their places, so that the lines that join them do not cross.
    axis = 1 if len(found) > 1 and found[0].x == found[1].x else 0
    order = np.argsort(np.argsort(targets[:, axis], kind="stable"), kind="stable")
    return box, tuple(found[k].snapped(scale) for k in order)
