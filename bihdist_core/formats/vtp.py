"""VTP and VTU files (VTK's XML formats for polygonal data and for grids of cells): a strict reader of polygons,
and a writer of points, lines and polygons.

Text, base64 and raw appended arrays, plain or compressed with zlib, LZ4 or LZMA, of either byte order; pieces are put
one after the other.  Ids are the order of the points.  Point data are read where they are asked for, cell data are not.
"""

import base64
import binascii
import lzma
import re
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import BinaryIO
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import MeshError
from .compression import unpacked_block
from .polygons import Polygons, whole_numbers
from .text_lines import parsed_numbers, xml_root
from .vtk import Cells, cells_by_type, cells_of_offsets, polygons_of_cells

_TYPES = {f"{sign}Int{8 * size}": f"{sign.lower() or 'i'}{size}" for sign in ("", "U") for size in (1, 2, 4, 8)}
_TYPES |= {"Float32": "f4", "Float64": "f8"}
_KINDS = {"Polys": "POLYGONS", "Strips": "TRIANGLE_STRIPS", "Lines": "LINES", "Verts": "VERTICES"}
_GRID = {"Cells": "CELLS"}
_CELL_TYPES = {1: 1, 3: 5, 4: 10}
"""Of triangles and tetrahedra, by their corners."""


def read_vtp(raw: bytes, name: str) -> Polygons:
    """Read the polygons of a VTP or VTU file; MeshError where it is none or is cut off."""
    file = _opened(raw, name)
    grids, pieces = _pieces(file)
    points: list[FloatArray] = []
    cells: dict[str, list[Cells]] = {}
    types: list[IntArray] = []
    before = 0
    for piece in pieces:
        points.append(_points(file, piece))
        for tag, kind in (_GRID if grids else _KINDS).items():
            sizes, corners = _cells(file, piece, tag)
            bad = (corners < 0) | (corners >= len(points[-1]))
            if bad.any():
                last = len(points[-1]) - 1
                raise MeshError(f"{name}: a cell of {tag} names point {corners[bad][0]}, but ids run from 0 to {last}.")
            cells.setdefault(kind, []).append((sizes, corners + before))
        types += [_types(file, piece)] if grids else []
        before += len(points[-1])
    joined = {
        kind: (np.concatenate([sizes for sizes, _ in parts]), np.concatenate([corners for _, corners in parts]))
        for kind, parts in cells.items()
    }
    if types:
        joined = cells_by_type(joined["CELLS"], np.concatenate(types), name)
    return polygons_of_cells(np.concatenate(points), joined, name)


def vtp_values(raw: bytes, name: str) -> dict[str, AnyArray]:
    """Read the point data (n,) of a VTP or VTU file by name; MeshError as of `read_vtp`.

    Arrays with several components, and those that not all pieces have, are left out.
    """
    file = _opened(raw, name)
    _, pieces = _pieces(file)
    found: dict[str, list[AnyArray]] = {}
    for piece in pieces:
        n = _announced(file, piece, "NumberOfPoints")
        for element in piece.findall("PointData/DataArray"):
            word = element.get("Name", "")
            if element.get("NumberOfComponents", "1") == "1" and element.get("type") in _TYPES:
                found.setdefault(word, []).append(file.array(element, n, f"values of {word[:40]!r}"))
    return {word: np.concatenate(parts) for word, parts in found.items() if len(parts) == len(pieces)}


def _pieces(file: "_File") -> tuple[list[ElementTree.Element], list[ElementTree.Element]]:
    """Return the pieces that are grids of cells, if there are any, and all pieces; MeshError if there is none."""
    grids = file.root.findall("UnstructuredGrid/Piece")
    pieces = grids or file.root.findall("PolyData/Piece")
    if not pieces:
        raise MeshError(f"{file.name} holds no piece of PolyData or of an UnstructuredGrid; only these are surfaces.")
    return grids, pieces


