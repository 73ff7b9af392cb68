"""MATLAB's MAT files of version 5, compressed or not: a strict reader of real arrays and of structs.

Format: https://www.mathworks.com/help/pdf_doc/matlab/matfile_format.pdf.  (SciPy's reader can take the process down on
a damaged file.)
"""

import math
import zlib
from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from ..arrays import AnyArray
from ..errors import MeshError

Variable: TypeAlias = "AnyArray | Mapping[str, Variable] | None"
"""An array of real numbers, the fields of a struct, or None for all else: texts, cells, complex and sparse arrays."""

_HEAD = 128
_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
_MATRIX, _COMPRESSED = 14, 15
_STRUCT = 2
_CLASSES = {6: "f8", 7: "f4", 8: "i1", 9: "u1", 10: "i2", 11: "u2", 12: "i4", 13: "u4", 14: "i8", 15: "u8"}
_COMPLEX = 0x0800
_DEEPEST = 4
"""Structs within each other that are read."""


def mat_variables(raw: bytes, name: str) -> dict[str, Variable]:
    """Read the variables of a MAT file; MeshError for one of another version, and where it is cut off or damaged."""
    if raw.startswith(b"MATLAB 7.3") or b"\x89HDF\r\n" in raw[:1024]:
        raise MeshError(f"{name} is a MAT file of version 7.3 (HDF5), which is not read; save it with -v7 in MATLAB.")
    order = {b"IM": "<", b"MI": ">"}.get(raw[_HEAD - 2 : _HEAD])
    if order is None:
        raise MeshError(f"{name} is not a MAT file of version 5; save it with -v7 in MATLAB.")
    found, elements = {}, _Elements(memoryview(raw), order, name, _HEAD)
    while elements.at < len(raw):
        kind, content = elements.next()
        if kind == _COMPRESSED:
            kind, content = _Elements(_unpacked(content, order, name), order, name).next()
        if kind == _MATRIX:
            label, variable = _matrix(_Elements(content, order, name))
            found[label] = variable
    return found


class _Elements:
    """A place in a row of elements, each a type, a number of bytes, and these."""

    def __init__(self, raw: memoryview, order: str, name: str, at: int = 0) -> None:
        self.raw, self.order, self.name, self.at = raw, order, name, at

    def next(self) -> tuple[int, memoryview]:
        """Read the type and the content of an element."""
        head = self._take(8)
        kind, size = np.frombuffer(head, self.order + "u4").tolist()
        if kind >> 16:  # both in four bytes, and the content in the others
            kind, size = kind & 0xFFFF, kind >> 16
            if size > 4:
                raise self.damage()
            return kind, head[4 : 4 + size]
        content = self._take(size)
        if kind != _COMPRESSED:
            self.at += -size % 8
        return kind, content

    def numbers(self) -> AnyArray:
        """Read (k,) the numbers of an element."""
        kind, content = self.next()
        if kind not in _TYPES or len(content) % np.dtype(_TYPES[kind]).itemsize:
            raise self.damage()
        return np.frombuffer(content, self.order + _TYPES[kind])

    def text(self) -> bytes:
        """Read the bytes of an element."""
        return bytes(self.next()[1])

    def damage(self) -> MeshError:
        """Return the error for what does not fit."""
        return MeshError(f"{self.name} is cut off or damaged: byte {self.at:,} of a variable does not fit.")

    def _take(self, count: int) -> memoryview:
        if count > len(self.raw) - self.at:
            raise MeshError(f"{self.name} is cut off or damaged: a variable ends after its file.")
        self.at += count
        return self.raw[self.at - count : self.at]


def _unpacked(content: memoryview, order: str, name: str) -> memoryview:
    """Return an element that is compressed, as long as it announces: less than 4 GiB."""
    stream = zlib.decompressobj()
    try:
        head = stream.decompress(content, 8)
        size = int(np.frombuffer(head, order + "u4")[1]) if len(head) == 8 else 0
        return memoryview(head + stream.decompress(stream.unconsumed_tail, size) if size else head)
    except zlib.error as error:
        raise MeshError(f"{name} is cut off or damaged ({error}).") from None


def _matrix(elements: _Elements, depth: int = 0) -> tuple[str, Variable]:
    """Return the name of a variable, "" for that of a field, and what it holds."""
    if not len(elements.raw):
        return "", np.empty((0, 0))
    flags, shape = elements.numbers(), elements.numbers().tolist()
    label = elements.text().decode("latin-1")
    if not len(flags) or not 2 <= len(shape) <= 32 or min(shape) < 0:
        raise elements.damage()
    kind, count = int(flags[0]) & 0xFF, math.prod(shape)
    if kind in _CLASSES and not int(flags[0]) & _COMPLEX:
        values = elements.numbers()
        if len(values) != count:
            raise MeshError(
                f"{elements.name} announces {count:,} numbers of {label or 'a field'!r} and holds {len(values):,}."
            )
        with np.errstate(invalid="ignore"):  # of whole numbers that a damaged file holds as others
            return label, values.astype(_CLASSES[kind]).reshape(shape, order="F")
    if kind != _STRUCT or count != 1 or depth == _DEEPEST:
        return label, None
    lengths, names = elements.numbers().tolist(), elements.text()
    if len(lengths) != 1 or lengths[0] < 1 or len(names) % lengths[0]:
        raise elements.damage()
    fields: dict[str, Variable] = {}
    for at in range(0, len(names), lengths[0]):
        field = names[at : at + lengths[0]].partition(b"\0")[0].decode("latin-1")
        inner, content = elements.next()
        if inner != _MATRIX:
            raise elements.damage()
        fields[field] = _matrix(_Elements(content, elements.order, elements.name), depth + 1)[1]
    return label, fields
