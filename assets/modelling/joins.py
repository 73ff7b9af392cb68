"""Fields joined, carved, mirrored and put in place.

Every `width` is a length: two surfaces closer than it flow into each other, as clay pressed together would.
"""

from collections.abc import Sequence

import numpy as np

from .fields import Field, frame, unit


def blend(a: np.ndarray, b: np.ndarray, width: float | np.ndarray) -> np.ndarray:
    """The smaller of two distances, with its kink rounded by a cubic (Quilez's cubic smooth minimum)."""
    if not np.any(width):
        return np.minimum(a, b)
    overlap = np.maximum(width - np.abs(a - b), 0) / width
    return np.minimum(a, b) - overlap**3 * width / 6


def join(width: float, *parts: Field) -> Field:
    """The union of all parts; width 0 leaves them apart where they only come near, as fingers do."""

    def joined(points: np.ndarray) -> np.ndarray:
        out = parts[0](points)
        for part in parts[1:]:
            out = blend(out, part(points), width)
        return out

    return joined


def join_by(width_at: Field, *parts: Field) -> Field:
    """The union of all parts, flowing together over a width that differs from place to place and is nowhere 0."""

    def joined(points: np.ndarray) -> np.ndarray:
        width, out = width_at(points), parts[0](points)
        for part in parts[1:]:
            out = blend(out, part(points), width)
        return out

    return joined


def carve(width: float, body: Field, *tools: Field) -> Field:
    """The body less the tools, with rims rounded over `width`."""

    def carved(points: np.ndarray) -> np.ndarray:
        out = body(points)
        for tool in tools:
            out = -blend(-out, tool(points), width)
        return out

    return carved


def standing_on(height: float, body: Field, width: float) -> Field:
    """The body cut flat at z = `height`, with the rim of the sole rounded."""
    return lambda points: -blend(-body(points), points[:, 2] - height, width)


def both_sides(part: Field, width: float = 0.001) -> Field:
    """The part and its mirror image in the plane x = 0, flowing together over about `width` where they meet there."""
    return lambda points: part(np.c_[np.sqrt(points[:, 0] ** 2 + width**2), points[:, 1:]])


def placed(
    part: Field, origin: Sequence[float], right: Sequence[float], up: Sequence[float], scale: float = 1.0
) -> Field:
    """A part modelled in axes of its own, put at `origin` with its z along `up` and its x near `right`."""
    z = unit(up)
    axes = frame(np.asarray(right, float) - z * (z @ np.asarray(right, float)), z)
    return lambda points: scale * part((points - np.asarray(origin, float)) @ axes.T / scale)
