"""OFF files: a strict reader.

Format: http://www.geomview.org/docs/html/OFF.html, text only, three coordinates; normals, colours and texture
coordinates are read over.  Vertex ids are the order in the file.
"""

import re

import numpy as np

from ..arrays import IntArray
from ..errors import MeshError
from .mesh_text import mesh_text
from .polygons import Polygons, checked_corners, runs, whole_numbers
from .text_lines import NumberLines, TextLines, shown

_HEADER = re.compile(rb"(ST)?(C)?(N)?(4)?(n)?OFF(?![A-Za-z])\s*(.*)", re.DOTALL)

_HEAD = 1 << 14
"""So many bytes are searched for the header first."""


def read_off(raw: bytes, name: str) -> Polygons:
    """The polygons of an OFF file; MeshError naming the line where it is not one."""
    if re.match(rb"\s*\w*OFF\s+BINARY", raw[:200]):
        raise MeshError(f"{name} is a binary OFF file; only text OFF files are read.")
    return _read_plain(raw, name) or _read_any(raw, name)


def _read_plain(raw: bytes, name: str) -> Polygons | None:
    """The polygons, read by the compiled kernel; None if it leaves the file to the other reader."""
    try:
        n, p, allowed, header = _header(TextLines(raw[: raw.rfind(b"\n", 0, _HEAD) + 1], name, comment=b"#"))
    except MeshError:
        return None
    found = mesh_text("read_lists", (header, n, p, True), raw, allowed, comment=b"#")
    return Polygons(found.vertices, found.sizes, found.corners) if found else None


def _read_any(raw: bytes, name: str) -> Polygons:
    lines = TextLines(raw, name, comment=b"#")
    vertex_count, face_count, allowed, header = _header(lines)
    held = len(lines) - header
    if held != vertex_count + face_count:
        problem = (
            "the file is cut off or its counts are wrong"
            if held < vertex_count + face_count
            else "its counts are wrong"
        )
        raise MeshError(
            f"{name} announces {vertex_count:,} vertices and {face_count:,} faces, one a line, but {held:,} lines "
            f"follow: {problem}."
        )
    numbers = lines.numbers(np.arange(len(lines)) >= header)
    wrong = np.flatnonzero(~np.isin(numbers.sizes[:vertex_count], allowed))
    if len(wrong):
        k = wrong[0]
        expected = " or ".join(map(str, allowed))
        raise MeshError(
            f"{name}, line {numbers.number[k]}: vertex {k} has {numbers.sizes[k]:,} numbers where {expected} belong."
        )
    vertices = numbers.columns(3, slice(0, vertex_count))
    sizes, corners = _faces(numbers, vertex_count, name)
    return Polygons(vertices, sizes, corners)


def _header(lines: TextLines) -> tuple[int, int, list[int], int]:
    """Vertices, faces, how many numbers a vertex line may hold, and the lines used up."""
    name = lines.name
    if not len(lines):
        raise MeshError(f"{name} holds nothing but blanks and comments.")
    found = _HEADER.fullmatch(lines.text[lines.start[0] : lines.end[0]])
    if not found:
        raise MeshError(f"{name} is not an OFF file: its first line is {lines.line(0)} where OFF belongs.")
    texture, colour, normal, four, any_dimension, rest = found.groups()
    if four or any_dimension:
        raise MeshError(f"{name} holds points with other than three coordinates ({lines.line(0)}); a surface needs 3.")
    used = 1
    if not rest.strip():
        if len(lines) < 2:
            raise MeshError(f"{name} ends after its first line; the numbers of vertices and faces are missing.")
        rest, used = lines.text[lines.start[1] : lines.end[1]], 2
    counts = rest.split()
    if len(counts) not in (2, 3) or not all(re.fullmatch(rb"\d{1,18}", c) for c in counts):
        raise MeshError(
            f"{name}, line {lines.number[used - 1]}: {shown(rest)} is not the numbers of vertices, faces and edges."
        )
    plain = 3 + (3 if normal else 0) + (2 if texture else 0)
    return int(counts[0]), int(counts[1]), [plain + 3, plain + 4] if colour else [plain], used


def _faces(numbers: NumberLines, vertex_count: int, name: str) -> tuple[IntArray, IntArray]:
    """(p,) polygon sizes and their corners; each line is a size, that many ids and perhaps a colour."""
    first = numbers.first[vertex_count:-1]
    held = numbers.sizes[vertex_count:]
    sizes, bad = whole_numbers(numbers.values[first])
    bad |= (sizes < 0) | (sizes >= held)
    if bad.any():
        k = int(np.argmax(bad))
        raise MeshError(
            f"{name}, line {numbers.number[vertex_count + k]}: face {k} announces {numbers.values[first[k]]:.16g} "
            f"corners and {held[k] - 1:,} numbers follow."
        )
    if len(sizes) and (sizes == 3).all():
        values = numbers.columns(4, np.s_[vertex_count:])[:, 1:].ravel()
    else:
        values = numbers.values[runs(first + 1, sizes)]
    corners = checked_corners(
        values, sizes, vertex_count, lambda k: f"{name}, line {numbers.number[vertex_count + k]}: face {k}"
    )
    return sizes, corners
