"""The figure of a histogram: how much of a surface's area has which values of a field, in the colours of its bar."""

import os
from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray

from ..drawing.chart import Axis
from ..drawing.numbers import MINUS
from ..drawing.shapes import Box, Path, Pen, Shape, Text, opaque, rectangle
from .chart_page import RIM, USUAL_LOOK, ChartLook, save_chart
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


def save_histogram_figure(figure: HistogramFigure, path: str | os.PathLike[str]) -> None:
    """Write the figure of a histogram, see `save_chart`."""
    height = min(SLANT * figure.look.inches, HIGH) * UNITS_PER_INCH
    save_chart(path, figure.look, height, _shapes(figure, height))


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
