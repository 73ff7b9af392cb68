"""Points without faces: XYZ, PCD (text, binary and compressed), and NumPy's .npy."""

import io
import re

import numpy as np

from ..arrays import AnyArray, FloatArray
from ..counts import counted
from ..errors import MeshError, ParameterError
from .array_file import array_in
from .mesh_names import mesh_format
from .polygons import Polygons
from .text_lines import TextLines

_DATA = re.compile(rb"(?:^|\n)DATA[ \t]+(ascii|binary|binary_compressed)[ \t]*\r?\n")
_TYPES = {"F": "f", "I": "i", "U": "u"}


def read_points(raw: bytes, name: str) -> Polygons:
    """Read the points of a file; MeshError where it is of another kind, or does not hold what its header announces."""
    read = {".xyz": _xyz, ".pcd": _pcd, ".npy": _npy}[mesh_format(name)]
    points = read(raw, name)
    return Polygons(points, np.empty(0, np.int64), np.empty(0, np.int64))


def _xyz(raw: bytes, name: str) -> FloatArray:
    lines = TextLines(raw.replace(b",", b" ").replace(b";", b" "), name, comment=b"#")
    rows = lines.numbers(np.ones(len(lines), bool))
    short = np.flatnonzero(rows.sizes < 3)
    if len(short) or not len(rows):
        where = f", line {rows.number[short[0]]}: {lines.line(int(short[0]))}" if len(short) else ""
        raise MeshError(f"{name}{where} is not a point; each line begins with its three coordinates.")
    return rows.columns(3)


def _npy(raw: bytes, name: str) -> FloatArray:
    try:
        array = array_in(io.BytesIO(raw), len(raw))
    except ParameterError as error:
        raise MeshError(f"{name} cannot be read: {error}") from None
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iuf":
        raise MeshError(
            f"{name} holds {array.dtype} values of shape {array.shape}. Points need real numbers of shape (n, 3); "
            "if these are values at vertices, open their mesh first."
        )
    return array.astype(np.float64)


def _pcd(raw: bytes, name: str) -> FloatArray:
    found = _DATA.search(raw)
    if not found:
        raise MeshError(f"{name} is not a PCD file: its header has no line DATA ascii, binary or binary_compressed.")
    lines = [line.split() for line in raw[: found.start()].decode("latin1").splitlines() if not line.startswith("#")]
    head = {words[0]: words[1:] for words in lines if words}
    try:
        names, sizes, types = head["FIELDS"], head["SIZE"], head["TYPE"]
        counts = [int(each) for each in head.get("COUNT", ["1"] * len(names))]
        kinds = [f"<{_TYPES[kind]}{int(size)}" for kind, size in zip(types, sizes, strict=True)]
        fields = [(f"{k}", np.dtype(kind), (c,)) for k, (kind, c) in enumerate(zip(kinds, counts, strict=True))]
        n = int(head["POINTS"][0]) if "POINTS" in head else int(head["WIDTH"][0]) * int(head["HEIGHT"][0])
        axes = [names.index(axis) for axis in "xyz"]
        record = np.dtype(fields)
    except (KeyError, ValueError, IndexError, TypeError):
        raise MeshError(f"{name} has a damaged header, or points without x, y and z.") from None
    body, width = raw[found.end() :], record.itemsize
    if found[1] == b"ascii":
        return _pcd_text(body, n, counts, axes, name)
    if found[1] == b"binary_compressed":
        packed, whole = (int(each) for each in np.frombuffer(body[:8].ljust(8, b"\0"), "<u4"))
        if len(body) < 8 + packed or whole != n * width:
            raise MeshError(f"{name} is cut off or damaged: it announces {n:,} points.")
        body = _unpacked(body[8 : 8 + packed], whole, name)
        # Column by column.
        starts = np.cumsum([0, *(n * field[1].itemsize * field[2][0] for field in fields)])
        columns: list[AnyArray] = [np.frombuffer(body, fields[k][1], n, starts[k]) for k in axes]
    else:
        if n < 0 or len(body) < n * width:
            raise MeshError(f"{name} announces {n:,} points but holds at most {len(body) // max(width, 1):,}.")
        records = np.frombuffer(body, record, n)
        columns = [records[f"{k}"][:, 0] for k in axes]
    return np.stack([each.astype(np.float64) for each in columns], axis=1)


def _pcd_text(body: bytes, n: int, counts: list[int], axes: list[int], name: str) -> FloatArray:
    lines = TextLines(body, f"{name} (after the header)")
    rows = lines.numbers(np.ones(len(lines), bool))
    if len(rows) != n or (rows.sizes != sum(counts)).any():
        raise MeshError(
            f"{name} announces {counted(n, 'point')} of {counted(sum(counts), 'number')}, one a line, and does not "
            "hold as many."
        )
    starts = np.cumsum([0, *counts])
    return rows.columns(sum(counts))[:, starts[axes]]


def _unpacked(packed: bytes, size: int, name: str) -> bytes:
    """Return what was packed by LZF: runs of bytes, and of bytes that repeat others before them."""
    out, at, end = bytearray(), 0, len(packed)
    try:
        while at < end:
            control = packed[at]
            at += 1
            if control < 32:
                out += packed[at : at + control + 1]
                at += control + 1
                continue
            length = control >> 5
            if length == 7:
                length += packed[at]
                at += 1
            start = len(out) - (control & 31) * 256 - packed[at] - 1
            at += 1
            if start < 0:
                break
            piece = out[start : start + length + 2]
            out += (piece * ((length + 2) // len(piece) + 1))[: length + 2]
    except IndexError:
        pass
    if len(out) != size:
        raise MeshError(f"{name} is damaged: {len(out):,} of {size:,} bytes are unpacked.")
    return bytes(out)
