"""What matplotlib draws of a page: words, colour bars, marks and frames over pixels, or the whole page as vectors.

Both come from the same commands, in units of the page.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from ..drawing.bands import band_edges, bar_parts, beyond
from ..drawing.field_actor import BOLD, half_steps
from ..drawing.style import Colour
from .description import Figure, FigurePanel
from .layout import FONT, Box, Cell, Layout, bar_words, text_width, wrapped
from .shots import Line, Shot
from .simplified import simplified

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas
    from matplotlib.path import Path


POINT = 0.75
"""Points in a unit."""

FINENESS = 0.03
"""Units by which a curve may differ from its exact course to need fewer points."""

EDGE_FINENESS = 0.1
"""The same for the edge of the shape, which is found from pixels."""


@dataclass(frozen=True, eq=False)
class Composition:
    """A figure, where everything stands, and its pictures in the order in which they lie on each other."""

    figure: Figure
    layout: Layout
    shots: list[Shot]


@contextmanager
def matplotlib_settings() -> Iterator[None]:
    """matplotlib as it is delivered, whatever the user's settings, and files that are equal when drawn again."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(
            {
                "font.family": FONT,
                "text.parse_math": False,
                "svg.fonttype": "none",
                "svg.hashsalt": "bihdist",
                "pdf.fonttype": 42,
                "path.simplify": False,
                "image.composite_image": False,
            }
        )
        yield


