"""Files of pins, named vertices of a surface: CSV and JSON, and landmarks in files of other programs."""

from __future__ import annotations

import csv
import io
import json
import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, array_of
from ..counts import counted
from ..errors import ParameterError, VertexError
from ..file_content import file_text
from ..file_output import atomic_write, check_output
from ..mesh_like import MeshLike
from ..sentences import shortened
from ..surface import Surface
from .landmarks import LANDMARKS, LPS, RAS, Picked, are_numbers, cut, json_in, markups, position_of
from .mesh_names import mesh_name

COLUMNS = ("id", "vertex", "x", "y", "z", "name")
WITH_VALUES = (*COLUMNS, "value")
"""Columns that are read; files of anchors (`anchors`) are files of pins, too."""
NAMES = ("label", "landmark")
"""What other programs call the column of names."""

MOST = 10**18
"""Ids have less digits."""


@dataclass(frozen=True, eq=False)
class Pins:
    """Pins: k named vertices of a surface, in order.

    Attributes
    ----------
    ids : (k,) int64 ndarray
        All different.
    vertices : (k,) int64 ndarray
        The vertices.
    names : tuple of str
        Names, which may be empty.
    moved : (k,) float64 ndarray
        How far each vertex is from the position that a file gave, in the mesh's unit; 0 where it gave none.
    facts : tuple of str
        What is to be known of a file's positions: their coordinate system, and those that are far from the surface.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> pins = bihdist.Pins.of(plane, [0, 40], names=["corner", "middle"])
    >>> pins.ids.tolist(), pins.vertices.tolist(), pins.names
    ([1, 2], [0, 40], ('corner', 'middle'))
    """

    ids: IntArray
    vertices: IntArray
    names: tuple[str, ...]
    moved: FloatArray
    facts: tuple[str, ...] = ()

    @classmethod
    def of(
        cls, surface: MeshLike, vertices: npt.ArrayLike, names: Sequence[str] = (), ids: npt.ArrayLike | None = None
    ) -> Pins:
        """Make pins at vertices.

        Parameters
        ----------
        surface : MeshLike
            The mesh.
        vertices : (k,) array_like
            At least one vertex.
        names : (k,) sequence of str
            Their names; none by default.
        ids : (k,) array_like, optional
            Different whole numbers; 1 to k by default.

        Returns
        -------
        Pins
            The pins.

        Raises
        ------
        VertexError
            If a vertex is not on the surface.
        ParameterError
            For no vertices, another number of names or ids, and ids that are not different whole numbers.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> bihdist.Pins.of(plane, [0, 40], ids=[7, 3]).ids.tolist()
        [7, 3]
        """
        surface = Surface.of(surface)
        places = surface.check_vertices(vertices)
        numbers = np.arange(1, len(places) + 1) if ids is None else array_of(ids, "Ids of pins")
        if not len(places):
            raise ParameterError("There are no pins.")
        if names and len(names) != len(places):
            raise ParameterError(f"{len(places)} pins need as many names, not {len(names)}.")
        if numbers.shape != places.shape or numbers.dtype.kind not in "iu" or len(np.unique(numbers)) < len(numbers):
            raise ParameterError(f"{len(places)} pins need as many different whole numbers as ids, not {ids!r}.")
        return cls(numbers, places, tuple(names) or ("",) * len(places), np.zeros(len(places)))

    def __len__(self) -> int:
        return len(self.vertices)


def read_pins(path: str | os.PathLike[str], surface: MeshLike) -> Pins:
    """Read pins from a file.

    Parameters
    ----------
    path : str or path-like
        The extension names the format.
        ``.csv``: a header of some of `id,vertex,x,y,z,name`, in any order, then a line for each pin.
        ``.json``: ``{"pins": [{"id", "vertex", "position": [x, y, z], "name"}, ...]}``.
        Landmarks of other programs: MeshLab's picked points ``.pp``, Slicer's ``.fcsv`` and ``.mrk.json``, IDAV
        Landmark's ``.pts``, Avizo's ``.landmarkAscii``, and ``.tps`` with ``LM3=``. A ``.csv`` without a header has
        three coordinates on each line, perhaps behind a name.
    surface : MeshLike
        The mesh that the pins are on.

    Returns
    -------
    Pins
        Each pin is at its vertex or, where the file names none, at the vertex nearest to its position; `Pins.moved`
        tells how far off that is. Ids count from 1 where there are none. `Pins.facts` says which landmarks are farther
        from the surface than the mean edge, and whether those of Slicer lie on it as they are or with the signs of x
        and y changed, from LPS to RAS or back.

    Raises
    ------
    ParameterError
        For anything else; the message names the file, the place in it and the value.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> _ = Path("pins.csv").write_text('''x,y,z,name
    ... 0.01,0,0,middle''')
    >>> pins = bihdist.read_pins("pins.csv", plane)
    >>> pins.vertices.tolist(), pins.names, pins.moved.round(6).tolist()
    ([40], ('middle',), [0.01])
    """
    return placed(picked_in(path), Surface.of(surface))


