"""OFF files, text and binary: a strict reader.

Format: http://www.geomview.org/docs/html/OFF.html, three coordinates; normals, colours and texture coordinates are read
over.  A text has a vertex or a face on each line; where it has not, it is read as one row of numbers, if these are as
many as it announces, to the last.  Vertex ids are the order in the file.
"""

import re

import numpy as np

from ..arrays import IntArray
from ..errors import MeshError
from .mesh_text import mesh_text
from .polygons import Polygons, checked_corners, lists_in, runs, whole_numbers
from .text_lines import NumberLines, TextLines, shown

_HEADER = re.compile(rb"(ST)?(C)?(N)?(4)?(n)?OFF(?![A-Za-z])\s*(.*)", re.DOTALL)

_HEAD = 1 << 14
"""So many bytes are searched for the header first."""


def read_off(raw: bytes, name: str) -> Polygons:
    """Read the polygons of an OFF file; MeshError naming the line where it is not one."""
    if head := re.match(rb"\s*(\w*OFF)[ \t]+BINARY[ \t\r]*\n", raw[:200]):
        return _read_binary(raw, head, name)
    return _read_plain(raw, name) or _read_any(raw, name)


def _read_plain(raw: bytes, name: str) -> Polygons | None:
    """Read the polygons by the compiled kernel; None if it leaves the file to the other reader."""
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
        if found := _read_row(lines, header, vertex_count, face_count, allowed):
            return found
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
    more = numbers.sizes[:vertex_count] - allowed[0]
    facts = []
    # An RGB or RGBA colour, which a first line without C does not announce.
    if len(allowed) == 1 and more.size and more[0] in (3, 4) and (more == more[0]).all():
        allowed = [allowed[0] + int(more[0])]
        facts.append(f"{more[0]} numbers behind each vertex, a colour that the first line does not announce, ignored")
    wrong = np.flatnonzero(~np.isin(numbers.sizes[:vertex_count], allowed))
    if len(wrong):
        k = wrong[0]
        expected = " or ".join(map(str, allowed))
        raise MeshError(
            f"{name}, line {numbers.number[k]}: vertex {k} has {numbers.sizes[k]:,} numbers where {expected} belong."
        )
    vertices = numbers.columns(3, slice(0, vertex_count))
    sizes, corners = _faces(numbers, vertex_count, name)
    return Polygons(vertices, sizes, corners, facts=tuple(facts))


def _read_row(lines: TextLines, header: int, n: int, p: int, allowed: list[int]) -> Polygons | None:
    """Return the polygons of a text with lines that end anywhere, as one row of numbers.

    None unless that fits to the last.
    """
    if 3 * n + p > lines.word_count[header:].sum():
        return None
    try:
        values = lines.numbers(np.arange(len(lines)) >= header).values
    except MeshError:
        return None
    for width in allowed:
        whole, bad = whole_numbers(values[width * n :])
        found = None if bad.any() else lists_in(whole, p)
        if found and ((found[1] >= 0) & (found[1] < n)).all():
            return Polygons(values[: width * n].reshape(n, width)[:, :3], *found)
    return None


def _header(lines: TextLines) -> tuple[int, int, list[int], int]:
    """Return the numbers of vertices and faces, how many numbers a vertex line may hold, and the lines used up."""
    name = lines.name
    if not len(lines):
        raise MeshError(f"{name} holds nothing but blanks and comments.")
    allowed, rest = _kind(lines.text[lines.start[0] : lines.end[0]], name)
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
    return int(counts[0]), int(counts[1]), allowed, used


def _kind(line: bytes, name: str) -> tuple[list[int], bytes]:
    """Return the numbers that a vertex may have by the first line, and the rest of that line."""
    found = _HEADER.fullmatch(line)
    if not found:
        raise MeshError(f"{name} is not an OFF file: its first line is {shown(line)} where OFF belongs.")
    texture, colour, normal, four, any_dimension, rest = found.groups()
    if four or any_dimension:
        raise MeshError(f"{name} holds points with other than three coordinates ({shown(line)}); a surface needs 3.")
    plain = 3 + (3 if normal else 0) + (2 if texture else 0)
    return [plain + 3, plain + 4] if colour else [plain], rest


def _faces(numbers: NumberLines, vertex_count: int, name: str) -> tuple[IntArray, IntArray]:
    """Return (p,) polygon sizes and their corners; each line is a size, that many ids and perhaps a colour."""
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


def _read_binary(raw: bytes, head: re.Match[bytes], name: str) -> Polygons:
    """Read big-endian numbers: three counts, the vertices, then the corners and colour of each face, counts first."""
    width, at = _kind(head[1], name)[0][-1], head.end()
    counts = np.frombuffer(raw, ">i4", min(3, (len(raw) - at) // 4), at).tolist()
    if len(counts) < 3 or min(counts) < 0:
        raise MeshError(f"{name} is cut off or damaged: the counts after its first line are {counts}.")
    n, p, _ = counts
    at += 12
    held = (len(raw) - at) // 4
    if width * n + 2 * p > held or (len(raw) - at) % 4:
        raise MeshError(
            f"{name} announces {n:,} vertices and {p:,} faces but has room for {held:,} numbers: it is cut off or "
            "damaged."
        )
    vertices = np.frombuffer(raw, ">f4", width * n, at).reshape(n, width)[:, :3].astype(np.float64)
    values = np.frombuffer(raw, ">i4", held - width * n, at + 4 * width * n).astype(np.int64)
    sizes, corners = _binary_faces(values, p, name)
    return Polygons(vertices, sizes, checked_corners(corners, sizes, n, lambda k: f"{name}: face {k}"))


def _binary_faces(values: IntArray, p: int, name: str) -> tuple[IntArray, IntArray]:
    """Return (p,) sizes and the corners of faces that fill the values, each with a number of corners, and one of
    colours."""
    starts, at, entries = np.empty(p, np.int64), 0, values.tolist()
    for k in range(p):
        starts[k] = at
        size = entries[at] if at < len(entries) else -1
        at += 1 + size
        colours = entries[at] if size >= 0 and at < len(entries) else -1
        if colours < 0 or colours > len(entries) - at - 1:
            raise MeshError(f"{name}: face {k} does not fit into the file, which is cut off or damaged.")
        at += 1 + colours
    if at != len(entries):
        raise MeshError(
            f"{name} goes on for {4 * (len(entries) - at):,} bytes after its last face: its counts are wrong."
        )
    sizes = values[starts]
    return sizes, values[runs(starts + 1, sizes)]
