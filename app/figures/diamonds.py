"""Balls and diamonds of a figure: a point that is sought, and what was found for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .description import Mark

if TYPE_CHECKING:
    from matplotlib.artist import Artist

    from .canvas import Composition

POINT = 0.75
"""Points in a unit."""

OF_BALL, OF_DIAMOND, LEAST = 0.55, 0.72, 3.5
"""From the centre to the outside: of what a mark is across, and in units."""

RIM = 0.22
"""Of that: the width of the rim."""


def solid_of(page: Composition, mark: Mark, x: float, y: float, is_hidden: bool, order: float) -> list[Artist]:
    """The parts of a ball or a diamond at (x, y): filled with a light rim in a dark one, hollow where it is hidden."""
    from matplotlib.patches import Circle, Polygon

    style, colour = page.figure.style, mark.ball or mark.diamond
    reach = max((OF_BALL if mark.ball else OF_DIAMOND) * page.layout.mark, LEAST)
    rim = max(RIM * reach, 0.6)
    dark = {"edgecolor": style.mark_edge, "linewidth": 2 * rim, "fill": False}
    light = {"edgecolor": "white", "linewidth": rim, "facecolor": colour}
    if is_hidden:
        dark = {"edgecolor": "white", "linewidth": 2 * rim, "fill": False}
        light = {"edgecolor": colour, "linewidth": rim, "fill": False}
    parts: list[Artist] = []
    for look in (dark, light):
        look["linewidth"] *= POINT
        if mark.ball:
            parts.append(Circle((x, y), reach - rim, zorder=order, **look))
            continue
        inner = reach - rim
        corners = [(x, y - inner), (x + inner, y), (x, y + inner), (x - inner, y)]
        parts.append(Polygon(corners, closed=True, joinstyle="miter", zorder=order, **look))
    return parts
