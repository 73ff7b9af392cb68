"""Surfaces written to files: as they are, or with colours and fields for Blender, MeshLab and viewers of glTF."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, ByteArray, FloatArray
from ..errors import ParameterError
from ..file_output import atomic_write, check_output
from ..mesh_like import MeshLike
from ..surface import Surface, vertex_normals
from ..tetrahedra import boundary_of
from ..version import VERSION
from .field_output import Columns, checked_columns, ply_names, write_ply_mesh
from .gltf import UNDEFINED
from .mesh_names import mesh_name
from .vtp import write_poly_data

SMALLEST, LARGEST = 1e-30, 1e30
"""Sizes between which single precision holds a surface."""


def write_coloured(
    path: str | os.PathLike[str], surface: MeshLike, colours: ByteArray, fields: Mapping[str, npt.ArrayLike]
) -> None:
    """Write a surface with a colour at each vertex, and fields where the format has a place for them.

    Parameters
    ----------
    path : str or path-like
        The extension names the format.
        ``.ply``: binary, with `red`, `green` and `blue` as bytes and a double property for each field.
        ``.obj``: text, a line `v x y z r g b` for each vertex; without the fields.
        ``.glb``: glTF 2.0 in single precision, with `COLOR_0` in linear RGB, as the format demands, and an attribute
        for each field, named such as `_BIHARMONIC_FROM_12`, with `UNDEFINED` for NaN. The surface's node is at its
        centre, from which positions are measured.
    surface : mesh of any kind
        With n vertices.
    colours : (n, 3) uint8 ndarray
        Red, green and blue in sRGB.
    fields : mapping of str to (n,) array_like
        By name.

    Raises
    ------
    OutputError
        If the file cannot be written; what was at `path` before then stays.
    ParameterError
        For fields that are not (n,) real numbers, and for a surface too large or too small for single precision.
    """
    surface = boundary_of(Surface.of(surface))
    extension = check_output(path, COLOURED_FORMATS)
    columns = checked_columns(fields, len(surface.vertices))
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        _COLOURED_WRITERS[extension](file, surface, columns, colours)


def _write_obj(file: BinaryIO, surface: Surface, columns: Columns, colours: ByteArray) -> None:
    # Some readers cut off what others round: a hair above both is the same byte.
    parts = np.ceil(colours / 255 * 1e6) / 1e6
    rows = zip(surface.vertices.tolist(), parts.tolist(), strict=True)
    file.write("".join(f"v {x!r} {y!r} {z!r} {r} {g} {b}\n" for (x, y, z), (r, g, b) in rows).encode())
    file.write(_lines(surface.faces + 1, "f "))


# ---------------------------------------------------------------------- glTF
def _write_glb(file: BinaryIO, surface: Surface, columns: Columns, colours: ByteArray) -> None:
    centre = surface.bounds.mean(axis=0)
    size = float(np.abs(surface.vertices - centre).max())
    if not SMALLEST < size < LARGEST:
        raise ParameterError(f".glb has single precision, and {surface.name} is {size:.3g} large; write .ply instead.")
    normals = vertex_normals(surface.shape)
    normals[~normals.any(axis=1)] = (0, 0, 1)
    attributes = {"POSITION": surface.vertices - centre, "NORMAL": normals, "COLOR_0": _linear(colours / 255)}
    for word, values in zip(ply_names([word.upper() for word in columns]), columns.values(), strict=True):
        attributes[f"_{word}"] = np.where(np.isfinite(values), np.clip(values, UNDEFINED, LARGEST), UNDEFINED)
    arrays = {name: values.astype("<f4") for name, values in attributes.items()}
    triangles = surface.faces.astype("<u4").ravel()
    views = [*arrays.values(), *([triangles] if len(triangles) else [])]
    accessors = [_accessor(k, array) for k, array in enumerate(views)]
    points, name = arrays["POSITION"], mesh_name(surface.name)
    accessors[0] |= {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
    data: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": f"bihdist {VERSION}"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": name, "mesh": 0, "translation": centre.tolist()}],
        "meshes": [
            {
                "name": name,
                "primitives": [
                    {
                        "attributes": {name: k for k, name in enumerate(arrays)},
                        **({"indices": len(arrays)} if len(surface.faces) else {"mode": 0}),
                        "material": 0,
                    }
                ],
            }
        ],
        "materials": [
            {
                "name": "field",
                "doubleSided": True,
                "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.9},
            }
        ],
        "accessors": accessors,
        "bufferViews": _buffer_views(views),
        "buffers": [{"byteLength": sum(array.nbytes for array in views)}],
    }
    text = json.dumps(data).encode()
    text += b" " * (-len(text) % 4)
    content = b"".join(array.tobytes() for array in views)
    file.write(b"glTF" + _whole(2) + _whole(12 + 8 + len(text) + 8 + len(content)))
    file.write(_whole(len(text)) + b"JSON" + text + _whole(len(content)) + b"BIN\0" + content)


def _accessor(k: int, array: AnyArray) -> dict[str, Any]:
    kind = "VEC3" if array.ndim == 2 else "SCALAR"
    return {
        "bufferView": k,
        "componentType": 5126 if array.dtype.kind == "f" else 5125,
        "count": len(array),
        "type": kind,
    }


def _buffer_views(arrays: list[AnyArray]) -> list[dict[str, int]]:
    """Return a buffer view for each array; one of whole numbers holds the corners of triangles."""
    views, offset = [], 0
    for array in arrays:
        target = 34963 if array.dtype.kind == "u" else 34962
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": array.nbytes, "target": target})
        offset += array.nbytes
    return views


def _whole(value: int) -> bytes:
    return value.to_bytes(4, "little")


def _linear(colours: FloatArray) -> FloatArray:
    """Convert colours from sRGB to linear RGB, both from 0 to 1 (IEC 61966-2-1)."""
    linear: FloatArray = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    return linear


_COLOURED_WRITERS: dict[str, Callable[[BinaryIO, Surface, Columns, ByteArray], None]] = {
    ".ply": write_ply_mesh,
    ".obj": _write_obj,
    ".glb": _write_glb,
}
COLOURED_FORMATS = tuple(_COLOURED_WRITERS)
"""The extensions `write_coloured` knows."""


# ---------------------------------------------------------------------- without colours
def write_mesh(path: str | os.PathLike[str], surface: MeshLike) -> None:
    """Write a surface to a mesh file that reads back exactly, vertices in their order.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .off, .obj, .ply or .vtp.
    surface : MeshLike
        The mesh.

    Raises
    ------
    OutputError
        If the file cannot be written; what was there then stays.

    Examples
    --------
    >>> import bihdist
    >>> triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> bihdist.write_mesh("triangle.off", triangle)
    >>> bihdist.read_surface("triangle.off")
    Surface(triangle.off: 3 vertices, 1 faces)
    """
    surface = boundary_of(Surface.of(surface))
    extension = check_output(path, MESH_FORMATS)
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        _MESH_WRITERS[extension](file, surface)


def _write_off(file: BinaryIO, surface: Surface) -> None:
    file.write(f"OFF\n{len(surface.vertices)} {len(surface.faces)} 0\n".encode())
    file.write(_lines(surface.vertices, ""))
    file.write(_lines(surface.faces, "3 "))


def _write_plain_obj(file: BinaryIO, surface: Surface) -> None:
    file.write(_lines(surface.vertices, "v "))
    file.write(_lines(surface.faces + 1, "f "))


def _lines(rows: AnyArray, before: str) -> bytes:
    return "".join(f"{before}{a!r} {b!r} {c!r}\n" for a, b, c in rows.tolist()).encode()


_MESH_WRITERS: dict[str, Callable[[BinaryIO, Surface], None]] = {
    ".off": _write_off,
    ".obj": _write_plain_obj,
    ".ply": lambda file, surface: write_ply_mesh(file, surface, {}),
    ".vtp": lambda file, surface: write_poly_data(file, surface.vertices, polygons=surface.faces),
}
MESH_FORMATS = tuple(_MESH_WRITERS)
"""The extensions that `write_mesh` knows."""
