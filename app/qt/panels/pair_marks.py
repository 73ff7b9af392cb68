"""Pairs of corresponding points over a view: drops with one number on both surfaces, and the best candidate, dashed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import AnyArray, FloatArray

from ...scene.picking import pixel_of
from ..look.look import LOOK
from . import overlay
from .extremum_marks import LOW, NOTE_LEFT, NOTE_TOP
from .pin_marks import (
    BRIGHT,
    DARK,
    HEAD,
    LEAST,
    RISE,
    PinMark,
    drop_at,
    drop_under,
    is_in_drop,
    paint_numeral,
    paint_pins,
)

if TYPE_CHECKING:
    from .view import View

CANDIDATE, TRUTH = "candidate", "truth"

ARM = 6.0
"""From the middle of a cross to its ends, along each side, in logical pixels."""


@dataclass(frozen=True, eq=False)
class CandidateMark:
    """Where the partner of a point would be, at a position (3,); value and share stand beside it."""

    number: int
    position: FloatArray
    value: str
    share: str


class PairMarks:
    """view: that they lie over.  The candidate is on top; is_meant: it is the one that Enter takes."""

    def __init__(self, view: View) -> None:
        self._view = view
        self._marks: tuple[PinMark, ...] = ()
        self.candidate: CandidateMark | None = None
        self.is_meant = False
        self.truth: tuple[AnyArray, ...] = ()
        self._hidden: frozenset[int] | None = None  # what the surface is before; None until it is looked

    def show(
        self, marks: tuple[PinMark, ...], candidate: CandidateMark | None, truth: tuple[AnyArray, ...] = ()
    ) -> None:
        """Put drops at these places, and crosses at positions (3,)."""
        if marks or candidate or truth or self._marks or self.candidate or self.truth:
            self._marks, self.candidate, self.truth, self._hidden = marks, candidate, truth, None
            self._view.update()

    def mean(self, is_meant: bool) -> None:
        """Whether its candidate is the one that Enter takes."""
        if is_meant != self.is_meant:
            self.is_meant = is_meant
            self._view.update()

    def see(self) -> None:
        """Another picture has been drawn: what is hidden in it?"""
        self._hidden = None

    def _look(self) -> frozenset[int]:
        if self._hidden is None:
            self._hidden = frozenset(mark.number for mark in self._marks if not self._view.sees(mark.position))
        return self._hidden

    def _seen(self) -> dict[int, tuple[PinMark, QtCore.QPointF]]:
        """By number, but for those that an inset covers."""
        return {m.number: (m, at) for m in self._marks if (at := self._place(m.position)) is not None}

    def _place(self, position: FloatArray) -> QtCore.QPointF | None:
        view = self._view
        x, y = pixel_of(view.renderer, position)
        if view.scene.insets.renderer_at(x, y) is not view.renderer:
            return None
        ratio = view.devicePixelRatioF()
        return QtCore.QPointF(x / ratio, view.height() - y / ratio)

    # ------------------------------------------------------------------ what is under the pointer
    def number_at(self, position: QtCore.QPoint) -> int:
        """Of the pair whose drop is under a point of the view, be it the candidate's; 0 for none."""
        place = QtCore.QPointF(position)
        if self.candidate is not None:
            at = self._place(self.candidate.position)
            if at is not None and is_in_drop(place, at, self._view.proportion):
                return self.candidate.number
        return drop_under(place, self._seen(), self._look(), self._view.proportion) if self._marks else 0

    def tip_of(self, number: int) -> QtCore.QPoint:
        """The pixel of the place of a drop that is seen."""
        seen = self._seen()
        if number not in seen and self.candidate is not None:
            at = self._view.place_of(self.candidate.position)
        else:
            at = seen[number][1]
        return QtCore.QPoint(int(np.floor(at.x())), int(np.floor(at.y())))

    # ------------------------------------------------------------------ painting
    def paint(self, painter: QtGui.QPainter) -> None:
        seen = self._seen()
        share = self._view.proportion
        paint_pins(painter, seen, self._look(), share)
        for position in self.truth:
            at = self._place(position)
            if at is not None:
                with overlay.shrunk(painter, at, share):
                    paint_cross(painter, at, not self._view.sees(position))
        candidate = self.candidate
        at = None if candidate is None else self._place(candidate.position)
        if candidate is not None and at is not None:
            with overlay.shrunk(painter, at, max(share, LEAST)):
                paint_candidate(painter, at, candidate.number)
            others = [drop_at(tip).boundingRect() for _, tip in seen.values()]
            box = label_box(at, candidate, QtCore.QRectF(self._view.rect()), others)
            overlay.paint_label(painter, box, candidate.value, candidate.share, self.is_meant)

    def names(self) -> Sequence[str]:
        """What has to be said of marks that are not numbered alone."""
        return (*([TRUTH] if self.truth else ()), *([] if self.candidate is None else [CANDIDATE]))


