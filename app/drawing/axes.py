"""The directions of x, y and z: a small cross of three arms in a corner of a picture."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray

from .shapes import Pen, Point, Shape, Text, line, opaque

CORNERS = ("bottom left", "bottom right", "top left", "top right")
"""Corners for the cross, of which it takes the first that is free."""

ARM, LETTER, AWAY = 18.0, 10.0, 7.0
"""Pixels: the length of an arm, the height of the letters, and how far they are from the arms' ends."""

BEYOND = ARM + AWAY + LETTER
"""Pixels from the middle of the cross to the picture's sides."""

FAINT = 0.45
"""Opacity of an arm that points straight away, where one across the line of sight has 1."""

SHORT = 0.12
"""The share of its length in which an arm has no letter: it would lie on the other arms."""


@dataclass(frozen=True)
class Arm:
    """An axis as it is seen.

    Attributes
    ----------
    x, y
        From the middle to its end, y up; its length is 1 across the line of sight.
    opacity
        Smaller for what points away.
    """

    name: str
    x: float
    y: float
    opacity: float

    @property
    def letter_at(self) -> tuple[float, float] | None:
        """The place of the axis' letter beside the middle, in pixels; None if the axis points at the eye."""
        length = float(np.hypot(self.x, self.y))
        away = ARM + AWAY / length if length >= SHORT else 0.0
        return (away * self.x, away * self.y) if away else None


def arms(frame: FloatArray) -> tuple[Arm, ...]:
    """Return the arms of the axes in a picture, the farthest first.

    Parameters
    ----------
    frame
        (3, 3) matrix whose columns point to the right, up, and back to the camera.
    """
    order = np.argsort(frame[:, 2], kind="stable")
    return tuple(
        Arm("xyz"[k], float(frame[k, 0]), float(frame[k, 1]), float(FAINT + (1 - FAINT) * min(1.0, frame[k, 2] + 1)))
        for k in order
    )


def middle(width: float, height: float, taken: Collection[str]) -> tuple[float, float]:
    """Return the middle of the cross in a picture of this size, in pixels, y down, off the corners that are taken."""
    corner = next((corner for corner in CORNERS if corner not in taken), CORNERS[0])
    x = BEYOND if "left" in corner else width - BEYOND
    return x, height - BEYOND if "bottom" in corner else BEYOND


def axes_shapes(frame: FloatArray, at: Point, letter: float, width: float, colour: Sequence[float]) -> list[Shape]:
    """Return the cross of the axes about a place, with letters and lines of these sizes; frame as in `arms`."""
    (x, y), unit = at, letter / LETTER
    shapes: list[Shape] = []
    for arm in arms(frame):
        ink = opaque(colour, arm.opacity)
        end = x + unit * ARM * arm.x, y - unit * ARM * arm.y
        shapes.append(line(at, end, Pen(ink, width, cap="round")))
        if arm.letter_at is not None:
            right, up = arm.letter_at
            text = Text(arm.name, x + unit * right, y - unit * up, letter, ink, align="centre", level="lowercase")
            shapes.append(text)
    return shapes
