"""A surface cut along the boundaries of regions, each region with vertices of its own: to be drawn and written."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..mesh_like import MeshLike
from ..surface import Surface
from .places import weighted
from .regions import chunks, least_of, region_polygons, rivals_in, whole_and_mixed

CLOSE = 1e-9
"""Vertices of a region in one face whose weights differ by less are one."""


@dataclass(frozen=True, eq=False)
class RegionMesh:
    """A surface cut along the boundaries of regions, so that each face is in one of them.

    surface: the cut surface.  regions: (v,) the region of each of its vertices.  parents: (m,) face of the whole
    surface that each face is part of.  corners, weights: (v, 3) each vertex as a place in a face of the whole surface:
    the ids of three of its vertices, and weights of sum 1.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 80])
    >>> cut = bihdist.region_mesh(plane, fields)
    >>> cut.surface.n_components
    2
    >>> sorted(set(cut.regions.tolist()))
    [0, 1]
    >>> round(cut.surface.area, 6)
    1.0
    """

    surface: Surface
    regions: IntArray
    parents: IntArray
    corners: IntArray
    weights: FloatArray

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """(v,) or (v, d): values at the vertices of the cut surface, linear on the faces of the whole one.

        field: (n,) or (n, d) values at the vertices of the whole surface.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 80])
        >>> cut = bihdist.region_mesh(plane, fields)
        >>> cut.along(fields).shape
        (106, 2)
        """
        return weighted(np.asarray(field), self.corners, self.weights)


def region_mesh(surface: MeshLike, columns: npt.ArrayLike) -> RegionMesh:
    """The regions of fields (n, k) as a mesh (see `voronoi_regions`); faces without a value are left out.

    Raises ParameterError for fields of another shape, or none; MeshError where no face has a value.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> fields = bihdist.BiharmonicDistance(sphere).from_sources([0, 1, 2])
    >>> cut = bihdist.region_mesh(sphere, fields)
    >>> cut.surface.n_components, cut.regions.max().item()
    (3, 2)
    """
    surface = Surface.of(surface)
    f, labels = least_of(surface, columns)
    at_corner = labels[surface.faces]
    whole, mixed = whole_and_mixed(at_corner)
    parents = [whole]
    regions = [at_corner[whole, 0]]
    triangles = [np.broadcast_to(np.eye(3), (len(whole), 3, 3))]
    for some in chunks(mixed, f.shape[1]):
        face, mine, polygons, sizes = region_polygons(f, surface.faces[some], rivals_in(f, surface.faces[some]))
        for k in range(1, polygons.shape[1] - 1):
            there = np.flatnonzero(k + 1 < sizes)
            parents.append(some[face[there]])
            regions.append(mine[there])
            triangles.append(polygons[there][:, [0, k, k + 1]])
    parent, region, weights = np.concatenate(parents), np.concatenate(regions), np.concatenate(triangles)
    corners = np.repeat(surface.faces[parent], 3, axis=0)
    weights, region = weights.reshape(-1, 3), np.repeat(region, 3)
    names = _names(corners, weights, region, np.repeat(parent, 3))
    _, first, index = np.unique(names, return_index=True, return_inverse=True)
    corners, weights = corners[first], weights[first]
    points = weighted(surface.vertices, corners, weights)
    faces = index.reshape(-1, 3)
    # Where a boundary passes a vertex within rounding, a part may have no area.
    proper = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return RegionMesh(Surface(points, faces[proper], surface.name), region[first], parent[proper], corners, weights)


def _names(corners: IntArray, weights: FloatArray, region: IntArray, face: IntArray) -> IntArray:
    """(v,) the same number for vertices in the same place of the same region, whichever face they come from."""
    there = weights > CLOSE
    n, count = int(corners.max(initial=0)) + 1, there.sum(axis=1)
    names: IntArray = region * n + corners[np.arange(len(corners)), weights.argmax(axis=1)]
    # On a side a place is known by the side and a weight, inside by the face and two.
    some = np.flatnonzero(count > 1)
    inside, at = count[some] == 3, weights[some]
    ids = np.sort(np.where(there[some], corners[some], -1), axis=1)
    of_last = np.where(corners[some] == ids[:, 2:], at, 0).sum(axis=1)
    first = np.where(inside, face[some], ids[:, 1])
    second = np.where(inside, -1, ids[:, 2])
    shares = np.rint(np.stack([np.where(inside, at[:, 0], of_last), np.where(inside, at[:, 1], 0)]) / CLOSE)
    table = np.stack([region[some], first, second, *shares.astype(np.int64)], 1)
    names[some] = names.max(initial=0) + 1 + np.unique(table, axis=0, return_inverse=True)[1].reshape(-1)
    return names