def picked_in(path: str | os.PathLike[str]) -> list[Picked]:
    """Read the pins of a file as they stand there, at least one. Raises ParameterError as `read_pins`."""
    path = Path(path)
    format = pins_extension(path)
    if not format:
        raise ParameterError(f"{path} is not a file of pins; such files are {', '.join(PIN_FORMATS)}.")
    return picked_from(file_text(path, "pins in"), path.name, format)


def pins_extension(path: str | os.PathLike[str]) -> str:
    """Return the one of PIN_FORMATS that a file's name ends in; "" for none."""
    name = os.path.basename(path).lower()
    return next((each for each in PIN_FORMATS if name.endswith(each.lower())), "")


def picked_from(text: str, name: str, format: str) -> list[Picked]:
    """Read the pins in a text of one of PIN_FORMATS; messages call it `name`."""
    found = _READERS[format](text, name)
    if not found:
        raise ParameterError(f"{name} holds no pins.")
    return found


def pins_format(text: str) -> str:
    """Guess which of PIN_FORMATS a text has by how it begins; "" for none."""
    begins = text.lstrip()
    if begins.startswith("{"):
        return ".json"
    known = (each for each, format in LANDMARKS.items() if begins[:30].lower().startswith(format.begins))
    first = re.split("[,;]", begins.partition("\n")[0])[0].strip().lower()
    return next(known, ".csv" if first in WITH_VALUES or first in NAMES or _has_coordinates(begins) else "")


def _has_coordinates(text: str) -> bool:
    """Return whether lines are positions, perhaps behind names, rather than vertex ids: a number is not whole."""
    numbers: list[str] = []
    for line in text.splitlines():
        words = [word.strip() for word in re.split("[,;]", line)]
        if line.strip() and not _is_position(words):
            return False
        numbers += words[-3:]
    return not all(map(str.isdigit, numbers))


def _is_position(words: Sequence[str]) -> bool:
    return len(words) in (3, 4) and are_numbers(words[-3:])


def write_pins(path: str | os.PathLike[str], surface: MeshLike, pins: Pins) -> None:
    """Write pins to a file that `read_pins` reads, with the exact positions of their vertices.

    Parameters
    ----------
    path : str or path-like
        The extension names the format, one of those of `read_pins`. Only .csv and .json keep ids, and
        .landmarkAscii and .tps have no names. Slicer's files call the positions RAS if the mesh is a GIFTI or
        FreeSurfer file, and else LPS.
    surface : MeshLike
        The mesh.
    pins : Pins
        The pins.

    Raises
    ------
    OutputError
        If the file cannot be written; what was there then stays.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> from pathlib import Path
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> bihdist.write_pins("pins.csv", plane, bihdist.Pins.of(plane, [40], ["middle"]))
    >>> print(Path("pins.csv").read_text().strip())
    id,vertex,x,y,z,name
    1,40,0.0,0.0,0.0,middle
    """
    surface = Surface.of(surface)
    points = surface.vertices[pins.vertices].tolist()
    rows = [
        {"id": number, "vertex": vertex, "position": point, "name": name}
        for number, vertex, point, name in zip(
            pins.ids.tolist(), pins.vertices.tolist(), points, pins.names, strict=True
        )
    ]
    write_rows(path, COLUMNS, "pins", rows, surface.name)


