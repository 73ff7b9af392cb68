"""The values of isolines, standing on those of a figure."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.arrays import BoolArray, FloatArray

from ..scene.field_actor import CASING
from ..scene.line_labels import Contour, Label, labelled as labelled_lines
from ..scene.style import RIM
from .description import Figure
from .glyphs import POINT
from .layout import Layout
from .shots import Shot

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LABEL_SIZE = 0.85
"""Of the letters of colour bars."""


def labelled(
    shot: Shot, size: float, width: Callable[[str], float], marks: float, written: Sequence[tuple[float, float]] = ()
) -> tuple[list[Contour], list[Label]]:
    """The shot's isolines with gaps, and what stands in them, see `scene.line_labels`.

    size: of the letters; width: of a text in them; marks: how far words keep from the middle of a mark; written:
    middles of single signs that stand in the picture.
    """
    marked = np.array([[x, y] for _, x, y in shot.marks]).reshape(-1, 2)
    box = (shot.box.x, shot.box.y, shot.box.width, shot.box.height)
    return labelled_lines(shot.isolines, box, size, width, partial(_is_covered, shot), marked, marks, written)


def _is_covered(shot: Shot, places: FloatArray) -> BoolArray:
    """Which of places (k, 2) are wholly on the shape."""
    height, width = shot.image.shape[:2]
    x = ((places[:, 0] - shot.box.x) / shot.box.width * width).astype(int)
    y = ((places[:, 1] - shot.box.y) / shot.box.height * height).astype(int)
    is_inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    is_covered: BoolArray = is_inside & (shot.image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1), 3] > 250)
    return is_covered


def draw_labels(axes: Axes, figure: Figure, layout: Layout, shot: Shot, order: int) -> list[Contour]:
    """Values on a shot's isolines, in the lines' own colours; the isolines with gaps for them."""
    from matplotlib.patheffects import withStroke

    style, panel, top = figure.style, figure.panels[shot.panel], figure.tops()[shot.panel]
    size = LABEL_SIZE * layout.label
    # The number of an inset.
    corner = [(shot.box.x + 0.6 * size, shot.box.y + 0.8 * size)] if shot.source and len(panel.zooms) > 1 else []
    width = partial(layout.lettering.width, size=size)
    contours, labels = labelled(shot, size, width, layout.mark / 2 + 3, corner)
    for label in labels:
        line = contours[label.contour]
        text = axes.text(
            label.x,
            label.y,
            label.text,
            ha="center",
            va="center_baseline",
            rotation=label.angle,
            rotation_mode="anchor",
            size=size * POINT,
            color=style.source if line.is_through else style.line(panel.signed, line.value / top if top > 0 else 0.0),
            weight="bold",
            zorder=order,
            gid="isoline-label",
        )
        if line.is_through:
            rim = 2 * CASING * layout.stroke * POINT
            text.set_path_effects([withStroke(linewidth=rim, foreground=style.mark_edge)])
        elif (faint := style.rim(panel.signed, line.value)) is not None:
            text.set_path_effects([withStroke(linewidth=2 * RIM * layout.stroke * POINT, foreground=faint)])
    return contours
