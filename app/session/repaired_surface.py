"""A surface with what is cut out of it, and vertices merged, as a document or a command says."""

import os

import numpy as np

from bihdist_core import MeshError, ParameterError, Surface, read_surface
from bihdist_core.analysis.parcels import checked_mask
from bihdist_core.arrays import IntArray
from bihdist_core.file_output import atomic_write
from bihdist_core.formats.whole_numbers import read_whole_numbers

from ..document.file import checksum
from ..document.repairs import Repairs


def repaired(surface: Surface, repairs: Repairs, remedy: str = "") -> tuple[Surface, IntArray | None]:
    """Return the surface after the repairs, and (n,) the id there of each vertex here, None where all keep theirs.

    `remedy` is a sentence on what to do where the mask is not the one meant. ParameterError for a mask that cannot be
    read, does not fit, or has changed since its checksum was taken; MeshError where no face is left.
    """
    if repairs.cut:
        mask = read_whole_numbers(repairs.cut, "mask", surface.n_vertices)
        if repairs.cut_sha256 and checksum(repairs.cut) != repairs.cut_sha256:
            sentence = f"The mask {repairs.cut} has changed since its checksum was recorded."
            raise ParameterError(f"{sentence} {remedy}".strip())
        try:
            surface = surface.without(~checked_mask(surface, mask))
        except (ParameterError, MeshError) as error:
            raise type(error)(f"{repairs.cut}: {error}") from None
    surface, ids = (surface, None) if repairs.merge is None else surface.merged(repairs.merge)
    if repairs.largest_component and surface.n_components > 1:
        surface = surface.without(surface.component_of_vertex > 0)
    return surface, ids


def read_repaired(path: str, repairs: Repairs) -> Surface:
    """Return the surface in a file after the repairs; the errors of `read_surface` and of `repaired`."""
    return repaired(read_surface(path), repairs)[0]


def write_ids(path: str | os.PathLike[str], ids: IntArray) -> None:
    """Write the table of `ids_table`; OutputError where it cannot be."""
    with atomic_write(path) as temporary:
        temporary.write_text(ids_table(ids), encoding="ascii")


def ids_table(ids: IntArray) -> str:
    """Return the new id of each vertex of a file, given as by `repaired`, as rows `old,new`."""
    return "".join(["old,new\n", *(f"{old},{new}\n" for old, new in enumerate(ids.tolist()))])


def kept_ids(ids: IntArray | None, count: int) -> IntArray:
    """Return (k,) the vertices of a file, of `count`, that the repaired surface has; `ids` is from `repaired`."""
    return np.arange(count) if ids is None else np.unique(ids, return_index=True)[1]
