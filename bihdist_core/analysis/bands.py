"""The part of a surface where a field lies between two values, cut out exactly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..scalars import real_number
from ..surface import Surface, with_faces
from .clipping import clipped


@dataclass(frozen=True, eq=False)
class Band:
    """The part of a surface where a field, linear on each face, lies between two values.

    Attributes
    ----------
    surface : Surface
        The part, as a mesh of its own with v vertices and m faces.
    ends : (v, 2) int64 ndarray
        Edge a, b of the whole surface on which each vertex of the part lies; a vertex of the whole surface twice.
    parameters : (v,) float64 ndarray
        The t of its position (1 - t) x_a + t x_b; 0 at vertices of the whole surface.
    parents : (m,) int64 ndarray
        The face of the whole surface that each face is part of.
    vertices : (k,) int64 ndarray
        Vertices of the whole surface in the band.
    faces : (q,) int64 ndarray
        Faces of the whole surface that are entirely in the band.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> strip = bihdist.band(plane, plane.points[:, 0], -0.1, 0.3)
    >>> strip.surface, round(strip.area, 6)
    (Surface(PolyData: 28 vertices, 32 faces), 0.4)
    """

    surface: Surface
    ends: IntArray
    parameters: FloatArray
    parents: IntArray
    vertices: IntArray
    faces: IntArray

    @property
    def area(self) -> float:
        """Exact area of the part, in the mesh's unit squared.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> strip = bihdist.band(plane, plane.points[:, 0], -0.1, 0.3)
        >>> round(strip.area, 6)  # of the unit square
        0.4
        """
        return float(self.surface.face_areas.sum())

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """Interpolate a field at the vertices of the part.

        Parameters
        ----------
        field : (n,) or (n, d) array_like
            Values at the vertices of the whole surface, linear on its faces.

        Returns
        -------
        (v,) or (v, d) ndarray
            Values at the vertices of the part, on whose faces they are linear, too.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> strip = bihdist.band(plane, plane.points[:, 0], 0.1, 0.3)
        >>> ends = strip.along(plane.points[:, 0])
        >>> ends.min().round(6).item(), ends.max().round(6).item()
        (0.1, 0.3)
        """
        at = np.asarray(field)
        t = self.parameters.reshape(-1, *(1,) * (at.ndim - 1))
        return np.where(t == 0, at[self.ends[:, 0]], (1 - t) * at[self.ends[:, 0]] + t * at[self.ends[:, 1]])


def band(surface: MeshLike, field: npt.ArrayLike, low: float = -np.inf, high: float = np.inf) -> Band:
    """Cut out the part of a surface where a field lies between two values.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Real numbers at the vertices. Faces with a corner that is not finite are left out.
    low, high : float
        The two values; either may be infinite.

    Returns
    -------
    Band
        The part, as a mesh of its own.

    Raises
    ------
    ParameterError
        If the field is not (n,) numbers, if the values are NaN or not in order, or if nothing lies between them.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> distance = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> near = bihdist.band(sphere, distance, high=1.0)
    >>> # of a cap of the unit sphere: 2 pi (1 - cos 1) = 2.89
    >>> print(f"{near.area:.2f}")
    2.88
    """
    surface = with_faces(surface, "bands")
    f = surface.check_field(field)
    if not real_number(low, "The lower value") < real_number(high, "The higher value"):
        raise ParameterError(f"A region lies between two values, the smaller first, not {low:g} and {high:g}.")
    finite = np.isfinite(f[surface.faces]).all(axis=1)
    inside = finite & ((f >= low) & (f <= high))[surface.faces].all(axis=1)
    corner = f[surface.faces]
    touched = finite & ~inside & (corner.max(axis=1) > low) & (corner.min(axis=1) < high)
    cut = np.flatnonzero(touched)
    whole = surface.faces[inside]
    ends, parameters, pieces, parents = _pieces(surface.faces[cut], f, low, high, cut)
    # Vertices of the whole surface first, then the crossings, each once.
    n = len(surface.vertices)
    key, index = np.unique(np.concatenate([whole.ravel(), pieces]), return_inverse=True)
    if not len(key):
        raise ParameterError(f"The field is nowhere between {low:g} and {high:g} on {surface.name}.")
    old, crossed = key[key < n], key[key >= n] - n
    ends = np.concatenate([np.stack([old, old], 1), ends[crossed]])
    t = np.concatenate([np.zeros(len(old)), parameters[crossed]])
    x = surface.vertices
    points = (1 - t)[:, None] * x[ends[:, 0]] + t[:, None] * x[ends[:, 1]]
    faces = index.reshape(-1, 3)
    vertices = np.flatnonzero((f >= low) & (f <= high) & (surface.component_of_vertex >= 0))
    return Band(
        Surface(points, faces, surface.name),
        ends,
        t,
        np.concatenate([np.flatnonzero(inside), parents]),
        vertices,
        np.flatnonzero(inside),
    )


def _pieces(
    corners: IntArray, f: FloatArray, low: float, high: float, cut: IntArray
) -> tuple[IntArray, FloatArray, IntArray, IntArray]:
    """Return the faces that are cut: ends (c, 2) and parameters (c,) of the crossings.

    (3 m,) corners of the pieces, of which those from n on are crossings; (m,) the face each is part of.
    """
    n, at = len(f), f[corners]
    polygons, sizes = np.broadcast_to(np.eye(3), (len(cut), 3, 3)), np.full(len(cut), 3)
    for values in (at - low, high - at):
        if np.isfinite(values).all():
            polygons, sizes = clipped(polygons, sizes, values)
    present = np.arange(polygons.shape[1]) < sizes[:, None]
    face, slot = np.nonzero(present)
    weights, of_face = polygons[face, slot], corners[face]
    is_corner = (weights > 0).sum(axis=1) == 1
    # A crossing is known by its edge and its value: the level lines of a linear function do not meet.
    out = weights.argmin(axis=1)
    a, b = (of_face[np.arange(len(face)), (out + s) % 3] for s in (1, 2))
    i, j = np.minimum(a, b), np.maximum(a, b)
    value = np.einsum("kc,kc->k", weights, at[face])
    upper = (np.abs(value - high) < np.abs(value - low)) if np.isfinite([low, high]).all() else np.isfinite(high)
    code = (i * n + j) * 2 + upper
    key, index = np.unique(np.where(is_corner, -1, code), return_inverse=True)
    edges, top = np.divmod(key, 2)
    ends = np.stack(np.divmod(np.maximum(edges, 0), n), 1)
    level = np.where(top == 1, high, low)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.clip((level - f[ends[:, 0]]) / (f[ends[:, 1]] - f[ends[:, 0]]), 0, 1)
    number = np.full(polygons.shape[:2], -1)
    number[face, slot] = np.where(is_corner, of_face[np.arange(len(face)), weights.argmax(axis=1)], n + index)
    fans = []
    parents = []
    for k in range(1, polygons.shape[1] - 1):
        there = np.flatnonzero(k + 1 < sizes)
        fans.append(number[there][:, [0, k, k + 1]])
        parents.append(cut[there])
    if not fans:
        return ends, t, np.empty(0, np.int64), np.empty(0, np.int64)
    return ends, t, np.concatenate(fans).ravel(), np.concatenate(parents)
