"""Legacy VTK files (.vtk), text and binary: a strict reader of polygonal data and of unstructured grids of polygons.

Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html, versions 1 to 5.  Point and cell
data are read over.  Ids are the order of the points.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from .polygons import Polygons, checked_corners, list_starts, lists_in, strip_triangles, whole_numbers
from .text_lines import parsed_numbers, plain_text, shown

_TYPES = {
    **{"unsigned_char": "u1", "char": "i1", "unsigned_short": "u2", "short": "i2", "unsigned_int": "u4", "int": "i4"},
    **{"unsigned_long": "u8", "long": "i8", "vtktypeint64": "i8", "vtktypeuint64": "u8", "vtkidtype": "i4"},
    **{"float": "f4", "double": "f8"},
}
_LOOSE = ("VERTICES", "LINES")
_CELLS = ("POLYGONS", "TRIANGLE_STRIPS", "CELLS", *_LOOSE)
_POLYGON_CELLS, _STRIP_CELL, _PIXEL_CELL = (5, 7, 9), 6, 8
_TETRAHEDRON = 10
_VOLUME_CELLS = (10, 11, 12, 13, 14, 15, 16, 24, 25, 26, 27, 29, 32, 33, 37, 41, 42, 71, 72, 73, 74)
"""Tetrahedra, voxels, hexahedra, wedges, pyramids, prisms, polyhedra, and those of higher order."""

Cells = tuple[IntArray, AnyArray]
"""(p,) sizes and (sum of sizes,) point ids as the file has them."""
NO_CELLS: Cells = (np.empty(0, np.int64), np.empty(0, np.int64))


def read_vtk(raw: bytes, name: str) -> Polygons:
    """Read the polygons of a legacy VTK file; MeshError where it is none or is cut off."""
    head = re.match(rb"(?:\xef\xbb\xbf)?# vtk DataFile Version[^\n]*\n[^\n]*\n\s*(ASCII|BINARY)[ \t\r]*\n", raw, re.I)
    if not head:
        raise MeshError(
            f"{name} is not a VTK file: it does not begin with '# vtk DataFile Version', a title and its type."
        )
    binary = head[1].upper() == b"BINARY"
    body = raw[head.end() :]
    file = _Cursor(body if binary else plain_text(body, name), name, binary)
    words = file.words()
    if [w.upper() for w in words] not in (["DATASET", "POLYDATA"], ["DATASET", "UNSTRUCTURED_GRID"]):
        raise MeshError(
            f"{name} holds {shown(' '.join(words).encode())}; only DATASET POLYDATA and UNSTRUCTURED_GRID are "
            "surfaces, so extract the surface first."
        )
    points, cells, types = _sections(file)
    if points is None:
        raise MeshError(f"{name} has no POINTS: it is cut off or holds no surface.")
    if "CELLS" in cells:
        if types is None:
            raise MeshError(f"{name} is cut off: it has CELLS but no CELL_TYPES.")
        cells = cells_by_type(cells["CELLS"], types, name)
    return polygons_of_cells(points, cells, name)


def polygons_of_cells(points: FloatArray, cells: Mapping[str, Cells], name: str) -> Polygons:
    """Return polygons, then the triangles of strips, or, if there are any, tetrahedra; all other kinds of cells are
    counted and left out."""
    solids, solid_corners = cells.get("TETRAHEDRA", NO_CELLS)
    if len(solids):
        ids = checked_corners(solid_corners, solids, len(points), lambda k: f"{name}: tetrahedron {k}")
        rest = sum(len(each[0]) for each in cells.values()) - len(solids)
        facts = (f"{counted(rest, 'cell')} other than tetrahedra ignored",) if rest else ()
        none = np.empty(0, np.int64)
        return Polygons(points, none, none, facts=facts, tetrahedra=ids.reshape(-1, 4))
    sizes, corners = cells.get("POLYGONS", NO_CELLS)
    ids = checked_corners(corners, sizes, len(points), lambda k: f"{name}: polygon {k}")
    left_out, divided = [], []
    strip_sizes, strip_corners = cells.get("TRIANGLE_STRIPS", NO_CELLS)
    if len(strip_sizes):
        strip_ids = checked_corners(strip_corners, strip_sizes, len(points), lambda k: f"{name}: triangle strip {k}")
        faces = strip_triangles(strip_sizes, strip_ids)
        sizes, ids = np.append(sizes, np.full(len(faces), 3)), np.append(ids, faces)
        divided.append(f"{counted(len(strip_sizes), 'triangle strip')} divided into {counted(len(faces), 'triangle')}")
    ignored = sum(len(cells[kind][0]) for kind in cells if kind not in ("POLYGONS", "TRIANGLE_STRIPS"))
    if ignored:
        left_out.append(f"{counted(ignored, 'cell')} other than polygons ignored")
    return Polygons(points, sizes, ids, tuple(left_out), tuple(divided))


@dataclass
class _Cursor:
    """A place in the file's body."""

    body: bytes
    name: str
    binary: bool
    at: int = 0
    _bounds: list[IntArray] = field(default_factory=list)

    def words(self) -> list[str]:
        """Return the words of the next line that is not blank; none at the end of the file."""
        while self.at < len(self.body):
            end = self.body.find(b"\n", self.at)
            end = len(self.body) if end < 0 else end
            line, self.at = self.body[self.at : end], end + 1
            if line.strip():
                return line.decode("latin-1").split()
        return []

    def skip_block(self) -> None:
        """Read over a METADATA block, which a blank line ends."""
        end = re.compile(rb"\n[ \t\r]*(\n|$)").search(self.body, max(self.at - 1, 0))
        self.at = end.end() if end else len(self.body)

    def numbers(self, count: int, kind: str, what: str) -> AnyArray:
        """Return (count,) numbers: binary of type `kind`, big-endian, or the next words of a text."""
        if kind.lower() not in _TYPES:
            raise MeshError(f"{self.name}: {what} are of the type {kind[:40]!r}, which is not read.")
        dtype = np.dtype(">" + _TYPES[kind.lower()])
        return self._binary(count, dtype, what) if self.binary else self._text(count, what)

    def _binary(self, count: int, dtype: np.dtype, what: str) -> AnyArray:
        held = (len(self.body) - self.at) // dtype.itemsize
        if count > held:
            raise self._too_short(count, max(held, 0), what)
        values = np.frombuffer(self.body, dtype, count, self.at)
        self.at += count * dtype.itemsize
        return values

    def _text(self, count: int, what: str) -> FloatArray:
        if not self._bounds:
            dark = np.frombuffer(self.body, np.uint8) > 32
            change = np.flatnonzero(np.diff(np.concatenate([[0], dark.astype(np.int8), [0]])))
            self._bounds = [change[::2], change[1::2]]
        starts, ends = self._bounds
        first = int(np.searchsorted(starts, self.at))
        if first + count > len(starts):
            raise self._too_short(count, len(starts) - first, what)
        if not count:
            return np.empty(0)
        begin, self.at = self.at, int(ends[first + count - 1])
        return parsed_numbers(self.body[begin : self.at], self.name, what)

    def _too_short(self, count: int, held: int, what: str) -> MeshError:
        return MeshError(
            f"{self.name} announces {count:,} numbers of {what} but at most {held} follow: "
            "the file is cut off or its counts are wrong."
        )


