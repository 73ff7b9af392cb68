"""Solid parts as signed-distance fields.

A field takes (n, 3) points and returns (n,) distances, negative inside.  Near the surface the value is close to the
true distance; far outside it is a lower bound, which is all that joining and polygonising need.
"""

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt
from scipy.interpolate import PchipInterpolator

Field = Callable[[np.ndarray], np.ndarray]

BLOCK = 20_000
"""Points handled at once: the table of points against segments stays in the cache."""


def unit(vectors: npt.ArrayLike) -> np.ndarray:
    """(..., 3) vectors scaled to length 1; a zero vector stays zero."""
    v = np.asarray(vectors, float)
    return v / np.maximum(np.linalg.norm(v, axis=-1, keepdims=True), 1e-30)


def frame(right: npt.ArrayLike, up: npt.ArrayLike) -> np.ndarray:
    """(3, 3) rows: `right`, the direction square to it and to `up`, and the one nearest to `up`."""
    x = unit(right)
    y = unit(np.cross(up, x))
    return np.stack([x, y, np.cross(x, y)])


def ellipsoid(
    center: Sequence[float],
    radii: Sequence[float],
    right: Sequence[float] = (1, 0, 0),
    up: Sequence[float] = (0, 0, 1),
    reach: float = 0.12,
) -> Field:
    """An ellipsoid: `radii` along `right`, across it and along `up`; `reach` as in `within_reach`."""
    middle, r, axes = np.asarray(center, float), np.asarray(radii, float), frame(right, up)
    low, high = middle - r.max(), middle + r.max()
    return within_reach(lambda p: _ellipsoid_distance((p - middle) @ axes.T, r), low, high, reach)


def tube(stations: npt.ArrayLike, side: Sequence[float] = (1, 0, 0), reach: float = 0.12, steps: int = 6) -> Field:
    """A round-ended tube of elliptic section through `stations`.

    Each station is a row (x, y, z, r) or (x, y, z, r along `side`, r across it); between stations the rows follow a
    shape-preserving spline, cut into `steps` straight pieces.
    """
    rows = np.asarray(stations, float)
    rows = np.c_[rows, rows[:, 3]] if rows.shape[1] == 4 else rows
    at = np.r_[0, np.cumsum(np.linalg.norm(np.diff(rows[:, :3], axis=0), axis=1))]
    fine = np.interp(np.linspace(0, len(at) - 1, steps * (len(at) - 1) + 1), np.arange(len(at)), at)
    curve = PchipInterpolator(at, rows)(fine)
    start, radii = curve[:, :3], curve[:, 3:]
    along = unit(np.gradient(start, fine, axis=0))
    across = unit(np.asarray(side, float) - along * (along @ np.asarray(side, float))[:, None])
    # One row per node: place, radii (the last rounds the ends), and the axes those radii belong to.
    node = np.c_[start, radii, radii.mean(axis=1), across, np.cross(along, across), along]
    piece = np.diff(start, axis=0)

    def distance(points: np.ndarray) -> np.ndarray:
        out = np.empty(len(points))
        for i in range(0, len(points), BLOCK):
            p = points[i : i + BLOCK]
            segment, share = _nearest_on_pieces(p, start[:-1], piece)
            here = node[segment] + share[:, None] * (node[segment + 1] - node[segment])
            axes = here[:, 6:].reshape(-1, 3, 3)
            out[i : i + BLOCK] = _ellipsoid_distance(np.einsum("nij,nj->ni", axes, p - here[:, :3]), here[:, 3:6])
        return out

    widest = rows[:, 3:].max(axis=1, keepdims=True)
    return within_reach(distance, (rows[:, :3] - widest).min(axis=0), (rows[:, :3] + widest).max(axis=0), reach)


def within_reach(field: Field, low: np.ndarray, high: np.ndarray, reach: float) -> Field:
    """`field` where it matters, within `reach` of its box; beyond, the distance to the box, a cheap lower bound.

    `reach` must exceed the width of every joint the part takes part in.
    """

    def near_or_bound(points: np.ndarray) -> np.ndarray:
        out = np.linalg.norm(np.maximum(np.maximum(low - points, points - high), 0), axis=1)
        near = out < reach
        if near.any():
            out[near] = field(points[near])
        return out

    return near_or_bound


def _nearest_on_pieces(p: np.ndarray, start: np.ndarray, piece: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n,) index of the straight piece nearest to each point, and (n,) how far along it, 0 to 1."""
    squared = (piece**2).sum(axis=1)
    ahead = p @ piece.T - (start * piece).sum(axis=1)
    share = np.clip(ahead / squared, 0, 1)
    # The squared distance without |p|^2, which all pieces have in common.
    away = (start**2).sum(axis=1) - 2 * (p @ start.T) + share * (share * squared - 2 * ahead)
    nearest = away.argmin(axis=1)
    return nearest, np.take_along_axis(share, nearest[:, None], axis=1)[:, 0]


def _ellipsoid_distance(q: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """First-order distance of points `q` (n, 3) to the ellipsoid at the origin: |q/r| (|q/r| - 1) / |q/r^2|."""
    scaled = np.sqrt(((q / radii) ** 2).sum(axis=1))
    return scaled * (scaled - 1) / (np.sqrt(((q / radii**2) ** 2).sum(axis=1)) + 1e-9)
