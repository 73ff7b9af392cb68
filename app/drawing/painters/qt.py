"""Shapes painted by Qt, in logical pixels and the application's font."""

from collections.abc import Iterable
from functools import cache, lru_cache

import numpy as np
from qtpy import QtCore, QtGui, QtWidgets

from ..numbers import runs_of_digits
from ..shapes import RGBA, Box, Gradient, Group, Image, Path, Pen, Shape, Subpath, Text

MOST_STOPS = 129
"""Colours of a gradient that Qt is given."""

CAPS = {"butt": QtCore.Qt.PenCapStyle.FlatCap, "round": QtCore.Qt.PenCapStyle.RoundCap}
JOINS = {"miter": QtCore.Qt.PenJoinStyle.MiterJoin, "round": QtCore.Qt.PenJoinStyle.RoundJoin}


def paint(painter: QtGui.QPainter, shapes: Iterable[Shape]) -> None:
    """Paint shapes, the first of them lowest."""
    for shape in shapes:
        if isinstance(shape, Path):
            if shape.pen is not None and (box := _straight(shape)) is not None:
                painter.fillRect(box, colour(shape.pen.colour))
                continue
            path = outline(shape)
            if shape.fill is not None:
                fill = shape.fill
                painter.fillPath(path, _gradient(fill) if isinstance(fill, Gradient) else colour(fill))
            if shape.pen is not None:
                painter.strokePath(path, pen_of(shape.pen))
        elif isinstance(shape, Text):
            _paint_text(painter, shape)
        elif isinstance(shape, Image):
            painter.drawImage(rectangle(shape.box), image_of(shape.pixels))
        else:
            _paint_group(painter, shape)


def _straight(shape: Path) -> QtCore.QRectF | None:
    """Return the rectangle of a line across or down, which is painted faster so; None for any other path."""
    pen, subpaths = shape.pen, shape.subpaths
    if pen is None or shape.fill is not None or pen.dashes or pen.cap != "butt" or len(subpaths) > 1:
        return None
    (part,) = subpaths
    if part.is_closed or len(part.segments) != 1 or len(part.segments[0]) != 1 or shape.scale != (1.0, 1.0):
        return None
    (left, top), ((right, bottom),), half = part.start, part.segments[0], pen.width / 2
    x, y = shape.at
    if left == right:
        return QtCore.QRectF(x + left - half, y + min(top, bottom), pen.width, abs(bottom - top))
    if top == bottom:
        return QtCore.QRectF(x + min(left, right), y + top - half, abs(right - left), pen.width)
    return None


def _paint_group(painter: QtGui.QPainter, group: Group) -> None:
    painter.save()
    painter.setClipRect(rectangle(group.clip), QtCore.Qt.ClipOperation.IntersectClip)
    paint(painter, group.shapes)
    painter.restore()


# ---------------------------------------------------------------------- colours, pens and paths
def colour(rgba: RGBA) -> QtGui.QColor:
    """Return Qt's colour."""
    return QtGui.QColor.fromRgbF(*rgba)


def rgba_of(name: str, opacity: float = 1.0) -> RGBA:
    """Return a colour by any name that Qt knows."""
    red, green, blue, _ = QtGui.QColor(name).getRgbF()
    return red, green, blue, opacity


def pen_of(pen: Pen) -> QtGui.QPen:
    """Return Qt's pen."""
    found = QtGui.QPen(colour(pen.colour), pen.width)
    found.setCapStyle(CAPS[pen.cap])
    found.setJoinStyle(JOINS[pen.join])
    if pen.dashes:
        found.setDashPattern(list(pen.dashes))
    return found


def rectangle(box: Box) -> QtCore.QRectF:
    """Return Qt's rectangle."""
    return QtCore.QRectF(box.x, box.y, box.width, box.height)


def box_of(rectangle: QtCore.QRectF | QtCore.QRect) -> Box:
    """Return a rectangle of Qt as a box."""
    return Box(rectangle.x(), rectangle.y(), rectangle.width(), rectangle.height())


def outline(path: Path) -> QtGui.QPainterPath:
    """Return a path where it is painted, as what is under the pointer is asked, too."""
    (wide, high), (x, y) = path.scale, path.at
    return QtGui.QTransform(wide, 0, 0, high, x, y).map(_unit_path(path.subpaths))


@lru_cache(maxsize=512)
def _unit_path(subpaths: tuple[Subpath, ...]) -> QtGui.QPainterPath:
    path = QtGui.QPainterPath()
    for part in subpaths:
        path.moveTo(*part.start)
        for segment in part.segments:
            if len(segment) == 1:
                path.lineTo(*segment[0])
            else:
                path.cubicTo(*(QtCore.QPointF(*point) for point in segment))
        if part.is_closed:
            path.closeSubpath()
    return path