def _count(words: list[str], place: int, file: _Cursor) -> int:
    if len(words) <= place or not re.fullmatch("[0-9]{1,15}", words[place]):
        raise MeshError(f"{file.name}: {shown(' '.join(words).encode())} lacks a count.")
    return int(words[place])


def _sections(file: _Cursor) -> tuple[FloatArray | None, dict[str, Cells], AnyArray | None]:
    points, types, cells = None, None, {}
    while words := file.words():
        key = words[0].upper()
        if key == "POINTS" and points is None:
            n = _count(words, 1, file)
            kind = words[2] if len(words) > 2 else "float"
            points = file.numbers(3 * n, kind, "POINTS").reshape(-1, 3).astype(np.float64)
        elif key in _CELLS and key not in cells:
            cells[key] = _cells(words, file)
        elif key == "CELL_TYPES" and types is None:
            types = whole_numbers(file.numbers(_count(words, 1, file), "int", "CELL_TYPES"))[0]
        elif key == "METADATA":
            file.skip_block()
        elif key == "FIELD":
            for _ in range(min(_count(words, 2, file), 1000)):
                array = file.words()
                size = _count(array, 1, file) * _count(array, 2, file)
                file.numbers(size, array[3] if len(array) > 3 else "", f"the field {array[0][:40]}")
        elif key in ("POINT_DATA", "CELL_DATA"):
            break
        else:
            raise MeshError(f"{file.name}: {shown(' '.join(words).encode())} is not a section of a VTK surface file.")
    return points, cells, types


