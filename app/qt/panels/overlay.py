"""Shapes over a view beside its marks: the label at the pointer, notes and a legend in a corner, sentences."""

from collections.abc import Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui

from bihdist_core.arrays import FloatArray

from ...drawing.glyphs import TRIANGLE_UP
from ...drawing.painters.qt import rgba_of, text_width
from ...drawing.shapes import Box, Path, Point, Shape, Text, rounded
from ...marks.primitives import LegendRow, PointMark
from ...scene.style import Style
from ..look.look import LOOK, paint_rounded, translucent
from .mark_shapes import mark_shapes, sample_shapes

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