@dataclass
class _File:
    """The XML tree, what its root says about binary arrays, and the appended bytes."""

    name: str
    root: ElementTree.Element
    order: str
    length: np.dtype
    decompress: str
    appended: bytes
    base64: bool

    def array(self, element: ElementTree.Element, count: int | None, what: str) -> AnyArray:
        """Return the numbers of a DataArray; MeshError unless there are `count` of them (None: any number)."""
        kind = element.get("type", "")
        if kind not in _TYPES:
            raise MeshError(f"{self.name}: {what} have the type {kind[:40]!r}, which is not read.")
        dtype = np.dtype(self.order + _TYPES[kind])
        match element.get("format", "ascii"):
            case "ascii":
                values = parsed_numbers((element.text or "").encode(), self.name, what)
            case "binary":
                values = self._numbers(_from_base64((element.text or "").encode(), f"{self.name}: {what}"), dtype, what)
            case "appended" if re.fullmatch("[0-9]{1,15}", element.get("offset", "")):
                content = self.appended[int(element.get("offset", "")) :]
                if self.base64:
                    content = _from_base64(self._until_next(element), f"{self.name}: {what}")
                values = self._numbers(content, dtype, what)
            case form:
                raise MeshError(f"{self.name}: {what} have the format {form[:40]!r}, which is not read.")
        if count is not None and len(values) != count:
            raise MeshError(f"{self.name} announces {count:,} numbers of {what} but holds {len(values):,}.")
        return values

    def _until_next(self, element: ElementTree.Element) -> bytes:
        start = int(element.get("offset", ""))
        offsets = [int(e.get("offset", "")) for e in self.root.iter("DataArray") if e.get("offset", "").isdecimal()]
        return self.appended[start : min((o for o in offsets if o > start), default=len(self.appended))]

    def _numbers(self, content: bytes, dtype: np.dtype, what: str) -> AnyArray:
        content = self._decompressed(content, what) if self.decompress else self._plain(content, what)
        if len(content) % dtype.itemsize:
            raise MeshError(
                f"{self.name}: {what} have {len(content)} bytes, not a multiple of {dtype.itemsize} ({dtype.name})."
            )
        return np.frombuffer(content, dtype)

    def _lengths(self, content: bytes, first: int, count: int, what: str) -> list[int]:
        if (first + count) * self.length.itemsize > len(content):
            raise self._cut_off(what)
        return [int(v) for v in np.frombuffer(content, self.length, count, first * self.length.itemsize)]

    def _plain(self, content: bytes, what: str) -> bytes:
        head = self.length.itemsize
        size = self._lengths(content, 0, 1, what)[0]
        if size > len(content) - head:
            raise self._cut_off(what)
        return content[head : head + size]

    def _decompressed(self, content: bytes, what: str) -> bytes:
        """Unpack blocks behind their number, size, size of the last (0 if whole) and their compressed sizes."""
        blocks = self._lengths(content, 0, 1, what)[0]
        if not blocks:
            return b""
        _, size, last, *packed = self._lengths(content, 0, 3 + blocks, what)
        at, parts = (3 + blocks) * self.length.itemsize, []
        for k, length in enumerate(packed):
            expected = last if k == blocks - 1 and last else size
            if at + length > len(content):
                raise self._cut_off(what)
            # At most the announced size is unpacked, so that a damaged file cannot fill the memory.
            packed_block = content[at : at + length]
            try:
                if self.decompress == "zlib":
                    part = zlib.decompressobj().decompress(packed_block, max(expected, 1))
                elif self.decompress == "lz4":
                    part = unpacked_block(packed_block, expected)
                else:
                    part = lzma.LZMADecompressor().decompress(packed_block, max(expected, 1))
            except (zlib.error, lzma.LZMAError, ValueError, OverflowError) as error:
                raise MeshError(f"{self.name}: the compressed {what} are damaged ({error}).") from None
            if len(part) != expected:
                raise self._cut_off(what)
            parts.append(part)
            at += length
        return b"".join(parts)

    def _cut_off(self, what: str) -> MeshError:
        return MeshError(f"{self.name}: the {what} are shorter than announced; the file is cut off or damaged.")


