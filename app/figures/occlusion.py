"""Occlusion by the faces of a surface in a picture, face by face and exactly: no rays, no pixels.

In the picture a straight segment passes behind a triangle along one interval.  Seven linear functions give it: the
segment is inside each of the three sides, before each of its ends, and farther than the triangle's plane.  What hides a
segment is the union of these intervals over all triangles that it meets; a grid over the picture finds those.  Nothing
is assumed of the surface: it may have holes, edges of three faces, and pass through itself.
"""

from collections.abc import Iterator

import numpy as np

from bihdist_core.arrays import FloatArray, IntArray

AT_ONCE = 1_000_000
"""Pairs of a segment and a triangle that are looked at together: what fits into the processor's memory is quick."""

MOST_CELLS = 1 << 22
"""Of the grid; and of the triangles' places in it, so many for each triangle at most."""
MOST_PLACES = 16

TOUCHING = 1e-9
"""Fraction of a segment that rounding may leave between two triangles that share a side."""

SLACK = 1e-9
"""Fraction of a triangle's height by which it is wider, as a segment may lie on a side that two of them share: at right
angles to a box, the sides of its far face end on a diagonal of the near one."""


class Occlusion:
    """Triangles in a picture, ready to say what they hide.

    Parameters
    ----------
    corners
        (t, 3, 3) x, y and nearness, which is linear in the picture (1 / depth in perspective); triangles that are not
        finite are left out.
    vertices
        (t, 3) ids of the corners.
    """

    def __init__(self, corners: FloatArray, vertices: IntArray) -> None:
        xy = corners[..., :2]
        a, b, c = xy[:, 0], xy[:, 1], xy[:, 2]
        area = cross(b - a, c - a)
        kept = np.flatnonzero(np.isfinite(area) & (area != 0))
        turned = area[kept] < 0
        corners = corners[kept]
        corners[turned] = corners[turned][:, ::-1]
        self._vertices, self._corners, self._area = vertices[kept], corners, np.abs(area[kept])
        low, high = corners[..., :2].min(axis=1), corners[..., :2].max(axis=1)
        self._nearest = corners[..., 2].max(axis=1)
        self._low, self._high = low, high
        self._start = low.min(axis=0) if len(low) else np.zeros(2)
        extent = np.maximum(high.max(axis=0) - self._start, 1e-9) if len(low) else np.ones(2)
        usual = 2 * float(np.median((high - low).max(axis=1))) if len(low) else 1.0
        self._cell = max(usual, float(np.sqrt(extent[0] * extent[1] / MOST_CELLS)), float(extent.max()) / 4000)
        while True:
            spans = self._cells(high) - self._cells(low) + 1
            if spans.prod(axis=1).sum() <= MOST_PLACES * len(kept) + 4096:
                break
            self._cell *= 2
        self._across, self._down = (np.floor(extent / self._cell).astype(int) + 1).tolist()

    def intervals(self, ends: FloatArray, on: IntArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Return segments (k,), in order, and from where to where (k,), 0 to 1, each is hidden; no intervals touch.

        Parameters
        ----------
        ends
            (m, 2, 3) x, y and nearness of the segments' ends.
        on
            (m, 4) or (m, 6) vertices that span the face or edge of each segment, which triangles with all of them do
            not hide.
        """
        found = []
        low, high = ends[..., :2].min(axis=1), ends[..., :2].max(axis=1)
        for i, j in self._pairs(low, high):
            p, q = ends[i, 0], ends[i, 1]
            farthest = np.minimum(p[:, 2], q[:, 2])
            near = self._nearest[j] > farthest
            near &= ((self._low[j] <= high[i]) & (self._high[j] >= low[i])).all(axis=1)
            i, j, p, q = i[near], j[near], p[near], q[near]
            corners, start, stop = self._corners[j], np.zeros(len(i)), np.ones(len(i))
            slack = SLACK * self._area[j]
            sides = []
            for k in range(3):
                a, b = corners[:, k - 2, :2], corners[:, k - 1, :2]
                f, g = cross(b - a, p[:, :2] - a), cross(b - a, q[:, :2] - a)
                _keep(start, stop, f + slack, g + slack)
                sides.append((f, g))
            # How much nearer the triangle is, at both ends: its plane from the corners' shares of the area.
            f, g = (sum(side[end] * corners[:, k, 2] for k, side in enumerate(sides)) / self._area[j] for end in (0, 1))
            _keep(start, stop, f - p[:, 2], g - q[:, 2])
            hit = np.flatnonzero(start < stop)
            alone = (on[i[hit], :, None] == self._vertices[j[hit], None]).any(axis=2).all(axis=1)
            hit = hit[~alone]
            found.append((i[hit], start[hit], stop[hit]))
        if not found:
            return np.empty(0, int), np.empty(0), np.empty(0)
        return _united(*map(np.concatenate, zip(*found, strict=True)))

    def nearest(self, points: FloatArray) -> FloatArray:
        """Return the nearness (m,) of what is seen at points (m, 2) of the picture; -inf where nothing is."""
        seen = np.full(len(points), -np.inf)
        for i, j in self._pairs(points, points):
            corners, at = self._corners[j], points[i]
            sides = [cross(corners[:, k - 1, :2] - corners[:, k - 2, :2], at - corners[:, k - 2, :2]) for k in range(3)]
            inside = (sides[0] >= 0) & (sides[1] >= 0) & (sides[2] >= 0)
            depth = sum(side * corners[:, k, 2] for k, side in enumerate(sides)) / self._area[j]
            np.maximum.at(seen, i[inside], depth[inside])
        return seen

    # ------------------------------------------------------------------ who may meet whom
    def _cells(self, points: FloatArray) -> IntArray:
        return np.floor((points - self._start) / self._cell).astype(np.int64)

    def _places(self, low: FloatArray, high: FloatArray) -> tuple[IntArray, IntArray]:
        """Return which box (k,) touches which cell (k,) of the grid; finite ones only."""
        most = [self._across - 1, self._down - 1]
        finite = np.flatnonzero(np.isfinite(low).all(axis=1) & np.isfinite(high).all(axis=1))
        far = 1e15  # beyond the numbers of cells
        first = self._cells(np.clip(low[finite], -far, far))
        last = self._cells(np.clip(high[finite], -far, far))
        inside = ((last >= 0) & (first <= most)).all(axis=1)
        index, first, last = finite[inside], first[inside].clip(min=0), last[inside].clip(max=most)
        across, down = (last - first + 1).T
        count = across * down
        row = np.repeat(np.arange(len(index)), count)
        step = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)
        y, x = np.divmod(step, across[row])
        return index[row], (first[row, 1] + y) * self._across + first[row, 0] + x

    def _pairs(self, low: FloatArray, high: FloatArray) -> Iterator[tuple[IntArray, IntArray]]:
        """Yield boxes (k,) and triangles (k,) that share a cell; all that meet are among them, some twice."""
        box, where = self._places(low, high)
        if not len(box) or not len(self._vertices):
            return
        used = np.zeros(self._across * self._down, bool)
        used[where] = True
        triangle, there = self._places(self._low, self._high)
        kept = used[there]
        triangle, there = triangle[kept], there[kept]
        order = np.argsort(there, kind="stable")
        triangle, there = triangle[order], there[order]
        first, last = np.searchsorted(there, where, "left"), np.searchsorted(there, where, "right")
        count = last - first
        total = np.cumsum(count)
        if not total[-1]:
            return
        bounds = np.searchsorted(total, np.arange(AT_ONCE, total[-1] + AT_ONCE, AT_ONCE), "right")
        for a, b in zip([0, *bounds[:-1]], bounds, strict=True):
            # A part holds one box at least.
            rows = np.repeat(np.arange(a, b), count[a:b])
            offset = np.repeat(np.cumsum(count[a:b]) - count[a:b], count[a:b])
            columns = np.arange(len(rows)) - offset + first[rows]
            yield box[rows], triangle[columns]


def _keep(start: FloatArray, stop: FloatArray, f: FloatArray, g: FloatArray) -> None:
    """Shrink intervals, in place, to where functions that are f at 0 and g at 1 are positive."""
    with np.errstate(divide="ignore", invalid="ignore"):
        zero = f / (f - g)
    stop[(f <= 0) & (g <= 0)] = -1.0
    rises, falls = (f <= 0) & (g > 0), (f > 0) & (g <= 0)
    np.maximum(start, zero, out=start, where=rises)
    np.minimum(stop, zero, out=stop, where=falls)


def _united(segment: IntArray, start: FloatArray, stop: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
    """Join intervals of segments (k,) that touch."""
    if not len(segment):
        return segment, start, stop
    order = np.lexsort((start, segment))
    segment, start, stop = segment[order], start[order], stop[order]
    # Laid out one segment after another, two apart, the farthest end so far tells whether the next one touches.
    ends = np.maximum.accumulate(stop + 2.0 * segment)
    first = np.flatnonzero(np.append(True, start[1:] + 2.0 * segment[1:] > ends[:-1] + TOUCHING))
    last = np.append(first[1:], len(segment)) - 1
    return segment[first], start[first], ends[last] - 2.0 * segment[last]


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the cross products (k,) of vectors (k, 2)."""
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
