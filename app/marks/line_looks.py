"""How lines on surfaces look, each defined once: the window and figures draw them from here."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Stroke:
    """colour: a name that `Style.named` knows.  width: pixels at scale 1; dots: as many apart, 0 for none."""

    colour: str
    width: float
    dots: float = 0.0


@dataclass(frozen=True)
class LineLook:
    """strokes: the lowest first; hidden: where the surface is before the line, () for nothing.

    rank: lines of a higher one are drawn over others.
    """

    name: str
    strokes: tuple[Stroke, ...]
    hidden: tuple[Stroke, ...] = ()
    rank: int = 0


BOUNDARY = LineLook("regions", (Stroke("white", 4.5), Stroke("mark_edge", 2.0)))
"""Of a region."""
PATH = LineLook(
    "path",
    (Stroke("white", 4.5), Stroke("mark_edge", 2.0)),
    hidden=(Stroke("white", 4.0, dots=6.0), Stroke("mark_edge", 1.5, dots=6.0)),
    rank=1,
)
"""Of a profile."""
SOURCE = LineLook("source", (Stroke("mark_edge", 6.0), Stroke("source", 3.5)), rank=2)
"""What a field starts from."""
