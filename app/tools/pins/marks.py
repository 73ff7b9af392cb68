"""Pins on surfaces."""

from ...marks.glyphs import PIN
from ...marks.marked_panel import MarkedPanel
from ...marks.primitives import PointMark
from ...scene.style import PINS
from .locations import LocatedPin, located_pins


def marks(marked: MarkedPanel) -> list[PointMark]:
    """In the order of their numbers."""
    return [pin_mark(pin) for pin in located_pins(marked.document, marked.panel.surface, marked.loaded.surface)]


def pin_mark(pin: LocatedPin) -> PointMark:
    """A pin marker with its number and colour."""
    colour = PINS[pin.pin.colour]
    if pin.vertex is not None:
        return PointMark(pin.vertex, PIN, colour, number=pin.number, point=pin.point)
    corners, weights = tuple(pin.corners.tolist()), tuple(pin.weights.tolist())
    nearest = corners[int(pin.weights.argmax())]
    return PointMark(nearest, PIN, colour, number=pin.number, corners=corners, weights=weights, point=pin.point)
