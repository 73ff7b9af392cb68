"""The figure of a scatter: one field against another over all vertices, with selections and what agrees."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from bihdist_core.analysis.field_scatter import FieldScatter
from bihdist_core.arrays import AnyArray, ByteArray

from ..drawing.chart import Axis
from ..drawing.numbers import MINUS
from ..drawing.shapes import Box, Image, Path, Pen, Shape, Text, hexadecimal, opaque, polyline, rectangle
from ..scene.density import axis_ends, cell_size, density_picture
from .chart_look import RIM, ChartLook
from .chart_page import save_chart
from .size import UNITS_PER_INCH

INCHES = 3.35
"""As wide as a column of most journals."""

COLUMN_LOOK = ChartLook(inches=INCHES)

PLOT = 0.76
"""The plot's part of the width, about: what is left is for words."""

STEP = 1.5
"""Font sizes from one selection's name to the next."""

CELLS_PER_INCH = 150
"""Twice or three times as wide where there are few points, as in the window."""


@dataclass(frozen=True)
class ScatterAxis:
    """An axis of a scatter: the field's name and unit, and the ends of the axis."""

    name: str
    unit: str
    low: float
    high: float

    @property
    def words(self) -> str:
        """The name, with the unit if there is one."""
        return f"{self.name} ({self.unit})" if self.unit else self.name


@dataclass(frozen=True, eq=False)
class ScatterFigure:
    """Two fields against each other.

    Attributes
    ----------
    in_shares
        Whether the values are fractions of 1, written in percent.
    is_common
        Whether both axes have one unit, so that there is a diagonal.
    selections
        A name, vertices (k,), and a colour as #rrggbb each.
    correlation
        Rank correlation of the two.
    largest
        The vertex where the fields are farthest apart.
    """

    scatter: FieldScatter
    across: ScatterAxis
    up: ScatterAxis
    in_shares: bool = True
    is_common: bool = True
    selections: tuple[tuple[str, AnyArray, str], ...] = ()
    correlation: float | None = None
    largest: int | None = None
    look: ChartLook = COLUMN_LOOK

    @property
    def legend_height(self) -> float:
        """The height of the names of selections, in units."""
        return STEP * self.look.size * len(self.selections)

    def shapes(self, height: float) -> list[Shape]:
        """Return the chart at a height in units."""
        return _shapes(self, height - self.legend_height)


def axes_of(
    scatter: FieldScatter, names: tuple[str, str], units: tuple[str, str], in_shares: bool
) -> tuple[ScatterAxis, ScatterAxis]:
    """Return both axes, named by fields with such units."""
    ends = axis_ends(scatter, in_shares or units[0] == units[1])
    words = ("% of the maximum", "% of the maximum") if in_shares else units
    across, up = (ScatterAxis(name, unit, *end) for name, unit, end in zip(names, words, ends, strict=True))
    return across, up


def save_scatter_figure(figure: ScatterFigure, path: str | os.PathLike[str]) -> None:
    """Write the figure of a scatter, see `save_chart`; its points are pixels, the rest vectors and text."""
    save_chart(path, figure, (PLOT * figure.look.inches + 0.55) * UNITS_PER_INCH + figure.legend_height)


def _shapes(figure: ScatterFigure, height: float) -> list[Shape]:
    look, scale = figure.look, 100 if figure.in_shares else 1
    across, up = (Axis(scale * axis.low, scale * axis.high) for axis in (figure.across, figure.up))
    top = RIM + (1.4 if figure.correlation is not None else 0.4) * look.size
    room = Box(0, top, look.width - look.right(across), height - top)
    plot, axes = look.plot(room, across, up, (figure.across.words, figure.up.words), is_square=figure.is_common)
    ink = look.ink
    without_grid = [shape for shape in axes if not (isinstance(shape, Path) and shape.pen == ink.grid)]
    shapes: list[Shape] = [Image(_picture(figure), plot.box), *without_grid]
    if figure.is_common:
        ends = max(across.low, up.low), min(across.high, up.high)
        places = [(float(plot.x(value)), float(plot.y(value))) for value in ends]
        shapes.append(Path(polyline(places), pen=Pen(ink.quiet, 1.07, (3.7, 1.6)), name="diagonal"))
    if figure.correlation is not None:
        words = f"rank correlation {figure.correlation:.4f}".replace("-", MINUS)
        y = plot.box.y - 0.35 * look.size
        shapes.append(Text(words, plot.box.right, y, look.size, ink.quiet, align="right"))
    for place in np.flatnonzero(figure.scatter.ids == figure.largest):
        x, y = float(plot.x(scale * figure.scatter.x[place])), float(plot.y(scale * figure.scatter.y[place]))
        for colour, width, arm in ((opaque(look.style.background), 3.2, 5.1), (ink.text, 1.5, 4.0)):
            cross = (*polyline([(x - arm, y), (x + arm, y)]), *polyline([(x, y - arm), (x, y + arm)]))
            shapes.append(Path(cross, pen=Pen(colour, width), name="largest"))
    return [*shapes, *_selections(figure, height)]


def _picture(figure: ScatterFigure) -> ByteArray:
    """Return the points as opaque pixels (h, w, 4): EPS has no others."""
    style = figure.look.style
    cells = round(PLOT * figure.look.inches * CELLS_PER_INCH / cell_size(len(figure.scatter.ids)))
    grid = cells, cells, (figure.across.low, figure.across.high), (figure.up.low, figure.up.high)
    chosen = [(vertices, _rgb(hexadecimal(colour))) for _, vertices, colour in figure.selections]
    picture = density_picture(figure.scatter, grid, _rgb(style.text), chosen)
    opacity = picture[..., 3:] / 255
    colours = np.round(opacity * picture[..., :3] + (1 - opacity) * _rgb(style.background))
    return np.concatenate([colours, np.full_like(opacity, 255)], 2).astype(np.uint8)


def _selections(figure: ScatterFigure, top: float) -> list[Shape]:
    """Return the names of selections, each with its colour, in the middle under the plot."""
    look, size = figure.look, figure.look.size
    texts = [f"{name} ({len(vertices):,})" for name, vertices, _ in figure.selections]
    wide = max((look.text_width(text, size) for text in texts), default=0.0)
    left = (look.width - wide) / 2
    shapes: list[Shape] = []
    for k, (text, (_, _, colour)) in enumerate(zip(texts, figure.selections, strict=True)):
        y = top + (k + 0.75) * STEP * size
        sample = Box(left - 0.8 * size, y - 0.8 * size, 0.9 * size, 0.9 * size)
        shapes.append(Path(rectangle(sample), hexadecimal(colour)))
        shapes.append(Text(text, left + 0.6 * size, y, size, look.ink.text))
    return shapes


def _rgb(colour: Sequence[float]) -> tuple[int, int, int]:
    red, green, blue = (round(255 * part) for part in colour[:3])
    return red, green, blue
