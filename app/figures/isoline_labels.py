"""The values of isolines, standing on those of a figure."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from bihdist_core.arrays import BoolArray, FloatArray
from bihdist_core.sentences import with_and

from ..drawing.shapes import Pen, Shape, Text
from ..scene.line_labels import CLEAR, Contour, Label, labelled as labelled_lines
from .description import Figure
from .page_layout import PageLayout
from .shots import Shot

TIGHT = 0.5
"""Least distance of other lines from the words' middle line, in letter sizes; letters reach up to 0.37."""

LABEL_SIZE = 0.85
"""Font size of labels, as a fraction of that of colour bars."""

SMALLER = ((1.0, CLEAR), (0.87, CLEAR), (0.75, CLEAR), (0.75, TIGHT))
"""Fractions of the usual size, and distances kept from other lines, that are tried until ENOUGH values have room."""
ENOUGH = 3


def labelled(
    shot: Shot,
    size: float,
    width: Callable[[str], float],
    marks: float,
    written: Sequence[tuple[float, float]] = (),
    clear: float = CLEAR,
) -> tuple[list[Contour], list[Label]]:
    """Return the shot's isolines with gaps, and the labels in them.

    Parameters
    ----------
    size
        Size of the letters.
    width
        Returns the width of a text.
    marks
        Distance that labels keep from the middle of a mark.
    written, clear
        See `scene.line_labels.labelled`.
    """
    marked = np.array([[x, y] for _, x, y in shot.marks]).reshape(-1, 2)

    def is_covered(places: FloatArray) -> BoolArray:
        return shot.cover_at(places) > 250

    return labelled_lines(shot.isolines, shot.box, size, width, is_covered, marked, marks, written, clear)


def placed_labels(figure: Figure, layout: PageLayout, shot: Shot) -> tuple[float, list[Contour], list[Label]]:
    """Return the size of a shot's labels, the isolines with gaps for them, and the labels, smaller if few have room."""
    best = LABEL_SIZE * layout.label, shot.isolines, list[Label]()
    for share, clear in SMALLER:
        size = share * LABEL_SIZE * layout.label
        # The number of an inset.
        insets = figure.panels[shot.panel].insets
        corner = [(shot.box.x + 0.6 * size, shot.box.y + 0.8 * size)] if shot.source and len(insets) > 1 else []
        width = partial(layout.lettering.width, size=size)
        contours, labels = labelled(shot, size, width, layout.mark / 2 + 3, corner, clear)
        if len(labels) > len(best[2]):
            best = size, contours, labels
        if len(labels) >= min(ENOUGH, len({line.value for line in shot.isolines})):
            break
    return best


def unlabelled_words(figure: Figure, layout: PageLayout, shots: Sequence[Shot]) -> list[str]:
    """Return a sentence if the values of isolines are wanted in panels where they have no room."""
    wanted = {shot.panel for shot in shots if figure.panels[shot.panel].isolines.labels and shot.isolines}
    there = {shot.panel for shot in shots if shot.panel in wanted and placed_labels(figure, layout, shot)[2]}
    missing = [f"{panel + 1}" for panel in sorted(wanted - there)]
    if not missing:
        return []
    where = f"{'panel' if len(missing) == 1 else 'panels'} {with_and(missing)}"
    return [f"The isolines of {where} are too close for their values; choose fewer isolines or a larger size."]


def label_shapes(figure: Figure, layout: PageLayout, shot: Shot) -> tuple[list[Contour], list[Shape]]:
    """Return a shot's isolines with gaps, and the values that stand in these in the lines' own colours."""
    size, contours, labels = placed_labels(figure, layout, shot)
    shapes: list[Shape] = []
    for label in labels:
        line = contours[label.contour]
        ink = figure.isoline_ink(shot.panel, line.value, line.is_through)
        shapes.append(
            Text(
                label.text,
                label.x,
                label.y,
                size,
                ink.colour,
                is_bold=True,
                align="centre",
                level="capitals",
                angle=label.angle,
                halo=ink.rim and Pen(ink.rim, 2 * ink.rim_width * layout.stroke),
                name="isoline-label",
            )
        )
    return contours, shapes
