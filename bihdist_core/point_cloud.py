"""Points of a scan, without faces: a surface whose Laplacian is found from the neighbours of each point."""

from __future__ import annotations

from functools import cached_property
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree
from scipy.spatial import cKDTree

from .arrays import FloatArray, IntArray
from .coincident_points import merged, merged_within
from .counts import counted
from .errors import MeshError, ParameterError
from .intrinsic import kernel_for, tufted
from .mesh_arrays import check_size, checked_vertices
from .nodes import Matrices, Nodes, nodes_of, spread
from .solver.worker_threads import side_by_side
from .surface import Surface

NEIGHBOURS = 30
"""Of each point, by which the surface about it is found, as Sharp and Crane have it."""
PLANE = 13
"""Nearest points, with itself, whose plane tells the normal of a point."""
FEWEST = 4
TOGETHER = 4_000
"""Points whose neighbours are found by one thread at a time."""


class PointCloud(Nodes):
    """Points without faces, such as a scan, opened as a surface.

    Parameters
    ----------
    points : (n, 3) array_like
        Coordinates; those of a point without any are NaN.
    name : str
        Name for messages.
    left_out : (k,) array_like of int, optional
        Points that are not of the surface, and have no distance.
    facts : sequence of str
        How a file was read.

    Attributes
    ----------
    matrices : tuple of (n, n) csr_matrix and (n,) ndarray
        Stiffness matrix and areas.

    Raises
    ------
    MeshError
        For wrong shapes, fewer than 4 points, points in a line, coordinates that are infinite, and without the
        compiled kernel.

    Notes
    -----
    The Laplacian is that of Sharp and Crane (A Laplacian for Nonmanifold Triangle Meshes, 2020): Delaunay triangles
    about each point in the plane of its 30 neighbours, all together as a non-manifold mesh with a tufted cover, a third
    of it as each is there about three points.  Unlike theirs the cover has three layers, of triangles about at least
    one, two and three of their corners: flips between triangles in one place would make distances of random points
    some 5 % too large.  All distances but the geodesic one are as exact as on meshes.  Points that repeat another have
    no distance (NaN), as one place has one row; `merged` takes them out.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = bihdist.PointCloud(pyvista.Icosphere(nsub=3).points, "sphere")
    >>> sphere, round(sphere.area, 1)
    (PointCloud(sphere: 642 points), 12.5)
    >>> round(float(bihdist.BiharmonicDistance(sphere).from_source(0).max()), 2)
    0.51
    """

    nouns: ClassVar[tuple[str, str]] = ("point", "points")

    matrices: Matrices
    _triangles: IntArray

    def __init__(
        self,
        points: npt.ArrayLike,
        name: str = "points",
        left_out: npt.ArrayLike = (),
        facts: tuple[str, ...] = (),
    ) -> None:
        x = checked_vertices(points, name)
        used = np.logical_not(np.isnan(x).any(axis=1))
        told = [counted(int((~used).sum()), "point without coordinates", "points without coordinates")]
        used[np.asarray(left_out, np.int64)] = False
        ids = np.flatnonzero(used)
        if len(ids):
            x[np.isnan(x).any(axis=1)] = x[ids[0]]
            ids = ids[np.unique(merged(x[ids])[1], return_index=True)[1]]
        told += [counted(int(used.sum()) - len(ids), "point that repeats another", "points that repeat others")]
        if len(ids) < FEWEST:
            raise MeshError(
                f"{name} has {counted(len(ids), 'point')} in different places; a point cloud needs {FEWEST}."
            )
        if not np.isfinite(x).all():
            k, axis = np.argwhere(~np.isfinite(x))[0]
            raise MeshError(f"{name}: point {k} has the coordinate {x[k, axis]:g}; all must be finite numbers.")
        check_size(x[ids], np.arange(len(ids))[None], name)
        layers = _layers(x[ids], name)
        nodes, matrices = _measured(x[ids], layers, name)
        label = np.full(len(x), -1)
        label[ids] = nodes.component_of_vertex
        said = tuple(f"{each} left out (NaN)" for each in told if not each.startswith("0 "))
        super().__init__(x, name=name, facts=(*facts, *said), component_of_vertex=label)
        object.__setattr__(self, "matrices", spread(matrices, ids, len(x)))
        object.__setattr__(self, "_triangles", ids[layers[0]])

    def __getstate__(self) -> dict[str, object]:
        return {**super().__getstate__(), "matrices": self.matrices, "_triangles": self._triangles}

    def __repr__(self) -> str:
        return f"PointCloud({self.name}: {len(self.vertices):,} points)"

    def merged(self, tolerance: float = 0.0) -> tuple[PointCloud, IntArray]:
        if not (np.isfinite(tolerance) and tolerance >= 0):
            raise ParameterError(f"A tolerance is a length, 0 or more, not {tolerance!r}.")
        kept, ids = merged_within(self.vertices, tolerance)
        if len(kept) == len(ids):
            return self, ids
        fact = f"{counted(len(ids) - len(kept), 'point')} merged with others within {tolerance:g}"
        return PointCloud(self.vertices[kept], self.name, facts=(fact,)), ids

    def without(self, vertices: npt.ArrayLike) -> PointCloud:
        gone = self._chosen(vertices)
        if not (gone & (self.component_of_vertex >= 0)).any():
            return self
        fact = f"{counted(int(gone.sum()), 'point')} cut out"
        left_out = np.flatnonzero(gone | (self.component_of_vertex < 0))
        return PointCloud(self.vertices, self.name, left_out, (*self.facts, fact))

    def _without_distances(self, vertex: int) -> str:
        return f"point {vertex} repeats another or was left out, so no distance is defined from it."

    @cached_property
    def _sides(self) -> tuple[IntArray, IntArray]:
        """The neighbours (e, 2) that the stiffness matrix joins, as edges, and no sides of faces."""
        upper = sp.triu(self.matrices[0], 1).tocoo()
        joined = np.abs(upper.data) > 1e-9 * np.abs(upper.data).max()
        return np.stack([upper.row[joined], upper.col[joined]], axis=1).astype(np.int64), np.empty(0, np.int64)

    @cached_property
    def shape(self) -> Surface:
        """The Delaunay triangles (m, 3) about all points, counter-clockwise seen from outside."""
        faces = self._triangles.copy()
        a, b, c = (self.vertices[faces[:, k]] for k in range(3))
        inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), self.normals[faces].sum(axis=1)) < 0
        faces[inward] = faces[inward][:, [0, 2, 1]]
        return Surface(self.vertices, faces, self.name)

    @cached_property
    def normals(self) -> FloatArray:
        """Unit normals (n, 3) of the planes of each point's nearest ones, which point outwards; 0 for one left out."""
        used = np.flatnonzero(self.component_of_vertex >= 0)
        x, normals = self.vertices[used], np.zeros_like(self.vertices)
        near = cKDTree(x).query(x, min(PLANE, len(x)))[1]
        local = x[near] - x[near].mean(axis=1, keepdims=True)
        found = np.linalg.eigh(np.einsum("nki,nkj->nij", local, local))[1][:, :, 0]
        normals[used] = found
        # Along a tree of pairs of neighbours whose planes are most alike, each as its parent (Hoppe et al. 1992).
        i, j = self.edges.T
        alike = np.abs(np.einsum("ij,ij->i", normals[i], normals[j]))
        tree = minimum_spanning_tree(sp.coo_matrix((1 + 1e-6 - alike, (i, j)), shape=(len(normals),) * 2).tocsr())
        for component in range(self.n_components):
            ids = np.flatnonzero(self.component_of_vertex == component)
            order, parent = breadth_first_order(tree, ids[0], directed=False)
            turn = np.ones(len(normals))
            child = order[1:]
            flips = np.sign(np.einsum("ij,ij->i", normals[child], normals[parent[child]]))
            for k, flip in zip(child.tolist(), flips.tolist(), strict=True):
                turn[k] = flip * turn[parent[k]]
            # What is outermost points outwards.
            out = self.vertices[ids] - self.vertices[ids].mean(axis=0)
            total = np.einsum("ij,ij->", out, normals[ids] * turn[ids, None])
            normals[ids] *= turn[ids, None] * (-1 if total < 0 else 1)
        return normals

    @property
    def area(self) -> float:
        return float(self.matrices[1].sum())