def placed(found: list[Picked], surface: Surface) -> Pins:
    """Put the pins of a file at their vertices, or at the vertices nearest to their positions.

    Of several sets of landmarks, the one that has the mesh's name counts. ParameterError if there is none.
    """
    from scipy.spatial import cKDTree

    groups = groups_of(found)
    if len(groups) > 1:
        mine = [name for name in groups if mesh_name(name).lower() == mesh_name(surface.name).lower()]
        if len(mine) != 1:
            raise ParameterError(
                f"{_file(found)} has {len(groups)} sets of landmarks, {shortened(', '.join(groups), 60)}; of several, "
                f"the one called as the mesh is read, {mesh_name(surface.name)}, and two are pairs."
            )
        found = groups[mine[0]]
    there = list(filter(_is_placed, found))
    if not there:
        raise ParameterError(f"{_file(found)} holds no landmark with a position.")
    facts = [f"{counted(len(found) - len(there), 'landmark')} without a position left out"]
    facts = facts if len(there) < len(found) else []
    ids: dict[int, str] = {}
    for k, pin in enumerate(found):
        number = k + 1 if pin.id is None else pin.id
        if number in ids:
            raise ParameterError(f"{pin.where}: the id {number} is that of {ids[number]} already.")
        if pin in there:
            ids[number] = pin.where.rpartition(", ")[2]
    vertices = np.array([-1 if pin.vertex is None else _vertex(pin, surface) for pin in there])
    at = np.array([pin.position or (np.nan,) * 3 for pin in there])
    snaps = np.flatnonzero(vertices < 0)
    if len(snaps):
        at[snaps], said = _turned(at[snaps], there[snaps[0]].system, surface)
        used = np.flatnonzero(surface.component_of_vertex >= 0)
        vertices[snaps] = used[cKDTree(surface.vertices[used]).query(at[snaps])[1]]
        facts += [*said, *_far(at[snaps], [list(ids)[k] for k in snaps], surface)]
    moved = np.nan_to_num(np.linalg.norm(surface.vertices[vertices] - at, axis=1))
    return Pins(np.array(list(ids)), vertices, tuple(pin.name for pin in there), moved, tuple(facts))


def placed_pairs(paths: Sequence[str], surfaces: Sequence[Surface]) -> tuple[Pins, Pins]:
    """Put corresponding landmarks on two surfaces: those of two files, or two sets of landmarks of one.

    Landmarks correspond by their names if both have the same, all different, and by their order if not. Those without a
    position are left out with their partners. ParameterError for other numbers of sets or landmarks.
    """
    sets = [picked_in(path) for path in paths]
    if len(sets) == 1:
        groups, names = groups_of(sets[0]), [mesh_name(surface.name) for surface in surfaces]
        sets = [groups[name] for name in names] if len({*names} & {*groups}) == 2 else [*groups.values()]
    if len(sets) != 2:
        raise ParameterError(
            f"{', '.join(paths)}: {counted(len(sets), 'set')} of landmarks; pairs are two, in one file or in two."
        )
    keys = [[pin.name for pin in each] for each in sets]
    if "" not in keys[0] and len({*keys[0]}) == len(keys[0]) and sorted(keys[0]) == sorted(keys[1]):
        sets[1].sort(key=lambda pin: keys[0].index(pin.name))
    elif len(sets[0]) != len(sets[1]):
        raise ParameterError(f"{', '.join(paths)}: {len(sets[0]):,} landmarks and {len(sets[1]):,} are not pairs.")
    both = [k for k, pair in enumerate(zip(*sets, strict=True)) if all(map(_is_placed, pair))]
    if not both:
        raise ParameterError(f"{', '.join(paths)}: there is no pair of landmarks with positions.")
    one, two = (placed([each[k] for k in both], surface) for each, surface in zip(sets, surfaces, strict=True))
    return one, two


def _is_placed(pin: Picked) -> bool:
    return pin.vertex is not None or pin.position is not None


def groups_of(found: list[Picked]) -> dict[str, list[Picked]]:
    """Return the sets of landmarks of a file by their names, in their order."""
    groups: dict[str, list[Picked]] = {}
    for pin in found:
        groups.setdefault(pin.group, []).append(pin)
    return groups


def _file(found: list[Picked]) -> str:
    return found[0].where.partition(", ")[0]


def _vertex(pin: Picked, surface: Surface) -> int:
    try:
        return surface.check_vertex(pin.vertex)  # type: ignore[arg-type]
    except VertexError as error:
        raise ParameterError(f"{pin.where}: {error}") from None


