"""Meshes of tetrahedra: distances through a solid, whose boundary is what is seen of it."""

from __future__ import annotations

from functools import cached_property
from itertools import combinations
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from .arrays import FloatArray, IntArray
from .counts import counted
from .errors import MeshError, ParameterError
from .mesh_arrays import checked_tetrahedra, checked_vertices
from .nodes import Matrices, Nodes, nodes_of, spread
from .surface import Surface

SIDES = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])
"""The side opposite to each corner, counter-clockwise seen from outside."""
FLAT = 1e-12
"""A tetrahedron of less volume, in cubes of its longest edge, has none."""


class SolidBoundary(Surface):
    """The boundary of tetrahedra.

    Attributes
    ----------
    tetrahedra : (m, 4) int64 ndarray
        Vertex ids.
    """

    tetrahedra: IntArray

    def _without_distances(self, vertex: int) -> str:
        return f"vertex {vertex} is inside, and pictures take sources on the boundary only; `bihdist field` takes any."


class TetrahedralMesh(Nodes):
    """A mesh of tetrahedra, checked once and never changed.

    Parameters
    ----------
    vertices : (n, 3) array_like
        Coordinates.
    tetrahedra : (m, 4) array_like of int
        Vertex ids, in any order.
    name : str
        Name for messages.
    facts : sequence of str
        How a file was read.

    Attributes
    ----------
    tetrahedra : (m, 4) int64 ndarray
        Vertex ids, each tetrahedron so turned that its volume is positive.
    matrices : tuple of (n, n) csr_matrix and (n,) ndarray
        Stiffness matrix of linear elements, unit length, and a quarter of the volume of the tetrahedra at each vertex.

    Raises
    ------
    MeshError
        For wrong shapes, a coordinate that is not finite, a vertex id out of range, and a tetrahedron without a volume.

    Notes
    -----
    All distances but the geodesic one are then as exact as on surfaces.  Those that scale with a power p of lengths
    there scale with p - 1/2, as eigenfunctions are normalised by volume.  The boundary condition is Neumann's.

    Examples
    --------
    >>> import bihdist
    >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
    >>> solid = bihdist.TetrahedralMesh(corners, [[0, 1, 2, 3], [4, 1, 2, 3]], "solid")
    >>> solid, round(solid.volume, 3), solid.shape.n_faces
    (TetrahedralMesh(solid: 5 vertices, 2 tetrahedra), 0.5, 6)
    >>> distance = bihdist.BiharmonicDistance(solid)
    >>> distance.from_source(0).round(3).tolist(), distance.unit
    ([0.0, 0.697, 0.697, 0.697, 1.173], 'mesh units^0.5')
    """

    dimension: ClassVar[int] = 3
    nouns: ClassVar[tuple[str, str]] = Surface.nouns

    tetrahedra: IntArray
    matrices: Matrices

    def __init__(
        self,
        vertices: npt.ArrayLike,
        tetrahedra: npt.ArrayLike,
        name: str = "tetrahedra",
        facts: tuple[str, ...] = (),
    ) -> None:
        x = checked_vertices(vertices, name)
        corners = checked_tetrahedra(tetrahedra, len(x), name)
        ids = np.unique(corners)
        wrong = np.flatnonzero(~np.isfinite(x).all(axis=1))
        if len(wrong):
            raise MeshError(f"{name}: vertex {wrong[0]} is at {x[wrong[0]].tolist()}; coordinates are finite numbers.")
        corners = _turned(x, corners, name)
        nodes, matrices = nodes_of(*_matrices(x, corners, ids), x[ids], name)
        label = np.full(len(x), -1)
        label[ids] = nodes.component_of_vertex
        super().__init__(x, name=name, facts=facts, component_of_vertex=label)
        object.__setattr__(self, "tetrahedra", corners)
        object.__setattr__(self, "matrices", spread(matrices, ids, len(x)))

    def __getstate__(self) -> dict[str, object]:
        return {**super().__getstate__(), "tetrahedra": self.tetrahedra, "matrices": self.matrices}

    def __repr__(self) -> str:
        return f"TetrahedralMesh({self.name}: {len(self.vertices):,} vertices, {len(self.tetrahedra):,} tetrahedra)"

    def merged(self, tolerance: float = 0.0) -> tuple[Surface, IntArray]:
        if tolerance:
            raise ParameterError(f"{self.name}: vertices of tetrahedra are not merged.")
        return self, np.arange(len(self.vertices))

    def without(self, vertices: npt.ArrayLike) -> TetrahedralMesh:
        gone = self._chosen(vertices)
        left = self.tetrahedra[~gone[self.tetrahedra].any(axis=1)]
        if len(left) == len(self.tetrahedra):
            return self
        if not len(left):
            raise ParameterError(f"{self.name}: nothing would be left of it.")
        fact = f"{counted(len(self.tetrahedra) - len(left), 'tetrahedron', 'tetrahedra')} cut out"
        return TetrahedralMesh(self.vertices, left, self.name, (*self.facts, fact))

    def _without_distances(self, vertex: int) -> str:
        return f"vertex {vertex} belongs to no tetrahedron, so no distance is defined from it."

    @cached_property
    def _sides(self) -> tuple[IntArray, IntArray]:
        """The edges (e, 2), and no sides of faces."""
        pairs = np.sort(np.concatenate([self.tetrahedra[:, pair] for pair in combinations(range(4), 2)]), axis=1)
        return np.unique(pairs, axis=0), np.empty(0, np.int64)

    @cached_property
    def shape(self) -> SolidBoundary:
        """The boundary: the sides (k, 3) of one tetrahedron alone, with the same vertices."""
        sides = self.tetrahedra[:, SIDES].reshape(-1, 3)
        _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
        fact = f"the boundary of {counted(len(self.tetrahedra), 'tetrahedron', 'tetrahedra')}"
        boundary = SolidBoundary(self.vertices, sides[np.sort(first[count == 1])], self.name, facts=(*self.facts, fact))
        object.__setattr__(boundary, "tetrahedra", self.tetrahedra)
        return boundary

    @property
    def area(self) -> float:
        return self.shape.area

    @property
    def volume(self) -> float:
        """The sum of the volumes of the tetrahedra; unit length cubed."""
        return float(self.matrices[1].sum())


