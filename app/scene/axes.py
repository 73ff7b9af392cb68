"""Where x, y and z point to: a small cross of three arms in a corner of a picture."""

from collections.abc import Collection
from dataclasses import dataclass

import numpy as np

from bihdist_core.arrays import FloatArray

CORNERS = ("bottom left", "bottom right", "top left", "top right")
"""Where it stands, the first that is free."""

ARM, LETTER, AWAY = 18.0, 10.0, 7.0
"""Pixels: the length of an arm, the height of the letters, and how far they are from the arms' ends."""

BEYOND = ARM + AWAY + LETTER
"""Pixels from the middle of the cross to the picture's sides."""

FAINT = 0.45
"""How opaque an arm is that points straight away, where one across the line of sight is 1."""

SHORT = 0.12
"""The share of its length in which an arm has no letter: it would lie on the other arms."""


@dataclass(frozen=True)
class Arm:
    """An axis as it is seen.  x, y: from the middle to its end, y up, 1 for an arm across the line of sight.

    opacity: what points away is fainter.  letter_at: (x, y) of its letter's middle in pixels from that of the cross, y
    up; None for an arm seen from its end.
    """

    name: str
    x: float
    y: float
    opacity: float

    @property
    def letter_at(self) -> tuple[float, float] | None:
        """Where the axis' letter stands beside the middle, in pixels; None if the axis points at the eye."""
        length = float(np.hypot(self.x, self.y))
        away = ARM + AWAY / length if length >= SHORT else 0.0
        return (away * self.x, away * self.y) if away else None


def arms(frame: FloatArray) -> tuple[Arm, ...]:
    """Those of a picture, the farthest first.  frame: (3, 3) columns: right, up, and back to the camera."""
    order = np.argsort(frame[:, 2], kind="stable")
    return tuple(
        Arm("xyz"[k], float(frame[k, 0]), float(frame[k, 1]), float(FAINT + (1 - FAINT) * min(1.0, frame[k, 2] + 1)))
        for k in order
    )


def middle(width: float, height: float, taken: Collection[str]) -> tuple[float, float]:
    """(x, y) of the cross in a picture of this size, in pixels, y down.  taken: corners where something else is."""
    corner = next((corner for corner in CORNERS if corner not in taken), CORNERS[0])
    x = BEYOND if "left" in corner else width - BEYOND
    return x, height - BEYOND if "bottom" in corner else BEYOND
