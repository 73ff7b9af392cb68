"""Arrays of values at vertices in files that any program has written, each with its name: thickness, curvature, labels.

An array with a value for each vertex has its name from the file; of a table, each column is an array.
"""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import MeshError, ParameterError
from ..sentences import shortened
from .array_file import archived_array, array_in, opened_archive
from .compression import MOST_BYTES
from .freesurfer import is_label, is_values, read_annotation, read_values
from .gifti import LABEL_INTENT, POINTS, TRIANGLES, gifti_arrays, label_colours, label_table
from .gltf import gltf_values
from .gltf_file import with_buffers
from .mat_file import mat_variables
from .mesh_names import GZIP, SHARED, beginning, is_mesh_file, mesh_format
from .ply import ply_values
from .text_lines import TextLines, plain_text
from .vertex_values import value_file
from .vtp import vtp_values

MOST_ARRAYS = 10_000
"""More columns are no choice."""
LISTED = 12
"""Arrays that a message names."""
PALETTE = ("#4477AA", "#EE6677", "#228833", "#CCBB44", "#66CCEE", "#AA3377", "#BBBBBB")
"""Of labels for which a file has no colours, in turn: Paul Tol's bright scheme, which the colour-blind can tell."""


@dataclass(frozen=True, eq=False)
class VertexArray:
    """Values (n,) at vertices, NaN where there is none.

    Those of labels are places in `names`, whose colours (k, 3) go from 0 to 1; other values have no names.
    """

    name: str
    values: FloatArray
    names: tuple[str, ...] = ()
    colours: FloatArray | None = None

    @property
    def vertex_colours(self) -> FloatArray:
        """The colours (n, 3) of labels, NaN where there is none."""
        assert self.colours is not None
        found = np.full((len(self.values), 3), np.nan)
        has = np.isfinite(self.values)
        found[has] = self.colours[self.values[has].astype(np.int64)]
        return found

    @property
    def counts(self) -> IntArray:
        """The number (k,) of vertices that have each label."""
        there = self.values[np.isfinite(self.values)].astype(np.int64)
        return np.bincount(there, minlength=len(self.names))

    def name_at(self, vertex: int) -> str:
        """Return the label of a vertex, "" for none."""
        return "" if np.isnan(self.values[vertex]) else self.names[int(self.values[vertex])]


def read_vertex_array(path: str | os.PathLike[str], array: str = "") -> VertexArray:
    """Read one array of values at vertices, by its name if the file has several.

    Raises ParameterError for a file that cannot be read, has none, or has several if none is named.
    """
    found = read_vertex_arrays(path)
    chosen = [each for each in found if not array or each.name == array]
    if len(chosen) == 1:
        return chosen[0]
    names = [each.name for each in found]
    listed = ", ".join(names[:LISTED]) + (f" and {len(names) - LISTED:,} more" if len(names) > LISTED else "")
    if array:
        raise ParameterError(f"{path} has no array {array!r}; it has {listed}.")
    raise ParameterError(f"{path} has {len(names):,} arrays, {listed}; name one behind a colon, {path}:{names[0]}.")


def split_array(text: str) -> tuple[str, str]:
    """Return the path and the array in FILE:ARRAY; the array is "" where no colon follows the name of a file."""
    colons = [k for k, letter in enumerate(text) if letter == ":"]
    for end in (len(text), *reversed(colons)):
        if os.path.isfile(text[:end]):
            return text[:end], text[end + 1 :]
    return text, ""


def is_vertex_array_file(path: str | os.PathLike[str]) -> bool:
    """Return whether a file holds values at vertices and no mesh, by its name or else by its content."""
    path = Path(path)
    form, extension = mesh_format(path), os.path.splitext(_plain_name(path))[1]
    if form in SHARED and path.is_file():
        return not is_mesh_file(path) and (extension in _READERS or is_values(beginning(path)))
    return extension in _READERS and not form


def array_name(path: str | os.PathLike[str], array: str = "") -> str:
    """Name an array after its file, "thickness" for lh.thickness, or by its own name in a file of several."""
    words = os.path.basename(path).split(".")
    while len(words) > 1 and words[-1].lower() in _ENDINGS:
        words.pop()
    stem = ".".join(words[len(words) > 1 and words[0].lower() in ("lh", "rh") :])
    return stem if not array else array if re.search("[^0-9]", array) else f"{stem} {array}"


def read_vertex_arrays(path: str | os.PathLike[str]) -> list[VertexArray]:
    """Read all arrays of values at vertices in a file, at least one.

    Raises ParameterError, with the file and the reason, for a file that cannot be read, or has none.
    """
    extension = os.path.splitext(_plain_name(path))[1]
    with value_file(path, "field") as content:
        if is_label(path):
            raise MeshError(f"{path} lists the vertices of a label, and has no values for the others.")
        reader = _READERS.get(extension)
        if is_values(content):
            reader = _from_freesurfer
        if reader is None:
            raise MeshError(
                f"{path} is of no kind of which fields are read: {', '.join(_READERS)}, and FreeSurfer's lh.thickness."
            )
        return _checked(path, reader(content, Path(path)))


