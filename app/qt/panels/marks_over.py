"""All that lies over the picture of a view, painted by Qt: the surface is drawn for none of it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import AnyArray, FloatArray

from ...marks.line_looks import SOURCE
from ...marks.primitives import LegendRow
from ...scene.axes import arms, middle
from ...scene.camera import camera_seen, frame
from ...scene.lines_of_sight import pixels_in
from . import overlay
from .line_marks import LineMarks, pen_of
from .mark_texts import paint_texts
from .notes import paint_legend, paint_note
from .overlay import Pointed
from .point_marks import PointMarks

if TYPE_CHECKING:
    from .view import View

DAB = 4.0
"""Pixels across of a vertex that a brush touches."""


class MarksOver:
    """view: what they lie over.  Lines alone are told by a drawing of the surface where they are hidden."""

    def __init__(self, view: "View") -> None:
        self._view = view
        self.points = PointMarks(view)
        self.lines = LineMarks(view)
        self.legend: Sequence[LegendRow] = ()
        self.pointed: Pointed | None = None
        self.sentence = ""
        self.notes: Sequence[str] = ()
        self.strokes: Sequence[AnyArray] = ()  # (k, 3) each: what has been drawn
        self._has_axes = False
        self._covered = QtCore.QRect()  # by the ring and its label
        self._dabs: list[tuple[str, QtGui.QPolygonF]] = []  # of a brush that is down
        self.ends = np.empty((0, 3))  # of what is joined

    # ------------------------------------------------------------------ what there is
    def say(self, sentence: str) -> None:
        """In the middle of the view: why there is no field; "" for nothing."""
        if sentence != self.sentence:
            self.sentence = sentence
            self._view.update()

    def write(self, notes: Sequence[str]) -> None:
        """A few words under the head, with a triangle: how many extrema there are; the first for which there is room.

        () for nothing.
        """
        if notes != self.notes:
            self.notes = notes
            self._view.update()

    def show_axes(self, has_axes: bool) -> None:
        """Whether a cross in a corner says where x, y and z point to."""
        if has_axes != self._has_axes:
            self._has_axes = has_axes
            self._view.update()

    def point_at(self, pointed: Pointed | None) -> None:
        """Put the ring somewhere."""
        self.pointed = pointed
        before, self._covered = self._covered, self._cover()
        self._view.update(before | self._covered)

    def show_legend(self, rows: Sequence[LegendRow]) -> None:
        """What glyphs stand for."""
        if rows != self.legend:
            self.legend = rows
            self._view.update()

    def show_strokes(self, strokes: Sequence[AnyArray]) -> None:
        """What has been drawn so far, points (k, 3)."""
        self.strokes = strokes
        self._view.update()

    def show_dabs(self, points: FloatArray | None, colour: str = "") -> None:
        """More vertices (k, 3) that a brush has touched, shown as long as the brush is down; None for none."""
        if points is None:
            self._dabs.clear()
        else:
            view = self._view
            at = pixels_in(view.scene.renderer, points, *view.pixels) / view.devicePixelRatioF()
            self._dabs.append((colour, QtGui.QPolygonF([QtCore.QPointF(*place) for place in at.tolist()])))
        self._view.update()

    def show_ends(self, points: FloatArray) -> None:
        """Rings at points (k, 3) that are joined with each other, dashed where the surface hides them."""
        if len(points) or len(self.ends):
            self.ends = points
            self._view.update()

    def see(self) -> None:
        """Another picture has been drawn: what is hidden in it?"""
        self.points.see_again()
        self.lines.see()
        self._covered = self._cover()

    # ------------------------------------------------------------------ painting
    def paint(self, painter: QtGui.QPainter) -> None:
        """What lies lowest first."""
        view = self._view
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        self.lines.paint(painter)
        for colour, places in self._dabs:
            painter.setPen(QtGui.QPen(QtGui.QColor(colour), DAB))
            painter.drawPoints(places)
        self.points.paint_flat(painter)
        if self._has_axes:
            at = middle(view.width(), view.height(), view.scene.insets.corners)
            overlay.paint_axes(painter, arms(frame(camera_seen(view.camera, 1.0))), at)
        paint_texts(painter, self.points.texts(), QtCore.QRectF(view.rect()))
        self.points.paint_standing(painter)
        if self.legend and not self.sentence:
            paint_legend(painter, QtCore.QRectF(view.rect()), self.legend)
        elif self.notes and not self.sentence:
            paint_note(painter, QtCore.QRectF(view.rect()), view.scene.style, self.notes)
        if self.sentence:
            overlay.paint_sentence(painter, view.rect(), self.sentence)
        for end in self.ends:
            self._paint_ring(painter, view.place_of(end), True, not view.sees(end))
        for stroke in self.strokes:
            path = QtGui.QPainterPath(view.place_of(stroke[0]))
            for place in stroke[-1:] if len(stroke) < 2 else stroke[1:]:
                path.lineTo(view.place_of(place))
            for each in SOURCE.strokes:
                painter.strokePath(path, pen_of(each, view.scene.style, view.proportion))
        if self.pointed is not None:
            self._paint_pointed(painter, self.pointed)

    def _paint_pointed(self, painter: QtGui.QPainter, pointed: Pointed) -> None:
        at = self._view.place_of(pointed.position)
        self._paint_ring(painter, at, pointed.is_own, pointed.is_hidden)
        if pointed.value:
            place = overlay.label_place(at, pointed.value, pointed.share, QtCore.QRectF(self._view.rect()))
            overlay.paint_label(painter, place, pointed.value, pointed.share)

    def _paint_ring(self, painter: QtGui.QPainter, at: QtCore.QPointF, is_own: bool, is_hidden: bool) -> None:
        with overlay.shrunk(painter, at, self._view.proportion):
            overlay.paint_ring(painter, at, is_own, is_hidden)

    def _cover(self) -> QtCore.QRect:
        """What the ring and its label take."""
        if self.pointed is None:
            return QtCore.QRect()
        at, reach = self._view.place_of(self.pointed.position), overlay.REACH
        found = QtCore.QRectF(at.x() - reach, at.y() - reach, 2 * reach, 2 * reach)
        if self.pointed.value:
            view = QtCore.QRectF(self._view.rect())
            found |= overlay.label_place(at, self.pointed.value, self.pointed.share, view)
        return found.toAlignedRect().adjusted(-2, -2, 2, 2)
