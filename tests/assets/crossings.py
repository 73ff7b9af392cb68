"""Faces of a surface that cut through each other."""

import numpy as np

from bihdist_core import Surface


def crossing_faces(surface: Surface) -> np.ndarray:
    """(k, 2) pairs of faces without a common vertex that intersect, coplanar ones apart."""
    faces, x = surface.faces, surface.vertices[surface.faces]
    low, high = x.min(axis=1), x.max(axis=1)
    # Boxes that overlap along the longest side: in the order of their starts, one's partners follow it.
    longest = int(np.ptp(surface.vertices, axis=0).argmax())
    order = np.argsort(low[:, longest], kind="stable")
    count = np.searchsorted(low[order, longest], high[order, longest], side="right") - np.arange(len(order)) - 1
    first = np.repeat(np.arange(len(order)), count)
    second = first + 1 + np.arange(len(first)) - np.repeat(np.cumsum(count) - count, count)
    pairs = np.stack([order[first], order[second]], 1)
    for axis in range(3):
        one, other = pairs.T
        pairs = pairs[(low[one, axis] <= high[other, axis]) & (low[other, axis] <= high[one, axis])]
    shared = (faces[pairs[:, 0]][:, :, None] == faces[pairs[:, 1]][:, None, :]).any(axis=(1, 2))
    pairs = pairs[~shared]
    cut = np.zeros(len(pairs), bool)
    for first, second in (pairs.T, pairs[:, ::-1].T):
        for k in range(3):
            cut |= _pierces(x[first, k], x[first, (k + 1) % 3], x[second])
    return pairs[cut]


def _pierces(start: np.ndarray, end: np.ndarray, triangle: np.ndarray) -> np.ndarray:
    """(n,) whether each segment passes through its triangle: signs of the volumes they span."""
    a, b, c = triangle[:, 0], triangle[:, 1], triangle[:, 2]

    def volume(p: np.ndarray, q: np.ndarray, r: np.ndarray, s: np.ndarray) -> np.ndarray:
        return np.einsum("ij,ij->i", q - p, np.cross(r - p, s - p))

    opposite = volume(start, a, b, c) * volume(end, a, b, c) < 0
    around = np.stack([volume(start, end, p, q) for p, q in ((a, b), (b, c), (c, a))])
    return opposite & ((around > 0).all(axis=0) | (around < 0).all(axis=0))
