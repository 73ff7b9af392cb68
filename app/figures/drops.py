"""Pins in figures: drops with numerals, whose tips are the places."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .description import Figure, Mark
from .framing import Framed, shown_surface

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from .canvas import Composition
    from .layout import Layout

POINT = 0.75
"""Points in a unit."""

RISE = 2.0
"""From the tip to the middle of the head, in radii of the head."""

OF_MARK, OF_LABEL = 0.6, 0.68
"""The radius of a head: of what a mark is across, and at least of the size of labels, so that numerals are read."""

NUMERAL = (1.25, 1.1, 0.85)
"""The size of a numeral of one, two and three digits, in radii."""


EDGE = 1.3
"""Radii from the middle of a head to the outside of its rims."""


def head_radius(layout: Layout) -> float:
    """In units."""
    return max(OF_MARK * layout.mark, OF_LABEL * layout.label)


def overhang(figure: Figure, layout: Layout) -> tuple[float, float]:
    """By how much drops stand over the views of a page: at most above one, and at most beside one.

    In a movie above, wherever they are now.
    """
    above = beside = 0.0
    radius = head_radius(layout)
    for panel, top, cell in zip(figure.panels, figure.tops(), layout.cells, strict=True):
        pins = [mark for mark in panel.marks if mark.number is not None]
        if not pins:
            continue
        surface = shown_surface(panel, top)
        at = np.array([mark.on(surface.vertices) for mark in pins])
        for view, box, part in zip(panel.views, cell.views, cell.parts, strict=True):
            x, y = Framed(view, panel, surface, box, part).places(at).T
            is_there = (x >= box.x) & (x <= box.right) & (y >= box.y) & (y <= box.bottom)
            tips = np.full(1, box.y) if figure.is_moving else y[is_there]
            above = max(above, float((box.y - tips + (RISE + EDGE) * radius).max(initial=0.0)))
            sides = np.maximum(box.x - x[is_there], x[is_there] - box.right) + EDGE * radius
            beside = max(beside, float(sides.max(initial=0.0)))
    return above, beside


def drop_of(
    axes: Axes, page: Composition, mark: Mark, x: float, y: float, is_hidden: bool, order: float
) -> list[Artist]:
    """The parts of the drop of a pin with its tip at (x, y), in the axes; hollow and dashed where it is hidden."""
    from matplotlib.patches import PathPatch

    radius = head_radius(page.layout)
    path, style = _outline(x, y, radius), page.figure.style
    rim = 0.17 * radius
    if mark.is_candidate:
        looks = [
            {"facecolor": mark.colour, "edgecolor": style.mark_edge, "linewidth": 2.4 * rim},
            {"fill": False, "edgecolor": "white", "linewidth": rim, "linestyle": (0, (2.2, 1.4))},
        ]
    elif is_hidden:
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
    colour = mark.colour if is_hidden and not mark.is_candidate else "white"
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