def _cells(words: list[str], file: _Cursor) -> Cells:
    what, count, size = words[0].upper(), _count(words, 1, file), _count(words, 2, file)
    back = file.at
    following = file.words()
    if following[:1] == ["OFFSETS"]:
        offsets = whole_numbers(file.numbers(count, " ".join(following[1:2]), f"{what} offsets"))[0]
        following = file.words()
        if following[:1] != ["CONNECTIVITY"]:
            raise MeshError(f"{file.name}: {what} have OFFSETS but no CONNECTIVITY.")
        corners = file.numbers(size, " ".join(following[1:2]), what)
        return cells_of_offsets(offsets, corners, f"{file.name}: {what}")
    file.at = back
    values, bad = whole_numbers(file.numbers(size, "int", what))
    if (found := lists_in(values, count)) is not None and not bad.any():
        return found
    starts = list_starts(values, count)
    if len(starts) < min(count, size):
        raise MeshError(f"{file.name}: cell {len(starts)} of {what} does not fit into the {size:,} numbers announced.")
    raise MeshError(f"{file.name}: {count:,} {what} do not fill the {size:,} numbers announced; the counts are wrong.")


def cells_of_offsets(offsets: IntArray, corners: AnyArray, where: str) -> Cells:
    """Return cells given by the (p + 1,) places where each begins, 0 first, and the number of corners last."""
    if not len(offsets):
        offsets = np.zeros(1, np.int64)
    sizes = np.diff(offsets)
    if offsets[0] != 0 or offsets[-1] != len(corners) or (sizes < 0).any():
        raise MeshError(f"{where}: the offsets of the cells do not fit their {len(corners):,} corners.")
    return sizes, corners


def cells_by_type(cells: Cells, types: IntArray, name: str) -> dict[str, Cells]:
    """Return the cells of a grid by their kinds; MeshError where there are volumes, but no polygons or tetrahedra."""
    sizes, corners = cells
    if len(types) != len(sizes):
        raise MeshError(f"{name} has {len(sizes):,} cells and {len(types):,} types of cells.")
    pixel = np.flatnonzero((types == _PIXEL_CELL) & (sizes == 4))
    if len(pixel):
        # A pixel's corners come row by row, not around.
        corners = corners.copy()
        last = (np.cumsum(sizes) - 1)[pixel]
        corners[last], corners[last - 1] = corners[last - 1], corners[last]
    polygon = np.isin(types, _POLYGON_CELLS)
    polygon[pixel] = True
    strip, volumes = types == _STRIP_CELL, int(np.isin(types, _VOLUME_CELLS).sum())
    solid = (types == _TETRAHEDRON) & (sizes == 4) & ~(polygon | strip).any()
    if volumes and not (polygon | strip | solid).any():
        raise MeshError(f"{name} holds only volume cells ({volumes:,}), no tetrahedra; extract the surface first.")
    chosen = {"POLYGONS": polygon, "TRIANGLE_STRIPS": strip, "TETRAHEDRA": solid, "other": ~(polygon | strip | solid)}
    return {kind: (sizes[mask], corners[np.repeat(mask, sizes)]) for kind, mask in chosen.items()}
