"""FreeSurfer's files: surfaces (lh.pial, lh.pial.asc), values at vertices (lh.thickness), annotations (lh.aparc.annot)
and labels (lh.cortex.label).

They have no extensions of their own, or share them; their first bytes tell them apart.  Coordinates are those of the
file, of FreeSurfer's surfaces ("tkr"): what a file says of the volume it was made from is not applied.
"""

import os
from dataclasses import dataclass

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..counts import counted
from ..errors import MeshError
from .mesh_names import GZIP
from .polygons import Polygons, checked_corners, whole_numbers
from .text_lines import TextLines, shown

_SURFACE, _QUADS, _VALUES = b"\xff\xff\xfe", b"\xff\xff\xfd", b"\xff\xff\xff"
_BEGINNING = b"#!ascii"
"""Of surfaces and labels of text."""
_TABLE_VERSION = -2


@dataclass(frozen=True)
class Annotation:
    """Labels (n,): the place of each vertex's name in `names`, -1 where it has none; colours (k, 3) are from 0 to 1."""

    labels: IntArray
    names: tuple[str, ...]
    colours: FloatArray


def is_surface(raw: bytes) -> bool:
    """Return whether a file begins as a surface of triangles."""
    return raw[:3] == _SURFACE


def is_values(raw: bytes) -> bool:
    """Return whether a file begins as one of values at vertices, such as thickness."""
    return raw[:3] == _VALUES


def read_freesurfer(raw: bytes, name: str) -> Polygons:
    """Read the triangles of a FreeSurfer surface; MeshError where it is none, or is cut off."""
    if raw.startswith(_BEGINNING):
        return _read_text(raw, name)
    if raw[:3] == _QUADS:
        raise MeshError(f"{name} is a FreeSurfer surface of quads; FreeSurfer's mris_convert makes triangles of it.")
    if not is_surface(raw):
        what = "holds values, not a surface" if is_values(raw) else "is not a FreeSurfer surface"
        raise MeshError(f"{name} {what}: its first bytes are {raw[:3].hex()} where {_SURFACE.hex()} belongs.")
    file = _Cursor(raw, name, len(_SURFACE))
    file.skip_line()
    # An empty line, or a text, may follow the stamp; a count below 167 million begins with a smaller byte.
    if not file.at_end and raw[file.at] >= 10:
        file.skip_line()
    n, m = file.whole("number of vertices"), file.whole("number of triangles")
    points = file.numbers(3 * n, ">f4", "coordinates").reshape(-1, 3)
    corners, sizes = file.numbers(3 * m, ">i4", "corners"), np.full(m, 3)
    ids = checked_corners(corners, sizes, n, lambda k: f"{name}: triangle {k}")
    return Polygons(points.astype(np.float64), sizes, ids)


def _read_text(raw: bytes, name: str) -> Polygons:
    """Read a surface of text: the numbers of vertices and triangles, then four for each, of which the last marks it."""
    what = next((word for word in (b"label", b"patch") if word in raw.partition(b"\n")[0].split()[1:4]), None)
    if what:
        raise MeshError(f"{name} is a FreeSurfer {what.decode()}, not a surface.")
    lines = TextLines(raw, name, comment=b"#")
    numbers = lines.numbers(np.ones(len(lines), bool))
    counts, _ = whole_numbers(numbers.values[: numbers.sizes[0]] if len(lines) else np.empty(0))
    if len(counts) != 2 or counts.min() < 0:
        line = f", line {numbers.number[0]}: {lines.line(0)}" if len(lines) else " is cut off: its second line"
        raise MeshError(f"{name}{line} is not the numbers of vertices and triangles.")
    n, m = counts.tolist()
    if n + m != len(lines) - 1:
        why = "it is cut off or damaged" if n + m > len(lines) - 1 else "its counts are wrong"
        raise MeshError(
            f"{name} announces {n:,} vertices and {m:,} triangles, and {len(lines) - 1:,} lines follow; {why}."
        )
    wrong = np.flatnonzero(numbers.sizes[1:] != 4)
    if len(wrong):
        k = wrong[0] + 1
        raise MeshError(f"{name}, line {numbers.number[k]}: {lines.line(k)} is not three numbers and a mark.")
    rows = numbers.columns(4, slice(1, None)) if n + m else np.empty((0, 4))
    sizes, kept = np.full(m, 3), rows[n:, 3] == 0
    ids = checked_corners(
        rows[n:, :3].ravel(), sizes, n, lambda k: f"{name}, line {numbers.number[1 + n + k]}: triangle {k}"
    )
    repairs = (f"{counted(int((~kept).sum()), 'triangle')} marked as cut out ignored",) if not kept.all() else ()
    return Polygons(rows[:n, :3], sizes[kept], ids.reshape(-1, 3)[kept].ravel(), repairs)


