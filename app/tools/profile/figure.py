"""The figure of a profile: fields over the length of a path, in the fonts and colours of the other figures.

Values in several units have a plot each, side by side or, on a narrow page, one below the other.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core import ParameterError
from bihdist_core.arrays import FloatArray
from bihdist_core.progress import Progress

from ...figures.chart_page import USUAL_LOOK, ChartLook, faded, save_chart, style_axes
from .curves import ProfileCurve, parted

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.text import Annotation

LEAST_ACROSS = 2.8
"""Inches that each of several plots side by side has at least; else they stand below each other."""

LOW, HIGH, SLANT = 1.5, 2.2, 0.5
"""Inches that a plot is high, and how high it would be for each that it is wide."""

LONG = 14
"""Letters from which on a name has several lines."""

LINE = 1.4
"""Points that a curve is wide."""


@dataclass(frozen=True)
class ProfileKnot:
    """A point that the path goes through, at a length along it: a disc in a colour with a number, "" for a source;
    without a colour no disc."""

    arc: float
    number: str
    colour: str
    name: str = ""


@dataclass(frozen=True, eq=False)
class ProfileFigure:
    """arcs: (k,) lengths along the path, in `unit`.

    Curves of one unit share a plot; in_shares: all are drawn as fractions of their maxima, in percent.
    """

    arcs: FloatArray
    curves: tuple[ProfileCurve, ...]
    in_shares: bool = True
    unit: str = ""
    knots: tuple[ProfileKnot, ...] = ()
    look: ChartLook = USUAL_LOOK

    @property
    def plots(self) -> list[tuple[str, bool, list[ProfileCurve]]]:
        """See `parted`."""
        return parted(self.curves, self.in_shares)


def save_profile_figure(figure: ProfileFigure, path: str | os.PathLike[str], progress: Progress | None = None) -> None:
    """See `save_chart`; ParameterError where there are no curves, too."""
    if not figure.curves:
        raise ParameterError("There is no field along the path yet; wait until a panel has one.")
    inches, count = figure.look.inches, len(figure.plots)
    is_row = inches >= LEAST_ACROSS * count
    across = inches / count if is_row else inches
    high = min(max(SLANT * across, LOW), HIGH) * (1 if is_row else count)
    save_chart(path, figure.look, high, lambda page: _fill(page, figure, is_row), progress)


def _fill(page: "Figure", figure: ProfileFigure, is_row: bool) -> None:
    plots = figure.plots
    rows = page.subplots(*((1, len(plots)) if is_row else (len(plots), 1)), squeeze=False)
    named = []
    for k, (axes, (unit, in_shares, curves)) in enumerate(zip(rows.flat, plots, strict=True)):
        drawn = [100 * curve.shares if in_shares else curve.values for curve in curves]
        _draw(axes, figure, curves, drawn)
        _fit(axes, in_shares, any(not curve.is_share for curve in curves))
        is_lowest = is_row or k == len(plots) - 1
        along = f"length along the path ({figure.unit})" if is_lowest else ""
        style_axes(axes, figure.look, along, "% of the maximum" if in_shares else unit or "value")
        axes.tick_params(labelbottom=is_lowest)
        axes.locator_params(axis="y", nbins=5)
        _mark(axes, figure, is_row or k == 0)
        named.append(_name(axes, figure, curves, drawn))
    # How high the plots are is known once all words are there.
    if (engine := page.get_layout_engine()) is not None:
        engine.execute(page)
    for axes, names in zip(rows.flat, named, strict=True):
        _spread(axes, figure.look.points, page.get_figheight(), names)


def _draw(axes: "Axes", figure: ProfileFigure, curves: Sequence[ProfileCurve], drawn: Sequence[FloatArray]) -> None:
    """drawn: (k,) of each curve."""
    for curve, values in zip(curves, drawn, strict=True):
        dashes = "--" if curve.is_dashed else "-"
        line = axes.plot(figure.arcs, values, dashes, color=curve.colour, linewidth=LINE)[0]
        line.set_gid(f"curve-{figure.curves.index(curve)}")
    axes.set_xlim(0, figure.arcs[-1] or 1.0)


def _fit(axes: "Axes", in_shares: bool, has_whole: bool) -> None:
    """has_whole: 100% is the most that one of them can have."""
    if in_shares and min(axes.get_ylim()) > -5 and has_whole:
        axes.set_ylim(0, max(100.0, axes.get_ylim()[1] if axes.get_ylim()[1] > 106 else 100.0))
    elif axes.dataLim.ymin >= 0:
        axes.set_ylim(bottom=0)


def _mark(axes: "Axes", figure: ProfileFigure, has_discs: bool) -> None:
    """The points that the path goes through, by lines and, over the plot, by discs; never one on another."""
    style, points = figure.look.style, figure.look.points
    across = 1.5 * points
    apart = across / 72 / (0.7 * figure.look.inches) * (figure.arcs[-1] or 1.0)
    taken: list[float] = []
    ends = figure.knots[:1] + figure.knots[-1:]
    for knot in (*ends, *figure.knots[1:-1]):
        axes.axvline(knot.arc, color=faded(style, 0.4), linewidth=0.5, zorder=0)
        if not has_discs or not knot.colour or any(abs(knot.arc - other) < apart for other in taken):
            continue
        taken.append(knot.arc)
        disc: dict[str, Any] = {"boxstyle": "circle,pad=0.25", "facecolor": knot.colour, "edgecolor": "none"}
        if not knot.number:
            disc |= {"edgecolor": style.mark_edge, "linewidth": 0.8, "boxstyle": "circle,pad=0.1"}
        axes.annotate(
            knot.number or " ",
            (knot.arc, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 0.9 * points),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=0.85 * points,
            fontweight="bold",
            color="#FFFFFF",
            bbox=disc,
        )


def _name(
    axes: "Axes", figure: ProfileFigure, curves: Sequence[ProfileCurve], drawn: Sequence[FloatArray]
) -> list["Annotation"]:
    """Each curve's name at its end, from the lowest up."""
    ends = [
        (float(values[np.isfinite(values)][-1]), curve)
        for values, curve in zip(drawn, curves, strict=True)
        if np.isfinite(values).any()
    ]
    return [
        axes.annotate(
            "\n".join(wrap(curve.name, LONG, break_long_words=False)),
            (1.0, end),
            xycoords=("axes fraction", "data"),
            xytext=(5, 0),
            textcoords="offset points",
            va="center",
            fontsize=figure.look.points,
            fontweight="bold",
            color=curve.colour,
        )
        for end, curve in sorted(ends, key=lambda each: each[0])
    ]


def _spread(axes: "Axes", points: float, inches: float, names: Sequence["Annotation"]) -> None:
    """One above the other where they would touch, on a page so many inches high."""
    low, high = axes.get_ylim()
    line = points * 1.25 / 72 / (axes.get_position().height * inches)
    halves = [line * (1 + name.get_text().count("\n")) / 2 for name in names]
    places: list[float] = []
    for k, name in enumerate(names):
        at = (name.xy[1] - low) / (high - low)
        places.append(max(at, places[-1] + halves[k - 1] + halves[k]) if places else at)
    over = 1 + line / 2
    for k in range(len(places) - 1, -1, -1):
        places[k] = min(places[k], over - halves[k])
        over = places[k] - halves[k]
    for name, at in zip(names, places, strict=True):
        name.xycoords, name.xy = "axes fraction", (1.0, at)
