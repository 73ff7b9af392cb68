"""Glyphs of marks on a figure's page, painted by matplotlib."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from ..marks.glyphs import Glyph, Layer, Subpath
from ..marks.primitives import PointMark

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.path import Path

    from .canvas import Composition

POINT = 0.75
"""Points in a unit."""

NUMERAL = (1.25, 1.1, 0.85)
"""The size of a numeral of one, two and three digits, in reaches of its glyph."""


def draw_glyph(
    axes: Axes, page: Composition, mark: PointMark, at: tuple[float, float], is_hidden: bool, order: float
) -> list[Artist]:
    """The parts of a mark's glyph about a place of the page, added to the axes; of one that is hidden, perhaps none."""
    glyph = mark.glyph.hidden if is_hidden else mark.glyph
    if glyph is None:
        return []
    reach = glyph.reach_of(page.layout.mark, page.layout.label)
    parts: list[Artist] = [_layer(page, mark, glyph, layer, at, reach, order) for layer in glyph.layers]
    for part in parts:
        axes.add_artist(part)
    if glyph.rise and mark.number is not None:
        text, (x, y) = str(mark.number), at
        size = NUMERAL[min(len(text), 3) - 1] * reach
        look: dict[str, Any] = {"ha": "center", "va": "baseline", "weight": "bold"}
        look |= {"size": size * POINT, "zorder": order}
        colour = _colour(page, mark, glyph.numeral)
        parts.append(axes.text(x, y - glyph.rise * reach + 0.36 * size, text, color=colour, **look))
    return parts


def _layer(
    page: Composition, mark: PointMark, glyph: Glyph, layer: Layer, at: tuple[float, float], reach: float, order: float
) -> Artist:
    from matplotlib.patches import PathPatch
    from matplotlib.transforms import Affine2D

    rim = max(glyph.rim * reach, glyph.least_rim)
    path = _path(glyph.outline).transformed(Affine2D().scale(reach - layer.inset * rim).translate(*at))
    opacity = 1.0 if page.is_opaque else layer.opacity
    look: dict[str, Any] = {"fill": False}
    if layer.fill:
        look = {"facecolor": (*_colour(page, mark, layer.fill), opacity)}
    look |= {"edgecolor": (*_colour(page, mark, layer.line), opacity) if layer.line else "none"}
    if layer.dashes:
        look["linestyle"] = (0, layer.dashes)
    width = layer.width * rim * POINT
    return PathPatch(path, linewidth=width, joinstyle=glyph.join, capstyle=glyph.cap, zorder=order, **look)


def _colour(page: Composition, mark: PointMark, name: str) -> tuple[float, float, float]:
    return page.figure.style.named(mark.colour if name == "own" else name)


@cache
def _path(outline: tuple[Subpath, ...]) -> Path:
    """In unit coordinates."""
    from matplotlib.path import Path

    vertices, codes = [], []
    for part in outline:
        vertices += [part.start, *(point for segment in part.segments for point in segment)]
        codes += [Path.MOVETO]
        for segment in part.segments:
            codes += [Path.LINETO] if len(segment) == 1 else [Path.CURVE4] * 3
        if part.is_closed:
            vertices.append(part.start)
            codes.append(Path.CLOSEPOLY)
    return Path(vertices, codes)