def read_values(raw: bytes, name: str) -> AnyArray:
    """Read (n,) float32 values of a FreeSurfer file such as lh.thickness.

    MeshError where it is none, or is cut off.
    """
    if not is_values(raw):
        what = "is a surface, and holds no values" if is_surface(raw) else "is not a FreeSurfer file of values"
        raise MeshError(f"{name} {what}: its first bytes are {raw[:3].hex()} where {_VALUES.hex()} belongs.")
    file = _Cursor(raw, name, len(_VALUES))
    n, _, each = file.whole("number of vertices"), file.whole("number of faces"), file.whole("number of values")
    if each != 1:
        raise MeshError(f"{name} has {each} values at each vertex; one is needed.")
    values = file.numbers(n, ">f4", "values")
    file.end()
    return values


def read_annotation(raw: bytes, name: str) -> Annotation:
    """Read the labels of a FreeSurfer annotation; MeshError where it is none, or is cut off or damaged."""
    file = _Cursor(raw, name)
    n = file.whole("number of vertices")
    ids, colours = file.numbers(2 * n, ">i4", "labels").reshape(-1, 2).astype(np.int64).T
    if not np.array_equal(np.sort(ids), np.arange(n)):
        raise MeshError(f"{name} does not label each of its {n:,} vertices once; it is damaged.")
    of_vertex = np.empty(n, np.int64)
    of_vertex[ids] = colours
    names, table = _table(file)
    order = np.argsort(table, kind="stable")
    at = np.minimum(np.searchsorted(table[order], of_vertex), len(table) - 1)
    labels = order[at]
    unknown = np.flatnonzero((table[labels] != of_vertex) & (of_vertex != 0))
    if len(unknown):
        k = unknown[0]
        raise MeshError(f"{name}: vertex {k} has the colour {of_vertex[k]}, which is not in the table of labels.")
    parts = np.maximum(table, 0)[:, None] >> np.array([0, 8, 16]) & 255
    return Annotation(np.where(of_vertex == 0, -1, labels), names, parts / 255)


def _table(file: "_Cursor") -> tuple[tuple[str, ...], IntArray]:
    """Return the names of labels, and (k,) their colours, red + 256 green + 65536 blue; unused ones are ""."""
    if not file.at_end and file.integer() == 1:
        count = file.integer()
        if count == _TABLE_VERSION:
            size = file.whole("number of labels")
            file.text("name of the table")
            count = file.whole("number of labels")
            numbered = True
        else:
            size, numbered = count, False
            file.text("name of the table")
        if 0 < size <= len(file.raw):
            names, colours = [""] * size, np.full(size, -1)
            for k in range(count):
                at = file.integer() if numbered else k
                if not 0 <= at < size:
                    raise MeshError(f"{file.name}: label {k} stands at {at} of a table of {size:,}; it is damaged.")
                names[at] = file.text(f"name of label {k}")
                red, green, blue, _ = file.numbers(4, ">i4", "colours").tolist()
                colours[at] = red + (green << 8) + (blue << 16)
            return tuple(names), colours
    raise MeshError(f"{file.name} has no table of labels; it is cut off, or not a FreeSurfer annotation.")


