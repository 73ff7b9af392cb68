"""Lines over a surface, such as a path or what a field starts from: painted on its picture by their looks."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtGui

from ...marks.line_looks import LineLook, Stroke
from ...scene.line_clipping import clipped
from ...scene.lines_of_sight import seen_in
from ...scene.style import Style
from ..look.painting import round_pen

if TYPE_CHECKING:
    from .view import View

Course = tuple[LineLook, np.ndarray]
"""A look, and points (k, 3) of a line."""

FINE = 0.005
"""Of the extent of all lines, at most from one of their points to the next: so finely it is told what is hidden."""


class LineMarks:
    """The lines of one view.

    points: (k, 3) of all, one line after another.  pixels: (k, 2) device pixels of these, y down, or NaN;
    is_seen: (k,) whether the surface is not before them; both of the picture that `see` was called for.
    """

    def __init__(self, view: "View") -> None:
        self._view = view
        self._looks: list[LineLook] = []
        self.points, self._ends = np.empty((0, 3)), np.empty(0, int)
        self._forget()

    def _forget(self) -> None:
        self.pixels, self.is_seen = np.empty((0, 2)), np.empty(0, bool)
        self._paths: list[tuple[QtGui.QRegion, list[tuple[Stroke, QtGui.QPainterPath]]]] = []

    def show(self, lines: Sequence[Course]) -> None:
        """These and no others, from the next picture on."""
        lines = sorted(lines, key=lambda line: line[0].rank)
        extent = max((float(np.ptp(points, axis=0).max()) for _, points in lines), default=0.0)
        courses = [_refined(points, FINE * extent) for _, points in lines]
        self._looks = [look for look, _ in lines]
        self.points = np.concatenate([np.empty((0, 3)), *courses])
        self._ends = np.cumsum([len(points) for points in courses])[:-1]

    def see(self) -> None:
        """What is seen in the picture that has just been drawn, and in its insets."""
        self._forget()
        if not self._looks:
            return
        view, depths = self._view, self._view.offscreen.depths()
        for renderer, region, (left, top, width, height) in view.parts():
            pixels, is_seen = seen_in(renderer, self.points, depths[top : top + height, left : left + width])
            pixels += left, top
            if renderer is view.scene.renderer:
                self.pixels, self.is_seen = pixels, is_seen
            self._paths.append((region, list(self._strokes(pixels / view.devicePixelRatioF(), is_seen))))

    def _strokes(self, pixels: np.ndarray, is_seen: np.ndarray) -> Iterator[tuple[Stroke, QtGui.QPainterPath]]:
        """The lowest first; lines of one look are one path, so that where they meet no rim lies over another line."""
        places, seen = np.split(pixels, self._ends), np.split(is_seen, self._ends)
        looks = dict.fromkeys(self._looks)
        width, height = self._view.width(), self._view.height()
        about = -width, 2 * width, -height, 2 * height
        for is_meant in (False, True):  # what is hidden lies behind
            for look in looks:
                path = QtGui.QPainterPath()
                for other, line, which in zip(self._looks, places, seen, strict=True):
                    for run in _runs(line, which == is_meant) if other == look else ():
                        # Beside the eye lines go on for millions of pixels, each with its dots.
                        for piece, _ in clipped((run, False), about):
                            path.addPolygon(QtGui.QPolygonF([QtCore.QPointF(*place) for place in piece.tolist()]))
                if not path.isEmpty():
                    yield from ((stroke, path) for stroke in (look.strokes if is_meant else look.hidden))

    def paint(self, painter: QtGui.QPainter) -> None:
        """On the view and its insets."""
        view = self._view
        for region, strokes in self._paths:
            painter.save()
            painter.setClipRegion(region, QtCore.Qt.ClipOperation.IntersectClip)
            for stroke, path in strokes:
                painter.strokePath(path, pen_of(stroke, view.scene.style, view.proportion))
            painter.restore()


def pen_of(stroke: Stroke, style: Style, share: float) -> QtGui.QPen:
    """What a stroke is painted with, in this share of its usual width."""
    pen = round_pen(QtGui.QColor.fromRgbF(*style.named(stroke.colour)), share * stroke.width)
    if stroke.dots:
        pen.setDashPattern([0.01, stroke.dots / stroke.width])
    return pen


def _refined(points: np.ndarray, step: float) -> np.ndarray:
    """Points (k, 3) of a line with others between them, none farther than a step from the next."""
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    if not (step > 0 and (lengths > step).any()):
        return points
    counts = np.ceil(np.maximum(lengths / step, 1)).astype(int)
    at = np.append(
        np.repeat(np.arange(len(counts)), counts) + np.concatenate([np.arange(n) / n for n in counts]), len(counts)
    )
    return np.stack([np.interp(at, np.arange(len(points)), x) for x in points.T], 1)


def _runs(places: np.ndarray, is_meant: np.ndarray) -> list[np.ndarray]:
    """The pieces (l, 2) of places (k, 2) both of whose ends are meant; a change in between belongs to neither, so that
    they just meet."""
    meant = is_meant & np.isfinite(places).all(axis=1)
    pieces = meant[:-1] & meant[1:]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], pieces, [False]]).astype(int)))
    return [places[first : last + 1] for first, last in edges.reshape(-1, 2)]
