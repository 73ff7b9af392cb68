"""The values of isolines, standing on them: along the line, in a gap of it, where there is room."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter
from scipy.spatial import cKDTree

from bihdist_core.arrays import AnyArray, BoolArray, FloatArray, IntArray

from ..drawing.shapes import Box
from .line_clipping import Line

EVERY = 3.0
"""Pixels, or units of a page, along a line from one place that is tried to the next."""

PAD = 3.0
"""The same of the gap to each side of the words."""

STRAIGHT = 0.35
"""Of the letters' size: a line may be off the words' own by so much."""

CLEAR = 0.75
"""Of the letters' size: other lines keep so far from the words' middle line."""

EDGE = 0.8
"""Of the letters' size: the edge of the shape does."""


@dataclass(frozen=True, eq=False)
class Contour:
    """An isoline: its value, its visible parts, and how it stands out."""

    value: float
    parts: list[Line]
    is_bold: bool = False
    is_through: bool = False


Room = tuple[float, int, float, float, FloatArray, FloatArray]
"""A place for a label: how good, the part of the line, from where to where on it, the middle and the way, (2,) each."""


@dataclass(frozen=True)
class Label:
    """Words about a middle (x, y) in the picture, turned by an angle in degrees, against the clock."""

    text: str
    x: float
    y: float
    angle: float
    contour: int


def value_text(value: float) -> str:
    """Return a value in three digits, or in all digits before the point."""
    if value and not 1e-4 <= abs(value) < 1e6:
        return f"{value:.3g}".replace("-", "\N{MINUS SIGN}")
    digits = max(0, 2 - int(np.floor(np.log10(abs(value))))) if value else 0
    text = f"{value:.{digits}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return text.replace("-", "\N{MINUS SIGN}")


def labelled(
    contours: Sequence[Contour],
    box: Box,
    size: float,
    width: Callable[[str], float],
    is_covered: Callable[[FloatArray], BoolArray],
    marked: FloatArray,
    apart: float,
    written: Sequence[tuple[float, float]] = (),
    clear: float = CLEAR,
) -> tuple[list[Contour], list[Label]]:
    """Return isolines with gaps, and the labels in them, one for each value that has room somewhere.

    Parameters
    ----------
    box
        Of the picture.
    size
        Of the letters.
    width
        Returns the width of a text.
    is_covered
        Returns which of places (k, 2) are on the shape, where labels may stand.
    marked, apart
        Marked places (k, 2), and how far labels keep from them.
    written
        Middles of single signs that stand in the picture.
    clear
        Distance of other lines from a label's middle line, in letter sizes.
    """
    places = _LabelPlaces(contours, box, size, is_covered, marked, apart, written, clear)
    lines, labels = list(contours), []
    done: set[float] = set()
    # Those that stand out come first, then the values from the largest: near the source lines are close.
    order = sorted(range(len(lines)), key=lambda k: (not lines[k].is_through, not lines[k].is_bold, -_length(lines[k])))
    for k in order:
        line = lines[k]
        if line.value in done:
            continue
        text = value_text(line.value)
        wide = width(text) + 2 * PAD
        rooms = (room for number, part in enumerate(line.parts) for room in places.on(part, number, k, wide))
        best = max(rooms, key=lambda room: room[0], default=None)
        if best is None:
            continue
        _, number, start, stop, middle, way = best
        angle = float(np.degrees(np.arctan2(-way[1], way[0])))
        angle = angle - 180 if angle > 90 else angle + 180 if angle <= -90 else angle
        labels.append(Label(text, float(middle[0]), float(middle[1]), angle, k))
        places.taken.append((middle, wide / 2))
        parts = list(line.parts)
        parts[number : number + 1] = _without(parts[number], start, stop)
        lines[k] = replace(line, parts=parts)
        done.add(line.value)
    return lines, labels


