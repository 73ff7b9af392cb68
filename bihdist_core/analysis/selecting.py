"""Vertices chosen on a surface: by a brush of some radius, cut out as a mesh, written to files."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.sparse import csgraph
from scipy.spatial import cKDTree

from ..arrays import IntArray
from ..errors import ParameterError
from ..file_content import file_text
from ..file_output import atomic_write, check_output
from ..formats.array_file import read_array
from ..formats.field_output import write_array, write_fields
from ..mesh_like import MeshLike
from ..surface import Surface, with_faces

SELECTION_WAYS = {"ids": (".txt", ".npy", ".csv"), "field": (".csv", ".npy", ".ply", ".vtp"), "mesh": (".ply", ".vtp")}
"""As what a selection is written, and the extensions there are for it."""


class Brush:
    """A brush that selects vertices near a place and connected to it.

    Parameters
    ----------
    surface : MeshLike
        The mesh.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> brush = bihdist.Brush(plane)
    >>> # the corner and its neighbours
    >>> brush.near(face=0, position=(-0.5, -0.5, 0), radius=0.13).tolist()
    [0, 1, 9]
    """

    def __init__(self, surface: MeshLike) -> None:
        self._surface = Surface.of(surface).shape
        self._tree = cKDTree(self._surface.vertices)

    @cached_property
    def _edges(self) -> sparse.csr_matrix:
        i, j = self._surface.edges.T
        n = len(self._surface.vertices)
        return sparse.csr_matrix((np.ones(len(i), np.int8), (i, j)), (n, n))

    def near(self, face: int, position: npt.ArrayLike, radius: float) -> IntArray:
        """Select the vertices within a radius that are connected to a face.

        Parameters
        ----------
        face : int
            The face under the brush.
        position : (3,) array_like
            A point in that face.
        radius : float
            Straight distance in the mesh's unit, above 0.

        Returns
        -------
        (k,) int64 ndarray
            Vertex ids, ascending: those within the radius that edges between such vertices join to the face, so none of
            a sheet behind it. If the face has no corner within the radius, the corner nearest to the position.

        Raises
        ------
        ParameterError
            For a position that is not three finite numbers, or a radius that is not above 0.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> bihdist.Brush(plane).near(face=0, position=(-0.5, -0.5, 0), radius=0.2).tolist()
        [0, 1, 9, 10]
        """
        place = np.asarray(position, np.float64)
        if not (radius > 0 and place.shape == (3,) and np.isfinite(place).all()):
            raise ParameterError(f"A brush has a place (3,) and a radius above 0, not {position!r} and {radius!r}.")
        corners = self._surface.faces[face]
        apart = np.linalg.norm(self._surface.vertices[corners] - place, axis=1)
        within = np.array(sorted(self._tree.query_ball_point(place, radius)), np.int64)
        begins = corners[apart <= radius]
        if not len(begins):
            nearest: IntArray = corners[[apart.argmin()]].astype(np.int64)
            return nearest
        _, piece = csgraph.connected_components(self._edges[within][:, within], directed=False)
        pieces = np.unique(piece[np.searchsorted(within, begins)])
        return within[np.isin(piece, pieces)]


def cut_out(surface: MeshLike, vertices: npt.ArrayLike) -> tuple[Surface, IntArray]:
    """Cut out the faces all of whose corners are among some vertices.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    vertices : (k,) array_like
        Vertex ids.

    Returns
    -------
    part : Surface
        These faces as a mesh, with v vertices.
    ids : (v,) int64 ndarray
        The vertex of the whole surface that each of its vertices is.

    Raises
    ------
    VertexError
        If a vertex is not on the surface.
    ParameterError
        If there is no such face.

    Examples
    --------
    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> half, ids = bihdist.cut_out(plane, np.flatnonzero(plane.points[:, 0] <= 0))
    >>> half.n_faces, half.area, ids[:6].tolist()
    (64, 0.5, [0, 1, 2, 3, 4, 9])
    """
    surface = with_faces(surface, "cuts")
    chosen = np.zeros(len(surface.vertices), bool)
    chosen[surface.check_vertices(vertices)] = True
    faces = surface.faces[chosen[surface.faces].all(axis=1)]
    if not len(faces):
        raise ParameterError(f"No face of {surface.name} has all its corners among the {int(chosen.sum()):,} vertices.")
    ids, index = np.unique(faces, return_inverse=True)
    return Surface(surface.vertices[ids], index.reshape(-1, 3), surface.name), ids


def write_ids(path: str | os.PathLike[str], vertices: npt.ArrayLike) -> None:
    """Write vertex ids (k,): .txt has one on each line, .npy an int64 array, .csv a column `vertex`."""
    ids = np.asarray(vertices, np.int64).ravel()
    if check_output(path, SELECTION_WAYS["ids"]) != ".txt":
        write_array(path, ids, ["vertex"])
        return
    with atomic_write(path) as temporary:
        temporary.write_text("".join(f"{id}\n" for id in ids.tolist()), encoding="ascii")


def is_ids_file(words: str) -> bool:
    """Return whether words name a file that `read_ids` reads."""
    return os.path.splitext(words)[1].lower() in SELECTION_WAYS["ids"]


def read_ids(path: str | os.PathLike[str]) -> IntArray:
    """Read vertex ids (k,) as `write_ids` writes them; a .csv may have other columns behind them.

    Raises ParameterError for a file that is not there or that holds something else.
    """
    file = Path(path)
    if file.suffix.lower() == ".npy":
        ids = read_array(file, "ids in")
    else:
        words = [line.split(",")[0].strip() for line in file_text(file, "ids in").splitlines()]
        has_head = file.suffix.lower() == ".csv" and words[:1] == ["vertex"]
        try:
            ids = np.array([int(word) for word in words[has_head:] if word], np.int64)
        except (ValueError, OverflowError):
            raise ParameterError(f"{file} does not hold vertex ids.") from None
    if ids.ndim != 1 or ids.dtype.kind not in "iu" or not len(ids) or ids.min() < 0 or ids.max() >= 2**63:
        raise ParameterError(f"{file} does not hold vertex ids.")
    checked: IntArray = ids.astype(np.int64)
    return checked


def write_selection(
    path: str | os.PathLike[str], surface: MeshLike, vertices: npt.ArrayLike, way: str = "ids", name: str = "selection"
) -> None:
    """Write selected vertices to a file.

    Parameters
    ----------
    path : str or path-like
        The extension names the format, of which each way has its own.
    surface : MeshLike
        The mesh.
    vertices : (k,) array_like
        Vertex ids.
    way : {"ids", "field", "mesh"}
        "ids": the ids (.txt, .csv, .npy).
        "field": 1 at the vertices and 0 elsewhere (.npy, .csv, .ply, .vtp).
        "mesh": the faces all of whose corners are selected, with the field `vertex` of their ids (.ply, .vtp).
    name : str
        The name of the field.

    Raises
    ------
    OutputError
        If the file cannot be written.
    VertexError
        If a vertex is not on the surface.
    ParameterError
        For another way, and if no face is selected for a mesh.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> bihdist.write_selection("selection.txt", plane, [3, 40])
    >>> Path("selection.txt").read_text().split()
    ['3', '40']
    """
    surface = Surface.of(surface)
    if way not in SELECTION_WAYS:
        raise ParameterError(f"A selection is written as {', '.join(SELECTION_WAYS)}, not as {way!r}.")
    check_output(path, SELECTION_WAYS[way])
    ids = surface.check_vertices(vertices)
    if way == "ids":
        write_ids(path, ids)
    elif way == "field":
        field = np.zeros(len(surface.vertices))
        field[ids] = 1
        write_fields(path, surface, {name: field})
    else:
        part, of = cut_out(surface, ids)
        write_fields(path, part, {"vertex": of})
