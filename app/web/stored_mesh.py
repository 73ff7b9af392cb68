"""A mesh as a page holds it: rounded, renumbered and packed; `viewer/unpack.js` unpacks it."""

from __future__ import annotations

import zlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
from scipy.sparse.csgraph import reverse_cuthill_mckee

from bihdist_core import Laplacian, PointCloud
from bihdist_core.arrays import AnyArray, FloatArray, IntArray
from bihdist_core.degenerate_faces import DegenerateFaces
from bihdist_core.errors import ParameterError
from bihdist_core.nodes import Nodes
from bihdist_core.operators import vertex_areas
from bihdist_core.surface import FLAT_RATIO, Surface

from ..scene.creases import face_normals
from ..scene.winding import winding
from .stored_values import StoredField

FLOAT32 = "float32"
PRECISIONS = ("24", FLOAT32)
"""Bits of a coordinate: 24, as a fraction of the largest side of the bounding box, or a single-precision float."""

NEAR, NEAR_BY_HEIGHT = 1e-5, 1e-9
"""A page computes small distances again as pairs: below the first fraction of the maximum or, on a mesh with thin
faces, below the second over the height of the thinnest face. For larger ones, rounded coordinates matter more."""


@dataclass(frozen=True, eq=False)
class StoredMatrices:
    """Stiffness matrix and areas that do not follow from the faces: of points, of tetrahedra, of another operator.

    Attributes
    ----------
    start, index : (n + 1,) and (e,) int ndarray
        The entries of the stiffness matrix above its diagonal, by rows.
    weights, areas : StoredField
        These entries (e,) without their sign, and the areas (n,).
    """

    start: IntArray
    index: IntArray
    weights: StoredField
    areas: StoredField

    @classmethod
    def of(cls, laplacian: Laplacian, ids: IntArray) -> StoredMatrices:
        """Round the rows `ids` (n,) of a Laplacian's matrices."""
        upper = sp.triu(laplacian.stiffness[ids][:, ids], 1, format="csr")
        upper.eliminate_zeros()
        upper.sort_indices()
        weights = StoredField.of(-upper.data, np.arange(upper.nnz))
        start, index = (each.astype(np.int64) for each in (upper.indptr, upper.indices))
        return cls(start, index, weights, StoredField.of(laplacian.areas, ids))

    @property
    def ends(self) -> IntArray:
        """The row and the column (2, e) of each entry."""
        return np.stack([np.repeat(np.arange(len(self.start) - 1), np.diff(self.start)), self.index])

    @property
    def stiffness(self) -> sp.csr_matrix:
        """The stiffness matrix (n, n)."""
        n = len(self.start) - 1
        upper = sp.csr_matrix((self.weights.values, self.index, self.start), (n, n))
        both = upper + upper.T
        return sp.csr_matrix(sp.diags_array(np.asarray(both.sum(axis=1)).ravel()) - both)


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
    matrices : StoredMatrices or None
        What does not follow from the faces.
    normals : (n, 3) int8 ndarray or None
        Of points without faces, 127 times as long as 1.
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
    matrices: StoredMatrices | None = None
    normals: npt.NDArray[np.int8] | None = None

    @classmethod
    def of(cls, surface: Surface, precision: str = "24", laplacian: Laplacian | None = None) -> StoredMesh:
        """Round and renumber a surface; raise ParameterError for an unknown precision.

        A Laplacian that does not follow from the faces of the surface is kept with it.
        """
        if precision not in PRECISIONS:
            raise ParameterError(f"Coordinates are kept in one of {', '.join(PRECISIONS)}, not {precision!r}.")
        n = len(surface.vertices)
        component = (laplacian.surface if laplacian else surface).component_of_vertex
        order = _order(laplacian.stiffness if laplacian else _graph(surface.faces, n))
        order = order[component[order] >= 0]
        order = order[np.argsort(component[order], kind="stable")]
        place = np.empty(n, np.int64)
        place[order] = np.arange(len(order))
        faces, insides = surface.faces, (False, False)
        if len(faces):
            wound = winding(surface, face_normals(surface.vertices, faces))
            faces, insides = _sorted(place[wound.faces(faces)]), (wound.has_backs, wound.has_inside)
        low, x = surface.vertices[order].min(axis=0), surface.vertices[order]
        step = float((x - low).max() / (2**24 - 1)) if precision == "24" else 0.0
        stored = x.astype(np.float32).astype(np.float64) if precision == FLOAT32 else low + _steps(x, low, step) * step
        counts = np.bincount(component[order])
        face_counts = np.bincount(component[order][faces[:, 0]], minlength=len(counts))
        first_vertices, first_faces = (np.concatenate([[0], np.cumsum(c)]) for c in (counts, face_counts))
        nodes = Nodes(stored, name=surface.name, component_of_vertex=component[order])
        kept = Surface(stored, faces, name=surface.name) if len(faces) else nodes
        matrices = StoredMatrices.of(laplacian, order) if laplacian else None
        normals = None
        if isinstance(surface, PointCloud):
            normals = np.rint(127 * surface.normals[order]).astype(np.int8)
        return cls(
            kept, order, precision, low, step, first_vertices, first_faces, *insides, matrices=matrices, normals=normals
        )

    def laplacian(self, areas: str) -> Laplacian:
        """Return the Laplacian by which a page computes."""
        if self.matrices is None:
            return Laplacian(self.surface, areas)
        matrices, x = (self.matrices.stiffness, self.matrices.areas.values), self.surface.vertices
        return Laplacian.from_matrices(*matrices, x, self.surface.name)

    @cached_property
    def packed(self) -> bytes:
        """The mesh as bytes, mostly differences in as few bytes as they need."""
        s, exact = self.surface, self.precision == FLOAT32
        f, entries = s.faces, self.matrices
        head = [len(s.vertices), len(f), len(self.first_vertices) - 1, int(exact), len(entries.index) if entries else 0]
        ints = [
            np.array(head),
            np.diff(self.first_vertices, prepend=0),
            np.diff(self.first_faces, prepend=0),
            np.diff(f[:, 0], prepend=0),
            (f[:, 1:] - f[:, :1]).ravel(),
            np.diff(self.ids, prepend=0),
            *([np.diff(entries.start), np.diff(entries.index, prepend=0)] if entries else []),
        ]
        words = s.vertices.astype("<f4").view("<u4") if exact else self._differences.astype("<u4")
        planes = words.view(np.uint8).reshape(-1, 4).T.tobytes()
        return np.array([*self.low, self.step], "<f8").tobytes() + varints(np.concatenate(ints)) + planes

    @property
    def _differences(self) -> IntArray:
        """Steps (n, 3) from the mean of the neighbours with smaller numbers, the sign in the lowest bit.

        A neighbour counts once for each face, or for its entry in the matrix.
        """
        f, n = self.surface.faces, len(self.ids)
        steps = _steps(self.surface.vertices, self.low, self.step)
        sides = np.stack([f.ravel(), np.roll(f, -1, axis=1).ravel()])
        ends = self.matrices.ends if self.matrices else sides
        lesser = sp.csr_matrix((np.ones(ends.shape[1], np.int64), (ends.max(axis=0), ends.min(axis=0))), (n, n))
        count = np.asarray(lesser.sum(axis=1))
        difference = steps - np.where(count > 0, (2 * (lesser @ steps) + count) // np.maximum(2 * count, 1), 0)
        signed: IntArray = (difference << 1) ^ (difference >> 63)
        return signed

    @property
    def near(self) -> list[float]:
        """For each component, the fraction of the maximum below which biharmonic distances are computed as pairs."""
        if self.matrices:
            return [NEAR] * (len(self.first_vertices) - 1)
        thinnest = np.minimum.reduceat(self.surface.face_heights, self.first_faces[:-1])
        shares: list[float] = np.maximum(NEAR, NEAR_BY_HEIGHT / np.maximum(thinnest, FLAT_RATIO)).tolist()
        return shares

    def corrections(self, areas: str) -> dict[str, list[list[float]]]:
        """Return what a page does not compute: weights of degenerate faces, and the vertex areas beside them."""
        if self.matrices:
            return {"weights": [], "areas": []}
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


def _graph(faces: IntArray, n: int) -> sp.csr_matrix:
    """Return a matrix (n, n) with entries where vertices are joined."""
    i, j = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    ends = np.concatenate([i, j]), np.concatenate([j, i])
    return sp.csr_matrix((np.ones(len(ends[0]), np.int8), ends), (n, n))


def _order(graph: sp.csr_matrix) -> IntArray:
    """Return the vertices (n,) in an order in which neighbours are close."""
    order: IntArray = reverse_cuthill_mckee(graph, symmetric_mode=True).astype(np.int64)
    return order


def _sorted(faces: AnyArray) -> IntArray:
    """Return faces (m, 3), each from its smallest corner, in the order of these."""
    first = faces.argmin(axis=1)
    turned = np.stack([faces[np.arange(len(faces)), (first + k) % 3] for k in range(3)], axis=1)
    return turned[np.lexsort(turned.T[::-1])]
