"""Exact geodesic distances on any triangle mesh in decimal arithmetic of 70 digits: slow, and right on any sliver.

    reference = GeodesicReference(vertices, faces)                  # (n, d) coordinates, (m, 3) vertex ids
    reference.distances([7])                                        # n Decimals, from vertex 7
    reference.distances([Source(7), Source(FacePoint(3, (0.2, 0.3, 0.5)), 0.1)])       # the nearer of two, one 0.1 off
    reference.distances([FaceSegment(3, (1, 0, 0), (0, 0.5, 0.5))], [FacePoint(4, (1, 1, 1))])
    np.array(reference.distances([7]), float)                       # (n,) what fast programs are held to

`distances(sources, points)` gives the distance of every vertex, then of every point, in the mesh's length unit,
infinite where no path leads.  All floats are taken as the exact numbers they are; there may be Fractions instead.

The surface.  Faces are flat triangles, joined wherever they name the same two vertices, however many they are and
however they are turned; vertices at the same place with different ids are not joined by that, but an edge of length 0
between them is a path of length 0.  A face that names a vertex twice is none, and has no edges.  A face of height 0 is
the segment it is: a path crosses it from one side to another at the same place of the line, at no length.  Two faces
of the same three vertices are two sheets.  Coordinates may have any number of dimensions d, as a flat torus needs.

Method.  A shortest path is a chain of straight stretches from source to vertex to ... to target, each of which runs in
the unfolded strip of faces that it passes, and meets no vertex between its ends.  `_look` unfolds all strips from one
start and finds what is in its line of sight, through a window (a piece of an edge) after the other; Dijkstra's
algorithm puts the stretches together.  No angle and no curvature is asked for.  A window is dropped for three reasons:

1. Its strip has had the face.  A face is flat and convex, so no path between two of its points is shorter than the
   straight one in it: some shortest path has each face once.  (The surface lies in space as it is; on one that is known
   by edge lengths alone this would be wrong.)
2. Each path through it is longer than one by an end of its edge.  Let x be the position on the edge, from a at 0 to b,
   d(x) the straight distance, u the length of any path to a.  d changes by at most 1 for each 1 of x, so that d(x) - x
   does not grow; if d(hi) > u + hi at the window's upper end, then d(x) > u + x in all of it, and the path by a is
   shorter.  In the same way from b.  That is strict, so no shortest path is lost.
3. All its rays are within `SLIVER` (of the longest edge) of one ray.  Rays at the borders of a window pass a vertex
   that cut it, from where the rest is seen as well, so that what is lost is of the order of `SLIVER`.

Of a segment, the points that it is nearest to are met by beams at right angles to it, or else from its ends.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from heapq import heappop, heappush
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

CONTEXT = Context(prec=70)
SLIVER = Decimal("1e-45")
ZERO, ONE, INFINITE = Decimal(0), Decimal(1), Decimal("Infinity")

Number = int | float | Fraction
Weights = tuple[Number, Number, Number]
Lengths = dict[int, Decimal]
CornerWeights = dict[int, Fraction]
"""Weights of a face's corners by their ids, adding up to 1."""
Targets = dict[int, list[tuple[int, CornerWeights]]]
"""For each face the points in it, numbered -1, -2, ..., and where they are."""


@dataclass(frozen=True)
class FacePoint:
    """A place in a face by its corners' weights, at least 0, which count in proportion to their sum."""

    face: int
    weights: Weights


@dataclass(frozen=True)
class FaceSegment:
    """The straight segment in a face between two places of it, given by weights as those of a `FacePoint`."""

    face: int
    start: Weights
    end: Weights


Origin = int | FacePoint | FaceSegment


@dataclass(frozen=True)
class Source:
    """A vertex, place or segment from which distances start at `offset` instead of at 0."""

    origin: Origin
    offset: float = 0


class _Rays(NamedTuple):
    """Rays from the point (x, y), in the frame of an edge: it runs from (0, 0) along x; they come from y <= 0."""

    x: Decimal
    y: Decimal

    def distance(self, x: Decimal, y: Decimal = ZERO) -> Decimal:
        return ((x - self.x) ** 2 + (y - self.y) ** 2).sqrt()

    def direction(self, x: Decimal) -> tuple[Decimal, Decimal]:
        """Of the ray through (x, 0)."""
        return x - self.x, -self.y

    def crossing(self, x: Decimal, y: Decimal) -> Decimal:
        """Where the ray to (x, y) crosses the edge's line."""
        return x if y == 0 else self.x - (x - self.x) * self.y / (y - self.y)

    def graze(self, low: Decimal, high: Decimal, small: Decimal) -> bool:
        """Whether they run along the edge.  A point of the edge itself, within the window, has all rays beyond."""
        return -self.y <= small and not low < self.x < high

    def seen_from(self, x: Decimal, y: Decimal, ux: Decimal, uy: Decimal) -> "_Rays":
        """In the frame of another edge, which starts at (x, y) in the direction of the unit vector (ux, uy)."""
        dx, dy = self.x - x, self.y - y
        return _Rays(dx * ux + dy * uy, min(ux * dy - uy * dx, ZERO))


