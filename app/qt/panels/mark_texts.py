"""The texts of marks, such as the values of anchors, painted beside them."""

from collections.abc import Sequence

from qtpy import QtCore, QtGui

from ..look.look import LOOK
from ..look.painting import paint_rounded

AWAY, HEIGHT, PAD, DOT = 9.0, 21.0, 5.0, 6.0
"""Logical pixels: from the place to the label, its height, beside the text, and from a place to its mark's rim."""


MarkText = tuple[str, bool, QtCore.QPointF]
"""What stands beside a mark, whether that stands out, and where it is."""


def paint_texts(painter: QtGui.QPainter, texts: Sequence[MarkText], view: QtCore.QRectF) -> None:
    """At their places in a view; what stands out comes first, and one that would cover another is left out."""
    theme = LOOK.theme
    painter.setFont(LOOK.font(12, bold=True))
    metrics = QtGui.QFontMetricsF(painter.font())
    sizes = [
        QtCore.QSizeF(metrics.horizontalAdvance(text) + 2 * PAD * LOOK.scale, HEIGHT * LOOK.scale)
        for text, _, _ in texts
    ]
    boxes = label_boxes([at for _, _, at in texts], sizes, [not is_lit for _, is_lit, _ in texts], view)
    for (text, is_lit, _), box in zip(texts, boxes, strict=True):
        if box is None:
            continue
        ground, ink = (theme.fill, theme.on_fill) if is_lit else (theme.raised, theme.text)
        paint_rounded(painter, box, 4, ground, ground if is_lit else theme.text)
        painter.setPen(QtGui.QColor(ink))
        painter.drawText(box, QtCore.Qt.AlignmentFlag.AlignCenter, text)


def label_boxes(
    places: Sequence[QtCore.QPointF], sizes: Sequence[QtCore.QSizeF], ranks: Sequence[int], view: QtCore.QRectF
) -> list[QtCore.QRectF | None]:
    """Where labels of these sizes go: beside their places, in the view, off each other and all places; None: nowhere.

    ranks: the lowest are placed first, and these stand somewhere whatever they cover.
    """
    found: list[QtCore.QRectF | None] = [None] * len(places)
    dot = DOT * LOOK.scale
    dots = [QtCore.QRectF(at.x() - dot, at.y() - dot, 2 * dot, 2 * dot) for at in places]
    for k in sorted(range(len(places)), key=lambda k: ranks[k]):
        taken = [box for box in found if box is not None] + dots[:k] + dots[k + 1 :]
        boxes = [box for box in _beside(places[k], sizes[k]) if view.contains(box)]
        found[k] = next((box for box in boxes if not any(box.intersects(other) for other in taken)), None)
        if found[k] is None and not ranks[k]:
            found[k] = next(iter(boxes), None)
    return found


def _beside(at: QtCore.QPointF, size: QtCore.QSizeF) -> list[QtCore.QRectF]:
    """At the right, the left, above, below, and at the corners."""
    away, wide, high = AWAY * LOOK.scale, size.width(), size.height()
    near = 0.7 * away
    lefts = (away, -away - wide, -wide / 2, -wide / 2, near, -near - wide, near, -near - wide)
    tops = (-high / 2, -high / 2, -away - high, away, -near - high, -near - high, near, near)
    return [QtCore.QRectF(at + QtCore.QPointF(x, y), size) for x, y in zip(lefts, tops, strict=True)]
