"""Shapes over a view: glyphs of marks with their texts, the label at the pointer, notes and a legend, sentences."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from qtpy import QtCore, QtGui

from bihdist_core.arrays import FloatArray

from ...drawing.glyphs import SCREEN_NUMERAL, TRIANGLE_UP, Glyph, Layer, glyph_shapes, label_boxes
from ...drawing.painters.qt import outline, rgba_of, text_width
from ...drawing.shapes import RGBA, Box, Path, Pen, Point, Shape, Text, rounded
from ...marks.primitives import LegendRow, PointMark
from ...scene.style import Style
from ..look.look import LOOK, paint_rounded, translucent

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


LABEL_HEIGHT, LABEL_PADDING, LABEL_GAP, LABEL_TEXT = 24.0, 8.0, 7.0, 12.0
LABEL_OFFSET = (16.0, -38.0)
"""Logical pixels from the place to the label's left top corner."""

LEFT, TOP, GAP = 14.0, 15.0, 10.0
"""Logical pixels: from the view's corner to the glyph of a note, and from that to the words."""

WIDEST_NOTE = 0.85
"""Largest fraction of a view's width that a note takes."""

LOW, TINY = 240, 170
"""Logical pixels: in lower views the shape needs the room, and notes take their short form, or are left out."""

SMALL = 0.7
"""Size of a mark in a legend, as a fraction of its usual size."""

ROW, NOTE_TEXT = 24.0, 12.5
"""Logical pixels from a legend to a note under it, and of the size of their font."""


@dataclass(frozen=True)
class Pointed:
    """The place that is pointed at, in this panel or in another.

    Attributes
    ----------
    position
        (3,) the place.
    is_own
        Whether the pointer is in this panel.
    is_hidden
        Whether the surface is before the place.
    value, share
        What the label at the pointer says.
    """

    position: FloatArray
    is_own: bool
    is_hidden: bool = False
    value: str = ""
    share: str = ""


def label_box(at: Point, value: str, share: str, view: Box) -> Box:
    """Return the box of a place's label, always inside the view."""
    (x, y), (right, up), scale = at, LABEL_OFFSET, LOOK.scale
    width = 2 * LABEL_PADDING + text_width(value, LABEL_TEXT * scale, True)
    width += LABEL_GAP + text_width(share, LABEL_TEXT * scale) if share else 0.0
    height = LABEL_HEIGHT * scale
    left = x + right if x + right + width <= view.right - 2 else x - right - width
    top = y + up if y + up >= view.y + 2 else y + right
    return Box(max(min(left, view.right - width), view.x), top, width, height)


def label_shapes(box: Box, value: str, share: str, is_target: bool = False) -> list[Shape]:
    """Return a value and its fraction of the maximum in a box; with `is_target` as the one that a key takes."""
    theme = LOOK.theme
    ground, plain, quiet = theme.label, theme.label_text, theme.label_quiet
    if is_target:
        ground, plain, quiet = theme.fill, theme.on_fill, theme.on_fill
    x, y, size = box.x + LABEL_PADDING, box.middle[1], LABEL_TEXT * LOOK.scale
    after = x + text_width(value, size, True) + LABEL_GAP
    texts = (value, x, plain, True), (share, after, quiet, False)
    return [
        Path(rounded(box, 4), rgba_of(ground)),
        *(
            Text(text, left, y, size, rgba_of(ink), is_bold, level="line", are_digits_even=True)
            for text, left, ink, is_bold in texts
        ),
    ]


def note_shapes(view: Box, style: Style, notes: Sequence[str], of_extrema: bool = True) -> list[Shape]:
    """Return the shapes of a note, such as the number of extrema, in the first words for which there is room.

    In a tiny view they would lie on the surface; the dock says them, too.
    """
    scale = LOOK.scale
    if view.height < TINY * scale:
        return []
    size, y, left = NOTE_TEXT * scale, view.y + TOP * scale, LEFT + of_extrema * (TRIANGLE_UP.pixels + GAP)
    room = WIDEST_NOTE * view.width - left
    fitting = (words for words in notes[view.height < LOW * scale :] if text_width(words, size) <= room)
    words = next(fitting, notes[-1])
    ground = Box(4, view.y + 2, left + text_width(words, size), 2 * (TOP * scale - 2))
    return [
        Path(rounded(ground, 4), rgba_of(LOOK.theme.canvas, 0.8)),
        *(mark_shapes(PointMark(0, TRIANGLE_UP), (LEFT, y), style, 1.0) if of_extrema else ()),
        Text(words, left, y, size, rgba_of(LOOK.theme.quiet), level="line"),
    ]


def legend_shapes(view: Box, style: Style, rows: Sequence[LegendRow]) -> list[Shape]:
    """Return the legend of the glyphs, in a view that has room for it."""
    theme, scale = LOOK.theme, LOOK.scale
    if view.height < LOW * scale:
        return []
    x, y, size = LEFT + 2, TOP * scale, NOTE_TEXT * scale
    shapes: list[Shape] = []
    for row in rows:
        if row.colour:
            shapes += mark_shapes(PointMark(0, row.glyph, row.colour), (x, y), style, SMALL)
        else:
            shapes += sample_shapes(row.glyph, (x, y), rgba_of(theme.quiet if row.glyph.rise else theme.text))
        x += 14 * scale
        shapes.append(Text(row.text, x, y, size, rgba_of(theme.quiet), level="line"))
        x += text_width(row.text, size) + 22 * scale
    return shapes


def paint_sentence(painter: QtGui.QPainter, view: QtCore.QRect, words: str) -> None:
    """Paint why there is no field, in the middle, on the ground of the panel; Qt breaks the lines."""
    painter.setFont(LOOK.font(13))
    room = view.adjusted(24, 24, -24, -24)
    flags = int(QtCore.Qt.AlignmentFlag.AlignCenter | QtCore.Qt.TextFlag.TextWordWrap)
    box = painter.fontMetrics().boundingRect(room, flags, words)
    paint_rounded(painter, QtCore.QRectF(box.adjusted(-12, -8, 12, 8)), 6, translucent(LOOK.theme.canvas, 0.88))
    painter.setPen(QtGui.QColor(LOOK.theme.text))
    painter.drawText(room, flags, words)
