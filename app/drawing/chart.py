"""A chart: axes with round ticks about a plot, and curves in it, as shapes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import AnyArray

from .numbers import tick, ticks
from .shapes import RGBA, Box, Group, Path, Pen, Shape, Text, line, polyline

LEAST_APART = (72.0, 22.0)
"""Logical pixels between two ticks, across and up."""

GAP, ASCENT = 0.4, 0.75
"""Font sizes from an axis, or its ticks, to the words at it, and from the top of digits to their baseline."""


@dataclass(frozen=True)
class Axis:
    """An axis from low to high; in percent, its values are fractions of 1."""

    low: float = 0.0
    high: float = 1.0
    unit: str = ""
    in_percent: bool = False

    @property
    def span(self) -> float:
        """The length of the axis in its own unit, 1 for an empty one."""
        return (self.high - self.low) or 1.0

    def ticks(self, room: float, apart: float) -> list[float]:
        """Return round values with at least so many pixels between them, in as much room."""
        scale = 100 if self.in_percent else 1
        most = max(int(room / apart), 2)
        return [value / scale for value in ticks(self.low * scale, self.high * scale, most)]

    def words(self, value: float, is_end: bool = False) -> str:
        """Return the text of a tick; only the last one has the sign for percent."""
        if not self.in_percent:
            return tick(value)
        return f"{tick(100 * value)} %" if is_end else tick(100 * value)


@dataclass(frozen=True)
class Ink:
    """The colours of a chart, and the size of its font."""

    text: RGBA
    quiet: RGBA
    grid: Pen
    size: float


@dataclass(frozen=True)
class Plot:
    """The rectangle between two axes."""

    box: Box
    across: Axis
    up: Axis

    def x(self, value: float | AnyArray) -> AnyArray:
        """Return the positions of values on the axis across."""
        return self.box.x + (np.asarray(value, float) - self.across.low) / self.across.span * self.box.width

    def y(self, value: float | AnyArray) -> AnyArray:
        """Return the positions of values on the axis up."""
        return self.box.bottom - (np.asarray(value, float) - self.up.low) / self.up.span * self.box.height

    def clipped(self, shapes: Sequence[Shape], edge: float) -> Group:
        """Return shapes that are seen in the plot, and so far beyond it."""
        return Group(tuple(shapes), self.box.grown(edge))

    def upright(self, value: float, pen: Pen, name: str = "") -> Path:
        """Return a line through the plot at a value of the axis across."""
        x = float(self.x(value))
        return Path(polyline([(x, self.box.y), (x, self.box.bottom)]), pen=pen, name=name)

    def curve(self, x: AnyArray, y: AnyArray, pen: Pen, name: str = "") -> Path | None:
        """Return a curve through values (k,), broken where one is not finite; None if all of it is."""
        known = np.isfinite(y)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], known, [False]]).astype(int)))
        places = np.stack([self.x(x), self.y(y)], 1)
        parts = tuple(part for i, j in edges.reshape(-1, 2) for part in polyline(places[i:j]))
        return Path(parts, pen=pen, name=name) if parts else None


def tick_shapes(
    plot: Plot,
    ink: Ink,
    apart: tuple[float, float] = LEAST_APART,
    rule: Pen | None = None,
    mark: float = 0.0,
    is_free: Callable[[float, str], bool] | None = None,
    gap: float = GAP,
) -> list[Shape]:
    """Return the grid lines of a plot, and round values at both axes.

    Parameters
    ----------
    apart
        Least distances between ticks, across and up.
    rule
        The pen of the axes, and of ticks of the length `mark`; None for no axes, and lines on whole pixels.
    is_free
        Returns whether a text has room under a place of the axis across.
    gap
        Font sizes from the axes to the words.
    """
    box, size, is_drawn = plot.box, ink.size, rule is not None
    rows, columns = plot.up.ticks(box.height, apart[1]), plot.across.ticks(box.width, apart[0])
    shapes: list[Shape] = []
    left, y_words = box.x - mark - gap * size, box.bottom + mark + (gap + ASCENT) * size
    for value in rows:
        y = float(plot.y(value))
        y = y if is_drawn else round(y) + 0.5
        shapes.append(line((box.x, y), (box.right, y), ink.grid))
        words = plot.up.words(value, value == rows[-1])
        level = "capitals" if is_drawn else "line"
        shapes.append(Text(words, left, y, size, ink.quiet, align="right", level=level, are_digits_even=True))
    for value in columns:
        x, words = float(plot.x(value)), plot.across.words(value)
        if is_free is None or is_free(x, words):
            shapes.append(Text(words, x, y_words, size, ink.quiet, align="centre", are_digits_even=True))
    if rule is not None:
        shapes.append(Path(polyline([(box.x, box.y), (box.x, box.bottom), (box.right, box.bottom)]), pen=rule))
        shapes += [line((box.x - mark, y), (box.x, y), rule) for y in plot.y(np.array(rows)).tolist()]
        shapes += [line((x, box.bottom), (x, box.bottom + mark), rule) for x in plot.x(np.array(columns)).tolist()]
    return shapes
