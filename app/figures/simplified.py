"""Lines in the plane with fewer points."""

import numpy as np

from bihdist_core.arrays import FloatArray


def simplified(points: FloatArray, tolerance: float) -> FloatArray:
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
