"""FreeSurfer's labels (lh.cortex.label): vertices of a surface as lines of text, `vertex x y z value`."""

import os

import numpy as np

from ..arrays import IntArray
from ..counts import counted
from ..errors import MeshError
from .mesh_names import GZIP
from .text_lines import TextLines

LABEL = ".label"
_BEGINNING = b"#!ascii"


def is_label(path: str | os.PathLike[str]) -> bool:
    """Whether a file is a label of FreeSurfer by its name."""
    return os.path.basename(path).lower().removesuffix(GZIP).endswith(LABEL)


def label_name(path: str | os.PathLike[str]) -> str:
    """What a label is called by its file: "cortex" of lh.cortex.label."""
    name = os.path.basename(path)
    name = name[: -len(GZIP)] if name.lower().endswith(GZIP) else name
    name = name[: -len(LABEL)] if name.lower().endswith(LABEL) else name
    return name[3:] if name[:3].lower() in ("lh.", "rh.") else name


def read_label(raw: bytes, name: str, n_vertices: int | None = None) -> IntArray:
    """(k,) the ids of the vertices in a label, in its order.

    n_vertices: of the surface that it is one of, if that is known.  MeshError, with the line, where it is no label, is
    cut off, or names a vertex that there is not.
    """
    if not raw.startswith(_BEGINNING):
        raise MeshError(f"{name} is no label of FreeSurfer: its first line does not begin with '#!ascii label'.")
    lines = TextLines(raw, name, comment=b"#")
    if not len(lines):
        raise MeshError(f"{name} is cut off: the number of its vertices, on the second line, is missing.")
    numbers = lines.numbers(np.ones(len(lines), bool))
    count = numbers.values[0]
    if numbers.sizes[0] != 1 or not (count.is_integer() and count >= 0):
        raise MeshError(f"{name}, line {numbers.number[0]}: {lines.line(0)} is not the number of its vertices.")
    if count != len(numbers) - 1:
        announced = counted(int(count), "vertex", "vertices")
        why = "it is cut off" if count > len(numbers) - 1 else "it goes on behind the last"
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
