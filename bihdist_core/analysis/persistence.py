"""Local extrema of a field on a surface, each with its topological persistence.

Grow the set {f <= level} from below.  A piece of it is born at a minimum; where two pieces meet, the younger one (of
the higher minimum) ends, and the persistence of its minimum is the level of the meeting less that of the birth: how
deep the hollow is.  Noise of the triangulation makes many minima of nearly no persistence; those that a reader of the
figure sees persist over a share of the field's range.  Maxima are the minima of -f.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..scalars import real_number
from ..surface import Surface


@dataclass(frozen=True, eq=False)
class Extrema:
    """Minima and maxima (k,) vertex ids, the most persistent first, and their persistence (k,) in the field's unit.

    The lowest minimum and the highest maximum of each connected piece have the whole range there as persistence.
    raw_minima, raw_maxima: how many vertices are lower or higher than all their neighbours, however little.

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


def extrema(surface: MeshLike, field: npt.ArrayLike, share: float = 1e-3) -> Extrema:
    """The local extrema of a field (n,) whose persistence is at least `share` of the field's range.

    Vertices whose value is not finite are left out.  Equal values are told apart by the smaller id; what that alone
    makes has no persistence and is left out, so a plateau has one extremum, and a constant field has none.  (The raw
    counts may count a plateau several times.)

    Raises ParameterError for a field of another shape, or a share outside 0 to 1.

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
    if not 0 <= real_number(share, "The share") <= 1:
        raise ParameterError(f"The share is {share:g}; it must lie between 0 and 1.")
    used = np.isfinite(f) & (surface.component_of_vertex >= 0)
    edges = surface.edges[used[surface.edges].all(axis=1)]
    ids = np.flatnonzero(used)
    least = share * np.ptp(f[ids]) if len(ids) else 0.0
    low, depth = _minima(f, edges, ids)
    high, height = _minima(-f, edges, ids)
    deep, tall = (depth >= least) & (depth > 0), (height >= least) & (height > 0)
    return Extrema(low[deep], depth[deep], high[tall], height[tall], len(low), len(high))


def _minima(f: FloatArray, edges: IntArray, ids: IntArray) -> tuple[IntArray, FloatArray]:
    """(k,) all minima among the vertices `ids`, and their persistence, greatest first."""
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
    """(n,) the minimum that steepest descent, always to the lowest neighbour, reaches from each vertex."""
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
