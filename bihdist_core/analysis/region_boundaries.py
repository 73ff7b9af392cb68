"""The boundaries of regions as curves, and files of them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray, IntArray
from ..formats.curve_output import Curve, write_curves
from ..mesh_like import MeshLike
from ..surface import Surface, with_faces
from .chains import chains
from .regions import Regions


@dataclass(frozen=True, eq=False)
class Boundary:
    """A curve between two regions.

    Attributes
    ----------
    between : tuple of int and int
        The numbers of the regions, the smaller first.
    points : (k, 3) float64 ndarray
        Points in order along the curve; a closed one does not repeat its first point.
    closed : bool
        Whether the last point joins the first. Open curves end where three regions meet, or at the surface's boundary.
    corners : (k, 3) int64 ndarray
        The vertices of a face that holds each point.
    weights : (k, 3) float64 ndarray
        The point's barycentric weights in that face.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 8])
    >>> regions = bihdist.voronoi_regions(plane, fields)
    >>> boundary, = bihdist.region_boundaries(plane, regions)
    >>> boundary.between, boundary.closed, round(boundary.length, 6)
    ((0, 1), False, 1.0)
    """

    between: tuple[int, int]
    points: FloatArray
    closed: bool
    corners: IntArray
    weights: FloatArray

    @property
    def length(self) -> float:
        """Length of the curve, in the mesh's unit.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> fields = bihdist.GeodesicDistance(plane).from_sources([0, 8])
        >>> regions = bihdist.voronoi_regions(plane, fields)
        >>> boundary, = bihdist.region_boundaries(plane, regions)
        >>> round(boundary.length, 6)  # between two corners of the unit square
        1.0
        """
        points = np.concatenate([self.points, self.points[:1]]) if self.closed else self.points
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def region_boundaries(surface: MeshLike, regions: Regions) -> list[Boundary]:
    """Join the boundary segments of regions into curves.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    regions : Regions
        The result of `voronoi_regions` on this surface.

    Returns
    -------
    list of Boundary
        Ordered by the regions that they divide.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> fields = bihdist.BiharmonicDistance(sphere).from_sources([0, 1, 2])
    >>> regions = bihdist.voronoi_regions(sphere, fields)
    >>> boundaries = bihdist.region_boundaries(sphere, regions)
    >>> [(boundary.between, boundary.closed) for boundary in boundaries]
    [((0, 1), False), ((0, 2), False), ((1, 2), False)]
    """
    surface = with_faces(surface, "boundaries of regions")
    if not len(regions.faces):
        return []
    ends = _named_ends(surface, regions)
    points, weights = regions.segments.reshape(-1, 3), regions.weights.reshape(-1, 3)
    corners = np.repeat(surface.faces[regions.faces], 2, axis=0)
    found = []
    pairs, of_segment = np.unique(regions.between, axis=0, return_inverse=True)
    for number, pair in enumerate(pairs.tolist()):
        mine = np.flatnonzero(of_segment.reshape(-1) == number)
        named = ends[mine]
        where = dict(zip(named.ravel().tolist(), np.add.outer(2 * mine, (0, 1)).ravel().tolist(), strict=True))
        for chain, closed in chains(named):
            at = [where[end] for end in chain.tolist()]
            found.append(Boundary((pair[0], pair[1]), points[at], closed, corners[at], weights[at]))
    return found


def write_boundaries(path: str | os.PathLike[str], curves: Sequence[Boundary], labels: Sequence[int] = ()) -> None:
    """Write boundaries of regions to a file, each with the numbers `region` and `other` of the regions that it divides.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .csv, .obj, .vtp or .json.
    curves : sequence of Boundary
        The boundaries.
    labels : (k,) sequence of int
        What to write for each region, such as the id of its pin; its number by default.

    Raises
    ------
    OutputError
        If the file cannot be written.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> sphere = pyvista.Icosphere(nsub=2)
    >>> fields = bihdist.BiharmonicDistance(sphere).from_sources([0, 1])
    >>> regions = bihdist.voronoi_regions(sphere, fields)
    >>> boundaries = bihdist.region_boundaries(sphere, regions)
    >>> bihdist.write_boundaries("boundaries.csv", boundaries)
    >>> print(Path("boundaries.csv").read_text().split()[0])
    line,region,other,closed,x,y,z
    """
    written = []
    for curve in curves:
        region, other = (int(labels[i]) if len(labels) else i for i in curve.between)
        written.append(Curve(curve.points, curve.closed, {"region": region, "other": other}))
    write_curves(path, written, ["region", "other"], "boundaries")


def _named_ends(surface: Surface, regions: Regions) -> IntArray:
    """Return (s, 2) numbers of the segments' ends: the same for ends in the same place, as rounding does not tell."""
    corners, on = surface.faces[regions.faces][:, None], regions.weights > 0
    count = len(corners)
    meets = (regions.cut_by >= 0)[..., None]
    pairs = np.broadcast_to(regions.between[:, None], (count, 2, 2))
    # A meeting is known by its face and regions, a crossing by its edge and regions.
    three = np.sort(np.concatenate([pairs, regions.cut_by[..., None]], axis=2), axis=2)
    faces = np.broadcast_to(regions.faces[:, None, None], (count, 2, 1))
    meeting = np.concatenate([faces, three, np.full((count, 2, 1), -1)], axis=2)
    crossing = np.concatenate([np.sort(np.where(on, corners, -1), axis=2), pairs], axis=2)
    at_vertex = on.sum(axis=2, keepdims=True) == 1
    crossing[..., 3:] = np.where(at_vertex, -1, crossing[..., 3:])
    is_meeting = meets & ~at_vertex
    names = np.concatenate([is_meeting, np.where(is_meeting, meeting, crossing)], axis=2)
    too = np.zeros((count, 2, 1), np.int64)
    too[:, 1, 0] = (names[:, 0] == names[:, 1]).all(axis=1)
    rows = np.concatenate([names, too], axis=2).reshape(2 * count, -1)
    _, first, number = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    # In the order in which they come.
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return rank[number.reshape(count, 2)]
