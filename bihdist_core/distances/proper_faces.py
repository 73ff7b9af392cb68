"""A mesh without its degenerate faces: edges of no length become points, and flat faces the edges that they are."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray

NO_HEIGHT = 2e-13
"""Of a face's longest edge: with less height, and so with a shorter edge, it is degenerate (`geodesic_mesh.c`)."""

ASIDE = 1e-10
"""Of coordinates: the least size of a face that is added."""

ROUNDING = 1e-15
"""Of weights."""

MOST_STEPS = 50
"""For each degenerate face, on average; what is left then stays."""


Edge = tuple[int, int]
"""An edge's name: the ends that it has in the mesh, or (-1, number) within a face."""


@dataclass
class Cell:
    """What a face, or a part of it, has become: a triangle, an edge or a point, by its k corners.

    face: which it was.  edges: from each corner to the next, from the last to the first only of a triangle.  inward
    (3, k): weights in that face times this are those in the cell; within (3, c): times this they are not negative in
    the cell, either.  outward (k, 3): the weights of the cell's corners in that face.
    """

    corners: list[int]
    edges: list[Edge]
    face: int
    inward: FloatArray
    within: FloatArray
    outward: FloatArray

    def reduced(self) -> "Cell":
        """With each corner once.  The edges that were of a triangle, and are one now, are all there."""
        corners = list(dict.fromkeys(self.corners))
        if len(corners) == len(self.corners):
            return self
        inward = np.zeros((3, len(corners)))
        for k, corner in enumerate(self.corners):
            inward[:, corners.index(corner)] += self.inward[:, k]
        ends = zip(self.corners, self.corners[1:] + self.corners[:1], strict=True)
        edges = [edge for edge, (p, q) in zip(self.edges, ends, strict=False) if p != q]
        within = np.hstack([self.within, self.inward])
        outward = self.outward[[self.corners.index(v) for v in corners]]
        return Cell(corners, edges, self.face, inward, within, outward)

    def halves(self, edge: Edge, share: float, c: int, near: dict[int, Edge], chord: Edge) -> "Iterator[Cell]":
        """Both parts of a cell that is divided by vertex c, at this share of an edge.

        near: the edges that are left of it, by the end that they share with it; chord: the edge between both parts.
        """
        i = self.edges.index(edge)
        j = (i + 1) % len(self.corners)
        if self.corners[i] != next(iter(near)):
            share = 1 - share
        for stays, goes, part in ((i, j, share), (j, i, 1 - share)):
            inward, outward = self.inward.copy(), self.outward.copy()
            inward[:, goes] /= part
            inward[:, stays] -= inward[:, goes] * (1 - part)
            outward[goes] = part * outward[goes] + (1 - part) * outward[stays]
            corners, edges = self.corners.copy(), self.edges.copy()
            corners[goes], edges[i] = c, near[self.corners[stays]]
            if len(corners) == 3:
                edges[j if goes == j else i - 1] = chord
            yield Cell(corners, edges, self.face, inward, self.within, outward).reduced()


class Part(NamedTuple):
    """A face that holds a part of another.

    inward (3, 3): weights in the other face times this are those in the part's; within (3, c): times this they are not
    negative in the part.
    """

    face: int
    inward: FloatArray
    within: FloatArray


