"""Colour bars of a figure: their ends, ticks and words."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from bihdist_core.distances.answers import with_unit

from ..scene.bands import beyond
from .boxes import Box, Words
from .description import Figure
from .words import BOUND, LINE, Lettering

THICK = 11.0
TICK = 3.0
LONGEST = 420.0
"""Usual sizes, in units."""

SHARE = 0.74
"""Of a panel's width that its bar takes."""


@dataclass(frozen=True)
class Bar:
    """A colour bar of the panel with this number, from `low` to `high`, upwards if it is upright, with its words.

    goes_beyond: whether there are values below its lower and above its upper end.
    """

    box: Box
    panel: int
    low: float
    high: float
    ticks: tuple[float, ...]
    texts: tuple[Words, ...]
    is_upright: bool = False
    goes_beyond: tuple[bool, bool] = (False, False)

    def place(self, value: float) -> float:
        """Where a value stands: its x, or y if the bar is upright."""
        share = (value - self.low) / (self.high - self.low)
        return self.box.bottom - share * self.box.height if self.is_upright else self.box.x + share * self.box.width


def ends(figure: Figure, panel: int) -> tuple[float, float]:
    """What stands at the ends of a panel's bar."""
    top = 100.0 if figure.is_in_shares(panel) else figure.tops()[panel]
    return (-top if figure.panels[panel].signed else 0.0), top


def goes_beyond(figure: Figure, panel: int) -> tuple[bool, bool]:
    """Whether a bar's panels have values beyond its lower and its upper end."""
    shown = range(len(figure.panels)) if figure.has_one_bar else [panel]
    tops, panels = figure.tops(), figure.panels
    found = [beyond(panels[k].field, tops[k], panels[k].signed) for k in shown]
    return any(low for low, _ in found), any(high for _, high in found)


def name_of(figure: Figure, panel: int) -> str:
    """The name of a panel, once."""
    each = figure.panels[panel]
    return each.heading or each.label


def end_words(figure: Figure, panel: int) -> str:
    """What stands at a panel's bar beside its name: the unit, and where the colours end."""
    each = figure.panels[panel]
    if each.field is None:
        return ""
    if each.largest:
        end = _largest_words(each.largest)
    elif each.signed:
        vertex = int(np.nanargmax(np.abs(each.field))) if np.isfinite(each.field).any() else 0
        end = f"largest{BOUND}{_signed(each.field[vertex])} at{BOUND}vertex{BOUND}{vertex}"
    else:
        top = figure.tops()[panel]
        is_own = figure.is_of_set or any(goes_beyond(figure, panel))
        end = f"max{BOUND}{each.own_top if is_own else top:.4g}"
    if figure.is_in_shares(panel) and not figure.has_one_bar:
        return f"% of the {end}{with_unit(each.unit)}"
    return f"{each.unit}, {end}" if each.unit else end


def _largest_words(largest: str) -> str:
    """How large a difference is; a number and what it counts stay on one line."""
    return largest.replace(" % ", f"{BOUND}% ").replace(" at vertex ", f" at{BOUND}vertex{BOUND}")


def bar_words(figure: Figure, panel: int) -> str:
    """All that stands under a panel: its name where it has no heading, and what its bar says."""
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
    """What stands at the one bar of all panels."""
    if figure.is_in_shares(panel):
        return "% of each maximum" if not figure.panels[panel].signed else "% of each largest value"
    # How large a difference is stands under its panel.
    return figure.panels[panel].unit if figure.panels[panel].largest else end_words(figure, panel)


def ticks(high: float, low: float = 0.0, most: int = 5) -> list[float]:
    """Round numbers from `low` to `high`, for a colour bar."""
    from matplotlib.ticker import MaxNLocator

    values = MaxNLocator(nbins=most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [float(v) for v in values if low * (1 + 1e-9) <= v <= high * (1 + 1e-9)]


def number(value: float) -> str:
    """A value at a tick."""
    return f"{value:.6g}".replace("-", "−")


def flat_bar(
    figure: Figure,
    panel: int,
    box: Box,
    room: tuple[float, float],
    lines: tuple[str, ...],
    size: float,
    type: Lettering,
) -> Bar:
    """A bar in a box with ticks and lines under it, all of them between two places of the page.

    Ticks are fewer where they would touch.
    """
    low, high = ends(figure, panel)
    bar = Bar(box, panel, low, high, (), ())
    chosen: list[float] = []
    for most in (5, 4, 3, 2, 1):
        chosen = ticks(high, low, most)
        halves = [type.width(number(v), size) / 2 for v in chosen]
        places = [bar.place(v) for v in chosen]
        spans = list(zip(places, halves, strict=True))
        is_inside = all(room[0] <= x - half and x + half <= room[1] for x, half in spans)
        is_apart = all(b - a >= 0.5 * size + half + other for (a, half), (b, other) in pairwise(spans))
        if is_inside and is_apart:
            break
        chosen = []
    base = box.bottom + TICK + 1 + size
    texts = [Words((number(v),), bar.place(v), base, size) for v in chosen]
    texts.append(Words(lines, sum(room) / 2, base + 1.1 * LINE * size, size, is_quiet=True))
    return Bar(box, panel, low, high, tuple(chosen), tuple(texts), False, goes_beyond(figure, panel))


def flat_foot(factor: float, size: float, lines: int, has_bar: bool = True) -> float:
    """The height of a bar with so many lines of words, and of the space around it."""
    bar = THICK * factor + TICK + 1 + 1.12 * size if has_bar else 0.0
    return 7 * factor + bar + lines * LINE * size + 5 * factor


def upright_width(figure: Figure, panel: int, factor: float, size: float, type: Lettering) -> float:
    """The width of an upright bar with its words, and of the space around it."""
    low, high = ends(figure, panel)
    widest = max(type.width(number(v), size) for v in ticks(high, low))
    return (10 + THICK) * factor + TICK + 3 + widest + 0.4 * size + LINE * size + 4 * factor


def upright_bar(figure: Figure, panel: int, strip: Box, factor: float, size: float, type: Lettering) -> Bar:
    """A bar at the left of a strip of the page, with its ticks and words at its right."""
    low, high = ends(figure, panel)
    long = min(strip.height - 1.2 * size, LONGEST * max(factor, 1.0))
    box = Box(strip.x + 10 * factor, strip.y + (strip.height - long) / 2, THICK * factor, long)
    bar = Bar(box, panel, low, high, (), (), True)
    chosen = next(
        c for n in (5, 4, 3, 2, 1, 0) if (c := ticks(high, low, n) if n else []) is not None and _apart(bar, c, size)
    )
    x = box.right + TICK + 3
    texts = []
    for value in chosen:
        text = number(value)
        texts.append(Words((text,), x + type.width(text, size) / 2, bar.place(value) + 0.36 * size, size))
    widest = max((type.width(number(v), size) for v in chosen), default=0.0)
    smaller, (lines,) = type.fitted([shared_words(figure, panel)], size, strip.height, 1)
    texts.append(Words(lines, x + widest + 0.4 * size + size, strip.middle[1], smaller, is_quiet=True, turned=True))
    return Bar(box, panel, low, high, tuple(chosen), tuple(texts), True, goes_beyond(figure, panel))


def _apart(bar: Bar, values: list[float], size: float) -> bool:
    places = [bar.place(v) for v in values]
    return all(a - b >= 1.3 * size for a, b in pairwise(places))


def _signed(value: float) -> str:
    return f"{value:+.4g}".replace("-", "−")
