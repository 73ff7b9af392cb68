"""The figure of a scatter: one field against another over all vertices, with selections and what agrees."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.analysis.field_scatter import FieldScatter
from bihdist_core.arrays import AnyArray
from bihdist_core.progress import Progress

from ..scene.density import axis_ends, cell_size, density_picture
from .chart_page import ChartLook, save_chart, style_axes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INCHES = 3.35
"""As wide as a column of most journals."""

COLUMN_LOOK = ChartLook(inches=INCHES)

PLOT = 0.76
"""The plot's part of the width, about: what is left is for words."""

CELLS_PER_INCH = 150
"""Twice or three times as wide where there are few points, as in the window."""


@dataclass(frozen=True)
class ScatterAxis:
    """name: of the field; unit: of its values; low, high: where the axis ends."""

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
    """in_shares: the values are shares of 1, written in percent.  is_common: both axes have one unit, so that there is
    a diagonal.  selections: a name, vertices (k,), and a colour as #rrggbb each.  correlation: of ranks.  largest: the
    vertex where the fields are farthest apart."""

    scatter: FieldScatter
    across: ScatterAxis
    up: ScatterAxis
    in_shares: bool = True
    is_common: bool = True
    selections: tuple[tuple[str, AnyArray, str], ...] = ()
    correlation: float | None = None
    largest: int | None = None
    look: ChartLook = COLUMN_LOOK


def axes_of(
    scatter: FieldScatter, names: tuple[str, str], units: tuple[str, str], in_shares: bool
) -> tuple[ScatterAxis, ScatterAxis]:
    """Both axes, named by fields with such units."""
    ends = axis_ends(scatter, in_shares or units[0] == units[1])
    words = ("% of the maximum", "% of the maximum") if in_shares else units
    across, up = (ScatterAxis(name, unit, *end) for name, unit, end in zip(names, words, ends, strict=True))
    return across, up


def save_scatter_figure(figure: ScatterFigure, path: str | os.PathLike[str], progress: Progress | None = None) -> None:
    """See `save_chart`.  The points are a picture, all else is drawn with lines and letters."""
    legend = 1.5 * figure.look.points / 72 * len(figure.selections)
    high = PLOT * figure.look.inches + 0.55 + legend
    save_chart(path, figure.look, high, lambda page: _draw(page, figure), progress)


def _draw(page: Figure, figure: ScatterFigure) -> None:
    look, axes = figure.look, page.add_subplot()
    style_axes(axes, look, figure.across.words, figure.up.words)
    scale = 100 if figure.in_shares else 1
    ends = [(scale * axis.low, scale * axis.high) for axis in (figure.across, figure.up)]
    axes.set_xlim(*ends[0])
    axes.set_ylim(*ends[1])
    axes.locator_params(nbins=6)
    axes.grid(False)
    if figure.is_common:
        axes.set_aspect("equal")
        axes.axline((0, 0), slope=1, color=look.style.quiet_text, linewidth=0.8, linestyle="--", gid="diagonal")
    cells = round(PLOT * look.inches * CELLS_PER_INCH / cell_size(len(figure.scatter.ids)))
    grid = cells, cells, (figure.across.low, figure.across.high), (figure.up.low, figure.up.high)
    chosen = [(vertices, _rgb(colour)) for _, vertices, colour in figure.selections]
    (red, green, blue), ground = (
        [round(255 * x) for x in colour] for colour in (look.style.text, look.style.background)
    )
    picture = density_picture(figure.scatter, grid, (red, green, blue), chosen)
    opaque = picture[..., 3:] / 255  # EPS has no other
    picture = np.round(opaque * picture[..., :3] + (1 - opaque) * ground).astype(np.uint8)
    axes.imshow(
        picture, extent=(*ends[0], *ends[1]), aspect="equal" if figure.is_common else "auto", interpolation="nearest"
    )
    if figure.correlation is not None:
        words = f"rank correlation {figure.correlation:.4f}".replace("-", "−")
        axes.set_title(words, loc="right", fontsize=look.points, color=look.style.quiet_text)
    place = np.flatnonzero(figure.scatter.ids == figure.largest)
    if len(place):
        at = scale * figure.scatter.x[place], scale * figure.scatter.y[place]
        for colour, width, size in ((look.style.background, 2.4, 7.6), (look.style.text, 1.1, 6)):
            axes.plot(*at, "+", color=colour, markersize=size, markeredgewidth=width, zorder=3, gid="largest")
    if figure.selections:
        _name_selections(page, figure)


def _name_selections(page: Figure, figure: ScatterFigure) -> None:
    from matplotlib.patches import Patch

    patches = [
        Patch(facecolor=colour, label=f"{name} ({len(vertices):,})") for name, vertices, colour in figure.selections
    ]
    page.legend(
        handles=patches,
        loc="outside lower center",
        ncols=1,
        frameon=False,
        fontsize=figure.look.points,
        labelcolor=figure.look.style.text,
        handlelength=0.9,
        handleheight=0.9,
    )


def _rgb(colour: str) -> tuple[int, int, int]:
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return red, green, blue
