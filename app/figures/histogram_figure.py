"""The figure of a histogram: how much of a surface's area has which values of a field, in the colours of its bar."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.arrays import FloatArray
from bihdist_core.progress import Progress

from .chart_page import USUAL_LOOK, ChartLook, save_chart, style_axes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGH, SLANT = 2.0, 0.62
"""Inches that it is high at most, and by its width."""


@dataclass(frozen=True, eq=False)
class HistogramFigure:
    """ends: (b + 1,) of the bins; shares: (b,) of the area, together 1; colours: (b, 3), from 0 to 1.

    name: of the field; unit: of its values.  mean: by area.
    """

    ends: FloatArray
    shares: FloatArray
    colours: FloatArray
    name: str
    unit: str = ""
    mean: float | None = None
    look: ChartLook = USUAL_LOOK


def save_histogram_figure(
    figure: HistogramFigure, path: str | os.PathLike[str], progress: Progress | None = None
) -> None:
    """See `save_chart`."""
    high = min(SLANT * figure.look.inches, HIGH)
    save_chart(path, figure.look, high, lambda page: _draw(page, figure), progress)


def _draw(page: Figure, figure: HistogramFigure) -> None:
    look, axes = figure.look, page.add_subplot()
    style_axes(axes, look, f"{figure.name} ({figure.unit})" if figure.unit else figure.name, "% of the area")
    ends = figure.ends
    axes.bar(
        ends[:-1],
        100 * figure.shares,
        np.diff(ends),
        align="edge",
        color=figure.colours,
        edgecolor=look.style.quiet_text,
        linewidth=0.4,
    )
    axes.set_xlim(float(ends[0]), float(ends[-1]))
    if figure.mean is not None:
        mean = figure.mean
        axes.axvline(mean, color=look.style.text, linewidth=0.9, linestyle="--", gid="mean")
        words = f"mean {mean:.4g}".replace("-", "−")
        axes.annotate(
            words,
            (mean, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 3),
            textcoords="offset points",
            ha="center",
            fontsize=look.points,
            color=look.style.text,
        )