def _opened(raw: bytes, name: str) -> _File:
    if b"<!DOCTYPE" in raw[:4096] or b"<!ENTITY" in raw[:4096]:
        raise MeshError(f"{name} declares XML entities, which no VTK file needs; it is not read.")
    # Appended bytes are no XML: they are taken out before the rest is parsed.
    found = re.search(rb"<AppendedData([^>]*)>\s*_", raw)
    tree, appended, coded = raw, b"", False
    if found:
        end = raw.rfind(b"</AppendedData>")
        if end < found.end():
            raise MeshError(f"{name} is cut off: its appended data do not end.")
        tree, appended = raw[: found.start()] + raw[end + len(b"</AppendedData>") :], raw[found.end() : end]
        coded = b"base64" in found[1]
    root = xml_root(tree, name, "an XML file of VTK's", "VTKFile")
    compressor = root.get("compressor", "")
    known = {f"vtk{word}DataCompressor": word.lower() for word in ("ZLib", "LZ4", "LZMA")} | {"": ""}
    if compressor not in known:
        raise MeshError(f"{name} is compressed by {compressor[:40]!r}, which is not read; save it with zlib.")
    order = ">" if root.get("byte_order") == "BigEndian" else "<"
    length = np.dtype(order + ("u8" if root.get("header_type") == "UInt64" else "u4"))
    return _File(name, root, order, length, known[compressor], appended, coded)


def _points(file: _File, piece: ElementTree.Element) -> FloatArray:
    n = _announced(file, piece, "NumberOfPoints")
    element = piece.find("Points/DataArray")
    if element is None:
        if n:
            raise MeshError(f"{file.name} announces {n:,} points but holds none.")
        return np.empty((0, 3))
    return file.array(element, 3 * n, "points").reshape(-1, 3).astype(np.float64)


def _cells(file: _File, piece: ElementTree.Element, tag: str) -> Cells:
    count = _announced(file, piece, f"NumberOf{tag}")
    arrays = {e.get("Name", "").lower(): e for e in piece.findall(f"{tag}/DataArray")}
    if not count:
        return cells_of_offsets(np.empty(0, np.int64), np.empty(0, np.int64), file.name)
    if not {"offsets", "connectivity"} <= arrays.keys():
        raise MeshError(f"{file.name} announces {count} {tag} but lacks their connectivity or offsets.")
    ends = whole_numbers(file.array(arrays["offsets"], count, f"{tag} offsets"))[0]
    corners = whole_numbers(file.array(arrays["connectivity"], None, f"{tag} connectivity"))[0]
    return cells_of_offsets(np.append(0, ends), corners, f"{file.name}: {tag}")


def _types(file: _File, piece: ElementTree.Element) -> IntArray:
    count = _announced(file, piece, "NumberOfCells")
    element = piece.find("Cells/DataArray[@Name='types']")
    if element is None:
        if count:
            raise MeshError(f"{file.name} announces {count:,} cells but lacks their types.")
        return np.empty(0, np.int64)
    return whole_numbers(file.array(element, count, "types of cells"))[0]


def _announced(file: _File, piece: ElementTree.Element, key: str) -> int:
    text = piece.get(key, "0")
    if not re.fullmatch("[0-9]{1,15}", text):
        raise MeshError(f"{file.name}: {key} is {text[:40]!r}, not a count.")
    return int(text)


def _from_base64(text: bytes, where: str) -> bytes:
    """Return the bytes of base64 text in which each part may be padded on its own."""
    try:
        parts = re.findall(rb"[^=]+={0,2}", b"".join(text.split()))
        return b"".join(base64.b64decode(part, validate=True) for part in parts)
    except binascii.Error as error:
        raise MeshError(f"{where} are damaged base64 text ({error}).") from None


# ---------------------------------------------------------------------- output
NOTHING: Mapping[str, AnyArray] = {}


