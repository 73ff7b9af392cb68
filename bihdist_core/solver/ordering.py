"""Nested dissection: in which order to eliminate the vertices of a graph so that little fill appears.

A region of the graph is cut in two by a small separator, each half again, and so on: a complete binary tree, whose
inner nodes hold separators and whose leaves hold what is left.  Its nodes have heap numbers: the root is 1, the
parent of node f is f // 2.  Where to cut is read off coordinates of the vertices.  Positions in space alone fail on
folded sheets, so hop counts to far-apart landmarks are tried as well: they see along the surface, in the measure
that separators are paid in.  The result depends on the input only: ties are broken by vertex number.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ..arrays import AnyArray, FloatArray, IntArray
from ..progress import Progress, part
from .separators import Sides, separate
from .worker_threads import Job
from .z_order import z_order

LANDMARKS = 4
LEAST_SHARE = 0.4
"""The smaller half of a cut region has at least this share of it."""
SMALL = 150
"""Up to so many vertices on the average, regions are cut by their positions alone."""
LARGE = 3000
"""From so many vertices on, separators of regions are made as small as can be."""
SAMPLE = 200
"""How many vertices of a region are enough to find its principal axes."""
CELL_BITS = 5
"""Vertices lie near each other in memory by cells, 2**CELL_BITS along each axis: 15 bits are fast to sort by."""


@dataclass(frozen=True)
class _Chart:
    """Coordinates to cut by: `axes`, a list of (n,) arrays, and how many of their principal axes to try."""

    axes: list[FloatArray]
    tries: int


def nested_dissection(
    i: IntArray, j: IntArray, coordinates: FloatArray, depth: int, split: int = 0, progress: Progress | None = None
) -> IntArray:
    """(n,) heap number of the tree node of each vertex; the leaves are on level `depth`.

    i, j: (e,) the two ends of each edge, each edge once, no loops; coordinates: (n, 3), finite.  The branches under
    the first `split` levels are cut side by side.
    """
    n = len(coordinates)
    node = np.ones(n, np.int64)
    if depth == 0 or n == 0:
        return node
    order, box = _along_a_curve(_unit_box(coordinates))
    graph = _graph(i, j, order)
    i, j = _edges_of(graph)
    charts = [_Chart(box, 1), _Chart(_hop_coordinates(graph, part(progress, 0, 0.4)), 2)]
    job = Job(part(progress, 0.4, 1), "Ordering the vertices", n * depth)
    top = _Cutter(node, charts, job)
    ((live, i, j),) = job.run(lambda root: top.cut(np.arange(n), i, j, root, split), [1])
    ends = np.searchsorted(node[live], np.arange(1 << split, (2 << split) + 1))

    def branch(root: int) -> None:
        lo, hi = ends[root - (1 << split)], ends[root - (1 << split) + 1]
        inside = (i >= lo) & (i < hi)
        top.cut(live[lo:hi], i[inside] - lo, j[inside] - lo, root, depth - split)

    job.run(branch, range(1 << split, 2 << split))
    job.finish()
    result = np.empty(n, np.int64)
    result[order] = node
    return result


def _unit_box(x: FloatArray) -> list[FloatArray]:
    """The columns of x (n, k), moved and scaled together into [-1, 1], where no square of them over- or underflows."""
    x = x - x.mean(axis=0) if np.abs(x).max() < 1e300 else x / 4 - (x / 4).mean(axis=0)
    largest = np.abs(x).max()
    return list((x / largest if largest > 0 else x).T.copy())


def _along_a_curve(box: list[FloatArray]) -> tuple[IntArray, list[FloatArray]]:
    """(n,) vertices in the order of their cells on a Morton (Z-order) curve, and their coordinates in this order.

    However a file numbers its vertices, neighbours then lie near each other in memory, for all that is done here.
    """
    last = (1 << CELL_BITS) - 1
    code = z_order([((x + 1) * (last + 1) / 2).clip(0, last).astype(np.uint8) for x in box], CELL_BITS)
    order = np.argsort(code, kind="stable")
    return order, [x.take(order) for x in box]


def _graph(i: AnyArray, j: AnyArray, order: IntArray) -> sp.csr_matrix:
    """(n, n) graph with the edges i - j, each in both directions, of vertices renumbered to be in this order."""
    n = len(order)
    place = np.empty(n, np.int32)
    place[order] = np.arange(n)
    i, j = place.take(i), place.take(j)
    return sp.csr_matrix((np.ones(2 * len(i)), (np.r_[i, j], np.r_[j, i])), shape=(n, n))


def _edges_of(graph: sp.csr_matrix) -> tuple[IntArray, IntArray]:
    """Two (e,) arrays: the ends of each edge, ascending by the first."""
    tail = np.repeat(np.arange(graph.shape[0]), np.diff(graph.indptr))
    once = np.flatnonzero(tail < graph.indices)
    return tail[once], graph.indices[once].astype(np.int64)


def _hop_coordinates(graph: sp.csr_matrix, progress: Progress) -> list[FloatArray]:
    """List of (n,) edge counts to far-apart landmarks, the connected components laid out one beside the other."""
    n = graph.shape[0]
    component, last = _components(graph)
    count = len(last)
    far = np.zeros(n, np.int64)
    axes = []
    # The first sweep only finds a far end to start from.
    for sweep in range(LANDMARKS + 1):
        if sweep and count == 1:
            last = np.array([far.argmax()])
        elif sweep:
            order = np.lexsort((far, component))
            last = order[np.r_[np.diff(component[order]) > 0, True]]
        hops = _hops(graph, last)
        far = hops if sweep < 2 else np.minimum(far, hops)
        if sweep:
            axes.append(hops)
        progress((sweep + 1) / (LANDMARKS + 1), "Ordering the vertices")
    extent = np.zeros(count, np.int64)
    for hops in axes:
        np.maximum.at(extent, component, hops) if count > 1 else extent.fill(hops.max())
    start = (np.cumsum(extent + 2) - extent - 2)[component]
    return [(hops + start).astype(np.float64) for hops in axes]


def _components(graph: sp.csr_matrix) -> tuple[AnyArray, IntArray]:
    """(n,) the connected component of each vertex, and (k,) a vertex of each."""
    # Here and below not at the top: it is half of what `import bihdist_core` would take.
    from scipy.sparse.csgraph import breadth_first_order, connected_components

    n = graph.shape[0]
    # A search is several times faster than finding components, during which other Python threads would stand still.
    if len(breadth_first_order(graph, 0, return_predecessors=False)) == n:
        return np.zeros(n, np.int64), np.zeros(1, np.int64)
    component = connected_components(graph, directed=False)[1]
    return component, np.unique(component, return_index=True)[1]


def _hops(graph: sp.csr_matrix, sources: IntArray) -> IntArray:
    """(n,) number of edges to the nearest source; each component has one."""
    from scipy.sparse.csgraph import breadth_first_order

    n = graph.shape[0]
    # One more vertex, with an edge to each source, makes it a search from a single vertex.
    indices, indptr = np.r_[graph.indices, sources], np.r_[graph.indptr, graph.nnz + len(sources)]
    rooted = sp.csr_matrix((np.ones(len(indices)), indices, indptr), shape=(n + 1, n + 1))
    order, before = breadth_first_order(rooted, n)
    # In breadth-first order the children of consecutive vertices are consecutive, so each level is a slice.
    position = np.empty(n + 1, np.int64)
    position[order] = np.arange(n + 1)
    children_end = 1 + np.cumsum(np.bincount(position[before[order[1:]]], minlength=n + 1))
    ends = [0, 1]
    while ends[-1] < n + 1:
        ends.append(int(children_end[ends[-1] - 1]))
    hops = np.empty(n + 1, np.int64)
    hops[order] = np.repeat(np.arange(-1, len(ends) - 2), np.diff(ends))
    return hops[:n]


class _Cutter:
    """Cuts regions; writes only into `node` (n,), at the vertices it is given."""

    def __init__(self, node: IntArray, charts: list[_Chart], job: Job) -> None:
        self.node, self.charts, self.job = node, charts, job

    def cut(
        self, live: IntArray, i: IntArray, j: IntArray, root: int, levels: int
    ) -> tuple[IntArray, IntArray, IntArray]:
        """Cut the vertices `live` (m,), all in tree node `root`, `levels` times, all regions of a level at once.

        i, j: their edges, as positions in `live`.  Returns what is left of live, sorted by region, and of the edges.
        """
        for level in range(levels):
            m = len(live)
            region = self.node[live] - (root << level)
            side = self._halves(live, i, j, region, 1 << level)
            # Moving separators pays where they are long.
            separate(side, i, j, region, move=m > LARGE << level)
            rest = np.flatnonzero(side < 2)
            region = self.node[live[rest]] * 2 + side[rest]
            self.node[live[rest]] = region
            rest = rest[_stable_order(region - (root << level + 1), 2 << level)]
            live = live[rest]
            new = np.full(m, -1)
            new[rest] = np.arange(len(rest))
            stay = (side[i] == side[j]) & (side[i] < 2)
            i, j = new[i[stay]], new[j[stay]]
            self.job.advance(m)
        return live, i, j

    def _halves(self, live: IntArray, i: IntArray, j: IntArray, region: IntArray, regions: int) -> Sides:
        """(m,) 0 or 1: each region is cut across the axis and at the place where the fewest edges are cut."""
        m = len(live)
        count = np.bincount(region, minlength=regions)
        start = np.cumsum(count) - count
        full = np.flatnonzero(count)
        rank = np.arange(m)
        off_centre = np.abs((rank - start[region]) / count[region] - 0.5)
        # Of equal cuts the one nearer the middle; half a vertex of slack leaves a choice in the smallest regions.
        allowed = off_centre <= 0.5 - LEAST_SHARE + 0.5 / count[region]
        weight = np.where(allowed, 1 + 2 * off_centre, np.inf)
        best, side = np.full(regions, np.inf), np.zeros(m, np.int8)
        # Small regions are many and nearly flat: one axis in space will do.
        for chart in self.charts if m > SMALL * regions else self.charts[:1]:
            axes = [axis[live] for axis in chart.axes]
            for key in _principal_keys(axes, region, count, chart.tries):
                place = np.empty(m, np.int64)
                place[_order_in_regions(key, region, start, full)] = rank
                p, q = place[i], place[j]
                cut = np.bincount(np.minimum(p, q), minlength=m) - np.bincount(np.maximum(p, q), minlength=m)
                cost = (np.cumsum(cut) - cut + 1) * weight
                least = np.full(regions, np.inf)
                least[full] = np.minimum.reduceat(cost, start[full]) if len(full) else 0
                at = np.flatnonzero(cost == least[region])[::-1]
                first = np.zeros(regions, np.int64)
                first[region[at]] = at
                better = least < best
                best[better] = least[better]
                side = np.where(better[region], place >= first[region], side).astype(np.int8)
        return side


def _principal_keys(axes: list[FloatArray], region: IntArray, count: IntArray, tries: int) -> Iterator[FloatArray]:
    """(m,) coordinates along each region's first principal axes, of points with the given axes, each (m,)."""
    step = max(1, len(region) // (SAMPLE * len(count)))
    some = region[::step]
    total = np.maximum(np.bincount(some, minlength=len(count)), 1)
    means = [np.bincount(some, axis[::step], len(count)) / total for axis in axes]
    centred = [axis[::step] - mean[some] for axis, mean in zip(axes, means, strict=True)]
    covariance = np.empty((len(count), len(axes), len(axes)))
    for a, x in enumerate(centred):
        for b, y in enumerate(centred[: a + 1]):
            covariance[:, a, b] = covariance[:, b, a] = np.bincount(some, x * y, len(count)) / total
    directions = np.linalg.eigh(covariance)[1]
    for k in range(1, tries + 1):
        # Where a region's key is zero does not matter, so nothing is centred here.
        key = np.zeros(len(region))
        for a, axis in enumerate(axes):
            key += axis * np.repeat(directions[:, a, -k], count)
        yield key


def _order_in_regions(key: FloatArray, region: IntArray, start: IntArray, full: IntArray) -> IntArray:
    """(m,) the order by region, then by key to 16 bits, then as given.  region (m,) ascends; start: where each does."""
    if not len(key):
        return np.zeros(0, np.int64)
    low, scale = np.zeros(len(start)), np.zeros(len(start))
    low[full] = np.minimum.reduceat(key, start[full])
    extent = np.maximum.reduceat(key, start[full]) - low[full]
    scale[full] = 65535 / np.maximum(extent, 1e-300)
    # Sixteen bits place a cut far finer than an edge is long, and sort several times faster than 64.
    coarse = ((key - low[region]) * scale[region]).clip(0, 65535).astype(np.uint16)
    order = np.argsort(coarse, kind="stable")
    return order[_stable_order(region[order], len(start))]


def _stable_order(label: IntArray, count: int) -> IntArray:
    """Stable argsort of labels 0 to count - 1."""
    return np.argsort(label.astype(np.uint16) if count <= 1 << 16 else label, kind="stable")
