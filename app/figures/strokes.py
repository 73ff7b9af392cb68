"""How lines on a surface are drawn: boundaries of regions, and what a field starts from."""

from collections.abc import Iterator

from ..drawing import region_lines, source_lines
from ..drawing.style import WHITE, Colour, Style
from .shots import Line, Shot


def strokes_on(shot: Shot, style: Style) -> Iterator[tuple[str, list[Line], Colour, float]]:
    """One after another: a name, the lines, their colour, and their width in pixels at scale 1."""
    if shot.regions:
        yield "regions", shot.regions, WHITE, region_lines.RIM
        yield "regions", shot.regions, style.mark_edge, region_lines.WIDTH
    if shot.lines:
        yield "source", shot.lines, style.mark_edge, source_lines.WIDTH + 2 * source_lines.RIM
        yield "source", shot.lines, style.source, source_lines.WIDTH
