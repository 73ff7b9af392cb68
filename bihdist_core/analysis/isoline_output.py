"""Isolines written to files that other programs read."""

import os
from collections.abc import Callable, Sequence
from typing import BinaryIO

import numpy as np

from ..formats.vtp_output import write_poly_data
from ..whole_file import check_output, whole_file
from .isoline_tracing import Isoline


def write_isolines(path: str | os.PathLike[str], lines: Sequence[Isoline]) -> None:
    """Write curves; the extension names the format.  Coordinates and values read back exactly.

    .csv: a line `line,value,closed,x,y,z` for each point; closed is 1 where the last point joins the first.
    .obj: vertices, and an `l` element for each curve under a group named by its value.
    .vtp: polylines with the cell data array `value`.

    Raises OutputError if the file cannot be written; what was at `path` before then stays.
    """
    extension = check_output(path, ISOLINE_FORMATS)
    with whole_file(path) as temporary, temporary.open("wb") as file:
        _WRITERS[extension](file, lines)


def _write_csv(file: BinaryIO, lines: Sequence[Isoline]) -> None:
    file.write(b"line,value,closed,x,y,z\n")
    for k, line in enumerate(lines):
        start = f"{k},{line.value!r},{int(line.closed)},"
        file.write("".join(f"{start}{x!r},{y!r},{z!r}\n" for x, y, z in line.points.tolist()).encode())


def _write_obj(file: BinaryIO, lines: Sequence[Isoline]) -> None:
    for line in lines:
        file.write("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in line.points.tolist()).encode())
    for line, corners in zip(lines, _corners(lines), strict=True):
        file.write(f"g {line.value!r}\nl {' '.join(map(str, (corners + 1).tolist()))}\n".encode())


def _write_vtp(file: BinaryIO, lines: Sequence[Isoline]) -> None:
    points = np.concatenate([np.empty((0, 3)), *(line.points for line in lines)])
    write_poly_data(file, points, lines=_corners(lines), cell_data={"value": np.array([line.value for line in lines])})


def _corners(lines: Sequence[Isoline]) -> list[np.ndarray]:
    """For each curve the numbers of its points in the file; a closed one comes back to its first."""
    result, start = [], 0
    for line in lines:
        ids = start + np.arange(len(line.points))
        result.append(np.append(ids, ids[:1]) if line.closed else ids)
        start += len(ids)
    return result


_WRITERS: dict[str, Callable[[BinaryIO, Sequence[Isoline]], None]] = {
    ".csv": _write_csv,
    ".obj": _write_obj,
    ".vtp": _write_vtp,
}
ISOLINE_FORMATS = tuple(_WRITERS)
"""The extensions `write_isolines` knows."""
