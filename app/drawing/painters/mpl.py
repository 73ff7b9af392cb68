"""Shapes painted by matplotlib, on axes whose units are those of the page, 1/96 inch, y down."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from ..shapes import RGBA, Box, Gradient, Group, Image, Path, Pen, Shape, Subpath, Text, rectangle

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.path import Path as Outline

POINT = 0.75
"""Points in a unit."""

LEVELS = {"baseline": 0.0, "capitals": 0.36, "lowercase": 0.27, "line": 0.35}
"""Sizes of a text from its middle down to its baseline."""


def paint(
    axes: Axes, shapes: Iterable[Shape], order: float = 1000.0, is_opaque: bool = False, clip: Box | None = None
) -> list[Artist]:
    """Add shapes to axes, the first of them lowest.

    Parameters
    ----------
    order
        The artists' zorder.
    is_opaque
        Whether the file has no transparency, so that all colours cover.
    clip
        The box outside of which nothing is seen.

    Returns
    -------
    list of Artist
        All that has been added.
    """

    def solid(colour: RGBA) -> RGBA:
        return (*colour[:3], 1.0) if is_opaque else colour

    found: list[Artist] = []
    for shape in shapes:
        if isinstance(shape, Group):
            found += paint(axes, shape.shapes, order, is_opaque, shape.clip)
            continue
        artists = _artists(axes, shape, solid)
        for artist in artists:
            artist.set_zorder(order)
            if not isinstance(shape, Text):
                axes.add_artist(artist)
            if clip is not None:
                artist.set_clip_path(_unit_path(rectangle(clip)), axes.transData)
        found += artists
    return found


def _artists(axes: Axes, shape: Path | Text | Image, solid: Any) -> list[Artist]:
    if isinstance(shape, Text):
        return [_text(axes, shape, solid)]
    if isinstance(shape, Image):
        return [_image(axes, shape)]
    if isinstance(shape.fill, Gradient):
        return [_steps(shape, shape.fill)]
    return [_patch(shape, shape.fill, solid)]


def _patch(shape: Path, fill: RGBA | None, solid: Any) -> Artist:
    from matplotlib.patches import PathPatch
    from matplotlib.transforms import Affine2D

    path = _unit_path(shape.subpaths).transformed(Affine2D().scale(*shape.scale).translate(*shape.at))
    look: dict[str, Any] = {"fill": False} if fill is None else {"facecolor": solid(fill)}
    pen = shape.pen
    if pen is None:
        look |= {"edgecolor": "none", "linewidth": 0}
    else:
        look |= {"edgecolor": solid(pen.colour), "linewidth": pen.width * POINT}
        look |= {"capstyle": pen.cap, "joinstyle": pen.join}
        if pen.dashes:
            look["linestyle"] = (0, pen.dashes)
    return PathPatch(path, gid=shape.name or None, **look)


def _steps(shape: Path, gradient: Gradient) -> Artist:
    """Return a rectangle in the gradient's colours, each to the end of it, under the next: else seams are seen."""
    from matplotlib.collections import PolyCollection

    corners = np.array([shape.subpaths[0].start, *(segment[-1] for segment in shape.subpaths[0].segments)])
    (left, top), (right, bottom) = corners.min(axis=0), corners.max(axis=0)
    places = np.arange(len(gradient.colours)) / len(gradient.colours)
    if gradient.start[1] == gradient.stop[1]:
        starts = gradient.start[0] + places * (gradient.stop[0] - gradient.start[0])
        boxes = [[(right, top), (x, top), (x, bottom), (right, bottom)] for x in starts]
    else:
        starts = gradient.start[1] + places * (gradient.stop[1] - gradient.start[1])
        boxes = [[(left, top), (right, top), (right, y), (left, y)] for y in starts]
    return PolyCollection(boxes, facecolors=list(gradient.colours), linewidths=0)


@lru_cache(maxsize=512)
def _unit_path(subpaths: tuple[Subpath, ...]) -> Outline:
    from matplotlib.path import Path as Outline

    vertices, codes = [], []
    for part in subpaths:
        vertices += [part.start, *(point for segment in part.segments for point in segment)]
        codes += [Outline.MOVETO]
        for segment in part.segments:
            codes += [Outline.LINETO] if len(segment) == 1 else [Outline.CURVE4] * 3
        if part.is_closed:
            vertices.append(part.start)
            codes.append(Outline.CLOSEPOLY)
    return Outline(vertices, codes)


def _text(axes: Axes, shape: Text, solid: Any) -> Artist:
    from matplotlib.patheffects import withStroke

    angle, lower = np.radians(shape.angle), LEVELS[shape.level] * shape.size
    text = axes.text(
        shape.x + lower * np.sin(angle),
        shape.y + lower * np.cos(angle),
        shape.text,
        size=shape.size * POINT,
        color=solid(shape.colour),
        weight="bold" if shape.is_bold else "normal",
        ha={"centre": "center"}.get(shape.align, shape.align),
        va="baseline",
        rotation=shape.angle,
        rotation_mode="anchor",
        gid=shape.name or None,
    )
    if shape.halo is not None:
        halo: Pen = shape.halo
        text.set_path_effects([withStroke(linewidth=halo.width * POINT, foreground=solid(halo.colour))])
    return text


def _image(axes: Axes, shape: Image) -> Artist:
    from matplotlib.image import AxesImage

    box = shape.box
    image = AxesImage(axes, origin="upper", interpolation="nearest", extent=(box.x, box.right, box.bottom, box.y))
    image.set_data(shape.pixels)
    return image
