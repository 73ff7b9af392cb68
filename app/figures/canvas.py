"""A page drawn by matplotlib: words, colour bars, marks and frames over pixels, or the whole page as vectors.

Both come from the same commands, in units of the page.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from bihdist_core.arrays import ByteArray, FloatArray

from ..drawing.painters.mpl import POINT, paint
from ..drawing.shapes import RGBA
from ..scene.levels import BOLD, width_of
from ..scene.line_clipping import Line
from ..scene.style import Colour
from .captions import caption_shapes, cross_shapes, scale_shapes
from .fonts import families, has_cff_outlines
from .isoline_labels import label_shapes
from .legend import legend_shapes
from .marks import frame_shapes, mark_shapes
from .page_layout import ComposedPage
from .shots import Shot

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Canvas
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path


FINENESS = 0.03
"""Units by which a curve may differ from its exact course to need fewer points."""

DOT = 0.05
"""Widths that a dot of a dotted line is long, besides its round ends; without any length PNG shows none."""

EDGE_FINENESS = 0.1
"""Units by which the edge of the shape may differ from its course between pixels."""


@contextmanager
def matplotlib_settings(font: str = "") -> Iterator[None]:
    """Use matplotlib's own settings, not the user's, and write files that are equal when drawn again."""
    import matplotlib

    # As type 42, which is for TrueType, PDF viewers warn of CFF outlines, and PostScript's refuse them.
    font_type = 3 if has_cff_outlines(font) else 42
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(
            {
                "font.family": families(font),
                "text.parse_math": False,
                "text.hinting": "none",  # letters are as wide on every page
                "svg.fonttype": "none",
                "svg.hashsalt": "bihdist",
                "pdf.fonttype": font_type,
                "ps.fonttype": font_type,
                "path.simplify": False,
                "image.composite_image": False,
            }
        )
        yield


def drawn(page: ComposedPage, vector: bool, shots: bool = True, words: bool = True) -> Canvas:
    """Draw a page by matplotlib.

    Parameters
    ----------
    vector
        Draw vectors, rather than for pixels among which those of the pictures stay as they are.
    shots, words
        Whether to draw the pictures with what lies on them, and the words and bars beside them.
    """
    layout = page.layout
    # matplotlib cuts fractions of pixels off: a page a hair larger keeps its last row and column.
    more = 0.0 if vector else 0.01 / layout.scale
    width, height = (layout.width, layout.height) if vector else (side / layout.scale + more for side in layout.page)
    ground = "none" if vector or not shots or page.figure.transparent else page.figure.style.background
    canvas, axes = blank_page((width / 96, height / 96), (width, height), 96 * layout.scale, ground)
    for number, shot in enumerate(page.shots if shots else ()):
        _draw_shot(axes, page, number, shot, vector)
    if shots:  # axes turn with them
        paint(axes, [*cross_shapes(page), *scale_shapes(page)], 10 * len(page.shots), page.is_opaque)
    if words:
        paint(axes, [*caption_shapes(page), *legend_shapes(page)], is_opaque=page.is_opaque)
    return canvas


def blank_page(
    inches: tuple[float, float], units: tuple[float, float], dpi: float, ground: str | Colour
) -> tuple[Canvas, Axes]:
    """Return a page of matplotlib's, and axes all over it with so many units across and down, y down."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    canvas = Canvas(inches, dpi, facecolor=ground)
    FigureCanvasAgg(canvas)
    axes = canvas.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, units[0])
    axes.set_ylim(units[1], 0)
    axes.axis("off")
    return canvas, axes


# ---------------------------------------------------------------------- pictures
def _draw_shot(axes: Axes, page: ComposedPage, number: int, shot: Shot, vector: bool) -> None:
    from matplotlib.patches import Rectangle

    style, order, stroke = page.figure.style, 10 * number, page.layout.stroke
    frame = Rectangle((shot.box.x, shot.box.y), shot.box.width, shot.box.height, linewidth=0, zorder=order)
    frame.set_facecolor(style.background if shot.source is not None else "none")
    axes.add_artist(frame)
    _draw_image(axes, page, shot, order + 1, vector)
    edge = _silhouette(shot, page.layout.scale) if shot.isolines else None
    # One object for all curves: it is then written once.
    shape = edge and _clip_path()(edge, axes.transData)
    add = partial(_add_curve, axes)
    panel, contours = page.figure.panels[shot.panel], shot.isolines
    if panel.isolines.labels:
        contours, labels = label_shapes(page.figure, page.layout, shot)
        paint(axes, labels, order + 2, page.is_opaque)
    for k, line in enumerate(sorted(contours, key=lambda line: line.is_through)):
        if not line.parts:
            continue
        ink = page.figure.isoline_ink(shot.panel, line.value, line.is_through)
        wider = BOLD if line.is_through else width_of(panel.isolines, line.is_bold, panel.signed and line.value == 0)
        width = wider * ink.width * style.isoline_width * stroke
        strokes = [(ink.rim, width + 2 * ink.rim_width * stroke)] if ink.rim is not None else []
        for colour, across in (*strokes, (ink.colour, width)):
            # The stroke is cut where the shape ends, which its middle line does already.
            add(line.parts, colour, across, "butt", order + 2, f"isoline-{number}-{k}", shape)
    if shot.outlines:
        width, name = style.outline * stroke, f"outline-{number}"
        add(shot.outlines, style.outline_colour, width, "round", order + 3, name, frame)
    for look, lines in shot.lines.items():
        hidden, opacity = look.behind(shot.opacity)
        pale = 1.0 if page.is_opaque else opacity
        for parts, looks, opacity in ((lines.course, hidden, pale), (lines.seen, look.strokes, 1.0)):
            for each in looks if parts else ():
                width, name = each.width * stroke, f"{look.name}-{number}"
                colour = (*style.named(each.colour), opacity)
                curve = add(parts, colour, width, "round", order + 3, name, frame)
                if each.dots:
                    curve.set_linestyle((0, (DOT, each.dots / each.width - DOT)))
    paint(axes, mark_shapes(page, shot), order + 4, page.is_opaque)
    if shot.source is not None:
        paint(axes, frame_shapes(page, shot), order + 5, page.is_opaque)


