"""Lines over a surface, such as a path or what a field starts from: painted on its picture by their looks."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np
from qtpy import QtCore, QtGui

from ...drawing.glyphs import LineLook, Stroke
from ...drawing.painters import qt
from ...drawing.shapes import Box, Pen, opaque
from ...scene.clipping import is_kept, lines_cut_away
from ...scene.line_clipping import clipped
from ...scene.lines_of_sight import seen_in
from ...scene.style import Style

if TYPE_CHECKING:
    from .view import View

Course = tuple[str, LineLook, np.ndarray]
"""The name, the look, and points (k, 3) of a line."""

FINE = 0.005
"""Longest step along lines, as a fraction of their extent, for finding hidden marks."""


class LineMarks:
    """The lines of one view.

    Attributes
    ----------
    points
        (k, 3) points of all lines, one line after another.
    pixels
        (k, 2) device pixels of these in the last picture, y down; NaN for what is not in it.
    is_seen
        (k,) whether the surface does not hide them.
    """

    def __init__(self, view: "View") -> None:
        self._view = view
        self._names: list[str] = []
        self._looks: list[LineLook] = []
        self.points, self._ends = np.empty((0, 3)), np.empty(0, int)
        self._forget()

    def _forget(self) -> None:
        self.pixels, self.is_seen = np.empty((0, 2)), np.empty(0, bool)
        self._paths: list[tuple[QtGui.QRegion, list[tuple[Stroke, float, QtGui.QPainterPath]]]] = []

    def show(self, lines: Sequence[Course]) -> None:
        """Show these lines and no others, from the next picture on."""
        lines = sorted(lines, key=lambda line: line[1].rank)
        extent = max((float(np.ptp(points, axis=0).max()) for _, _, points in lines), default=0.0)
        courses = [_refined(points, FINE * extent) for _, _, points in lines]
        self._names, self._looks = [name for name, _, _ in lines], [look for _, look, _ in lines]
        self.points = np.concatenate([np.empty((0, 3)), *courses])
        self._ends = np.cumsum([len(points) for points in courses])[:-1]

    def cut_away(self) -> list[str]:
        """Return the names of lines that are cut away."""
        return lines_cut_away(self._view.clip, zip(self._names, np.split(self.points, self._ends), strict=False))

    def find_hidden(self) -> None:
        """Find what is seen in the picture that has just been drawn, and in its insets."""
        self._forget()
        if not self._looks:
            return
        view, depths = self._view, self._depths()
        for renderer, region, (left, top, width, height) in view.parts():
            pixels, is_seen = seen_in(renderer, self.points, depths[top : top + height, left : left + width])
            pixels += left, top
            pixels[~is_kept(view.clip, self.points)] = np.nan
            if renderer is view.scene.renderer:
                self.pixels, self.is_seen = pixels, is_seen
            self._paths.append((region, list(self._strokes(pixels / view.devicePixelRatioF(), is_seen))))

    def _depths(self) -> np.ndarray:
        """Return the depths of the last picture, those of its surfaces if they are translucent, which leave none."""
        view, actor, scene = self._view, self._view.scene.field_actor, self._view.scene
        opacity, seconds = actor.opacity, scene.seconds
        if opacity < 1:
            actor.show_opacity(1.0)
            view.offscreen.picture(scene, view.pixels)
            actor.show_opacity(opacity)
            scene.seconds = seconds
        return view.offscreen.depths()

    def _strokes(self, pixels: np.ndarray, is_seen: np.ndarray) -> Iterator[tuple[Stroke, float, QtGui.QPainterPath]]:
        """Yield strokes with their opacity, the lowest first.

        Lines of one look are one path, so that no rim lies over a line.
        """
        places, seen = np.split(pixels, self._ends), np.split(is_seen, self._ends)
        looks = dict.fromkeys(self._looks)
        width, height = self._view.width(), self._view.height()
        about = Box(-width, -height, 3 * width, 3 * height)
        for shows_seen in (False, True):  # what is hidden lies behind
            for look in looks:
                path = QtGui.QPainterPath()
                for other, line, which in zip(self._looks, places, seen, strict=True):
                    for run in _runs(line, which == shows_seen) if other == look else ():
                        # Beside the eye lines go on for millions of pixels, each with its dots.
                        for piece, _ in clipped((run, False), about):
                            path.addPolygon(QtGui.QPolygonF([QtCore.QPointF(*place) for place in piece.tolist()]))
                if not path.isEmpty():
                    opacity = self._view.scene.field_actor.opacity
                    strokes, own = (look.strokes, 1.0) if shows_seen else look.behind(opacity)
                    yield from ((stroke, own, path) for stroke in strokes)

    def paint(self, painter: QtGui.QPainter) -> None:
        """Paint on the view and its insets."""
        view = self._view
        for region, strokes in self._paths:
            painter.save()
            painter.setClipRegion(region, QtCore.Qt.ClipOperation.IntersectClip)
            for stroke, opacity, path in strokes:
                painter.setOpacity(opacity)
                painter.strokePath(path, qt.pen_of(pen_of(stroke, view.scene.style, view.proportion)))
            painter.restore()


def pen_of(stroke: Stroke, style: Style, scale: float) -> Pen:
    """Return the pen of a stroke at a scale of its usual width."""
    dashes = (0.01, stroke.dots / stroke.width) if stroke.dots else ()
    return Pen(opaque(style.named(stroke.colour)), scale * stroke.width, dashes, "round", "round")


def _refined(points: np.ndarray, step: float) -> np.ndarray:
    """Return points (k, 3) of a line with others between them, none farther than a step from the next."""
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    if not (step > 0 and (lengths > step).any()):
        return points
    counts = np.ceil(np.maximum(lengths / step, 1)).astype(int)
    at = np.append(
        np.repeat(np.arange(len(counts)), counts) + np.concatenate([np.arange(n) / n for n in counts]), len(counts)
    )
    return np.stack([np.interp(at, np.arange(len(points)), x) for x in points.T], 1)


def _runs(places: np.ndarray, is_wanted: np.ndarray) -> list[np.ndarray]:
    """Return the pieces (l, 2) of places (k, 2) both of whose ends are wanted, so that neighbours just meet."""
    wanted = is_wanted & np.isfinite(places).all(axis=1)
    pieces = wanted[:-1] & wanted[1:]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], pieces, [False]]).astype(int)))
    return [places[first : last + 1] for first, last in edges.reshape(-1, 2)]
