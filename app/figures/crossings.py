"""Lines in the plane: where two sets of segments cross, lines with fewer points."""

import numpy as np


def crossings(ours: np.ndarray, others: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Pairs of segments (m, 2, 2) and (n, 2, 2) that cross: (k,) index of each, and (k,) shares of each at which.

    Ends count as inside for the others and as outside for ours; parallel segments do not cross; segments with an end
    that is not finite are left out.
    """
    i, j = _near(ours, others)
    p, q = ours[i, 0], others[j, 0]
    u, v = ours[i, 1] - p, others[j, 1] - q
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = ((q - p)[:, 0] * v[:, 1] - (q - p)[:, 1] * v[:, 0]) / area
        r = ((q - p)[:, 0] * u[:, 1] - (q - p)[:, 1] * u[:, 0]) / area
    hit = (area != 0) & (s > 0) & (s < 1) & (r >= 0) & (r <= 1)
    return i[hit], j[hit], s[hit], r[hit]


def _near(ours: np.ndarray, others: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of segments that touch the same cell of a grid: all that cross are among them."""
    finite = [np.flatnonzero(np.isfinite(ends).all(axis=(1, 2))) for ends in (ours, others)]
    if not all(map(len, finite)):
        return np.empty(0, int), np.empty(0, int)
    kept = [ends[index] for ends, index in zip((ours, others), finite, strict=True)]
    lengths = [np.abs(ends[:, 1] - ends[:, 0]).max(axis=1) for ends in kept]
    low = np.minimum(*(ends.min(axis=(0, 1)) for ends in kept))
    span = max(float(max(np.ptp(ends, axis=(0, 1)).max() for ends in kept)), 1e-300)
    cell = max(span / 2000, 2 * float(np.median(np.concatenate(lengths))))
    (one, where), (two, there) = (_cells(ends, length, low, cell) for ends, length in zip(kept, lengths, strict=True))
    order = np.argsort(there, kind="stable")
    two, there = two[order], there[order]
    first, last = np.searchsorted(there, where, "left"), np.searchsorted(there, where, "right")
    count = last - first
    rows = np.repeat(np.arange(len(one)), count)
    columns = np.arange(len(rows)) - np.repeat(np.cumsum(count) - count, count) + np.repeat(first, count)
    pairs = np.unique(one[rows] * len(others) + two[columns])
    i, j = pairs // len(others), pairs % len(others)
    return finite[0][i], finite[1][j]


def _cells(ends: np.ndarray, length: np.ndarray, low: np.ndarray, cell: float) -> tuple[np.ndarray, np.ndarray]:
    """Which segment (k,) touches which cell (k,), perhaps more than those it touches, and some twice."""
    # Cut into parts no longer than a cell, each touches at most the four cells around it.
    parts = np.maximum(np.ceil(length / cell).astype(int), 1)
    index = np.repeat(np.arange(len(ends)), parts)
    step = np.arange(len(index)) - np.repeat(np.cumsum(parts) - parts, parts)
    width = (ends[:, 1] - ends[:, 0]) / parts[:, None]
    start = ends[index, 0] + step[:, None] * width[index]
    # A hair wider, so that rounding loses no cell.
    corners = np.stack([start, start + width[index]])
    first = np.floor((corners.min(axis=0) - low) / cell - 1e-9).astype(np.int64) + 1
    last = np.floor((corners.max(axis=0) - low) / cell + 1e-9).astype(np.int64) + 1
    cells = [
        np.where(x, last[:, 0], first[:, 0]) * (1 << 31) + np.where(y, last[:, 1], first[:, 1])
        for x in (False, True)
        for y in (False, True)
    ]
    return np.tile(index, 4), np.concatenate(cells)


def simplified(points: np.ndarray, tolerance: float) -> np.ndarray:
    """Points (k, 2) of a line without those it passes anyway, within `tolerance` (Douglas and Peucker)."""
    keep = np.zeros(len(points), bool)
    keep[[0, -1]] = True
    stack = [(0, len(points) - 1)]
    while stack:
        a, b = stack.pop()
        if b - a < 2:
            continue
        way = points[b] - points[a]
        length = float(np.hypot(*way))
        arm = points[a + 1 : b] - points[a]
        if length > 0:
            along = np.clip((arm @ way) / length**2, 0, 1)
            arm = arm - along[:, None] * way
        off = np.hypot(arm[:, 0], arm[:, 1])
        k = int(off.argmax())
        if off[k] > tolerance:
            keep[a + 1 + k] = True
            stack += [(a, a + 1 + k), (a + 1 + k, b)]
    return points[keep]
