"""Files of maps from the vertices of one surface to those of another, and of pairs of vertices."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..arrays import IntArray, array_of
from ..errors import ParameterError
from ..file_output import atomic_write, check_output
from ..mesh_like import MeshLike
from ..sentences import shortened
from ..surface import Surface
from .field_output import write_array
from .pins import pins_extension, placed_pairs
from .whole_numbers import NUMBER_FORMATS, WHOLE, read_whole_numbers, text_lines

MAP_FORMATS = NUMBER_FORMATS
PAIR_FORMATS = (".csv", ".txt")
IDENTITY = "identity"


def read_map(path: str | os.PathLike[str], source: MeshLike, target: MeshLike) -> IntArray:
    """Read a map between the vertices of two surfaces.

    Parameters
    ----------
    path : str or path-like
        A .npy file with (n,) or (n, 1) whole numbers, a .txt file with one on each line, or the word ``identity``: the
        same ids, where both surfaces have as many vertices. Ids count from 0.
    source, target : MeshLike
        The surface that is mapped, with n vertices, and the one it is mapped to.

    Returns
    -------
    (n,) int64 ndarray
        A vertex of the target for each vertex of the source, -1 for none.

    Raises
    ------
    ParameterError
        For anything else; the message names the file, the place in it and the value.

    Examples
    --------
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
                f"{source.name} has {n:,} vertices and {target.name} {most:,}, and the same ids are not a map."
            )
        return np.arange(n)
    path = Path(path)
    if path.suffix.lower() not in MAP_FORMATS:
        raise ParameterError(f"{path} is not a map; maps are {', '.join(MAP_FORMATS)} files, or the word {IDENTITY}.")
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
    """Write a map to a file that `read_map` reads.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .npy or .txt.
    found : (n,) array_like
        Whole numbers, -1 for no vertex.

    Raises
    ------
    OutputError
        If the file cannot be written.
    ParameterError
        For a map that is not whole numbers.

    Examples
    --------
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
    with atomic_write(path) as temporary:
        temporary.write_text("".join(f"{id}\n" for id in ids.tolist()), encoding="ascii")


def read_pairs(
    path: str | os.PathLike[str], surfaces: Sequence[Surface] = (), tell: Callable[[str], object] = str
) -> IntArray:
    """Read pairs of ids (k, 2) from a file with a line `i,j`, `i:j` or `i j` for each, perhaps below a header.

    `surfaces` are the two whose vertices i and j must be, if they are known. They must be for landmarks
    (`are_landmarks`): two files with a comma between, or one with two sets; what is known of their positions is told.
    Raises ParameterError, with the file, the line and the value, for anything else.
    """
    if not are_landmarks(path):
        return pairs_in(text_lines(Path(path), "pairs"), str(path), surfaces)
    if not surfaces:
        raise ParameterError(f"{path}: pairs of landmarks need both of their meshes.")
    sets = placed_pairs(_files(path), surfaces)
    for each, surface in zip(sets, surfaces, strict=True):
        for fact in each.facts:
            tell(f"{path}, on {surface.name}: {fact}.")
    return np.column_stack([each.vertices for each in sets])


def are_landmarks(path: str | os.PathLike[str]) -> bool:
    """Return whether a file of pairs holds landmarks, or is two with a comma between."""
    return len(_files(path)) == 2 or pins_extension(path) not in ("", *PAIR_FORMATS)


def _files(path: str | os.PathLike[str]) -> list[str]:
    found = [word.strip() for word in os.fspath(path).split(",")]
    return found if len(found) == 2 and not os.path.exists(path) else [os.fspath(path)]


def pairs_in(lines: Sequence[tuple[int, str]], path: str, surfaces: Sequence[Surface] = ()) -> IntArray:
    """Read pairs of ids (k, 2) from numbered lines such as those of `read_pairs`; messages call the file `path`."""
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
        for id, surface in zip(pairs[-1], surfaces, strict=False):
            if not 0 <= id < len(surface.vertices):
                most = len(surface.vertices) - 1
                raise ParameterError(f"{path}, line {number}: {surface.name} has vertices 0 to {most}, not {id}.")
    if not pairs:
        raise ParameterError(f"{path} holds no pairs; each line is two vertex ids such as 1,2.")
    return np.array(pairs)


def write_pairs(path: str | os.PathLike[str], pairs: npt.ArrayLike) -> None:
    """Write pairs (k, 2) so that `read_pairs` reads them. Raises OutputError if the file cannot be written."""
    check_output(path, PAIR_FORMATS)
    ids = np.asarray(pairs, np.int64).reshape(-1, 2)
    with atomic_write(path) as temporary:
        temporary.write_text("".join(f"{i},{j}\n" for i, j in ids.tolist()), encoding="ascii")
