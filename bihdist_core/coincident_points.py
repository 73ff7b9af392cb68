"""Points in one place, or within a tolerance of each other, found and made one."""

import numpy as np

from .arrays import FloatArray, IntArray
from .kernel.library import NO_ROOM, library


def merged(points: FloatArray) -> tuple[FloatArray, IntArray]:
    """Return the different points (n, 3) in order of first appearance, and (k,) the number of each point (k, 3)
    there."""
    kernel = library()
    if kernel is None:
        return _merged_by_sorting(points)
    places, number = np.empty_like(points), np.empty(len(points), np.int64)
    # Where a surface is closed, some six corners are in one place.
    n, slots = NO_ROOM, 1 << (len(points) // 2).bit_length()
    while n == NO_ROOM:
        n = kernel.bih_merge_points(len(points), points, slots, np.empty(slots, np.int32), places, number)
        slots *= 4
    places.resize((n, 3), refcheck=False)
    return places, number


def _merged_by_sorting(points: FloatArray) -> tuple[FloatArray, IntArray]:
    order = np.lexsort(points.T)
    new = np.append(True, (points[order][1:] != points[order][:-1]).any(axis=1))[: len(points)]
    first = order[new]
    group = np.empty(len(points), np.int64)
    group[order] = np.cumsum(new) - 1
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return points[np.sort(first)], rank[group]


def least_apart(points: FloatArray) -> float:
    """Return the least distance between two of the points (k, 3); infinite for fewer than two."""
    from scipy.spatial import cKDTree  # not at the top: files are read without it

    return float(cKDTree(points).query(points, [2])[0].min(initial=np.inf))


def merged_within(points: FloatArray, tolerance: float) -> tuple[IntArray, IntArray]:
    """Return (n,) which of the points (k, 3) are kept, ascending, and (k,) which of these stands for each.

    In their order, each point stands for all within the tolerance behind it for which no other does yet: no point moves
    farther than the tolerance, and those that are kept are farther apart.
    """
    if tolerance == 0:
        place = merged(points)[1]
        return np.unique(place, return_index=True)[1], place
    from scipy.spatial import cKDTree  # not at the top: files are read without it

    tree, stands_for = cKDTree(points), np.arange(len(points))
    # Most points are alone: only the others are looked at one by one, with some room for rounding.
    nearest = tree.query(points, [2], distance_upper_bound=1.001 * tolerance)[0].ravel()
    others = np.flatnonzero(np.isfinite(nearest))
    stands_for[others] = -1
    for point in others.tolist():
        if stands_for[point] < 0:
            near = np.array(tree.query_ball_point(points[point], tolerance), np.int64)
            stands_for[near[stands_for[near] < 0]] = point
            stands_for[point] = point
    kept, place = np.unique(stands_for, return_inverse=True)
    return kept, place
