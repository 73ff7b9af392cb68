"""Where x, y and z point to, in a corner of each picture of a page that is not seen as one before it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.arrays import AnyArray

from ..scene.axes import ARM, LETTER, arms, middle
from .boxes import Box
from .shots import Shot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .canvas import Composition

LINE = 1.1
"""Pixels of the arms' width, where letters are LETTER high."""


def draw_axes(axes: Axes, page: Composition, order: int) -> None:
    """Of the panels that want them, in letters as large as those at the colour bar."""
    seen: list[AnyArray] = []
    for shot in page.shots:
        is_new = not any(np.allclose(shot.frame, frame, atol=1e-6) for frame in seen)
        if page.figure.panels[shot.panel].axes and shot.source is None and is_new:
            seen.append(shot.frame)
            _draw(axes, page, shot, order)


def _draw(axes: Axes, page: Composition, shot: Shot, order: int) -> None:
    from matplotlib.lines import Line2D

    colour, unit, box = page.figure.style.quiet_text, page.layout.label / LETTER, shot.box
    insets = [other.box for other in page.shots if other.source is not None and other.panel == shot.panel]
    taken = {_corner(inset, box) for inset in insets if box.x <= inset.x < box.right}
    x, y = middle(box.width / unit, box.height / unit, taken)
    x, y = box.x + unit * x, box.y + unit * y
    for arm in arms(shot.frame):
        ends = (x, x + unit * ARM * arm.x), (y, y - unit * ARM * arm.y)
        line = Line2D(*ends, color=colour, alpha=arm.opacity, linewidth=0.75 * LINE * unit, solid_capstyle="round")
        line.set_zorder(order)
        axes.add_artist(line)
        if arm.letter_at is None:
            continue
        right, up = (unit * way for way in arm.letter_at)
        axes.text(
            x + right,
            y - up,
            arm.name,
            fontsize=0.75 * page.layout.label,
            color=colour,
            alpha=arm.opacity,
            ha="center",
            va="center",
            zorder=order,
        )


def _corner(inset: Box, box: Box) -> str:
    down = "top" if inset.y + inset.height / 2 < box.y + box.height / 2 else "bottom"
    return f"{down} {'left' if inset.x + inset.width / 2 < box.x + box.width / 2 else 'right'}"
