"""Lines over a surface that are also told where it hides them, such as a path: painted on its picture."""

from collections.abc import Sequence

import numpy as np
from qtpy import QtCore, QtGui

from ...marks.line_looks import LineLook
from ...scene.lines_of_sight import seen_in
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.panel_scene import PanelScene
from ...scene.style import Style
from ..look.painting import round_pen

Course = tuple[LineLook, np.ndarray]
"""A look, and points (k, 3) of a line."""


class LineMarks:
    """The lines of one view.

    points: (k, 3) of all, one line after another.  pixels: (k, 2) device pixels of these, y down, NaN where there is
    nothing to paint; is_seen: (k,) whether the surface is not before them; both of the picture that `see` was called
    for.
    """

    def __init__(self) -> None:
        self._lines: Sequence[Course] = ()
        self.pixels, self.is_seen = np.empty((0, 2)), np.empty(0, bool)

    @property
    def points(self) -> np.ndarray:
        """All points (k, 3) of the lines."""
        return np.concatenate([np.empty((0, 3)), *(points for _, points in self._lines)])

    def show(self, lines: Sequence[Course]) -> bool:
        """These, and whether that has to be drawn."""
        before, self._lines = self._lines, sorted(lines, key=lambda line: line[0].rank)
        return bool(before or lines)

    def see(self, scene: PanelScene, offscreen: OffscreenRenderer) -> None:
        """What is seen in the picture that has just been drawn; insets lie over the lines."""
        self.pixels, self.is_seen = np.empty((0, 2)), np.empty(0, bool)
        if not self._lines:
            return
        depths = offscreen.depths()
        self.pixels, self.is_seen = seen_in(scene.renderer, self.points, depths)
        for left, bottom, width, height in scene.insets.covered:
            top = len(depths) - bottom - height
            low, high = (left, top), (left + width, top + height)
            self.pixels[((self.pixels >= low) & (self.pixels < high)).all(axis=1)] = np.nan

    def paint(self, painter: QtGui.QPainter, style: Style, ratio: float, share: float = 1.0) -> None:
        """ratio: device pixels in a logical one; share: of the usual widths."""
        if not len(self.pixels):
            return
        ends = np.cumsum([len(points) for _, points in self._lines])[:-1]
        places, seen = np.split(self.pixels / ratio, ends), np.split(self.is_seen, ends)
        painter.save()
        painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
        for is_seen in (False, True):  # what is hidden lies behind
            for (look, _), line, which in zip(self._lines, places, seen, strict=True):
                pieces = _runs(line, which == is_seen)
                for stroke in look.strokes if is_seen else look.hidden:
                    pen = round_pen(QtGui.QColor.fromRgbF(*style.named(stroke.colour)), share * stroke.width)
                    if stroke.dots:
                        pen.setDashPattern([0.01, stroke.dots / stroke.width])
                    painter.setPen(pen)
                    for piece in pieces:
                        painter.drawPolyline(piece)
        painter.restore()


def _runs(places: np.ndarray, is_meant: np.ndarray) -> list[QtGui.QPolygonF]:
    """The pieces both of whose ends are meant; a change in between belongs to neither, so that they just meet."""
    meant = is_meant & np.isfinite(places).all(axis=1)
    pieces = meant[:-1] & meant[1:]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], pieces, [False]]).astype(int)))
    return [
        QtGui.QPolygonF([QtCore.QPointF(x, y) for x, y in places[first : last + 1].tolist()])
        for first, last in edges.reshape(-1, 2)
    ]
