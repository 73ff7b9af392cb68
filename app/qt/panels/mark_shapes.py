"""Glyphs of marks over a view, and the texts beside them, as shapes."""

from collections.abc import Sequence
from dataclasses import replace

from qtpy import QtCore

from ...drawing.glyphs import SCREEN_NUMERAL, Glyph, Layer, glyph_shapes
from ...drawing.labels import label_boxes
from ...drawing.painters.qt import outline, rgba_of, text_width
from ...drawing.shapes import RGBA, Box, Path, Pen, Point, Shape, Text, rounded
from ...marks.primitives import PointMark
from ...scene.style import Style
from ..look.look import LOOK

LEAST_SCALE = 0.75
"""Smallest scale of a glyph with a number, which is to be read in small views, too."""

RIMS = 2.5
"""Logical pixels around the head of a glyph that stands above its place."""

LIT = (("accent", 9.0), ("", 4.5))
"""Colours of the window's theme, white for none, and logical pixels of the lines around a glyph that stands out."""

HEIGHT, PAD = 21.0, 5.0
"""Logical pixels of a text's height, and beside it."""

WHITE: RGBA = (1.0, 1.0, 1.0, 1.0)

MarkText = tuple[str, bool, Point]
"""A text beside a mark, whether that stands out, and where it is."""


def mark_shapes(
    mark: PointMark, at: Point, style: Style, proportion: float, is_hidden: bool = False, is_lit: bool = False
) -> list[Shape]:
    """Return a mark's glyph about a place, at this proportion of the usual size of marks."""
    glyph = mark.glyph.hidden if is_hidden else mark.glyph
    if glyph is None:
        return []
    scale, layers = _scale(glyph, proportion), glyph.screen or glyph.layers
    shapes: list[Shape] = []
    if is_lit:
        path = replace(glyph_path(glyph, at, style, scale), fill=None)
        for name, width in LIT:
            colour = rgba_of(getattr(LOOK.theme, name)) if name else WHITE
            shapes.append(replace(path, pen=Pen(colour, scale * width, (), glyph.cap, glyph.join)))
        layers = tuple(layer for layer in layers if layer.line != "mark_edge")
    named, reach, is_down = style.named_for(mark.colour), reach_of(glyph, style), hangs_down(glyph, at)
    return [*shapes, *glyph_shapes(glyph, at, reach, named, mark.number, layers, scale, is_down, SCREEN_NUMERAL)]


def reach_of(glyph: Glyph, style: Style) -> float:
    """Return the logical pixels from the place to the outside, in a view of the usual size."""
    return glyph.pixels * LOOK.scale if glyph.pixels else glyph.reach_of(style.marker_size, 0.0)


def hangs_down(glyph: Glyph, at: Point) -> bool:
    """Return whether a glyph that stands above its place hangs below it, as the view ends above."""
    return glyph.rise > 0 and at[1] <= ((glyph.rise + 1) * glyph.pixels + RIMS) * LOOK.scale


def glyph_path(glyph: Glyph, at: Point, style: Style, scale: float = 1.0) -> Path:
    """Return the outline of a glyph about a place."""
    reach = scale * reach_of(glyph, style)
    return Path(glyph.outline, at=at, scale=(reach, -reach if hangs_down(glyph, at) else reach))


def box_of_glyph(glyph: Glyph, at: Point, style: Style) -> QtCore.QRectF:
    """Return the box of a glyph's outline about a place, in a view of the usual size."""
    return outline(glyph_path(glyph, at, style)).boundingRect()


def covers(glyph: Glyph, at: Point, place: Point, style: Style, proportion: float) -> bool:
    """Return whether the glyph about one place covers another."""
    path = outline(glyph_path(glyph, at, style, _scale(glyph, proportion)))
    return bool(path.contains(QtCore.QPointF(*place)))


def sample_shapes(glyph: Glyph, middle: Point, colour: RGBA) -> list[Shape]:
    """Return a glyph in quiet lines, small, about a place: for a legend."""
    size = (0.6 if glyph.rise else 0.7) * glyph.pixels * LOOK.scale
    dashes = (glyph.screen or glyph.layers)[-1].dashes
    layer = Layer("own", 1.3 if dashes else 1.6, dashes=dashes)
    at = middle[0], middle[1] + 0.9 * glyph.rise * size
    return glyph_shapes(replace(glyph, rim=0.0, least_rim=1.0), at, size, lambda _: colour, layers=(layer,))


def _scale(glyph: Glyph, proportion: float) -> float:
    return max(proportion, LEAST_SCALE) if glyph.rise else proportion


def text_shapes(texts: Sequence[MarkText], view: Box) -> list[Shape]:
    """Return texts beside their marks in a view; those that stand out come first, and none covers another."""
    theme, scale = LOOK.theme, LOOK.scale
    size = 12 * scale
    sizes = [(text_width(text, size, True) + 2 * PAD * scale, HEIGHT * scale) for text, _, _ in texts]
    boxes = label_boxes([at for _, _, at in texts], sizes, [not is_lit for _, is_lit, _ in texts], view, scale)
    shapes: list[Shape] = []
    for (text, is_lit, _), box in zip(texts, boxes, strict=True):
        if box is not None:
            ground, ink = (theme.fill, theme.on_fill) if is_lit else (theme.raised, theme.text)
            pen = Pen(rgba_of(ground if is_lit else theme.text))
            shapes.append(Path(rounded(box, 4), rgba_of(ground), pen))
            x, y = box.middle
            shapes.append(Text(text, x, y, size, rgba_of(ink), True, "centre", "line"))
    return shapes


def point_of(place: QtCore.QPointF) -> Point:
    """Return a place of Qt as a pair."""
    return place.x(), place.y()
