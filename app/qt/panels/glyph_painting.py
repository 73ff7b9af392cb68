"""Glyphs of marks over a view, painted by Qt."""

from functools import cache

from qtpy import QtCore, QtGui

from ...marks.glyphs import Glyph, Layer, Subpath
from ...marks.primitives import PointMark
from ...scene.style import Style
from ..look.look import LOOK
from .number_badge import paint_numeral
from .overlay import shrunk

LEAST = 0.75
"""The fraction of its size that a glyph with a number has in small views, at least: that is to be read."""

RIMS = 2.5
"""Logical pixels around the head of one that stands above its place."""

LIT = (9.0, 4.5)
"""Logical pixels of the lines around one that stands out: in the window's accent, and in white."""

_CAPS = {"butt": QtCore.Qt.PenCapStyle.FlatCap, "round": QtCore.Qt.PenCapStyle.RoundCap}
_JOINS = {"miter": QtCore.Qt.PenJoinStyle.MiterJoin, "round": QtCore.Qt.PenJoinStyle.RoundJoin}


def paint_glyph(
    painter: QtGui.QPainter,
    mark: PointMark,
    at: QtCore.QPointF,
    style: Style,
    proportion: float,
    is_hidden: bool = False,
    is_lit: bool = False,
) -> None:
    """A mark's glyph about a place; proportion: of the usual size of marks."""
    glyph = mark.glyph.hidden if is_hidden else mark.glyph
    if glyph is None:
        return
    with shrunk(painter, at, _share(glyph, proportion)):
        reach = reach_of(glyph, style)
        rim = max(glyph.rim * reach, glyph.least_rim)
        way = -1.0 if hangs_down(glyph, at) else 1.0

        def outline(inset: float = 0.0) -> QtGui.QPainterPath:
            size = reach - inset * rim
            return QtGui.QTransform(size, 0, 0, way * size, at.x(), at.y()).map(_path(glyph.outline))

        layers = glyph.screen or glyph.layers
        if is_lit:
            for colour, width in zip((LOOK.theme.accent, "white"), LIT, strict=True):
                painter.strokePath(outline(), _pen(glyph, QtGui.QColor(colour), width))
            layers = tuple(layer for layer in layers if layer.line != "mark_edge")
        for layer in layers:
            painter.setOpacity(layer.opacity)
            if layer.fill:
                painter.fillPath(outline(layer.inset), _colour(mark, style, layer.fill))
            if layer.line:
                pen = _pen(glyph, _colour(mark, style, layer.line), layer.width * rim, layer)
                painter.strokePath(outline(layer.inset), pen)
        painter.setOpacity(1.0)
        if glyph.rise and mark.number is not None:
            middle = at - QtCore.QPointF(0, way * glyph.rise * reach)
            paint_numeral(painter, middle, mark.number, _colour(mark, style, glyph.numeral))


def reach_of(glyph: Glyph, style: Style) -> float:
    """Logical pixels from the place to the outside, in a view of the usual size."""
    return glyph.pixels * LOOK.scale if glyph.pixels else glyph.reach_of(style.marker_size, 0.0)


def hangs_down(glyph: Glyph, tip: QtCore.QPointF) -> bool:
    """Whether one that stands above its place hangs below it, as the view ends above."""
    return glyph.rise > 0 and tip.y() <= ((glyph.rise + 1) * glyph.pixels + RIMS) * LOOK.scale


def outline_at(glyph: Glyph, tip: QtCore.QPointF, style: Style) -> QtGui.QPainterPath:
    """The outline of a glyph about a place, in a view of the usual size."""
    reach = reach_of(glyph, style)
    way = -1.0 if hangs_down(glyph, tip) else 1.0
    return QtGui.QTransform(reach, 0, 0, way * reach, tip.x(), tip.y()).map(_path(glyph.outline))


def covers(glyph: Glyph, tip: QtCore.QPointF, place: QtCore.QPointF, style: Style, proportion: float) -> bool:
    """Whether the glyph about one place covers another."""
    return bool(outline_at(glyph, tip, style).contains(tip + (place - tip) / _share(glyph, proportion)))


def paint_sample(painter: QtGui.QPainter, glyph: Glyph, middle: QtCore.QPointF, colour: QtGui.QColor) -> None:
    """A glyph in quiet lines, small, about a place: for a legend."""
    size = (0.6 if glyph.rise else 0.7) * glyph.pixels * LOOK.scale
    at = middle + QtCore.QPointF(0, 0.9 * glyph.rise * size)
    path = QtGui.QTransform(size, 0, 0, size, at.x(), at.y()).map(_path(glyph.outline))
    dashes = (glyph.screen or glyph.layers)[-1].dashes
    painter.strokePath(path, _pen(glyph, colour, 1.3 if dashes else 1.6, Layer(dashes=dashes)))


def _share(glyph: Glyph, proportion: float) -> float:
    return max(proportion, LEAST) if glyph.rise else proportion


def _colour(mark: PointMark, style: Style, name: str) -> QtGui.QColor:
    return QtGui.QColor.fromRgbF(*style.named(mark.colour if name == "own" else name))


def _pen(glyph: Glyph, colour: QtGui.QColor, width: float, layer: Layer | None = None) -> QtGui.QPen:
    pen = QtGui.QPen(colour, width)
    pen.setJoinStyle(_JOINS[glyph.join])
    pen.setCapStyle(_CAPS[glyph.cap])
    if layer is not None and layer.dashes:
        pen.setCapStyle(QtCore.Qt.PenCapStyle.FlatCap)
        pen.setDashPattern(list(layer.dashes))
    return pen


@cache
def _path(outline: tuple[Subpath, ...]) -> QtGui.QPainterPath:
    """In unit coordinates."""
    path = QtGui.QPainterPath()
    for part in outline:
        path.moveTo(*part.start)
        for segment in part.segments:
            points = [QtCore.QPointF(*point) for point in segment]
            if len(points) == 1:
                path.lineTo(*points)
            else:
                path.cubicTo(*points)
        if part.is_closed:
            path.closeSubpath()
    return path
