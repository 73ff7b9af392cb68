"""Paths on a surface: polylines of which each piece lies in one face, so that fields can be read along them exactly;
and their files."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..distances.exact_geodesic import FacePath
from ..errors import ParameterError
from ..file_output import atomic_write, check_output
from ..formats.curve_output import Curve, write_curves
from ..formats.field_output import write_array
from ..formats.vtp import write_poly_data
from ..sources.splitting import Split
from ..surface import Surface
from .places import Places, weighted

NO_WAY = 1e-13
"""Pieces of a path that are shorter than this, in mean edge lengths, are left out."""


@dataclass(frozen=True, eq=False)
class SurfacePath:
    """A polyline of k points on a surface, each piece of which lies in one face.

    Attributes
    ----------
    points : (k, 3) float64 ndarray
        The points.
    faces : (k - 1,) int64 ndarray
        The face of each piece.
    corners : (k - 1, 3) int64 ndarray
        The vertices of these faces.
    begins : (k - 1, 3) float64 ndarray
        Barycentric weights of the beginning of each piece in its face.
    ends : (k - 1, 3) float64 ndarray
        Barycentric weights of its end.
    knots : (j,) int64 ndarray
        Which points are the places that the path was led through.
    method : str
        How the path was made, as a word.
    label : str
        How the path was made, for a reader.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> path = bihdist.GeodesicPaths(plane).path([0, 9])
    >>> round(path.length, 3), path.arcs.round(3).tolist()
    (1.031, [0.0, 0.258, 0.344, 0.515, 0.687, 0.773, 1.031])
    """

    points: FloatArray
    faces: IntArray
    corners: IntArray
    begins: FloatArray
    ends: FloatArray
    knots: IntArray
    method: str
    label: str

    @cached_property
    def arcs(self) -> FloatArray:
        """Length (k,) along the path up to each point, in the mesh's unit.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 5])
        >>> path.arcs.round(3).tolist()  # up to each edge that is crossed
        [0.0, 0.559, 1.118]
        """
        return np.append(0, np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1)))

    @property
    def length(self) -> float:
        """Length of the path, in the mesh's unit.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 24])
        >>> round(path.length, 3)  # the diagonal of the unit square
        1.414
        """
        return float(self.arcs[-1])

    @property
    def places(self) -> Places:
        """The k points as places.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 5])
        >>> places = path.places
        >>> places.faces.tolist(), (places.weights[0]).round(3).tolist()
        ([0, 3, 3], [1.0, 0.0, 0.0])
        """
        faces, corners = (np.append(a, a[-1:], axis=0) for a in (self.faces, self.corners))
        return Places(faces, corners, np.append(self.begins, self.ends[-1:], axis=0))

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """Interpolate a field at the points of the path.

        Parameters
        ----------
        field : (n,) or (n, d) array_like
            Values at the vertices of the surface, linear on each face.

        Returns
        -------
        (k,) or (k, d) ndarray
            Values at the points. Between two points they change linearly with length, so this is the whole profile.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 5])
        >>> path.along(plane.points[:, 0]).round(3).tolist()
        [-0.5, 0.0, 0.5]
        """
        return self.places.values(field)

    def at(self, arcs: npt.ArrayLike) -> Places:
        """Return the places at given lengths along the path.

        Parameters
        ----------
        arcs : (q,) array_like
            Lengths in the mesh's unit; below 0 is the start of the path, beyond its length the end.

        Returns
        -------
        Places
            The q places.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=2, j_resolution=2)
        >>> path = bihdist.GeodesicPaths(plane).path([0, 8])
        >>> middle = path.at([path.length / 2])
        >>> middle.values(plane.points).round(6).tolist()
        [[0.0, 0.0, 0.0]]
        """
        s = np.clip(np.array(arcs, np.float64, ndmin=1), 0, self.length)
        piece = np.clip(np.searchsorted(self.arcs, s, side="right") - 1, 0, len(self.faces) - 1)
        span = self.arcs[piece + 1] - self.arcs[piece]
        t = np.divide(s - self.arcs[piece], span, out=np.zeros(len(s)), where=span > 0)[:, None]
        return Places(self.faces[piece], self.corners[piece], (1 - t) * self.begins[piece] + t * self.ends[piece])


@dataclass(frozen=True, eq=False)
class Crossings:
    """A path given by the edges that it meets.

    Point i is (1 - t) x_a + t x_b with t = `t` (k,) and a, b = `ends` (k, 2); at a vertex a and b are equal. `faces` (k
    - 1,) hold the pieces from each point to the next.
    """

    ends: IntArray
    t: FloatArray
    faces: IntArray

    def points(self, x: FloatArray) -> FloatArray:
        """Return the points (k, 3), given the vertices x (n, 3)."""
        return (1 - self.t)[:, None] * x[self.ends[:, 0]] + self.t[:, None] * x[self.ends[:, 1]]


def assembled(split: Split, parts: Sequence[Crossings], method: str, label: str) -> SurfacePath:
    """Join parts on a split surface, each begun where the last ended, to a path on the whole surface."""
    faces = np.concatenate([part.faces for part in parts])
    begins, ends = (
        np.concatenate([_weights(split.surface, part, end) for part in parts])
        for end in (slice(None, -1), slice(1, None))
    )
    begins, ends = (split.weights_in_parents(faces, w) for w in (begins, ends))
    parents = split.parents[faces]
    knots = np.append(0, np.cumsum([len(part.faces) for part in parts]))
    # Points inside a face that is whole are ends of pieces only where it was split.
    inner = (begins[1:] > 0).all(axis=1) & (parents[1:] == parents[:-1])
    inner[knots[1:-1] - 1] = False
    first = np.append(True, ~inner)
    last = np.append(~inner, True)
    number = np.append(np.cumsum(first) - 1, first.sum())
    parents, begins, ends = parents[first], begins[first], ends[last]
    corners = split.whole.faces[parents]
    x = split.whole.vertices
    points = np.append(weighted(x, corners, begins), weighted(x, corners[-1:], ends[-1:]), axis=0)
    return SurfacePath(points, parents, corners, begins, ends, number[knots], method, label)


def _weights(surface: Surface, part: Crossings, which: slice) -> FloatArray:
    corners, ends, t = surface.faces[part.faces], part.ends[which], part.t[which, None]
    is_vertex = (ends[:, :1] == ends[:, 1:]) & (corners == ends[:, :1])
    return np.where(is_vertex, 1.0, np.where(corners == ends[:, :1], 1 - t, np.where(corners == ends[:, 1:], t, 0)))


def in_faces(surface: Surface, parts: Sequence[FacePath], method: str, label: str) -> SurfacePath:
    """Join parts, each begun where the last ended, to one path."""
    x, moving = surface.vertices, []
    for part in parts:
        corners = surface.faces[part.faces]
        way = weighted(x, corners, part.ends) - weighted(x, corners, part.begins)
        moves = np.linalg.norm(way, axis=1) > NO_WAY * surface.mean_edge_length
        moves[0] |= not moves.any()
        moving.append(moves)
    faces, begins, ends = (
        np.concatenate([getattr(part, name)[moves] for part, moves in zip(parts, moving, strict=True)])
        for name in ("faces", "begins", "ends")
    )
    corners = surface.faces[faces]
    points = np.append(weighted(x, corners, begins), weighted(x, corners[-1:], ends[-1:]), axis=0)
    knots = np.append(0, np.cumsum([moves.sum() for moves in moving]))
    return SurfacePath(points, faces, corners, begins, ends, knots, method, label)


class Stars:
    """The faces around each vertex."""

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        corner = surface.faces.ravel()
        self._faces = np.argsort(corner, kind="stable") // 3
        self._first = np.append(0, np.cumsum(np.bincount(corner, minlength=len(surface.vertices))))

    def __getitem__(self, vertex: int) -> IntArray:
        """Return the faces (k,) of a vertex."""
        return self._faces[self._first[vertex] : self._first[vertex + 1]]

    def common(self, ends: IntArray) -> IntArray:
        """Return (k - 1,) a face that holds both points of each piece, whose points are on the edges `ends` (k, 2)."""
        faces = []
        for a, b in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True):
            shared = set.intersection(*(set(self[v].tolist()) for v in {*a, *b}))
            if not shared:
                raise ParameterError(f"Vertices {sorted({*a, *b})} do not share a face.")
            faces.append(min(shared))
        return np.array(faces, np.int64)


# ---------------------------------------------------------------------- files
PROFILE_FORMATS = (".csv", ".npy", ".vtp", ".json", ".obj")
"""The extensions `write_profile` knows."""


def write_profile(
    path: str | os.PathLike[str], along: SurfacePath, fields: Mapping[str, npt.ArrayLike] | None = None
) -> None:
    """Write a path and the fields along it to a file; numbers read back exactly.

    Parameters
    ----------
    path : str or path-like
        The extension names the format.
        ``.csv``: a line `arc,x,y,z,face,b0,b1,b2,NAMES` for each point: its length along the path, position, place, and
        values.
        ``.npy``: the columns of the .csv as a (k, c) array.
        ``.vtp``: a polyline with the point data arrays `arc` and the fields.
        ``.json``: ``{"points": [[face, b0, b1], ...], "method", "length", "arcs": [...], "fields": {name: [...]}}``.
        ``.obj``: vertices, and an `l` element through them under a group named by the length; without the fields.
    along : SurfacePath
        The path. Between its points the fields change linearly.
    fields : mapping of str to (n,) array_like, optional
        Fields by name.

    Raises
    ------
    OutputError
        If the file cannot be written; what was at `path` before then stays.
    ParameterError
        For a field that has not one real number at each vertex.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> path = bihdist.GeodesicPaths(plane).path([0, 24])
    >>> bihdist.write_profile("profile.csv", path, {"x": plane.points[:, 0]})
    >>> print(Path("profile.csv").read_text().split()[0])
    arc,x,y,z,face,b0,b1,b2,x
    """
    extension = check_output(path, PROFILE_FORMATS)
    values = {
        name: along.along(real_numbers(field, f"Values of the field {name!r}"))
        for name, field in (fields or {}).items()
    }
    for name, column in values.items():
        if column.ndim != 1:
            raise ParameterError(f"The field {name!r} has {column.shape[1:]} numbers at a vertex; a profile needs one.")
    places = along.places
    if extension in (".csv", ".npy"):
        table = np.column_stack([along.arcs, along.points, places.faces, places.weights, *values.values()])
        write_array(path, table, ["arc", "x", "y", "z", "face", "b0", "b1", "b2", *values])
        return
    if extension == ".obj":
        write_curves(path, [Curve(along.points, False, {"length": along.length})], ["length"], "profile")
        return
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        if extension == ".vtp":
            line = [np.arange(len(along.points))]
            write_poly_data(file, along.points, lines=line, point_data={"arc": along.arcs, **values})
        else:
            points = [
                [f, b0, b1] for f, (b0, b1, _) in zip(places.faces.tolist(), places.weights.tolist(), strict=True)
            ]
            record = {"points": points, "method": along.label, "length": along.length, "arcs": along.arcs.tolist()}
            record["fields"] = {name: column.tolist() for name, column in values.items()}
            file.write((json.dumps(record) + "\n").encode())
