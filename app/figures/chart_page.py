"""The page of a chart's figure, and its file."""

import os
from collections.abc import Callable
from typing import Any

from bihdist_core import OutputError
from bihdist_core.file_output import atomic_write, check_output
from bihdist_core.progress import Progress

from ..drawing.painters.mpl import paint
from .canvas import blank_page, matplotlib_settings
from .chart_look import Chart
from .draw import FIGURE_FORMATS
from .fonts import check_font
from .page_output import write_undated
from .size import UNITS_PER_INCH

PIXELS_PER_INCH = 300


def draw_chart(save: Callable[[Any, str], None], figure: object, path: str, progress: Progress | None = None) -> None:
    """Save a figure as a job does, too quickly to report any progress."""
    save(figure, path)


def save_chart(path: str | os.PathLike[str], chart: Chart, height: float) -> None:
    """Write a chart on a page of a height in units to a .png, .pdf, .svg or .eps file, whole or not at all.

    Raises
    ------
    ParameterError
        If there is no such font.
    OutputError
        If the file cannot be written.
    """
    extension, look = check_output(path, FIGURE_FORMATS), chart.look
    check_font(look.font)
    with atomic_write(path) as temporary, matplotlib_settings(look.font):
        try:
            page = (look.inches, height / UNITS_PER_INCH), (look.width, height)
            figure, axes = blank_page(*page, PIXELS_PER_INCH, look.style.background)
            paint(axes, chart.shapes(height), is_opaque=extension == ".eps")
            made: dict[str, Any] = {".png": {"Software": None}}.get(extension, {"Creator": "bihdist"})
            write_undated(figure, temporary, made, facecolor=look.style.background)
        except ValueError as error:  # matplotlib's word for a page it cannot make
            raise OutputError(f"{path} could not be written: {error}.") from error
