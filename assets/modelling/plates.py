"""Relief on a part: a banded armour that follows an axis, as heights by which the part's surface is raised.

All lengths in the part's own unit.
"""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.interpolate import PchipInterpolator

from .fields import BLOCK, Field, unit

NEAR = 0.1
"""Relief is worked out this near to the bare surface."""

SIDE_KEEL = 48
"""Degrees round the axis."""

FINE = 8
"""Pieces of the axis between two stations."""


def plated(
    body: Field,
    stations: npt.ArrayLike,
    back: Sequence[float],
    lift: float = 0.0,
    keel: tuple[float, float] = (0.0, 0.03),
    folds: float = 0.0,
) -> Field:
    """The body with plates round an axis, each rising slowly and ending in a step.

    Each station is a row (x, y, z, plates counted up to here, plate height, half-angle covered, degrees).  Plates lie
    on the side of `back`, `lift` above the bare surface; `keel` is the height and half-width of a ridge of bumps along
    their middle, one on each plate, and lower ones run at `SIDE_KEEL` from it; `folds` is the height of soft folds on
    the other side.
    """
    rows = np.asarray(stations, float)
    at = np.r_[0, np.cumsum(np.linalg.norm(np.diff(rows[:, :3], axis=0), axis=1))]
    fine = np.interp(np.linspace(0, len(at) - 1, FINE * (len(at) - 1) + 1), np.arange(len(at)), at)
    node = PchipInterpolator(at, rows)(fine)
    along = unit(np.gradient(node[:, :3], fine, axis=0))
    outward = unit(np.asarray(back, float) - along * (along @ np.asarray(back, float))[:, None])
    node = np.c_[node, outward]

    def heights(p: np.ndarray) -> np.ndarray:
        here = _blurred(p, node)
        away, out = p - here[:, :3], unit(here[:, 6:])
        up = (away * out).sum(axis=1)
        beside = np.linalg.norm(away - up[:, None] * out, axis=1)
        angle = np.degrees(np.arctan2(beside, up))
        count, height, reach = here[:, 3:6].T
        covered = smooth_step((reach - angle) / 22 + 0.5)
        full = height / rows[:, 4].max()
        step = lift * full + height * saw(count)
        lines = np.exp(-((beside / keel[1]) ** 2)) + 0.6 * np.exp(-(((angle - SIDE_KEEL) / 11) ** 2))
        ridge = keel[0] * lines * (0.5 + 0.5 * saw(count))
        other = folds * np.sin(2 * np.pi * count) * (1 - smooth_step((reach + 22 - angle) / 22 + 0.5))
        return covered * (step + full * ridge) + other

    def raised(points: np.ndarray) -> np.ndarray:
        out = body(points)
        near = np.flatnonzero(np.abs(out) < NEAR)
        for i in range(0, len(near), BLOCK):
            some = near[i : i + BLOCK]
            out[some] -= heights(points[some])
        return out

    return raised


def saw(turns: np.ndarray) -> np.ndarray:
    """(n,) a rounded saw tooth of period 1 between about -1 and 1, rising for two thirds and then falling."""
    x = 2 * np.pi * turns
    return 0.9 * np.sin(x) - 0.3 * np.sin(2 * x)


def smooth_step(share: np.ndarray) -> np.ndarray:
    """(n,) from 0 to 1 while `share` goes from 0 to 1, level at both ends."""
    t = np.clip(share, 0, 1)
    return t * t * (3 - 2 * t)


def _blurred(p: np.ndarray, node: np.ndarray) -> np.ndarray:
    """(n, k) the axis' rows near each point: a mean that falls off so fast that it is smooth and nearly the nearest."""
    squared = ((p[:, None] - node[None, :, :3]) ** 2).sum(axis=2)
    weight = (squared.min(axis=1, keepdims=True) / np.maximum(squared, 1e-12)) ** 5
    return weight @ node / weight.sum(axis=1, keepdims=True)
