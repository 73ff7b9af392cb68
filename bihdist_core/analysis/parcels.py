"""Distances between the parcels of a labelled surface, without the distances between all its vertices."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
from scipy import sparse

from ..arrays import AnyArray, BoolArray, FloatArray, IntArray, array_of
from ..distances.distance import Distance
from ..errors import ParameterError
from ..progress import Progress, part, silent, steps
from ..scalars import real_number
from ..sources.pieces import points_on
from ..surface import Surface

MEMORY = 3e8
"""Bytes that the fields of one block may take, unless another number is given."""
BYTES_PER_VALUE = 24
"""In memory, at once, for each distance of a block."""


REDUCTIONS = ("mean", "min", "centroid", "hausdorff")
"""The rules that make one number of the distances between two parcels (`parcel_means`)."""


@dataclass(frozen=True, eq=False)
class Parcels:
    """Distances between the parcels that labels divide the vertices into.

    Attributes
    ----------
    labels : (p,) ndarray
        The labels, ascending.
    counts : (p,) int64 ndarray
        Vertices of each parcel.
    distances : (p, p) float64 ndarray
        Symmetric, in the distance's unit.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> labels = (plane.points[:, 0] > 0).astype(int)  # the left half, and the right
    >>> parcels = bihdist.parcel_means(bihdist.GeodesicDistance(plane), labels)
    >>> parcels.labels.tolist()
    [0, 1]
    >>> parcels.counts.tolist()
    [45, 36]
    >>> parcels.distances.round(3).tolist()
    [[0.461, 0.718], [0.718, 0.434]]
    """

    labels: AnyArray
    counts: IntArray
    distances: FloatArray


@dataclass(frozen=True, eq=False)
class ParcelSums:
    """Sums of distances between parcels over some columns; sums over disjoint columns can be added, in any order.

    `labels` (p,), `counts` (p,), and `sums` (p, p), whose rows are the columns' parcels. `weights` (p,) are those of
    all vertices of a parcel.
    """

    labels: AnyArray
    counts: IntArray
    sums: FloatArray
    weights: FloatArray | IntArray

    def __add__(self, other: ParcelSums) -> ParcelSums:
        return replace(self, sums=self.sums + other.sums)

    @property
    def parcels(self) -> Parcels:
        """The means, once the sums over all columns have been added."""
        means = self.sums / np.outer(self.weights, self.weights)
        return Parcels(self.labels, self.counts, (means + means.T) / 2)


def parcel_means(
    distance: Distance,
    labels: npt.ArrayLike,
    mask: npt.ArrayLike | None = None,
    memory: float = MEMORY,
    progress: Progress | None = None,
    *,
    reduce: str = "mean",
    weights: str | None = None,
) -> Parcels:
    """Compute one distance between each two parcels of vertices.

    Parameters
    ----------
    distance : Distance
        The distance.
    labels : (n,) array_like
        Whole numbers, negative where a vertex belongs to no parcel, or strings, empty there.
    mask : (n,) array_like, optional
        Which vertices count, as 0 or 1; all by default.
    memory : float
        Bytes that the fields of one block may take.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    reduce : {"mean", "min", "hausdorff", "centroid"}
        How one number is made of the distances between the vertices of two parcels.
        "mean": over all pairs, within a parcel each vertex with itself among them; NaN where a pair has no distance.
        Costs a field for each vertex that counts.
        "min": the least.
        "hausdorff": the greatest distance of a vertex of either to the nearest of the other; NaN where one is not
        reached.
        "min" and "hausdorff" cost one field from each parcel for geodesic distances, else one from each vertex.
        "centroid": between the vertices that are nearest to the mean positions.
    weights : {None, "area"}
        Whether vertices are weighted by their areas in means and mean positions.

    Returns
    -------
    Parcels
        The distances.

    Raises
    ------
    ParameterError
        For labels or a mask of another shape or kind, another word, and if no vertex is left.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> labels = (plane.points[:, 0] > 0).astype(int)  # the left half, and the right
    >>> for way in ("mean", "min", "hausdorff", "centroid"):
    ...     parcels = bihdist.parcel_means(distance, labels, reduce=way)
    ...     print(way, parcels.distances[0, 1].round(3))
    mean 0.718
    min 0.125
    hausdorff 0.625
    centroid 0.5
    """
    if reduce not in REDUCTIONS:
        raise ParameterError(f"Distances of parcels are reduced by {', '.join(REDUCTIONS)}, not by {reduce!r}.")
    vertices = labelled(distance.surface, labels, mask)
    if reduce == "mean":
        return parcel_sums(distance, labels, mask, 0, len(vertices), memory, progress, weights).parcels
    names, parcel, counts = np.unique(_as_labels(labels)[vertices], return_inverse=True, return_counts=True)
    members = [vertices[parcel == k] for k in range(len(names))]
    if reduce == "centroid":
        of_each = _weights(distance, weights)
        centres = [_central(distance.surface.vertices[mine], of_each[mine]) for mine in members]
        found = distance.pairwise([mine[k] for mine, k in zip(members, centres, strict=True)], progress)
    else:
        found = _from_nearest(distance, members, np.fmin if reduce == "min" else np.maximum, progress)
        found = (found + found.T) / 2 if reduce == "min" else np.maximum(found, found.T)
    return Parcels(names, counts, found)


def _from_nearest(
    distance: Distance, members: list[IntArray], reduce: np.ufunc, progress: Progress | None
) -> FloatArray:
    """Return (p, p) how far each parcel's vertices are from the nearest of another's, reduced to one number."""
    found = np.empty((len(members), len(members)))
    for k, (step, mine) in enumerate(steps(progress, members)):
        field = distance.from_pieces(points_on(distance.surface, mine.tolist()), step)
        found[:, k] = [reduce.reduce(field[each]) for each in members]
    (progress or silent)(1.0, f"{len(members):,} parcels")
    return found


def _central(positions: FloatArray, weights: FloatArray) -> int:
    """Return the index of the position (m, 3) nearest to their mean by weights (m,)."""
    apart = positions - np.average(positions, axis=0, weights=weights if weights.any() else None)
    return int((apart**2).sum(axis=1).argmin())


def _weights(distance: Distance, weights: str | None) -> FloatArray:
    """Return (n,) what each vertex counts."""
    if weights not in (None, "area"):
        raise ParameterError(f"Vertices are weighed by 'area' or by None, not by {weights!r}.")
    return np.ones(len(distance.surface.vertices)) if weights is None else distance.laplacian.areas


def parcel_sums(
    distance: Distance,
    labels: npt.ArrayLike,
    mask: npt.ArrayLike | None,
    begin: int,
    end: int,
    memory: float = MEMORY,
    progress: Progress | None = None,
    weights: str | None = None,
) -> ParcelSums:
    """Sum distances over the columns `begin` to `end` of the vertices that `labelled` lists."""
    surface = distance.surface
    vertices = labelled(surface, labels, mask)
    names, parcel = np.unique(_as_labels(labels)[vertices], return_inverse=True)
    p, of_vertex = len(names), surface.component_of_vertex
    counts, of_each = np.bincount(parcel, minlength=p), _weights(distance, weights)
    sums = np.zeros((p, p))
    longest = int(np.bincount(of_vertex[of_vertex >= 0])[of_vertex[vertices]].max())
    memory = real_number(memory, "The memory for a block")
    step = int(np.clip(memory / (longest * BYTES_PER_VALUE), 1, max(end - begin, 1)))
    for start in range(begin, end, step):
        some = slice(start, min(start + step, end))
        done, todo = start - begin, end - begin
        (progress or silent)(done / todo, f"{done:,} of {todo:,} columns")
        report = part(progress, done / todo, (done + some.stop - start) / todo)
        for component, mine, columns in distance.columns_by_component(vertices[some], report):
            here = of_vertex[vertices] == component.index
            theirs, own = vertices[here], vertices[some][mine]
            into = _sums_into(of_each[theirs], parcel[here], component.local(theirs), (p, len(columns)))
            of_column = _sums_into(of_each[own], parcel[some][mine], np.arange(len(mine)), (p, len(mine)))
            sums += of_column @ (into @ columns).T
            is_elsewhere = np.bincount(parcel[~here], minlength=p) > 0
            sums[np.ix_(np.unique(parcel[some][mine]), is_elsewhere)] = np.nan
    (progress or silent)(1.0, f"{end - begin:,} columns")
    return ParcelSums(names, counts, sums, np.bincount(parcel, of_each[vertices], p))


def _sums_into(weights: FloatArray, rows: IntArray, columns: IntArray, shape: tuple[int, int]) -> sparse.csr_array:
    """Return the matrix that adds up what stands at those columns, by weights, into those rows."""
    return sparse.csr_array((weights, (rows, columns)), shape=shape)


def _as_labels(labels: npt.ArrayLike) -> AnyArray:
    """Return labels as an array, with Python's strings, as pandas has them, as NumPy's."""
    array = array_of(labels, "Labels")
    is_text = array.dtype.kind == "O" and all(isinstance(each, str) for each in array.flat)
    return array.astype(np.str_) if is_text else array


def labelled(surface: Surface, labels: npt.ArrayLike, mask: npt.ArrayLike | None = None) -> IntArray:
    """Return the vertices that have a label, belong to a face and are not masked, by component, label and id.

    Raises ParameterError for labels or a mask of another shape or kind, and if there is no such vertex.
    """
    numbers, n = _as_labels(labels), len(surface.vertices)
    if numbers.shape != (n,) or numbers.dtype.kind not in "iuU":
        raise ParameterError(
            f"Labels are whole numbers or strings, one for each of the {n:,} vertices of {surface.name}; "
            f"these have the shape {numbers.shape} and the type {numbers.dtype}."
        )
    counts = ((numbers != "") if numbers.dtype.kind == "U" else (numbers >= 0)) & (surface.component_of_vertex >= 0)
    if mask is not None:
        counts &= checked_mask(surface, mask)
    vertices = np.flatnonzero(counts)
    if not len(vertices):
        raise ParameterError(f"No vertex of {surface.name} has a label and is not masked.")
    return vertices[np.lexsort((numbers[vertices], surface.component_of_vertex[vertices]))]


def checked_mask(surface: Surface, mask: npt.ArrayLike) -> BoolArray:
    """Return the mask (n,) of vertices that count; ParameterError for anything but 0 or 1 for each of n vertices."""
    flags, n = array_of(mask, "Values of a mask"), len(surface.vertices)
    what = f"A mask has 0 or 1 for each of the {n:,} vertices of {surface.name}"
    if flags.shape != (n,):
        raise ParameterError(f"{what}; this one has the shape {flags.shape}.")
    wrong = np.flatnonzero(~np.isin(flags, (0, 1)))
    if len(wrong):
        raise ParameterError(f"{what}; vertex {wrong[0]} has {flags[wrong[0]]}.")
    return flags.astype(bool)
