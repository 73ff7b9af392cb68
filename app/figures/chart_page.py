"""What the figures of all charts have in common: a page in the style and the letters of other figures, and its file."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from bihdist_core import OutputError
from bihdist_core.progress import Progress, silent
from bihdist_core.whole_file import check_output, whole_file

from ..document.page import Page
from ..scene.style import PAPER, Style
from .canvas import matplotlib_settings
from .draw import FIGURE_FORMATS
from .fonts import check_font
from .size import MM_PER_INCH, Size

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INCHES = 5.5
"""As wide as the text of most papers."""

POINTS = 8.0
"""The size of all letters, if nothing is said."""

PIXELS_PER_INCH = 300

RULE, TICK = 0.6, 2.5
"""Points that an axis is wide, and its ticks long."""

RIM = 3.0
"""Points that words keep from the edge of the page."""

FAINT = 0.25
"""How much of their colour the lines of a grid have."""


@dataclass(frozen=True)
class ChartLook:
    """inches: across; points: of the letters; font: a family, "" for the usual one."""

    style: Style = PAPER
    font: str = ""
    inches: float = INCHES
    points: float = POINTS

    @classmethod
    def of(cls, page: Page, style: Style, inches: float = INCHES) -> ChartLook:
        """As other figures on a page; inches: where the page says no width on paper."""
        size = Size.parse(page.size) if page.size else Size()
        across = size.width / MM_PER_INCH if size.unit == "mm" and size.width else inches
        return cls(style, page.font, across, page.text or POINTS)


USUAL_LOOK = ChartLook()


def faded(style: Style, share: float) -> list[float]:
    """The colour of quiet text with only a share of its contrast; EPS knows no transparency."""
    return [share * a + (1 - share) * b for a, b in zip(style.quiet_text, style.background, strict=True)]


def save_chart(
    path: str | os.PathLike[str],
    look: ChartLook,
    high: float,
    draw: Callable[[Figure], None],
    progress: Progress | None = None,
) -> None:
    """Let `draw` fill a page so many inches high, into a .png, .pdf, .svg or .eps file, whole or not at all.

    Raises ParameterError where there is no such font; OutputError if it cannot be written.
    """
    extension = check_output(path, FIGURE_FORMATS)
    check_font(look.font)
    (progress or silent)(0.0, "drawing the chart")
    with whole_file(path) as temporary, matplotlib_settings(look.font):
        try:
            _write(temporary, extension, look, high, draw)
        except ValueError as error:  # matplotlib's word for a page it cannot make
            raise OutputError(f"{path} could not be written: {error}.") from error


def _write(path: Path, extension: str, look: ChartLook, high: float, draw: Callable[[Figure], None]) -> None:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    ground = look.style.background
    figure = Figure((look.inches, high), PIXELS_PER_INCH, facecolor=ground, layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure)
    _keep_on_page(figure)
    # Nothing in the file says when it was made, so that it is equal when made again.
    dates = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}, ".png": {"Software": None}}.get(extension, {})
    made = {} if extension == ".png" else {"Creator": "bihdist"}
    figure.savefig(path, metadata={**made, **dates}, facecolor=ground)
    if extension == ".eps":
        content = path.read_bytes()
        path.write_bytes(re.sub(rb"^%%(CreationDate|Title):[^\n]*\n", b"", content, count=2, flags=re.MULTILINE))


def _keep_on_page(figure: Figure) -> None:
    """Words at an axis that are longer than it is move along it where they would leave the page."""
    if (engine := figure.get_layout_engine()) is not None:
        engine.execute(figure)
    rim = RIM / 72 * figure.dpi
    for axes in figure.axes:
        room = axes.get_window_extent()
        for axis, ends, length, page in (
            (axes.xaxis, "intervalx", room.width, figure.bbox.width),
            (axes.yaxis, "intervaly", room.height, figure.bbox.height),
        ):
            low, high = getattr(axis.label.get_window_extent(), ends)
            moved = max(rim - low, 0.0) - max(high - (page - rim), 0.0)
            if moved and high > low:
                axis.label.set(**{ends[-1]: 0.5 + moved / length})


def style_axes(axes: Axes, look: ChartLook, across: str = "", up: str = "") -> None:
    """Axes at the left and below, round numbers with true minus signs, quiet lines; across, up: words at the axes."""
    from matplotlib.ticker import FuncFormatter

    style, points = look.style, look.points
    axes.set_facecolor(style.background)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(style.quiet_text)
        axes.spines[side].set_linewidth(RULE)
    # Mixed, not transparent, which EPS cannot be.
    quiet = faded(style, FAINT)
    axes.grid(axis="y", color=quiet, linewidth=0.5)
    axes.set_axisbelow(True)
    axes.tick_params(labelsize=points, colors=style.quiet_text, width=RULE, length=TICK)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.6g}".replace("-", "−")))
    if across:
        axes.set_xlabel(across, fontsize=points, color=style.text)
    if up:
        axes.set_ylabel(up, fontsize=points, color=style.text)
