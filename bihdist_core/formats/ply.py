"""PLY files, text and binary of both byte orders: a strict reader.

Vertices come from the element `vertex` (x, y, z), polygons from the lists `vertex_indices` or `vertex_index` of the
element `face`, or triangle strips from `tristrips`; everything else is read over.  Vertex ids are the file's, also
where faces carry texture coordinates of their own.
"""

import re
import struct
from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from ..arrays import AnyArray, BoolArray, FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from .mesh_text import mesh_text
from .polygons import Polygons, checked_corners, runs, strip_triangles, whole_numbers
from .text_lines import TextLines, shown

_TYPES = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"},
    **{"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"},
    **{"float": "f4", "double": "f8", "float32": "f4", "float64": "f8"},
}
_LINE_END = re.compile(rb"\r\n|\n\r|\n|\r")
_IDS = ("vertex_indices", "vertex_index")
_NO_VALUES = {*"xyzstuv", "nx", "ny", "nz", "red", "green", "blue", "alpha"}


@dataclass
class _Property:
    name: str
    kind: str
    count_kind: str = ""
    """Type of the number of entries; empty for a property that is one number."""


@dataclass
class _Element:
    name: str
    count: int
    properties: list[_Property] = field(default_factory=list)


_Column = AnyArray | tuple[IntArray, AnyArray]
"""(count,) numbers, or (count,) sizes and (sum of sizes,) entries of lists."""


def read_ply(raw: bytes, name: str) -> Polygons:
    """Read the polygons of a PLY file; MeshError where it is none, or does not hold what its header announces."""
    order, elements, bodies = _header(raw, name)
    if order is None and (plain := _read_plain(raw, elements, bodies[0])):
        return plain
    columns = _body(raw, order, elements, bodies, name)
    vertex = columns.get("vertex", {})
    missing = [axis for axis in "xyz" if not isinstance(vertex.get(axis), np.ndarray)]
    if missing:
        raise MeshError(f"{name} has no vertex property {missing[0]}; a surface needs the coordinates x, y and z.")
    vertices = np.stack([np.asarray(vertex[axis], np.float64) for axis in "xyz"], axis=1)
    lists = next((columns["face"][key] for key in _IDS if key in columns.get("face", {})), None)
    if isinstance(lists, tuple):
        sizes, values = lists
        return Polygons(vertices, sizes, checked_corners(values, sizes, len(vertices), lambda k: f"{name}: face {k}"))
    strips = next((columns["tristrips"][key] for key in _IDS if key in columns.get("tristrips", {})), None)
    if isinstance(strips, tuple):
        return _from_strips(vertices, strips[1], name)
    if len(columns.get("face", {})):
        held = counted(len(vertices), "vertex", "vertices")
        raise MeshError(f"{name} has {held} but no faces (no list vertex_indices).")
    return Polygons(vertices, np.empty(0, np.int64), np.empty(0, np.int64))


def ply_values(raw: bytes, name: str) -> dict[str, AnyArray]:
    """Read the properties (n,) of the vertices of a PLY file by name, without places, normals, colours and textures.

    MeshError as of `read_ply`.
    """
    vertex = _body(raw, *_header(raw, name), name).get("vertex", {})
    return {key: each for key, each in vertex.items() if isinstance(each, np.ndarray) and key not in _NO_VALUES}


def _body(
    raw: bytes, order: str | None, elements: list[_Element], bodies: list[int], name: str
) -> dict[str, dict[str, _Column]]:
    if order is None:
        return _text_body(raw[bodies[0] :], elements, name)
    return _binary_body(raw, bodies, order, elements, name)


def _from_strips(vertices: FloatArray, values: FloatArray, name: str) -> Polygons:
    """Return the triangles of strips, which -1 ends."""
    whole, _ = whole_numbers(values)
    breaks = np.append(np.flatnonzero(whole == -1), len(whole))
    sizes = np.diff(np.append(-1, breaks)) - 1
    ids = checked_corners(values[whole != -1], sizes, len(vertices), lambda k: f"{name}: strip {k}")
    faces = strip_triangles(sizes, ids)
    fact = f"{counted(int((sizes > 0).sum()), 'triangle strip')} divided into {counted(len(faces), 'triangle')}"
    return Polygons(vertices, np.full(len(faces), 3), faces.ravel(), facts=(fact,))