class _Beams(NamedTuple):
    """Parallel rays of the unit direction (dx, dy), dy >= 0; at (0, 0) they have come `length` far."""

    dx: Decimal
    dy: Decimal
    length: Decimal

    def distance(self, x: Decimal, y: Decimal = ZERO) -> Decimal:
        return self.length + x * self.dx + y * self.dy

    def direction(self, _x: Decimal) -> tuple[Decimal, Decimal]:
        return self.dx, self.dy

    def crossing(self, x: Decimal, y: Decimal) -> Decimal:
        return x - y * self.dx / self.dy

    def graze(self, _low: Decimal, _high: Decimal, _small: Decimal) -> bool:
        """Never: where they run along an edge, their window there has no width."""
        return False

    def seen_from(self, x: Decimal, y: Decimal, ux: Decimal, uy: Decimal) -> "_Beams":
        return _Beams(self.dx * ux + self.dy * uy, ux * self.dy - uy * self.dx, self.distance(x, y))


class _Window(NamedTuple):
    """The piece from `low` to `high` of the edge from vertex a to b, what rays come through it, after which faces."""

    a: int
    b: int
    low: Decimal
    high: Decimal
    rays: _Rays | _Beams
    passed: int
    """Bit f for face f."""


class _Beyond(NamedTuple):
    """A face in the frame of one of its sides, from vertex a to b: its third vertex c at (x, y), y >= 0."""

    face: int
    a: int
    b: int
    c: int
    x: Decimal
    y: Decimal


