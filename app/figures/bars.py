"""Colour bars of a figure: their ends, ticks and words, and their shapes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from bihdist_core.arrays import FloatArray
from bihdist_core.distances.answers import with_unit

from ..drawing.colour_bar import BarLine, bar_shapes, line_shapes
from ..drawing.numbers import MINUS, tick
from ..drawing.shapes import Box, Path, Pen, Shape, line, opaque, rectangle
from ..scene.bands import band_edges, bar_colours, beyond
from ..scene.levels import BOLD, Levels, levels
from .description import Figure
from .words import BOUND, LINE, Lettering, TextLines

THICK = 11.0
TICK = 3.0
LONGEST = 420.0
"""Usual sizes, in units."""

POINT = 0.7
"""Length of the point at an end, as a fraction of a bar's thickness."""

MOST_STEPS = 5
"""Most steps from tick to tick on a bar."""

LINE_ROOM, END_ROOM = 3.0, 1.5
"""Least units from one isoline on a bar to the next, and to an end of the bar."""

SHARE = 0.74
"""Fraction of a panel's width that its bar takes."""


@dataclass(frozen=True)
class Bar:
    """A colour bar of a panel, with its words.

    Attributes
    ----------
    panel
        Number of the panel.
    low, high
        Values at its ends.
    goes_beyond
        Whether there are values below its lower and above its upper end.
    """

    box: Box
    panel: int
    low: float
    high: float
    ticks: tuple[float, ...]
    texts: tuple[TextLines, ...]
    is_upright: bool = False
    goes_beyond: tuple[bool, bool] = (False, False)

    def place(self, value: float) -> float:
        """Return the position of a value: its x, or y if the bar is upright."""
        share = (value - self.low) / (self.high - self.low)
        return self.box.bottom - share * self.box.height if self.is_upright else self.box.x + share * self.box.width


def bar_limits(figure: Figure, panel: int) -> tuple[float, float]:
    """Return the values at the ends of a panel's bar."""
    top = 100.0 if figure.is_in_shares(panel) else figure.upper_limits()[panel]
    return (-top if figure.panels[panel].signed else 0.0), top


def goes_beyond(figure: Figure, panel: int) -> tuple[bool, bool]:
    """Return whether a bar's panels have values beyond its lower and its upper end."""
    shown = range(len(figure.panels)) if figure.has_one_bar else [panel]
    tops, panels = figure.upper_limits(), figure.panels
    found = [beyond(panels[k].field, tops[k], panels[k].signed) for k in shown]
    return any(low for low, _ in found), any(high for _, high in found)


def name_of(figure: Figure, panel: int) -> str:
    """Return the heading of a panel, or its label if it has none."""
    each = figure.panels[panel]
    return each.heading or each.label


def end_words(figure: Figure, panel: int) -> str:
    """Return the words beside the name of a panel's bar: the unit, and the end of the colours."""
    each = figure.panels[panel]
    if each.field is None:
        return ""
    if each.largest:
        end = _largest_words(each.largest)
    elif each.signed:
        vertex = int(np.nanargmax(np.abs(each.field))) if np.isfinite(each.field).any() else 0
        number_at = f"{each.field[vertex]:+.4g}".replace("-", MINUS)
        end = f"largest{BOUND}{number_at} at{BOUND}vertex{BOUND}{vertex}"
    else:
        top = figure.upper_limits()[panel]
        is_own = figure.is_of_set or any(goes_beyond(figure, panel))
        end = f"max{BOUND}{each.own_maximum if is_own else top:.4g}"
    if figure.is_in_shares(panel) and not figure.has_one_bar:
        return f"% of the {end}{with_unit(each.unit)}"
    return f"{each.unit}, {end}" if each.unit else end


def _largest_words(largest: str) -> str:
    """Return the size of a difference in words; a number and what it counts stay on one line."""
    # Which of the two is farther there follows from the sign and the heading.
    return largest.partition(":")[0].replace(" % ", f"{BOUND}% ").replace(" at vertex ", f" at{BOUND}vertex{BOUND}")


