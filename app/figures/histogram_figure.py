"""The figure of a histogram: how much of a surface's area has which values of a field, in the colours of its bar."""

import os
from dataclasses import dataclass, replace

import numpy as np

from bihdist_core import Surface, field_statistics
from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import Answer

from ..drawing.chart import Axis
from ..drawing.numbers import MINUS
from ..drawing.shapes import Box, Path, Pen, Shape, Text, opaque, rectangle
from ..scene.style import style_of
from .arrangement import ChartRow
from .chart_look import RIM, USUAL_LOOK, ChartLook
from .chart_page import save_chart
from .size import UNITS_PER_INCH

HIGH, SLANT = 2.0, 0.62
"""Inches that it is high at most, and by its width."""

HEAD = 0.05
"""Room above the highest bar, as a fraction of it."""


@dataclass(frozen=True, eq=False)
class HistogramFigure:
    """A histogram by area.

    Attributes
    ----------
    ends
        (b + 1,) ends of the bins.
    shares
        (b,) fractions of the area, together 1.
    colours
        (b, 3) colours of the bins, 0 to 1.
    name, unit
        The field's name and unit.
    mean
        The field's mean by area.
    """

    ends: FloatArray
    shares: FloatArray
    colours: FloatArray
    name: str
    unit: str = ""
    mean: float | None = None
    look: ChartLook = USUAL_LOOK

    def shapes(self, height: float) -> list[Shape]:
        """Return the chart at a height in units."""
        return _shapes(self, height)


BINS = 40
"""Of a histogram."""


def histogram_figure(
    surface: Surface, field: FloatArray, answer: Answer, top: float, look: ChartLook
) -> HistogramFigure:
    """Return the histogram of an answer's field (n,), in colours that end at `top`."""
    found = field_statistics(surface, field, BINS)
    colours = look.style.bin_colours(found.bins, top, answer.is_signed)
    shares = found.areas / found.areas.sum()
    return HistogramFigure(found.bins, shares, colours, answer.label, answer.unit, found.mean, look)


def charts(row: ChartRow) -> list[HistogramFigure]:
    """Return a histogram for each panel of a row with a field."""
    look = ChartLook.of(row.page, style_of(row.page.style, row.document.colours))
    shown = [(panel, row.answers[panel.id]) for panel in row.document.panels if panel.id in row.answers]
    return [
        replace(
            histogram_figure(row.surfaces[panel.surface].surface, answer.field, answer, row.tops[panel.id], look),
            name=row.label(panel),
        )
        for panel, answer in shown
        if answer.field is not None
    ]


def save_histogram_figure(figure: HistogramFigure, path: str | os.PathLike[str]) -> None:
    """Write the figure of a histogram, see `save_chart`."""
    height = min(SLANT * figure.look.inches, HIGH) * UNITS_PER_INCH
    save_chart(path, figure, height)


def _shapes(figure: HistogramFigure, height: float) -> list[Shape]:
    look, ends = figure.look, figure.ends
    top = RIM + (1.4 * look.size if figure.mean is not None else 0.5 * look.size)
    across = Axis(float(ends[0]), float(ends[-1]))
    up = Axis(0.0, 100 * (1 + HEAD) * float(figure.shares.max(initial=0.0)) or 1.0)
    name = f"{figure.name} ({figure.unit})" if figure.unit else figure.name
    room = Box(0, top, look.width - look.right(across), height - top)
    plot, shapes = look.plot(room, across, up, (name, "% of the area"))
    pen = Pen(opaque(look.style.quiet_text), 0.53)
    bottom = plot.box.bottom
    for left, right, share, colour in zip(ends[:-1], ends[1:], figure.shares, figure.colours, strict=True):
        x, high = float(plot.x(left)), bottom - float(plot.y(100 * share))
        bar = Box(x, bottom - high, float(plot.x(right)) - x, high)
        shapes.append(Path(rectangle(bar), opaque(colour), pen))
    if figure.mean is not None:
        shapes.append(plot.upright(figure.mean, Pen(look.ink.text, 1.2, (3.7, 1.6)), "mean"))
        words = f"mean {figure.mean:.4g}".replace("-", MINUS)
        half = look.text_width(words, look.size) / 2
        x = float(np.clip(plot.x(figure.mean), RIM + half, look.width - RIM - half))
        shapes.append(Text(words, x, plot.box.y - 0.35 * look.size, look.size, look.ink.text, align="centre"))
    return shapes
