"""The sample `genus3`: three tilted rings grown together round a core."""

import numpy as np

from .fields import Field, ellipsoid
from .joins import join, placed
from .sculpture import Sculpture

EDGE = 0.054


def sculpture() -> Sculpture:
    """The same edge length everywhere."""
    return Sculpture(rings(), (-2, -2, -1.2), (2, 2, 1.2), grid=0.04, edge=EDGE, wanted=lambda p: np.full(len(p), EDGE))


def rings(tilt: float = 0.6) -> Field:
    """Three rings at 120 degrees; each is turned by `tilt` radians about the spoke it sits on."""
    parts = []
    for angle in np.radians([90, 210, 330]):
        spoke, beside = np.array([np.cos(angle), np.sin(angle), 0]), np.array([-np.sin(angle), np.cos(angle), 0])
        parts.append(placed(_ring, 0.86 * spoke, spoke, np.cos(tilt) * np.array([0, 0, 1]) + np.sin(tilt) * beside))
    return join(0.25, join(0.3, *parts), ellipsoid((0, 0, 0), (0.42, 0.42, 0.3), reach=1.0))


def _ring(points: np.ndarray, radius: float = 0.62, thickness: float = 0.21, swell: float = 0.05) -> np.ndarray:
    """A torus round the z axis, thicker on the side of +x."""
    x, y, z = points.T
    return np.hypot(np.hypot(x, y) - radius, z) - thickness - swell * np.cos(np.arctan2(y, x))
