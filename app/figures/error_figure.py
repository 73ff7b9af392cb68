"""The figure of maps' errors: which share of the vertices is at most so far from where it belongs."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.applications.map_errors import LIMIT, ErrorCurve
from bihdist_core.progress import Progress
from bihdist_core.whole_file import check_output, whole_file

from ..drawing.style import CURVES
from .chart_page import USUAL_LOOK, ChartLook, dress, save_chart
from .draw import FIGURE_FORMATS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGH = 0.62
"""How high it is, by its width."""
LINE = 1.4
"""Points that a curve is wide."""
STEPS = 250
"""From 0 to the limit, in a table."""

ERROR_FORMATS = (".csv", *FIGURE_FORMATS)


@dataclass(frozen=True, eq=False)
class ErrorFigure:
    """The curves of several maps, by their names.  colours: as #rrggbb, in turn."""

    curves: Mapping[str, ErrorCurve]
    colours: tuple[str, ...] = CURVES
    look: ChartLook = USUAL_LOOK


def save_error_figure(figure: ErrorFigure, path: str | os.PathLike[str], progress: Progress | None = None) -> None:
    """Draw the curves (see `save_chart`), or write them as a .csv table: a line for each threshold."""
    if check_output(path, ERROR_FORMATS) == ".csv":
        with whole_file(path) as temporary:
            temporary.write_text(_table(figure.curves), encoding="utf-8")
    else:
        save_chart(path, figure.look, HIGH * figure.look.inches, lambda page: _draw(page, figure), progress)


def _table(curves: Mapping[str, ErrorCurve]) -> str:
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
    dress(axes, look, "geodesic error / √area", "% of the vertices")
    for number, (name, curve) in enumerate(figure.curves.items()):
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
    axes.set_xlim(0, LIMIT)
    axes.set_ylim(0, 101)
    legend = axes.legend(
        frameon=False, fontsize=look.points, loc="lower right", title="mean error", title_fontsize=look.points
    )
    for text in (*legend.get_texts(), legend.get_title()):
        text.set_color(look.style.text)
