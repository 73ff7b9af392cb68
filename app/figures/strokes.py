"""How lines on a surface are drawn: boundaries of regions, the path of a profile, and what a field starts from."""

from collections.abc import Iterator
from dataclasses import dataclass

from ..scene import path_lines, region_lines, source_lines
from ..scene.style import WHITE, Colour, Style
from .shots import Line, Shot


@dataclass(frozen=True)
class Stroke:
    """Lines under a name, their colour, and their width in pixels at scale 1; dots: as many apart, 0 for none."""

    name: str
    lines: list[Line]
    colour: Colour
    width: float
    dots: float = 0.0


def strokes_on(shot: Shot, style: Style) -> Iterator[Stroke]:
    """One after another."""
    dark = style.mark_edge
    if shot.regions:
        yield Stroke("regions", shot.regions, WHITE, region_lines.RIM)
        yield Stroke("regions", shot.regions, dark, region_lines.WIDTH)
    if shot.course:  # covered where it is seen
        yield Stroke("path", shot.course, WHITE, path_lines.WIDE - path_lines.THINNER, path_lines.DOTS)
        yield Stroke("path", shot.course, dark, path_lines.NARROW - path_lines.THINNER, path_lines.DOTS)
    if shot.path:
        yield Stroke("path", shot.path, WHITE, path_lines.WIDE)
        yield Stroke("path", shot.path, dark, path_lines.NARROW)
    if shot.lines:
        yield Stroke("source", shot.lines, dark, source_lines.WIDTH + 2 * source_lines.RIM)
        yield Stroke("source", shot.lines, style.source, source_lines.WIDTH)
