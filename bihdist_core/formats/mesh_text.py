"""Mesh files of text, read by the compiled kernel in one pass (`kernel/text.c`).

It reads what there is nothing to say about; a file that is damaged or unusual is left to the readers that say what is
wrong.
"""

import ctypes
from collections.abc import Sequence
from ctypes import Structure, c_int64, c_uint64, c_void_p
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..kernel.library import DONE, at, library
from .text_lines import BYTE_ORDER_MARK, parsed


class _Text(Structure):
    _fields_ = (
        *((name, c_void_p) for name in ("text", "at", "powers")),
        *((name, c_uint64) for name in ("comment", "allowed")),
        *((name, c_int64) for name in ("point_room", "polygon_room", "corner_room", "word_room")),
        *((name, c_int64) for name in ("points", "polygons", "corners", "words")),
        *((name, c_void_p) for name in ("point", "size", "corner", "word")),
        *((name, c_int64) for name in ("greatest", "loose")),
    )

    at: int
    points: int
    polygons: int
    corners: int
    words: int
    loose: int


@dataclass(frozen=True)
class MeshText:
    """The mesh in a text: `vertices` (n, 3), polygon `sizes` (p,), and `corners` (sum of sizes,) as vertex ids from 0.

    `loose` counts the lines of loose points and edges of an OBJ file.
    """

    vertices: FloatArray
    sizes: IntArray
    corners: IntArray
    loose: int


def mesh_text(
    function: str, arguments: tuple[Any, ...], raw: bytes, allowed: Sequence[int], comment: bytes = b"", begin: int = 0
) -> MeshText | None:
    """Return the mesh in a text from `begin` on, which a function of the kernel takes whole; None if it does not.

    A vertex may have any of `allowed` numbers (each below 64), of which three are kept.
    """
    kernel = library()
    if kernel is None:
        return None
    length = len(raw) - begin
    try:
        # No vertex is shorter than '0 0 0', few faces are; memory that is not used is not taken.
        points, sizes, corners = np.empty((length // 6 + 1, 3)), *(np.empty(length // k + 1, np.int64) for k in (6, 2))
        words = np.empty((length // 16 + 1, 3), np.int64)
    except MemoryError:
        return None
    arrays: tuple[AnyArray, ...] = (points, sizes, corners, words)
    address = ctypes.cast(ctypes.c_char_p(raw), c_void_p).value or 0
    text = _Text(
        *(address, address + (begin or len(BYTE_ORDER_MARK) * raw.startswith(BYTE_ORDER_MARK))),
        *(at(_powers_of_five()), ord(comment or b"\0"), sum(1 << k for k in allowed)),
        *(*map(len, arrays), 0, 0, 0, 0, *map(at, arrays), -1, 0),
    )
    status = getattr(kernel, f"bih_{function}")(ctypes.byref(text), *arguments)
    # A zero byte ends the text for the kernel.
    if status != DONE or text.at != address + len(raw) or not _complete(points, words[: text.words], raw):
        return None
    points.resize((text.points, 3), refcheck=False)
    sizes.resize(text.polygons, refcheck=False)
    corners.resize(text.corners, refcheck=False)
    return MeshText(points, sizes, corners, text.loose)


def _complete(points: FloatArray, words: IntArray, raw: bytes) -> bool:
    """Fill in the words (k, 3), begin, end and place, that the kernel has left; return whether all are numbers."""
    values = parsed(b" ".join([raw[begin:end] for begin, end, _ in words.tolist()]), len(words))
    if values is None:
        return False
    place = words[:, 2]
    points.reshape(-1)[place[place >= 0]] = values[place >= 0]
    return True


@cache
def _powers_of_five() -> AnyArray:
    """Return (651, 2) the leading 128 bits of 5^e for e from -342 to 308, high word first.

    Rounded up for -27 <= e < 0.
    """
    found = []
    for e in range(-342, 309):
        power = 5 ** abs(e)
        length = power.bit_length()
        found.append((1 << 127 + length) // power + (e >= -27) if e < 0 else power << 128 >> length)
    return np.array([(bits >> 64, bits & (1 << 64) - 1) for bits in found], np.uint64)
