"""Files of whole numbers: a .npy array, a text with some on each line and remarks after #, or values at vertices."""

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import AnyArray, IntArray
from ..errors import ParameterError
from ..file_content import file_text
from ..sentences import shortened
from .array_file import read_array
from .freesurfer import label_name, read_annotation
from .gifti import label_table
from .mesh_names import GZIP
from .vertex_values import VALUE_FILES, is_vertex_values, read_vertex_values, value_file

NUMBER_FORMATS = (".npy", ".txt")
WHOLE = re.compile("-?[0-9]{1,15}")
MOST = 10**15
"""Larger ones are no numbers of vertices or labels, and floats do not hold all of them."""


def read_whole_numbers(path: str | os.PathLike[str], what: str, n_vertices: int | None = None) -> IntArray:
    """Read (n,) the numbers in a file, of which a message speaks as `what`: "map", "mask".

    .npy, .txt, and what `read_vertex_values` reads: .gii, .annot, values of FreeSurfer, and labels
    (.label), whose vertices have 1 among n_vertices.

    Raises ParameterError, a sentence with the file, the place in it and the value, for anything else.
    """
    path = Path(path)
    if is_vertex_values(path):
        return _whole_values(read_vertex_values(path, what, n_vertices), path, what)
    if path.suffix.lower() not in NUMBER_FORMATS:
        raise ParameterError(
            f"{path} is not a file of the {what}; such files are {', '.join(NUMBER_FORMATS)}, {VALUE_FILES}."
        )
    return _array_in(path, what) if path.suffix.lower() == ".npy" else _numbers_in(path, what)


def _array_in(path: Path, what: str) -> IntArray:
    array = read_array(path, f"{what} in")
    if array.ndim not in (1, 2):
        raise ParameterError(f"The {what} in {path} is not an array of whole numbers.")
    if array.ndim == 2 and 1 not in array.shape:
        raise ParameterError(
            f"The {what} in {path} has shape {array.shape}; a {what} is one whole number for each vertex."
        )
    return _whole_values(array.reshape(-1), path, what)


def _whole_values(flat: AnyArray, path: Path, what: str) -> IntArray:
    if flat.dtype.kind == "f" and (np.abs(flat) <= MOST).all() and (flat == np.floor(flat)).all():
        flat = flat.astype(np.int64)
    if flat.dtype.kind not in "biu":
        raise ParameterError(f"The {what} in {path}: {flat.dtype} values that are not whole numbers.")
    if flat.size and not -MOST <= int(flat.min()) <= int(flat.max()) <= MOST:
        largest = max(int(flat.max()), int(flat.min()), key=abs)
        raise ParameterError(f"The {what} in {path}: {largest} is larger than any vertex id or label can be.")
    return flat.astype(np.int64)


def _numbers_in(path: Path, what: str) -> IntArray:
    found = []
    for number, line in text_lines(path, what):
        for word in line.partition("#")[0].replace(",", " ").split():
            found.append(_whole(word, f"{path}, line {number}"))
    return np.array(found, np.int64)


def _whole(word: str, where: str) -> int:
    """Return a whole number, which may be written as a float is."""
    if WHOLE.fullmatch(word):
        return int(word)
    try:
        number = float(word)
    except ValueError:
        number = float("nan")
    if not number.is_integer() or abs(number) > MOST:
        raise ParameterError(f"{where}: {shortened(repr(word), 60)} is not a whole number.")
    return int(number)


def text_lines(path: Path, what: str) -> list[tuple[int, str]]:
    """Return the lines that are not empty, with their numbers; ParameterError if the file cannot be read."""
    return numbered_lines(file_text(path, f"{what} in"))


def numbered_lines(text: str) -> list[tuple[int, str]]:
    """Return the lines of a text that are not empty, with their numbers."""
    return [(number, line.strip()) for number, line in enumerate(text.splitlines(), 1) if line.strip()]


# ---------------------------------------------------------------------- labels
@dataclass(frozen=True, eq=False)
class ParcelLabels:
    """Labels of vertices, values (n,) below 0 for none, and names by value where the file has them."""

    values: IntArray
    names: Mapping[int, str]


def read_labels(path: str | os.PathLike[str], n_vertices: int) -> ParcelLabels:
    """Read the labels of a surface's vertices, of any file that `read_whole_numbers` reads, and their names.

    Those of GIFTI (.label.gii) and of an annotation (.annot) are in the file; the vertices of a FreeSurfer label
    (lh.V1.label) have 0, which is called as the file, and all others -1. Raises ParameterError, a sentence with the
    file and the place in it, for what cannot be read.
    """
    name = os.path.basename(path).lower().removesuffix(GZIP)
    if name.endswith(".label"):
        return ParcelLabels(read_whole_numbers(path, "labels", n_vertices) - 1, {0: label_name(path)})
    values = read_whole_numbers(path, "labels", n_vertices)
    if name.endswith(".annot"):
        with value_file(path, "labels") as content:
            return ParcelLabels(values, dict(enumerate(read_annotation(content, Path(path).name).names)))
    if name.endswith(".gii"):
        with value_file(path, "labels") as content:
            return ParcelLabels(values, label_table(content, Path(path).name))
    return ParcelLabels(values, {})
