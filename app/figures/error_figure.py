"""The figure of maps' errors: which share of the vertices is at most so far from where it belongs."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from bihdist_core.applications.map_errors import LIMIT, ErrorCurve, MeanCurve
from bihdist_core.file_output import atomic_write, check_output

from ..drawing.chart import Axis
from ..drawing.shapes import Box, Path, Pen, Shape, Text, hexadecimal, line
from ..scene.style import CURVES
from .chart_look import FAINT, RIM, USUAL_LOOK, ChartLook
from .chart_page import save_chart
from .draw import FIGURE_FORMATS

HIGH = 0.62
"""Height of the figure, as a fraction of its width."""
LINE, DASHES = 1.9, ((), (3.7, 1.6), (1.0, 1.65))
"""Units that a curve is wide, and dashes of curves whose colours are taken, in widths."""
MOST_NAMED = 5
"""Most curves that have names beside their mean."""
STEPS = 250
"""Steps from 0 to the limit in a table."""

ERROR_FORMATS = (".csv", *FIGURE_FORMATS)


@dataclass(frozen=True, eq=False)
class ErrorFigure:
    """The curves of several maps, by their names.

    Attributes
    ----------
    colours
        Colours of curves as #rrggbb, in turn.
    means
        Means over all maps by their names, if these matter more: those of many maps are thin then and have no names.
    """

    curves: Mapping[str, ErrorCurve]
    colours: tuple[str, ...] = CURVES
    look: ChartLook = USUAL_LOOK
    means: Mapping[str, MeanCurve] = field(default_factory=dict)

    def shapes(self, height: float) -> list[Shape]:
        """Return the chart at a height in units."""
        return _shapes(self, height)


def save_error_figure(figure: ErrorFigure, path: str | os.PathLike[str]) -> None:
    """Draw the curves (see `save_chart`), or write them as a .csv table: a line for each threshold."""
    if check_output(path, ERROR_FORMATS) == ".csv":
        with atomic_write(path) as temporary:
            temporary.write_text(_table({**figure.means, **figure.curves}), encoding="utf-8")
    else:
        save_chart(path, figure, HIGH * figure.look.width)


def _table(curves: Mapping[str, ErrorCurve | MeanCurve]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["error", *curves])
    thresholds = np.linspace(0, LIMIT, STEPS + 1)
    columns = [curve.fractions(thresholds).tolist() for curve in curves.values()]
    for threshold, *shares in zip(thresholds.tolist(), *columns, strict=True):
        writer.writerow([f"{threshold:.6g}", *map(repr, shares)])
    return text.getvalue()


def _shapes(figure: ErrorFigure, height: float) -> list[Shape]:
    look = figure.look
    top = RIM + 0.4 * look.size
    across, up = Axis(0.0, LIMIT), Axis(0.0, 101.0)
    room = Box(0, top, look.width - look.right(across), height - top)
    plot, shapes = look.plot(room, across, up, ("geodesic error / √area", "% of the vertices"))
    thresholds, text = np.linspace(0, LIMIT, STEPS + 1), look.ink.text
    are_thin = bool(figure.means) and len(figure.curves) > MOST_NAMED
    curves: list[Path | None] = []
    named: list[tuple[str, Pen]] = []
    for curve in figure.curves.values() if are_thin else ():
        curves.append(plot.curve(thresholds, 100 * curve.fractions(thresholds), Pen((*text[:3], FAINT), LINE / 3)))
    for number, (name, curve) in enumerate(() if are_thin else figure.curves.items()):
        count = len(figure.colours)
        pen = Pen(hexadecimal(figure.colours[number % count]), LINE, DASHES[number // count % 3], join="round")
        ends = np.unique(np.clip(curve.errors, 0, LIMIT))
        places = np.unique(np.concatenate([[0.0], ends, thresholds]))
        shares = 100 * curve.fractions(places)
        if len(curve.errors) < STEPS:
            places, shares = np.repeat(places, 2)[1:], np.repeat(shares, 2)[:-1]
        curves.append(plot.curve(places, shares, pen))
        named.append((f"{name}: {curve.mean:.3g}", pen))
    for number, (name, mean) in enumerate(figure.means.items()):
        colour = hexadecimal(figure.colours[number]) if are_thin else text
        pen = Pen(colour, 1.5 * LINE, DASHES[number % 3], join="round")
        curves.append(plot.curve(thresholds, 100 * mean.fractions(thresholds), pen))
        named.append((f"{name}: {mean.mean:.3g}", pen))
    shapes.append(plot.clipped([curve for curve in curves if curve], 1.0))
    return [*shapes, *_names(look, plot.box, named)]


def _names(look: ChartLook, box: Box, named: Sequence[tuple[str, Pen]]) -> list[Shape]:
    """Return the curves' names with their mean errors, in the lower right corner of the plot."""
    size, head, text = look.size, "mean error", look.ink.text
    step, sample = 1.35 * size, 2.0 * size
    wide = max(look.text_width(words, size) for words in (head, *(words for words, _ in named)))
    right = box.right - 0.6 * size
    y = box.bottom - 0.7 * size - len(named) * step
    left = right - wide
    shapes: list[Shape] = [Text(head, (left - sample + right) / 2, y, size, text, align="centre")]
    for words, pen in named:
        y += step
        shapes.append(line((left - sample - 0.6 * size, y - 0.3 * size), (left - 0.6 * size, y - 0.3 * size), pen))
        shapes.append(Text(words, left, y, size, text))
    return shapes
