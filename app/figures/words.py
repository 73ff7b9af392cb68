"""Words that fit their room: wrapped, then smaller, and at last shortened, but never beyond it."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from ..drawing.shapes import Shape, Text, opaque
from ..scene.style import Style
from .fonts import text_width

LEAST, LAST = 8.0, 20 / 3
"""Units: words become smaller down to 6 points, and where that is not enough and nothing is printed down to 5."""

ALMOST = 0.7
"""Down to this share of its size a text rather becomes smaller than it takes a second line."""

LINE = 1.28
"""Font sizes from line to line."""

_PARTS = re.compile(r"[^ ]+?[_/](?=[^ ])|[^ ]+")
"""Parts after which a line may end: at a space, an underscore or a slash, but not at a space that binds."""

BOUND = "\u00a0"
"""A space at which no line ends."""

Widths = Callable[[str, float], float]
"""Returns the width of a line of text at a size."""


@dataclass(frozen=True)
class Lettering:
    """The font of all words of a page.

    Attributes
    ----------
    family
        Its name, "" for the usual one.
    stays
        Whether the size is given, so that words do not become smaller to fit.
    is_printed
        Whether words are to be read on paper.
    """

    family: str = ""
    stays: bool = False
    is_printed: bool = False

    def width(self, text: str, size: float, bold: bool = False) -> float:
        """Return the width of a text, in the unit of its size."""
        return text_width(text, size, bold, self.family)

    def fitted(
        self, texts: list[str], size: float, room: float, most: int, bold: bool = False
    ) -> tuple[float, list[tuple[str, ...]]]:
        """Fit texts into at most `most` lines no wider than the room; return their common size, and their lines."""

        def wide(text: str, size: float) -> float:
            return self.width(text, size, bold)

        sizes = [size] if self.stays else _sizes(size, (LEAST,) if self.is_printed else (LEAST, LAST))
        for smaller in sizes:
            if smaller >= ALMOST * size and all(wide(text, smaller) <= room for text in texts):
                return smaller, [_plain((text,)) if text else () for text in texts]
        for smaller in sizes:
            found = [wrapped(text, smaller, room, wide) for text in texts]
            if all(len(lines) <= most and all(wide(x, smaller) <= room for x in lines) for lines in found):
                return smaller, [_plain(lines) for lines in found]
        return sizes[-1], [_plain(shortened(text, sizes[-1], room, most, wide)) for text in texts]


@dataclass(frozen=True)
class TextLines:
    """Lines of text about x, the first standing on y; with `turned` they run upwards, the first standing on x."""

    lines: tuple[str, ...]
    x: float
    y: float
    size: float
    is_bold: bool = False
    is_quiet: bool = False
    turned: bool = False

    def shapes(self, style: Style) -> list[Shape]:
        """Return a text for each line, in a style's colours."""
        colour = opaque(style.quiet_text if self.is_quiet else style.text)
        across, down = (LINE * self.size, 0.0) if self.turned else (0.0, LINE * self.size)
        return [
            Text(
                line,
                self.x + k * across,
                self.y + k * down,
                self.size,
                colour,
                self.is_bold,
                align="centre",
                angle=90.0 if self.turned else 0.0,
            )
            for k, line in enumerate(self.lines)
        ]


def _plain(lines: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(line.replace(BOUND, " ") for line in lines)


def _sizes(size: float, floors: tuple[float, ...]) -> list[float]:
    """Return sizes from the first down to the last."""
    found, step = [size], 0.94
    for floor in floors:
        while found[-1] > floor:
            found.append(max(found[-1] * step, floor))
    return found


def wrapped(text: str, size: float, room: float, wide: Widths = text_width) -> tuple[str, ...]:
    """Return the lines of a text that are no wider than the room, as far as its words allow."""
    lines: list[str] = []
    end = 0
    for part in _PARTS.finditer(text):
        longer = lines[-1] + text[end : part.end()] if lines else part[0]
        if lines and wide(longer, size) <= room:
            lines[-1] = longer
        else:
            lines.append(part[0])
        end = part.end()
    return tuple(lines)


def shortened(text: str, size: float, room: float, most: int, wide: Widths = text_width) -> tuple[str, ...]:
    """Return at most `most` lines no wider than the room; what is left out is an ellipsis."""
    lines: list[str] = []
    for line in wrapped(text, size, room, wide):
        while wide(line, size) > room and len(line) > 1:
            count = next((k for k in range(len(line) - 1, 1, -1) if wide(line[:k], size) <= room), 1)
            lines.append(line[:count])
            line = line[count:]
        lines.append(line)
    if len(lines) > most:
        last = lines[most - 1]
        while last and wide(f"{last}…", size) > room:
            last = last[:-1].rstrip()
        lines[most - 1 :] = [f"{last}…"]
    return tuple(line for line in lines if wide(line, size) <= room)
