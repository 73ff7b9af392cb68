"""Values at vertices in files of brain imaging: GIFTI, and FreeSurfer's .annot, .label and lh.thickness."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from ..arrays import AnyArray, IntArray
from ..counts import counted
from ..errors import MeshError, ParameterError
from .compression import unpacked
from .freesurfer import LABEL, is_label, read_annotation, read_label, read_values
from .gifti import POINTS, TRIANGLES, gifti_arrays, with_external_data
from .mesh_names import GZIP, has_hemisphere

VALUE_FILES = ".gii, .annot, .label, FreeSurfer's lh.thickness"
"""The formats that are read, for a message."""


def is_vertex_values(path: str | os.PathLike[str]) -> bool:
    """Tell by its name whether a file holds values at vertices; other known extensions take precedence."""
    name = os.path.basename(path).lower().removesuffix(GZIP)
    return name.endswith((".gii", ".annot", LABEL)) or (has_hemisphere(name) and not name.endswith((".npy", ".txt")))


def read_vertex_values(path: str | os.PathLike[str], what: str = "values", n_vertices: int | None = None) -> AnyArray:
    """Read values at vertices from a GIFTI or FreeSurfer file.

    Parameters
    ----------
    path : str or path-like
        A file .func.gii, .shape.gii, .label.gii, .annot, .label, or such as lh.thickness; .gz may follow.
    what : str
        How messages speak of the values.
    n_vertices : int, optional
        How many vertices the surface has, which a .label file needs.

    Returns
    -------
    (n,) ndarray
        The values. Labels of GIFTI files are their keys, those of an annotation the places in its table, -1 for none.
        The vertices that a .label lists have 1, all others 0. Values such as thickness are float32.

    Raises
    ------
    ParameterError
        For anything else; the message names the file and the place in it.

    Examples
    --------
    >>> import bihdist
    >>> from pathlib import Path
    >>> _ = Path("lh.V1.label").write_text('''#!ascii label
    ... 2
    ... 0 0 0 0 0
    ... 3 1 1 1 0''')
    >>> bihdist.read_vertex_values("lh.V1.label", n_vertices=5).tolist()
    [1, 0, 0, 1, 0]
    """
    with value_file(path, what) as content:
        found = _values_in(content, Path(path).name, what, n_vertices)
        return found.astype(found.dtype.newbyteorder("="))


def read_label_vertices(path: str | os.PathLike[str], n_vertices: int) -> IntArray:
    """Read (k,) the vertices that a FreeSurfer label lists, of a surface with n_vertices.

    Raises ParameterError as `read_vertex_values`.
    """
    with value_file(path, "label") as content:
        return read_label(content, Path(path).name, n_vertices)


@contextmanager
def value_file(path: str | os.PathLike[str], what: str) -> Iterator[bytes]:
    """Open a file of values, unpacked; what is wrong with it, on reading and inside, is a ParameterError."""
    path = Path(path)
    try:
        content = path.read_bytes() if path.is_file() else None
        if content is None:
            raise ParameterError(f"The {what} in {path} cannot be read: there is no such file.")
        content = unpacked(content, path.name) if path.suffix.lower() == GZIP else content
        yield with_external_data(content, path) if path.name.lower().removesuffix(GZIP).endswith(".gii") else content
    except OSError as error:
        raise ParameterError(f"The {what} in {path} cannot be read: {error.strerror or error}.") from None
    except MeshError as error:
        raise ParameterError(str(error)) from None


def _values_in(content: bytes, name: str, what: str, n_vertices: int | None) -> AnyArray:
    lower = name.lower().removesuffix(GZIP)
    if is_label(name):
        if n_vertices is None:
            raise MeshError(f"{name} lists the vertices of a label; the {what} needs a value for each vertex.")
        mask = np.zeros(n_vertices, np.int64)
        mask[read_label(content, name, n_vertices)] = 1
        return mask
    if not lower.endswith(".gii"):
        return read_annotation(content, name).labels if lower.endswith(".annot") else read_values(content, name)
    arrays = [array for array in gifti_arrays(content, name) if array.intent not in (POINTS, TRIANGLES)]
    if len(arrays) != 1:
        raise ParameterError(f"{name} has {counted(len(arrays), 'array')} of values; one is needed.")
    values = arrays[0].values
    if values.size != len(values):
        raise ParameterError(f"{name} has values of the shape {values.shape}; one is needed for each vertex.")
    return values.reshape(-1)
