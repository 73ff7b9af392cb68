"""Isolines of a field on a surface, as ordered polylines."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..errors import ParameterError
from ..formats.curve_output import CURVE_FORMATS, Curve, write_curves
from ..mesh_like import MeshLike
from ..surface import Surface, with_faces
from .chains import chains


@dataclass(frozen=True, eq=False)
class Isoline:
    """A curve on which a field has one value.

    Attributes
    ----------
    value : float
        The field's value.
    points : (k, 3) float64 ndarray
        Points in order along the curve; a closed one does not repeat its first point.
    edges : (k, 2) int64 ndarray
        The mesh edge a, b that each point lies on.
    parameters : (k,) float64 ndarray
        The t of each point (1 - t) x_a + t x_b.
    closed : bool
        Whether the last point joins the first.

    Examples
    --------
    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=16, j_resolution=16)
    >>> circle, = bihdist.isolines(plane, np.hypot(*plane.points[:, :2].T), [0.4])
    >>> circle.closed, round(circle.length, 2)  # 2 pi 0.4 = 2.51
    (True, 2.51)
    """

    value: float
    points: FloatArray
    edges: IntArray
    parameters: FloatArray
    closed: bool

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """Interpolate a field at the points of the curve.

        Parameters
        ----------
        field : (n,) or (n, d) array_like
            Values at the vertices of the surface.

        Returns
        -------
        (k,) or (k, d) ndarray
            Values at the points.

        Examples
        --------
        >>> import bihdist, numpy as np, pyvista
        >>> plane = pyvista.Plane(i_resolution=16, j_resolution=16)
        >>> line, = bihdist.isolines(plane, plane.points[:, 0], [0.1])
        >>> heights = line.along(plane.points[:, 1])
        >>> line.closed, heights.min().item(), heights.max().item()
        (False, -0.5, 0.5)
        """
        at = np.asarray(field)
        t = self.parameters.reshape(-1, *(1,) * (at.ndim - 1))
        values: FloatArray = (1 - t) * at[self.edges[:, 0]] + t * at[self.edges[:, 1]]
        return values

    @property
    def length(self) -> float:
        """Length of the curve, in the mesh's unit.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> lines = bihdist.isolines(plane, plane.points[:, 0], [0.1, 0.2])
        >>> [round(line.length, 6) for line in lines]
        [1.0, 1.0]
        """
        points = np.concatenate([self.points, self.points[:1]]) if self.closed else self.points
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def isolines(surface: MeshLike, field: npt.ArrayLike, values: npt.ArrayLike) -> list[Isoline]:
    """Trace the curves where a field, linear on each face, has given values.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Real numbers at the vertices. Faces with a corner that is not finite are left out.
    values : (k,) array_like
        The values of the isolines.

    Returns
    -------
    list of Isoline
        In the order of `values`. Each piece of a level set is there once, also where it runs along edges whose both
        ends have the value: in a valley of the field, on a ridge, and along a boundary.

    Raises
    ------
    ParameterError
        If the field is not (n,) numbers, or a value is not finite.

    Notes
    -----
    Curves end at boundaries, at edges of more than two faces, and where other than two pieces of the level set meet in
    a vertex, as at a saddle. Faces that have the value all over are not filled: their outline is drawn once, along the
    mesh's boundary, too. A level set that is a single point has no curve.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> lines = bihdist.isolines(sphere, field, [0.1, 0.3, 0.5])
    >>> [(line.value, line.closed, round(line.length, 2)) for line in lines]
    [(0.1, True, 1.21), (0.3, True, 4.91), (0.5, True, 3.62)]
    """
    surface = with_faces(surface, "isolines")
    f = surface.check_field(field)
    levels = np.atleast_1d(real_numbers(values, "The values of isolines"))
    if levels.ndim != 1 or not np.isfinite(levels).all():
        raise ParameterError("The values of isolines are finite numbers.")
    faces = surface.faces[np.isfinite(f[surface.faces]).all(axis=1)]
    corner = f[faces]
    low, high = corner.min(axis=1), corner.max(axis=1)
    found: list[Isoline] = []
    for level in levels:
        there = np.flatnonzero((low <= level) & (high >= level))
        if len(there):
            side = (corner[there] > level).astype(np.int8) - (corner[there] < level)
            found += _joined(surface, f, float(level), *_segments(faces[there], side))
    return found


def _segments(faces: IntArray, side: IntArray) -> tuple[IntArray, IntArray]:
    """Split the level set on some faces into straight segments.

    Parameters
    ----------
    faces : (m, 3) ndarray
        Vertex ids.
    side : (m, 3) ndarray
        -1, 0 or 1 where a corner's value is below, at or above the level.

    Returns
    -------
    edges : (e, 2) ndarray
        The mesh edges that the ends of segments lie on: the vertex below the level first, or a vertex at the level
        first, where the end is that vertex.
    segments : (s, 2) ndarray
        Rows of `edges`.
    """
    size = int(faces.max()) + 1
    # Across a face: around the lone corner, or from a corner at the level to the opposite side.
    rows = np.flatnonzero((side.min(axis=1) < 0) & (side.max(axis=1) > 0))
    lone = (side[rows] == -side[rows].sum(axis=1, keepdims=True)).argmax(axis=1)
    tip, left, right = (faces[rows, (lone + k) % 3] for k in range(3))
    of_tip, of_left = (side[rows, (lone + k) % 3] for k in range(2))
    is_across = of_tip != 0
    first = _below_first(tip, left, of_tip)
    second = _below_first(np.where(is_across, tip, left), right, np.where(is_across, of_tip, of_left))
    # Along edges at the level, each once, unless it is within faces that are at the level all over.
    face, k = np.nonzero((side == 0) & (np.roll(side, -1, axis=1) == 0))
    along = np.sort(np.stack([faces[face, k], faces[face, (k + 1) % 3]], 1), axis=1)
    _, at, index, count = np.unique(along @ [size, 1], return_index=True, return_inverse=True, return_counts=True)
    flat = np.bincount(index, (side[face] == 0).all(axis=1), len(at))
    along = along[at[(count == 1) | (flat < count)]]
    # Ends that are one edge's crossing, or one vertex, are the same.
    edges = np.concatenate([first, second, along, along[:, ::-1]])
    at_vertex = np.concatenate([~is_across, np.zeros(len(second), bool), np.ones(2 * len(along), bool)])
    key = edges[:, 0] * size + np.where(at_vertex, edges[:, 0], edges[:, 1])
    _, at, index = np.unique(key, return_index=True, return_inverse=True)
    ends = np.split(index, [len(first), 2 * len(first), 2 * len(first) + len(along)])
    return edges[at], np.concatenate([np.stack(ends[:2], 1), np.stack(ends[2:], 1)])


def _below_first(a: IntArray, b: IntArray, side_of_a: IntArray) -> IntArray:
    """Return (k, 2) edges a, b, turned round where a is above the level."""
    return np.where(side_of_a > 0, (b, a), (a, b)).T


def _joined(surface: Surface, f: FloatArray, level: float, edges: IntArray, segments: IntArray) -> list[Isoline]:
    below, top = f[edges[:, 0]], f[edges[:, 1]]
    # Halved first, so that the difference of two huge values of opposite sign is finite.
    between = below != level
    t = np.zeros(len(edges))
    t[between] = np.clip(((level / 2 - below / 2) / np.where(between, top / 2 - below / 2, 1))[between], 0, 1)
    x = surface.vertices
    points = (1 - t)[:, None] * x[edges[:, 0]] + t[:, None] * x[edges[:, 1]]
    lines = []
    for chosen, closed in chains(segments):
        here = points[chosen]
        # Within rounding of a vertex several edges are met in the same point.
        new = np.ones(len(chosen), bool)
        new[1:] = (here[1:] != here[:-1]).any(axis=1)
        if closed and (here[0] == here[-1]).all():
            new[0] = False
        if new.sum() >= 2:
            chosen = chosen[new]
            lines.append(Isoline(level, points[chosen], edges[chosen], t[chosen], closed and len(chosen) > 2))
    return lines


# ---------------------------------------------------------------------- files
ISOLINE_FORMATS = CURVE_FORMATS
"""The extensions `write_isolines` knows."""


def write_isolines(path: str | os.PathLike[str], lines: Sequence[Isoline]) -> None:
    """Write isolines to a file; coordinates and values read back exactly.

    Parameters
    ----------
    path : str or path-like
        The extension names the format.
        ``.csv``: a line `line,value,closed,x,y,z` for each point; `closed` is 1 where the last point joins the first.
        ``.obj``: vertices, and an `l` element for each curve under a group named by its value.
        ``.vtp``: polylines with the cell data array `value`.
        ``.json``: ``{"isolines": [...]}``, each ``{"value", "closed", "points": [[x, y, z], ...], "edges": [[a, b],
        ...],
        "parameters": [t, ...]}``, whose points are (1 - t) x_a + t x_b of the vertices a, b of the mesh.
    lines : sequence of Isoline
        The curves.

    Raises
    ------
    OutputError
        If the file cannot be written; what was at `path` before then stays.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=1, j_resolution=1)
    >>> lines = bihdist.isolines(plane, plane.points[:, 0], [0.25])
    >>> bihdist.write_isolines("lines.csv", lines)
    >>> print(Path("lines.csv").read_text().strip())
    line,value,closed,x,y,z
    0,0.25,0,0.25,-0.5,0.0
    0,0.25,0,0.25,0.25,0.0
    0,0.25,0,0.25,0.5,0.0
    """
    curves = [
        Curve(line.points, line.closed, {"value": line.value}, {"edges": line.edges, "parameters": line.parameters})
        for line in lines
    ]
    write_curves(path, curves, ["value"], "isolines")
