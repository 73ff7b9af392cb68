"""A surface cut along the boundaries of regions, each region with vertices of its own; and the files of regions."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..file_output import check_output
from ..formats.field_output import FIELD_FORMATS, write_fields
from ..mesh_like import MeshLike
from ..surface import Surface
from .places import weighted
from .regions import Regions, chunks, least_of, region_polygons, rivals_in, whole_and_mixed

CLOSE = 1e-9
"""Vertices of a region in one face whose weights differ by less are one."""


@dataclass(frozen=True, eq=False)
class RegionMesh:
    """A surface cut along the boundaries of regions, so that each face is in one of them.

    Attributes
    ----------
    surface : Surface
        The cut surface, with v vertices and m faces.
    regions : (v,) int64 ndarray
        The region of each vertex.
    parents : (m,) int64 ndarray
        The face of the whole surface that each face is part of.
    corners : (v, 3) int64 ndarray
        Vertices of a face of the whole surface that holds each vertex.
    weights : (v, 3) float64 ndarray
        The vertex's barycentric weights in that face.

    Examples
    --------
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
        """Interpolate a field at the vertices of the cut surface.

        Parameters
        ----------
        field : (n,) or (n, d) array_like
            Values at the vertices of the whole surface, linear on its faces.

        Returns
        -------
        (v,) or (v, d) ndarray
            Values at the vertices of the cut surface.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 80])
        >>> cut = bihdist.region_mesh(plane, fields)
        >>> cut.along(fields).shape
        (106, 2)
        """
        return weighted(np.asarray(field), self.corners, self.weights)


def region_mesh(surface: MeshLike, columns: npt.ArrayLike) -> RegionMesh:
    """Cut a surface along the boundaries of its Voronoi regions.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    columns : (n, k) array_like
        Fields, as of `voronoi_regions`. Faces without a value are left out.

    Returns
    -------
    RegionMesh
        The cut surface; regions have vertices of their own along their boundaries.

    Raises
    ------
    ParameterError
        For fields of another shape, or none.
    MeshError
        If no face has a value.

    Examples
    --------
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
    """Return (v,) the same number for vertices in the same place of the same region, whichever face they come from."""
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
    fractions = np.rint(np.stack([np.where(inside, at[:, 0], of_last), np.where(inside, at[:, 1], 0)]) / CLOSE)
    table = np.stack([region[some], first, second, *fractions.astype(np.int64)], 1)
    names[some] = names.max(initial=0) + 1 + np.unique(table, axis=0, return_inverse=True)[1].reshape(-1)
    return names


# ---------------------------------------------------------------------- files
LABEL_FORMATS = FIELD_FORMATS
REGION_MESH_FORMATS = (".ply", ".vtp")


def write_labels(
    path: str | os.PathLike[str], surface: MeshLike, regions: Regions, labels: Sequence[int] | None = None
) -> None:
    """Write the region of each vertex to a file, as the field `region`.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .npy, .csv, .ply, .vtp, .func.gii or .shape.gii.
    surface : MeshLike
        The mesh.
    regions : Regions
        The regions; vertices in none are NaN.
    labels : (k,) sequence of int, optional
        What to write for each region, such as the id of its pin; its number by default.

    Raises
    ------
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 8])
    >>> regions = bihdist.voronoi_regions(plane, fields)
    >>> bihdist.write_labels("regions.npy", plane, regions, labels=[5, 7])
    >>> np.load("regions.npy").tolist()
    [5.0, 5.0, 5.0, 5.0, 5.0, 7.0, 5.0, 7.0, 7.0]
    """
    write_fields(path, surface, {"region": _labelled(regions.labels, labels)})


def write_region_mesh(path: str | os.PathLike[str], mesh: RegionMesh, labels: Sequence[int] | None = None) -> None:
    """Write a mesh cut along the boundaries of regions, with the field `region` at its vertices.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .ply or .vtp.
    mesh : RegionMesh
        The cut mesh.
    labels : (k,) sequence of int, optional
        What to write for each region, such as the id of its pin; its number by default.

    Raises
    ------
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 24])
    >>> cut = bihdist.region_mesh(plane, fields)
    >>> bihdist.write_region_mesh("regions.ply", cut)
    >>> bihdist.read_surface("regions.ply").n_components
    2
    """
    check_output(path, REGION_MESH_FORMATS)
    write_fields(path, mesh.surface, {"region": _labelled(mesh.regions, labels)})


def _labelled(regions: IntArray, labels: Sequence[int] | None) -> IntArray:
    """Return (n,) the labels of regions (n,)."""
    if not (regions >= 0).any():
        return np.full(len(regions), np.nan)
    named = np.arange(int(regions.max()) + 1) if labels is None else np.asarray(labels)
    return np.where(regions >= 0, named[np.maximum(regions, 0)], np.nan)