def _turned(at: FloatArray, system: str, surface: Surface) -> tuple[FloatArray, list[str]]:
    """Return positions (k, 3) of one of Slicer's systems in the one that the mesh has, and a sentence on it.

    A mesh does not say which it has: that in which the positions lie on it.
    """
    if not system:
        return at, []
    other, turned = RAS if system == LPS else LPS, at * [-1, -1, 1]
    here, there = (float(np.median(off_surface(each, surface))) for each in (at, turned))
    said = f"its positions are {system}, {here:.3g} from the mesh as they are and {there:.3g} as {other}"
    if min(here, there) > min(surface.mean_edge_length, max(here, there) / 2):
        return at, [f"{said}, which decides nothing: read as they are"]
    return (turned, [f"{said}: read as {other}"]) if there < here else (at, [f"{said}: read as they are"])


def _far(at: FloatArray, ids: Sequence[int], surface: Surface) -> list[str]:
    """Return a sentence on the positions (k, 3) that are farther from the surface than the mean edge, if any are."""
    away, edge = off_surface(at, surface), surface.mean_edge_length
    far = int((away > edge).sum())
    if not far:
        return []
    most = int(away.argmax())
    return [
        f"{far:,} of {counted(len(at), 'landmark')} farther from the surface than the mean edge, {edge:.3g}; the "
        f"farthest, {ids[most]}, by {away[most]:.3g}"
    ]


def off_surface(points: FloatArray, surface: Surface) -> FloatArray:
    """Return how far points (k, 3) are from a surface; of points farther off than any side is long, from a vertex."""
    from scipy.spatial import cKDTree

    if not len(surface.faces):
        near: FloatArray = cKDTree(surface.vertices[surface.component_of_vertex >= 0]).query(points)[0]
        return near
    corners = surface.vertices[surface.faces]
    middle = corners.mean(axis=1)
    radius = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    away: FloatArray = cKDTree(corners.reshape(-1, 3)).query(points)[0]
    # A place in a face is within its radius of a corner, and a side is at most two radii long.
    for k in np.flatnonzero((away > 0) & (away <= 3 * radius.max())):
        near = np.linalg.norm(middle - points[k], axis=1) - radius <= away[k]
        away[k] = min(away[k], _off_triangles(points[k], corners[near]))
    return away


