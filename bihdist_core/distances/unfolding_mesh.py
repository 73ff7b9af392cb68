"""A surface as exact geodesic distance needs it: near in memory what is near in space, and no edge without a face."""

import ctypes
from functools import cached_property
from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import SolverError
from ..kernel import library as kernel
from ..memo import Memo
from ..sources.pieces import Pieces
from ..surface import Surface
from .proper_faces import ProperFaces

MOST_FACES = (2**31 - 1) // 6
"""Numbers of sides are below 2^31, twice."""

RENUMBERED_FROM = 30_000
"""Vertices; smaller meshes are in the processor's cache anyway."""


class Places(NamedTuple):
    """Points, or straight pieces, as the kernel has them: rows (k,) which they are of those asked for; faces (k,) and
    the weights (k, 3) of their ends."""

    rows: IntArray
    faces: AnyArray
    begin: FloatArray
    end: FloatArray


class UnfoldingMesh:
    """A surface in the kernel's memory, without degenerate faces, and the kernel's numbers of its vertices and faces.

    Attributes
    ----------
    vertices, faces : int
        Their numbers, with those that stand for degenerate faces.
    points : (vertices, 3) ndarray
        Where the kernel's vertices are, in units of `unit`.
    number : (n,) ndarray
        The kernel's number of each vertex of the surface, or of the one that stands for it.
    unit : float
        The power of two of the surface's length unit in which the kernel measures lengths, so that no number overflows.
    """

    def __init__(self, surface: Surface) -> None:
        if len(surface.faces) > MOST_FACES // 2:
            raise SolverError(f"{surface.name} has more than {MOST_FACES // 2:,} faces; use the heat method.")
        x = surface.vertices
        low, high = x.min(axis=0), x.max(axis=0)
        self.unit = 2.0 ** np.floor(np.log2(max(np.abs(low).max(), np.abs(high).max()) or 1.0))
        vertex_order, self._face_order = _order(surface)
        number = np.empty(len(x), np.int32)
        number[vertex_order] = np.arange(len(x), dtype=np.int32)
        self._face_number = np.empty(len(surface.faces), np.int32)
        self._face_number[self._face_order] = np.arange(len(surface.faces), dtype=np.int32)
        points = np.ascontiguousarray(x[vertex_order] / self.unit)
        corners = np.ascontiguousarray(number[surface.faces[self._face_order]])
        self._proper: ProperFaces | None = None
        self.number = number
        if degenerate := self._build(points, corners):
            self._proper = proper = ProperFaces(points, corners, self.sides, degenerate)
            self.number = proper.same[number]
            self._build(proper.points, proper.faces, proper.labels)

    @property
    def has_degenerate_faces(self) -> bool:
        """True if the surface has faces that others stand for."""
        return self._proper is not None

    @cached_property
    def has_two_faces_at_edges(self) -> bool:
        """True if no edge has three faces or more."""
        across = self.sides["twin"] >> 1
        return bool((across[across] == np.arange(len(across)))[across >= 0].all())

    def _build(self, points: FloatArray, corners: AnyArray, labels: AnyArray | None = None) -> int:
        """Returns how many faces are degenerate."""
        n, m = len(points), len(corners)
        self.vertices, self.faces, self.points = n, m, points
        side = np.empty(3 * m, kernel.SIDE)
        first, corner, kind = np.empty(n + 1, np.int32), np.empty(3 * m, np.int32), np.empty(n, np.uint8)
        self.arrays = side, first, corner, kind
        self.structure = kernel.Mesh(n, m, *(kernel.at(array) for array in self.arrays))
        work = np.empty((2, 3 * m), np.int32)
        self.sides, self.first, self.corner = side, first, corner
        degenerate = kernel.library().bih_geodesic_mesh(
            ctypes.byref(self.structure),
            points,
            corners,
            None if labels is None else kernel.at(labels),
            work[0],
            work[1],
            np.empty(n + 1, np.int32),
        )
        return int(degenerate)

    def at_vertices(self, ids: IntArray) -> Places:
        """Vertices (k,) of the surface."""
        corner = self.corner[self.first[self.number[ids]]]
        weights = np.eye(3)[corner % 3]
        return Places(np.arange(len(ids)), corner // 3, weights, weights)

    def at_pieces(self, pieces: Pieces) -> Places:
        """Return pieces (k,) of the surface; one that crosses a face that was divided becomes several, a point one."""
        faces = self._face_number[pieces.faces]
        rows = np.arange(len(faces))
        begin, end = np.array(pieces.start, np.float64), np.array(pieces.stop, np.float64)
        proper = self._proper
        changed = np.zeros(len(faces), bool) if proper is None else proper.is_changed(faces)
        if proper is None or not changed.any():
            return Places(rows, faces, begin, end)
        found = [
            (row, face, *ends)
            for row in rows.tolist()
            for face, *ends in (
                proper.pieces(int(faces[row]), begin[row], end[row])
                if changed[row]
                else [(faces[row], begin[row], end[row])]
            )
        ]
        numbers, parts, begins, ends = (np.array(column) for column in zip(*found, strict=True))
        return Places(numbers, parts.astype(np.int32), begins, ends)

    def outside(self, faces: AnyArray, begins: FloatArray, ends: FloatArray) -> tuple[IntArray, FloatArray, FloatArray]:
        """Faces (p,) of the surface for the kernel's, with the weights (p, 3) there."""
        faces = faces.astype(np.int64)
        if self._proper is not None:
            faces, begins, ends = self._proper.outside(faces, begins, ends)
        return self._face_order[faces], begins, ends


_known: WeakKeyDictionary[Surface, UnfoldingMesh] = WeakKeyDictionary()
_turn: Memo[None, None] = Memo()


def unfolding_mesh(surface: Surface) -> UnfoldingMesh:
    """Return the mesh of a surface, made when first asked for; SolverError for too many faces."""
    with _turn.lock:
        if surface not in _known:
            _known[surface] = UnfoldingMesh(surface)
        return _known[surface]


def _order(surface: Surface) -> tuple[IntArray, IntArray]:
    """Return the orders (n,) of vertices and (m,) of faces in the kernel."""
    x, faces = surface.vertices, surface.faces
    if len(x) < RENUMBERED_FROM:
        return np.arange(len(x)), np.arange(len(faces))
    vertex_order = np.argsort(_morton(x), kind="stable")
    number = np.empty(len(x), np.int64)
    number[vertex_order] = np.arange(len(x))
    return vertex_order, np.argsort(number[faces].min(axis=1), kind="stable")


def _morton(x: FloatArray) -> AnyArray:
    """Return (n,) numbers of points along Morton's curve."""
    low, size = x.min(axis=0), np.ptp(x, axis=0).max() or 1.0
    cells = np.minimum((x - low) / size * 2**20, 2**20 - 1).astype(np.uint64)
    code = np.zeros(len(x), np.uint64)
    for bit in range(20):
        for axis in range(3):
            code |= (cells[:, axis] >> np.uint64(bit) & np.uint64(1)) << np.uint64(3 * bit + axis)
    return code
