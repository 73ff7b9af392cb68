"""Crosses of a figure: where a point belongs."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from .canvas import Composition

SIDE = 0.9
"""How far it is across, in that of other marks."""

LEAST = 6.0
"""Units."""

POINT = 0.75
"""Points in a unit."""


def cross_of(axes: Axes, page: Composition, x: float, y: float, is_hidden: bool, order: int) -> list[Line2D]:
    """The lines of a cross about (x, y), in the axes, light on dark; dashed where it is hidden."""
    from matplotlib.lines import Line2D

    arm = max(SIDE * page.layout.mark, LEAST) / 2
    width, style, parts = 0.34 * arm, page.figure.style, []
    for colour, times in ((style.mark_edge, 2.2), ("white", 1.0)):
        look = {"color": colour, "linewidth": times * width * POINT, "zorder": order}
        look |= {"dash_capstyle": "butt", "linestyle": (0, (3.0 / times, 1.6 / times))} if is_hidden else {}
        look |= {"solid_capstyle": "round"}
        for way in (-1, 1):
            parts.append(Line2D([x - arm, x + arm], [y - arm * way, y + arm * way], **look))
            axes.add_artist(parts[-1])
    return parts
