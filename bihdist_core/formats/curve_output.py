"""Curves written to files that other programs read."""

import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, BinaryIO

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..file_output import atomic_write, check_output
from .vtp import write_poly_data


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve to be written, with numbers and arrays along it.

    `points` (k, 3) are in order; a closed curve does not repeat its first. `numbers` are by name; all curves of a file
    have equal names. `along` has arrays (k, ...) by name, which only .json holds.
    """

    points: FloatArray
    closed: bool
    numbers: Mapping[str, float]
    along: Mapping[str, AnyArray] = field(default_factory=dict)


def write_curves(path: str | os.PathLike[str], curves: Sequence[Curve], names: Sequence[str], word: str) -> None:
    """Write curves with their numbers `names`; the extension names the format. Coordinates read back exactly.

    .csv: a line `line,NUMBERS,closed,x,y,z` for each point; closed is 1 where the last point joins the first.
    .obj: vertices, and an `l` element for each curve under a group named by its numbers.
    .vtp: polylines with the numbers as cell data arrays.
    .json: {word: [...]}, a curve each {NUMBERS, "closed", "points": [[x, y, z], ...]} and its other arrays.

    Raises OutputError if the file cannot be written; what was at `path` before then stays.
    """
    extension = check_output(path, CURVE_FORMATS)
    with atomic_write(path) as temporary, temporary.open("wb") as file:
        _WRITERS[extension](file, curves, names, word)


def _write_csv(file: BinaryIO, curves: Sequence[Curve], names: Sequence[str], word: str) -> None:
    file.write(f"{','.join(['line', *names, 'closed'])},x,y,z\n".encode())
    for k, curve in enumerate(curves):
        start = ",".join([str(k), *(repr(curve.numbers[name]) for name in names), str(int(curve.closed))])
        file.write("".join(f"{start},{x!r},{y!r},{z!r}\n" for x, y, z in curve.points.tolist()).encode())


def _write_obj(file: BinaryIO, curves: Sequence[Curve], names: Sequence[str], word: str) -> None:
    for curve in curves:
        file.write("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in curve.points.tolist()).encode())
    for curve, corners in zip(curves, _corners(curves), strict=True):
        group = "_".join(repr(curve.numbers[name]) for name in names)
        file.write(f"g {group}\nl {' '.join(map(str, (corners + 1).tolist()))}\n".encode())


def _write_vtp(file: BinaryIO, curves: Sequence[Curve], names: Sequence[str], word: str) -> None:
    points = np.concatenate([np.empty((0, 3)), *(curve.points for curve in curves)])
    numbers = {name: np.array([curve.numbers[name] for curve in curves]) for name in names}
    write_poly_data(file, points, lines=_corners(curves), cell_data=numbers)


def _write_json(file: BinaryIO, curves: Sequence[Curve], names: Sequence[str], word: str) -> None:
    def entry(curve: Curve) -> dict[str, Any]:
        numbers = {name: curve.numbers[name] for name in names}
        along = {name: values.tolist() for name, values in curve.along.items()}
        return {**numbers, "closed": curve.closed, "points": curve.points.tolist(), **along}

    # A line of the file for each curve.
    lines = ",\n".join(json.dumps(entry(curve)) for curve in curves)
    file.write(f'{{"{word}": [\n{lines}\n]}}\n'.encode())


def _corners(curves: Sequence[Curve]) -> list[IntArray]:
    """Return the numbers of each curve's points in the file; a closed one comes back to its first."""
    result, start = [], 0
    for curve in curves:
        ids = start + np.arange(len(curve.points))
        result.append(np.append(ids, ids[:1]) if curve.closed else ids)
        start += len(ids)
    return result


_WRITERS: dict[str, Callable[[BinaryIO, Sequence[Curve], Sequence[str], str], None]] = {
    ".csv": _write_csv,
    ".obj": _write_obj,
    ".vtp": _write_vtp,
    ".json": _write_json,
}
CURVE_FORMATS = tuple(_WRITERS)
"""The extensions `write_curves` knows."""