class GeodesicReference:
    """Geodesic distances on the surface of (n, d) vertices and (m, 3) faces, as the module's docstring defines it.

    Sight lines between vertices are kept, so that later calls are faster.
    """

    def __init__(self, vertices: npt.ArrayLike | Sequence[Sequence[Number]], faces: npt.ArrayLike) -> None:
        points = [[Fraction(c) for c in vertex] for vertex in np.asarray(vertices, object).tolist()]
        self.faces: list[list[int]] = np.asarray(faces, int).reshape(-1, 3).tolist()
        self._squares: dict[tuple[int, int], Fraction] = {}
        self._beyond: dict[tuple[int, int], list[_Beyond]] = {}
        self._known: list[Lengths] = [{v: ZERO} for v in range(len(points))]
        self._at_vertex: list[list[_Beyond]] = [[] for _ in points]
        self._seen: dict[int, Lengths] = {}
        with localcontext(CONTEXT):
            for face in filter(_is_face, self.faces):
                for a, b in zip(face, face[1:] + face[:1], strict=True):
                    square = sum(((p - q) ** 2 for p, q in zip(points[a], points[b], strict=True)), Fraction(0))
                    self._squares[a, b] = self._squares[b, a] = square
                    self._known[a][b] = self._known[b][a] = _root(square)
            for f, (i, j, k) in enumerate(self.faces):
                if _is_face((i, j, k)):
                    for a, b, c in ((i, j, k), (j, k, i), (k, i, j)):
                        self._add_side(f, a, b, c)
                        self._add_side(f, b, a, c)
            self._sliver = SLIVER * max((d for lengths in self._known for d in lengths.values()), default=ZERO)

    def _add_side(self, face: int, a: int, b: int, c: int) -> None:
        base, side, other = self._squares[a, b], self._squares[a, c], self._squares[b, c]
        if base:  # nothing comes through an edge of length 0 but by its ends
            along = (base + side - other) / 2
            beyond = _Beyond(face, a, b, c, _decimal(along) / _root(base), _root(side - along**2 / base))
            self._beyond.setdefault((a, b), []).append(beyond)
            if a < b:
                self._at_vertex[c].append(beyond)

    def distances(self, sources: Iterable[Source | Origin], points: Sequence[FacePoint] = ()) -> list[Decimal]:
        """The distance of each of the n vertices, then of each of the points, from the nearest of the sources.

        Raises ValueError for a face that does not exist or is none, and weights that are none.
        """
        with localcontext(CONTEXT):
            start: Lengths = {}
            reached = [INFINITE] * len(points)
            for source in sources:
                origin, offset = (source.origin, source.offset) if isinstance(source, Source) else (source, 0)
                for node, length in self._from(origin, points).items():
                    length += Decimal(offset)
                    if node < 0:
                        reached[~node] = min(reached[~node], length)
                    else:
                        start[node] = min(start.get(node, INFINITE), length)
            found = self._shortest(start, self._from_vertex)
            for k, point in enumerate(points):
                for v, length in self._from(point, ()).items():
                    reached[k] = min(reached[k], found[v] + length)
            return found + reached

    def _shortest(self, start: Lengths, stretches: Callable[[int], Lengths]) -> list[Decimal]:
        """Dijkstra's algorithm over the stretches from each vertex."""
        found = [INFINITE] * len(self._known)
        queue: list[tuple[Decimal, int]] = []

        def reach(v: int, length: Decimal) -> None:
            if length < found[v]:
                found[v] = length
                heappush(queue, (length, v))

        for v, length in start.items():
            reach(v, length)
        while queue:
            length, v = heappop(queue)
            if length == found[v]:
                for w, more in stretches(v).items():
                    reach(w, length + more)
        return found

    def _from(self, origin: Origin, points: Sequence[FacePoint]) -> Lengths:
        """Lengths of straight stretches to vertices v and, as ~k, to points k."""
        if not isinstance(origin, FacePoint | FaceSegment):
            return {origin: ZERO}
        if isinstance(origin, FacePoint):
            ends = [self._checked(origin.face, origin.weights)] * 2
        else:
            ends = [self._checked(origin.face, weights) for weights in (origin.start, origin.end)]
        face = self.faces[origin.face]
        targets: Targets = {}
        for k, point in enumerate(points):
            targets.setdefault(point.face, []).append((~k, self._checked(point.face, point.weights)))
        corners = [(v, {w: Fraction(w == v) for w in face}) for v in face]
        lengths = {node: self._in_face(ends, place) for node, place in corners + targets.get(origin.face, [])}
        starts = [self._rays(origin.face, end) for end in ends[: 1 if ends[0] == ends[1] else 2]]
        if ends[0] != ends[1]:
            starts.append(self._beams(origin.face, *ends))
        for windows in starts:
            self._look(windows, lengths, targets)
        return lengths

    def _from_vertex(self, v: int) -> Lengths:
        """Lengths of straight stretches to other vertices, found once."""
        if v not in self._seen:
            self._seen[v] = self._known[v].copy()
            windows = (
                _Window(s.a, s.b, ZERO, self._known[s.a][s.b], _Rays(s.x, -s.y), 1 << s.face)
                for s in self._at_vertex[v]
            )
            self._look(windows, self._seen[v], {})
            for w, length in self._seen[v].items():
                self._known[v][w] = self._known[w][v] = min(length, self._known[w].get(v, INFINITE))
        return self._seen[v]

    def _look(self, windows: Iterable[_Window], lengths: Lengths, targets: Targets) -> None:
        """Add to the lengths of stretches those to all that is seen through windows."""
        bound = self._shortest({v: d for v, d in lengths.items() if v >= 0}, self._known.__getitem__)
        stack = list(windows)
        while stack:
            window = stack.pop()
            if self._is_useless(window, bound):
                continue
            a, b, low, high, rays, passed = window
            base = self._known[a][b]
            for beyond in self._beyond[a, b]:
                if passed >> beyond.face & 1:
                    continue
                places = [(beyond.c, beyond.x, beyond.y)]
                for node, weight in targets.get(beyond.face, ()):
                    wb, wc = _decimal(weight[b]), _decimal(weight[beyond.c])
                    places.append((node, wb * base + wc * beyond.x, wc * beyond.y))
                for node, x, y in places:
                    if low <= rays.crossing(x, y) <= high:
                        length = rays.distance(x, y)
                        lengths[node] = min(length, lengths.get(node, INFINITE))
                        if node >= 0:
                            bound[node] = min(length, bound[node])
                stack += self._through(window, beyond)

    def _is_useless(self, window: _Window, bound: list[Decimal]) -> bool:
        a, b, low, high, rays, _ = window
        if high - low <= self._sliver or rays.graze(low, high, self._sliver):
            return True
        if rays.distance(high) > bound[a] + high + self._sliver:
            return True
        return rays.distance(low) > bound[b] + self._known[a][b] - low + self._sliver

    def _through(self, window: _Window, beyond: _Beyond) -> Iterator[_Window]:
        """The windows on the other two sides of a face that a window's rays enter."""
        a, b, low, high, rays, passed = window
        _, _, _, c, x, y = beyond
        base, left, right = self._known[a][b], self._known[a][c], self._known[c][b]
        passed |= 1 << beyond.face
        if y == 0:
            if x > 0:
                yield _Window(a, c, low, min(high, x), rays, passed)
            if x < base:
                yield _Window(c, b, max(low, x) - x, high - x, rays.seen_from(x, ZERO, ONE, ZERO), passed)
            return
        apex = rays.crossing(x, y)
        if apex > low + self._sliver:
            ux, uy = x / left, y / left
            top = left if apex <= high else _meeting(rays, high, ZERO, ZERO, ux, uy)
            bottom = _meeting(rays, low, ZERO, ZERO, ux, uy)
            yield _Window(a, c, max(bottom, ZERO), min(top, left), rays.seen_from(ZERO, ZERO, ux, uy), passed)
        if apex < high - self._sliver:
            ux, uy = (base - x) / right, -y / right
            bottom = ZERO if apex >= low else _meeting(rays, low, x, y, ux, uy)
            top = _meeting(rays, high, x, y, ux, uy)
            yield _Window(c, b, max(bottom, ZERO), min(top, right), rays.seen_from(x, y, ux, uy), passed)

    def _checked(self, face: int, weights: Weights) -> CornerWeights:
        """The weight of each corner, as an exact number; they add up to 1."""
        if not 0 <= face < len(self.faces) or not _is_face(self.faces[face]):
            raise ValueError(f"There is no face {face}.")
        exact = [Fraction(w) for w in weights]
        if len(exact) != 3 or min(exact) < 0 or not sum(exact):
            raise ValueError(f"{weights} are no weights of a place in a face.")
        return {v: w / sum(exact) for v, w in zip(self.faces[face], exact, strict=True)}

    def _in_face(self, ends: list[CornerWeights], place: CornerWeights) -> Decimal:
        """The length from a place to the segment between two places of its face."""

        def product(p: CornerWeights, q: CornerWeights) -> Fraction:
            """Of vectors as weights that add up to 0: -sum over sides of (p_i q_j + p_j q_i) length_ij^2 / 2."""
            i, j, k = p
            sides = ((i, j), (j, k), (k, i))
            return -sum(((p[v] * q[w] + p[w] * q[v]) * self._squares[v, w] for v, w in sides), Fraction(0)) / 2

        along = {v: ends[1][v] - ends[0][v] for v in place}
        to_place = {v: place[v] - ends[0][v] for v in place}
        square = product(along, along)
        t = min(max(product(along, to_place) / square, Fraction(0)), Fraction(1)) if square else Fraction(0)
        rest = {v: to_place[v] - t * along[v] for v in place}
        return _root(product(rest, rest))

    def _sides(self, face: int) -> Iterator[_Beyond]:
        i, j, k = self.faces[face]
        for a, b in ((i, j), (j, k), (k, i)):
            yield from (side for side in self._beyond.get((a, b), ()) if side.face == face)

    def _rays(self, face: int, place: CornerWeights) -> Iterator[_Window]:
        for side in self._sides(face):
            base = self._known[side.a][side.b]
            yield _Window(side.a, side.b, ZERO, base, _Rays(*_position(side, base, place)), 1 << face)

    def _beams(self, face: int, start: CornerWeights, end: CornerWeights) -> Iterator[_Window]:
        for side in self._sides(face):
            base = self._known[side.a][side.b]
            (px, py), (qx, qy) = _position(side, base, start), _position(side, base, end)
            tx, ty = qx - px, qy - py
            length = (tx**2 + ty**2).sqrt()
            if length <= self._sliver or abs(tx) <= SLIVER * length:
                continue  # it is a point, or its beams run along this side
            dx, dy = -ty.copy_sign(ty * tx) / length, abs(tx) / length
            feet = sorted((px - py * dx / dy, qx - qy * dx / dy))
            low, high = max(feet[0], ZERO), min(feet[1], base)
            yield _Window(side.a, side.b, low, high, _Beams(dx, dy, -dx * px - dy * py), 1 << face)


def _position(side: _Beyond, base: Decimal, place: CornerWeights) -> tuple[Decimal, Decimal]:
    """Of a place in a face, in the frame of a side that it is seen through: y <= 0."""
    b, c = _decimal(place[side.b]), _decimal(place[side.c])
    return b * base + c * side.x, -c * side.y


def _meeting(rays: _Rays | _Beams, low: Decimal, x: Decimal, y: Decimal, ux: Decimal, uy: Decimal) -> Decimal:
    """Where the ray through (low, 0) meets the line from (x, y) in the direction of the unit vector (ux, uy)."""
    dx, dy = rays.direction(low)
    return (dy * (x - low) - dx * y) / (dx * uy - dy * ux)


def _is_face(face: Sequence[int]) -> bool:
    return len(set(face)) == 3


def _decimal(number: Fraction) -> Decimal:
    return Decimal(number.numerator) / Decimal(number.denominator)


def _root(square: Fraction) -> Decimal:
    return _decimal(square).sqrt()