def _plain_name(path: str | os.PathLike[str]) -> str:
    return os.path.basename(path).lower().removesuffix(GZIP)


def _checked(path: str | os.PathLike[str], found: Iterable[VertexArray]) -> list[VertexArray]:
    """Return the arrays with names of their own; ParameterError if there is none."""
    arrays: dict[str, VertexArray] = {}
    for each in found:
        name, k = each.name, 2
        while name in arrays:
            name, k = f"{each.name} {k}", k + 1
        arrays[name] = VertexArray(name, each.values, each.names, each.colours)
        if len(arrays) > MOST_ARRAYS:
            raise ParameterError(f"{path} has more than {MOST_ARRAYS:,} columns, and is no table of fields.")
    if not arrays:
        raise ParameterError(f"{path} has no array of real numbers with a value for each vertex.")
    return list(arrays.values())


def _columns(arrays: Mapping[str, AnyArray]) -> Iterable[VertexArray]:
    """Yield what is a column of real numbers in some arrays, along the longer side of each."""
    for name, array in arrays.items():
        if array.dtype.kind not in "biuf" or array.ndim not in (1, 2) or not array.size:
            continue
        table = array.reshape(-1, 1) if array.ndim == 1 or 1 in array.shape else array
        table = table.T if table.shape[0] < table.shape[1] else table
        if table.shape[1] > MOST_ARRAYS:
            continue
        for k, column in enumerate(table.T):
            own = name if table.shape[1] == 1 else f"{name} {k}".strip()
            yield VertexArray(own or "values", np.array(column, np.float64))


# ---------------------------------------------------------------------- readers
def _from_npy(content: bytes, path: Path) -> Iterable[VertexArray]:
    try:
        return _columns({"": array_in(io.BytesIO(content), len(content))})
    except ParameterError as error:
        raise ParameterError(f"The field in {path} cannot be read: {error}") from None


def _from_npz(content: bytes, path: Path) -> Iterable[VertexArray]:
    with opened_archive(io.BytesIO(content), path) as archive:
        names = [name.removesuffix(".npy") for name in archive.namelist() if name.endswith(".npy")]
        if sum(entry.file_size for entry in archive.infolist()) > MOST_BYTES:
            raise ParameterError(f"{path} unpacks to more than {MOST_BYTES / 2**30:g} GiB; it is not read.")
        return list(_columns({name: archived_array(archive, name, path) for name in names}))


_MISSING = (b"NA", b"N/A", b"null", b"None")
"""What stands in tables where there is no value."""


def _from_table(content: bytes, path: Path) -> Iterable[VertexArray]:
    """Read the columns of a text, between which commas, semicolons, tabs or blanks stand."""
    text = re.sub(rb"#[^\n]*", b"", plain_text(content, path.name)).strip()
    head, _, rest = text.partition(b"\n")
    separator = next((each for each in (b"\t", b";", b",") if each in head), b" ")
    texts = next(csv.reader([head.decode("utf-8", "replace")], delimiter=separator.decode()), [])
    names = [name.strip() for name in texts] if separator != b" " else head.decode("utf-8", "replace").split()
    if all(map(_is_number, names)):
        names, rest = [], text
    if separator != b" ":
        rest = rest.replace(b",", b".") if separator == b";" else rest  # as where commas are decimal
        rest = re.sub(rb"\n\s*\n", b"\n", rest.replace(b'"', b""))
        ends = (separator * 2, separator + b"\n", b"\n" + separator, separator + b" ")
        if any(each in b"\n%b\n" % rest for each in ends):  # there may be empty cells
            rest = re.sub(rb"(?m)(^|[,;\t])[ ]*(?=[,;\t]|$)", rb"\1nan", rest)
        rest = rest.replace(separator, b" ")
    if any(word in rest for word in _MISSING):
        rest = re.sub(rb"(?<!\S)(%b)(?!\S)" % b"|".join(_MISSING), b"nan", rest)
    lines = TextLines(rest, path.name)
    if not len(lines):
        raise MeshError(f"{path.name} has no lines of numbers.")
    sizes, first = lines.word_count, len(names) or int(lines.word_count[0])
    if (sizes != first).any():
        k = int(np.argmax(sizes != first))
        line = k + 1 + bool(names)
        raise MeshError(f"{path.name}, line {line}: there are {sizes[k]} values where {first} belong.")
    table = lines.numbers(np.ones(len(lines), bool)).values.reshape(len(lines), first)
    if first > 1 and (order := _ids(table[:, 0])) is not None:
        table, names = table[order, 1:], names[1:]
    if not names:
        return _columns({"": table})
    columns = zip(names, table.T, strict=True)
    named = (name or f"{k}" * bool(np.isfinite(column).any()) for k, (name, column) in enumerate(columns))
    return _columns({name: column for name, column in zip(named, table.T, strict=True) if name})


def _is_number(text: str) -> bool:
    try:
        float(text.replace(",", ".") or "nan")
    except ValueError:
        return False
    return True


