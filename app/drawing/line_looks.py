"""The looks of lines on surfaces, each defined once, for the window and figures."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Stroke:
    """A stroke in a named colour, so many pixels wide at scale 1, or of dots as many pixels apart."""

    colour: str
    width: float
    dots: float = 0.0


@dataclass(frozen=True)
class LineLook:
    """The strokes of a line, the lowest first; lines of a higher rank are drawn over others.

    Attributes
    ----------
    hidden
        Strokes where the surface is before the line, () for none.
    """

    name: str
    strokes: tuple[Stroke, ...]
    hidden: tuple[Stroke, ...] = ()
    rank: int = 0


BOUNDARY = LineLook("regions", (Stroke("white", 4.5), Stroke("mark_edge", 2.0)))
"""The look of a region's boundary."""
PATH = LineLook(
    "path",
    (Stroke("white", 4.5), Stroke("mark_edge", 2.0)),
    hidden=(Stroke("white", 4.0, dots=6.0), Stroke("mark_edge", 1.5, dots=6.0)),
    rank=1,
)
"""The look of a profile's path."""
LABELS = LineLook("labels", (Stroke("outline_colour", 0.7),), rank=-3)
"""The look of borders between labels."""
FEATURE_EDGES = LineLook("feature-edges", (Stroke("outline_colour", 0.7),), rank=-2)
"""The look of lines along sharp edges."""
SECTION = LineLook("section", (Stroke("section", 1.8),), rank=-1)
"""The look of the line where a clip plane cuts a surface."""
SOURCE = LineLook("source", (Stroke("mark_edge", 6.0), Stroke("source", 3.5)), rank=2)
"""The look of a line from which a field starts."""
