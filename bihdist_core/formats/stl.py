"""STL files, text and binary: a strict reader.

STL knows no vertices, only triangles with coordinates: corners at exactly the same place become one vertex, and
vertices are numbered in the order in which they first appear.
"""

import re

import numpy as np

from ..arrays import FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from ..kernel.library import NO_ROOM, library
from .mesh_text import mesh_text
from .polygons import Polygons
from .text_lines import TextLines, keyword_code

_HEAD = 84
"""Bytes before the first triangle: 80 of free text and the count."""
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("colour", "<u2")])
_WORDS = ("solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid")


def read_stl(raw: bytes, name: str) -> Polygons:
    """The triangles of an STL file, corners merged; MeshError where it is none or is cut off."""
    # Binary files, too, may begin with the word solid.
    if re.match(rb"(?:\xef\xbb\xbf)?\s*solid", raw) and not _has_binary_length(raw) and b"\0" not in raw[:1000]:
        corners = _text_corners(raw, name)
    else:
        corners = _binary_corners(raw, name)
    bad = np.flatnonzero(~np.isfinite(corners))
    if len(bad):
        place = ", ".join(f"{c:g}" for c in corners[bad[0] // 3])
        raise MeshError(f"{name}: triangle {bad[0] // 9} has a corner at ({place}); all must be finite numbers.")
    vertices, ids = merged(corners)
    fact = (
        f"{counted(len(corners), 'triangle corner')} at {counted(len(vertices), 'place')} merged into one vertex each, "
        "numbered in the order of the file"
    )
    return Polygons(vertices, np.full(len(corners) // 3, 3), ids, facts=(fact,))


def merged(points: FloatArray) -> tuple[FloatArray, IntArray]:
    """(n, 3) the different points in order of first appearance, and (k,) where each of the (k, 3) points is there."""
    kernel = library()
    if kernel is None:
        return _merged_by_sorting(points)
    places, number = np.empty_like(points), np.empty(len(points), np.int64)
    # Where a surface is closed, some six corners are in one place.
    n, slots = NO_ROOM, 1 << (len(points) // 2).bit_length()
    while n == NO_ROOM:
        n = kernel.bih_merge_points(len(points), points, slots, np.empty(slots, np.int32), places, number)
        slots *= 4
    places.resize((n, 3), refcheck=False)
    return places, number


def _merged_by_sorting(points: FloatArray) -> tuple[FloatArray, IntArray]:
    order = np.lexsort(points.T)
    new = np.append(True, (points[order][1:] != points[order][:-1]).any(axis=1))[: len(points)]
    first = order[new]
    group = np.empty(len(points), np.int64)
    group[order] = np.cumsum(new) - 1
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return points[np.sort(first)], rank[group]


def _has_binary_length(raw: bytes) -> bool:
    return len(raw) >= _HEAD and len(raw) == _HEAD + _TRIANGLE.itemsize * int.from_bytes(raw[80:84], "little")


def _binary_corners(raw: bytes, name: str) -> FloatArray:
    if len(raw) < _HEAD:
        raise MeshError(f"{name} is not an STL file: it has {len(raw)} bytes, fewer than an STL header.")
    announced, held = int.from_bytes(raw[80:84], "little"), (len(raw) - _HEAD) / _TRIANGLE.itemsize
    if not _has_binary_length(raw):
        raise MeshError(
            f"{name} announces {announced:,} triangles but has room for {int(100 * held) / 100:.12g}: "
            "it is cut off, its count is wrong or it is not an STL file."
        )
    return np.frombuffer(raw, _TRIANGLE, offset=_HEAD)["corners"].reshape(-1, 3).astype(np.float64)


def _text_corners(raw: bytes, name: str) -> FloatArray:
    solid, facet, outer, vertex, endloop, endfacet, endsolid = (keyword_code(w.encode()) for w in _WORDS)
    pattern = np.array([facet, outer, vertex, vertex, vertex, endloop, endfacet], np.uint64)
    if found := mesh_text("read_stl", (pattern, solid, endsolid), raw, [3]):
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
