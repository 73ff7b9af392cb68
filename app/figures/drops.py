"""Pins in figures: drops with numerals, whose tips are the places."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .description import Mark

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from .canvas import Composition

POINT = 0.75
"""Points in a unit."""

RISE = 2.0
"""From the tip to the middle of the head, in radii of the head."""

OF_MARK, OF_LABEL = 0.6, 0.68
"""The radius of a head: of what a mark is across, and at least of the size of labels, so that numerals are read."""

NUMERAL = (1.25, 1.1, 0.85)
"""The size of a numeral of one, two and three digits, in radii."""


def head_radius(page: Composition) -> float:
    """In units."""
    return max(OF_MARK * page.layout.mark, OF_LABEL * page.layout.label)


def drop_of(
    axes: Axes, page: Composition, mark: Mark, x: float, y: float, is_hidden: bool, order: float
) -> list[Artist]:
    """The parts of the drop of a pin with its tip at (x, y), in the axes; hollow and dashed where it is hidden."""
    from matplotlib.patches import PathPatch

    radius = head_radius(page)
    path, style = _outline(x, y, radius), page.figure.style
    rim = 0.17 * radius
    if is_hidden:
        looks = [
            {"facecolor": (1, 1, 1, 1.0 if page.is_opaque else 0.92), "edgecolor": "white", "linewidth": 2.4 * rim},
            {"fill": False, "edgecolor": mark.colour, "linewidth": rim, "linestyle": (0, (2.2, 1.4))},
        ]
    else:
        looks = [
            {"fill": False, "edgecolor": style.mark_edge, "linewidth": 3.2 * rim},
            {"facecolor": mark.colour, "edgecolor": "white", "linewidth": 1.6 * rim},
        ]
    parts: list[Artist] = []
    for look in looks:
        look["linewidth"] *= POINT
        parts.append(PathPatch(path, zorder=order, joinstyle="round", **look))
        axes.add_artist(parts[-1])
    text = str(mark.number)
    size = NUMERAL[min(len(text), 3) - 1] * radius
    look = {"ha": "center", "va": "baseline", "weight": "bold", "size": size * POINT, "zorder": order}
    colour = mark.colour if is_hidden else "white"
    parts.append(axes.text(x, y - RISE * radius + 0.36 * size, text, color=colour, **look))
    return parts


def _outline(x: float, y: float, radius: float):
    """A circle, and its tangents from the tip; y goes down."""
    from matplotlib.path import Path
    from matplotlib.transforms import Affine2D

    half = math.degrees(math.acos(1 / RISE))
    # In y up, with the tip at 0: the arc goes round from right of the tip to left of it.
    arc = Path.arc(-90 + half, 270 - half).transformed(Affine2D().translate(0, RISE))
    vertices = [(0.0, 0.0), *arc.vertices.tolist(), (0.0, 0.0)]
    codes = [Path.MOVETO, Path.LINETO, *arc.codes[1:].tolist(), Path.CLOSEPOLY]
    return Path(vertices, codes).transformed(Affine2D().scale(radius, -radius).translate(x, y))
