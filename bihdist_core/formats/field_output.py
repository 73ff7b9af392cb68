"""Values at vertices, and tables of numbers, written to files that other programs read."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import BinaryIO

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, ByteArray
from ..errors import ParameterError
from ..file_output import atomic_write, check_output
from ..mesh_like import MeshLike
from ..surface import Surface
from ..tetrahedra import TetrahedralMesh, boundary_of
from .array_file import put_array
from .gifti import write_gifti_values
from .vtp import write_grid, write_poly_data

Columns = dict[str, AnyArray]
"""(n,) float64 arrays by name, in order."""


def write_fields(path: str | os.PathLike[str], surface: MeshLike, fields: Mapping[str, npt.ArrayLike]) -> None:
    """Write (n,) values at the vertices, in the order and under the names of `fields`; the extension names the format.

    .npy: an (n, k) float64 array, (n,) for a single field; the names are not kept.
    .csv: a line `vertex,name,...`, then a line for each vertex: its id and values that read back exactly; `nan` where
          there is no value.
    .ply: binary little-endian; the surface with a double property for each field (names reduced to letters, digits
          and underscores).
    .vtp, .vtu: the surface, or in .vtu the tetrahedra, with a point data array for each field.
    .func.gii, .shape.gii: GIFTI, a float32 array for each field, with its name.

    Raises OutputError if the file cannot be written (what was at `path` before then stays), ParameterError for fields
    that are not (n,) real numbers.
    """
    surface = Surface.of(surface)
    extension = check_output(path, FIELD_FORMATS)
    columns = checked_columns(fields, len(surface.vertices))
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        _FIELD_WRITERS[extension](file, surface if extension == ".vtu" else boundary_of(surface), columns)


def write_array(path: str | os.PathLike[str], array: npt.ArrayLike, header: Sequence[str] | None = None) -> None:
    """Write a (k,) or (k, m) array of numbers as .npy or .csv; `header` (m,) names the columns of a .csv.

    In .csv whole numbers are written without a decimal point, other numbers so that they read back exactly. Raises
    OutputError as `write_fields`, ParameterError for anything else than one or two axes of real numbers, or a header
    that does not fit.
    """
    extension = check_output(path, ARRAY_FORMATS)
    table = np.asarray(array)
    if table.ndim not in (1, 2) or table.dtype.kind not in "biuf":
        raise ParameterError(f"a table needs one or two axes of real numbers, not {table.shape} of {table.dtype}.")
    columns = list(table.reshape(len(table), -1).T)
    if header is not None and len(header) != len(columns):
        raise ParameterError(f"{len(header)} column names were given for {len(columns):,} columns.")
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        if extension == ".npy":
            put_array(file, table)
        else:
            _write_csv(file, header, columns)


def checked_columns(fields: Mapping[str, npt.ArrayLike], n: int) -> Columns:
    """Return fields (n,) by name as float64; ParameterError for anything else."""
    if not fields:
        raise ParameterError("there are no fields to write.")
    columns = {}
    for name, values in fields.items():
        column = np.asarray(values)
        if column.shape != (n,) or column.dtype.kind not in "biuf":
            raise ParameterError(
                f"the field {name!r} has shape {column.shape} and type {column.dtype}; "
                f"it needs a real number for each of the {n:,} vertices."
            )
        columns[name] = column.astype(np.float64)
    return columns


def _write_npy(file: BinaryIO, surface: Surface, columns: Columns) -> None:
    arrays = list(columns.values())
    put_array(file, arrays[0] if len(arrays) == 1 else np.stack(arrays, axis=1))


def _write_fields_csv(file: BinaryIO, surface: Surface, columns: Columns) -> None:
    ids = np.arange(len(surface.vertices))
    _write_csv(file, ["vertex", *columns], [ids, *columns.values()])


def _write_csv(file: BinaryIO, header: Sequence[str] | None, columns: Sequence[AnyArray]) -> None:
    if header is not None:
        lines = _Lines(file)
        csv.writer(lines, lineterminator="\n").writerow(header)
    # Whole numbers in a float column (the ids in a list of pairs) need no '.0'; repr reads back exactly.
    texts = [
        map(str, np.asarray(column, np.int64).tolist()) if _is_whole(column) else map(repr, column.tolist())
        for column in columns
    ]
    rows = list(zip(*texts, strict=True))
    for low in range(0, len(rows), 65536):
        file.write("".join(",".join(row) + "\n" for row in rows[low : low + 65536]).encode())


def _is_whole(column: AnyArray) -> bool:
    if column.dtype.kind in "biu":
        return True
    return bool(np.all(np.isfinite(column)) and np.all(np.abs(column) < 2**53) and np.all(column == np.floor(column)))


class _Lines:
    """A binary file as csv.writer needs it, which writes text."""

    def __init__(self, file: BinaryIO) -> None:
        self.file = file

    def write(self, text: str) -> int:
        return self.file.write(text.encode("utf-8"))


def ply_names(names: Sequence[str]) -> list[str]:
    """Make names that PLY can hold, all different, none of them a coordinate or a colour."""
    taken, result = {"x", "y", "z", "red", "green", "blue"}, []
    for name in names:
        plain = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_") or "field"
        candidate, k = plain, 2
        while candidate in taken:
            candidate, k = f"{plain}_{k}", k + 1
        taken.add(candidate)
        result.append(candidate)
    return result


def write_ply_mesh(file: BinaryIO, surface: Surface, columns: Columns, colours: ByteArray | None = None) -> None:
    """Write a surface as binary PLY, with a property of its vertices for each column, if any.

    `colours` (n, 3) are red, green and blue of the vertices, left out if None.
    """
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(surface.vertices)}"]
    header += [f"property double {axis}" for axis in "xyz"]
    header += [] if colours is None else [f"property uchar {name}" for name in ("red", "green", "blue")]
    header += [f"property double {name}" for name in ply_names(list(columns))]
    header += [f"element face {len(surface.faces)}", "property list uchar int vertex_indices", "end_header", ""]
    file.write("\n".join(header).encode("ascii"))
    parts: list[AnyArray] = [surface.vertices, *([] if colours is None else [colours]), *columns.values()]
    kinds = [("u1" if part.dtype == np.uint8 else "<f8", part.shape[1:]) for part in parts]
    rows = np.empty(len(surface.vertices), np.dtype([(str(k), *kind) for k, kind in enumerate(kinds)]))
    for k, part in enumerate(parts):
        rows[str(k)] = part
    file.write(rows.tobytes())
    faces = np.empty(len(surface.faces), np.dtype([("size", "u1"), ("corners", "<i4", 3)]))
    faces["size"], faces["corners"] = 3, surface.faces
    file.write(faces.tobytes())


def _write_vtp(file: BinaryIO, surface: Surface, columns: Columns) -> None:
    write_poly_data(file, surface.vertices, polygons=surface.faces, point_data=columns)


def _write_vtu(file: BinaryIO, surface: Surface, columns: Columns) -> None:
    cells = surface.tetrahedra if isinstance(surface, TetrahedralMesh) else surface.faces
    write_grid(file, surface.vertices, cells, columns)


def _write_gifti(file: BinaryIO, surface: Surface, columns: Columns) -> None:
    write_gifti_values(file, surface.name, columns)


_FIELD_WRITERS: dict[str, Callable[[BinaryIO, Surface, Columns], None]] = {
    ".npy": _write_npy,
    ".csv": _write_fields_csv,
    ".ply": write_ply_mesh,
    ".vtp": _write_vtp,
    ".vtu": _write_vtu,
    ".func.gii": _write_gifti,
    ".shape.gii": _write_gifti,
}
FIELD_FORMATS = tuple(_FIELD_WRITERS)
"""The extensions `write_fields` knows."""
ARRAY_FORMATS = (".npy", ".csv")
"""The extensions `write_array` knows."""
