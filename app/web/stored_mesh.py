"""A surface as a page holds it: rounded, renumbered and packed; `viewer/unpack.js` unpacks it."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import reverse_cuthill_mckee

from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.degenerate_faces import DegenerateFaces
from bihdist_core.distances.biharmonic import NEAR, NEAR_BY_HEIGHT
from bihdist_core.errors import ParameterError
from bihdist_core.operators import vertex_areas
from bihdist_core.surface import FLAT, Surface

from ..scene.creases import face_normals
from ..scene.winding import winding

FLOAT32 = "float32"
PRECISIONS = ("24", FLOAT32)
"""How many bits of a coordinate are kept: 24, as shares of the largest side of the box, or a float's."""


@dataclass(frozen=True, eq=False)
class StoredMesh:
    """What a page knows of a surface: its vertices with faces, near in number what is near in space, and its faces,
    turned over where the window turns them: counterclockwise outside, where there is an outside.

    surface: with vertices (n, 3) as rounded and faces (m, 3), both by components; ids (n,): the surface's own numbers.
    first_vertices, first_faces (c + 1,): where each component begins, and n or m.  has_backs: an inside can be seen.
    """

    surface: Surface
    ids: IntArray
    precision: str
    low: FloatArray
    step: float
    first_vertices: IntArray
    first_faces: IntArray
    has_backs: bool

    @classmethod
    def of(cls, surface: Surface, precision: str = "24") -> StoredMesh:
        """Round and renumber a surface; ParameterError for a precision that is not one of PRECISIONS."""
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
        return cls(kept, order, precision, low, step, first_vertices, first_faces, wound.has_backs)

    @cached_property
    def packed(self) -> bytes:
        """The numbers of the mesh, mostly as differences, in as few bytes as they take."""
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
        """(n, 3) by how many steps vertices differ from the mean of their neighbours with lesser numbers, once for each
        face, with the sign in the lowest bit."""
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
        """Of each component the share of the largest distance below which biharmonic ones are computed as pairs."""
        thinnest = np.minimum.reduceat(self.surface.face_heights, self.first_faces[:-1])
        shares: list[float] = np.maximum(NEAR, NEAR_BY_HEIGHT / np.maximum(thinnest, FLAT)).tolist()
        return shares

    def corrections(self, areas: str) -> dict[str, list[list[float]]]:
        """What a page does not compute of vertex areas of that kind: weights of degenerate faces, and areas beside."""
        s = self.surface
        faces = s.degenerate_faces
        weights, of_vertex, beside = DegenerateFaces.of(s).weights(), vertex_areas(s, areas), np.unique(s.faces[faces])
        return {
            "weights": [[int(f), *map(float, w)] for f, w in zip(faces, weights.T, strict=True)],
            "areas": [[int(v), float(of_vertex[v])] for v in beside],
        }


def deflated(content: bytes) -> bytes:
    """As the viewer inflates it: raw, without a head."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return packer.compress(content) + packer.flush()


def varints(numbers: IntArray) -> bytes:
    """Whole numbers (k,), 7 bits a byte, least first, with the sign in the lowest bit."""
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
    """The vertices (n,) such that neighbours have numbers near each other."""
    i, j = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    ends = np.concatenate([i, j]), np.concatenate([j, i])
    graph = sp.csr_matrix((np.ones(len(ends[0]), np.int8), ends), (n, n))
    order: IntArray = reverse_cuthill_mckee(graph, symmetric_mode=True).astype(np.int64)
    return order


def _sorted(faces: AnyArray) -> IntArray:
    """Faces (m, 3), each from its least corner on, in the order of these."""
    first = faces.argmin(axis=1)
    turned = np.stack([faces[np.arange(len(faces)), (first + k) % 3] for k in range(3)], axis=1)
    return turned[np.lexsort(turned.T[::-1])]
