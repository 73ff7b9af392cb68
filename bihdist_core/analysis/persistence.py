"""Local extrema of a field on a surface, each with its topological persistence.

Grow the set {f <= level} from below.  A piece of it is born at a minimum; where two pieces meet, the younger one (of
the higher minimum) ends, and the persistence of its minimum is the level of the meeting less that of the birth: how
deep the hollow is.  Noise of the triangulation makes many minima of nearly no persistence; those that a reader of the
figure sees persist over a fraction of the field's range.  Maxima are the minima of -f.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..scalars import real_number
from ..sources.pieces import pieces_of
from ..sources.source import Source
from ..surface import Surface


@dataclass(frozen=True, eq=False)
class Extrema:
    """Minima and maxima of a field, the most persistent first.

    Attributes
    ----------
    minima : (k,) int64 ndarray
        Vertices.
    minima_persistence : (k,) float64 ndarray
        In the field's unit; the lowest minimum of each component has the whole range there.
    maxima : (q,) int64 ndarray
        Vertices.
    maxima_persistence : (q,) float64 ndarray
        In the field's unit; the highest maximum of each component has the whole range there.
    raw_minima, raw_maxima : int
        How many vertices are lower or higher than all their neighbours, however little.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> found = bihdist.extrema(sphere, sphere.points[:, 2])
    >>> # from pole to pole
    >>> len(found.minima), len(found.maxima), found.maxima_persistence.round(3).tolist()
    (1, 1, [2.0])
    """

    minima: IntArray
    minima_persistence: FloatArray
    maxima: IntArray
    maxima_persistence: FloatArray
    raw_minima: int
    raw_maxima: int


def extrema(surface: MeshLike, field: npt.ArrayLike, fraction: float = 1e-3) -> Extrema:
    """Find the local extrema of a field that are persistent.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Real numbers at the vertices; vertices whose value is not finite are left out.
    fraction : float
        The least persistence, as a fraction of the field's range.

    Returns
    -------
    Extrema
        The extrema and their persistence.

    Raises
    ------
    ParameterError
        For a field of another shape, or a fraction outside 0 to 1.

    Notes
    -----
    Equal values are told apart by the smaller id. What that alone makes has no persistence and is left out, so a
    plateau has one extremum, and a constant field none. The raw counts may count a plateau several times.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> found = bihdist.extrema(sphere, field)
    >>> # the source, and what is opposite to it
    >>> found.minima.tolist(), found.maxima.tolist()
    ([0], [2])
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    if not 0 <= real_number(fraction, "The fraction of the range") <= 1:
        raise ParameterError(f"The least persistence is a fraction of the range from 0 to 1, not {fraction:g}.")
    used = np.isfinite(f) & (surface.component_of_vertex >= 0)
    edges = surface.edges[used[surface.edges].all(axis=1)]
    ids = np.flatnonzero(used)
    least = fraction * np.ptp(f[ids]) if len(ids) else 0.0
    low, depth = _minima(f, edges, ids)
    high, height = _minima(-f, edges, ids)
    deep, tall = (depth >= least) & (depth > 0), (height >= least) & (height > 0)
    return Extrema(low[deep], depth[deep], high[tall], height[tall], len(low), len(high))