def _header(raw: bytes, name: str) -> tuple[str | None, list[_Element], list[int]]:
    """Return the byte order ('<', '>', None for text), the elements, and where the body may begin, likely places
    first."""
    found = re.match(rb"(?:\xef\xbb\xbf)?ply[ \t]*(?=[\r\n])", raw)
    if not found:
        raise MeshError(f"{name} is not a PLY file: it does not begin with the line 'ply'.")
    end = re.compile(rb"[\r\n]end_header[ \t]*(?=[\r\n])").search(raw)
    if not end:
        raise MeshError(f"{name} is cut off or damaged: its header has no line 'end_header'.")
    head = raw[found.end() : end.start() + 1]
    # What follows may be a longer or a shorter line end, and the body's first byte: most likely one of those before.
    used = [each for each, _ in Counter(_LINE_END.findall(head)).most_common()]
    ends = [each for each in (*used, b"\r\n", b"\n\r", b"\n", b"\r") if raw.startswith(each, end.end())]
    order: str | None = ""
    elements: list[_Element] = []
    for number, line in enumerate(_LINE_END.split(head)[1:], 2):
        words = line.decode("utf-8", "replace").split()
        match words:
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["format", "ascii" | "binary_little_endian" | "binary_big_endian", _]:
                order = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}[words[1]]
            case ["element", kind, count] if re.fullmatch("[0-9]{1,18}", count):
                if any(e.name == kind for e in elements):
                    raise MeshError(f"{name}, line {number}: the element {kind} is announced twice.")
                elements.append(_Element(kind, int(count)))
            case ["property", kind, key] if kind in _TYPES and elements:
                elements[-1].properties.append(_Property(key, _TYPES[kind]))
            case ["property", "list", counts, kind, key] if {counts, kind} <= _TYPES.keys() and elements:
                elements[-1].properties.append(_Property(key, _TYPES[kind], _TYPES[counts]))
            case _:
                raise MeshError(f"{name}, line {number}: {shown(line)} is not a line of a PLY header.")
    if order == "":
        raise MeshError(f"{name} does not say in its header whether it is text or binary (no line 'format').")
    return order, elements, [end.end() + len(each) for each in dict.fromkeys(ends)]


def _list_sizes(values: FloatArray, element: _Element, name: str) -> IntArray:
    sizes, bad = whole_numbers(values)
    bad |= sizes < 0
    if bad.any():
        k = int(np.argmax(bad))
        raise MeshError(f"{name}: {element.name} {k} announces a list of {values[k]:.16g} entries.")
    return sizes


# ---------------------------------------------------------------------- text
def _read_plain(raw: bytes, elements: list[_Element], body: int) -> Polygons | None:
    """Read the polygons by the compiled kernel; None if it leaves the file to the other reader."""
    match [element for element in elements if element.properties]:
        case [_Element("vertex", n, columns), _Element("face", p, [ids])]:
            names = [column.name for column in columns if not column.count_kind]
            if names[:3] == ["x", "y", "z"] and len(columns) == len(set(names)) and ids.count_kind and ids.name in _IDS:
                found = mesh_text("read_lists", (0, n, p, False), raw, [len(columns)], begin=body)
                return Polygons(found.vertices, found.sizes, found.corners) if found else None
    return None


def _text_body(body: bytes, elements: list[_Element], name: str) -> dict[str, dict[str, _Column]]:
    lines = TextLines(body, f"{name} (after the header)")
    elements = [e for e in elements if e.properties]
    announced = sum(e.count for e in elements)
    if len(lines) != announced:
        if found := _text_row(lines, elements):
            return found
        what = " and ".join(f"{e.count} of {e.name}" for e in elements) or "nothing"
        raise MeshError(
            f"{name} announces {what}, one a line, but {len(lines):,} lines follow: "
            f"{'the file is cut off or its' if len(lines) < announced else 'its'} counts are wrong."
        )
    columns, low = {}, 0
    for element in elements:
        rows = lines.numbers((np.arange(len(lines)) >= low) & (np.arange(len(lines)) < low + element.count))
        low += element.count
        # `at` walks through the numbers of all lines at once.
        at, end, of_element = rows.first[:-1].copy(), rows.first[1:], {}
        column: _Column
        for item in element.properties:
            _enough(at + 1 <= end, element, name)
            value = column = rows.values[at]
            at += 1
            if item.count_kind:
                sizes = _list_sizes(value, element, name)
                _enough(sizes <= end - at, element, name)
                column = (sizes, rows.values[runs(at, sizes)])
                at += sizes
            of_element[item.name] = column
        _enough(at == end, element, name)
        columns[element.name] = of_element
    return columns


def _text_row(lines: TextLines, elements: list[_Element]) -> dict[str, dict[str, _Column]] | None:
    """Return the columns of a text with lines that end anywhere, as one row of numbers.

    None unless that fits to the last.
    """
    if sum(e.count * len(e.properties) for e in elements) > lines.word_count.sum():
        return None
    try:
        values = lines.numbers(np.ones(len(lines), bool)).values
    except MeshError:
        return None
    columns: dict[str, dict[str, _Column]] = {}
    at = 0
    for element in elements:
        # For each property where it stands at each record.
        starts = np.empty((len(element.properties), element.count), np.int64)
        if not any(item.count_kind for item in element.properties):
            starts[:] = at + np.arange(starts.size).reshape(element.count, len(element.properties)).T
            at += starts.size
        else:
            for record in range(element.count):
                for k, item in enumerate(element.properties):
                    starts[k, record] = at
                    if at >= len(values) or (item.count_kind and not 0 <= values[at] < len(values) - at):
                        return None
                    at += 1 + (int(values[at]) if item.count_kind else 0)
        if at > len(values):
            return None
        columns[element.name] = {}
        for item, places in zip(element.properties, starts, strict=True):
            column: _Column = values[places]
            if item.count_kind:
                sizes, bad = whole_numbers(values[places])
                if bad.any():
                    return None
                column = (sizes, values[runs(places + 1, sizes)])
            columns[element.name][item.name] = column
    return columns if at == len(values) else None