class _LabelPlaces:
    """Finds places for labels on isolines, off everything else; see `labelled`.

    Attributes
    ----------
    taken
        Middles of labels that have a place, and half their widths.
    """

    def __init__(
        self,
        contours: Sequence[Contour],
        box: Box,
        size: float,
        is_covered: Callable[[FloatArray], BoolArray],
        marked: FloatArray,
        apart: float,
        written: Sequence[tuple[float, float]],
        clear: float,
    ) -> None:
        self._size, self._is_covered, self._marked, self._apart, self._clear = size, is_covered, marked, apart, clear
        dense = [[_along(part, 1.0)[0] for part in line.parts] for line in contours]
        self._points = np.concatenate([np.empty((0, 2)), *(p for parts in dense for p in parts)])
        owners = (np.full(len(p), k) for k, parts in enumerate(dense) for p in parts)
        self._owner = np.concatenate([np.empty(0, int), *owners])
        self._tree: Any = cKDTree(self._points) if len(self._points) else None
        self._crowded = _crowded(box, self._points, self._owner, clear * size)
        self.taken = [(np.array(place), size / 2) for place in written]

    def on(self, part: Line, number: int, k: int, wide: float) -> list[Room]:
        """Return places on a part, by its number, of line k that have room for a label of this width."""
        size = self._size
        at, length = _along(part, 1.0)
        starts = np.arange(0.0, length[-1] - wide, EVERY)
        first, last = (np.stack([np.interp(s, length, at[:, i]) for i in (0, 1)], 1) for s in (starts, starts + wide))
        # First what is found out at once for all places.
        chords = np.hypot(*(last - first).T)
        ways = (last - first) / np.maximum(chords, 1e-9)[:, None]
        middles = (first + last) / 2
        is_free = (chords >= 0.96 * wide) & ~self._crowded(middles)
        for s in (-1, -0.5, 0, 0.5, 1):
            for t in (-1, 1):
                corner = middles + s * wide / 2 * ways + t * EDGE * size * np.stack([-ways[:, 1], ways[:, 0]], 1)
                is_free &= self._is_covered(corner)
        for other, half in self.taken:
            is_free &= np.hypot(*(middles - other).T) >= half + wide / 2 + size
        for mark in self._marked:
            is_free &= np.hypot(*(middles - mark).T) >= self._apart + wide / 2
        found = []
        for place in np.flatnonzero(is_free):
            start, stop, a, b, way, middle, chord = (
                each[place] for each in (starts, starts + wide, first, last, ways, middles, chords)
            )
            inner = at[(length > start) & (length < stop)]
            off = np.abs((inner - a) @ [-way[1], way[0]]).max(initial=0.0)
            if off > STRAIGHT * size:
                continue
            near = np.array(self._tree.query_ball_point(middle, wide / 2 + size), int)
            others = near[(self._owner[near] != k) | ~_is_between(self._points[near], a, way, chord)]
            room = _least_distance(self._points[others], a, b)
            if room >= self._clear * size:
                found.append((min(room, 2 * size) / size - off / size, number, start, stop, middle, way))
        return found


def _crowded(box: Box, points: FloatArray, owner: IntArray, clear: float) -> Callable[[FloatArray], BoolArray]:
    """Return a function that tells of places (k, 2) on lines whether another line is surely nearer than `clear`.

    Parameters
    ----------
    points, owner
        (n, 2) points of all lines, and the line (n,) that each is of.
    """
    reach = int(clear / np.sqrt(2) - 1.5)  # of a square inside the circle, whose units are whole
    if reach < 1 or not len(points):
        return lambda places: np.zeros(len(places), bool)
    corner, shape = np.array([box.x, box.y]), (int(box.height) + 2, int(box.width) + 2)

    def cells(places: FloatArray) -> tuple[AnyArray, AnyArray]:
        column, row = np.floor(places - corner).astype(int).T
        return np.clip(row, 0, shape[0] - 1), np.clip(column, 0, shape[1] - 1)

    least, most = np.full(shape, owner.max() + 1), np.full(shape, -1)
    np.minimum.at(least, cells(points), owner)
    np.maximum.at(most, cells(points), owner)
    least, most = minimum_filter(least, 2 * reach + 1), maximum_filter(most, 2 * reach + 1)
    return lambda places: least[cells(places)] < most[cells(places)]


def _is_between(points: FloatArray, a: FloatArray, way: FloatArray, chord: float) -> BoolArray:
    """Return whether points (k, 2) of the line itself lie under the label, or continue from it."""
    along, across = (points - a) @ way, np.abs((points - a) @ [-way[1], way[0]])
    is_between: BoolArray = (across < min(0.5 * chord, 4.0)) | (along < 0) | (along > chord)
    return is_between


def _least_distance(points: FloatArray, a: FloatArray, b: FloatArray) -> float:
    """Return the least distance from points (k, 2) to the segment from a to b."""
    if not len(points):
        return np.inf
    t = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return float(np.hypot(*(points - a - t[:, None] * (b - a)).T).min())


def _length(line: Contour) -> float:
    return sum(float(_along(part, np.inf)[1][-1]) for part in line.parts)


def _along(part: Line, step: float) -> tuple[FloatArray, FloatArray]:
    """Return points (k, 2) along a line, no farther apart than `step`, and their lengths (k,) from its start."""
    points, closed = part
    ring = np.concatenate([points, points[:1]]) if closed else points
    length = np.append(0.0, np.cumsum(np.hypot(*np.diff(ring, axis=0).T)))
    if np.isfinite(step):
        more = np.union1d(length, np.arange(0.0, length[-1], step))
        ring = np.stack([np.interp(more, length, ring[:, k]) for k in (0, 1)], 1)
        length = more
    return ring, length


def _without(part: Line, start: float, stop: float) -> list[Line]:
    """Return the rest of a line without the part from one length to another."""
    ring, length = _along(part, np.inf)

    def cut(a: float, b: float) -> FloatArray:
        lengths = np.concatenate([[a], length[(length > a) & (length < b)], [b]])
        return np.stack([np.interp(lengths, length, ring[:, k]) for k in (0, 1)], 1)

    before, after = cut(0.0, start), cut(stop, length[-1])
    if part[1]:
        return [(np.concatenate([after, before[1:]]), False)]
    return [(each, False) for each, room in ((before, start), (after, length[-1] - stop)) if room > 0]
