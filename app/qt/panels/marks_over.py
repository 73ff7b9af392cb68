"""All that lies over the picture of a view, painted by Qt: the surface is drawn for none of it."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from qtpy import QtCore, QtGui

from bihdist_core.arrays import AnyArray, FloatArray

from ...drawing.axes import axes_shapes, middle
from ...drawing.glyphs import REACH, SOURCE, ring_shapes
from ...drawing.painters.qt import box_of, paint, rectangle, rgba_of
from ...drawing.scale_bar import corner_of_bar, scale_bar_shapes
from ...drawing.shapes import Box, Path, Shape, polyline
from ...marks.primitives import LegendRow, cut_away_words
from ...scene.camera import camera_seen, frame
from ...scene.lines_of_sight import pixels_in
from ..look.look import LOOK
from . import overlay
from .line_marks import LineMarks, pen_of
from .overlay import ROW, Pointed, point_of, text_shapes
from .point_marks import PointMarks

if TYPE_CHECKING:
    from .view import View

DAB = 4.0
"""Logical pixels across of a vertex that a brush touches."""

AXIS_LETTER, AXIS_WIDTH = 11.0, 1.5
"""Logical pixels of the font of the axes' letters, and of their arms' width."""


class MarksOver:
    """All that lies over a view; only lines need the depths of its picture to know where they are hidden."""

    def __init__(self, view: "View") -> None:
        self._view = view
        self.points = PointMarks(view)
        self.lines = LineMarks(view)
        self.legend: Sequence[LegendRow] = ()
        self.pointed: Pointed | None = None
        self.sentence = ""
        self.notes: Sequence[str] = ()
        self._is_covered = False  # at the top, by the progress
        self.strokes: Sequence[AnyArray] = ()  # (k, 3) each: what has been drawn
        self._has_axes = False
        self._scale_unit = ""
        self._covered = QtCore.QRect()  # by the ring and its label
        self._dabs: list[tuple[str, QtGui.QPolygonF]] = []  # of a brush that is down

    # ------------------------------------------------------------------ what there is
    def say(self, sentence: str) -> None:
        """Show why there is no field in the middle of the view; "" for nothing."""
        if sentence != self.sentence:
            self.sentence = sentence
            self._view.update()

    def write(self, notes: Sequence[str]) -> None:
        """Show how many extrema there are, in the first words for which there is room; () for nothing."""
        if notes != self.notes:
            self.notes = notes
            self._view.update()

    def cover_top(self, is_covered: bool) -> None:
        """Leave out the legend and the notes while the progress lies over them."""
        if is_covered != self._is_covered:
            self._is_covered = is_covered
            self._view.update()

    def show_axes(self, has_axes: bool) -> None:
        """Show or hide the cross in a corner that says where x, y and z point to."""
        if has_axes != self._has_axes:
            self._has_axes = has_axes
            self._view.update()

    def show_scale_bar(self, unit: str) -> None:
        """Show a scale bar in a unit, "" for none."""
        if unit != self._scale_unit:
            self._scale_unit = unit
            self._view.update()

    def point_at(self, pointed: Pointed | None) -> None:
        """Put the ring somewhere."""
        self.pointed = pointed
        before, self._covered = self._covered, self._cover()
        self._view.update(before | self._covered)

    def show_legend(self, rows: Sequence[LegendRow]) -> None:
        """Show what glyphs stand for."""
        if rows != self.legend:
            self.legend = rows
            self._view.update()

    def show_strokes(self, strokes: Sequence[AnyArray]) -> None:
        """Show the lines drawn so far, points (k, 3) each."""
        self.strokes = strokes
        self._view.update()

    def show_dabs(self, points: FloatArray | None, colour: str = "") -> None:
        """Show more vertices (k, 3) that a brush has touched, as long as it is down; None for none."""
        if points is None:
            self._dabs.clear()
        else:
            view = self._view
            at = pixels_in(view.scene.renderer, points, *view.pixels) / view.devicePixelRatioF()
            self._dabs.append((colour, QtGui.QPolygonF([QtCore.QPointF(*place) for place in at.tolist()])))
        self._view.update()

    def cut_away(self) -> tuple[str, ...]:
        """Return words on marks that are cut away, from the longest to the shortest; () for none."""
        points, lines = self.points.cut_away(), self.lines.cut_away()
        if not points and not lines:
            return ()
        words = cut_away_words(points, lines)
        return words, words.replace(" by the clip plane", "")

    def find_hidden(self) -> None:
        """Find what is hidden in the picture that has just been drawn."""
        self.points.find_hidden()
        self.lines.find_hidden()
        self._covered = self._cover()

    # ------------------------------------------------------------------ painting
    def paint(self, painter: QtGui.QPainter) -> None:
        """Paint what lies lowest first."""
        view = self._view
        painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
        self.lines.paint(painter)
        for colour, places in self._dabs:
            painter.setPen(QtGui.QPen(QtGui.QColor(colour), DAB))
            painter.drawPoints(places)
        self.points.paint_flat(painter)
        room = box_of(view.rect())
        shapes = [
            *self._axes(),
            *self._scale_bar(),
            *text_shapes(self.points.texts(), room),
            *self.points.standing_shapes(),
        ]
        if not self.sentence and not self._is_covered:
            shapes += overlay.legend_shapes(room, view.scene.style, self.legend)
            top = ROW * LOOK.scale if self.legend else 0.0
            for notes, of_extrema in ((self.notes, True), (self.cut_away(), False)):
                below = Box(0.0, top, room.width, room.height - top)
                shapes += overlay.note_shapes(below, view.scene.style, notes, of_extrema) if notes else []
                top += ROW * LOOK.scale * bool(notes)
        paint(painter, shapes)
        if self.sentence:
            overlay.paint_sentence(painter, view.rect(), self.sentence)
        paint(painter, [*self._stroke_shapes(), *self._pointed_shapes()])

    def _axes(self) -> list[Shape]:
        view = self._view
        if not self._has_axes:
            return []
        taken = [*view.scene.insets.corners]
        taken += [corner_of_bar(taken)] * bool(self._scale_unit)
        at, colour = middle(view.width(), view.height(), taken), rgba_of(LOOK.theme.quiet)
        return axes_shapes(frame(camera_seen(view.camera, 1.0)), at, AXIS_LETTER * LOOK.scale, AXIS_WIDTH, colour)

    def _scale_bar(self) -> list[Shape]:
        if not self._scale_unit:
            return []
        view, camera, theme = self._view, self._view.camera, LOOK.theme
        is_parallel = bool(camera.GetParallelProjection())
        slope = math.tan(math.radians(camera.GetViewAngle() / 2))
        half = camera.GetParallelScale() if is_parallel else slope * camera.GetDistance()
        words = "" if is_parallel else "≈ ", self._scale_unit
        ink, ground, letter = rgba_of(theme.quiet), rgba_of(theme.canvas, 0.7), AXIS_LETTER * LOOK.scale
        per_unit, taken = view.height() / (2 * half), view.scene.insets.corners
        return scale_bar_shapes(box_of(view.rect()), per_unit, words, taken, letter, AXIS_WIDTH, ink, ground)

    def _stroke_shapes(self) -> list[Shape]:
        view = self._view
        shapes: list[Shape] = []
        for stroke in self.strokes:
            places = [point_of(view.place_of(place)) for place in (stroke if len(stroke) > 1 else [*stroke, *stroke])]
            shapes += [
                Path(polyline(places), pen=pen_of(each, view.scene.style, view.proportion)) for each in SOURCE.strokes
            ]
        return shapes

    def _pointed_shapes(self) -> list[Shape]:
        if (pointed := self.pointed) is None:
            return []
        at = point_of(self._view.place_of(pointed.position))
        shapes = ring_shapes(at, pointed.is_own, pointed.is_hidden, self._view.proportion)
        if pointed.value:
            box = overlay.label_box(at, pointed.value, pointed.share, box_of(self._view.rect()))
            shapes += overlay.label_shapes(box, pointed.value, pointed.share)
        return shapes

    def _cover(self) -> QtCore.QRect:
        """Return the area of the ring and its label."""
        if self.pointed is None:
            return QtCore.QRect()
        at = point_of(self._view.place_of(self.pointed.position))
        found = rectangle(Box(*at, 0.0, 0.0).grown(REACH))
        if self.pointed.value:
            view = box_of(self._view.rect())
            found |= rectangle(overlay.label_box(at, self.pointed.value, self.pointed.share, view))
        return found.toAlignedRect().adjusted(-2, -2, 2, 2)
