"""Files of pins, named vertices of a surface: CSV, JSON, and MeshLab's picked points (.pp)."""

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
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, array_of
from ..errors import ParameterError, VertexError
from ..file_content import file_text, json_value
from ..file_output import atomic_write, check_output
from ..mesh_like import MeshLike
from ..sentences import shortened
from ..surface import Surface

COLUMNS = ("id", "vertex", "x", "y", "z", "name")
WITH_VALUES = (*COLUMNS, "value")
"""Columns that are read; files of anchors (`anchors`) are files of pins, too."""


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
        ``.pp``: the active points of MeshLab's PickPoints.
    surface : MeshLike
        The mesh that the pins are on.

    Returns
    -------
    Pins
        Each pin is at its vertex or, where the file names none, at the vertex nearest to its position; `Pins.moved`
        tells how far off that is. Ids count from 1 where there are none.

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
    if path.suffix.lower() not in PIN_FORMATS:
        raise ParameterError(f"{path} is not a file of pins; such files are {', '.join(PIN_FORMATS)}.")
    return picked_from(file_text(path, "pins in"), path.name, path.suffix.lower())


def picked_from(text: str, name: str, format: str) -> list[Picked]:
    """Read the pins in a text of one of PIN_FORMATS; messages call it `name`."""
    found = _READERS[format](text, name)
    if not found:
        raise ParameterError(f"{name} holds no pins.")
    return found


def pins_format(text: str) -> str:
    """Guess which of PIN_FORMATS a text has by how it begins; "" for none."""
    begins = text.lstrip()
    if begins[:1] in ("{", "<"):
        return ".json" if begins[0] == "{" else ".pp"
    first = re.split("[,;]", begins.partition("\n")[0])[0].strip().lower()
    return ".csv" if first in WITH_VALUES else ""


