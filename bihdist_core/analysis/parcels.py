"""Mean distances between the parcels of a labelled surface, without the distances between all its vertices."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy import sparse

from ..arrays import BoolArray, FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..progress import Progress, silent
from ..surface import Surface

MEMORY = 3e8
"""Bytes that the fields of one block may take, unless another number is given."""
BYTES_PER_VALUE = 24
"""In memory, at once, for each distance of a block."""


@dataclass(frozen=True, eq=False)
class Parcels:
    """Mean distances between the parcels that labels divide the vertices into.

    labels: (p,) ascending.  counts: (p,) vertices of each.  means: (p, p), symmetric: over all pairs of a vertex of the
    one and a vertex of the other, in the distance's unit; NaN where any pair has none.  On the diagonal the pairs are
    those within a parcel, each vertex with itself among them.
    """

    labels: IntArray
    counts: IntArray
    means: FloatArray


@dataclass(frozen=True, eq=False)
class ParcelSums:
    """labels: (p,); counts: (p,); sums: (p, p), of a column's parcel over a part of its vertices.

    Parts of one surface's vertices are added up: they may be computed apart, in any order.
    """

    labels: IntArray
    counts: IntArray
    sums: FloatArray

    def __add__(self, other: "ParcelSums") -> "ParcelSums":
        return ParcelSums(self.labels, self.counts, self.sums + other.sums)

    @property
    def parcels(self) -> Parcels:
        """The means, once all parts have been added up."""
        means = self.sums / np.outer(self.counts, self.counts)
        return Parcels(self.labels, self.counts, (means + means.T) / 2)


def parcel_means(
    distance: Distance,
    labels: npt.ArrayLike,
    mask: npt.ArrayLike | None = None,
    memory: float = MEMORY,
    progress: Progress | None = None,
) -> Parcels:
    """The mean distances between parcels of vertices.

    labels: (n,) whole numbers, negative where a vertex belongs to none; mask: (n,) which vertices count, or all.

    Costs a field for each vertex that counts; holds those of a block, and (p, p) sums.  memory: bytes for a block.
    Raises ParameterError for labels or a mask of another shape or kind, and if nothing is left.
    """
    chosen = labelled(distance.surface, labels, mask)
    return parcel_sums(distance, labels, mask, 0, len(chosen), memory, progress).parcels


def parcel_sums(
    distance: Distance,
    labels: npt.ArrayLike,
    mask: npt.ArrayLike | None,
    begin: int,
    end: int,
    memory: float = MEMORY,
    progress: Progress | None = None,
) -> ParcelSums:
    """The sums over the columns begin to end of those that `labelled` lists."""
    surface = distance.surface
    vertices = labelled(surface, labels, mask)
    names, parcel = np.unique(np.asarray(labels)[vertices], return_inverse=True)
    p, of_vertex = len(names), surface.component_of_vertex
    counts = np.bincount(parcel, minlength=p)
    sums = np.zeros((p, p))
    longest = int(np.bincount(of_vertex[of_vertex >= 0])[of_vertex[vertices]].max())
    step = int(np.clip(memory / (longest * BYTES_PER_VALUE), 1, max(end - begin, 1)))
    for start in range(begin, end, step):
        some = slice(start, min(start + step, end))
        (progress or silent)((start - begin) / (end - begin), f"{start - begin:,} of {end - begin:,} columns")
        for component, mine, columns in distance.columns_by_component(vertices[some]):
            here = of_vertex[vertices] == component.index
            into = _sums_into(parcel[here], component.local(vertices[here]), (p, len(columns)))
            of_column = _sums_into(parcel[some][mine], np.arange(len(mine)), (p, len(mine)))
            sums += of_column @ (into @ columns).T
            is_elsewhere = np.bincount(parcel[~here], minlength=p) > 0
            sums[np.ix_(np.unique(parcel[some][mine]), is_elsewhere)] = np.nan
    (progress or silent)(1.0, f"{end - begin:,} columns")
    return ParcelSums(names, counts, sums)


def _sums_into(rows: IntArray, columns: IntArray, shape: tuple[int, int]) -> sparse.csr_array:
    """The matrix that adds up what stands at those columns, into those rows."""
    return sparse.csr_array((np.ones(len(rows)), (rows, columns)), shape=shape)


def labelled(surface: Surface, labels: npt.ArrayLike, mask: npt.ArrayLike | None = None) -> IntArray:
    """The vertices that have a label, belong to a face and are not masked, by component, by label, then by number.

    ParameterError for labels or a mask of another shape or kind, and if there is none.
    """
    numbers, n = np.asarray(labels), len(surface.vertices)
    if numbers.shape != (n,) or numbers.dtype.kind not in "iu":
        raise ParameterError(
            f"Labels are whole numbers, one for each of the {n:,} vertices of {surface.name}; "
            f"these have the shape {numbers.shape} and the type {numbers.dtype}."
        )
    counts = (numbers >= 0) & (surface.component_of_vertex >= 0)
    if mask is not None:
        counts &= checked_mask(surface, mask)
    vertices = np.flatnonzero(counts)
    if not len(vertices):
        raise ParameterError(f"No vertex of {surface.name} has a label and is not masked.")
    return vertices[np.lexsort((numbers[vertices], surface.component_of_vertex[vertices]))]


def checked_mask(surface: Surface, mask: npt.ArrayLike) -> BoolArray:
    """(n,) which vertices count; ParameterError for anything but n times yes or no."""
    flags, n = np.asarray(mask), len(surface.vertices)
    what = f"A mask has 0 or 1 for each of the {n:,} vertices of {surface.name}"
    if flags.shape != (n,):
        raise ParameterError(f"{what}; this one has the shape {flags.shape}.")
    wrong = np.flatnonzero(~np.isin(flags, (0, 1)))
    if len(wrong):
        raise ParameterError(f"{what}; vertex {wrong[0]} has {flags[wrong[0]]}.")
    return flags.astype(bool)
