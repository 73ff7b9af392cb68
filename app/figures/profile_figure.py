"""The figure of a profile: fields over the length of a path, in the fonts and colours of the other figures."""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bihdist_core import OutputError, ParameterError
from bihdist_core.progress import Progress, silent
from bihdist_core.whole_file import check_output, whole_file

from ..drawing.style import PAPER, Style
from .canvas import matplotlib_settings
from .draw import FIGURE_FORMATS
from .fonts import check_font

INCHES = (5.5, 2.2)
"""As wide as the text of most papers."""

POINTS = 8.0
"""The size of all letters."""

LINE = 1.4
"""Points that a curve is wide."""

PIXELS_PER_INCH = 300


@dataclass(frozen=True, eq=False)
class ProfileCurve:
    """values: (k,) at the points of the path, NaN where there are none; colour: as #rrggbb."""

    name: str
    values: np.ndarray
    colour: str
    is_dashed: bool = False


@dataclass(frozen=True, eq=False)
class ProfileFigure:
    """arcs: (k,) lengths along the path, in `unit`.  in_shares: the values are shares of 1, written in percent.

    value_unit: of the values, "" where they have several.  knots: lengths with what is written there.  font: a family,
    "" for the usual one.
    """

    arcs: np.ndarray
    curves: tuple[ProfileCurve, ...]
    unit: str = ""
    in_shares: bool = True
    value_unit: str = ""
    knots: tuple[tuple[float, str], ...] = ()
    style: Style = PAPER
    font: str = ""


def save_profile_figure(figure: ProfileFigure, path: str | os.PathLike[str], progress: Progress | None = None) -> None:
    """Into a .png, .pdf, .svg or .eps file, whole or not at all.

    Raises ParameterError where there are no curves or no such font; OutputError if it cannot be written.
    """
    extension = check_output(path, FIGURE_FORMATS)
    check_font(figure.font)
    if not figure.curves:
        raise ParameterError("There is no field along the path yet; wait until a panel has one.")
    (progress or silent)(0.0, "drawing the profile")
    with whole_file(path) as temporary, matplotlib_settings(figure.font):
        try:
            _write(figure, temporary, extension)
        except ValueError as error:  # matplotlib's word for a page it cannot make
            raise OutputError(f"{path} could not be written: {error}.") from error


def _write(figure: ProfileFigure, path: Path, extension: str) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    style = figure.style
    canvas = Canvas(figsize=INCHES, dpi=PIXELS_PER_INCH, facecolor=style.background, layout="constrained")
    FigureCanvasAgg(canvas)
    axes = canvas.add_subplot()
    axes.set_facecolor(style.background)
    _draw(axes, figure)
    # Nothing in the file says when it was made, so that it is equal when made again.
    dates = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}, ".png": {"Software": None}}.get(extension, {})
    made = {} if extension == ".png" else {"Creator": "bihdist"}
    canvas.savefig(path, metadata={**made, **dates}, facecolor=style.background)
    if extension == ".eps":
        content = path.read_bytes()
        path.write_bytes(re.sub(rb"^%%(CreationDate|Title):[^\n]*\n", b"", content, count=2, flags=re.MULTILINE))


def _draw(axes, figure: ProfileFigure) -> None:
    from matplotlib.ticker import FuncFormatter

    style, scale = figure.style, 100 if figure.in_shares else 1
    names = []
    for k, curve in enumerate(figure.curves):
        dashes = "--" if curve.is_dashed else "-"
        axes.plot(figure.arcs, scale * curve.values, dashes, color=curve.colour, linewidth=LINE, gid=f"curve-{k}")
        known = np.flatnonzero(np.isfinite(curve.values))
        if len(known):
            names.append((float(scale * curve.values[known[-1]]), curve))
    axes.set_xlim(0, figure.arcs[-1] or 1.0)
    if figure.in_shares and min(axes.get_ylim()) > -5:
        axes.set_ylim(0, max(100.0, axes.get_ylim()[1] if axes.get_ylim()[1] > 106 else 100.0))
    elif not figure.in_shares and axes.dataLim.ymin >= 0:
        axes.set_ylim(bottom=0)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(style.quiet_text)
        axes.spines[side].set_linewidth(0.6)
    axes.grid(axis="y", color=style.quiet_text, alpha=0.25, linewidth=0.5)
    axes.tick_params(labelsize=POINTS, colors=style.quiet_text, width=0.6, length=2.5)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.6g}".replace("-", "−")))
    axes.set_xlabel(f"length along the path ({figure.unit})", fontsize=POINTS, color=style.text)
    words = "% of the maximum" if figure.in_shares else figure.value_unit or "value"
    axes.set_ylabel(words, fontsize=POINTS, color=style.text)
    for k, (arc, text) in enumerate(figure.knots):
        axes.annotate(
            text,
            (arc, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 5),
            textcoords="offset points",
            ha={0: "left", len(figure.knots) - 1: "right"}.get(k, "center"),
            fontsize=POINTS,
            color=style.quiet_text,
        )
        axes.axvline(arc, color=style.quiet_text, alpha=0.4, linewidth=0.5, zorder=0)
    _name(axes, names)


def _name(axes, names: Sequence[tuple[float, ProfileCurve]]) -> None:
    """At the ends of the curves, one below the other where they would touch."""
    low, high = axes.get_ylim()
    step = POINTS * 1.25 / 72 / (0.72 * INCHES[1])
    places: list[float] = []
    ordered = sorted(names, key=lambda each: each[0])
    for value, _ in ordered:
        at = (value - low) / (high - low)
        places.append(at if not places else max(at, places[-1] + step))
    over = 1.0
    for k in range(len(places) - 1, -1, -1):
        places[k] = min(places[k], over)
        over = places[k] - step
    for at, (_, curve) in zip(places, ordered, strict=True):
        axes.annotate(
            curve.name,
            (1.0, at),
            xycoords="axes fraction",
            xytext=(5, 0),
            textcoords="offset points",
            va="center",
            fontsize=POINTS,
            fontweight="bold",
            color=curve.colour,
        )