class ProperFaces:
    """The faces of a mesh, with degenerate ones and what they touch replaced.  Lengths change by `NO_HEIGHT` at each.

    The ends of an edge of no length become one vertex.  A flat face with its apex between the ends of its longest edge
    is taken out, and all other faces at that edge are divided at the apex.  points (n + p, 3), faces (m + q, 3): those
    that are added come last; a face that is gone names one vertex three times.  labels (m + q, 3): sides of faces that
    have the same ends are the same edge only with the same label.  same (n + p,): the vertex that stands for each.
    parts: what became of each face that is not there as it was.  whole: the face that each of these is of, with the
    matrix (3, 3) that takes weights back.
    """

    def __init__(self, points: FloatArray, faces: AnyArray, degenerate: IntArray) -> None:
        self.points, self.faces = points, faces
        self.parts: dict[int, list[Part]] = {}
        self.whole: dict[int, tuple[int, FloatArray]] = {}
        self._stands: dict[int | Edge, int | Edge] = {}
        self._order = np.argsort(faces, axis=None, kind="stable")
        self._first = np.searchsorted(faces.ravel()[self._order], np.arange(len(points) + 1))
        self._cells: dict[int, Cell] = {}
        self._around: dict[int, set[int]] = {}
        self._count = len(faces)  # the highest number of a cell, or more
        self._divided: dict[Edge, tuple[int, int]] = {}  # by each chord the ends of the edge that was divided
        self._waiting = degenerate.tolist()
        for _ in range(MOST_STEPS * len(degenerate)):
            if not self._waiting:
                break
            self._mend(self._waiting.pop())
        self._complete()

    def _root(self, name: Any) -> Any:
        """The vertex, or the edge, that stands for one."""
        while name in self._stands:
            name = self._stands[name]
        return name

    # ------------------------------------------------------------------ cells
    def _at(self, vertex: int) -> set[int]:
        """The numbers of cells with this corner."""
        if vertex not in self._around:
            self._around[vertex] = set((self._order[self._first[vertex] : self._first[vertex + 1]] // 3).tolist())
        return self._around[vertex]

    def _cell(self, number: int) -> Cell:
        if number not in self._cells:
            i, j, k = self.faces[number].tolist()
            edges = [(min(p, q), max(p, q)) for p, q in ((i, j), (j, k), (k, i))]
            self._cells[number] = Cell([i, j, k], edges, number, np.eye(3), np.empty((3, 0)), np.eye(3))
        cell = self._cells[number]
        cell.edges = list(map(self._root, cell.edges))
        return cell

    def _replace(self, number: int, *cells: Cell) -> None:
        for vertex in self._cell(number).corners:
            self._at(vertex).discard(number)
        for cell in cells:
            for vertex in cell.corners:
                self._at(vertex).add(number)
            if len(cell.corners) == 2:
                edge, *others = set(map(self._root, cell.edges))
                self._stands |= dict.fromkeys(others, edge)
                cell.edges = [edge]
            self._cells[number] = cell
            self._waiting.append(number)
            number = self._count = self._count + 1

    # ------------------------------------------------------------------ what becomes of degenerate faces
    def _mend(self, number: int) -> None:
        """Join vertices or divide faces, if this is a degenerate one."""
        cell = self._cell(number)
        if len(cell.corners) < 3:
            return
        x = [self.points[v].tolist() for v in cell.corners]
        lengths = [math.dist(x[k], x[k - 2]) for k in range(3)]  # of the edges
        longest, shortest = max(lengths), min(lengths)
        k = lengths.index(longest)
        edge, way = ([q - p for p, q in zip(x[k], x[end], strict=True)] for end in (k - 2, k - 1))
        if (
            math.hypot(*(edge[i - 2] * way[i - 1] - edge[i - 1] * way[i - 2] for i in range(3)))
            > NO_HEIGHT * longest**2
        ):
            return
        if shortest <= NO_HEIGHT * longest:
            k = lengths.index(shortest)
            self._join(cell.corners[k], cell.corners[k - 2])
            return
        a, b, c = cell.corners[k], cell.corners[k - 2], cell.corners[k - 1]
        share = min(max(sum(p * q for p, q in zip(edge, way, strict=True)) / longest**2, NO_HEIGHT), 1 - NO_HEIGHT)
        if c in self._divided.get(cell.edges[k], ()):
            return  # that would undo it
        divided, near = cell.edges[k], {a: cell.edges[k - 1], b: cell.edges[k - 2]}
        for other in self._at(a) & self._at(b):
            if divided in self._cell(other).edges:
                chord = -1, len(self._divided)
                self._divided[chord] = a, b
                self._replace(other, *self._cell(other).halves(divided, share, c, near, chord))

    def _join(self, a: int, b: int) -> None:
        self._stands[b] = a
        for number in list(self._at(b)):
            cell = self._cell(number)
            corners = [a if v == b else v for v in cell.corners]
            self._replace(number, replace(cell, corners=corners).reduced())

    # ------------------------------------------------------------------ the result
    def _complete(self) -> None:
        """Number the triangles, and find one for each edge and each point, or add it."""
        own, lower = len(self.faces), list[Cell]()
        faces, added, numbers = self.faces.copy(), list[list[int]](), dict[int, int]()
        labels, more_labels, names = np.zeros_like(faces), list[list[int]](), dict[Edge, int]()

        def label(edge: Edge, *ends: int) -> int:
            return 0 if edge == self._root((min(ends), max(ends))) else names.setdefault(edge, len(names) + 1)

        for number in self._cells:
            cell = self._cell(number)
            corners = cell.corners
            if number < own:
                faces[number] = 0
            if len(corners) < 3:
                lower.append(cell)
                continue
            its_labels = [label(edge, corners[k], corners[k - 2]) for k, edge in enumerate(cell.edges)]
            if number < own:
                numbers[number], faces[number], labels[number] = number, corners, its_labels
            else:
                numbers[number] = own + len(added)
                added.append(corners)
                more_labels.append(its_labels)
            self.parts.setdefault(cell.face, []).append(Part(numbers[number], cell.inward, cell.inward))
            self.whole[numbers[number]] = cell.face, cell.outward
        flaps, more = dict[int | Edge, int](), list[FloatArray]()  # at an edge or a point that has no triangle
        for cell in lower:
            edge, corners = (cell.edges or cell.corners)[0], cell.corners
            there = (n for n in set.intersection(*map(self._at, corners)) if len(self._cell(n).corners) == 3)
            found = next((numbers.get(n, n) for n in there if not cell.edges or edge in self._cell(n).edges), None)
            if found is None and edge not in flaps:
                flaps[edge] = own + len(added)
                new, count = self._aside(corners), len(self.points) + len(more)
                added.append([*corners, *range(count, count + len(new))])
                more_labels.append([*(label(each, *corners) for each in cell.edges), 0, 0, 0][:3])
                more += new
                self.whole[flaps[edge]] = cell.face, np.pad(cell.outward, ((0, len(new)), (0, 0)))
            target = flaps[edge] if found is None else found
            columns = _columns(added[target - own] if target >= own else faces[target].tolist(), cell)
            self.parts.setdefault(cell.face, []).append(Part(target, columns, np.hstack([cell.within, cell.inward])))
        self.faces = np.concatenate([faces, np.array(added, np.int32).reshape(-1, 3)])
        self.labels = np.concatenate([labels, np.array(more_labels, np.int32).reshape(-1, 3)])
        self.points = np.concatenate([self.points, np.reshape(more, (-1, 3))])
        self.same = np.arange(len(self.points), dtype=np.int32)
        for vertex in {v for v in self._stands if isinstance(v, int)}:
            self.same[vertex] = self._root(vertex)

    def _aside(self, corners: list[int]) -> list[FloatArray]:
        """The corners that an edge, or a point, lacks for a triangle: so far from it that they can be told from it."""
        start, way = self.points[corners[0]], self.points[corners[-1]] - self.points[corners[0]]
        size = max(float(np.linalg.norm(way)), ASIDE * float(np.abs(start).max())) or 1.0
        axes = size * np.eye(3)[np.argsort(np.abs(way), kind="stable")]
        return [start + way / 2 + axes[0]] if len(corners) == 2 else [start + axes[0], start + axes[1]]


def _columns(corners: list[int], cell: Cell) -> FloatArray:
    """(3, 3) the cell's weights for a triangle that has its corners."""
    inward = np.zeros((3, 3))
    inward[:, [corners.index(v) for v in cell.corners]] = cell.inward
    return inward


def in_parts(parts: list[Part], begin: FloatArray, end: FloatArray) -> list[tuple[int, FloatArray, FloatArray]]:
    """A straight piece of a face, by the weights (3,) of its ends, as pieces of the face's parts: one for a point."""
    if np.array_equal(begin, end):
        face, inward, _ = max(parts, key=lambda part: float((begin @ part.within / _sizes(part.within)).min()))
        weights = _inside(begin @ inward, inward)
        return [(face, weights, weights)]
    found = []
    for face, inward, within in parts:
        room, way = begin @ within + ROUNDING * _sizes(within), (end - begin) @ within
        lo, hi = 0.0, 1.0
        for least, change in zip(room.tolist(), way.tolist(), strict=True):
            if change > 0:
                lo = max(lo, -least / change)
            elif change < 0:
                hi = min(hi, -least / change)
            elif least < 0:
                hi = -1.0
        if lo < hi:
            here, there = (_inside((begin + t * (end - begin)) @ inward, inward) for t in (lo, hi))
            found.append((face, here, there))
    return found or in_parts(parts, begin, begin) + in_parts(parts, end, end)


def _sizes(within: FloatArray) -> FloatArray:
    """(c,) how large numbers are that add up to those that are not negative in a part."""
    sizes: FloatArray = np.maximum(np.abs(within).max(axis=0), 1)
    return sizes


def _inside(weights: FloatArray, inward: FloatArray) -> FloatArray:
    """Weights in a part, those below 0 by rounding made up for by others that large numbers add up to, too."""
    inside = [max(weight, 0.0) for weight in weights.tolist()]
    excess = sum(inside) - 1
    for k in np.argsort(-np.abs(inward).max(axis=0)).tolist():
        less = min(inside[k], max(excess, 0.0))
        inside[k] -= less
        excess -= less
    return np.array(inside, np.float64)
