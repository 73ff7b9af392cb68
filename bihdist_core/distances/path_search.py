"""Shortest paths by search, where the kernel's way back (`geodesic_paths.c`) is lost between vertices that nearly meet.

The way back follows one line, and rounding may take that past a vertex on the wrong side.  Here all lines from a place
are unfolded, as far as the distances of vertices, which are known, allow a shortest path there at all.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

from ..arrays import AnyArray, FloatArray

MOST_WINDOWS = 100_000
"""Windows that are opened for one straight part, at most."""

Weights = list[float]
Piece = tuple[int, Weights, Weights]
"""A face, and the weights of both ends of a straight piece in it."""


class _Side(NamedTuple):
    """A row of `Side` in `geodesic.h`."""

    length: float
    x: float
    y: float
    vertex: int
    twin: int


class _Window(NamedTuple):
    """The part from `low` to `high` of a side through which the start, at (x, -y) in its frame, sees its face.

    Attributes
    ----------
    leaving : int
        The side of the face before through which the lines came.
    is_turned : bool
        True if that side begins at the other end.
    before : _Window or None
        The window of the face before; None where the start is in it.
    """

    side: int
    low: float
    high: float
    x: float
    y: float
    leaving: int
    is_turned: bool
    before: "_Window | None"

    def crossing(self, x: float, y: float) -> float:
        """Return the x at which the line from the start to (x, y) of the face crosses the window, or comes nearest."""
        across = self.x + (x - self.x) * self.y / (self.y + y) if self.y + y > 0 else x
        return min(max(across, self.low), self.high)


class _Hit(NamedTuple):
    """The end of a straight line: a vertex or, below 0, ~ a source; at (x, y) in the frame of a side.

    `length` is that of the path that leads on from there, `weights` are those of the end in the side's face.
    """

    length: float
    id: int
    side: int
    x: float
    y: float
    weights: Weights
    window: _Window | None


@dataclass(frozen=True, eq=False)
class PathSearch:
    """The distances that a run has found, in the kernel's numbers and unit.

    Attributes
    ----------
    sides, first, corner : (3 faces,), (vertices + 1,) and (3 faces,) ndarray
        The mesh, as in `geodesic.h`.
    distances : (vertices,) ndarray
        The distances of vertices.
    is_start : (vertices,) ndarray
        True for vertices that are sources.
    sources : dict
        The numbers of the sources in each face.
    begins, ends, offsets : (k, 3), (k, 3) and (k,) ndarray
        The weights of both ends of each source, and its offset.
    rounding : float
        The length by which a straight part may be too long.
    """

    sides: AnyArray
    first: AnyArray
    corner: AnyArray
    distances: FloatArray
    is_start: AnyArray
    sources: dict[int, list[int]]
    begins: FloatArray
    ends: FloatArray
    offsets: FloatArray
    rounding: float

    def from_vertex(self, vertex: int) -> list[Piece] | None:
        """Return the pieces of the shortest path from a vertex back to its source; None if there is none as short."""
        pieces: list[Piece] = []
        passed = {vertex}
        while not self.is_start[vertex]:
            corners = self.corner[self.first[vertex] : self.first[vertex + 1]].tolist()
            starts = [(h // 3, _at_corner(h)) for h in corners]
            windows = [w for h in corners for w in self._leaving(_next(h), 0, math.inf, *self._apex(_next(h)), None)]
            hit = self._hit(starts, windows, float(self.distances[vertex]), passed)
            if hit is None:
                return None
            face = _first_face(hit)
            pieces += self._pieces(hit, next(weights for start, weights in starts if start == face))
            if hit.id < 0:
                break
            vertex = hit.id
            passed.add(vertex)
        return pieces

    def from_place(self, face: int, weights: Weights, distance: float) -> list[Piece] | None:
        """Return the pieces of the shortest path from a place in a face, at this distance."""
        windows = [
            w for h in range(3 * face, 3 * face + 3) for w in self._leaving(h, 0, math.inf, *self._at(h, weights), None)
        ]
        hit = self._hit([(face, weights)], windows, distance, set())
        if hit is None:
            return None
        pieces = self._pieces(hit, weights)
        rest = self.from_vertex(hit.id) if hit.id >= 0 else []
        return None if rest is None else pieces + rest

    # ------------------------------------------------------------------ a straight part
    def _hit(
        self, starts: Iterable[tuple[int, Weights]], windows: list[_Window], distance: float, passed: set[int]
    ) -> _Hit | None:
        """Return the vertex or source that the shortest path from a place at this distance meets first.

        Vertices that were passed are left out. `starts` are the place's weights in each face that has it, `windows`
        those of the lines that leave these.
        """
        best: _Hit | None = None
        found = [hit for face, weights in starts for hit in self._hits_within(face, weights)]
        for _ in range(MOST_WINDOWS):
            for hit in found:
                is_nearer = hit.id < 0 or (hit.id not in passed and self.distances[hit.id] <= distance)
                if is_nearer and hit.length <= (distance + self.rounding if best is None else best.length):
                    best = hit
            if not windows:
                break
            window = windows.pop()
            found = []
            if self._bound(window, distance) <= distance + self.rounding and not _comes_round(window):
                found = list(self._hits(window))
                windows += self._beyond(window)
        return best

    def _hits_within(self, face: int, weights: Weights) -> Iterator[_Hit]:
        """Yield what is in the face of a place."""
        x, y = self._at(3 * face, weights)
        for h in range(3 * face, 3 * face + 3):
            vertex, (qx, qy) = self._side(h).vertex, self._at(3 * face, _at_corner(h))
            length = math.hypot(qx - x, qy - y) + float(self.distances[vertex])
            yield _Hit(length, vertex, 3 * face, qx, qy, _at_corner(h), None)
        for number in self.sources.get(face, ()):
            qx, qy, end = self._nearest(number, 3 * face, x, y)
            length = math.hypot(qx - x, qy - y) + float(self.offsets[number])
            yield _Hit(length, ~number, 3 * face, qx, qy, end, None)

    def _hits(self, window: _Window) -> Iterator[_Hit]:
        """Yield what is in the face behind a window."""
        h = window.side
        apex, (x, y) = _previous(h), self._apex(h)
        vertex = self._side(apex).vertex
        length = self._length(window, x, y) + float(self.distances[vertex])
        yield _Hit(length, vertex, h, x, y, _at_corner(apex), window)
        for number in self.sources.get(h // 3, ()):
            x, y, _ = self._nearest(number, h, window.x, -window.y)
            x, y, weights = self._nearest(number, h, window.crossing(x, y), 0)
            yield _Hit(self._length(window, x, y) + float(self.offsets[number]), ~number, h, x, y, weights, window)

    def _length(self, window: _Window, x: float, y: float) -> float:
        across = window.crossing(x, y)
        return math.hypot(across - window.x, window.y) + math.hypot(x - across, y)

    def _bound(self, window: _Window, distance: float) -> float:
        """Return a length that no path through a window is below, of a place at this distance."""
        side, end = self._side(window.side), self._side(_next(window.side)).vertex
        # Distances farther out need not be known.
        a, b = (min(float(self.distances[vertex]), distance) for vertex in (side.vertex, end))
        x = min(max((a - b + side.length) / 2, window.low), window.high)
        return math.hypot(x - window.x, window.y) + max(a - x, b - side.length + x)

    # ------------------------------------------------------------------ unfolding
    def _leaving(
        self, leaving: int, low: float, high: float, x: float, y: float, before: _Window | None
    ) -> Iterator[_Window]:
        """Yield the windows behind a side by which lines leave a face; they come from (x, y) in its frame."""
        length = self._side(leaving).length
        low, high, y = max(low, 0.0), min(high, length), max(y, 0.0)
        if not low < high:
            return
        is_turned, h = False, leaving
        while (twin := self._side(h).twin) >= 0 and twin >> 1 != leaving:
            is_turned ^= not twin & 1
            h = twin >> 1
            if is_turned:
                yield _Window(h, length - high, length - low, length - x, y, leaving, True, before)
            else:
                yield _Window(h, low, high, x, y, leaving, False, before)

    def _beyond(self, window: _Window) -> Iterator[_Window]:
        """Yield the windows behind the other two sides of the face behind a window."""
        h = window.side
        side, is_on_side = self._side(h), window.y == 0
        if is_on_side and not window.low <= window.x <= window.high:
            return  # the lines run along the side
        across = window.x + (side.x - window.x) * window.y / (window.y + side.y) if window.y + side.y > 0 else side.x
        left, right = window.low < across or is_on_side, window.high > across or is_on_side
        # Of the two sides' far ends, which are the apex, each is seen unless all lines leave over the other one.
        for is_right in (False, True)[not left : 1 + right]:
            leaving = _next(h) if is_right else _previous(h)
            length, (c, s) = self._side(leaving).length, self._corner(leaving if is_right else h)
            x, ends = window.x, (window.low, window.high)
            if is_right:
                x, ends = side.length - x, (side.length - window.high, side.length - window.low)
            low, high = 0.0, length
            if not is_on_side:
                low = max(_meeting(ends[0], ends[0] - x, window.y, c, s, low), low)
            if not is_on_side and not (left and right):
                high = min(_meeting(ends[1], ends[1] - x, window.y, c, s, high), high)
            x, y = x * c - window.y * s, c * window.y + s * x
            if not is_right:
                low, high, x = length - high, length - low, length - x
            yield from self._leaving(leaving, low, high, x, y, window)

    def _pieces(self, hit: _Hit, start: Weights) -> list[Piece]:
        """Return the line from the start, with these weights in its face, to its target."""
        pieces: list[Piece] = []
        window, x, y, end = hit.window, hit.x, hit.y, hit.weights
        while window is not None:
            across = window.crossing(x, y)  # all of the window is seen from the start, and what is behind it from there
            pieces.append((window.side // 3, self._on_side(window.side, across), end))
            on_leaving = self._side(window.side).length - across if window.is_turned else across
            end = self._on_side(window.leaving, on_leaving)
            if window.before is not None:
                x, y = self._of_side(window.before.side, window.leaving, on_leaving)
            window = window.before
        return [(_first_face(hit), start, end), *reversed(pieces)]

    def _of_side(self, h: int, other: int, x: float) -> tuple[float, float]:
        """Return, in the frame of side h, the point at x from the beginning of another side of its face."""
        if other == _next(h):
            c, s = self._corner(other)
            return self._side(h).length - x * c, x * s
        (c, s), rest = self._corner(h), self._side(other).length - x
        return rest * c, rest * s

    # ------------------------------------------------------------------ the mesh
    def _side(self, h: int) -> _Side:
        return _Side(*self.sides[h].item())

    def _apex(self, h: int) -> tuple[float, float]:
        side = self._side(h)
        return side.x, side.y

    def _corner(self, h: int) -> tuple[float, float]:
        """Return the cosine and sine of a face's corner at the beginning of a side."""
        side, length = self._side(h), self._side(_previous(h)).length
        return side.x / length, side.y / length

    def _at(self, h: int, weights: Weights) -> tuple[float, float]:
        """Return the position of weights in the frame of a side."""
        side, apex = self._side(h), weights[_previous(h) % 3]
        return weights[_next(h) % 3] * side.length + apex * side.x, apex * side.y

    def _on_side(self, h: int, x: float) -> Weights:
        weights, share = [0.0, 0.0, 0.0], x / self._side(h).length
        weights[h % 3], weights[_next(h) % 3] = 1 - share, share
        return weights

    def _nearest(self, number: int, h: int, x: float, y: float) -> tuple[float, float, Weights]:
        """Return the point of a source that is nearest to (x, y) in the frame of a side of its face, and its
        weights."""
        begin, end = self.begins[number].tolist(), self.ends[number].tolist()
        (ax, ay), (bx, by) = self._at(h, begin), self._at(h, end)
        ux, uy = bx - ax, by - ay
        square = ux * ux + uy * uy
        t = min(max(((x - ax) * ux + (y - ay) * uy) / square, 0.0), 1.0) if square > 0 else 0.0
        return ax + t * ux, ay + t * uy, [(1 - t) * p + t * q for p, q in zip(begin, end, strict=True)]


def _next(h: int) -> int:
    return h - 2 if h % 3 == 2 else h + 1


def _previous(h: int) -> int:
    return h - 1 if h % 3 else h + 2


def _at_corner(h: int) -> Weights:
    return [float(k == h % 3) for k in range(3)]


def _first_face(hit: _Hit) -> int:
    """Return the face in which the line to a hit begins."""
    h, window = hit.side, hit.window
    while window is not None:
        h, window = window.leaving, window.before
    return h // 3


def _comes_round(window: _Window) -> bool:
    """Return whether the lines have been in the window's face before: a shortest path crosses a face once."""
    face, before = window.side // 3, window.before
    while before is not None and before.leaving // 3 != face:
        before = before.before
    return before is not None


def _meeting(b: float, dx: float, dy: float, c: float, s: float, otherwise: float) -> float:
    """Return the distance from the origin at which a line from (b, 0) into (dx, dy) meets the ray into (c, s)."""
    across = dy * c - dx * s
    return dy * b / across if across > 0 else otherwise
