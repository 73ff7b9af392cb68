"""The figure of maps' errors: which share of the vertices is at most so far from where it belongs."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.applications.map_errors import LIMIT, ErrorCurve, MeanCurve
from bihdist_core.progress import Progress
from bihdist_core.whole_file import check_output, whole_file

from ..scene.style import CURVES
from .chart_page import FAINT, USUAL_LOOK, ChartLook, save_chart, style_axes
from .draw import FIGURE_FORMATS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGH = 0.62
"""How high it is, by its width."""
LINE = 1.4
"""Points that a curve is wide."""
MOST_NAMED = 5
"""So many curves have names beside their mean."""
STEPS = 250
"""From 0 to the limit, in a table."""

ERROR_FORMATS = (".csv", *FIGURE_FORMATS)


@dataclass(frozen=True, eq=False)
class ErrorFigure:
    """The curves of several maps, by their names.  colours: as #rrggbb, in turn.

    means: of all of them, by their names, if these matter more: then those of many maps are thin and have no names.
    """

    curves: Mapping[str, ErrorCurve]
    colours: tuple[str, ...] = CURVES
    look: ChartLook = USUAL_LOOK
    means: Mapping[str, MeanCurve] = field(default_factory=dict)


def save_error_figure(figure: ErrorFigure, path: str | os.PathLike[str], progress: Progress | None = None) -> None:
    """Draw the curves (see `save_chart`), or write them as a .csv table: a line for each threshold."""
    if check_output(path, ERROR_FORMATS) == ".csv":
        with whole_file(path) as temporary:
            temporary.write_text(_table({**figure.means, **figure.curves}), encoding="utf-8")
    else:
        save_chart(path, figure.look, HIGH * figure.look.inches, lambda page: _draw(page, figure), progress)


def _table(curves: Mapping[str, ErrorCurve | MeanCurve]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["error", *curves])
    thresholds = np.linspace(0, LIMIT, STEPS + 1)
    columns = [curve.shares(thresholds).tolist() for curve in curves.values()]
    for threshold, *shares in zip(thresholds.tolist(), *columns, strict=True):
        writer.writerow([f"{threshold:.6g}", *map(repr, shares)])
    return text.getvalue()


def _draw(page: Figure, figure: ErrorFigure) -> None:
    look, axes = figure.look, page.add_subplot()
    style_axes(axes, look, "geodesic error / √area", "% of the vertices")
    thresholds = np.linspace(0, LIMIT, STEPS + 1)
    are_thin = bool(figure.means) and len(figure.curves) > MOST_NAMED
    for curve in figure.curves.values() if are_thin else ():
        axes.plot(thresholds, 100 * curve.shares(thresholds), color=look.style.text, alpha=FAINT, linewidth=LINE / 3)
    for number, (name, curve) in enumerate(() if are_thin else figure.curves.items()):
        ends = np.unique(np.clip(curve.errors, 0, LIMIT))
        places = np.unique(np.concatenate([[0.0], ends, np.linspace(0, LIMIT, STEPS + 1)]))
        axes.plot(
            places,
            100 * curve.shares(places),
            color=figure.colours[number % len(figure.colours)],
            linewidth=LINE,
            linestyle=("-", "--", ":")[number // len(figure.colours) % 3],
            label=f"{name}: {curve.mean:.3g}",
            drawstyle="steps-post" if len(curve.errors) < STEPS else "default",
        )
    for number, (name, mean) in enumerate(figure.means.items()):
        axes.plot(
            thresholds,
            100 * mean.shares(thresholds),
            color=figure.colours[number] if are_thin else look.style.text,
            linewidth=1.5 * LINE,
            linestyle=("-", "--", ":")[number % 3],
            label=f"{name}: {mean.mean:.3g}",
        )
    axes.set_xlim(0, LIMIT)
    axes.set_ylim(0, 101)
    legend = axes.legend(
        frameon=False, fontsize=look.points, loc="lower right", title="mean error", title_fontsize=look.points
    )
    for text in (*legend.get_texts(), legend.get_title()):
        text.set_color(look.style.text)
