"""A mesh without its degenerate faces: edges of no length become points, and flat faces the edges that they are."""

import ctypes

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..kernel import library as kernel
from .face_cells import Part, cell_weights, in_parts

ASIDE = 1e-10
"""Of coordinates: the least size of a face that is added."""

MOST_STEPS = 50
"""Cells that are looked at for each degenerate face, on average; what is left then stays."""

CELLS_EACH = 16
"""Room for so many cells for each degenerate face at first."""


class ProperFaces:
    """The faces of a mesh, with degenerate ones and what they touch replaced.

    The ends of an edge of no length become one vertex. A flat face with its apex between the ends of its longest edge
    is taken out, and all other faces at that edge are divided at the apex. Lengths change by 2e-13 of a face's longest
    edge at each.

    Attributes
    ----------
    points, faces : (n + p, 3) and (m + q, 3) ndarray
        The vertices and faces, those that are added last; a face that is gone names one vertex three times.
    labels : (m + q, 3) ndarray
        The edge of each side; sides with the same ends are not always of one edge.
    same : (n + p,) ndarray
        The vertex that stands for each.
    """

    def __init__(self, points: FloatArray, faces: AnyArray, sides: AnyArray, degenerate: int) -> None:
        """Replace the faces; `sides` (3 m,) is of `SIDE`, and `degenerate` is the number of degenerate faces."""
        self._own = m = len(faces)
        edge_of = _edges(sides)
        is_face = _is_face(faces)
        room = CELLS_EACH * degenerate
        while (cells := _cells(points, faces, edge_of, is_face, room, degenerate)) is None:
            room *= 2
        self._cells, vertex_for, edge_for = cells
        found = np.flatnonzero(self._cells["is_there"][m:]) + m
        corners = self._cells["corner"]
        # Triangles first of all where the face has been, and the others behind.
        triangles, lower = found[corners[found, 2] >= 0], found[corners[found, 2] < 0]
        here = np.zeros(len(triangles), bool)
        here[np.unique(self._cells["face"][triangles], return_index=True)[1]] = True
        numbers = np.where(here, self._cells["face"][triangles], m - 1 + np.cumsum(~here))
        is_gone = is_face & (self._cells["is_there"][:m] == 0)
        count = m + int((~here).sum())
        self.faces, self.labels = np.zeros((count, 3), np.int32), np.zeros((count, 3), np.int32)
        self.faces[:m], self.labels[:m] = faces, edge_for[edge_of.reshape(-1, 3)]
        self.faces[:m][is_gone] = 0
        self.faces[numbers], self.labels[numbers] = corners[triangles], edge_for[self._cells["edge"][triangles]]
        self._cell_of = np.full(count, -1, np.int32)
        self._cell_of[numbers] = triangles
        self.points = points
        targets = self._targets(lower, edge_for)
        all_cells = np.concatenate([triangles, lower])
        order = np.argsort(self._cells["face"][all_cells], kind="stable")
        self._part_cells, self._part_targets = all_cells[order], np.concatenate([numbers, targets])[order]
        self._part_faces = self._cells["face"][self._part_cells]
        self.same = np.concatenate([vertex_for, np.arange(len(points), len(self.points), dtype=np.int32)])

    def _targets(self, lower: IntArray, edge_for: AnyArray) -> IntArray:
        """Find a face for each cell that is an edge or a point, and add one where there is none."""
        edge, vertex = self._cells["edge"][lower, 0], self._cells["corner"][lower, 0]
        edge = np.where(edge >= 0, edge_for[edge], -1)
        is_there = _is_face(self.faces)
        at_edge, at_vertex = np.full(len(edge_for), -1, np.int64), np.full(len(self.points), -1, np.int64)
        rows = np.repeat(np.flatnonzero(is_there), 3)
        at_edge[self.labels[is_there].ravel()], at_vertex[self.faces[is_there].ravel()] = rows, rows
        targets = np.where(edge >= 0, at_edge[edge], at_vertex[vertex])
        more, added, labels = list[FloatArray](), list[list[int]](), list[list[int]]()
        for row in np.flatnonzero(targets < 0).tolist():
            known = at_edge[edge[row]] if edge[row] >= 0 else at_vertex[vertex[row]]
            if known < 0:
                corners = [v for v in self._cells["corner"][lower[row]].tolist() if v >= 0]
                known, count = len(self.faces) + len(added), len(self.points) + len(more)
                new = self._aside(corners)
                more += new
                added.append([*corners, *range(count, count + len(new))])
                labels.append([int(edge[row]) if len(corners) == 2 else 0, 0, 0])
                self._cell_of = np.append(self._cell_of, np.int32(lower[row]))
                if edge[row] >= 0:
                    at_edge[edge[row]] = known
                else:
                    at_vertex[vertex[row]] = known
            targets[row] = known
        self.points = np.concatenate([self.points, np.reshape(more, (-1, 3))])
        self.faces = np.concatenate([self.faces, np.array(added, np.int32).reshape(-1, 3)])
        self.labels = np.concatenate([self.labels, np.array(labels, np.int32).reshape(-1, 3)])
        return targets

    def _aside(self, corners: list[int]) -> list[FloatArray]:
        """Return the corners that an edge, or a point, lacks for a triangle: so far from it that they can be told from
        it."""
        start, way = self.points[corners[0]], self.points[corners[-1]] - self.points[corners[0]]
        size = max(float(np.linalg.norm(way)), ASIDE * float(np.abs(start).max())) or 1.0
        axes = size * np.eye(3)[np.argsort(np.abs(way), kind="stable")]
        return [start + way / 2 + axes[0]] if len(corners) == 2 else [start + axes[0], start + axes[1]]

    # ------------------------------------------------------------------ from the mesh's faces to these, and back
    def is_changed(self, faces: AnyArray) -> AnyArray:
        """Return (k,) whether faces (k,) of the mesh are not there as they were."""
        first, end = (np.searchsorted(self._part_faces, faces, side) for side in ("left", "right"))
        changed: AnyArray = end > first
        return changed

    def pieces(self, face: int, begin: FloatArray, end: FloatArray) -> list[tuple[int, FloatArray, FloatArray]]:
        """Return a straight piece of a face that has changed, by the weights (3,) of its ends, in these faces."""
        low, high = np.searchsorted(self._part_faces, [face, face + 1]).tolist()
        parts = [self._part(number) for number in range(low, high)]
        return in_parts(parts, self.points[self._cells["corner"][face]], begin, end)

    def _part(self, number: int) -> Part:
        cell, target = int(self._part_cells[number]), int(self._part_targets[number])
        inward, within, _ = cell_weights(self._cells, cell)
        corners, full = self.faces[target].tolist(), np.zeros((3, 3))
        columns = [corners.index(v) for v in self._cells["corner"][cell].tolist() if v >= 0]
        full[:, columns] = inward
        return Part(target, full, full if len(columns) == 3 else np.hstack([within, inward]), self.points[corners])

    def outside(self, faces: IntArray, begins: FloatArray, ends: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Faces (p,) of the mesh for these, with the weights (p, 3) there."""
        faces, begins, ends = faces.copy(), begins.copy(), ends.copy()
        for row in np.flatnonzero(self._cell_of[faces] >= 0).tolist():
            cell = int(self._cell_of[faces[row]])
            back = cell_weights(self._cells, cell).outward
            begins[row], ends[row] = begins[row, : len(back)] @ back, ends[row, : len(back)] @ back
            faces[row] = self._cells["face"][cell]
        return faces, begins, ends


def _is_face(faces: AnyArray) -> AnyArray:
    """Return (m,) whether a face names no vertex twice."""
    is_face: AnyArray = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return is_face


def _edges(sides: AnyArray) -> AnyArray:
    """Return (3 m,) the number of each side's edge: that of the first side there."""
    own, twin = np.arange(len(sides), dtype=np.int32), sides["twin"] >> 1
    following = np.where(sides["twin"] >= 0, twin, own)
    edge: AnyArray = own.copy()
    while True:
        less = np.minimum(edge, edge[following])
        if np.array_equal(less, edge):
            return edge
        edge, following = less, following[following]


def _cells(
    points: FloatArray, faces: AnyArray, edge_of: AnyArray, is_face: AnyArray, more: int, degenerate: int
) -> tuple[AnyArray, AnyArray, AnyArray] | None:
    """Return all cells, and the vertex and the edge that stand for each; None if there are so many more than faces."""
    n, m, room, edges = len(points), len(faces), len(faces) + more, 3 * len(faces) + more
    cell = np.zeros(room, kernel.CELL)
    cell["corner"][:m], cell["edge"][:m], cell["before"][:m] = faces, edge_of.reshape(-1, 3), -1
    cell["face"][:m], cell["is_there"][:m] = np.arange(m), is_face
    sizes = {"first": n, "next": 3 * room, "vertex_for": n, "edge_for": edges, "divided": 2 * edges}
    kept = {name: np.empty(size, np.int32) for name, size in sizes.items()}
    kept |= {name: np.empty(room, np.int32) for name in ("wait", "found")}
    arrays = {"points": points, "cell": cell} | kept | {"longest": np.empty((room, kernel.FLAT), np.uint8)}
    all_cells = kernel.Cells(
        cells=m, edges=3 * m, room=room, edge_room=edges, **{name: kernel.at(array) for name, array in arrays.items()}
    )
    most = m + MOST_STEPS * degenerate
    if kernel.library().bih_geodesic_cells(ctypes.byref(all_cells), n, m, most) == kernel.NO_ROOM:
        return None
    return cell[: all_cells.cells], _roots(kept["vertex_for"]), _roots(kept["edge_for"][: all_cells.edges])


def _roots(stands: AnyArray) -> AnyArray:
    """Return (k,) the last that stands for each."""
    while not np.array_equal(further := stands[stands], stands):
        stands = further
    return stands
