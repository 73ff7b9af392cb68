"""Rectangles and lines of text on a page, in units of 1/96 inch, y down."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Box:
    """A rectangle."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """The x of the right side."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """The y of the lower side."""
        return self.y + self.height

    @property
    def middle(self) -> tuple[float, float]:
        """The x and y of the centre."""
        return self.x + self.width / 2, self.y + self.height / 2

    def without(self, edge: float) -> Box:
        """The box with so much less at each side."""
        edge = min(edge, self.width / 4, self.height / 4)
        return Box(self.x + edge, self.y + edge, self.width - 2 * edge, self.height - 2 * edge)

    def meets(self, other: Box) -> bool:
        """Whether two boxes overlap."""
        return self.x < other.right and other.x < self.right and self.y < other.bottom and other.y < self.bottom

    def holds(self, x: float, y: float, edge: float = 0.0) -> bool:
        """Whether a place is inside, or outside by less than `edge`."""
        return self.x - edge <= x <= self.right + edge and self.y - edge <= y <= self.bottom + edge

    def snapped(self, scale: float) -> Box:
        """The box with its sides on whole pixels."""
        x, y = round(self.x * scale), round(self.y * scale)
        right, bottom = max(round(self.right * scale), x + 1), max(round(self.bottom * scale), y + 1)
        return Box(x / scale, y / scale, (right - x) / scale, (bottom - y) / scale)

    def pixels(self, scale: float) -> tuple[int, int, int, int]:
        """Left, top, width and height of a snapped box in pixels."""
        return round(self.x * scale), round(self.y * scale), round(self.width * scale), round(self.height * scale)


@dataclass(frozen=True)
class Words:
    """Lines of text about x, the first standing on y; with `turned` they run upwards, the first standing on x."""

    lines: tuple[str, ...]
    x: float
    y: float
    size: float
    is_bold: bool = False
    is_quiet: bool = False
    turned: bool = False