def drawn(page: Composition, vector: bool, shots: bool = True, words: bool = True) -> Canvas:
    """The page in matplotlib; not `vector`: for pixels, which its pictures' own become as they are.

    shots, words: whether there are the pictures and what lies on them, and what stands beside them.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    layout = page.layout
    # matplotlib cuts fractions of pixels off: a page a hair larger keeps its last row and column.
    more = 0.0 if vector else 0.01 / layout.scale
    width, height = (layout.width, layout.height) if vector else (side / layout.scale + more for side in layout.page)
    ground = "none" if vector or not shots or page.figure.transparent else page.figure.style.background
    canvas = Canvas(figsize=(width / 96, height / 96), dpi=96 * layout.scale, facecolor=ground)
    FigureCanvasAgg(canvas)
    axes = canvas.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, width)
    axes.set_ylim(height, 0)
    axes.axis("off")
    for number, shot in enumerate(page.shots if shots else ()):
        _draw_shot(axes, page, number, shot, vector)
    if words:
        _draw_words(axes, page)
    return canvas


# ---------------------------------------------------------------------- pictures
def _draw_shot(axes: Axes, page: Composition, number: int, shot: Shot, vector: bool) -> None:
    from matplotlib.patches import Rectangle
    from matplotlib.transforms import TransformedPath

    style, order, stroke = page.figure.style, 10 * number, page.layout.stroke
    frame = Rectangle((shot.box.x, shot.box.y), shot.box.width, shot.box.height, linewidth=0, zorder=order)
    frame.set_facecolor(style.background if shot.source is not None else "none")
    axes.add_artist(frame)
    _draw_image(axes, page, shot, order + 1, vector)
    edge = _silhouette(shot, page.layout.scale)
    # One object for all curves: it is then written once.
    shape = edge and TransformedPath(edge, axes.transData)
    signed, top = page.figure.panels[shot.panel].signed, page.figure.tops()[shot.panel]
    for k, (value, lines) in enumerate(shot.isolines):
        width = style.isoline_width * stroke * (BOLD if signed and value == 0 else 1)
        line = style.line(signed, value / top if top > 0 else 0.0)
        curve = _curve(lines, line, width, "butt", order + 2, f"isoline-{number}-{k}")
        axes.add_artist(curve)
        # The stroke is cut where the shape ends, which its middle line does already.
        curve.set_clip_path(shape)
    if shot.outlines:
        curve = _curve(
            shot.outlines, style.outline_colour, style.outline * stroke, "round", order + 3, f"outline-{number}"
        )
        axes.add_artist(curve)
        curve.set_clip_path(frame)
    _draw_marks(axes, page, shot, order + 4, frame)
    if shot.source is not None:
        _draw_frames(axes, shot, style.quiet_text, order + 5)


def _draw_image(axes: Axes, page: Composition, shot: Shot, order: int, vector: bool) -> None:
    """The shaded pixels on their background, without the empty rows and columns around them."""
    from matplotlib.image import AxesImage

    alpha = shot.image[..., 3]
    rows, columns = np.flatnonzero(alpha.any(axis=1)), np.flatnonzero(alpha.any(axis=0))
    if not len(rows):
        return
    part = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    pixels = _on(None if page.figure.transparent else page.figure.style.background, shot.image[part])
    if not vector:
        x, y, _, _ = shot.box.pixels(page.layout.scale)
        axes.add_artist(_pixels_artist()(pixels, x + int(columns[0]), y + int(rows[0]), order))
        return
    per_x, per_y = shot.box.width / alpha.shape[1], shot.box.height / alpha.shape[0]
    left, right = shot.box.x + columns[0] * per_x, shot.box.x + (columns[-1] + 1) * per_x
    top, bottom = shot.box.y + rows[0] * per_y, shot.box.y + (rows[-1] + 1) * per_y
    image = AxesImage(axes, origin="upper", interpolation="none", extent=(left, right, bottom, top), zorder=order)
    image.set_data(pixels if page.figure.transparent else pixels[..., :3])
    axes.add_artist(image)


@cache
def _pixels_artist() -> type:
    """The class of pixels that are put on a page of pixels as they are: matplotlib is imported late."""
    from matplotlib.artist import Artist

    class Pixels(Artist):
        def __init__(self, pixels: np.ndarray, left: int, top: int, order: int) -> None:
            super().__init__()
            self.set_zorder(order)
            self._pixels, self._left, self._top = pixels, left, top

        def draw(self, renderer) -> None:
            # matplotlib counts rows from below.
            low = int(renderer.height) - self._top - len(self._pixels)
            renderer.draw_image(renderer.new_gc(), self._left, low, self._pixels[::-1])

    return Pixels


def _on(background: Colour | None, image: np.ndarray) -> np.ndarray:
    """Pixels (h, w, 4) whose colours are multiplied by alpha: the same on a background, or straight.

    On a background without transparency: some readers blend the edge of the shape with what lies unseen beside it.
    """
    result = np.empty_like(image)
    paper = np.round(255 * np.array(background or (0, 0, 0))).astype(np.uint16)
    # By rows: a whole picture in wider numbers would take several times its memory.
    for row, into in zip(image, result, strict=True):
        colours, alpha = row[:, :3].astype(np.uint16), row[:, 3:].astype(np.uint16)
        if background is None:
            into[:, :3] = np.minimum((colours * 255 + alpha // 2) // np.maximum(alpha, 1), 255)
            into[:, 3] = row[:, 3]
        else:
            into[:, :3] = np.minimum(colours + (paper * (255 - alpha) + 127) // 255, 255)
            into[:, 3] = 255
    return result


def _curve(lines: list[Line], colour: Colour, width: float, cap: str, order: int, name: str):
    """Parts of one curve as one path."""
    from matplotlib.patches import PathPatch

    rings = [(simplified(np.concatenate([p, p[:1]]) if closed else p, FINENESS), closed) for p, closed in lines]
    return PathPatch(
        _path(rings),
        fill=False,
        edgecolor=colour,
        linewidth=width * POINT,
        capstyle=cap,
        joinstyle="round",
        zorder=order,
        gid=name,
    )


def _path(rings: list[Line]) -> Path:
    """Lines (k, 2) as one path; a closed one ends with its first point."""
    from matplotlib.path import Path

    codes = [[Path.MOVETO, *[Path.LINETO] * (len(p) - 2), Path.CLOSEPOLY if c else Path.LINETO] for p, c in rings]
    return Path(np.concatenate([p for p, _ in rings]), np.concatenate(codes))


def _silhouette(shot: Shot, scale: float) -> Path | None:
    """The edge of the shape in the picture, between its pixels."""
    from contourpy import contour_generator

    alpha = np.pad(shot.image[..., 3].astype(np.float32), 1)
    if not alpha.any():
        return None
    at = [(np.arange(-1, side + 1) + 0.5) / scale for side in shot.image.shape[1::-1]]
    loops = contour_generator(at[0] + shot.box.x, at[1] + shot.box.y, alpha).lines(127.5)
    return _path([(simplified(loop, EDGE_FINENESS), True) for loop in loops if len(loop) > 3])


def _draw_marks(axes: Axes, page: Composition, shot: Shot, order: int, frame) -> None:
    from matplotlib.patches import Circle

    style, panel = page.figure.style, page.figure.panels[shot.panel]
    top = page.figure.tops()[shot.panel]
    radius = style.marker_size / 2 * page.layout.stroke
    for k, x, y in shot.marks:
        mark = panel.marks[k]
        colour = style.largest if mark.is_largest else style.source
        if mark.value is not None:
            colour = style.colour_of(mark.value, top, panel.signed)
        circle = Circle(
            (x, y),
            radius,
            facecolor=colour,
            edgecolor=style.mark_edge,
            linewidth=1.1 * page.layout.stroke * POINT,
            zorder=order,
        )
        axes.add_artist(circle)
        if shot.source is not None:
            circle.set_clip_path(frame)
        if mark.text:
            size = page.layout.label
            _write(axes, mark.text, x + radius + 3, y + 0.35 * size, size, style.text, "left", order + 1)


def _draw_frames(axes: Axes, shot: Shot, colour, order: int) -> None:
    """Around what an inset enlarges, around the inset, and two lines that join them."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Rectangle

    boxes = (shot.source, shot.box)
    for box in boxes:
        axes.add_artist(
            Rectangle(
                (box.x, box.y), box.width, box.height, fill=False, edgecolor=colour, linewidth=POINT, zorder=order
            )
        )
    for a, b in zip(*([(x, y) for x in (b.x, b.right) for y in (b.y, b.bottom)] for b in boxes), strict=True):
        way = [(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])) for t in np.linspace(0.01, 0.99, 60)]
        if not any(box.x < x < box.right and box.y < y < box.bottom for x, y in way for box in boxes):
            axes.add_artist(Line2D(*zip(a, b, strict=True), color=colour, linewidth=0.6 * POINT, zorder=order))


