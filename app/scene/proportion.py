"""How large lines and marks are where a view is small: in proportion to it, so that they do not hide the shape."""

USUAL = 400.0
"""Pixels, at scale 1, of the shorter side of a view from which on lines and marks have the size that a style says."""

LEAST = 0.6
"""Of that size, at least: what is white must still be seen."""


def proportion(width: float, height: float) -> float:
    """The share of their usual size that lines and marks have in a view of so many logical pixels."""
    return max(min(width, height, USUAL) / USUAL, LEAST)