def paint_cross(painter: QtGui.QPainter, at: QtCore.QPointF, is_hidden: bool = False) -> None:
    """Where a point belongs; dashed on the far side."""
    arm = ARM * LOOK.scale
    for colour, width in ((DARK, 5.0), (BRIGHT, 2.4)):
        pen = QtGui.QPen(colour, width * LOOK.scale)
        pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap if is_hidden else QtCore.Qt.PenCapStyle.RoundCap)
        if is_hidden:
            pen.setDashPattern([3.2 / width, 2.4 / width])
        painter.setPen(pen)
        for way in (-1, 1):
            painter.drawLine(at + QtCore.QPointF(-arm, -arm * way), at + QtCore.QPointF(arm, arm * way))


def paint_candidate(painter: QtGui.QPainter, tip: QtCore.QPointF, number: int) -> None:
    """A dark drop with a dashed rim."""
    drop = drop_at(tip)
    painter.setPen(QtGui.QPen(DARK, 4.0))
    painter.setBrush(DARK)
    painter.drawPath(drop)
    pen = QtGui.QPen(BRIGHT, 1.6)
    pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap)
    pen.setDashPattern([2.0, 1.4])
    painter.setPen(pen)
    painter.drawPath(drop)
    way = -1 if drop.boundingRect().top() < tip.y() - 1 else 1
    middle = QtCore.QPointF(tip.x(), tip.y() + way * RISE * LOOK.scale)
    paint_numeral(painter, middle, HEAD * LOOK.scale, number, BRIGHT)


def label_box(
    tip: QtCore.QPointF, candidate: CandidateMark, view: QtCore.QRectF, others: Sequence[QtCore.QRectF]
) -> QtCore.QRectF:
    """Beside the head of a candidate: at the right or the left, in the view, off the other drops if may be."""
    size = overlay.label_place(tip, candidate.value, candidate.share, view).size()
    head = drop_at(tip).boundingRect()
    gap = 8 * LOOK.scale
    is_upright = head.top() < tip.y() - 1
    middle = tip.y() + (-RISE if is_upright else RISE) * LOOK.scale
    places = [
        QtCore.QPointF(head.right() + gap, middle - size.height() / 2),
        QtCore.QPointF(head.left() - gap - size.width(), middle - size.height() / 2),
        QtCore.QPointF(tip.x() - size.width() / 2, head.top() - gap - size.height()),
        QtCore.QPointF(tip.x() - size.width() / 2, head.bottom() + gap),
    ]
    boxes = [QtCore.QRectF(place, size) for place in places]
    inside = [box for box in boxes if view.adjusted(4, 4, -4, -4).contains(box)]
    free = [box for box in inside if not any(box.intersects(other) for other in others)]
    return (free or inside or boxes)[0]


SMALL = 0.6
"""Of a drop in a legend."""


def paint_legend(painter: QtGui.QPainter, view: QtCore.QRectF, names: Sequence[str]) -> None:
    """In the left upper corner of a view that has room for it: what marks without a number are."""
    if view.height() < LOW * LOOK.scale:
        return
    painter.setFont(LOOK.font(12.5))
    metrics = QtGui.QFontMetricsF(painter.font())
    x, middle = NOTE_LEFT + 2, NOTE_TOP * LOOK.scale
    for name in names:
        if name == TRUTH:
            _paint_small_cross(painter, QtCore.QPointF(x, middle))
        else:
            _paint_sample(painter, QtCore.QPointF(x, middle))
        painter.setPen(QtGui.QColor(LOOK.theme.quiet))
        x += 14 * LOOK.scale
        painter.drawText(QtCore.QPointF(x, middle + (metrics.ascent() - metrics.descent()) / 2), name)
        x += metrics.horizontalAdvance(name) + 22 * LOOK.scale


def _paint_small_cross(painter: QtGui.QPainter, middle: QtCore.QPointF) -> None:
    """The same in quiet lines."""
    arm = 0.7 * ARM * LOOK.scale
    painter.setPen(QtGui.QPen(QtGui.QColor(LOOK.theme.text), 1.6))
    for way in (-1, 1):
        painter.drawLine(middle + QtCore.QPointF(-arm, -arm * way), middle + QtCore.QPointF(arm, arm * way))


def _paint_sample(painter: QtGui.QPainter, middle: QtCore.QPointF) -> None:
    """A dashed drop, small, about a place."""
    painter.save()
    tip = 100 * LOOK.scale  # far enough down for its head to be above it
    painter.translate(middle)
    painter.scale(SMALL, SMALL)
    painter.translate(0, 0.9 * RISE * LOOK.scale - tip)
    pen = QtGui.QPen(QtGui.QColor(LOOK.theme.quiet), 2.2)
    pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap)
    pen.setDashPattern([1.8, 1.2])
    painter.setPen(pen)
    painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
    painter.drawPath(drop_at(QtCore.QPointF(0, tip)))
    painter.restore()
