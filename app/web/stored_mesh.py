"""A mesh as a page holds it: rounded, renumbered and packed; `viewer/unpack.js` unpacks it."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import reverse_cuthill_mckee

from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.degenerate_faces import DegenerateFaces
from bihdist_core.errors import ParameterError
from bihdist_core.operators import vertex_areas
from bihdist_core.surface import FLAT_RATIO, Surface

from ..scene.creases import face_normals
from ..scene.winding import winding

FLOAT32 = "float32"
PRECISIONS = ("24", FLOAT32)
"""Bits of a coordinate: 24, as a fraction of the largest side of the bounding box, or a single-precision float."""

NEAR, NEAR_BY_HEIGHT = 1e-5, 1e-9
"""A page computes small distances again as pairs: below the first fraction of the maximum or, on a mesh with thin
faces, below the second over the height of the thinnest face. For larger ones, rounded coordinates matter more."""


@dataclass(frozen=True, eq=False)
class StoredMesh:
    """The vertices of faces, numbered so that neighbours are close, and the faces, counterclockwise seen from outside.

    Attributes
    ----------
    surface : Surface
        With rounded vertices (n, 3) and faces (m, 3), both ordered by component.
    ids : (n,) int ndarray
        The vertex ids of the file.
    precision : str
        Of `PRECISIONS`.
    low, step : (3,) ndarray, float
        The origin and the step of rounded coordinates.
    first_vertices, first_faces : (c + 1,) int ndarray
        Where each component begins, then n and m.
    has_backs : bool
        Whether the inside of the surface can be seen.
    has_inside : bool
        Whether it can be seen once the surface is cut.
    """

    surface: Surface
    ids: IntArray
    precision: str
    low: FloatArray
    step: float
    first_vertices: IntArray
    first_faces: IntArray
    has_backs: bool
    has_inside: bool

    @classmethod
    def of(cls, surface: Surface, precision: str = "24") -> StoredMesh:
        """Round and renumber a surface; raise ParameterError for an unknown precision."""
        if precision not in PRECISIONS:
            raise ParameterError(f"Coordinates are kept in one of {', '.join(PRECISIONS)}, not {precision!r}.")
        n, component = len(surface.vertices), surface.component_of_vertex
        order = _order(surface.faces, n)
        order = order[component[order] >= 0]
        order = order[np.argsort(component[order], kind="stable")]
        place = np.empty(n, np.int64)
        place[order] = np.arange(len(order))
        wound = winding(surface, face_normals(surface.vertices, surface.faces))
        faces = _sorted(place[wound.faces(surface.faces)])
        low, x = surface.vertices[order].min(axis=0), surface.vertices[order]
        step = float((x - low).max() / (2**24 - 1)) if precision == "24" else 0.0
        stored = x.astype(np.float32).astype(np.float64) if precision == FLOAT32 else low + _steps(x, low, step) * step
        counts = np.bincount(component[order])
        face_counts = np.bincount(component[order][faces[:, 0]])
        first_vertices, first_faces = (np.concatenate([[0], np.cumsum(c)]) for c in (counts, face_counts))
        kept = Surface(stored, faces, name=surface.name)
        return cls(kept, order, precision, low, step, first_vertices, first_faces, wound.has_backs, wound.has_inside)

    @cached_property
    def packed(self) -> bytes:
        """The mesh as bytes, mostly differences in as few bytes as they need."""
        s, exact = self.surface, self.precision == FLOAT32
        head = [len(s.vertices), len(s.faces), len(self.first_vertices) - 1, int(exact)]
        f = s.faces
        ints = [
            np.array(head),
            np.diff(self.first_vertices, prepend=0),
            np.diff(self.first_faces, prepend=0),
            np.diff(f[:, 0], prepend=0),
            (f[:, 1:] - f[:, :1]).ravel(),
            np.diff(self.ids, prepend=0),
        ]
        words = s.vertices.astype("<f4").view("<u4") if exact else self._differences.astype("<u4")
        planes = words.view(np.uint8).reshape(-1, 4).T.tobytes()
        return np.array([*self.low, self.step], "<f8").tobytes() + varints(np.concatenate(ints)) + planes

    @property
    def _differences(self) -> IntArray:
        """Steps (n, 3) from the mean of the neighbours with smaller numbers, the sign in the lowest bit.

        A neighbour counts once for each face.
        """
        f, n = self.surface.faces, len(self.ids)
        steps = _steps(self.surface.vertices, self.low, self.step)
        ends = np.stack([f.ravel(), np.roll(f, -1, axis=1).ravel()])
        lesser = sp.csr_matrix((np.ones(ends.shape[1], np.int64), (ends.max(axis=0), ends.min(axis=0))), (n, n))
        count = np.asarray(lesser.sum(axis=1))
        difference = steps - np.where(count > 0, (2 * (lesser @ steps) + count) // np.maximum(2 * count, 1), 0)
        signed: IntArray = (difference << 1) ^ (difference >> 63)
        return signed

    @property
    def near(self) -> list[float]:
        """For each component, the fraction of the maximum below which biharmonic distances are computed as pairs."""
        thinnest = np.minimum.reduceat(self.surface.face_heights, self.first_faces[:-1])
        shares: list[float] = np.maximum(NEAR, NEAR_BY_HEIGHT / np.maximum(thinnest, FLAT_RATIO)).tolist()
        return shares

    def corrections(self, areas: str) -> dict[str, list[list[float]]]:
        """Return what a page does not compute: weights of degenerate faces, and the vertex areas beside them."""
        s = self.surface
        faces = s.degenerate_faces
        weights, of_vertex, beside = DegenerateFaces.of(s).weights(), vertex_areas(s, areas), np.unique(s.faces[faces])
        return {
            "weights": [[int(f), *map(float, w)] for f, w in zip(faces, weights.T, strict=True)],
            "areas": [[int(v), float(of_vertex[v])] for v in beside],
        }


def deflated(content: bytes) -> bytes:
    """Compress bytes to a raw deflate stream, as the viewer inflates it."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return packer.compress(content) + packer.flush()


