"""The ring that follows the pointer over surfaces and shows on every colour."""

from .shapes import Pen, Point, Shape, disc, hexadecimal

RING, ECHO = 8.0, 6.0
"""Logical pixels: the radius of the ring under the pointer, and of that in the other panels."""

REACH = 14
"""Logical pixels about a place that its ring may cover."""

BRIGHT, DARK = hexadecimal("#FFFFFF"), hexadecimal("#14161A")


def ring_shapes(at: Point, is_own: bool, is_hidden: bool = False, scale: float = 1.0) -> list[Shape]:
    """Return a white ring between dark rims, with a dot in the panel of the pointer; dashed behind the surface."""
    radius = scale * (RING if is_own else ECHO)
    shapes: list[Shape] = []
    for colour, width in ((DARK, 4.5), (BRIGHT, 2.0)):
        dashes = (4.0 / width, 3.0 / width) if is_hidden else ()
        shapes.append(disc(at, radius, pen=Pen(colour, scale * width, dashes)))
    if is_own:
        shapes.append(disc(at, 2.0 * scale, BRIGHT, Pen(DARK, scale)))
    return shapes