def boundary_of(surface: Surface) -> Surface:
    """Return the boundary of tetrahedra, and any other surface as it is."""
    return surface.shape if isinstance(surface, TetrahedralMesh) else surface


def _turned(x: FloatArray, corners: IntArray, name: str) -> IntArray:
    """Return tetrahedra (m, 4) so turned that their volumes are positive; MeshError for one without."""
    a, b, c = (x[corners[:, k]] - x[corners[:, 0]] for k in (1, 2, 3))
    volume = np.einsum("ij,ij->i", np.cross(a, b), c) / 6
    longest = np.max([np.einsum("ij,ij->i", e, e) for e in (a, b, c, a - b, b - c, c - a)], axis=0) ** 1.5
    flat = np.flatnonzero(np.abs(volume) <= FLAT * longest)
    if len(flat):
        at = corners[flat[0]].tolist()
        raise MeshError(f"{name}: tetrahedron {flat[0]}, of the vertices {at}, has no volume; remeshing would help.")
    turned = corners.copy()
    turned[volume < 0] = turned[volume < 0][:, [1, 0, 2, 3]]
    return turned


def _matrices(x: FloatArray, corners: IntArray, ids: IntArray) -> Matrices:
    """Return the stiffness matrix (k, k) of linear elements and the lumped volumes (k,), at the vertices `ids` (k,)."""
    n, local = len(ids), np.searchsorted(ids, corners)
    p, q, r = (x[corners[:, SIDES[:, k]]] for k in range(3))
    # A corner's gradient is the inward normal of the opposite side over three times the volume.
    normals = np.cross(q - p, r - p) / 2
    volumes = np.einsum("ij,ij->i", x[corners[:, 0]] - p[:, 0], -normals[:, 0]) / 3
    i, j = np.array(list(combinations(range(4), 2))).T
    weights = -np.einsum("tkx,tkx->tk", normals[:, i], normals[:, j]) / (9 * volumes[:, None])
    half = sp.coo_matrix((weights.ravel(), (local[:, i].ravel(), local[:, j].ravel())), shape=(n, n)).tocsr()
    both = half + half.T
    stiffness = sp.csr_matrix(sp.diags_array(np.asarray(both.sum(axis=1)).ravel()) - both)
    return stiffness, np.bincount(local.ravel(), np.repeat(volumes / 4, 4), n).astype(np.float64)
