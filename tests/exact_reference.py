"""Distances in decimal arithmetic of 90 digits, from the coordinates as they are: slow, and right on any sliver."""

from decimal import Decimal, localcontext

import numpy as np

from bihdist_core import Surface

DIGITS = 90
SMALLEST = Decimal(10) ** -40
"""Height over the longest side that stands for none; faces of it are met by smaller ones to forty digits."""

Rows = list[dict[int, Decimal]]


class ExactReference:
    """Biharmonic and commute-time distance on one connected surface with mixed Voronoi areas."""

    def __init__(self, surface: Surface) -> None:
        with localcontext() as context:
            context.prec = DIGITS
            self.stiffness, self.areas = _operators(surface)
            self._eliminated = _eliminated(self.stiffness)

    def pair(self, i: int, j: int) -> tuple[float, float]:
        """The biharmonic and the commute-time distance: L y = e_i - e_j, |y - mean|_A and the root of y_i - y_j."""
        with localcontext() as context:
            context.prec = DIGITS
            y = [Decimal(0)] * len(self.areas)
            y[i], y[j] = Decimal(1), Decimal(-1)
            y[0] = Decimal(0)  # pinned
            for p, _, row in self._eliminated:
                if y[p]:
                    for q, share in row.items():
                        y[q] -= share * y[p]
            for p, pivot, row in reversed(self._eliminated):
                y[p] = y[p] / pivot - sum((share * y[q] for q, share in row.items()), Decimal(0))
            mean = sum(a * v for a, v in zip(self.areas, y, strict=True)) / sum(self.areas)
            squares = sum(a * (v - mean) ** 2 for a, v in zip(self.areas, y, strict=True))
            return float(squares.sqrt()), float((y[i] - y[j]).sqrt())


def _operators(surface: Surface) -> tuple[Rows, list[Decimal]]:
    """Stiffness rows and vertex areas.  Of the longest side ab of a face and its apex i: a spring and a link."""
    x = [[Decimal(float(c)) for c in vertex] for vertex in surface.vertices]
    rows: Rows = [{} for _ in x]
    areas = [Decimal(0)] * len(x)

    def add(p: int, q: int, value: Decimal) -> None:
        rows[p][q] = rows[p].get(q, Decimal(0)) + value

    for face in surface.faces.tolist():
        squares = [sum((s - t) ** 2 for s, t in zip(x[face[k - 1]], x[face[k - 2]], strict=True)) for k in range(3)]
        k = squares.index(max(squares))
        i, a, b = face[k], face[k - 2], face[k - 1]
        square, length = squares[k], squares[k].sqrt()
        along = [q - p for p, q in zip(x[a], x[b], strict=True)]
        to_apex = [q - p for p, q in zip(x[a], x[i], strict=True)]
        s = sum(p * q for p, q in zip(along, to_apex, strict=True)) / square
        height = sum((q - s * p) ** 2 for p, q in zip(along, to_apex, strict=True)).sqrt()
        height = max(height, SMALLEST * length)
        spring, link, g = length / (2 * height), height / (2 * length), {i: Decimal(1), a: s - 1, b: -s}
        for p, value in g.items():
            for q, other in g.items():
                add(p, q, spring * value * other)
        for p, q in ((a, b), (b, a)):
            add(p, p, link)
            add(p, q, -link)
        area = length * height / 2
        cotangent = {i: (height**2 - s * (1 - s) * square) / (2 * area), a: s * length / height}
        cotangent[b] = (1 - s) * length / height
        opposite = {i: square, a: ((1 - s) * length) ** 2 + height**2, b: (s * length) ** 2 + height**2}
        parts = {p: cotangent[p] * opposite[p] for p in (i, a, b)}
        for p in (i, a, b):
            if cotangent[i] < 0:
                areas[p] += area / (2 if p == i else 4)
            else:
                areas[p] += (sum(parts.values()) - parts[p]) / 8
    return rows, areas


def _eliminated(rows: Rows) -> list[tuple[int, Decimal, dict[int, Decimal]]]:
    """Each vertex but the pinned one (0), fewest neighbours first, with its pivot and what it gives to the others."""
    left = {p: {q: v for q, v in rows[p].items() if q} for p in range(1, len(rows))}
    steps = []
    while left:
        p = min(left, key=lambda vertex: len(left[vertex]))
        row = left.pop(p)
        pivot = row.pop(p)
        shares = {q: value / pivot for q, value in row.items()}
        for q, share in shares.items():
            del left[q][p]
            for r, value in row.items():
                left[q][r] = left[q].get(r, Decimal(0)) - share * value
        steps.append((p, pivot, shares))
    return steps


def constrained_operators(surface: Surface, apexes: dict[int, tuple[int, int, float]]) -> tuple[np.ndarray, ...]:
    """The limit of faces of no height, dense: (n, k) T, (k, k) stiffness and (k, k) areas of what is free.

    apexes: those vertices that degenerate faces hold to a foot, with the ends of its edge and the foot's share from the
    first of them.  surface: without these faces.
    """
    from bihdist_core.operators import stiffness, vertex_areas

    n = len(surface.vertices)
    free = [v for v in range(n) if v not in apexes]
    t = np.zeros((n, len(free)))
    t[free, np.arange(len(free))] = 1
    for apex, (a, b, foot) in apexes.items():
        t[apex] = (1 - foot) * t[a] + foot * t[b]
    return t, t.T @ stiffness(surface).toarray() @ t, t.T @ (vertex_areas(surface)[:, None] * t)