def _draw_image(axes: Axes, page: ComposedPage, shot: Shot, order: int, vector: bool) -> None:
    """Add the shaded pixels on their background, without what is empty around them."""
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
    if not page.figure.transparent:
        # White of a picture becomes a light grey where some readers make it smaller: what is empty is not painted.
        edge = _silhouette(shot, page.layout.scale, wider=2)
        image.set_clip_path(edge and _clip_path()(edge, axes.transData))


@cache
def _clip_path() -> type:
    """Return the class of clip paths that stay the same object, so that EPS has each once."""
    from matplotlib.transforms import TransformedPath

    class ClipPath(TransformedPath):
        _kept: tuple[Any, Any] = (None, None)

        def get_transformed_path_and_affine(self) -> tuple[Any, Any]:
            found = super().get_transformed_path_and_affine()
            if found[0] is not self._kept[0]:
                self._kept = found
            return self._kept

    return ClipPath


@cache
def _pixels_artist() -> type:
    """Return the class of pixels that are put on a page of pixels as they are: matplotlib is imported late."""
    from matplotlib.artist import Artist

    class Pixels(Artist):
        def __init__(self, pixels: ByteArray, left: int, top: int, order: int) -> None:
            super().__init__()
            self.set_zorder(order)
            self._pixels, self._left, self._top = pixels, left, top

        def draw(self, renderer: Any) -> None:
            # matplotlib counts rows from below.
            low = int(renderer.height) - self._top - len(self._pixels)
            renderer.draw_image(renderer.new_gc(), self._left, low, self._pixels[::-1])

    return Pixels


def _on(background: Colour | None, image: ByteArray) -> ByteArray:
    """Put pixels (h, w, 4) with premultiplied alpha on a background, or make their alpha straight.

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


def _add_curve(
    axes: Axes, lines: list[Line], colour: Colour | RGBA, width: float, cap: str, order: int, name: str, clip: Any
) -> PathPatch:
    """Add the parts of one curve as one path, which is seen inside of another."""
    from matplotlib.patches import PathPatch

    rings = [(simplified_line(np.concatenate([p, p[:1]]) if closed else p, FINENESS), closed) for p, closed in lines]
    look = {"edgecolor": colour, "linewidth": width * POINT, "capstyle": cap, "joinstyle": "round"}
    curve = PathPatch(_path(rings), fill=False, zorder=order, gid=name, **look)
    axes.add_artist(curve)
    curve.set_clip_path(clip)
    return curve


def simplified_line(points: FloatArray, tolerance: float) -> FloatArray:
    """Return points (k, 2) of a line without those it passes within `tolerance` anyway (Douglas and Peucker)."""
    keep = np.zeros(len(points), bool)
    keep[[0, -1]] = True
    stack = [(0, len(points) - 1)]
    while stack:
        a, b = stack.pop()
        if b - a < 2:
            continue
        way = points[b] - points[a]
        length = float(np.hypot(*way))
        arm = points[a + 1 : b] - points[a]
        if length > 0:
            along = np.clip((arm @ way) / length**2, 0, 1)
            arm = arm - along[:, None] * way
        off = np.hypot(arm[:, 0], arm[:, 1])
        k = int(off.argmax())
        if off[k] > tolerance:
            keep[a + 1 + k] = True
            stack += [(a, a + 1 + k), (a + 1 + k, b)]
    return points[keep]


def _path(rings: list[Line]) -> Path:
    """Return lines (k, 2) as one path; a closed one ends with its first point."""
    from matplotlib.path import Path

    codes = [[Path.MOVETO, *[Path.LINETO] * (len(p) - 2), Path.CLOSEPOLY if c else Path.LINETO] for p, c in rings]
    return Path(np.concatenate([p for p, _ in rings]), np.concatenate(codes))


def _silhouette(shot: Shot, scale: float, wider: int = 0) -> Path | None:
    """Return the edge of the shape in the picture, or of what lies so many pixels around it; None for none."""
    from contourpy import contour_generator

    alpha = np.pad(shot.cover.astype(np.float32), 1 + wider)
    if not alpha.any():
        return None
    at = [(np.arange(-1 - wider, side + 1 + wider) + 0.5) / scale for side in shot.image.shape[1::-1]]
    for _ in range(wider):
        for axis in (0, 1):
            one, other = (np.roll(alpha, step, axis) for step in (1, -1))
            alpha = np.maximum(np.maximum(one, other), alpha)
    loops: Any = contour_generator(at[0] + shot.box.x, at[1] + shot.box.y, alpha).lines(0.5 if wider else 127.5)
    return _path([(simplified_line(loop, EDGE_FINENESS), True) for loop in loops if len(loop) > 3])
