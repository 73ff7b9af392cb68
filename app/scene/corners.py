"""Places of insets in a view, and the lines that join them to what they enlarge, for window and figures alike.

Boxes are left, right, bottom, top, in pixels of the view, y up.
"""

from collections.abc import Callable, Sequence

import numpy as np

from bihdist_core.arrays import AnyArray, BoolArray, FloatArray

from ..document.document import Inset

SIDE = 0.40
"""Of an inset, as a share of the shorter side of its view."""

CELLS = 8
"""By how many along each side the cover of a corner is found out."""

FINE_CELLS = 32
"""The same for the lines that join insets to their places."""

NEAR = 0.01
"""By what share more of its cover a corner is the worse for being a whole view away."""

CROSSED = 0.02
"""The share of a joining line that may lie on the surface."""

Rectangle = tuple[float, float, float, float]


def corner_boxes(size: tuple[float, float], side: float, gap: float) -> dict[str, Rectangle]:
    """Return the box of an inset in each corner of a view, by name."""
    width, height = size
    right, top = (width - gap - side, width - gap), (height - gap - side, height - gap)
    left, bottom = (gap, gap + side), (gap, gap + side)
    return {
        "top right": (*right, *top),
        "top left": (*left, *top),
        "bottom right": (*right, *bottom),
        "bottom left": (*left, *bottom),
    }


def source_box(place: FloatArray, side: float, inset: Inset) -> Rectangle:
    """Return the box around a place (2,) that an inset enlarges."""
    half = side / inset.factor / 2
    x, y = map(float, place)
    return x - half, x + half, y - half, y + half


def chosen_corners(
    insets: Sequence[Inset],
    boxes: dict[str, Rectangle],
    sources: Sequence[Rectangle],
    surface: FloatArray,
    marks: FloatArray,
) -> list[str]:
    """Return a corner for each inset: its own, or the one that hides the least.

    Parameters
    ----------
    boxes
        Boxes of the corners by name.
    sources
        What the insets enlarge.
    surface
        (k, 2) places all over the surface.
    marks
        (k, 2) places that must be seen, as what is enlarged must.
    """
    taken, found = list(sources), []
    wide = max(max(box) for box in boxes.values())
    for inset, source in zip(insets, sources, strict=True):
        if inset.corner == "auto":
            hidden = {
                name: cover(box, surface)
                + _meetings(box, taken)
                + 2 * inside(marks, box).sum()
                # Of corners that hide alike, the nearest.
                + NEAR * np.nan_to_num(np.abs(np.subtract(box, source)).max()) / wide
                for name, box in boxes.items()
            }
            found.append(min(boxes, key=lambda name: hidden[name]))
        else:
            found.append(inset.corner)
        taken.append(boxes[found[-1]])
    return found


def cover(box: Rectangle, places: FloatArray) -> float:
    """Return the fraction of a box where the surface is seen; `places` (k, 2) are all over it, NaN for unseen ones."""
    left, right, bottom, top = box
    cells = np.floor((places - (left, bottom)) / (right - left, top - bottom) * CELLS)
    within = cells[((cells >= 0) & (cells < CELLS)).all(axis=1)]
    return len(np.unique(within, axis=0)) / CELLS**2


def joins(source: Rectangle, box: Rectangle, is_taken: Callable[[FloatArray], BoolArray]) -> list[AnyArray]:
    """Return lines (2, 2) between equal corners of an inset and of what it enlarges that run through neither.

    Lines that cross much of what is taken are left out; `is_taken` tells which of places (k, 2) lie on the surface or
    on
    another inset.
    """
    found = []
    for x in (0, 1):
        for y in (2, 3):
            a, b = (np.array([each[x], each[y]]) for each in (source, box))
            way = a + np.linspace(0.01, 0.99, 100)[:, None] * (b - a)
            if not any(inside(way, each).any() for each in (source, box)) and is_taken(way).mean() <= CROSSED:
                found.append(np.stack([a, b]))
    return found


def taken_by(
    places: FloatArray, size: tuple[float, float], boxes: Sequence[Rectangle]
) -> Callable[[FloatArray], BoolArray]:
    """Return a function that tells which of points (k, 2) lie near places (m, 2) of a view, or in one of the boxes."""
    cell = max(min(size), 1) / FINE_CELLS
    known = places[np.isfinite(places).all(axis=1)]
    taken = {tuple(each) for each in np.unique(np.floor(known / cell).astype(int), axis=0).tolist()}

    def is_taken(points: FloatArray) -> BoolArray:
        is_taken = np.array([tuple(each) in taken for each in np.floor(points / cell).astype(int).tolist()], bool)
        for box in boxes:
            is_taken |= inside(points, box)
        return is_taken

    return is_taken


def inside(points: FloatArray, box: Rectangle) -> BoolArray:
    """Return which of points (k, 2) lie in a box."""
    x, y = points.T
    is_inside: BoolArray = (box[0] < x) & (x < box[1]) & (box[2] < y) & (y < box[3])
    return is_inside


def _meetings(box: Rectangle, others: Sequence[Rectangle]) -> int:
    """Return the number of other boxes that a box meets."""
    return sum(box[0] < b[1] and b[0] < box[1] and box[2] < b[3] and b[2] < box[3] for b in others)
