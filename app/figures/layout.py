"""Where everything stands in a figure.  Lengths are in units of 1/96 inch, from the top left corner, y down."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from .description import Figure

PANEL = (560.0, 640.0)
"""The usual size of a panel with one view."""

VIEW_WIDTH = 400.0
"""The usual width of each view where a panel has several."""

WORDS = 128.0
"""What heading, hint and colour bar take of a panel's height."""

FONT = "DejaVu Sans"
HEADING, HINT, LABEL = 17.0, 13.0, 12.0
SMALLEST = 0.55
"""Text that does not fit becomes smaller, down to this share."""

LINE = 1.32
"""From line to line, in sizes of the text."""


@dataclass(frozen=True)
class Box:
    """A rectangle."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        return self.x + self.width

    @property
    def bottom(self) -> float:
        return self.y + self.height

    def snapped(self, scale: float) -> Box:
        """The box with its sides on whole pixels."""
        x, y = round(self.x * scale), round(self.y * scale)
        right, bottom = max(round(self.right * scale), x + 1), max(round(self.bottom * scale), y + 1)
        return Box(x / scale, y / scale, (right - x) / scale, (bottom - y) / scale)

    def pixels(self, scale: float) -> tuple[int, int, int, int]:
        """Left, top, width and height of a snapped box in pixels."""
        return tuple(round(side * scale) for side in (self.x, self.y, self.width, self.height))


@dataclass(frozen=True)
class Cell:
    """One panel: where its words stand, its views, and its colour bar."""

    box: Box
    views: tuple[Box, ...]
    hint: tuple[str, ...]
    heading_at: float
    hint_at: float
    bar: Box | None


@dataclass(frozen=True)
class Layout:
    """The page.

    scale: pixels per unit; page: the size the page has in pixels at that scale; stroke: by how much lines and marks
    are thinner than the style says, in narrow panels.
    """

    width: float
    height: float
    scale: float
    page: tuple[int, int]
    cells: tuple[Cell, ...]
    heading: float
    hint: float
    label: float
    shared_bar: Box | None
    stroke: float


def lay_out(figure: Figure, least_scale: float = 0.0) -> Layout:
    """The figure's layout, at its own resolution or at least at `least_scale`."""
    rows, columns = figure.grid
    views = max(len(p.views) for p in figure.panels)
    usual = _usual_size(figure.size.printed_width, rows, columns, views)
    across, down, own_scale = figure.size.pixels(usual)
    width, height = across / own_scale, down / own_scale
    scale = max(own_scale, least_scale)
    cell_width, cell_height = width / columns, height / rows
    # Narrow panels, as in a column of print, get smaller words; all panels the same.
    factor = min(max(cell_width / 420, 0.72), 1.0)
    room = cell_width - 12
    stroke = min(max(cell_width / views / 400, 0.5), 1.0)
    heading = _fitting([p.heading for p in figure.panels], HEADING * factor, room, bold=True)
    label = _fitting([f"{bar_words(p.label, p.unit)}, maximum 0.00000" for p in figure.panels], LABEL * factor, room)
    hints, hint = _hints([p.hint for p in figure.panels], HINT * factor, room)
    lines = max(len(h) for h in hints)
    head = (heading * LINE + 8 if any(p.heading for p in figure.panels) else 4) + lines * hint * LINE + 6
    bar_height = round(11 * factor)
    foot = bar_height + 2 * label * LINE + 18
    shared = figure.has_one_bar
    low = foot if shared else 0.0
    cell_height = (height - low) / rows
    below = 6.0 if shared or all(p.field is None for p in figure.panels) else foot
    cells = []
    for k, panel in enumerate(figure.panels):
        row, column = divmod(k, columns)
        box = Box(column * cell_width, row * cell_height, cell_width, cell_height)
        area = Box(box.x, box.y + head, box.width, max(box.height - head - below, 8.0))
        each = area.width / len(panel.views)
        boxes = tuple(Box(area.x + i * each, area.y, each, area.height).snapped(scale) for i in range(len(panel.views)))
        has_bar = panel.field is not None and not shared and panel.top > 0
        bar = _bar(box, area.bottom + 8, bar_height) if has_bar else None
        heading_at = box.y + 8 + heading
        cells.append(Cell(box, boxes, hints[k], heading_at, heading_at + hint * LINE + 2, bar))
    page = (across, down) if scale == own_scale else (round(width * scale), round(height * scale))
    shared_bar = _bar(Box(0, 0, width, height), height - foot + 8, bar_height) if shared else None
    return Layout(width, height, scale, page, tuple(cells), heading, hint, label, shared_bar, stroke)


def _usual_size(printed_width: float | None, rows: int, columns: int, views: int) -> tuple[float, float]:
    """The size of a page; where its width is given as printed, words keep their size and only the views shrink."""
    view_width = PANEL[0] if views == 1 else VIEW_WIDTH
    if printed_width is None:
        return columns * views * view_width, rows * PANEL[1]
    # Hints take a second line in narrow panels.
    words = WORDS * (0.85 if printed_width / columns < 350 else 1.0)
    view_height = printed_width / (columns * views) * (PANEL[1] - WORDS) / view_width
    return printed_width, rows * (words + view_height)


def bar_words(label: str, unit: str) -> str:
    """What stands at a colour bar."""
    return f"{label} ({unit})" if label and unit else label or unit


def _bar(box: Box, y: float, height: float) -> Box:
    width = min(0.62 * box.width, 420.0)
    return Box(box.x + (box.width - width) / 2, y, width, height)


def _fitting(texts: list[str], size: float, room: float, bold: bool = False) -> float:
    """The size at which the widest of the texts fits."""
    widest = max(text_width(text, size, bold) for text in texts)
    return size * max(min(1.0, room / widest), SMALLEST) if widest else size


def _hints(texts: list[str], size: float, room: float) -> tuple[list[tuple[str, ...]], float]:
    """The hints in one or two lines, and their size; none at all if they do not fit."""
    for factor in (1.0, 0.9, 0.8, 0.72):
        found = [wrapped(text, size * factor, room) for text in texts]
        if all(len(lines) <= 2 and all(text_width(x, size * factor) <= room for x in lines) for lines in found):
            return found, size * factor
    return [() for _ in texts], size


def wrapped(text: str, size: float, room: float) -> tuple[str, ...]:
    """The lines of a text of this size that are no wider than the room, as far as its words allow."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and text_width(longer, size) <= room:
            lines[-1] = longer
        else:
            lines.append(word)
    return tuple(lines)


def text_width(text: str, size: float, bold: bool = False) -> float:
    """Units a line of text takes at a size in units."""
    return _width(text, bold) * size / 100 if text else 0.0


@cache
def _width(text: str, bold: bool) -> float:
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(family=FONT, weight="bold" if bold else "normal", size=100)
    return float(text_to_path.get_text_width_height_descent(text, font, False)[0])
