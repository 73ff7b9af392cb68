"""MNI objects (.obj) of polygons, as CIVET writes surfaces: a strict reader of text and binary files.

Behind the letter P stand five numbers of a material, the number of points, these, a normal for each, the number of
polygons, colours, for each polygon where its corners end, and all corners, counted from 0.  Behind a small p they are
binary, of four bytes each; how many a colour takes differs from program to program.
"""

from contextlib import suppress
from itertools import product

import numpy as np

from ..arrays import AnyArray
from ..errors import MeshError
from .polygons import Polygons, checked_corners, whole_numbers
from .text_lines import parsed_numbers, plain_text

_KINDS = {"F": "models", "L": "lines", "M": "markers", "Q": "a grid of quads", "T": "text", "X": "pixels"}
_MATERIAL = 5


def read_mni(raw: bytes, name: str) -> Polygons:
    """Read the polygons of an MNI object; MeshError for other objects, and where it is cut off or damaged."""
    kind = raw.lstrip()[:1].decode("latin-1")
    if kind.upper() in _KINDS:
        raise MeshError(f"{name} is an MNI object of {_KINDS[kind.upper()]}, not of polygons.")
    if kind.isupper():
        values = parsed_numbers(plain_text(raw, name).lstrip()[1:], name, "numbers of polygons")
        return _polygons(values, values, 4, name)
    if len(raw) % 4 == 1:
        for order, width in product("<>", (1, 2, 3, 4)):
            with suppress(MeshError):
                floats, integers = (np.frombuffer(raw, order + kind, -1, 1) for kind in ("f4", "i4"))
                return _polygons(floats, integers, width, name)
    raise MeshError(f"{name} is a binary MNI object of polygons, and is cut off or damaged.")


def _polygons(floats: AnyArray, integers: AnyArray, width: int, name: str) -> Polygons:
    """Return the polygons of a row of numbers (k,), as coordinates and as integers, if they fill it to the last."""
    at = _MATERIAL

    def take(row: AnyArray, count: int, what: str) -> AnyArray:
        nonlocal at
        if count > len(row) - at:
            held = len(row) - at
            raise MeshError(f"{name} announces {count:,} {what} and holds {max(held, 0):,}; it is cut off or damaged.")
        at += count
        return row[at - count : at]

    def count_of(what: str) -> int:
        (count,), (bad,) = whole_numbers(take(integers, 1, "numbers"))
        if bad or count < 0:
            raise MeshError(f"{name}: the number of {what} is {integers[at - 1]:g}; it is damaged.")
        return int(count)

    n = count_of("points")
    points = take(floats, 3 * n, "coordinates").reshape(-1, 3)
    take(floats, 3 * n, "coordinates of normals")
    p, colours = count_of("polygons"), count_of("kinds of colours")
    if colours > 2:
        raise MeshError(f"{name}: its colours are of kind {colours}, not 0, 1 or 2; it is damaged.")
    take(floats, width * (1, p, n)[colours], "numbers of colours")
    ends, bad = whole_numbers(take(integers, p, "ends of polygons"))
    sizes = np.diff(ends, prepend=0)
    bad |= sizes < 0
    if bad.any():
        raise MeshError(f"{name}: polygon {int(bad.argmax())} ends before it begins; the file is damaged.")
    corners = take(integers, int(ends[-1]) if p else 0, "corners")
    if at != len(integers):
        raise MeshError(f"{name} has {len(integers) - at:,} numbers after its polygons; its counts are wrong.")
    ids = checked_corners(corners, sizes, n, lambda k: f"{name}: polygon {k}")
    return Polygons(points.astype(np.float64), sizes, ids)
