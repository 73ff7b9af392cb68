"""Words, colour bars and axes beside the pictures of a page, as shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bihdist_core.arrays import AnyArray

from ..drawing.axes import LETTER, axes_shapes, middle
from ..drawing.painters.mpl import POINT
from ..drawing.scale_bar import corner_of_bar, scale_bar_shapes
from ..drawing.shapes import Box, Path, Shape, moved, opaque, rectangle
from .bars import line_spacing, shapes_of_bar
from .chart_look import Chart, ChartLook
from .page_layout import ComposedPage, PanelLayout
from .shots import Shot
from .size import UNITS_PER_INCH
from .words import LINE, TextLines

HIGHEST, LEAST_HEIGHT = 0.85, 17.0
"""Height of a chart for each unit that it is wide, at most, if that is enough of the sizes of labels."""

BAR_WIDTH = 1.3
"""The same of the scale bar's line."""

UNDER = 0.7
"""Opacity of the ground under it."""

ARM_WIDTH = 1.1
"""Pixels of the width of the axes' arms, where letters are LETTER high."""


def caption_shapes(page: ComposedPage) -> list[Shape]:
    """Return the words and the colour bars of a page."""
    layout, figure = page.layout, page.figure
    shapes: list[Shape] = []
    for panel, cell in zip(figure.panels, layout.cells, strict=True):
        for words in cell.words:
            shapes += words.shapes(figure.style)
        if panel.failure:
            shapes += _failure_shapes(page, panel.failure, cell)
    for heads in layout.heads:
        shapes += heads.shapes(figure.style)
    for charts, box in zip(figure.charts, layout.charts, strict=True):
        shapes += _chart_shapes(page, charts, box)
    # Bars with isolines next to one without would look like another kind of scale.
    room = min((line_spacing(figure, bar) for bar in layout.bars), default=0.0)
    for bar in layout.bars:
        shapes += shapes_of_bar(figure, bar, layout.stroke, room)
    return shapes


def _chart_shapes(page: ComposedPage, charts: Sequence[Chart], box: Box) -> list[Shape]:
    """Return charts one below the other in the middle of a box."""
    look = ChartLook(page.figure.style, page.figure.font, box.width / UNITS_PER_INCH, page.layout.label * POINT)
    high = min(box.height / max(len(charts), 1), max(HIGHEST * box.width, LEAST_HEIGHT * page.layout.label))
    top = box.middle[1] - len(charts) * high / 2
    return [
        shape
        for k, chart in enumerate(charts)
        for shape in moved(replace(chart, look=look).shapes(high), box.x, top + k * high)
    ]


def _failure_shapes(page: ComposedPage, failure: str, cell: PanelLayout) -> list[Shape]:
    """Return the reason for which there is no field, in lines on the shape."""
    style, lettering = page.figure.style, page.layout.lettering
    area = Box(cell.views[0].x, cell.views[0].y, cell.views[-1].right - cell.views[0].x, cell.views[0].height)
    most = max(int(0.9 * area.height / (LINE * page.layout.label) - 1), 1)
    size, (lines,) = lettering.fitted([failure], page.layout.label, 0.9 * area.width, most)
    if not lines:
        return []
    wide = max(lettering.width(line, size) for line in lines) + size
    high = (len(lines) - 1) * LINE * size + 1.9 * size
    x, y = area.middle
    ground = Path(rectangle(Box(x - wide / 2, y - high / 2, wide, high)), opaque(style.background, 0.88))
    return [ground, *TextLines(lines, x, y - high / 2 + 1.3 * size, size).shapes(style)]


def cross_shapes(page: ComposedPage) -> list[Shape]:
    """Return the axes x, y and z in a corner of each picture that is not seen as one before it."""
    seen: list[AnyArray] = []
    shapes: list[Shape] = []
    for shot in page.shots:
        is_new = not any(np.allclose(shot.frame, frame, atol=1e-6) for frame in seen)
        if page.figure.panels[shot.panel].axes and shot.source is None and is_new:
            seen.append(shot.frame)
            shapes += _cross(page, shot)
    return shapes


def scale_shapes(page: ComposedPage) -> list[Shape]:
    """Return a scale bar for each panel that has one, and for further views of it at another scale."""
    shown: dict[int, list[float]] = {}
    shapes: list[Shape] = []
    style, letter = page.figure.style, page.layout.label
    for shot in page.shots:
        panel, known = page.figure.panels[shot.panel], shown.setdefault(shot.panel, [])
        if panel.scale_unit and shot.source is None and not np.isclose(shot.per_unit, known, rtol=0.01).any():
            known.append(shot.per_unit)
            words = "" if panel.is_parallel else "≈ ", panel.scale_unit
            ink, ground = opaque(style.text), opaque(style.background, UNDER)
            width = BAR_WIDTH * letter / LETTER
            shapes += scale_bar_shapes(shot.box, shot.per_unit, words, _taken(page, shot), letter, width, ink, ground)
    return shapes


def _taken(page: ComposedPage, shot: Shot) -> set[str]:
    """Return the corners of a picture that insets take."""
    box = shot.box
    insets = [inset.box for inset in page.insets_of(shot.panel)]
    return {_corner(inset, box) for inset in insets if box.x <= inset.x < box.right}


def _cross(page: ComposedPage, shot: Shot) -> list[Shape]:
    unit, box, taken = page.layout.label / LETTER, shot.box, _taken(page, shot)
    if page.figure.panels[shot.panel].scale_unit:
        taken.add(corner_of_bar(taken))
    x, y = middle(box.width / unit, box.height / unit, taken)
    at = box.x + unit * x, box.y + unit * y
    return axes_shapes(shot.frame, at, page.layout.label, ARM_WIDTH * unit, page.figure.style.quiet_text)


def _corner(inset: Box, box: Box) -> str:
    (x, y), (across, down) = inset.middle, box.middle
    return f"{'top' if y < down else 'bottom'} {'left' if x < across else 'right'}"
