"""STL files, text and binary: a strict reader.

STL knows no vertices, only triangles with coordinates: corners at exactly the same place become one vertex, and
vertices are numbered in the order in which they first appear.
"""

import re

import numpy as np

from ..arrays import FloatArray
from ..coincident_points import merged
from ..counts import counted
from ..errors import MeshError
from .mesh_text import mesh_text
from .polygons import Polygons
from .text_lines import TextLines, keyword_code

_HEAD = 84
"""Bytes before the first triangle: 80 of free text and the count."""
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("colour", "<u2")])
_WORDS = ("solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid")


def read_stl(raw: bytes, name: str) -> Polygons:
    """Read the triangles of an STL file, corners merged; MeshError where it is none or is cut off."""
    # Binary files, too, may begin with the word solid.
    says_text = re.match(rb"(?:\xef\xbb\xbf)?\s*solid", raw, re.IGNORECASE)
    if says_text and not _has_binary_length(raw) and b"\0" not in raw[:1000]:
        corners, left = _text_corners(raw, name), 0
    else:
        corners, left = _binary_corners(raw, name)
    if not len(corners):
        raise MeshError(f"{name} holds 0 triangles; a surface needs at least one.")
    bad = np.flatnonzero(~np.isfinite(corners))
    if len(bad):
        place = ", ".join(f"{c:g}" for c in corners[bad[0] // 3])
        raise MeshError(f"{name}: triangle {bad[0] // 9} has a corner at ({place}); all must be finite numbers.")
    vertices, ids = merged(corners)
    fact = (
        f"{counted(len(corners), 'triangle corner')} at {counted(len(vertices), 'place')} merged into one vertex each, "
        "numbered in the order of the file"
    )
    facts = (fact, f"{counted(left, 'byte')} after the last triangle ignored") if left else (fact,)
    return Polygons(vertices, np.full(len(corners) // 3, 3), ids, facts=facts)


def _has_binary_length(raw: bytes) -> bool:
    return len(raw) >= _HEAD and len(raw) == _HEAD + _TRIANGLE.itemsize * int.from_bytes(raw[80:84], "little")


def _binary_corners(raw: bytes, name: str) -> tuple[FloatArray, int]:
    """Return the corners, and how many bytes come behind the last triangle."""
    if len(raw) < _HEAD:
        raise MeshError(f"{name} is not an STL file: it has {len(raw)} bytes, fewer than an STL header.")
    announced, held = int.from_bytes(raw[80:84], "little"), (len(raw) - _HEAD) / _TRIANGLE.itemsize
    left = len(raw) - _HEAD - announced * _TRIANGLE.itemsize
    # Where the rest could be triangles, too, their number is wrong.
    if left < 0 or (left and (left % _TRIANGLE.itemsize == 0 or not announced)):
        raise MeshError(
            f"{name} announces {announced:,} triangles but has room for {int(100 * held) / 100:.12g}: "
            "it is cut off, its count is wrong or it is not an STL file."
        )
    triangles = np.frombuffer(raw, _TRIANGLE, announced, _HEAD)
    return triangles["corners"].reshape(-1, 3).astype(np.float64), left


def _text_corners(raw: bytes, name: str) -> FloatArray:
    solid, facet, outer, vertex, endloop, endfacet, endsolid = (keyword_code(w.encode()) for w in _WORDS)
    pattern = np.array([facet, outer, vertex, vertex, vertex, endloop, endfacet], np.uint64)
    words = pattern, solid, endsolid
    found = mesh_text("read_stl", words, raw, [3])
    if not found:
        raw = raw.lower()  # some programs write all of it in capitals
        found = mesh_text("read_stl", words, raw, [3])
    if found:
        return found.vertices
    lines = TextLines(raw, name)
    word = lines.keyword
    # Lines between facets may only open and close solids; inside, each facet repeats these seven.
    inner = (word != solid) & (word != endsolid)
    at = np.flatnonzero(inner)
    wrong = np.flatnonzero(word[at] != np.resize(pattern, len(at)))
    if len(wrong):
        k, expected = int(at[wrong[0]]), (*_WORDS[1:3], *["vertex"] * 3, *_WORDS[4:6])[int(wrong[0]) % 7]
        raise MeshError(f"{name}, line {lines.number[k]}: {lines.line(k)} stands where {expected!r} belongs.")
    if len(at) % 7 or word[-1] != endsolid:
        raise MeshError(f"{name} is cut off: its last line is {lines.line(len(lines) - 1)}, not 'endsolid'.")
    numbers = lines.numbers(word == vertex, keyword=b"vertex")
    bad = np.flatnonzero(numbers.sizes != 3)
    if len(bad):
        k = bad[0]
        raise MeshError(f"{name}, line {numbers.number[k]}: the vertex has {numbers.sizes[k]} coordinates, not 3.")
    return numbers.columns(3)
