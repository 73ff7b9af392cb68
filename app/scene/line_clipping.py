"""Lines in a picture without what lies outside of a box, such as where a surface passes beside the eye."""

import numpy as np

from bihdist_core.arrays import AnyArray, FloatArray

from ..drawing.shapes import Box

Line = tuple[FloatArray, bool]
"""Points (k, 2) in a picture, y down, and whether the last joins the first."""


def clipped(line: Line, box: Box) -> list[Line]:
    """Return the parts of a line that lie in a box."""
    points, closed = line
    low, high = np.array([box.x, box.y]), np.array([box.right, box.bottom])
    is_inside = ((points >= low) & (points <= high)).all(axis=1)
    if is_inside.all():
        return [line]
    if closed:  # so that no part of it goes through where it is joined
        points = np.roll(points, -int(is_inside.argmin()), axis=0)
        points = np.concatenate([points, points[:1]])
    a, step = points[:-1], np.diff(points, axis=0)
    start, stop = _inside(a, step, low, high)
    kept = np.flatnonzero(start < stop)
    is_new = (np.diff(kept) > 1) | (stop[kept[:-1]] < 1) | (start[kept[1:]] > 0)
    found = []
    for run in np.split(kept, np.flatnonzero(is_new) + 1) if len(kept) else ():
        first, last = run[0], run[-1]
        ends = (a[k] + share * step[k] for k, share in ((first, start[first]), (last, stop[last])))
        begin, end = (np.clip(place, low, high)[None] for place in ends)
        found.append((np.concatenate([begin, points[first + 1 : last + 1], end]), False))
    return found


def _inside(a: FloatArray, step: FloatArray, low: AnyArray, high: AnyArray) -> tuple[FloatArray, FloatArray]:
    """Return the fractions (s,) between which each piece a + fraction * step (s, 2) is inside; stop ≤ start: none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.stack([low - a, high - a]) / step
    # Not a number: a piece along a side of the box, or one with an end that is no place.
    ends = np.where(np.isnan(ends), np.reshape([-np.inf, np.inf], (2, 1, 1)), ends)
    near, far = ends.min(axis=0).max(axis=1), ends.max(axis=0).min(axis=1)
    is_place = np.isfinite(a).all(axis=1) & np.isfinite(step).all(axis=1)
    return np.maximum(near, 0.0), np.where(is_place, np.minimum(far, 1.0), -np.inf)
