"""A path over a surface: dark on white where it is seen, dotted where the surface hides it."""

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import AnyArray, FloatArray

from ...marks.line_looks import PATH
from ...scene.lines_of_sight import seen_in
from ...scene.offscreen_renderer import OffscreenRenderer
from ...scene.panel_scene import PanelScene
from ...scene.style import Style


class PathMarks:
    """The path of one view.

    pixels: (k, 2) device pixels of its points, y down, NaN where there is nothing to paint; is_seen: (k,) whether the
    surface is not before them; both of the picture that `see` was called for.
    """

    def __init__(self) -> None:
        self.points = np.empty((0, 3))
        self.pixels, self.is_seen = np.empty((0, 2)), np.empty(0, bool)

    def show(self, points: FloatArray) -> bool:
        """Through points (k, 3) of the surface, none if there are none; whether that has to be drawn."""
        before, self.points = self.points, points
        return bool(len(points) or len(before))

    def see(self, scene: PanelScene, offscreen: OffscreenRenderer) -> None:
        """What is seen in the picture that has just been drawn; insets lie over the path."""
        self.pixels, self.is_seen = np.empty((0, 2)), np.empty(0, bool)
        if not len(self.points):
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
        places = self.pixels / ratio
        painter.save()
        painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
        for seen in (False, True):  # what is hidden lies behind
            lines = _runs(places, self.is_seen == seen)
            for stroke in PATH.strokes if seen else PATH.hidden:
                pen = QtGui.QPen(QtGui.QColor.fromRgbF(*style.named(stroke.colour)), share * stroke.width)
                pen.setCapStyle(QtCore.Qt.PenCapStyle.RoundCap)
                pen.setJoinStyle(QtCore.Qt.PenJoinStyle.RoundJoin)
                if stroke.dots:
                    pen.setDashPattern([0.01, stroke.dots / stroke.width])
                painter.setPen(pen)
                for line in lines:
                    painter.drawPolyline(line)
        painter.restore()


def _runs(places: FloatArray, is_meant: AnyArray) -> list[QtGui.QPolygonF]:
    """The pieces both of whose ends are meant; a change in between belongs to neither, so that they just meet."""
    meant = is_meant & np.isfinite(places).all(axis=1)
    pieces = meant[:-1] & meant[1:]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], pieces, [False]]).astype(int)))
    return [
        QtGui.QPolygonF([QtCore.QPointF(x, y) for x, y in places[first : last + 1].tolist()])
        for first, last in edges.reshape(-1, 2)
    ]
