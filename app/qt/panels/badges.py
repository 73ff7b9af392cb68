"""Discs of pins, sources and panels in charts, heads, lists and menus, as on surfaces."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from qtpy import QtCore, QtGui, QtWidgets

from ...drawing.glyphs import SCREEN_NUMERAL
from ...drawing.painters.qt import paint, rgba_of
from ...drawing.shapes import Pen, Point, Shape, Text, disc
from ...scene.style import PINS
from ..look.look import LOOK
from .overlay import WHITE, point_of

RADIUS = 8.5
"""Radius of a badge in logical pixels: as large as the head of a pin."""

SOURCE, RIM = "#FFDB1A", "#1A1A1F"

COLOUR_NAMES = ("Green", "Orange", "Violet", "Olive", "Plum", "Slate", "Brown", "Teal", "Indigo", "Ochre")
"""The names of PINS."""


@dataclass(frozen=True)
class Badge:
    """A point of the document: the text on its disc, "" for a source, its colour and its name."""

    text: str
    colour: str
    name: str = ""


def badge_shapes(at: Point, badge: Badge) -> list[Shape]:
    """Return a disc with a number, or a small one with a rim without a number."""
    if not badge.text:
        return [disc(at, 5.0, rgba_of(badge.colour), Pen(rgba_of(RIM), 1.5))]
    radius = RADIUS * LOOK.scale
    size = SCREEN_NUMERAL[min(len(badge.text), 3) - 1] * radius
    numeral = Text(badge.text, *at, size, WHITE, is_bold=True, align="centre", level="capitals")
    return [disc(at, radius, rgba_of(badge.colour)), numeral]


def paint_badge(painter: QtGui.QPainter, at: QtCore.QPointF, badge: Badge) -> None:
    """Paint a badge about a place."""
    paint(painter, badge_shapes(point_of(at), badge))


def icon_of(side: float, shapes: Sequence[Shape]) -> QtGui.QIcon:
    """Return shapes as an icon of this side in logical pixels."""
    picture = QtGui.QPixmap(round(2 * side), round(2 * side))
    picture.setDevicePixelRatio(2)
    picture.fill(QtCore.Qt.GlobalColor.transparent)
    painter = QtGui.QPainter(picture)
    painter.setRenderHint(QtGui.QPainter.RenderHint.Antialiasing)
    paint(painter, shapes)
    painter.end()
    icon = QtGui.QIcon(picture)
    icon.addPixmap(picture, QtGui.QIcon.Mode.Selected)  # which else is tinted
    return icon


def disc_icon(colour: str, text: str = "", side: float = 16.0, radius: float = 5.0) -> QtGui.QIcon:
    """Return an icon with a disc of a colour, or with the badge of a pin if there is a text."""
    if text:
        middle = RADIUS * LOOK.scale
        return icon_of(2 * middle, badge_shapes((middle, middle), Badge(text, colour)))
    return icon_of(side, [disc((side / 2, side / 2), radius, rgba_of(colour))])


def add_colours(menu: QtWidgets.QMenu, choose: Callable[[int], object]) -> None:
    """Add a menu of the colours of pins, whose numbers a function takes."""
    colours = menu.addMenu("Colour")
    for number, (name, colour) in enumerate(zip(COLOUR_NAMES, PINS, strict=True)):
        colours.addAction(disc_icon(colour), name, lambda number=number: choose(number))


def curve_colour(place: int) -> str:
    """Return the colour of the panel at a place, by which docks tell panels and their curves apart."""
    return LOOK.theme.curves[place % len(LOOK.theme.curves)]
