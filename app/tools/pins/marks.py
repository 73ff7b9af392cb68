"""Pins on surfaces."""

from dataclasses import replace

from ...drawing.glyphs import PIN
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...scene.style import PINS
from .locations import LocatedPin, located_pins


def marks(marked: MarkedPanel) -> list[PointMark]:
    """Return the pin markers of a panel, in the order of their numbers."""
    return [pin_mark(pin) for pin in located_pins(marked.document, marked.panel.surface, marked.loaded.surface)]


def pin_mark(pin: LocatedPin) -> PointMark:
    """Return a pin marker with its number and colour."""
    colour, name = PINS[pin.pin.colour], pin.pin.name
    if pin.vertex is not None:
        return PointMark(pin.vertex, PIN, colour, number=pin.number, value=name, point=pin.point)
    corners, weights = tuple(pin.corners.tolist()), tuple(pin.weights.tolist())
    nearest = corners[int(pin.weights.argmax())]
    mark = PointMark(nearest, PIN, colour, number=pin.number, value=name, point=pin.point)
    return replace(mark, corners=corners, weights=weights)
