"""Where a field starts, over a view: discs with a rim, which no surface clips; dashed rings where it hides them."""

from typing import Any

import numpy as np
from qtpy import QtCore, QtGui

from bihdist_core.arrays import FloatArray

from ...scene.picking import pixel_of
from ...scene.source_disc import DASHED, DASHES, HALO, RIM
from ...scene.style import Colour
from .seen_places import SeenPlaces


class SourceMarks(SeenPlaces):
    """Also in the view's insets."""

    def paint(self, painter: QtGui.QPainter) -> None:
        """Those that are hidden lie lowest."""
        if not len(self.positions):
            return
        seen, view = self.seen(), self._view
        style, across = view.scene.style, view.mark_size
        main, insets = view.renderer, view.scene.insets
        everywhere = QtGui.QRegion(view.rect())
        boxes = {renderer: self._box(*box) for renderer, box in insets.placed.items()}
        for box in boxes.values():
            everywhere -= QtGui.QRegion(box)
        painter.save()
        for renderer, region in {main: everywhere, **{r: QtGui.QRegion(box) for r, box in boxes.items()}}.items():
            painter.setClipRegion(region)
            for k in np.argsort(seen, kind="stable").tolist():
                at = self.at(renderer, self.positions[k])
                if seen[k]:
                    paint_disc(painter, at, across, style.source, style.mark_edge)
                else:
                    paint_dashed(painter, at, across, style.background, style.text)
        painter.restore()

    def at(self, renderer: Any, position: FloatArray) -> QtCore.QPointF:
        """Where a position (3,) is seen in the view or in an inset, in logical pixels."""
        x, y = pixel_of(renderer, position)
        ratio = self._view.devicePixelRatioF()
        return QtCore.QPointF(x / ratio, self._view.height() - y / ratio)

    def _box(self, left: int, bottom: int, width: int, height: int) -> QtCore.QRect:
        """In logical pixels, of a box in device pixels with y up."""
        ratio = self._view.devicePixelRatioF()
        top = self._view.height() - (bottom + height) / ratio
        return QtCore.QRectF(left / ratio, top, width / ratio, height / ratio).toAlignedRect()


def paint_disc(painter: QtGui.QPainter, at: QtCore.QPointF, across: float, colour: Colour, rim: Colour) -> None:
    """A place that is seen."""
    width = RIM * across
    painter.setPen(QtGui.QPen(QtGui.QColor.fromRgbF(*rim), width))
    painter.setBrush(QtGui.QColor.fromRgbF(*colour))
    radius = (across - width) / 2
    painter.drawEllipse(at, radius, radius)


def paint_dashed(painter: QtGui.QPainter, at: QtCore.QPointF, across: float, under: Colour, colour: Colour) -> None:
    """A place on the far side: light under dark, to be seen on every colour."""
    width = DASHED * across
    painter.setBrush(QtCore.Qt.BrushStyle.NoBrush)
    radius = (across - width) / 2
    for shade, wide, dashes in ((under, HALO * width, ()), (colour, width, DASHES)):
        pen = QtGui.QPen(QtGui.QColor.fromRgbF(*shade), wide)
        if dashes:
            pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap)
            pen.setDashPattern(list(dashes))
        painter.setPen(pen)
        painter.drawEllipse(at, radius, radius)