def _off_triangles(point: FloatArray, corners: FloatArray) -> float:
    """Return the distance of a point (3,) from the nearest of triangles (m, 3, 3)."""
    sides = np.roll(corners, -1, axis=1) - corners
    to = point - corners
    along = np.einsum("mij,mij->mi", to, sides) / np.maximum(np.einsum("mij,mij->mi", sides, sides), 1e-300)
    off_sides = np.linalg.norm(to - np.clip(along, 0, 1)[..., None] * sides, axis=2).min()
    normal = np.cross(sides[:, 0], sides[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    is_over = (np.einsum("mij,mj->mi", np.cross(sides, to), normal) >= 0).all(axis=1)
    heights = np.abs(np.einsum("mj,mj->m", to[:, 0], normal))[is_over]
    return float(min(off_sides, heights.min(initial=np.inf)))


# ---------------------------------------------------------------------- CSV
def _read_csv(text: str, name: str) -> list[Picked]:
    first = text.partition("\n")[0]
    rows = csv.reader(
        io.StringIO(text, newline=""), delimiter=";" if ";" in first and "," not in first else ",", strict=True
    )
    found: list[Picked] = []
    header: list[str] = []
    try:
        for row in rows:
            where = f"{name}, line {rows.line_num}"
            if not any(word.strip() for word in row):
                continue
            if not header:
                words = [word.strip() for word in row]
                is_position = _is_position(words)
                header = ["name", "x", "y", "z"][-len(words) :] if is_position else _header(words, where)
                if not is_position:
                    continue
            if len(row) != len(header):
                raise ParameterError(f"{where} has {len(row)} values under {len(header)} columns.")
            found.append(_of_words(dict(zip(header, row, strict=True)), where))
    except csv.Error as error:
        raise ParameterError(f"{name}, line {rows.line_num}: {error}.") from None
    return found


def _header(words: list[str], where: str) -> list[str]:
    header = ["name" if word.lower() in NAMES else word.lower() for word in words]
    for word in header:
        if word not in WITH_VALUES:
            known = ", ".join(COLUMNS)
            raise ParameterError(f"{where}: {cut(word)} is not a column of pins; columns are {known}.")
        if header.count(word) > 1:
            raise ParameterError(f"{where}: the column {word} is given twice.")
    if "vertex" not in header and not {"x", "y", "z"} <= set(header):
        raise ParameterError(f"{where}: pins need the column vertex, or x, y and z.")
    return header


def _of_words(row: dict[str, str], where: str) -> Picked:
    words = {column: word.strip() for column, word in row.items()}
    position = [words.get(axis, "") for axis in "xyz"]
    return Picked(
        where,
        _whole(words.get("id", ""), "id", where),
        _whole(words.get("vertex", ""), "vertex", where),
        position_of(position, where) if any(position) or not words.get("vertex") else None,
        row.get("name", ""),
        _number(words["value"], where) if words.get("value") else None,
    )


def _whole(text: str, what: str, where: str) -> int | None:
    if not text:
        return None
    if not text.isascii() or not text.removeprefix("-").isdigit() or len(text) > 18:
        raise ParameterError(f"{where}: the {what} {cut(text)} is not a whole number.")
    return int(text)


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        raise ParameterError(f"{where}: the value {cut(text)} is not a finite number.")
    return value


# ---------------------------------------------------------------------- JSON
def _read_json(text: str, name: str) -> list[Picked]:
    content = json_in(text, name)
    if isinstance(content, dict) and "markups" in content:
        return markups(content, name)
    pins = content.get("pins", content.get("anchors")) if isinstance(content, dict) else None
    if not isinstance(pins, list):
        raise ParameterError(f'{name} holds no list of pins; it should be {{"pins": [...]}}.')
    return [_of_entry(entry, f"{name}, pin {k}") for k, entry in enumerate(pins, 1)]


def _of_entry(entry: Any, where: str) -> Picked:
    known = ("id", "vertex", "position", "name", "value")
    if not isinstance(entry, dict) or not set(entry) <= set(known):
        raise ParameterError(f"{where}: {cut(entry)} is not a pin; a pin has {', '.join(known)}.")
    for key in ("id", "vertex"):
        found = entry.get(key)
        if not isinstance(found, (int, type(None))) or isinstance(found, bool) or not -MOST < (found or 0) < MOST:
            raise ParameterError(f"{where}: the {key} {cut(found)} is not a whole number of up to 18 digits.")
    position, name = entry.get("position"), entry.get("name", "")
    if not isinstance(name, str):
        raise ParameterError(f"{where}: the name {cut(name)} is not a text.")
    if position is None and entry.get("vertex") is None:
        raise ParameterError(f"{where} has neither a vertex nor a position.")
    if position is not None and not (isinstance(position, list) and all(type(x) in (int, float) for x in position)):
        raise ParameterError(f"{where}: the position {cut(position)} is not three finite numbers.")
    at = None if position is None else position_of(position, where)
    value = entry.get("value")
    if value is not None and (isinstance(value, bool) or not isinstance(value, (int, float))):
        raise ParameterError(f"{where}: the value {cut(value)} is not a number.")
    number = None if value is None else _number(str(value), where)
    return Picked(where, entry.get("id"), entry.get("vertex"), at, name, number)


_READERS: dict[str, Callable[[str, str], list[Picked]]] = {
    ".csv": _read_csv,
    **{extension: each.read for extension, each in LANDMARKS.items()},
    ".json": _read_json,
}
PIN_FORMATS = tuple(_READERS)
"""The extensions that `read_pins` and `write_pins` know."""


# ---------------------------------------------------------------------- output
def write_rows(
    path: str | os.PathLike[str], columns: Sequence[str], kind: str, rows: Sequence[dict[str, Any]], surface: str
) -> None:
    """Write pins or anchors, each with a "position" and other values by column, to a file that reads back exactly.

    `columns` are those of a .csv, `kind` is the name of the list in a .json. Landmarks of other programs are named by
    their values, by their names, or else by their ids.
    """
    extension = check_output(path, PIN_FORMATS)
    if extension == ".csv":
        file = io.StringIO()
        writer = csv.DictWriter(file, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows({**row, **dict(zip("xyz", row["position"], strict=True))} for row in rows)
        text = file.getvalue()
    elif extension == ".json":
        lines = ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows)
        text = f'{{"{kind}": [\n{lines}\n]}}\n'
    else:
        names = [repr(row["value"]) if "value" in row else row["name"] or str(row["id"]) for row in rows]
        points = [(row["position"], name) for row, name in zip(rows, names, strict=True)]
        text = LANDMARKS[extension].written(points, surface)
    with atomic_write(path) as temporary:
        temporary.write_bytes(text.encode())
