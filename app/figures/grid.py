"""The size of a page, and its rows and columns of panels."""

from __future__ import annotations

from dataclasses import dataclass

from .description import Figure
from .size import UNITS_PER_INCH

PANEL = (560.0, 640.0)
"""The usual size of a panel with one view."""

VIEW_WIDTH = 400.0
"""The usual width of each view where a panel has several."""

VIEW_HEIGHT = 512.0
"""The usual height of views."""

NARROWEST = 100.0
"""Units of a panel's width, 26 mm, below which there are rather more rows."""

MOST_IN_A_ROW = 4


@dataclass(frozen=True)
class Grid:
    """The page before its panels are laid out, in units.

    Attributes
    ----------
    height
        None if it follows from the panels.
    scale
        Pixels per unit.
    pixels
        Size of the page in pixels, None for a height that follows.
    is_printed
        Whether units are those of paper.
    chart
        Columns that a chart at the end of a row is wide.
    """

    rows: int
    columns: int
    width: float
    height: float | None
    scale: float
    pixels: tuple[int, int | None]
    is_printed: bool
    chart: float = 0.0

    @property
    def column(self) -> float:
        """The usual width of a column, of which the chart has its share."""
        return self.width / (self.columns + self.chart)


def grid_of(figure: Figure) -> Grid:
    """Return the page that a figure's size says."""
    size = figure.size
    dpi = size.resolution
    if size.width is not None and size.height is not None:
        columns = _fullest(figure, size.width / size.height)
    elif size.width is None or dpi is None:
        columns = _columns(figure, size.width)
    else:
        columns = _columns(figure, size.pixels_of(size.width) * UNITS_PER_INCH / dpi)
    rows = -(-len(figure.panels) // columns)
    wide = view_width(figure) * most_views(figure)
    chart = PANEL[0] / wide if figure.charts else 0.0
    usual = (columns + chart) * wide, rows * PANEL[1]
    across, down, scale = size.pixels(usual)
    is_free = size.height is None and size.width is not None and (dpi is not None or across < usual[0])
    return Grid(
        rows,
        columns,
        across / scale,
        None if is_free else down / scale,
        scale,
        (across, None if is_free else down),
        dpi is not None,
        chart,
    )


def most_views(figure: Figure) -> int:
    """Return the largest number of views that a panel of the figure has."""
    return max(len(panel.views) for panel in figure.panels)


def view_width(figure: Figure) -> float:
    """Return the usual width of a view."""
    return PANEL[0] if most_views(figure) == 1 else VIEW_WIDTH


def _columns(figure: Figure, width: float | None) -> int:
    """Return as many columns as are asked for, or as a page of this width has room for."""
    count = len(figure.panels)
    if figure.columns is not None:
        return min(figure.columns, count)
    if width is None:
        return count
    most = max(int(width / (NARROWEST * most_views(figure) ** 0.5)), 1)
    rows = -(-count // min(most, MOST_IN_A_ROW))
    return -(-count // rows)


def _fullest(figure: Figure, aspect: float) -> int:
    """Return the number of columns with which panels are largest on a page of this width / height."""
    count = len(figure.panels)
    if figure.columns is not None:
        return min(figure.columns, count)
    wide = view_width(figure) * most_views(figure)

    def room(columns: int) -> float:
        return min(aspect / (columns * wide), 1 / (-(-count // columns) * PANEL[1]))

    rows = (-(-count // columns) for columns in range(count, 0, -1))
    return max((-(-count // each) for each in rows), key=room)