# ---------------------------------------------------------------------- words and bars
def _draw_words(axes: Axes, page: Composition) -> None:
    layout, style = page.layout, page.figure.style
    tops = page.figure.tops()
    for panel, cell, top in zip(page.figure.panels, layout.cells, tops, strict=True):
        middle = cell.box.x + cell.box.width / 2
        _write(axes, panel.heading, middle, cell.heading_at, layout.heading, style.text, bold=True)
        for k, line in enumerate(cell.hint):
            _write(axes, line, middle, cell.hint_at + k * 1.32 * layout.hint, layout.hint, style.quiet_text)
        if panel.failure:
            _draw_failure(axes, page, panel.failure, cell)
        if cell.bar:
            _draw_bar(axes, page, cell.bar, top, bar_words(panel.label, panel.unit), panel)
    if layout.shared_bar:
        shown = [p for p in page.figure.panels if p.field is not None]
        labels = {p.label for p in shown}
        label = labels.pop() if len(labels) == 1 else "distance"
        if page.figure.range == "shares":
            _draw_bar(axes, page, layout.shared_bar, 100.0, "% of each maximum", replace(shown[0], field=None))
        else:
            _draw_bar(axes, page, layout.shared_bar, max(tops), bar_words(label, shown[0].unit), shown[0])


def _draw_failure(axes: Axes, page: Composition, failure: str, cell: Cell) -> None:
    """Why there is no field, in lines on the shape."""
    from matplotlib.patches import Rectangle

    style, size = page.figure.style, page.layout.label * 1.1
    area = Box(cell.views[0].x, cell.views[0].y, cell.views[-1].right - cell.views[0].x, cell.views[0].height)
    lines = wrapped(failure, size, 0.8 * area.width)
    step, middle = 1.35 * size, area.y + area.height / 2
    wide = max(text_width(line, size) for line in lines) + 2 * size
    high = len(lines) * step + size
    ground = Rectangle((area.x + (area.width - wide) / 2, middle - high / 2), wide, high, linewidth=0, zorder=999)
    ground.set_facecolor((*style.background, 0.88))
    axes.add_artist(ground)
    for k, line in enumerate(lines):
        y = middle - high / 2 + 0.5 * size + (k + 0.78) * step
        _write(axes, line, area.x + area.width / 2, y, size, style.text)


