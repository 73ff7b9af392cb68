"""Boundaries of regions on a surface: dark lines with a light rim, which show on every colour, hidden by what is before
them."""

from .line_actors import NEARER, RimmedLines
from .style import WHITE, Style

WIDTH, RIM = 2.0, 4.5
"""Pixels, at scale 1, of the lines, and of them with their rims."""

LOWER = 0.0002
"""Of all depth: what a source consists of is drawn over them."""


class RegionLines(RimmedLines):
    """Hidden until there are any."""

    def __init__(self, style: Style, scale: float) -> None:
        super().__init__(style.mark_edge, WHITE, WIDTH, (RIM - WIDTH) / 2, scale, NEARER - LOWER)
