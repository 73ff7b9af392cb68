"""Triangles cut by linear functions: convex polygons in weights of the corners, many at a time."""

import numpy as np

from ..arrays import FloatArray, IntArray


def clipped(polygons: FloatArray, sizes: IntArray, values: FloatArray) -> tuple[FloatArray, IntArray]:
    """Clip convex polygons to where linear functions are at least 0 (Sutherland and Hodgman 1974).

    Parameters
    ----------
    polygons : (p, s, 3) ndarray
        Barycentric weights of up to s vertices in their triangles.
    sizes : (p,) ndarray
        How many vertices each polygon has.
    values : (p, 3) ndarray
        The functions at the corners of the triangles.

    Returns
    -------
    polygons : (p, t, 3) ndarray
        The clipped polygons.
    sizes : (p,) ndarray
        How many vertices they have; 0 for nothing.
    """
    count, most = polygons.shape[:2]
    rows = np.arange(count)
    at = np.einsum("psc,pc->ps", polygons, values)
    # One vertex more than before, but for rounding where values are nearly 0.
    cut, cut_sizes = np.zeros((count, 2 * most, 3)), np.zeros(count, np.int64)
    for s in range(most):
        there = s < sizes
        following = np.where(s + 1 < sizes, s + 1, 0)
        u, v = at[:, s], at[rows, following]
        inside = rows[there & (u >= 0)]
        cut[inside, cut_sizes[inside]] = polygons[inside, s]
        cut_sizes[inside] += 1
        crossed = rows[there & (((u > 0) & (v < 0)) | ((u < 0) & (v > 0)))]
        t = (u[crossed] / (u[crossed] - v[crossed]))[:, None]
        cut[crossed, cut_sizes[crossed]] = (1 - t) * polygons[crossed, s] + t * polygons[crossed, following[crossed]]
        cut_sizes[crossed] += 1
    cut_sizes[cut_sizes < 3] = 0
    return cut[:, : max(3, int(cut_sizes.max(initial=0)))], cut_sizes


def polygon_fractions(polygons: FloatArray, sizes: IntArray) -> FloatArray:
    """Return (p,) areas of polygons as fractions of their triangles'."""
    a, b = polygons[:, 1:-1] - polygons[:, :1], polygons[:, 2:] - polygons[:, :1]
    # In weights, a triangle's area over the whole one's is the determinant of two of its sides without a coordinate.
    determinants = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    present = np.arange(2, polygons.shape[1]) < sizes[:, None]
    areas: FloatArray = np.where(present, np.abs(determinants), 0).sum(axis=1)
    return areas
