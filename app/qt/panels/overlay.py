"""What lies over a view and needs no drawing of the surface: the ring and the label at the pointer, the
axes, and sentences."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

from qtpy import QtCore, QtGui

from bihdist_core.arrays import FloatArray

from ...scene.axes import ARM, Arm
from ..look.look import LOOK
from ..look.numbers import number_width, paint_number
from ..look.painting import paint_rounded, round_pen, translucent

REACH = 14
"""Logical pixels about a place that its ring may cover."""

RING, ECHO = 8.0, 6.0
"""Radius of the ring under the pointer, and of that in the other panels."""

BRIGHT, DARK = QtGui.QColor("#FFFFFF"), QtGui.QColor("#14161A")

LABEL_HEIGHT, LABEL_PADDING, LABEL_GAP = 24.0, 8.0, 7.0
LABEL_OFFSET = QtCore.QPointF(16, -38)
"""From the place to the label's left top corner."""


@dataclass(frozen=True)
class Pointed:
    """The place that is pointed at, in this panel or in another.

    position: (3,); is_hidden: whether the surface is before it; value, share: what the label at the pointer says.
    """

    position: FloatArray
    is_own: bool
    is_hidden: bool = False
    value: str = ""
    share: str = ""


@contextmanager
def shrunk(painter: QtGui.QPainter, at: QtCore.QPointF, share: float) -> Iterator[None]:
    """Paint at this share of the usual size about a place."""
    painter.save()
    painter.translate(at)
    painter.scale(share, share)
    painter.translate(-at)
    yield
    painter.restore()


def paint_ring(painter: QtGui.QPainter, at: QtCore.QPointF, is_own: bool, is_hidden: bool) -> None:
    """A white ring between dark rims, which shows on every colour; is_own: under the pointer, with a dot.

    is_hidden: on the far side of the surface, dashed.
    """
    painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
    radius = RING if is_own else ECHO
    for colour, width in ((DARK, 4.5), (BRIGHT, 2.0)):
        pen = QtGui.QPen(colour, width)
        if is_hidden:
            pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap)
            pen.setDashPattern([4.0 / width, 3.0 / width])
        painter.setPen(pen)
        painter.drawEllipse(at, radius, radius)
    if is_own:
        painter.setPen(QtGui.QPen(DARK, 1))
        painter.setBrush(BRIGHT)
        painter.drawEllipse(at, 2.0, 2.0)


def label_place(at: QtCore.QPointF, value: str, share: str, view: QtCore.QRectF) -> QtCore.QRectF:
    """Where the label of a place stands, always inside the view."""
    width = 2 * LABEL_PADDING + number_width(LOOK.font(12, bold=True), value)
    if share:
        width += LABEL_GAP + number_width(LOOK.font(12), share)
    size = QtCore.QSizeF(width, LABEL_HEIGHT * LOOK.scale)
    place = QtCore.QRectF(at + LABEL_OFFSET, size)
    if place.right() > view.right() - 2:
        place.moveRight(at.x() - LABEL_OFFSET.x())
    if place.top() < view.top() + 2:
        place.moveTop(at.y() + LABEL_OFFSET.x())
    place.moveLeft(max(min(place.left(), view.right() - width), view.left()))
    return place


def paint_label(painter: QtGui.QPainter, place: QtCore.QRectF, value: str, share: str, is_meant: bool = False) -> None:
    """A value and its fraction of the maximum; is_meant: it is the one of several that a key takes."""
    theme = LOOK.theme
    ground, plain, quiet = theme.label, theme.label_text, theme.label_quiet
    if is_meant:
        ground, plain, quiet = theme.fill, theme.on_fill, theme.on_fill
    paint_rounded(painter, place, 4, ground)
    x = place.left() + LABEL_PADDING
    for text, bold, colour in ((value, True, plain), (share, False, quiet)):
        painter.setFont(LOOK.font(12, bold))
        metrics = painter.fontMetrics()
        painter.setPen(QtGui.QColor(colour))
        baseline = place.center().y() + (metrics.ascent() - metrics.descent()) / 2
        x = paint_number(painter, x, baseline, text) + LABEL_GAP


def paint_axes(painter: QtGui.QPainter, arms: Sequence[Arm], at: tuple[float, float]) -> None:
    """The cross of the axes about a place."""
    painter.setFont(LOOK.font(11))
    metrics = painter.fontMetrics()
    x, y = at
    for arm in arms:
        painter.setPen(round_pen(translucent(LOOK.theme.quiet, arm.opacity), 1.5))
        painter.drawLine(QtCore.QPointF(x, y), QtCore.QPointF(x + ARM * arm.x, y - ARM * arm.y))
        if arm.letter_at is None:
            continue
        right, up = arm.letter_at
        width = metrics.horizontalAdvance(arm.name)
        painter.drawText(QtCore.QPointF(x + right - width / 2, y - up + metrics.xHeight() / 2), arm.name)


def paint_sentence(painter: QtGui.QPainter, view: QtCore.QRect, words: str) -> None:
    """Why there is no field, in the middle, on the ground of the panel."""
    painter.setFont(LOOK.font(13))
    room = view.adjusted(24, 24, -24, -24)
    flags = int(QtCore.Qt.AlignmentFlag.AlignCenter | QtCore.Qt.TextFlag.TextWordWrap)
    box = painter.fontMetrics().boundingRect(room, flags, words)
    paint_rounded(painter, QtCore.QRectF(box.adjusted(-12, -8, 12, 8)), 6, translucent(LOOK.theme.canvas, 0.88))
    painter.setPen(QtGui.QColor(LOOK.theme.text))
    painter.drawText(room, flags, words)