def _measured(points: FloatArray, layers: list[IntArray], name: str) -> tuple[Nodes, Matrices]:
    """Return the nodes and the matrices of different points (n, 3) with triangles in layers."""
    found = side_by_side(lambda layer: tufted(Surface(points, layer, name)), layers)
    stiffness, masses = (sum(each) / 3 for each in zip(*found, strict=True))
    return nodes_of(stiffness, masses, points, name)


def _layers(points: FloatArray, name: str) -> list[IntArray]:
    """Return the Delaunay triangles (t, 3) about each point in the plane of its neighbours, each once: those about one
    of their corners at least, about two, and about three."""
    kernel, tree, n = kernel_for(name), cKDTree(points), len(points)
    k = min(NEIGHBOURS + 1, n)

    def star(first: int) -> IntArray:
        end = min(first + TOGETHER, n)
        near = tree.query(points[first:end], k)[1]
        size, star = np.empty(end - first, np.int32), np.empty((end - first, k, 2), np.int32)
        kernel.bih_stars(first, end, k, points, near, size, star)
        return np.column_stack([np.repeat(np.arange(first, end), size), star[np.arange(k) < size[:, None]]])

    triangles = np.sort(np.concatenate(side_by_side(star, range(0, n, TOGETHER))), axis=1)
    if not np.bincount(triangles.ravel(), minlength=n).all():
        raise MeshError(f"{name}: no surface is found through its points; they may be in a line.")
    triangles = triangles[np.lexsort(triangles.T)]
    first = np.flatnonzero(np.append(True, (triangles[1:] != triangles[:-1]).any(axis=1)))
    times = np.diff(first, append=len(triangles))
    return [triangles[first[times > k]] for k in range(times.max())]