def write_pins(path: str | os.PathLike[str], surface: MeshLike, pins: Pins) -> None:
    """Write pins to a file that `read_pins` reads, with the exact positions of their vertices.

    Parameters
    ----------
    path : str or path-like
        The extension names the format: .csv, .json or .pp. MeshLab's .pp has no place for ids.
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


@dataclass(frozen=True)
class Picked:
    """A pin or an anchor as a file says it; `where` is its place in the file, in words."""

    where: str
    id: int | None
    vertex: int | None
    position: tuple[float, ...] | None
    name: str
    value: float | None = None


def placed(found: list[Picked], surface: Surface) -> Pins:
    """Put the pins of a file at their vertices, or at the vertices nearest to their positions."""
    from scipy.spatial import cKDTree

    ids: dict[int, str] = {}
    used = np.flatnonzero(surface.component_of_vertex >= 0)
    tree = None
    vertices, moved = [], []
    for k, pin in enumerate(found):
        number = k + 1 if pin.id is None else pin.id
        if number in ids:
            raise ParameterError(f"{pin.where}: the id {number} is that of {ids[number]} already.")
        ids[number] = pin.where.rpartition(", ")[2]
        if pin.vertex is None:
            tree = tree or cKDTree(surface.vertices[used])
            vertices.append(int(used[tree.query(pin.position)[1]]))
        else:
            try:
                vertices.append(surface.check_vertex(pin.vertex))
            except VertexError as error:
                raise ParameterError(f"{pin.where}: {error}") from None
        at = surface.vertices[vertices[-1]]
        moved.append(0.0 if pin.position is None else float(np.linalg.norm(at - pin.position)))
    return Pins(np.array(list(ids)), np.array(vertices), tuple(pin.name for pin in found), np.array(moved))


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
                header = _header(row, where)
                continue
            if len(row) != len(header):
                raise ParameterError(f"{where} has {len(row)} values under {len(header)} columns.")
            found.append(_of_words(dict(zip(header, row, strict=True)), where))
    except csv.Error as error:
        raise ParameterError(f"{name}, line {rows.line_num}: {error}.") from None
    return found


def _header(words: list[str], where: str) -> list[str]:
    header = [word.strip().lower() for word in words]
    for word in header:
        if word not in WITH_VALUES:
            known = ", ".join(COLUMNS)
            raise ParameterError(f"{where}: {_cut(word)} is not a column of pins; columns are {known}.")
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
        _position(position, where) if any(position) or not words.get("vertex") else None,
        row.get("name", ""),
        _number(words["value"], where) if words.get("value") else None,
    )


def _whole(text: str, what: str, where: str) -> int | None:
    if not text:
        return None
    if not text.isascii() or not text.removeprefix("-").isdigit() or len(text) > 18:
        raise ParameterError(f"{where}: the {what} {_cut(text)} is not a whole number.")
    return int(text)


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not np.isfinite(value):
        raise ParameterError(f"{where}: the value {_cut(text)} is not a finite number.")
    return value


def _position(words: Sequence[Any], where: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(word) for word in words)
    except (TypeError, ValueError, OverflowError):
        numbers = ()
    # Of larger numbers the square is infinite, and so are distances.
    if len(numbers) != 3 or not all(abs(number) < 1e150 for number in numbers):
        shown = ", ".join(shortened(str(word), 30) or "nothing" for word in words[:4])
        raise ParameterError(f"{where}: the position ({shown}) is not three finite numbers.")
    return numbers


# ---------------------------------------------------------------------- JSON
def _read_json(text: str, name: str) -> list[Picked]:
    try:
        content = json_value(text)
    except ParameterError as error:
        raise ParameterError(f"{name}: {error}") from None
    pins = content.get("pins", content.get("anchors")) if isinstance(content, dict) else None
    if not isinstance(pins, list):
        raise ParameterError(f'{name} holds no list of pins; it should be {{"pins": [...]}}.')
    return [_of_entry(entry, f"{name}, pin {k}") for k, entry in enumerate(pins, 1)]


def _of_entry(entry: Any, where: str) -> Picked:
    known = ("id", "vertex", "position", "name", "value")
    if not isinstance(entry, dict) or not set(entry) <= set(known):
        raise ParameterError(f"{where}: {_cut(entry)} is not a pin; a pin has {', '.join(known)}.")
    for key in ("id", "vertex"):
        found = entry.get(key)
        if not isinstance(found, (int, type(None))) or isinstance(found, bool) or not -MOST < (found or 0) < MOST:
            raise ParameterError(f"{where}: the {key} {_cut(found)} is not a whole number of up to 18 digits.")
    position, name = entry.get("position"), entry.get("name", "")
    if not isinstance(name, str):
        raise ParameterError(f"{where}: the name {_cut(name)} is not a text.")
    if position is None and entry.get("vertex") is None:
        raise ParameterError(f"{where} has neither a vertex nor a position.")
    if position is not None and not (isinstance(position, list) and all(type(x) in (int, float) for x in position)):
        raise ParameterError(f"{where}: the position {_cut(position)} is not three finite numbers.")
    at = None if position is None else _position(position, where)
    value = entry.get("value")
    if value is not None and (isinstance(value, bool) or not isinstance(value, (int, float))):
        raise ParameterError(f"{where}: the value {_cut(value)} is not a number.")
    number = None if value is None else _number(str(value), where)
    return Picked(where, entry.get("id"), entry.get("vertex"), at, name, number)


def _cut(value: Any) -> str:
    return shortened(repr(value), 60)


# ---------------------------------------------------------------------- MeshLab
def _read_pp(text: str, name: str) -> list[Picked]:
    if "<!ENTITY" in text:
        raise ParameterError(f"{name} defines XML entities, which files of picked points do not.")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ParameterError(f"{name}, line {error.position[0]}: this is not XML ({error}).") from None
    if root.tag != "PickedPoints":
        raise ParameterError(f"{name} holds {_cut(root.tag)}, not MeshLab's PickedPoints.")
    found = []
    for k, point in enumerate(root.iter("point"), 1):
        # Points of a template that have not been picked yet.
        if point.get("active", "1") != "0":
            where = f"{name}, point {k}"
            words = [point.get(axis, "") for axis in "xyz"]
            found.append(Picked(where, None, None, _position(words, where), point.get("name", "")))
    return found


_READERS: dict[str, Callable[[str, str], list[Picked]]] = {".csv": _read_csv, ".json": _read_json, ".pp": _read_pp}
PIN_FORMATS = tuple(_READERS)
"""The extensions that `read_pins` and `write_pins` know."""


# ---------------------------------------------------------------------- output
def write_rows(
    path: str | os.PathLike[str], columns: Sequence[str], kind: str, rows: Sequence[dict[str, Any]], surface: str
) -> None:
    """Write pins or anchors, each with a "position" and other values by column, to a file that reads back exactly.

    `columns` are those of a .csv, `kind` is the name of the list in a .json. The points of a .pp are named by their
    values, by their names, or else by their ids.
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
        text = written_points([(row["position"], name) for row, name in zip(rows, names, strict=True)], surface)
    with atomic_write(path) as temporary:
        temporary.write_bytes(text.encode())


def written_points(points: list[tuple[list[float], str]], surface: str) -> str:
    """Write named positions as MeshLab's picked points."""
    lines = [
        f'    <point x="{x!r}" y="{y!r}" z="{z!r}" name={quoteattr(name)} active="1"/>\n' for (x, y, z), name in points
    ]
    return (
        "<!DOCTYPE PickedPoints>\n<PickedPoints>\n    <DocumentData>\n"
        f"        <DataFileName name={quoteattr(surface)}/>\n"
        f'        <templateName name=""/>\n    </DocumentData>\n{"".join(lines)}</PickedPoints>\n'
    )
