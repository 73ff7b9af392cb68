"""From a cut between the two halves of a region to a small set of vertices that separates them.

A cut is a set of edges.  The least vertices that touch all of them are a vertex cover (Koenig's theorem).  Where it
pays, the separator may also move: of all separators within a few edges of the cut the smallest is a minimal vertex
cut, found as a maximal flow (Menger's theorem).
"""

from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..arrays import BoolArray, IntArray

Sides: TypeAlias = npt.NDArray[np.int8]
"""0 or 1 for the half of a region that a vertex is in, 2 for the separator."""

REACH = 2
"""How many edges from the cut a separator may move."""
BAND = 4_000
"""About how many vertices one flow is computed on: SciPy holds the interpreter lock meanwhile."""
LEAST_REST = 0.25
"""Where a moved separator leaves less than this share of a region on one side, the vertex cover is taken."""


def separate(side: Sides, i: IntArray, j: IntArray, region: IntArray, move: bool) -> None:
    """Mark separators with 2 in `side` (m,), whose zeros and ones are the halves of regions.

    i, j: the edges; none joins two regions.  region (m,), ascending.  With `move` zeros and ones may change as well.
    """
    across = np.flatnonzero(side[i] != side[j])
    if move and len(across):
        old = side.copy()
        _move(side, i, j, region, across)
        count = np.stack([np.bincount(region[side == half], minlength=region[-1] + 1) for half in (0, 1)])
        poor = count.min(axis=0) < LEAST_REST * np.bincount(region)
        back = poor[region]
        side[back] = old[back]
        across = across[poor[region[i[across]]]]
    a, b = i[across], j[across]
    first = side[a] < side[b]
    side[_vertex_cover(np.where(first, a, b), np.where(first, b, a))] = 2


def _move(side: Sides, i: IntArray, j: IntArray, region: IntArray, across: IntArray) -> None:
    """Minimal separators in the bands of vertices within REACH edges of the cut edges `across`."""
    near = np.zeros(len(side), bool)
    near[i[across]] = near[j[across]] = True
    for _ in range(REACH):
        touched = near[i] | near[j]
        near[i[touched]] = near[j[touched]] = True
    one, two = near[i], near[j]
    band, inside, leaving = np.flatnonzero(near), one & two, one ^ two
    place = np.cumsum(near) - 1
    # Beyond its rim a band's sides are what they are.
    rim = np.zeros(len(band), bool)
    rim[place[np.where(one, i, j)[leaving]]] = True
    # Regions whose bands begin within the same BAND vertices share a flow; it falls apart into theirs.
    begins = np.r_[True, np.diff(region[band]) > 0]
    group = np.flatnonzero(begins)[np.cumsum(begins) - 1] // BAND
    a, b = place[i[inside]], place[j[inside]]
    order = np.argsort(group[a], kind="stable")
    a, b = a[order], b[order]
    for g in np.flatnonzero(np.bincount(group)):
        lo, hi = np.searchsorted(group, (g, g + 1))
        first, last = np.searchsorted(group[a], (g, g + 1))
        some = band[lo:hi]
        side[some] = _least_cut(side[some], rim[lo:hi], a[first:last] - lo, b[first:last] - lo)


def _least_cut(side: Sides, rim: BoolArray, a: IntArray, b: IntArray) -> Sides:
    """(k,) new sides, 2 for the fewest vertices that part the rim (k,) of side 0 from that of side 1."""
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    # Each vertex k is an edge from its entry k to its exit n + k, which one unit can pass; edges let any number pass.
    n, any_number = len(side), len(side) + 1
    v, start, end = np.arange(n), np.flatnonzero(rim & (side == 0)), np.flatnonzero(rim & (side == 1))
    source, sink = 2 * n, 2 * n + 1
    tail = np.concatenate([v, n + a, n + b, np.full(len(start), source), n + end])
    head = np.concatenate([n + v, b, a, start, np.full(len(end), sink)])
    capacity = np.full(len(tail), any_number, np.int32)
    capacity[:n] = 1
    network = sp.csr_matrix((capacity, (tail, head)), shape=(2 * n + 2, 2 * n + 2))
    left = network - maximum_flow(network, source, sink).flow
    left.eliminate_zeros()
    reached = np.zeros(2 * n + 2, bool)
    reached[breadth_first_order(left, source, return_predecessors=False)] = True
    entered, left_again = reached[:n], reached[n : 2 * n]
    return np.where(left_again, 0, np.where(entered, 2, 1)).astype(side.dtype)


def _vertex_cover(a: IntArray, b: IntArray) -> IntArray:
    """A least set of vertices that touches all edges a - b of a bipartite graph (Koenig's theorem)."""
    from scipy.sparse.csgraph import breadth_first_order, maximum_bipartite_matching

    if not len(a):
        return a
    left, a = np.unique(a, return_inverse=True)
    right, b = np.unique(b, return_inverse=True)
    m, n = len(left), len(left) + len(right)
    bipartite = sp.csr_matrix((np.ones(len(a), np.int8), (a, b)), shape=(m, n - m))
    mate = maximum_bipartite_matching(bipartite, perm_type="column")
    free, bound = np.flatnonzero(mate < 0), np.flatnonzero(mate >= 0)
    # Reached from an unmatched left vertex (from vertex n) by edges rightwards and matched edges leftwards.
    tail, head = np.r_[a, m + mate[bound], np.full(len(free), n)], np.r_[m + b, bound, free]
    walk = sp.csr_matrix((np.ones(len(tail), np.int8), (tail, head)), shape=(n + 1, n + 1))
    seen = np.zeros(n + 1, bool)
    seen[breadth_first_order(walk, n, return_predecessors=False)] = True
    cover: IntArray = np.r_[left[~seen[:m]], right[seen[m:n]]]
    return cover
