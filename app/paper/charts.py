"""The charts of an experiment as SVG, drawn by matplotlib."""

import io
import re
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from bihdist_core.distances.distance_types import BUILT_IN
from bihdist_core.experiments import Chart
from bihdist_core.experiments.verdicts import RAISED

if TYPE_CHECKING:
    from matplotlib.axis import XAxis, YAxis
    from matplotlib.figure import Figure as Canvas

SIZE = (5.85, 3.8)
"""Inches: two stand side by side on the page."""

COLOURS = {each.word: each.colour for each in BUILT_IN}
COLOURS["dijkstra"] = COLOURS["geodesic"]
"""The colour of each distance by the first word of its name, the same in all charts."""

BRIEF, LONG = (1 / 16, "#a5d66f"), (4.0, "#0c5238")
"""Times of diffusion distance, and their colours; those between them are mixed."""

REST = ("#d07c00", "#5b6470", "#b03a8c", "#8a6d1c", "#159a9c")
"""For what is no distance."""

DASHES = ("-", "--", ":", "-.")

NARROW, WIDE = 0.9, 2.2
"""Decades: axes that span less have ticks like linear ones, and those that span more at powers of ten alone."""


def colours_of(names: Sequence[str]) -> list[str]:
    """Return a colour for each of the curves of these names: distances have their own, others take the rest in turn."""
    found = [_of_distance(name) for name in names]
    rest = iter(REST * (len(names) // len(REST) + 1))
    return [colour or next(rest) for colour in found]


def _of_distance(name: str) -> str:
    word = re.split(r"[\s,(]", name.strip().lower(), maxsplit=1)[0]
    if word != "diffusion":
        return COLOURS.get(word, "")
    time = re.search(r"t\s*=\s*([\d.]+(?:/\d+)?)", name)
    share = 0.5
    if time:
        low, high = np.log(BRIEF[0]), np.log(LONG[0])
        share = float(np.clip((np.log(float(Fraction(time[1]))) - low) / (high - low), 0, 1))
    from matplotlib.colors import to_hex, to_rgb

    red, green, blue = (1 - share) * np.array(to_rgb(BRIEF[1])) + share * np.array(to_rgb(LONG[1]))
    return to_hex((red, green, blue))


def chart_svg(chart: Chart) -> str:
    """Return the chart as an <svg> element."""
    import matplotlib

    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": chart.heading, "font.size": 10}):
        text = io.StringIO()
        drawn(chart).savefig(text, format="svg", metadata={"Date": None})
    svg = text.getvalue()
    return svg[svg.index("<svg") :]


def drawn(chart: Chart) -> "Canvas":
    """Return the chart as a matplotlib canvas."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    canvas = Canvas(figsize=SIZE, layout="constrained")
    FigureCanvasAgg(canvas)
    axes = canvas.add_subplot()
    colours = colours_of([series.name for series in chart.series])
    for k, (series, colour) in enumerate(zip(chart.series, colours, strict=True)):
        points = series.style == "points"
        axes.plot(
            series.x,
            series.y,
            color=colour,
            label=series.name,
            # Curves of one colour differ by their dashes.
            linestyle="" if points else DASHES[colours[:k].count(colour) % len(DASHES)],
            linewidth=1.6,
            marker="o" if points or len(series.x) <= 8 else "",
            markersize=4.5,
        )
    axes.set(title=chart.heading, xlabel=chart.x_label, ylabel=chart.y_label)
    for axis, is_log in ((axes.xaxis, chart.log_x), (axes.yaxis, chart.log_y)):
        _scale(axis, is_log)
    axes.grid(color="#e3e6ea", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    if len(chart.series) > 1:
        axes.legend(frameon=False, fontsize=9)
    return canvas


def _scale(axis: "XAxis | YAxis", is_log: bool) -> None:
    """Write plain numbers at ticks, far enough from each other."""
    from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

    if is_log:
        axis.axes.set(**{f"{axis.axis_name}scale": "log"})
        low, high = axis.get_view_interval()
        decades = float(np.log10(high / low))
        axis.set_minor_locator(NullLocator())
        if decades < NARROW:
            axis.set_major_locator(MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]))
        else:
            subs = (1.0,) if decades > WIDE else (1.0, 2.0, 5.0)
            axis.set_major_locator(LogLocator(10, subs=subs, numticks=9))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))


def plain(number: float) -> str:
    """Return a number at a tick: 0.25, 1,000, and 10⁻⁵ instead of many zeros."""
    if number and not 1e-4 <= abs(number) < 1e7:
        power = int(np.floor(np.log10(abs(number)) + 1e-9))
        times = f"{number / 10.0**power:.4g}"
        raised = str(power).translate(RAISED)
        return (f"10{raised}" if times == "1" else f"{times} · 10{raised}").replace("-", "−")
    return f"{number:,.6g}".replace("-", "−")
