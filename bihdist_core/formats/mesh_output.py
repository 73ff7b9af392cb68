"""Surfaces written to files that other programs read."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import BinaryIO

from ..arrays import AnyArray
from ..mesh_like import MeshLike
from ..surface import Surface
from ..whole_file import check_output, whole_file
from .field_output import write_ply_mesh
from .vtp_output import write_poly_data


def write_mesh(path: str | os.PathLike[str], surface: MeshLike) -> None:
    """Write a surface as .off, .obj, .ply or .vtp, vertices in their order and so that they read back exactly.

    Raises OutputError if the file cannot be written; what was there then stays.

    >>> import bihdist
    >>> triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    >>> bihdist.write_mesh("triangle.off", triangle)
    >>> bihdist.read_surface("triangle.off")
    Surface(triangle.off: 3 vertices, 1 faces)
    """
    surface = Surface.of(surface)
    extension = check_output(path, MESH_FORMATS)
    with whole_file(path) as temporary, temporary.open("wb") as file:
        _WRITERS[extension](file, surface)


def _write_off(file: BinaryIO, surface: Surface) -> None:
    file.write(f"OFF\n{len(surface.vertices)} {len(surface.faces)} 0\n".encode())
    file.write(_lines(surface.vertices, ""))
    file.write(_lines(surface.faces, "3 "))


def _write_obj(file: BinaryIO, surface: Surface) -> None:
    file.write(_lines(surface.vertices, "v "))
    file.write(_lines(surface.faces + 1, "f "))


def _write_vtp(file: BinaryIO, surface: Surface) -> None:
    write_poly_data(file, surface.vertices, polygons=surface.faces, point_data={})


def _lines(rows: AnyArray, before: str) -> bytes:
    return "".join(f"{before}{a!r} {b!r} {c!r}\n" for a, b, c in rows.tolist()).encode()


_WRITERS: dict[str, Callable[[BinaryIO, Surface], None]] = {
    ".off": _write_off,
    ".obj": _write_obj,
    ".ply": lambda file, surface: write_ply_mesh(file, surface, {}),
    ".vtp": _write_vtp,
}
MESH_FORMATS = tuple(_WRITERS)
"""The extensions that `write_mesh` knows."""