def write_poly_data(
    file: BinaryIO,
    points: FloatArray,
    lines: Sequence[IntArray] | IntArray = (),
    polygons: Sequence[IntArray] | IntArray = (),
    point_data: Mapping[str, FloatArray] = NOTHING,
    cell_data: Mapping[str, AnyArray] = NOTHING,
) -> None:
    """Write points (n, 3), and lines and polygons as the ids (k,) of their corners, or (m, k) where all have as many.

    Where there are neither, the points are cells, without which programs show nothing.

    `point_data` and `cell_data` are arrays by name, with a value for each point or cell.
    """
    arrays = _Appended()
    parts = [*arrays.data(point_data, cell_data), arrays.section("Points", {"Points": points})]
    verts = () if len(lines) or len(polygons) else np.arange(len(points))[:, None]
    for name, cells in (("Verts", verts), ("Lines", lines), ("Polys", polygons)):
        if len(cells):
            corners, ends = _flat(cells)
            parts.append(arrays.section(name, {"connectivity": corners, "offsets": ends}))
    counts = {"Points": len(points), "Verts": len(verts), "Lines": len(lines), "Strips": 0, "Polys": len(polygons)}
    arrays.write(file, "PolyData", counts, parts)


def write_grid(file: BinaryIO, points: FloatArray, cells: IntArray, point_data: Mapping[str, FloatArray]) -> None:
    """Write points (n, 3) and triangles (m, 3) or tetrahedra (m, 4) as an unstructured grid.

    Where there are none, the points are cells, without which programs show nothing.
    """
    cells = cells if len(cells) else np.arange(len(points))[:, None]
    arrays, (corners, ends) = _Appended(), _flat(cells)
    types = np.full(len(cells), _CELL_TYPES[cells.shape[1]], np.uint8)
    parts = [
        *arrays.data(point_data, {}),
        arrays.section("Points", {"Points": points}),
        arrays.section("Cells", {"connectivity": corners, "offsets": ends, "types": types}),
    ]
    arrays.write(file, "UnstructuredGrid", {"Points": len(points), "Cells": len(cells)}, parts)


class _Appended:
    """Arrays that follow the tags which name them."""

    def __init__(self) -> None:
        self._blocks: list[bytes] = []
        self._offset = 0

    def section(self, name: str, arrays: Mapping[str, AnyArray]) -> str:
        """Return an element with arrays; "" without any."""
        tags = "".join(self._array(word, values) for word, values in arrays.items())
        return f"<{name}>\n{tags}</{name}>\n" if tags else ""

    def data(self, point_data: Mapping[str, AnyArray], cell_data: Mapping[str, AnyArray]) -> list[str]:
        """Return the elements with a value for each point or cell."""
        return [self.section("PointData", point_data), self.section("CellData", cell_data)]

    def _array(self, name: str, values: AnyArray) -> str:
        kind, written = {"f": ("Float64", "<f8"), "u": ("UInt8", "u1")}.get(values.dtype.kind, ("Int64", "<i8"))
        content = values.astype(written).tobytes()
        components = f' NumberOfComponents="{values.shape[1]}"' if values.ndim > 1 else ""
        tag = (
            f'<DataArray type="{kind}" Name={quoteattr(name)}{components} format="appended" offset="{self._offset}"/>\n'
        )
        self._blocks.extend([len(content).to_bytes(8, "little"), content])
        self._offset += 8 + len(content)
        return tag

    def write(self, file: BinaryIO, kind: str, counts: Mapping[str, int], parts: Sequence[str]) -> None:
        numbers = " ".join(f'NumberOf{name}="{count}"' for name, count in counts.items())
        file.write(
            '<?xml version="1.0" encoding="UTF-8"?>\n'
            f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<{kind}>\n'
            f'<Piece {numbers}>\n{"".join(parts)}</Piece>\n</{kind}>\n<AppendedData encoding="raw">\n_'.encode()
        )
        for block in self._blocks:
            file.write(block)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")


def _flat(cells: Sequence[IntArray] | IntArray) -> tuple[IntArray, IntArray]:
    """Return the corners of all cells in a row, and where each cell ends."""
    if isinstance(cells, np.ndarray):
        return cells.ravel(), cells.shape[1] * np.arange(1, len(cells) + 1)
    return np.concatenate(cells), np.cumsum([len(cell) for cell in cells])
