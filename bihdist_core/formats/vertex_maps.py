"""Files of maps from the vertices of one surface to those of another, and of pairs of vertices."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..arrays import IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..number_arrays import array_of
from ..sentences import shortened
from ..surface import Surface
from ..whole_file import check_output, whole_file
from .field_output import write_array
from .whole_numbers import NUMBER_FORMATS, WHOLE, read_whole_numbers, text_lines

MAP_FORMATS = NUMBER_FORMATS
PAIR_FORMATS = (".csv", ".txt")
IDENTITY = "identity"


def read_map(path: str | os.PathLike[str], source: MeshLike, target: MeshLike) -> IntArray:
    """(n,) for each vertex of the source surface a vertex of the target, -1 for none.

    path: a .npy file with (n,) or (n, 1) whole numbers, a .txt file with one on each line, or the word `identity`: the
    same ids, where both have as many vertices.  Ids count from 0.

    Raises ParameterError, a sentence with the file, the place in it and the value, for anything else.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=1, j_resolution=1)
    >>> bihdist.write_map("map.txt", [3, 2, -1, 0])
    >>> bihdist.read_map("map.txt", plane, plane).tolist()
    [3, 2, -1, 0]
    """
    source, target = Surface.of(source), Surface.of(target)
    n, most = len(source.vertices), len(target.vertices)
    if str(path) == IDENTITY:
        if n != most:
            raise ParameterError(
                f"{source.name} has {n:,} vertices and {target.name} {most:,}, so the same ids are no map between them."
            )
        return np.arange(n)
    path = Path(path)
    if path.suffix.lower() not in MAP_FORMATS:
        raise ParameterError(f"{path} is no map; these are {', '.join(MAP_FORMATS)} files, or the word {IDENTITY}.")
    found = read_whole_numbers(path, "map")
    if len(found) != n:
        raise ParameterError(f"{path} maps {len(found):,} vertices, and {source.name} has {n:,}.")
    wrong = np.flatnonzero((found < -1) | (found >= most))
    if len(wrong):
        hint = " (ids count from 0)" if found.min() >= 1 and found.max() == most else ""
        raise ParameterError(
            f"{path} maps vertex {wrong[0]} to {found[wrong[0]]}, and {target.name} has vertices 0 to {most - 1}{hint}."
        )
    return found


def write_map(path: str | os.PathLike[str], found: npt.ArrayLike) -> None:
    """Write a map (n,) so that `read_map` reads it.

    Raises OutputError if the file cannot be written, ParameterError for a map that is not whole numbers.

    >>> import bihdist
    >>> from pathlib import Path
    >>> bihdist.write_map("map.txt", [3, 2, -1, 0])
    >>> Path("map.txt").read_text().split()
    ['3', '2', '-1', '0']
    """
    ids = array_of(found, "Vertices of a map").ravel()
    if ids.dtype.kind not in "iu":
        raise ParameterError(f"A map is (n,) whole numbers, not {ids.dtype}.")
    if check_output(path, MAP_FORMATS) == ".npy":
        write_array(path, ids)
        return
    with whole_file(path) as temporary:
        temporary.write_text("".join(f"{id}\n" for id in ids.tolist()), encoding="ascii")


def read_pairs(path: str | os.PathLike[str], source: Surface | None = None, target: Surface | None = None) -> IntArray:
    """(k, 2) ids from a file with a line `i,j`, `i:j` or `i j` for each pair; a first line of words is a header.

    source, target: the surfaces whose vertices i and j must be, if they are known.

    Raises ParameterError, a sentence with the file, the line and the value, for anything else.
    """
    return pairs_in(text_lines(Path(path), "pairs"), str(path), source, target)


def pairs_in(
    lines: Sequence[tuple[int, str]], path: str, source: Surface | None = None, target: Surface | None = None
) -> IntArray:
    """(k, 2) ids from numbered lines such as `read_pairs` reads; path: how messages call the file."""
    pairs = []
    for number, line in lines:
        words = re.split(r"\s*[,;:]\s*|\s+", line)
        if number == 1 and line[:1].isalpha():
            continue
        if len(words) < 2 or not all(WHOLE.fullmatch(word) for word in words[:2]):
            raise ParameterError(
                f"{path}, line {number}: {shortened(repr(line), 60)} is not a pair of ids such as 1,2."
            )
        pairs.append((int(words[0]), int(words[1])))
        for id, surface in zip(pairs[-1], (source, target), strict=True):
            if surface is not None and not 0 <= id < len(surface.vertices):
                most = len(surface.vertices) - 1
                raise ParameterError(f"{path}, line {number}: {surface.name} has vertices 0 to {most}, not {id}.")
    if not pairs:
        raise ParameterError(f"{path} holds no pairs; each line is two vertex ids such as 1,2.")
    return np.array(pairs)


def write_pairs(path: str | os.PathLike[str], pairs: npt.ArrayLike) -> None:
    """Write pairs (k, 2) so that `read_pairs` reads them.  Raises OutputError if the file cannot be written."""
    check_output(path, PAIR_FORMATS)
    ids = np.asarray(pairs, np.int64).reshape(-1, 2)
    with whole_file(path) as temporary:
        temporary.write_text("".join(f"{i},{j}\n" for i, j in ids.tolist()), encoding="ascii")