def varints(numbers: IntArray) -> bytes:
    """Pack whole numbers (k,), 7 bits a byte, low bits first, with the sign in the lowest bit."""
    z = ((numbers << 1) ^ (numbers >> 63)).astype(np.uint64)
    count = np.ones(len(z), np.int64)
    for bits in range(7, 63, 7):
        count += z >> np.uint64(bits) > 0
    packed, begin = np.zeros(count.sum(), np.uint8), np.cumsum(count) - count
    for k in range(int(count.max(initial=0))):
        has = count > k
        more = np.where(count[has] > k + 1, 128, 0)
        packed[begin[has] + k] = (z[has] >> np.uint64(7 * k)).astype(np.uint8) & 127 | more
    return packed.tobytes()


def _steps(x: FloatArray, low: FloatArray, step: float) -> IntArray:
    return np.rint((x - low) / (step or 1.0)).astype(np.int64)


def _order(faces: IntArray, n: int) -> IntArray:
    """Return the vertices (n,) in an order in which neighbours are close."""
    i, j = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    ends = np.concatenate([i, j]), np.concatenate([j, i])
    graph = sp.csr_matrix((np.ones(len(ends[0]), np.int8), ends), (n, n))
    order: IntArray = reverse_cuthill_mckee(graph, symmetric_mode=True).astype(np.int64)
    return order


def _sorted(faces: AnyArray) -> IntArray:
    """Return faces (m, 3), each from its smallest corner, in the order of these."""
    first = faces.argmin(axis=1)
    turned = np.stack([faces[np.arange(len(faces)), (first + k) % 3] for k in range(3)], axis=1)
    return turned[np.lexsort(turned.T[::-1])]