def bar_words(figure: Figure, panel: int) -> str:
    """Return all words under a panel: its name where it has no heading, and what its bar says."""
    each, end = figure.panels[panel], end_words(figure, panel)
    if figure.has_one_bar and each.largest:
        end = _largest_words(each.largest)
    elif figure.has_one_bar and figure.range == "shared":
        end = ""
    if figure.title == "none" or (figure.title == "heading" and each.heading):
        return end
    name = name_of(figure, panel) if figure.title == "caption" else each.label
    return f"{name} ({end})" if name and end else name or end


def shared_words(figure: Figure, panel: int) -> str:
    """Return the words at the one bar of all panels."""
    if figure.is_in_shares(panel):
        return "% of each maximum" if not figure.panels[panel].signed else "% of each largest value"
    # How large a difference is stands under its panel.
    return figure.panels[panel].unit if figure.panels[panel].largest else end_words(figure, panel)


def ticks(high: float, low: float = 0.0, most: int = MOST_STEPS) -> list[float]:
    """Return round numbers from `low` to `high`, at most so many steps apart."""
    from matplotlib.ticker import MaxNLocator

    values = MaxNLocator(nbins=most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [float(v) for v in values if low * (1 + 1e-9) <= v <= high * (1 + 1e-9)]


def flat_bar(
    figure: Figure,
    panel: int,
    box: Box,
    room: tuple[float, float],
    lines: tuple[str, ...],
    size: float,
    type: Lettering,
) -> Bar:
    """Place a bar in a box with ticks and lines under it, all of them between two places of the page.

    Ticks are fewer where they would touch.
    """
    low, high = bar_limits(figure, panel)
    bar = Bar(box, panel, low, high, (), ())
    chosen: list[float] = []
    for most in range(MOST_STEPS, 0, -1):
        chosen = ticks(high, low, most)
        halves = [type.width(tick(v), size) / 2 for v in chosen]
        places = [bar.place(v) for v in chosen]
        spans = list(zip(places, halves, strict=True))
        is_inside = all(room[0] <= x - half and x + half <= room[1] for x, half in spans)
        is_apart = all(b - a >= 0.5 * size + half + other for (a, half), (b, other) in pairwise(spans))
        if is_inside and is_apart:
            break
        chosen = []
    base = box.bottom + TICK + 1 + size
    texts = [TextLines((tick(v),), bar.place(v), base, size) for v in chosen]
    texts.append(TextLines(lines, sum(room) / 2, base + 1.1 * LINE * size, size, is_quiet=True))
    return Bar(box, panel, low, high, tuple(chosen), tuple(texts), False, goes_beyond(figure, panel))


def flat_foot(factor: float, size: float, lines: int, has_bar: bool = True) -> float:
    """Return the height of a bar with so many lines of words, and of the space around it."""
    bar = THICK * factor + TICK + 1 + 1.12 * size if has_bar else 0.0
    return 7 * factor + bar + lines * LINE * size + 5 * factor


def upright_width(figure: Figure, panel: int, factor: float, size: float, type: Lettering) -> float:
    """Return the width of an upright bar with its words, and of the space around it."""
    low, high = bar_limits(figure, panel)
    widest = max(type.width(tick(v), size) for v in ticks(high, low))
    return (10 + THICK) * factor + TICK + 3 + widest + 0.4 * size + LINE * size + 4 * factor


def upright_bar(figure: Figure, panel: int, strip: Box, factor: float, size: float, type: Lettering) -> Bar:
    """Place a bar at the left of a strip of the page, with its ticks and words at its right."""
    low, high = bar_limits(figure, panel)
    long = min(strip.height - 1.2 * size, LONGEST * max(factor, 1.0))
    box = Box(strip.x + 10 * factor, strip.y + (strip.height - long) / 2, THICK * factor, long)
    bar = Bar(box, panel, low, high, (), (), True)
    choices = (ticks(high, low, most) if most else [] for most in range(MOST_STEPS, -1, -1))
    chosen = next(values for values in choices if _apart(bar, values, size))
    x = box.right + TICK + 3
    texts = []
    for value in chosen:
        text = tick(value)
        texts.append(TextLines((text,), x + type.width(text, size) / 2, bar.place(value) + 0.36 * size, size))
    widest = max((type.width(tick(v), size) for v in chosen), default=0.0)
    smaller, (lines,) = type.fitted([shared_words(figure, panel)], size, strip.height, 1)
    texts.append(TextLines(lines, x + widest + 0.4 * size + size, strip.middle[1], smaller, is_quiet=True, turned=True))
    return Bar(box, panel, low, high, tuple(chosen), tuple(texts), True, goes_beyond(figure, panel))


def _apart(bar: Bar, values: list[float], size: float) -> bool:
    places = [bar.place(v) for v in values]
    return all(a - b >= 1.3 * size for a, b in pairwise(places))


# ---------------------------------------------------------------------- as shapes
def shapes_of_bar(figure: Figure, bar: Bar, stroke: float, room: float) -> list[Shape]:
    """Return a colour bar with its isolines, ticks and words.

    `room` is the least distance of two isolines on any bar.
    """
    style, signed, box, upright = figure.style, figure.panels[bar.panel].signed, bar.box, bar.is_upright
    thick = box.width if upright else box.height
    shapes: list[Shape] = []
    if style.coloured:
        # Where bars are in fractions of the maximum, what is drawn still ends there.
        edges = band_edges(figure.panels[bar.panel].isolines, figure.upper_limits()[bar.panel], signed)
        shapes += bar_shapes(box, bar_colours(style, edges, signed, bar.goes_beyond), POINT * thick, upright)
    shapes += line_shapes(box, _lines_on_bar(figure, bar, stroke, room), upright)
    if not style.coloured:
        shapes.append(Path(rectangle(box), pen=Pen(opaque(style.text), 0.8)))
    pen = Pen(opaque(style.quiet_text), 0.8 * max(stroke, 0.7))
    for value in bar.ticks:
        at = bar.place(value)
        ends = ((box.right, at), (box.right + TICK, at)) if upright else ((at, box.bottom), (at, box.bottom + TICK))
        shapes.append(line(*ends, pen))
    return [*shapes, *(text for words in bar.texts for text in words.shapes(style))]


def _levels_on(figure: Figure, bar: Bar) -> tuple[Levels, FloatArray]:
    """Return the isolines of a bar's panel, and where they are on the bar, from 0 to 1."""
    panel, top = figure.panels[bar.panel], figure.upper_limits()[bar.panel]
    found = levels(panel.isolines, top, top, panel.signed, panel.through)
    low = -top if panel.signed else 0.0
    # Where bars are in fractions of the maximum, they do not end at it.
    return found, (found.values - low) / (top - low) if top > 0 else found.values


def line_spacing(figure: Figure, bar: Bar) -> float:
    """Return the least distance between two isolines on a bar, without those through points."""
    found, shares = _levels_on(figure, bar)
    long = bar.box.height if bar.is_upright else bar.box.width
    return float(np.diff(shares[~found.is_through]).min(initial=1.0)) * long


def _lines_on_bar(figure: Figure, bar: Bar, stroke: float, room: float) -> list[BarLine]:
    """Return the isolines, unless they would be too close; those through points always."""
    style, signed = figure.style, figure.panels[bar.panel].signed
    found, shares = _levels_on(figure, bar)
    long, lines = bar.box.height if bar.is_upright else bar.box.width, []
    for share, value, bold, through in zip(shares, found.values, found.is_bold, found.is_through, strict=True):
        ink, width = style.isoline_ink(signed, value, through), style.isoline_width * stroke
        rim_width = ink.rim_width * stroke
        if through:
            width *= BOLD
        elif room >= LINE_ROOM and min(share, 1 - share) * long >= END_ROOM:
            width, rim_width = min(width, room / 4) * (BOLD if bold else 1), min(rim_width, room / 8)
        else:
            continue
        lines.append(BarLine(float(share), width, ink.colour, ink.rim, width + 2 * rim_width))
    return lines