def _enough(good: BoolArray, element: _Element, name: str) -> None:
    if not good.all():
        k = int(np.argmin(good))
        raise MeshError(
            f"{name}: the line of {element.name} {k} does not hold as many numbers as the header announces."
        )


# ---------------------------------------------------------------------- binary
def _binary_body(
    raw: bytes, bodies: list[int], order: str, elements: list[_Element], name: str
) -> dict[str, dict[str, _Column]]:
    """Return the columns of a body, from the first place of some from which it fills the file."""
    errors = []
    for body in bodies:
        try:
            return _Binary(raw, body, order, name).read(elements)
        except MeshError as error:
            errors.append(error)
    raise errors[0]


@dataclass
class _Binary:
    raw: bytes
    at: int
    order: str
    name: str

    def read(self, elements: list[_Element]) -> dict[str, dict[str, _Column]]:
        columns = {}
        for element in elements:
            if element.properties:
                columns[element.name] = self._element(element)
        rest = self.raw[self.at :]
        if rest.strip():
            raise MeshError(f"{self.name} goes on for {len(rest)} bytes after its last element: its counts are wrong.")
        return columns

    def _element(self, element: _Element) -> dict[str, _Column]:
        least = sum(np.dtype(p.count_kind or p.kind).itemsize for p in element.properties)
        if least * element.count > len(self.raw) - self.at:
            raise self._too_short(element, (len(self.raw) - self.at) // least)
        if not element.count:
            empty = np.empty(0)
            return {p.name: (empty.astype(int), empty) if p.count_kind else empty for p in element.properties}
        return self._even(element) or self._uneven(element)

    def _too_short(self, element: _Element, held: int) -> MeshError:
        return MeshError(
            f"{self.name} announces {element.count} of {element.name} but holds at most {held}: "
            "the file is cut off or its counts are wrong."
        )

    def _even(self, element: _Element) -> dict[str, _Column] | None:
        """Return all records at once if every list is as long as in the first record, else None."""
        parts: list[tuple[str, str] | tuple[str, str, tuple[int]]] = []
        sizes, at = {}, self.at
        for k, p in enumerate(element.properties):
            if p.count_kind:
                count_type = np.dtype(self.order + p.count_kind)
                if at + count_type.itemsize > len(self.raw):
                    return None
                size = np.frombuffer(self.raw, count_type, 1, at)[0]
                if not 0 <= size <= len(self.raw) or size != int(size):
                    return None
                sizes[k] = int(size)
                parts += [(f"n{k}", self.order + p.count_kind), (f"v{k}", self.order + p.kind, (sizes[k],))]
                at += count_type.itemsize + sizes[k] * np.dtype(p.kind).itemsize
            else:
                parts.append((f"v{k}", self.order + p.kind))
                at += np.dtype(p.kind).itemsize
        if (at - self.at) * element.count > len(self.raw) - self.at or at - self.at >= 2**31:
            return None
        records = np.frombuffer(self.raw, np.dtype(parts), element.count, self.at)
        if any((records[f"n{k}"] != size).any() for k, size in sizes.items()):
            return None
        self.at += (at - self.at) * element.count
        return {
            p.name: (np.full(element.count, sizes[k]), records[f"v{k}"].ravel()) if k in sizes else records[f"v{k}"]
            for k, p in enumerate(element.properties)
        }

    def _uneven(self, element: _Element) -> dict[str, _Column]:
        """Read record by record."""
        letters = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "f4": "f", "f8": "d"}
        raw, at = self.raw, self.at
        steps = [
            (
                struct.Struct(self.order + letters[p.count_kind or p.kind]),
                np.dtype(self.order + p.kind),
                bool(p.count_kind),
            )
            for p in element.properties
        ]
        scalars: list[list[float]] = [[] for _ in steps]
        entries: list[list[bytes]] = [[] for _ in steps]
        for record in range(element.count):
            for k, (head, kind, is_list) in enumerate(steps):
                if at + head.size > len(raw):
                    raise self._too_short(element, record)
                value = head.unpack_from(raw, at)[0]
                at += head.size
                scalars[k].append(value)
                if is_list:
                    if not 0 <= value <= len(raw) or value != int(value):
                        raise MeshError(f"{self.name}: {element.name} {record} announces a list of {value:g} entries.")
                    size = int(value) * kind.itemsize
                    if at + size > len(raw):
                        raise self._too_short(element, record)
                    entries[k].append(raw[at : at + size])
                    at += size
        self.at = at
        return {
            p.name: (np.array(scalars[k]).astype(np.int64), np.frombuffer(b"".join(entries[k]), steps[k][1]))
            if p.count_kind
            else np.array(scalars[k])
            for k, p in enumerate(element.properties)
        }
