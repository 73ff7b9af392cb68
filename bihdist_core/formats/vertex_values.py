"""Values at vertices in files of brain imaging: GIFTI, and FreeSurfer's annotations and files such as lh.thickness."""

import os
from pathlib import Path

from ..arrays import AnyArray
from ..counts import counted
from ..errors import MeshError, ParameterError
from .freesurfer import read_annotation, read_values
from .gifti import POINTS, TRIANGLES, gifti_arrays
from .gzip_files import unpacked
from .mesh_names import GZIP, has_hemisphere

VALUE_FILES = ".gii, .annot, FreeSurfer's lh.thickness"
"""What is read, for a message."""


def is_vertex_values(path: str | os.PathLike[str]) -> bool:
    """Whether a file is one of values at vertices by its name; a file with another known extension comes before."""
    name = os.path.basename(path).lower().removesuffix(GZIP)
    return name.endswith((".gii", ".annot")) or (has_hemisphere(name) and not name.endswith((".npy", ".txt")))


def read_vertex_values(path: str | os.PathLike[str], what: str = "values") -> AnyArray:
    """(n,) the values at the vertices in a GIFTI file (.func.gii, .shape.gii, .label.gii) or a FreeSurfer file.

    Labels of GIFTI files are their keys, those of an annotation (.annot) the places in its table, -1 for none; values
    such as thickness are float32.  .gz may follow.  what: how a message speaks of them.

    Raises ParameterError, a sentence with the file and the place in it, for anything else.
    """
    path = Path(path)
    try:
        content = path.read_bytes() if path.is_file() else None
        if content is None:
            raise ParameterError(f"The {what} in {path} cannot be read: there is no such file.")
        if path.suffix.lower() == GZIP:
            content = unpacked(content, path.name)
        found = _values_in(content, path.name)
        return found.astype(found.dtype.newbyteorder("="))
    except OSError as error:
        raise ParameterError(f"The {what} in {path} cannot be read: {error.strerror or error}.") from None
    except MeshError as error:
        raise ParameterError(str(error)) from None


def _values_in(content: bytes, name: str) -> AnyArray:
    lower = name.lower().removesuffix(GZIP)
    if not lower.endswith(".gii"):
        return read_annotation(content, name).labels if lower.endswith(".annot") else read_values(content, name)
    arrays = [array for array in gifti_arrays(content, name) if array.intent not in (POINTS, TRIANGLES)]
    if len(arrays) != 1:
        raise ParameterError(f"{name} has {counted(len(arrays), 'array')} of values; one is needed.")
    values = arrays[0].values
    if values.size != len(values):
        raise ParameterError(f"{name} has values of the shape {values.shape}; one is needed for each vertex.")
    return values.reshape(-1)
