"""Polygons as mesh files hold them, and their division into triangles."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from ..arrays import AnyArray, BoolArray, FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError

EAR_CLIPPING_LIMIT = 512
"""Concave polygons with more corners are divided as a fan; clipping ears takes time cubic in the corners."""


@dataclass(frozen=True)
class Polygons:
    """The polygons of a file: `vertices` (n, 3), `sizes` (p,) and `corners` (sum of sizes,) as vertex ids.

    Of a solid its `tetrahedra` (m, 4) instead. `repairs` tells in words what reading has already changed or left out,
    `facts` how else the file was taken.
    """

    vertices: FloatArray
    sizes: IntArray
    corners: IntArray
    repairs: tuple[str, ...] = ()
    facts: tuple[str, ...] = ()
    tetrahedra: IntArray = field(default_factory=lambda: np.empty((0, 4), np.int64))


def runs(starts: IntArray, sizes: IntArray) -> IntArray:
    """Return (sum of sizes,) the indices start, start + 1, ... of each run, one run after the other."""
    ends = np.cumsum(sizes)
    return np.repeat(starts - (ends - sizes), sizes) + np.arange(ends[-1] if len(ends) else 0)


def whole_numbers(values: AnyArray) -> tuple[IntArray, BoolArray]:
    """Return `values` as int64, and the mask of those that are not whole numbers (these become -1)."""
    if values.dtype.kind in "iu":
        return values.astype(np.int64), values.astype(np.float64) > 2.0**53
    with np.errstate(invalid="ignore"):
        bad = ~(np.abs(values) <= 2.0**53) | (values != np.floor(values))
    return np.where(bad, -1, values).astype(np.int64), bad


def checked_corners(values: AnyArray, sizes: IntArray, n: int, where: Callable[[int], str]) -> IntArray:
    """Return the corners as int64 ids from 0 to n - 1.

    MeshError beginning with `where(polygon)` at the first that is not.
    """
    ids, bad = whole_numbers(values)
    bad |= (ids < 0) | (ids >= n)
    if bad.any():
        at = int(np.argmax(bad))
        polygon = int(np.searchsorted(np.cumsum(sizes), at, side="right"))
        allowed = f"ids run from 0 to {n - 1}" if n else "there are no vertices"
        raise MeshError(f"{where(polygon)} names vertex {values[at]:.16g}, but {allowed}.")
    return ids


def list_starts(values: IntArray, count: int) -> IntArray:
    """Return (k,) where the first k of `count` lists begin, each a size and so many entries.

    Fewer where they do not fit.
    """
    starts, at, size = np.empty(min(count, len(values)), np.int64), 0, len(values)
    entries = values.tolist()
    for k in range(len(starts)):
        if at >= size or not 0 <= entries[at] < size - at:
            return starts[:k]
        starts[k] = at
        at += 1 + entries[at]
    return starts


def lists_in(values: IntArray, count: int) -> tuple[IntArray, IntArray] | None:
    """Return (count,) sizes and (sum of sizes,) entries of lists that fill the values; None if they do not."""
    if len(values) == 4 * count and (values[::4] == 3).all():
        return np.full(count, 3), values.reshape(-1, 4)[:, 1:].ravel()
    starts = list_starts(values, count)
    sizes = values[starts]
    if len(starts) != count or len(values) != count + sizes.sum():
        return None
    return sizes, values[runs(starts + 1, sizes)]


def strip_triangles(sizes: IntArray, corners: IntArray) -> IntArray:
    """Return (m, 3) triangles of triangle strips, every second one turned so that all keep the strip's orientation."""
    count = np.maximum(sizes - 2, 0)
    starts = np.cumsum(sizes) - sizes
    first = runs(starts, count)
    odd = (first - np.repeat(starts, count)) % 2
    return corners[np.stack([first, first + 1 + odd, first + 2 - odd], axis=1)]


