"""Landmarks in files of other programs: MeshLab's .pp, Slicer's .fcsv and .mrk.json, IDAV Landmark's .pts, Avizo's
.landmarkAscii, and TPS.

A reader takes the text and the name of a file, and returns its points as they stand there.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

from ..counts import counted
from ..errors import ParameterError
from ..file_content import json_value
from ..sentences import shortened
from .mesh_names import FREESURFER, mesh_format, mesh_name
from .whole_numbers import numbered_lines

LPS, RAS = "LPS", "RAS"
"""Slicer's coordinate systems: x and y of one are those of the other with the opposite sign."""
_SYSTEMS = {"LPS": LPS, "1": LPS, "RAS": RAS, "0": RAS}
MISSING = 9999.0
"""All three coordinates of a landmark that IDAV Landmark writes without a position."""
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


@dataclass(frozen=True)
class Picked:
    """A pin, an anchor or a landmark as a file says it.

    Attributes
    ----------
    where
        Its place in the file, in words.
    id, vertex, position
        None where the file does not say them; with neither a vertex nor a position it is left out.
    name, value
        Its name, which may be empty, and the value of an anchor.
    group
        The name of its set of landmarks in a file of several.
    system
        LPS or RAS if the file says one, "" otherwise.
    """

    where: str
    id: int | None
    vertex: int | None
    position: tuple[float, ...] | None
    name: str
    value: float | None = None
    group: str = ""
    system: str = ""


def cut(value: Any) -> str:
    """Return a value as a message shows it."""
    return shortened(repr(value), 60)


def position_of(words: Sequence[Any], where: str) -> tuple[float, ...]:
    """Return a position of three finite numbers; ParameterError for anything else."""
    try:
        numbers = tuple(float(word) for word in words)
    except (TypeError, ValueError, OverflowError):
        numbers = ()
    # Of larger numbers the square is infinite, and so are distances.
    if len(numbers) != 3 or not all(abs(number) < 1e150 for number in numbers):
        shown = ", ".join(shortened(str(word), 30) or "nothing" for word in words[:4])
        raise ParameterError(f"{where}: the position ({shown}) is not three finite numbers.")
    return numbers


def are_numbers(words: Iterable[str]) -> bool:
    """Return whether all words are decimal numbers."""
    return all(_NUMBER.fullmatch(word) for word in words)


def _count(text: str, where: str) -> int:
    if not re.fullmatch(r"[0-9]{1,9}", text.strip()):
        raise ParameterError(f"{where}: {cut(text.strip())} is not a number of landmarks.")
    return int(text)


def _check_count(found: Sequence[object], count: int, name: str) -> None:
    if len(found) != count:
        raise ParameterError(f"{name} says that it has {count:,} landmarks, and has {len(found):,}.")


# ---------------------------------------------------------------------- MeshLab
def read_pp(text: str, name: str) -> list[Picked]:
    """Read MeshLab's picked points that are active."""
    if "<!ENTITY" in text:
        raise ParameterError(f"{name} defines XML entities, which files of picked points do not.")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ParameterError(f"{name}, line {error.position[0]}: this is not XML ({error}).") from None
    if root.tag != "PickedPoints":
        raise ParameterError(f"{name} holds {cut(root.tag)}, not MeshLab's PickedPoints.")
    found = []
    for k, point in enumerate(root.iter("point"), 1):
        # Points of a template that have not been picked yet.
        if point.get("active", "1") != "0":
            where = f"{name}, point {k}"
            words = [point.get(axis, "") for axis in "xyz"]
            found.append(Picked(where, None, None, position_of(words, where), point.get("name", "")))
    return found


# ---------------------------------------------------------------------- Slicer
def read_fcsv(text: str, name: str) -> list[Picked]:
    """Read Slicer's fiducials; coordinates are RAS where an old file does not say so."""
    columns, system = ["id", "x", "y", "z"], RAS
    found = []
    for number, line in numbered_lines(text):
        where = f"{name}, line {number}"
        key, _, value = line.removeprefix("#").partition("=")
        if not line.startswith("#"):
            row = dict(zip(columns, next(csv.reader([line])), strict=False))
            at = position_of([row.get(axis, "") for axis in "xyz"], where)
            found.append(Picked(where, None, None, at, row.get("label", ""), system=system))
        elif key.strip() == "columns":
            columns = [word.strip().lower() for word in value.split(",")]
            if not {"x", "y", "z"} <= set(columns):
                raise ParameterError(f"{where}: the columns {cut(value.strip())} are without x, y or z.")
        elif key.strip() == "CoordinateSystem":
            system = _system(value.strip(), where)
    return found


def _system(word: Any, where: str) -> str:
    if not isinstance(word, str) or word not in _SYSTEMS:
        raise ParameterError(f"{where}: the coordinate system {cut(word)} is neither LPS nor RAS.")
    return _SYSTEMS[word]


