"""How weights go from a face to the cells that it has become where degenerate faces are taken out (`proper_faces`)."""

from typing import NamedTuple

import numpy as np

from ..arrays import AnyArray, FloatArray

ROUNDING = 1e-15
"""Of weights."""


class CellWeights(NamedTuple):
    """inward (3, k): weights in a face times this are those at the k corners of a cell; within (3, c): times this they
    are not negative in the cell, either.  outward (k, 3): the weights of the cell's corners in the face."""

    inward: FloatArray
    within: FloatArray
    outward: FloatArray


def cell_weights(cells: AnyArray, number: int) -> CellWeights:
    """cells (c,): of `CELL`, see `geodesic_cells.c`."""
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

    inward (3, 3): weights in the other face times this are those in the part's; within (3, c): times this they are not
    negative in the part.
    """

    face: int
    inward: FloatArray
    within: FloatArray


def in_parts(parts: list[Part], begin: FloatArray, end: FloatArray) -> list[tuple[int, FloatArray, FloatArray]]:
    """A straight piece of a face, by the weights (3,) of its ends, as pieces of the face's parts: one for a point."""
    if np.array_equal(begin, end):
        face, inward, _ = max(parts, key=lambda part: float((begin @ part.within / _sizes(part.within)).min()))
        weights = _inside(begin @ inward, inward)
        return [(face, weights, weights)]
    found = []
    for face, inward, within in parts:
        room, way = begin @ within + ROUNDING * _sizes(within), (end - begin) @ within
        lo, hi = 0.0, 1.0
        for least, change in zip(room.tolist(), way.tolist(), strict=True):
            if change > 0:
                lo = max(lo, -least / change)
            elif change < 0:
                hi = min(hi, -least / change)
            elif least < 0:
                hi = -1.0
        if lo < hi:
            here, there = (_inside((begin + t * (end - begin)) @ inward, inward) for t in (lo, hi))
            found.append((face, here, there))
    return found or in_parts(parts, begin, begin) + in_parts(parts, end, end)


def _sizes(within: FloatArray) -> FloatArray:
    """(c,) how large numbers are that add up to those that are not negative in a part."""
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
