"""What stands beside the pictures of a page: words, and colour bars with their isolines and ticks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..scene.bands import band_edges, bar_parts
from ..scene.field_actor import CASING
from ..scene.levels import BOLD, levels
from ..scene.style import RGBA, RIM, Colour
from .bars import TICK, Bar
from .boxes import Box, Words
from .glyphs import POINT
from .layout import Cell
from .words import LINE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .canvas import Composition

LINE_ROOM, END_ROOM = 4.0, 1.5
"""Units from one isoline on a colour bar to the next, and to an end of the bar, at least."""


def draw_words(axes: Axes, page: Composition) -> None:
    """All of it."""
    layout = page.layout
    for panel, cell in zip(page.figure.panels, layout.cells, strict=True):
        for words in cell.words:
            write(axes, page, words)
        if panel.failure:
            _draw_failure(axes, page, panel.failure, cell)
        if cell.bar:
            _draw_bar(axes, page, cell.bar)
    if layout.shared_bar:
        _draw_bar(axes, page, layout.shared_bar)


def _draw_failure(axes: Axes, page: Composition, failure: str, cell: Cell) -> None:
    """Why there is no field, in lines on the shape."""
    from matplotlib.patches import Rectangle

    style = page.figure.style
    area = Box(cell.views[0].x, cell.views[0].y, cell.views[-1].right - cell.views[0].x, cell.views[0].height)
    most = max(int(0.9 * area.height / (LINE * page.layout.label) - 1), 1)
    size, (lines,) = page.layout.lettering.fitted([failure], page.layout.label, 0.9 * area.width, most)
    if not lines:
        return
    wide = max(page.layout.lettering.width(line, size) for line in lines) + size
    high = (len(lines) - 1) * LINE * size + 1.9 * size
    x, y = area.middle
    ground = Rectangle((x - wide / 2, y - high / 2), wide, high, linewidth=0, zorder=999)
    ground.set_facecolor((*style.background, 1.0 if page.is_opaque else 0.88))
    axes.add_artist(ground)
    write(axes, page, Words(lines, x, y - high / 2 + 1.3 * size, size))


def _draw_bar(axes: Axes, page: Composition, bar: Bar) -> None:
    """A colour bar with its isolines, ticks and words."""
    from matplotlib.collections import PolyCollection
    from matplotlib.patches import Rectangle

    style, panel, box = page.figure.style, page.figure.panels[bar.panel], bar.box
    signed = panel.signed
    if style.coloured:
        # Where bars are in fractions of the maximum, what is drawn still ends there.
        top = page.figure.tops()[bar.panel]
        parts = bar_parts(style, band_edges(panel.isolines, top, signed), signed)
        for is_there, way, (_, colour) in zip(bar.goes_beyond, (-1, 1), (parts[0], parts[-1]), strict=True):
            if is_there:
                _draw_point(axes, box, bar.is_upright, way, colour)
        # Each runs to the end of the bar, under the next ones: side by side they would show seams.
        rests = [(1 - start) * (box.height if bar.is_upright else box.width) for start, _ in parts]
        ends = [(box.right, box.y + rest) if bar.is_upright else (box.right - rest, box.bottom) for rest in rests]
        low = (box.x, box.y) if bar.is_upright else (box.right, box.y)
        corners = [[low, (x, low[1]), (x, y), (low[0], y)] for x, y in ends]
        axes.add_artist(PolyCollection(corners, facecolors=[colour for _, colour in parts], linewidths=0))
    _draw_lines_on_bar(axes, page, bar)
    if not style.coloured:
        axes.add_artist(
            Rectangle((box.x, box.y), box.width, box.height, fill=False, edgecolor=style.text, linewidth=0.8 * POINT)
        )
    thick = box.width if bar.is_upright else box.height
    for value in bar.ticks:
        _across(axes, bar, value, (1, 1 + TICK / thick), style.quiet_text, 0.8 * max(page.layout.stroke, 0.7))
    for words in bar.texts:
        write(axes, page, words)


def _across(axes: Axes, bar: Bar, value: float, part: tuple[float, float], colour: Colour | RGBA, width: float) -> None:
    """A line across a bar at a value; part: from where to where, as shares of the bar's thickness."""
    from matplotlib.lines import Line2D

    at, box = bar.place(value), bar.box
    look: dict[str, Any] = {"color": colour, "linewidth": width * POINT, "solid_capstyle": "butt"}
    if bar.is_upright:
        axes.add_artist(Line2D([box.x + share * box.width for share in part], [at, at], **look))
    else:
        axes.add_artist(Line2D([at, at], [box.y + share * box.height for share in part], **look))


def _draw_point(axes: Axes, box: Box, is_upright: bool, way: int, colour: Colour) -> None:
    """A colour bar with values beyond its lower (-1) or upper end (1) has a point there."""
    from matplotlib.patches import Polygon

    x, y, thick = (box.x if way < 0 else box.right), *((box.y, box.height) if not is_upright else (0.0, 0.0))
    corners = [(x - way, y), (x, y), (x + 0.7 * way * thick, y + thick / 2), (x, y + thick), (x - way, y + thick)]
    if is_upright:
        y, thick = (box.bottom if way < 0 else box.y), box.width
        x = box.x
        corners = [(x, y + way), (x, y), (x + thick / 2, y - 0.7 * way * thick), (x + thick, y), (x + thick, y + way)]
    axes.add_artist(Polygon(corners, facecolor=colour, linewidth=0))


def _draw_lines_on_bar(axes: Axes, page: Composition, bar: Bar) -> None:
    """The isolines' values, unless they would be too close; those through points always."""
    style, panel, stroke = page.figure.style, page.figure.panels[bar.panel], page.layout.stroke
    top = page.figure.tops()[bar.panel]
    found = levels(panel.isolines, top, top, panel.signed, panel.through)
    low = -top if panel.signed else 0.0
    shares = (found.values - low) / (top - low) if top > 0 else found.values
    usual, long = shares[~found.is_through], bar.box.height if bar.is_upright else bar.box.width
    room = float(np.diff(usual).min(initial=1.0)) * long
    for share, value, bold, through in zip(shares, found.values, found.is_bold, found.is_through, strict=True):
        # Where bars are in fractions of the maximum, they do not end there.
        at, width = bar.low + share * (bar.high - bar.low), style.isoline_width * stroke
        if not through and min(share, 1 - share) * long < END_ROOM:
            continue
        if through:
            _across(axes, bar, at, (0, 1), style.mark_edge, BOLD * width + 2 * CASING * stroke)
            _across(axes, bar, at, (0, 1), style.source, BOLD * width)
        elif room >= LINE_ROOM:
            width = min(width, room / 4) * (BOLD if bold else 1)
            rim = style.rim(panel.signed, value)
            if rim is not None:
                _across(axes, bar, at, (0, 1), rim, width + 2 * min(RIM * stroke, room / 8))
            _across(axes, bar, at, (0, 1), style.line(panel.signed, value / top), width)


def write(axes: Axes, page: Composition, words: Words, order: int = 1000) -> None:
    """Words where the layout has put them; order: what they lie over."""
    style = page.figure.style
    look: dict[str, Any] = {
        "ha": "center",
        "va": "baseline",
        "size": words.size * POINT,
        "color": style.quiet_text if words.is_quiet else style.text,
        "weight": "bold" if words.is_bold else "normal",
        "zorder": order,
    }
    for k, line in enumerate(words.lines):
        step = k * LINE * words.size
        if words.turned:
            axes.text(words.x + step, words.y, line, rotation=90, rotation_mode="anchor", **look)
        else:
            axes.text(words.x, words.y + step, line, **look)
