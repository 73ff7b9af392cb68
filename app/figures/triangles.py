"""Extrema in figures: triangles, upwards at maxima and downwards at minima, as in the window."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .description import Mark

if TYPE_CHECKING:
    from matplotlib.artist import Artist

    from .canvas import Composition

POINT = 0.75
"""Points in a unit."""

OF_MARK, LEAST = 0.5, 3.0
"""From the centre to a corner: of what a mark is across, and in units."""

RIM = 0.25
"""Of that: the width of the rim."""


def triangle_of(page: Composition, mark: Mark, x: float, y: float, is_hidden: bool, order: float) -> list[Artist]:
    """The parts of the triangle of an extremum at (x, y): white with a dark rim, an outline where it is hidden."""
    from matplotlib.patches import Polygon

    style, reach = page.figure.style, max(OF_MARK * page.layout.mark, LEAST)
    way = -1 if mark.extremum == "maximum" else 1  # y goes down
    corners = [
        (x, y + way * reach),
        (x - 0.87 * reach, y - 0.6 * way * reach),
        (x + 0.87 * reach, y - 0.6 * way * reach),
    ]
    rim = max(RIM * reach, 0.6)
    looks: list[dict] = [{"facecolor": "white", "edgecolor": style.mark_edge, "linewidth": rim}]
    if is_hidden:
        # Light under dark, to be seen on every colour.
        looks = [
            {"fill": False, "edgecolor": "white", "linewidth": 1.7 * rim},
            {"fill": False, "edgecolor": style.mark_edge, "linewidth": 0.7 * rim},
        ]
    for look in looks:
        look["linewidth"] *= POINT
    return [Polygon(corners, closed=True, joinstyle="round", zorder=order, **look) for look in looks]
