"""A surface as exact geodesic distance needs it: near in memory what is near in space, and no edge without a face."""

import ctypes
from typing import Any

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import SolverError
from ..kernel import library as kernel
from ..sources.pieces import Pieces
from ..surface import Surface

MOST_FACES = (2**31 - 1) // 6
"""Numbers of sides are below 2^31, twice."""

ASIDE = 1e-10
"""Of coordinates: the least size of a face that is added."""

RENUMBERED_FROM = 30_000
"""Vertices; smaller meshes are in the processor's cache anyway."""


class UnfoldingMesh:
    """A surface with its sides in the kernel's memory, and the kernel's numbers of what callers name.

    vertices, faces: how many there are, including flaps: where a face is a needle whose short side counts as a point,
    and the edge that is left of it belongs to no other face, a face of a new vertex holds that edge.  number (n,): of
    each vertex of the surface; same_number (n,): of the one that stands for it.  unit: lengths in the kernel are in
    this power of two of the surface's, so that no number overflows.
    """

    def __init__(self, surface: Surface) -> None:
        if len(surface.faces) > MOST_FACES // 2:
            raise SolverError(f"{surface.name} has more than {MOST_FACES // 2:,} faces; use the heat method.")
        self.surface = surface
        x = surface.vertices
        low, high = x.min(axis=0), x.max(axis=0)
        self.unit = 2.0 ** np.floor(np.log2(max(np.abs(low).max(), np.abs(high).max()) or 1.0))
        vertex_order, self._face_order = _order(surface)
        self.number = np.empty(len(x), np.int32)
        self.number[vertex_order] = np.arange(len(x), dtype=np.int32)
        self._face_number = np.empty(len(surface.faces), np.int32)
        self._face_number[self._face_order] = np.arange(len(surface.faces), dtype=np.int32)
        points = np.ascontiguousarray(x[vertex_order] / self.unit)
        corners = np.ascontiguousarray(self.number[surface.faces[self._face_order]])
        self._build(points, corners)
        # Of each face that collapsed: a face with what is left of it, and its corners there, one for each of its own.
        self._instead: dict[int, tuple[int, IntArray]] = {}
        collapsed = np.flatnonzero(self._lengths[::3] == 0)
        if len(collapsed):
            self._replace(collapsed, points, corners)

    def _build(self, points: FloatArray, corners: AnyArray) -> None:
        n, m = len(points), len(corners)
        self.vertices, self.faces, self._corners = n, m, corners
        side = np.empty((3 * m, kernel.SIDE), np.uint8)
        first, corner = np.empty(n + 1, np.int32), np.empty(3 * m, np.int32)
        same, kind = np.empty(n, np.int32), np.empty(n, np.uint8)
        self.arrays = side, first, corner, same, kind
        self.structure = kernel.Mesh(n, m, *map(kernel.at, self.arrays))
        work = np.empty((2, 3 * m), np.int32)
        kernel.library().bih_geodesic_mesh(
            ctypes.byref(self.structure), points, corners, work[0], work[1], np.empty(n + 1, np.int32)
        )
        self._lengths = side.view(np.float64)[:, 0]
        self._first, self._corner, self._same = first, corner, same
        self.same_number = same[self.number]

    def _replace(self, collapsed: IntArray, points: FloatArray, corners: AnyArray) -> None:
        """Find a face for what is left of each that collapsed, or add one."""
        left = {int(face): list(dict.fromkeys(self._same[corners[face]].tolist())) for face in collapsed}
        flaps: dict[tuple[int, ...], None] = {}
        for vertices in left.values():
            if self._face_with(vertices) is None:
                flaps[tuple(sorted(vertices))] = None
        more_points: list[FloatArray] = []
        more_faces: list[tuple[int, ...]] = []
        for vertices in flaps:
            start, way = points[vertices[0]], points[vertices[-1]] - points[vertices[0]]
            # So far from the edge that its place can be told from that of the edge.
            size = max(float(np.linalg.norm(way)), ASIDE * float(np.abs(start).max())) or 1.0
            axes = size * np.eye(3)[np.argsort(np.abs(way), kind="stable")]
            new = [start + way / 2 + axes[0]] if len(vertices) == 2 else [start + axes[0], start + axes[1]]
            count = len(points) + len(more_points)
            more_faces.append((*vertices, *range(count, count + len(new))))
            more_points += new
        if flaps:
            faces = np.concatenate([corners, np.array(more_faces, np.int32)])
            self._build(np.concatenate([points, more_points]), np.ascontiguousarray(faces))
        for face, vertices in left.items():
            found = self._face_with(vertices)
            assert found is not None
            there = self._same[self._corners[found]].tolist()
            self._instead[face] = found, np.array([there.index(v) for v in self._same[corners[face]].tolist()])

    def _face_with(self, vertices: list[int]) -> int | None:
        """A face that did not collapse, with these vertices."""
        ends = self._same[vertices]
        at = self._corner[self._first[ends[0]] : self._first[ends[0] + 1]] // 3
        return next((int(face) for face in at if np.isin(ends, self._same[self._corners[face]]).all()), None)

    def at_vertices(self, ids: IntArray) -> tuple[AnyArray, FloatArray, FloatArray]:
        """Vertices (k,) of the surface as the kernel's faces (k,) and weights (k, 3), twice."""
        corner = self._corner[self._first[self.same_number[ids]]]
        weights = np.eye(3)[corner % 3]
        return corner // 3, weights, weights

    def at_pieces(self, pieces: Pieces) -> tuple[AnyArray, FloatArray, FloatArray]:
        """Pieces (k,) of the surface as the kernel's faces (k,) and the weights (k, 3) of their ends."""
        faces = self._face_number[pieces.faces]
        begin, end = np.array(pieces.start, np.float64), np.array(pieces.stop, np.float64)
        for row in np.flatnonzero(np.isin(faces, list(self._instead))) if self._instead else ():
            faces[row], there = self._instead[int(faces[row])]
            for weights in (begin, end):
                weights[row] = np.bincount(there, weights[row], 3)
        return faces, begin, end

    def outside(self, faces: AnyArray, begins: FloatArray, ends: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Faces (p,) of the surface for the kernel's, with the weights (p, 3) there."""
        own = len(self._face_order)
        faces = faces.astype(np.int64)
        for row in np.flatnonzero(faces >= own):
            face, there = next((face, there) for face, (flap, there) in self._instead.items() if flap == faces[row])
            faces[row] = face
            for weights in (begins, ends):
                back = np.zeros(3)
                for corner in range(3):
                    back[np.flatnonzero(there == corner)[:1]] = weights[row, corner]
                weights[row] = back
        return self._face_order[faces], begins, ends


def _order(surface: Surface) -> tuple[IntArray, IntArray]:
    """The orders (n,) of vertices and (m,) of faces in the kernel."""
    x, faces = surface.vertices, surface.faces
    if len(x) < RENUMBERED_FROM:
        return np.arange(len(x)), np.arange(len(faces))
    vertex_order = np.argsort(_morton(x), kind="stable")
    number = np.empty(len(x), np.int64)
    number[vertex_order] = np.arange(len(x))
    return vertex_order, np.argsort(number[faces].min(axis=1), kind="stable")


def _morton(x: FloatArray) -> AnyArray:
    """(n,) numbers of points along Morton's curve."""
    low, size = x.min(axis=0), np.ptp(x, axis=0).max() or 1.0
    cells = np.minimum((x - low) / size * 2**20, 2**20 - 1).astype(np.uint64)
    code = np.zeros(len(x), np.uint64)
    for bit in range(20):
        for axis in range(3):
            code |= (cells[:, axis] >> np.uint64(bit) & np.uint64(1)) << np.uint64(3 * bit + axis)
    return code
