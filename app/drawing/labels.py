"""Places of labels: beside what they name, inside the view, off each other."""

from collections.abc import Sequence

from .shapes import Box, Point

AWAY, DOT = 9.0, 6.0
"""Logical pixels from a place to its label, and to the rim of its mark."""


def label_boxes(
    places: Sequence[Point], sizes: Sequence[Point], ranks: Sequence[int], view: Box, scale: float = 1.0
) -> list[Box | None]:
    """Place labels (width, height) in a view, off each other and off all places; None where there is no room.

    Those of the lowest rank are placed first, and of rank 0 stand somewhere whatever they cover.
    """
    found: list[Box | None] = [None] * len(places)
    dots = [Box(*at, 0.0, 0.0).grown(DOT * scale) for at in places]
    for k in sorted(range(len(places)), key=lambda k: ranks[k]):
        taken = [box for box in found if box is not None] + dots[:k] + dots[k + 1 :]
        boxes = [box for box in _beside(places[k], sizes[k], scale) if view.contains(box)]
        found[k] = next((box for box in boxes if not any(box.meets(other) for other in taken)), None)
        if found[k] is None and not ranks[k]:
            found[k] = next(iter(boxes), None)
    return found


def _beside(at: Point, size: Point, scale: float) -> list[Box]:
    """Return boxes at the right, the left, above, below, and at the corners of a place."""
    (x, y), (wide, high), away = at, size, AWAY * scale
    near = 0.7 * away
    lefts = (away, -away - wide, -wide / 2, -wide / 2, near, -near - wide, near, -near - wide)
    tops = (-high / 2, -high / 2, -away - high, away, -near - high, -near - high, near, near)
    return [Box(x + left, y + top, wide, high) for left, top in zip(lefts, tops, strict=True)]
