"""Meshes in files of arrays: MATLAB's .mat, as shape matching has them, and NumPy's .npz.

A .mat has a mesh as a struct, or as variables: TOSCA's X, Y, Z and TRIV, or VERT and TRIV, or vertices and faces.  Its
ids count from 1.  A .npz has vertices and faces, with ids from 0.
"""

import io
import os
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ..arrays import AnyArray
from ..errors import MeshError, ParameterError
from ..sentences import shortened, with_and
from .array_file import archived_array, opened_archive
from .mat_file import mat_variables
from .mesh_names import GZIP
from .polygons import Polygons, whole_numbers

_MATLAB = ((("X", "Y", "Z"), "TRIV"), (("VERT",), "TRIV"), (("vertices",), "faces"))
_NUMPY = ((("vertices",), "faces"),)
_LISTED = 8


def read_array_mesh(raw: bytes, name: str) -> Polygons:
    """Read the mesh in a file of arrays; MeshError where there is none, or several, or the file cannot be read."""
    first = 1 if _is_matlab(name) else 0
    found, names = _meshes_in(raw, name)
    if len(found) != 1:
        wanted = "X, Y, Z and TRIV, VERT and TRIV, or vertices and faces" if first else "vertices and faces"
        listed = with_and([*names[:_LISTED], *(["more"] if len(names) > _LISTED else [])]) or "none"
        held = f"several meshes, in {with_and(list(found))}" if found else f"no mesh, which is {wanted}"
        raise MeshError(f"{name} has {held} (its variables are {shortened(listed, 200)}).")
    (points, faces), *_ = found.values()
    if len(points) == 3:
        columns = [_numbers(each, name).ravel() for each in points]
        if len({len(column) for column in columns}) > 1:
            raise MeshError(f"{name} has {with_and([str(len(column)) for column in columns])} numbers of X, Y and Z.")
        vertices = np.stack(columns, axis=1)
    else:
        vertices = _numbers(points[0], name)
    corners = _numbers(faces, name)
    for what, array, least in (("vertices", vertices, 3), ("faces", corners, 3)):
        if array.ndim != 2 or array.shape[1] < least or (what == "vertices" and array.shape[1] > 3):
            raise MeshError(f"{name}: its {what} have the shape {array.shape}, not three numbers each.")
    ids, bad = whole_numbers(corners)
    ids, n = ids - first, len(vertices)
    bad |= (ids < 0) | (ids >= n)
    if bad.any():
        k, corner = np.argwhere(bad)[0]
        last = n - 1 + first
        raise MeshError(
            f"{name}: face {k + first} names vertex {corners[k, corner]:.16g}, but ids run from {first} to {last}."
        )
    return Polygons(vertices.astype(np.float64), np.full(len(ids), ids.shape[1]), ids.ravel())


def holds_mesh(raw: bytes, name: str) -> bool:
    """Return whether a file of arrays has a mesh."""
    try:
        return bool(_meshes_in(raw, name)[0])
    except MeshError:
        return False


_Mesh = tuple[list[Any], Any]
"""The arrays of coordinates, one or three, and the faces."""


def _is_matlab(name: str) -> bool:
    return os.fspath(name).lower().removesuffix(GZIP).endswith(".mat")


def _meshes_in(raw: bytes, name: str) -> tuple[dict[str, _Mesh], list[str]]:
    """Return the meshes in a file by the names of what holds them, and the names of all variables."""
    if _is_matlab(name):
        variables = mat_variables(raw, name)
        return {label: mesh for label, each in _structs(variables) if (mesh := _mesh(each, _MATLAB))}, list(variables)
    try:
        with opened_archive(io.BytesIO(raw), name) as archive:
            names = [each.removesuffix(".npy") for each in archive.namelist()]
            wanted = [each for each in names if each in ("vertices", "faces")]
            mesh = _mesh({each: archived_array(archive, each, name) for each in wanted}, _NUMPY)
    except ParameterError as error:
        raise MeshError(str(error)) from None
    return {"it": mesh} if mesh else {}, names


def _structs(variables: Mapping[str, Any], at: str = "") -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield what has names of its own: all variables, and each struct."""
    yield at or "its variables", variables
    for name, value in variables.items():
        if isinstance(value, Mapping):
            yield from _structs(value, f"{at}.{name}".lstrip("."))


def _mesh(variables: Mapping[str, Any], known: tuple[tuple[tuple[str, ...], str], ...]) -> _Mesh | None:
    for coordinates, faces in known:
        if {*coordinates, faces} <= variables.keys():
            return [variables[each] for each in coordinates], variables[faces]
    return None


def _numbers(array: Any, name: str) -> AnyArray:
    found = np.asarray(array)
    if found.dtype.kind not in "iuf":
        raise MeshError(f"{name}: the arrays of its mesh are not real numbers.")
    return found