def _minima(f: FloatArray, edges: IntArray, ids: IntArray) -> tuple[IntArray, FloatArray]:
    """Return (k,) all minima among the vertices `ids`, and their persistence, greatest first."""
    order = ids[np.argsort(f[ids], kind="stable")]
    rank = np.full(len(f), len(f))
    rank[order] = np.arange(len(order))
    basin = _basins(rank, order, edges)
    roots = order[basin[order] == order]
    # Two basins first meet over the edge between them whose higher end is lowest.
    pair = basin[edges]
    crossing = np.flatnonzero(pair[:, 0] != pair[:, 1])
    saddle = rank[edges[crossing]].max(axis=1)
    older = {int(v): int(v) for v in roots}

    def oldest(v: int) -> int:
        while older[v] != v:
            older[v] = older[older[v]]
            v = older[v]
        return v

    persistence = {}
    for k in np.argsort(saddle, kind="stable").tolist():
        a, b = (oldest(int(v)) for v in pair[crossing[k]])
        if a != b:
            young, old = (a, b) if rank[a] > rank[b] else (b, a)
            older[young] = old
            persistence[young] = float(f[order[saddle[k]]] - f[young])
    top: dict[int, float] = {}
    root_of = {v: oldest(v) for v in older}
    highest = np.full(len(f), -np.inf)
    np.maximum.at(highest, basin[order], f[order])
    for v in older:
        top[root_of[v]] = max(top.get(root_of[v], -np.inf), float(highest[v]))
    depth = np.array([persistence[int(v)] if int(v) in persistence else top[int(v)] - f[v] for v in roots])
    first = np.argsort(-depth, kind="stable")
    return roots[first], depth[first]


def _basins(rank: IntArray, order: IntArray, edges: IntArray) -> IntArray:
    """Return (n,) the minimum that steepest descent, always to the lowest neighbour, reaches from each vertex."""
    lowest = rank.copy()
    for a, b in (edges.T, edges.T[::-1]):
        np.minimum.at(lowest, a, rank[b])
    follow = np.arange(len(rank))
    follow[order] = order[lowest[order]]
    while True:
        further = follow[follow]
        if (further == follow).all():
            return follow
        follow = further


# ---------------------------------------------------------------------- away from a source
@dataclass(frozen=True, eq=False)
class OtherExtrema:
    """Extrema of a field away from its source, the most persistent first.

    Attributes
    ----------
    minima : (k,) int64 ndarray
        Vertices.
    minima_depth : (k,) float64 ndarray
        Persistence of the minima over the field's range, without a unit.
    maxima : (q,) int64 ndarray
        Vertices.
    maxima_height : (q,) float64 ndarray
        Persistence of the maxima over the field's range, without a unit.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> found = bihdist.other_extrema(sphere, field, 0)
    >>> found.minima.tolist(), found.maxima.tolist(), found.maxima_height.tolist()
    ([], [2], [1.0])
    """

    minima: IntArray
    minima_depth: FloatArray
    maxima: IntArray
    maxima_height: FloatArray

    @property
    def vertices(self) -> IntArray:
        """Vertices (k,) of all minima, then of all maxima.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
        >>> bihdist.other_extrema(sphere, field, 0).vertices.tolist()
        [2]
        """
        return np.concatenate([self.minima, self.maxima])


def other_extrema(
    surface: MeshLike, field: npt.ArrayLike, source: Source | None, fraction: float = 1e-3
) -> OtherExtrema:
    """Find the extrema of a field away from its source.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Real numbers at the vertices.
    source : Source or None
        None for a field that starts nowhere, all extrema of which count.
    fraction : float
        The least persistence, as a fraction of the field's range.

    Returns
    -------
    OtherExtrema
        The extrema and their persistence.

    Raises
    ------
    VertexError
        If a source vertex is not on the surface.
    ParameterError
        For another bad source, a field of another shape, or a constant one.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> # a height, with a bump at the side
    >>> field = sphere.points[:, 2] + 0.3 * (sphere.points[:, 0] > 0.9)
    >>> found = bihdist.other_extrema(sphere, field, None)
    >>> len(found.minima), len(found.maxima)
    (1, 2)
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    touched = np.empty(0, np.int64) if source is None else pieces_of(source, surface).touched
    found = extrema(surface, f, fraction)
    finite = f[np.isfinite(f)]
    if not len(finite) or not np.ptp(finite) > 0:
        raise ParameterError("The quality of a field needs values that differ.")
    span = float(np.ptp(finite))
    low, high = (~np.isin(ids, touched) for ids in (found.minima, found.maxima))
    return OtherExtrema(
        found.minima[low],
        found.minima_persistence[low] / span,
        found.maxima[high],
        found.maxima_persistence[high] / span,
    )