@lru_cache(maxsize=16)
def _gradient(gradient: Gradient) -> QtGui.QBrush:
    found, colours = QtGui.QLinearGradient(*gradient.start, *gradient.stop), gradient.colours
    shown = np.linspace(0, len(colours) - 1, min(len(colours), MOST_STOPS)).round().astype(int).tolist()
    places = np.linspace(0, 1, len(shown)).tolist() if len(shown) > 1 else [0.0]
    found.setStops([(at, QtGui.QColor.fromRgbF(*colours[k])) for at, k in zip(places, shown, strict=True)])
    return QtGui.QBrush(found)


def image_of(pixels: np.ndarray) -> QtGui.QImage:
    """Return pixels (h, w, 4) as Qt's image, which keeps a copy."""
    rows = np.ascontiguousarray(pixels)
    height, width, _ = rows.shape
    return QtGui.QImage(rows.data, width, height, 4 * width, QtGui.QImage.Format.Format_RGBA8888).copy()


# ---------------------------------------------------------------------- text
def font(size: float, is_bold: bool = False) -> QtGui.QFont:
    """Return the application's font in so many logical pixels."""
    return QtGui.QFont(_font(QtWidgets.QApplication.font().toString(), max(1, round(size)), is_bold))


@cache
def _font(usual: str, size: int, is_bold: bool) -> QtGui.QFont:
    found = QtGui.QFont()
    found.fromString(usual)
    found.setPixelSize(size)
    found.setWeight(QtGui.QFont.Weight.DemiBold if is_bold else QtGui.QFont.Weight.Normal)
    return found


def text_width(text: str, size: float, is_bold: bool = False) -> float:
    """Return the width of a text whose digits are even, in logical pixels."""
    return number_width(font(size, is_bold), text)


def _paint_text(painter: QtGui.QPainter, text: Text) -> None:
    shown = font(text.size, text.is_bold)
    painter.setFont(shown)
    metrics = QtGui.QFontMetricsF(shown)
    x, lower = 0.0, 0.0
    if text.align != "left":
        width = number_width(shown, text.text) if text.are_digits_even else metrics.horizontalAdvance(text.text)
        x = -width if text.align == "right" else -width / 2
    if text.level == "line":
        lower = (metrics.ascent() - metrics.descent()) / 2
    elif text.level != "baseline":
        lower = (metrics.capHeight() if text.level == "capitals" else metrics.xHeight()) / 2
    if text.angle or text.halo is not None:
        painter.save()
        painter.translate(text.x, text.y)
        painter.rotate(-text.angle)
        path = QtGui.QPainterPath()
        path.addText(QtCore.QPointF(x, lower), shown, text.text)
        if text.halo is not None:
            painter.strokePath(path, pen_of(text.halo))
        painter.fillPath(path, colour(text.colour))
        painter.restore()
        return
    painter.setPen(colour(text.colour))
    baseline = round(text.y + lower) if text.level == "line" else text.y + lower
    if text.are_digits_even:
        paint_number(painter, text.x + x, baseline, text.text)
    else:
        painter.drawText(QtCore.QPointF(text.x + x, baseline), text.text)


def paint_number(painter: QtGui.QPainter, x: float, baseline: float, text: str) -> float:
    """Write a text at (x, baseline), each digit in the widest one's cell, and return where it ends.

    Qt 5 cannot ask a font for figures of equal width, so numbers that change would jump.
    """
    metrics = QtGui.QFontMetricsF(painter.font())
    cell = _cell(painter.font().toString())
    for run, is_digit in runs_of_digits(text):
        if not is_digit:
            painter.drawText(QtCore.QPointF(x, baseline), run)
            x += metrics.horizontalAdvance(run)
            continue
        for digit in run:
            painter.drawText(QtCore.QPointF(x + (cell - metrics.horizontalAdvance(digit)) / 2, baseline), digit)
            x += cell
    return x


def number_width(font: QtGui.QFont, text: str) -> float:
    """Return the width of a text as `paint_number` writes it."""
    metrics, cell = QtGui.QFontMetricsF(font), _cell(font.toString())
    runs = runs_of_digits(text)
    return sum(cell * len(run) if is_digit else metrics.horizontalAdvance(run) for run, is_digit in runs)


@lru_cache(maxsize=64)
def _cell(font: str) -> float:
    """Return the width of the widest digit."""
    known = QtGui.QFont()
    known.fromString(font)
    metrics = QtGui.QFontMetricsF(known)
    return float(max(metrics.horizontalAdvance(digit) for digit in "0123456789"))
