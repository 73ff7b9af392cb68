"""How weights go from a face to the cells that it has become where degenerate faces are taken out (`proper_faces`)."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from ..arrays import AnyArray, FloatArray

ROUNDING = 1e-15
"""Rounding of weights."""

MOVED = 4e-12
"""In the kernel's unit: how far places may move where faces are divided."""

BISECTIONS = 50


class CellWeights(NamedTuple):
    """The matrices between the weights of places in a face and in a cell of it, which has k corners.

    Attributes
    ----------
    inward : (3, k) ndarray
        Weights in the face times this are those at the corners of the cell.
    within : (3, c) ndarray
        Weights in the face times this are not negative in the cell, either.
    outward : (k, 3) ndarray
        The weights of the cell's corners in the face.
    """

    inward: FloatArray
    within: FloatArray
    outward: FloatArray


def cell_weights(cells: AnyArray, number: int) -> CellWeights:
    """Return the weights of a cell; `cells` (c,) are of `CELL`, see `geodesic_cells.c`."""
    steps = []
    while (cell := cells[number])["before"] >= 0:
        steps.append(cell)
        number = int(cell["before"])
    inward, within, outward = np.eye(3), np.empty((3, 0)), np.eye(3)
    for cell in reversed(steps):
        part, (stays, goes, _) = float(cell["part"]), cell["step"].tolist()
        if part > 0:
            inward[:, goes] /= part
            inward[:, stays] -= inward[:, goes] * (1 - part)
            outward[goes] = part * outward[goes] + (1 - part) * outward[stays]
        elif stays >= 0:
            became = cell["step"].tolist()[: inward.shape[1]]
            within = np.hstack([within, inward])
            joined = np.zeros((3, max(became) + 1))
            for k, to in enumerate(became):
                joined[:, to] += inward[:, k]
            inward, outward = joined, outward[[became.index(to) for to in range(max(became) + 1)]]
    return CellWeights(inward, within, outward)


class Part(NamedTuple):
    """A face that holds a part of another.

    Weights in the other face times `inward` (3, 3) are those in the part's face; times `within` (3, c) they are not
    negative in the part. `corners` (3, 3) are the positions of the corners of the part's face.
    """

    face: int
    inward: FloatArray
    within: FloatArray
    corners: FloatArray

    def weights(self, there: FloatArray) -> FloatArray:
        """Return (3,) weights in the face for weights in the other one."""
        return _inside(there @ self.inward, self.inward)


def in_parts(
    parts: list[Part], corners: FloatArray, begin: FloatArray, end: FloatArray
) -> list[tuple[int, FloatArray, FloatArray]]:
    """Return a straight piece of a face, by the weights (3,) of its ends, as pieces of the face's parts: one for a
    point.

    `corners` (3, 3) are the positions of the corners of the face.
    """
    way = end - begin

    def off(part: Part, t: float) -> float:
        there = begin + t * way
        return float(np.linalg.norm(part.weights(there) @ part.corners - there @ corners))

    if not way.any():
        part = min(parts, key=lambda part: off(part, 0))
        return [(part.face, part.weights(begin), part.weights(begin))]

    def is_there(part: Part, t: float) -> bool:
        return off(part, t) <= MOVED

    found = []
    for part in parts:
        lo, hi = _range(begin @ part.within + ROUNDING * _sizes(part.within), way @ part.within)
        middle = (lo + hi) / 2
        # In parts with hardly any height rounding may say anything.
        if lo < hi and is_there(part, middle):
            lo, hi = (_last(middle, t, partial(is_there, part)) for t in (lo, hi))
            found.append((part.face, part.weights(begin + lo * way), part.weights(begin + hi * way)))
    return found or in_parts(parts, corners, begin, begin) + in_parts(parts, corners, end, end)


def _range(room: FloatArray, way: FloatArray) -> tuple[float, float]:
    """Return the part of 0 to 1 where numbers (c,) that begin so and change by so much are not negative."""
    lo, hi = 0.0, 1.0
    for least, change in zip(room.tolist(), way.tolist(), strict=True):
        if change > 0:
            lo = max(lo, -least / change)
        elif change < 0:
            hi = min(hi, -least / change)
        elif least < 0:
            hi = -1.0
    return lo, hi


def _last(good: float, end: float, holds: Callable[[float], bool]) -> float:
    """Return the last number on the way from a good one to an end for which something holds."""
    if holds(end):
        return end
    for _ in range(BISECTIONS):
        middle = (good + end) / 2
        good, end = (middle, end) if holds(middle) else (good, middle)
    return good


def _sizes(within: FloatArray) -> FloatArray:
    """Return (c,) how large numbers are that add up to those that are not negative in a part."""
    sizes: FloatArray = np.maximum(np.abs(within).max(axis=0), 1)
    return sizes


def _inside(weights: FloatArray, inward: FloatArray) -> FloatArray:
    """Weights in a part, those below 0 by rounding made up for by others that large numbers add up to, too."""
    inside = [max(weight, 0.0) for weight in weights.tolist()]
    excess = sum(inside) - 1
    for k in np.argsort(-np.abs(inward).max(axis=0)).tolist():
        less = min(inside[k], max(excess, 0.0))
        inside[k] -= less
        excess -= less
    return np.array(inside, np.float64)