def read_markups(text: str, name: str) -> list[Picked]:
    """Read the markups of a text in JSON."""
    return markups(json_in(text, name), name)


def json_in(text: str, name: str) -> Any:
    """Return the value of a text in JSON; ParameterError, which names the file, where there is none."""
    try:
        return json_value(text)
    except ParameterError as error:
        raise ParameterError(f"{name}: {error}") from None


def markups(content: Any, name: str) -> list[Picked]:
    """Read the control points of Slicer's markups, a value of JSON, each of them a set of landmarks."""
    found = []
    for number, markup in enumerate(_list_in(content, "markups", name), 1):
        where = f"{name}, markup {number}"
        points = _list_in(markup, "controlPoints", where)
        system = _system(markup.get("coordinateSystem", LPS), where)
        for k, point in enumerate(points, 1):
            there = f"{where}, point {k}"
            if not isinstance(point, dict) or not isinstance(label := point.get("label", ""), str):
                raise ParameterError(f"{there}: {cut(point)} is not a control point.")
            at = None
            if point.get("positionStatus", "defined") == "defined":
                at = point.get("position")
                if not isinstance(at, list) or not all(type(x) in (int, float) for x in at):
                    raise ParameterError(f"{there}: the position {cut(at)} is not three finite numbers.")
                at = position_of(at, there)
            found.append(Picked(there, None, None, at, label, group=f"markup {number}", system=system))
    return found


def _list_in(value: Any, key: str, where: str) -> list[Any]:
    found = value.get(key) if isinstance(value, dict) else None
    if not isinstance(found, list):
        raise ParameterError(f"{where} holds no list of {key}.")
    return found


# ---------------------------------------------------------------------- IDAV Landmark
def read_pts(text: str, name: str) -> list[Picked]:
    """Read landmarks of IDAV Landmark, a name and a position on each line."""
    lines = numbered_lines(text)
    if len(lines) < 2 or not lines[0][1].lower().startswith("version"):
        raise ParameterError(f"{name} does not begin with IDAV Landmark's `Version 1.0` and a number of landmarks.")
    count, found = _count(lines[1][1], f"{name}, line {lines[1][0]}"), []
    for number, line in lines[2:]:
        where, words = f"{name}, line {number}", line.rsplit(None, 3)
        at = position_of(words[-3:], where)
        is_there = any(coordinate != MISSING for coordinate in at)
        found.append(Picked(where, None, None, at if is_there else None, words[0] if len(words) > 3 else ""))
    _check_count(found, count, name)
    return found


# ---------------------------------------------------------------------- Avizo
def read_landmark_ascii(text: str, name: str) -> list[Picked]:
    """Read Avizo's and Amira's landmarks; a file has one set of them, or several of as many."""
    count = re.search(r"^\s*define\s+Markers\s+(\S+)", text, re.MULTILINE)
    sets = re.findall(r"^\s*Markers\s*\{\s*(?:float|double)\[3\]\s+Coordinates\d*\s*\}\s*=?\s*@(\d+)", text, re.M)
    if not count or not sets:
        raise ParameterError(f"{name} has no Markers with Coordinates, as Avizo's landmarks in text have.")
    n, found = _count(count[1], name), list[Picked]()
    rows: dict[str, list[tuple[int, str]]] = {}
    for number, line in numbered_lines(text):
        if re.fullmatch(r"@\d+", line):
            rows[section := line[1:]] = []
        elif rows:
            rows[section].append((number, line))
    for number, section in enumerate(sets, 1):
        lines = rows.get(section, [])
        _check_count(lines, n, name)
        for at_line, line in lines:
            where = f"{name}, line {at_line}"
            found.append(Picked(where, None, None, position_of(line.split(), where), "", group=f"set {number}"))
    return found


# ---------------------------------------------------------------------- TPS
def read_tps(text: str, name: str) -> list[Picked]:
    """Read the landmarks of a TPS file times their scale; each specimen is a set, named by its ID or its image."""
    specimens: list[tuple[dict[str, str], list[tuple[str, list[str]]]]] = []
    left = skipped = 0
    for number, line in numbered_lines(text):
        where = f"{name}, line {number}"
        key, equals, value = (part.strip() for part in line.partition("="))
        if equals and key.upper() == "LM":
            raise ParameterError(f"{where}: LM= are landmarks in a picture, without z; those of a surface are LM3=.")
        if left and equals:
            raise ParameterError(f"{where}: {counted(left, 'landmark')} missing before {cut(line)}.")
        if equals and key.upper() == "LM3":
            left = _count(value, where)
            specimens.append(({}, []))
        elif equals and specimens:
            # Of curves, which are no landmarks.
            skipped = _count(value, where) if key.upper().startswith("POINTS") else 0
            specimens[-1][0].setdefault(key.upper(), value)
        elif left:
            specimens[-1][1].append((where, line.split()))
            left -= 1
        elif skipped:
            skipped -= 1
        else:
            raise ParameterError(f"{where}: {cut(line)} is not of a TPS file, which begins with LM3= and a number.")
    if left:
        raise ParameterError(f"{name} ends before {left:,} of its landmarks.")
    found = []
    for number, (says, rows) in enumerate(specimens, 1):
        scale, group = says.get("SCALE", "1"), says.get("ID") or mesh_name(says.get("IMAGE", "")) or str(number)
        if not are_numbers([scale]):
            raise ParameterError(f"{name}: the scale {cut(scale)} of specimen {cut(group)} is not a number.")
        for where, words in rows:
            is_there = any(word.upper() not in ("NA", "NAN") for word in words)
            at = position_of([x * float(scale) for x in position_of(words, where)], where) if is_there else None
            found.append(Picked(where, None, None, at, "", group=group))
    return found


