"""Wavefront OBJ files: a strict reader of `v` and `f` lines.

Vertex ids are the order of the `v` lines: texture coordinates and normals never split a vertex.  Other statements of
the format are read over, unknown ones are counted; one that may be a damaged vertex or face is an error, since all
vertices after it would be renumbered.
"""

import re

import numpy as np

from ..arrays import FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from .mesh_text import mesh_text
from .polygons import Polygons, whole_numbers
from .text_lines import NumberLines, TextLines, keyword_code, shown

_OTHER_STATEMENTS = (
    *("vt", "vn", "vp", "vc", "g", "o", "s", "mg", "usemtl", "mtllib", "usemap", "maplib", "lod", "bevel", "end"),
    *("c_interp", "d_interp", "shadow_obj", "trace_obj", "csh", "call", "cstype", "deg", "bmat", "step", "curv"),
    *(
        "curv2",
        "surf",
        "parm",
        "trim",
        "hole",
        "scrv",
        "sp",
        "con",
        "ctech",
        "stech",
        "bsp",
        "bzp",
        "cdc",
        "cdp",
        "res",
    ),
)
_STATEMENTS = ("v", "f", "l", "p", *_OTHER_STATEMENTS)
_CONTINUED = re.compile(rb"(?m)^(?:[^\n]*\\\n(?![ \t]*(?:%b)(?:[ \t\n]|\Z)))+[^\n]*" % "|".join(_STATEMENTS).encode())
"""A backslash before a statement does not continue a line: it ends a path, as in `mtllib C:\\models\\`."""
_VERTEX_SIZES = (3, 4, 6, 7)
"""Coordinates, perhaps a weight, perhaps a colour."""
_NUMBERS = re.compile(rb"[-+.\d/eE]*")
_LAST_FACE = re.compile(rb"(?:^|[\r\n])[ \t]*f((?:[ \t][^\r\n#]*)?)\Z")


def read_obj(raw: bytes, name: str) -> Polygons:
    """Read the polygons of an OBJ file.

    MeshError naming the line where it is not one, or its last face is cut off.
    """
    _check_end(raw, name)
    return _read_plain(raw) or _read_any(raw, name)


def _read_plain(raw: bytes) -> Polygons | None:
    """Read the polygons by the compiled kernel; None if it leaves the file to the other reader."""
    if b"\\" in raw and re.search(rb"\\[\r\n#]", raw):
        return None
    keywords = np.array([keyword_code(word.encode()) for word in _STATEMENTS], np.uint64)
    found = mesh_text("read_obj", (keywords, len(keywords)), raw, _VERTEX_SIZES, comment=b"#")
    return Polygons(found.vertices, found.sizes, found.corners, _repairs(found.loose)) if found else None


def _check_end(raw: bytes, name: str) -> None:
    """Raise MeshError for a file that ends within a face: with no line end, too few corners, or half a corner."""
    if raw.endswith((b"\n", b"\r")):
        return
    last = _LAST_FACE.search(raw, max(raw.rfind(b"\n"), raw.rfind(b"\r"), 0))
    if not last:
        return
    corners = last[1].split()
    # 7/2/9 has as many slashes as the corners before it, and a number behind the last of them.
    forms = {re.sub(rb"\d+", b"0", corner.replace(b"-", b"")) for corner in corners}
    if len(corners) < 3 or len(forms) > 1:
        raise MeshError(
            f"{name} is cut off: its last line, which does not end, is the face {shown(b'f' + last[1])}; add a line "
            "end if that is all of it."
        )


def _read_any(raw: bytes, name: str) -> Polygons:
    lines = TextLines(raw, name, comment=b"#", continued=_CONTINUED)
    is_vertex = lines.keyword == keyword_code(b"v")
    is_face = lines.keyword == keyword_code(b"f")
    is_loose = (lines.keyword == keyword_code(b"l")) | (lines.keyword == keyword_code(b"p"))
    known = np.array([keyword_code(word.encode()) for word in _OTHER_STATEMENTS], np.uint64)
    unknown = np.flatnonzero(~(is_vertex | is_face | is_loose) & ~np.isin(lines.keyword, known))
    for k in unknown.tolist():
        if _may_be_damaged(lines.text[lines.start[k] : lines.end[k]].split()):
            raise MeshError(f"{name}, line {lines.number[k]}: {lines.line(k)} is not an OBJ statement.")
    if not is_vertex.any():
        raise MeshError(f"{name} has no vertices: none of its lines begins with 'v'.")

    vertices = _vertices(lines.numbers(is_vertex, keyword=b"v"), name)
    face_rows = lines.numbers(is_face, keyword=b"f", slashes=True)
    before = np.cumsum(is_vertex)[is_face]
    corners = _corners(face_rows, before, len(vertices), name)
    said = f"{counted(len(unknown), 'line')} of unknown statements ignored"
    facts = [f"{said}, the first: {lines.line(k)}" for k in unknown[:1]]
    return Polygons(vertices, face_rows.sizes, corners, _repairs(int(is_loose.sum())), tuple(facts))


def _may_be_damaged(words: list[bytes]) -> bool:
    """Return whether an unknown statement may be left of a vertex or a face: nothing but numbers behind a word."""
    first, *others = words
    return all(map(_NUMBERS.fullmatch, others)) if others else bool(re.search(rb"\d", first))


def _repairs(loose: int) -> tuple[str, ...]:
    return (f"{counted(loose, 'line or point statement')} ignored",) if loose else ()


def _vertices(rows: NumberLines, name: str) -> FloatArray:
    wrong = np.flatnonzero(~np.isin(rows.sizes, _VERTEX_SIZES))
    if len(wrong):
        k = wrong[0]
        raise MeshError(
            f"{name}, line {rows.number[k]}: vertex {k + 1} has {counted(rows.sizes[k], 'number')} where 3 coordinates "
            "(perhaps with a weight or a colour) belong."
        )
    return rows.columns(3)


def _corners(rows: NumberLines, before: IntArray, n: int, name: str) -> IntArray:
    """Return the corners of all faces as ids from 0; `before` (p,) counts the vertices above each face line."""
    sizes = rows.sizes
    ids, bad = whole_numbers(rows.values)
    # -1 is the last vertex above the face's line.
    back = ids < 0
    if back.any():
        ids = np.where(back, ids + np.repeat(before, sizes), ids - 1)
        bad |= back & (ids < 0)
    else:
        ids -= 1
    bad |= (ids < 0) | (ids >= n)
    if bad.any():
        at = int(np.argmax(bad))
        k = int(np.searchsorted(rows.first[1:], at, side="right"))
        raise MeshError(
            f"{name}, line {rows.number[k]}: the face names vertex {rows.values[at]:.16g}, but vertices are numbered "
            f"1 to {n} (or -1 to -{before[k]}, back from this line)."
        )
    return ids
