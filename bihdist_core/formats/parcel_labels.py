"""Labels of vertices in files, with the names that some files have for them."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..arrays import IntArray
from .freesurfer import read_annotation
from .freesurfer_label import label_name
from .gifti import label_table
from .mesh_names import GZIP
from .vertex_values import value_file
from .whole_numbers import read_whole_numbers


@dataclass(frozen=True, eq=False)
class ParcelLabels:
    """values: (n,) of the vertices, below 0 for none.  names: by value, of those that the file has a name for."""

    values: IntArray
    names: Mapping[int, str]


def read_labels(path: str | os.PathLike[str], n_vertices: int) -> ParcelLabels:
    """The labels of a surface's vertices, of any file that `read_whole_numbers` reads, and their names.

    Those of GIFTI (.label.gii) and of an annotation (.annot) are in the file; the vertices of a FreeSurfer label
    (lh.V1.label) have 0, which is called as the file, and all others -1.  Raises ParameterError, a sentence with the
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
