"""Exact geodesic distance the slow way: straight lines between vertices in 60 digits, and Dijkstra along them.

From each vertex that is reached, rays unfold through every sequence of faces that they cross; nothing is left out but
what is farther than the longest way along edges.
"""

from collections import defaultdict
from decimal import Decimal, localcontext
from heapq import heappop, heappush

import numpy as np

from bihdist_core import Surface
from bihdist_core.distances.edge_geodesic import EdgeGeodesic

DIGITS = 60
ZERO = Decimal("1e-40")
Vector = tuple[Decimal, Decimal]


def reference_distances(surface: Surface, source: int | tuple[int, tuple[float, float, float]]) -> np.ndarray:
    """(n,) distances from a vertex, or from a face and three weights of a point inside, on a connected surface."""
    with localcontext() as context:
        context.prec = DIGITS
        return _Unfolding(surface).distances(source)


def cross(a: Vector, b: Vector) -> Decimal:
    return a[0] * b[1] - a[1] * b[0]


class _Unfolding:
    def __init__(self, surface: Surface) -> None:
        self.points = [[Decimal(float(c)) for c in x] for x in surface.vertices]
        self.faces = [tuple(face) for face in surface.faces.tolist()]
        self.longest = Decimal(float(EdgeGeodesic(surface).distances(np.arange(1))[:, 0].max() * 2 * (1 + 1e-9)))
        self.around, self.at_edge = defaultdict(list), defaultdict(list)
        for number, (a, b, c) in enumerate(self.faces):
            for vertex, p, q in ((a, b, c), (b, c, a), (c, a, b)):
                self.around[vertex].append((number, p, q))
                self.at_edge[frozenset((p, q))].append((number, vertex))

    def distances(self, source) -> np.ndarray:
        found, heap, done = {}, [], set()
        if isinstance(source, tuple):
            face, weights = source
            a, b, c = self.faces[face]
            total = sum(map(Decimal, weights))
            share = {v: Decimal(w) / total for v, w in zip((a, b, c), weights, strict=True)}
            point = [sum(share[v] * self.points[v][k] for v in share) for k in range(3)]
            starts = [(face, p, q) for p, q in ((a, b), (b, c), (c, a))]
        else:
            point, starts = self.points[source], self.around[source]
            found[source] = Decimal(0)
            done.add(source)
        for vertex, way in self.seen(point, starts).items():
            found[vertex] = min(found.get(vertex, way), way)
            heappush(heap, (found[vertex], vertex))
        while heap:
            length, vertex = heappop(heap)
            if vertex in done:
                continue
            done.add(vertex)
            for other, way in self.seen(self.points[vertex], self.around[vertex]).items():
                if other not in found or length + way < found[other]:
                    found[other] = length + way
                    heappush(heap, (found[other], other))
        return np.array([float(found[v]) for v in range(len(self.points))])

    def square(self, p, q) -> Decimal:
        return sum((a - b) ** 2 for a, b in zip(p, q, strict=True))

    def seen(self, point, starts) -> dict[int, Decimal]:
        """The lengths of straight ways from a point, whose faces have the opposite edges `starts`, to vertices."""
        found: dict[int, Decimal] = {}

        def sees(vertex: int, square: Decimal) -> None:
            way = square.sqrt()
            found[vertex] = min(found.get(vertex, way), way)

        stack = []
        for face, a, b in starts:
            aa, bb, ab = (self.square(*ends) for ends in ((point, self.points[a]), (point, self.points[b]), (self.points[a], self.points[b])))
            sees(a, aa)
            sees(b, bb)
            # In the plane, the point at the origin and a on the axis.
            x = (aa + bb - ab) / (2 * aa.sqrt())
            height = bb - x * x
            at_a, at_b = (aa.sqrt(), Decimal(0)), (x, height.sqrt() if height > 0 else Decimal(0))
            stack.append((face, a, b, at_a, at_b, at_a, at_b))
        while stack:
            face, a, b, at_a, at_b, right, left = stack.pop()
            if self.nearest(at_a, at_b) > self.longest**2:
                continue
            for other, c in self.at_edge[frozenset((a, b))]:
                if other == face:
                    continue
                at_c = self.unfolded(a, b, c, at_a, at_b)
                from_right, from_left = cross(right, at_c), cross(at_c, left)
                if from_right >= -ZERO and from_left >= -ZERO:
                    sees(c, at_c[0] ** 2 + at_c[1] ** 2)
                if from_right > 0:
                    stack.append((other, a, c, at_a, at_c, right, left if from_left <= 0 else at_c))
                if from_left > 0:
                    stack.append((other, c, b, at_c, at_b, right if from_right <= 0 else at_c, left))
        return found

    def unfolded(self, a: int, b: int, c: int, at_a: Vector, at_b: Vector) -> Vector:
        """Where c comes to lie beyond the edge from a to b, which has the origin on its left."""
        pa, pb, pc = (self.points[v] for v in (a, b, c))
        ab, ac, bc = self.square(pa, pb), self.square(pa, pc), self.square(pb, pc)
        t = (ac - bc + ab) / (2 * ab)
        height = ac / ab - t * t
        h = height.sqrt() if height > 0 else Decimal(0)
        dx, dy = at_b[0] - at_a[0], at_b[1] - at_a[1]
        return at_a[0] + t * dx + h * dy, at_a[1] + t * dy - h * dx

    def nearest(self, a: Vector, b: Vector) -> Decimal:
        """The squared distance of the segment from a to b from the origin."""
        dx, dy = b[0] - a[0], b[1] - a[1]
        square = dx * dx + dy * dy
        t = -(a[0] * dx + a[1] * dy) / square if square else Decimal(0)
        t = max(Decimal(0), min(Decimal(1), t))
        return (a[0] + t * dx) ** 2 + (a[1] + t * dy) ** 2