def triangulated(polygons: Polygons) -> tuple[IntArray, list[str], list[str]]:
    """Return (m, 3) triangles in the order of the polygons; in words what was left out, and what was divided.

    A fan about the first corner where that covers the polygon, else about another corner, else by clipping ears;
    a polygon that no cut divides cleanly (self-intersecting, all corners in line) stays a fan.
    """
    sizes, corners, left_out = polygons.sizes, polygons.corners, []
    small = sizes < 3
    if small.any():
        left_out.append(f"{counted(int(small.sum()), 'face')} with fewer than 3 corners ignored")
        corners, sizes = corners[np.repeat(~small, sizes)], sizes[~small]
    if (sizes == 3).all():
        return corners.reshape(-1, 3), left_out, []
    starts, first = np.cumsum(sizes) - sizes, np.cumsum(sizes - 2) - (sizes - 2)
    faces = np.empty((int((sizes - 2).sum()), 3), np.int64)
    for size in np.unique(sizes):
        of_size = np.flatnonzero(sizes == size)
        rings = corners[starts[of_size][:, None] + np.arange(size)]
        local = _divided(polygons.vertices, rings)
        faces[first[of_size][:, None] + np.arange(size - 2)] = np.take_along_axis(
            rings, local.reshape(len(rings), -1), axis=1
        ).reshape(local.shape)
    split = sizes > 3
    made = int((sizes[split] - 2).sum())
    words = "quad" if (sizes[split] == 4).all() else "polygon"
    fact = f"{counted(int(split.sum()), words)} divided into {counted(made, 'triangle')}"
    return faces, left_out, [fact]


def _fan(start: int, size: int) -> IntArray:
    """Return (size - 2, 3) the fan about one corner, as places in the ring."""
    k = np.arange(1, size - 1)
    return np.stack([np.full(size - 2, start), (start + k) % size, (start + k + 1) % size], axis=1)


def _divided(vertices: FloatArray, rings: IntArray) -> IntArray:
    """Return (r, k - 2, 3) the triangles of r polygons of k corners, as places in the ring."""
    size = rings.shape[1]
    local = np.repeat(_fan(0, size)[None], len(rings), axis=0)
    if size == 3 or not len(vertices):
        return local
    # Coordinates that overflow or are not numbers are refused later, with the vertex named.
    with np.errstate(over="ignore", invalid="ignore"):
        x = vertices[rings] - vertices[rings[:, :1]]
        normal = np.cross(x[:, 1:-1], x[:, 2:]).sum(axis=1)
        best = _smallest_fraction(x, normal, local[0])
        unsettled = np.flatnonzero(~(best > 0))
        for start in range(1, size if size <= EAR_CLIPPING_LIMIT else 0):
            if not len(unsettled):
                break
            fan = _fan(start, size)
            fraction = _smallest_fraction(x[unsettled], normal[unsettled], fan)
            better = fraction > best[unsettled]
            local[unsettled[better]], best[unsettled[better]] = fan, fraction[better]
            unsettled = unsettled[~(best[unsettled] > 0)]
        if 5 < size <= EAR_CLIPPING_LIMIT:
            for ring in unsettled[best[unsettled] < 0]:
                local[ring] = _clipped(x[ring], normal[ring], local[ring])
    return local


def _smallest_fraction(x: FloatArray, normal: FloatArray, fan: IntArray) -> FloatArray:
    """Return (r,) the smallest oriented triangle area of a fan over the polygon's.

    Below 0 where it leaves the polygon.
    """
    a, b, c = (x[:, fan[:, k]] for k in range(3))
    area = np.einsum("rtk,rk->rt", np.cross(b - a, c - a), normal)
    fraction = area.min(axis=1) / np.maximum(np.einsum("rk,rk->r", normal, normal), np.finfo(float).tiny)
    return np.where(np.abs(fraction) < 1e-12, 0.0, fraction)


def _clipped(x: FloatArray, normal: FloatArray, fan: IntArray) -> IntArray:
    """Return (k - 2, 3) one polygon divided by clipping ears; the given fan where it has none left to clip."""
    length = np.linalg.norm(normal)
    if not length > 0:
        return fan
    across = np.linalg.svd(normal[None])[2][1:]
    plane = x @ across.T
    if np.dot(np.cross(across[0], across[1]), normal) < 0:
        plane = plane[:, ::-1]

    def turn(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
        u, w = b - a, c - a
        return u[..., 0] * w[..., 1] - u[..., 1] * w[..., 0]

    ring, triangles = list(range(len(x))), []
    while len(ring) > 3:
        for k in range(len(ring)):
            a, b, c = ring[k - 1], ring[k], ring[(k + 1) % len(ring)]
            p = plane[[v for v in ring if v not in (a, b, c)]]
            sides = (turn(plane[a], plane[b], p), turn(plane[b], plane[c], p), turn(plane[c], plane[a], p))
            inside = (sides[0] >= 0) & (sides[1] >= 0) & (sides[2] >= 0)
            if turn(plane[a], plane[b], plane[c]) > 0 and not inside.any():
                triangles.append((a, b, c))
                del ring[k]
                break
        else:
            return fan
    return np.array([*triangles, ring])