def _ids(column: FloatArray) -> AnyArray | None:
    """Return the order (n,) of the lines of a table whose first column has the ids of all vertices; None for values."""
    order = np.argsort(column, kind="stable")
    begin = column[order[0]]
    is_all = begin in (0, 1) and np.array_equal(column[order], begin + np.arange(len(column)))
    return order if is_all else None


def _from_mat(content: bytes, path: Path) -> Iterable[VertexArray]:
    variables = mat_variables(content, path.name)
    return _columns({name: array for name, array in variables.items() if isinstance(array, np.ndarray)})


def _from_gifti(content: bytes, path: Path) -> Iterable[VertexArray]:
    arrays = [each for each in gifti_arrays(content, path.name) if each.intent not in (POINTS, TRIANGLES)]
    names, colours = label_table(content, path.name), label_colours(content, path.name)
    for k, array in enumerate(arrays):
        name = array.name or ("" if len(arrays) == 1 else f"{k}")
        if array.intent == LABEL_INTENT and array.values.size == len(array.values):
            yield _labels(name, array.values.reshape(-1), names, colours)
        else:
            yield from _columns({name: array.values})


def _labels(
    name: str, keys: AnyArray, names: Mapping[int, str], colours: Mapping[int, tuple[float, ...]]
) -> VertexArray:
    """Return labels by their keys (n,); those without a name, or without an opaque colour, are none."""
    known = [key for key in names if colours.get(key, (0, 0, 0, 1))[3] > 0]
    values = np.full(len(keys), np.nan)
    of = np.array([names[key] for key in known])
    for place, key in enumerate(known):
        values[keys == key] = place
    own = [colours.get(key) or _rgb(PALETTE[place % len(PALETTE)]) for place, key in enumerate(known)]
    return VertexArray(
        name or "labels", values, tuple(of.tolist()), np.array([each[:3] for each in own]).reshape(-1, 3)
    )


def _rgb(colour: str) -> tuple[float, ...]:
    return tuple(int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))


def _from_annotation(content: bytes, path: Path) -> Iterable[VertexArray]:
    found = read_annotation(content, path.name)
    values = np.where(found.labels < 0, np.nan, found.labels)
    return [VertexArray(array_name(path), values, found.names, found.colours)]


def _from_freesurfer(content: bytes, path: Path) -> Iterable[VertexArray]:
    return _columns({array_name(path): read_values(content, path.name)})


def _from_cifti(content: bytes, path: Path) -> Iterable[VertexArray]:
    """Read the maps of a CIFTI file on each of its surfaces, NaN where it has no value."""
    try:
        cifti: Any = import_module("nibabel.cifti2")
    except ImportError:
        raise MeshError(f"{path.name} is a CIFTI file, which nibabel reads; install nibabel.") from None
    try:
        image = cifti.Cifti2Image.from_bytes(content)
        maps, models = (image.header.get_axis(k) for k in (0, 1))
        if not isinstance(models, cifti.BrainModelAxis):
            raise TypeError("its columns are no vertices")
        data = np.asarray(image.dataobj, np.float64)
        surfaces = [each for each in models.iter_structures() if each[0] in models.nvertices]
        found = []
        for k in range(len(data)):
            title = str(getattr(maps, "name", range(len(data)))[k])
            for structure, columns, model in surfaces:
                side = structure.removeprefix("CIFTI_STRUCTURE_").removeprefix("CORTEX_").lower()
                name = title if len(surfaces) == 1 else f"{title} {side}"
                values = np.full(models.nvertices[structure], np.nan)
                values[model.vertex] = data[k, columns]
                if isinstance(maps, cifti.LabelAxis):
                    table = maps.label[k]
                    names = {key: word for key, (word, _) in table.items()}
                    found.append(_labels(name, values, names, {key: rgba for key, (_, rgba) in table.items()}))
                else:
                    found.append(VertexArray(name, values))
        return found
    except Exception as error:  # of nibabel's reader, which says of damaged files whatever it meets
        raise MeshError(f"{path.name} is not a CIFTI file, or is damaged ({shortened(str(error), 100)}).") from None


_Reader = Callable[[bytes, Path], Iterable[VertexArray]]
_READERS: dict[str, _Reader] = {
    ".npy": _from_npy,
    ".npz": _from_npz,
    ".csv": _from_table,
    ".txt": _from_table,
    ".mat": _from_mat,
    ".vtp": lambda content, path: _columns(vtp_values(content, path.name)),
    ".vtu": lambda content, path: _columns(vtp_values(content, path.name)),
    ".ply": lambda content, path: _columns(ply_values(content, path.name)),
    ".gltf": lambda content, path: _columns(gltf_values(with_buffers(content, path), path.name)),
    ".glb": lambda content, path: _columns(gltf_values(content, path.name)),
    ".gii": _from_gifti,
    ".annot": _from_annotation,
    ".nii": _from_cifti,
}
ARRAY_FORMATS = tuple(_READERS)
"""Extensions of files with values at vertices; FreeSurfer's, such as lh.thickness, have none."""
_ENDINGS = {"gz", "func", "shape", "label", "dscalar", "dlabel", *(name.removeprefix(".") for name in ARRAY_FORMATS)}