# ---------------------------------------------------------------------- output
Named = Sequence[tuple[list[float], str]]
"""Positions and their names."""


def written_pp(points: Named, surface: str) -> str:
    """Write MeshLab's picked points."""
    lines = [
        f'    <point x="{x!r}" y="{y!r}" z="{z!r}" name={quoteattr(name)} active="1"/>\n' for (x, y, z), name in points
    ]
    return (
        "<!DOCTYPE PickedPoints>\n<PickedPoints>\n    <DocumentData>\n"
        f"        <DataFileName name={quoteattr(surface)}/>\n"
        f'        <templateName name=""/>\n    </DocumentData>\n{"".join(lines)}</PickedPoints>\n'
    )


def _system_of(surface: str) -> str:
    """Return the coordinate system of a mesh by its format: neuroimaging's have RAS, Slicer takes others for LPS."""
    return RAS if mesh_format(surface) in (".gii", FREESURFER) else LPS


def written_fcsv(points: Named, surface: str) -> str:
    """Write Slicer's fiducials."""
    columns = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID"
    lines = io.StringIO()
    rows = ([str(k), *map(repr, at), 0, 0, 0, 1, 1, 1, 0, name, "", ""] for k, (at, name) in enumerate(points, 1))
    csv.writer(lines, lineterminator="\n").writerows(rows)
    head = (
        f"# Markups fiducial file version = 4.11\n# CoordinateSystem = {_system_of(surface)}\n# columns = {columns}\n"
    )
    return head + lines.getvalue()


def written_markups(points: Named, surface: str) -> str:
    """Write Slicer's markups."""
    schema = "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
    controls = [{"id": str(k), "label": name, "position": at} for k, (at, name) in enumerate(points, 1)]
    markup = {"type": "Fiducial", "coordinateSystem": _system_of(surface), "controlPoints": controls}
    content = {"@schema": f"{schema}markups-schema-v1.0.0.json#", "markups": [markup]}
    return f"{json.dumps(content, ensure_ascii=False, indent=1)}\n"


def written_pts(points: Named, surface: str) -> str:
    """Write landmarks of IDAV Landmark."""
    return f"Version 1.0\n{len(points)}\n" + "".join(f"{_one_line(name)} {_row(at)}" for at, name in points)


def written_landmark_ascii(points: Named, surface: str) -> str:
    """Write Avizo's landmarks, which have no names."""
    return (
        f"# Avizo 3D ASCII 2.0\n\ndefine Markers {len(points)}\n\n"
        'Parameters {\n    NumSets 1,\n    ContentType "LandmarkSet"\n}\n\n'
        f"Markers {{ float[3] Coordinates }} @1\n\n# Data section follows\n@1\n{''.join(_row(at) for at, _ in points)}"
    )


def written_tps(points: Named, surface: str) -> str:
    """Write a TPS file of one specimen, whose landmarks have no names."""
    return f"LM3={len(points)}\n{''.join(_row(at) for at, _ in points)}ID={_one_line(mesh_name(surface))}\n"


def _row(at: Sequence[float]) -> str:
    return " ".join(map(repr, at)) + "\n"


def _one_line(name: str) -> str:
    return " ".join(name.split())


# ---------------------------------------------------------------------- formats
@dataclass(frozen=True)
class LandmarkFormat:
    """A format of landmarks: its reader and writer, how its texts begin, and whether its landmarks have names."""

    read: Callable[[str, str], list[Picked]]
    written: Callable[[Named, str], str]
    begins: tuple[str, ...]
    has_names: bool = True


LANDMARKS = {
    ".pp": LandmarkFormat(read_pp, written_pp, ("<",)),
    ".fcsv": LandmarkFormat(read_fcsv, written_fcsv, ("# markups fiducial", "# fiducial list")),
    ".mrk.json": LandmarkFormat(read_markups, written_markups, ()),
    ".pts": LandmarkFormat(read_pts, written_pts, ("version",)),
    ".landmarkAscii": LandmarkFormat(read_landmark_ascii, written_landmark_ascii, ("# avizo", "# amira"), False),
    ".tps": LandmarkFormat(read_tps, written_tps, ("lm3=", "lm="), False),
}
"""All formats by their extensions."""
