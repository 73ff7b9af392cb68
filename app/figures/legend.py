"""The legend of a figure: its kinds of marks in lines under all panels, each with what it stands for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from bihdist_core.distances.answers import Answer

from ..drawing.glyphs import SWATCH, glyph_shapes
from ..drawing.shapes import Shape
from ..marks.marked_panel import label_rows
from ..marks.primitives import PointMark
from .description import Entry, Figure
from .page_layout import ComposedPage, PageLayout
from .words import TextLines

GAP, BETWEEN, HIGH = 0.5, 2.0, 1.7
"""Font sizes from a mark to its words, from one entry to the next, and from line to line."""


MOST_LABELS = 48
"""Of which the legend has names."""


def legend_of_labels(answers: Iterable[Answer]) -> tuple[tuple[Entry, ...], str]:
    """Return an entry for each label that panels show, and a sentence on labels left out, "" for none."""
    rows = list(dict.fromkeys(row for answer in answers for row in label_rows(answer, MOST_LABELS)))
    count = max((int((each.labels.counts > 0).sum()) for each in answers if each.labels is not None), default=0)
    entries = tuple((PointMark(0, SWATCH, row.colour), row.text) for row in rows)
    sentence = f"The legend names the {MOST_LABELS} labels of most vertices among {count:,}."
    return entries, sentence if count > MOST_LABELS else ""


def with_legend(figure: Figure, layout: PageLayout) -> PageLayout:
    """Return the layout with room for the figure's legend under it, in as many lines as it takes."""
    size = layout.label
    reach = _reach(figure, layout)
    wide = [2 * reach + GAP * size + layout.lettering.width(words, size) for _, words in figure.legend]
    lines: list[list[int]] = [[]]
    for k, width in enumerate(wide):
        so_far = sum(wide[q] + BETWEEN * size for q in lines[-1])
        if lines[-1] and so_far + width > layout.width - 2 * size:
            lines.append([])
        lines[-1].append(k)
    high = max(HIGH * size, 2.4 * reach)
    places = []
    y = layout.height + high / 2
    for line in lines:
        x = (layout.width - sum(wide[k] for k in line) - BETWEEN * size * (len(line) - 1)) / 2
        for k in line:
            mark, words = figure.legend[k]
            middle = x + 2 * reach + GAP * size + (wide[k] - 2 * reach - GAP * size) / 2
            places.append((mark, x + reach, y, TextLines((words,), middle, y + 0.36 * size, size)))
            x += wide[k] + BETWEEN * size
        y += high
    more = len(lines) * high + 0.4 * size
    page = (layout.page[0], layout.page[1] + round(more * layout.scale))
    return replace(layout, height=layout.height + more, page=page, legend=tuple(places))


def _reach(figure: Figure, layout: PageLayout) -> float:
    """Return half the width of the largest mark of the legend."""
    standing = [mark.glyph.reach_of(layout.mark, layout.label) for mark, _ in figure.legend if mark.glyph.rise]
    return max(0.72 * layout.mark, 3.5, *(1.6 * reach for reach in standing))


def legend_shapes(page: ComposedPage) -> list[Shape]:
    """Return the legend of a page, if it has one."""
    style, layout = page.figure.style, page.layout
    shapes: list[Shape] = []
    for mark, x, y, words in layout.legend:
        reach = mark.glyph.reach_of(layout.mark, layout.label)
        at = x, y + mark.glyph.rise * reach / 2
        shapes += glyph_shapes(mark.glyph, at, reach, style.named_for(mark.colour), mark.number)
        shapes += words.shapes(style)
    return shapes