def _draw_bar(axes: Axes, page: Composition, bar: Box, top: float, words: str, panel: FigurePanel) -> None:
    """A colour bar from 0, or from -top, to top."""
    from matplotlib.patches import Rectangle

    style, size, signed = page.figure.style, page.layout.label, panel.signed
    goes_beyond = (False, False)
    if style.coloured:
        parts = bar_parts(style, band_edges(panel.isolines, top, signed), signed)
        goes_beyond = beyond(panel.field, top, signed)
        for is_there, way, (_, colour) in zip(goes_beyond, (-1, 1), (parts[0], parts[-1]), strict=True):
            if is_there:
                _draw_point(axes, bar, way, colour)
        for start, colour in parts:
            left = bar.x + start * bar.width
            # Each runs to the end of the bar, under the next ones: side by side they would show seams.
            axes.add_artist(Rectangle((left, bar.y), bar.right - left, bar.height, facecolor=colour, linewidth=0))
    count = panel.isolines.count
    steps = 2 * half_steps(count) if signed else count
    step = bar.width / steps if count else 0.0
    if step >= 4:
        for k in range(1, steps):
            width = min(style.isoline_width * page.layout.stroke, step / 4)
            width *= BOLD if signed and 2 * k == steps else 1
            line = style.line(signed, 2 * k / steps - 1)
            _stroke(axes, bar.x + k * step, bar.y, bar.y + bar.height, line, width)
    if not style.coloured:
        axes.add_artist(
            Rectangle((bar.x, bar.y), bar.width, bar.height, fill=False, edgecolor=style.text, linewidth=0.8 * POINT)
        )
    low = -top if signed else 0.0
    for value in ticks(top, low):
        x = bar.x + bar.width * (value - low) / (top - low)
        _stroke(axes, x, bar.bottom, bar.bottom + 3, style.quiet_text, 0.8)
        _write(axes, f"{value:.6g}", x, bar.bottom + 4 + size, size, style.text)
    middle = bar.x + bar.width / 2
    end = f"maximum {panel.own_top or top:.4g}" if any(goes_beyond) else f"maximum {top:.4g}"
    if signed and panel.field is not None:
        vertex = int(np.nanargmax(np.abs(panel.field)))
        end = f"largest {panel.field[vertex]:+.4g} at vertex {vertex}"
    words = f"{words}, {end}" if words else end
    _write(axes, words, middle, bar.bottom + 5 + 2.25 * size, size, style.quiet_text)


def _draw_point(axes: Axes, bar: Box, way: int, colour: Colour) -> None:
    """A colour bar with values beyond its lower (-1) or upper end (1) has a point there."""
    from matplotlib.patches import Polygon

    x = bar.right if way > 0 else bar.x
    corners = [(x - way, bar.y), (x, bar.y), (x + 0.7 * way * bar.height, bar.y + bar.height / 2), (x, bar.bottom)]
    axes.add_artist(Polygon([*corners, (x - way, bar.bottom)], facecolor=colour, linewidth=0))


def ticks(top: float, low: float = 0.0) -> list[float]:
    """Round numbers from `low` to `top`, for a colour bar."""
    from matplotlib.ticker import MaxNLocator

    values = MaxNLocator(nbins=5, steps=[1, 2, 2.5, 5, 10]).tick_values(low, top)
    return [float(v) for v in values if low * (1 + 1e-9) <= v <= top * (1 + 1e-9)]


def _stroke(axes: Axes, x: float, top: float, bottom: float, colour, width: float) -> None:
    from matplotlib.lines import Line2D

    axes.add_artist(Line2D([x, x], [top, bottom], color=colour, linewidth=width * POINT, solid_capstyle="butt"))


def _write(
    axes: Axes,
    text: str,
    x: float,
    y: float,
    size: float,
    colour,
    side: str = "center",
    order: int = 1000,
    bold: bool = False,
) -> None:
    """A line of text standing on y."""
    if text:
        weight = "bold" if bold else "normal"
        axes.text(x, y, text, ha=side, va="baseline", size=size * POINT, color=colour, weight=weight, zorder=order)