@dataclass
class _Cursor:
    """A place in a file of big-endian numbers."""

    raw: bytes
    name: str
    at: int = 0

    @property
    def at_end(self) -> bool:
        """True if everything has been read."""
        return self.at >= len(self.raw)

    def skip_line(self) -> None:
        """Read over a line of text."""
        end = self.raw.find(b"\n", self.at)
        if end < 0:
            raise MeshError(f"{self.name} is cut off: the text at its beginning does not end.")
        self.at = end + 1

    def numbers(self, count: int, kind: str, what: str) -> AnyArray:
        """Read (count,) numbers."""
        size = np.dtype(kind).itemsize
        held = (len(self.raw) - self.at) // size
        if count > held:
            raise MeshError(f"{self.name} announces {count:,} {what} and holds {held:,}; it is cut off or damaged.")
        found = np.frombuffer(self.raw, kind, count, self.at)
        self.at += count * size
        return found

    def integer(self) -> int:
        """Read a number of four bytes."""
        return int(self.numbers(1, ">i4", "numbers")[0])

    def whole(self, what: str) -> int:
        """Read a count."""
        found = self.integer()
        if found < 0:
            raise MeshError(f"{self.name}: the {what} is {found}; it is damaged, or of another kind.")
        return found

    def text(self, what: str) -> str:
        """Read a text, its length before it, that a zero byte ends."""
        count = self.whole(f"length of the {what}")
        found = self.numbers(count, "u1", f"bytes of the {what}").tobytes()
        return found.partition(b"\0")[0].decode("utf-8", "replace")

    def end(self) -> None:
        """Refuse bytes behind the last."""
        if not self.at_end:
            rest = shown(self.raw[self.at : self.at + 20])
            raise MeshError(f"{self.name} continues after its last value, with {rest}; its counts are wrong.")


# ---------------------------------------------------------------------- labels
LABEL = ".label"


def is_label(path: str | os.PathLike[str]) -> bool:
    """Return whether a file is a label of FreeSurfer by its name."""
    return os.path.basename(path).lower().removesuffix(GZIP).endswith(LABEL)


def label_name(path: str | os.PathLike[str]) -> str:
    """Name a label after its file: "cortex" for lh.cortex.label."""
    name = os.path.basename(path)
    name = name[: -len(GZIP)] if name.lower().endswith(GZIP) else name
    name = name[: -len(LABEL)] if name.lower().endswith(LABEL) else name
    return name[3:] if name[:3].lower() in ("lh.", "rh.") else name


def read_label(raw: bytes, name: str, n_vertices: int | None = None) -> IntArray:
    """Read (k,) the ids of the vertices in a label, in its order.

    Raises MeshError, with the line, where it is no label, is cut off, or names a vertex that is not among `n_vertices`,
    if that is known.
    """
    if not raw.startswith(_BEGINNING):
        raise MeshError(f"{name} is not a FreeSurfer label: its first line does not begin with '#!ascii label'.")
    lines = TextLines(raw, name, comment=b"#")
    if not len(lines):
        raise MeshError(f"{name} is cut off: the number of its vertices, on the second line, is missing.")
    numbers = lines.numbers(np.ones(len(lines), bool))
    count = numbers.values[0]
    if numbers.sizes[0] != 1 or not (count.is_integer() and count >= 0):
        raise MeshError(f"{name}, line {numbers.number[0]}: {lines.line(0)} is not the number of its vertices.")
    if count != len(numbers) - 1:
        announced = counted(int(count), "vertex", "vertices")
        why = "it is cut off" if count > len(numbers) - 1 else "it continues after the last"
        raise MeshError(f"{name} announces {announced} and lists {len(numbers) - 1:,}; {why}.")
    wrong = np.flatnonzero(numbers.sizes[1:] != 5)
    if len(wrong):
        k = int(wrong[0]) + 1
        raise MeshError(f"{name}, line {numbers.number[k]}: {lines.line(k)} is not a vertex, x, y, z and a value.")
    ids = numbers.columns(5, slice(1, None))[:, 0] if count else np.empty(0)
    unassigned = np.flatnonzero(ids == -1)
    if len(unassigned):
        line = numbers.number[unassigned[0] + 1]
        raise MeshError(
            f"{name}, line {line}: vertex -1 is a place that belongs to no vertex; map the label onto the surface "
            "first, with FreeSurfer's mri_label2label."
        )
    most = np.inf if n_vertices is None else n_vertices
    wrong = np.flatnonzero(~((ids >= 0) & (ids < min(most, 2**31)) & (ids == np.floor(ids))))
    if len(wrong):
        k = wrong[0]
        there = "a whole number from 0" if n_vertices is None else f"one of the {n_vertices:,} of the surface"
        raise MeshError(f"{name}, line {numbers.number[k + 1]}: vertex {ids[k]:g} is not {there}.")
    return ids.astype(np.int64)
