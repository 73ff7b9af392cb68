"""The solver without the compiled kernel: the algebra of `kernel/kernel.h` in NumPy, written as its specification.

Right, not fast: what the kernel computes is measured by it.

The vertices of a graph are put in an order by nested dissection.  A front is a dense block of the elimination in that
order: its c pivots, which it eliminates, and its boundary, the m rows above them that they touch, s = c + m.  With F
the pivots' block of a front, R the rows right of it (c, m) and Q the boundary's block, and beside each its derivative
along L + t A, L the matrix and A the diagonal of areas:

    K = F^-1        N = -K R                S = Q + R^T N        (S: Schur complement, added into the parent)
    K1 = K F1 K     N1 = K (R1 + F1 N)      S1 = Q1 + X + X^T,   X = (R1 + F1 N / 2)^T N

K1 and N1 are minus the derivatives of K and N, so that all that follows adds up to +G A G, G = L^-1.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.linalg import solve_triangular
from scipy.sparse.csgraph import connected_components, dijkstra

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..machine_memory import MEMORY_ADVICE, check_memory
from ..progress import Progress
from .blas import one_blas_thread
from .worker_threads import Job

LEAF = 40
"""Most vertices of a region that is not cut."""
SINGULAR = 1e-14
"""A pivot that is no larger a fraction of its diagonal entry is rounding."""
STIFF = 3e-2
"""Below this fraction of its diagonal entry a pivot has lost digits that matter: beside a degenerate face, of height h,
rows have entries of size 1 / h, and what K lacks comes back in S magnified by that."""

FRONTS = 3
"""Blocks of a front's size in memory at a time while it is eliminated."""

SEPARATOR = 2
"""The side of vertices in neither half, 0 or 1, of a region."""


class Front(NamedTuple):
    """A dense block of the elimination: `rows` (s,), ascending places of its c pivots and then of its boundary.

    `children` are the numbers of the fronts below it, each with the places of its boundary among `rows`.
    """

    c: int
    rows: IntArray
    children: list[tuple[int, IntArray]]

    @property
    def pivots(self) -> IntArray:
        """The places (c,) that it eliminates."""
        return self.rows[: self.c]

    @property
    def boundary(self) -> IntArray:
        """The later places (m,) that its pivots touch."""
        return self.rows[self.c :]


class PlainTree:
    """The elimination tree of a pattern (n, n), by rows as `canonical` makes them; x (n, 3), in [-1, 1].

    Raises ParameterError if the pattern is not symmetric.

    Attributes
    ----------
    vertices : (n,) ndarray
        The vertices in elimination order.
    place : (n,) ndarray
        The place of each vertex in that order.
    fronts : list of Front
        The fronts in postorder, children before parents.
    """

    vertices: IntArray
    place: IntArray
    fronts: list[Front]

    def __init__(self, pattern: sp.csr_matrix, x: FloatArray, progress: Progress | None = None) -> None:
        self.n = len(x)
        graph = sp.csr_matrix((np.ones(pattern.nnz), pattern.indices, pattern.indptr), shape=pattern.shape)
        if (graph != graph.T).nnz:
            raise ParameterError("The sparsity pattern of the matrix is not symmetric.")
        job = Job(progress, "Ordering the vertices", self.n)

        def build(graph: sp.csr_matrix) -> None:
            regions: list[Region] = []
            _dissect(np.arange(self.n), graph, x, regions, job)
            self._lay_out(graph, regions)

        job.run(build, [graph])
        job.finish()

    @property
    def sizes(self) -> tuple[IntArray, IntArray]:
        """The numbers of pivots (fronts,) and of boundary rows (fronts,) of each front."""
        c, s = np.array([(front.c, len(front.rows)) for front in self.fronts]).T
        return c, s - c

    @property
    def work(self) -> float:
        """The work of an elimination, in the unit of `Job.advance`."""
        return float(sum(_work(front) for front in self.fronts))

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        ups = (up for front in self.fronts for _, up in front.children)
        return sum(each.nbytes for each in (self.vertices, self.place, *ups, *(front.rows for front in self.fronts)))

    def factor_bytes(self, is_dual: bool) -> float:
        """Memory for a factor, and for the most that there is at a time to make it of."""
        kept, handed, most = 0, dict[int, int](), 0
        for q, front in enumerate(self.fronts):
            s, c = len(front.rows), front.c
            # The front, what is left of it, and the products between.
            most = max(most, kept + sum(handed.values()) + FRONTS * s * s)
            for child, _ in front.children:
                del handed[child]
            handed[q] = (s - c) ** 2
            kept += c * s
        return 8.0 * (1 + is_dual) * most

    def _lay_out(self, graph: sp.csr_matrix, regions: "list[Region]") -> None:
        """Bottom up: a front's boundary is what its pivots' edges and its children's boundaries reach above it."""
        self.vertices = np.concatenate([region.vertices for region in regions])
        self.place = np.argsort(self.vertices)
        graph, self.fronts, first = graph[self.vertices][:, self.vertices], [], 0
        for region in regions:
            c = len(region.vertices)
            pivots = np.arange(first, first + c)
            below = [self.fronts[child].boundary for child in region.children]
            rows = np.unique(np.concatenate([pivots, graph[first : first + c].indices, *below]))
            rows = rows[rows >= first]
            ups = [np.searchsorted(rows, boundary) for boundary in below]
            self.fronts.append(Front(c, rows, list(zip(region.children, ups, strict=True))))
            first += c


# ---------------------------------------------------------------------- nested dissection
class Region(NamedTuple):
    """A region that becomes a front: the vertices (c,) of a separator, or of a leaf, and the numbers of the fronts
    below it."""

    vertices: IntArray
    children: list[int]


def _dissect(vertices: IntArray, graph: sp.csr_matrix, x: FloatArray, regions: list[Region], job: Job) -> int:
    """Append the fronts of some vertices (k,), with their graph (k, k) and positions x (k, 3), in postorder.

    Returns the number of the last, which is the root of all others.
    """
    side, children = _cut(graph, x), []
    for half in (np.flatnonzero(side == 0), np.flatnonzero(side == 1)):
        if len(half):
            children.append(_dissect(vertices[half], graph[half][:, half], x[half], regions, job))
    own = vertices[side == SEPARATOR]
    regions.append(Region(own, children))
    job.advance(len(own))
    return len(regions) - 1


def _cut(graph: sp.csr_matrix, x: FloatArray) -> AnyArray:
    """Return (k,) the sides of vertices: no edge joins the halves, and the separator is small.

    It is tried across the widest direction, and, as that fails on folded sheets, across edge counts from a far end.
    One component after the other, so that at most one of them is cut.  Small regions are one separator, and so are
    those that have no halves.
    """
    best = np.full(len(x), SEPARATOR, np.int8)
    if len(x) <= LEAF:
        return best
    _, component = connected_components(graph, directed=False)
    for key in (_along_widest_direction(x), _hops_from_far_end(graph, component)):
        side = _separated(graph, np.lexsort((key, component)))
        if {0, 1} <= set(side) and (side == SEPARATOR).sum() < (best == SEPARATOR).sum():
            best = side
    return best


def _separated(graph: sp.csr_matrix, order: IntArray) -> AnyArray:
    """Return (k,) sides by halves of an order of the vertices: one half loses those of its vertices that touch the
    other."""
    side = np.zeros(len(order), np.int8)
    side[order[len(order) // 2 :]] = 1
    i, j = graph.nonzero()
    touching = np.unique(i[side[i] != side[j]])
    side[min((touching[side[touching] == half] for half in (0, 1)), key=len)] = SEPARATOR
    return side


def _along_widest_direction(x: FloatArray) -> FloatArray:
    """Return (k,) positions along the first principal axis of points x (k, 3)."""
    x = x - x.mean(axis=0)
    _, axes = np.linalg.eigh(x.T @ x)
    along: FloatArray = x @ axes[:, -1]
    return along


def _hops_from_far_end(graph: sp.csr_matrix, component: AnyArray) -> FloatArray:
    """Return (k,) edge counts from a vertex of each component that is far away from another."""
    _, start = np.unique(component, return_index=True)
    for _ in range(2):
        hops: FloatArray = dijkstra(graph, indices=start, unweighted=True, min_only=True)
        start = np.lexsort((hops, component))[np.cumsum(np.bincount(component)) - 1]
    return hops


# ---------------------------------------------------------------------- the algebra of a front
class Blocks(NamedTuple):
    """The blocks of a front in the factor: K (c, c), N (c, m), and K1 and N1, which are empty without areas."""

    K: FloatArray
    N: FloatArray
    K1: FloatArray
    N1: FloatArray


def _inverse(F: FloatArray, scale: FloatArray) -> tuple[FloatArray, float]:
    """F^-1 by Cholesky, and the least pivot as a fraction of scale (c,), the matrix' own diagonal there."""
    if not len(F):
        return F, 1.0
    if np.iscomplexobj(F):
        return np.asarray(np.linalg.inv(F)), 1.0
    try:
        lower = np.linalg.cholesky(F)
        left = float((lower.diagonal() ** 2 / scale).min()) if (scale > 0).all() else 0.0
    except np.linalg.LinAlgError:
        left = 0.0
    if not left > SINGULAR:
        raise SolverError("The matrix is not positive definite to working accuracy, so it cannot be factored.")
    root = solve_triangular(lower, np.identity(len(F)), lower=True, check_finite=False)
    return root.T @ root, left


def _eliminate(front: FloatArray, c: int, scale: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """K, N and S of a front (s, s).

    One step of refinement where a pivot is stiff: N F = -R then holds to rounding, as after a solve with Cholesky's
    factor.
    """
    F, R, Q = front[:c, :c], front[:c, c:], front[c:, c:]
    K, left = _inverse(F, scale)
    N = -K @ R
    if left < STIFF:
        N -= K @ (R + F @ N)
    S = Q + R.T @ N
    return K, N, (S + S.T) / 2


def _derive(front1: FloatArray, K: FloatArray, N: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """K1, N1 and S1 of a front with derivatives (s, s)."""
    c = len(K)
    F1, R1, Q1 = front1[:c, :c], front1[:c, c:], front1[c:, c:]
    X = (R1 + F1 @ N / 2).T @ N
    return K @ F1 @ K, K @ (R1 + F1 @ N), Q1 + X + X.T


def _invert(blocks: Blocks, Z22: FloatArray, H22: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return a front's blocks (s, s) Z of G and H of G A G, given those of its boundary (Takahashi's selected
    inversion)."""
    K, N, K1, N1 = blocks
    Z12 = N @ Z22
    H12 = N1 @ Z22 + N @ H22
    Z11 = K + Z12 @ N.T
    H11 = K1 + Z12 @ N1.T + H12 @ N.T
    return np.block([[Z11, Z12], [Z12.T, Z22]]), np.block([[H11, H12], [H12.T, H22]])


def _work(front: Front) -> int:
    return front.c * len(front.rows) ** 2


# ---------------------------------------------------------------------- the factor
class PlainFactor:
    """The factor of a matrix as `canonical` makes it; `areas` (n,) are needed for derivatives.

    Raises SolverError if the matrix is not positive definite, ParameterError if it has an entry outside the pattern.
    """

    @one_blas_thread()
    def __init__(self, tree: PlainTree, matrix: sp.csr_matrix, areas: FloatArray | None, job: Job) -> None:
        self.tree = tree
        check_memory(tree.factor_bytes(areas is not None), f"The factor for {tree.n:,} vertices", MEMORY_ADVICE)
        self._blocks: list[Blocks] = []
        self._dtype = matrix.dtype
        job.run(lambda rows: self._eliminate(rows, areas, job), [matrix[tree.vertices][:, tree.vertices]])

    @property
    def nbytes(self) -> int:
        """Bytes of its blocks."""
        return sum(block.nbytes for blocks in self._blocks for block in blocks)

    def _eliminate(self, matrix: sp.csr_matrix, areas: FloatArray | None, job: Job) -> None:
        """Bottom up; the rows of the matrix (n, n) are in elimination order."""
        diagonal, none = matrix.diagonal(), np.empty((0, 0))
        complements: dict[int, FloatArray] = {}
        complements1: dict[int, FloatArray] = {}
        for q, front in enumerate(self.tree.fronts):
            whole = self._entries(front, matrix)
            _add_children(whole, front, complements)
            K, N, complements[q] = _eliminate(whole, front.c, diagonal[front.pivots])
            K1 = N1 = none
            if areas is not None:
                pivots = np.arange(front.c)
                whole = np.zeros_like(whole)
                whole[pivots, pivots] = areas[self.tree.vertices[front.pivots]]
                _add_children(whole, front, complements1)
                K1, N1, complements1[q] = _derive(whole, K, N)
            self._blocks.append(Blocks(K, N, K1, N1))
            job.advance(_work(front))

    def _entries(self, front: Front, matrix: sp.csr_matrix) -> FloatArray:
        """Return (s, s) the entries of the matrix in the rows and columns of a front's pivots, read right of the
        diagonal."""
        own = matrix[front.pivots].tocoo()
        row, column = front.pivots[own.row], own.col
        read = (column >= row) & (own.data != 0)
        row, column, value = row[read], column[read], own.data[read]
        outside = np.flatnonzero(~np.isin(column, front.rows))
        if len(outside):
            i, j = (self.tree.vertices[places[outside[0]]] for places in (row, column))
            raise ParameterError(f"The entry ({i}, {j}) is outside the pattern of the tree.")
        i, j = (np.searchsorted(front.rows, places) for places in (row, column))
        block = np.zeros((len(front.rows), len(front.rows)), matrix.dtype)
        block[i, j] = block[j, i] = value
        return block

    @one_blas_thread()
    def diagonals(self, job: Job, pattern: sp.csr_matrix | None = None) -> tuple[FloatArray, FloatArray]:
        """Return (n,) diag(G) and (n,) diag(G A G), or with a pattern entries (e,) there, those right of the diagonal
        in elimination order."""
        [found] = job.run(lambda wanted: self._invert(job, wanted), [pattern])
        return found

    def _invert(self, job: Job, pattern: sp.csr_matrix | None) -> tuple[FloatArray, FloatArray]:
        """Top down: the boundary's block of the inverse is part of the parent's."""
        diagonal, sandwich = np.empty((2, self.tree.n), self._dtype)
        entries = None if pattern is None else np.zeros((2, pattern.nnz), self._dtype)
        fronts = self.tree.fronts
        known = {len(fronts) - 1: (np.empty((0, 0)), np.empty((0, 0)))}
        for q, front in reversed(list(enumerate(fronts))):
            blocks = self._blocks[q]
            if not blocks.K1.size:
                blocks = blocks._replace(K1=0 * blocks.K, N1=0 * blocks.N)
            Z, H = _invert(blocks, *known.pop(q))
            vertices = self.tree.vertices[front.pivots]
            if pattern is not None and entries is not None:
                for i, vertex in enumerate(vertices):
                    row = np.arange(pattern.indptr[vertex], pattern.indptr[vertex + 1])
                    places = self.tree.place[pattern.indices[row]]
                    right = places >= front.pivots[i]
                    column = np.searchsorted(front.rows, places[right])
                    entries[:, row[right]] = Z[i, column], H[i, column]
            diagonal[vertices], sandwich[vertices] = Z.diagonal()[: front.c], H.diagonal()[: front.c]
            for child, up in front.children:
                known[child] = Z[np.ix_(up, up)], H[np.ix_(up, up)]
            job.advance(_work(front))
        first, second = (diagonal, sandwich) if entries is None else entries
        return first, second

    @one_blas_thread()
    @np.errstate(all="ignore")
    def solve(self, b: FloatArray, out: FloatArray, _run: object, _workspaces: object) -> None:
        """out (n, k) = matrix^-1 b, b (n, k): up from the leaves to the root, and down."""
        x = b[self.tree.vertices].astype(out.dtype)
        fronts = list(zip(self.tree.fronts, self._blocks, strict=True))
        for front, (_, N, _, _) in fronts:
            x[front.boundary] += N.T @ x[front.pivots]
        for front, (K, N, _, _) in reversed(fronts):
            x[front.pivots] = K @ x[front.pivots] + N @ x[front.boundary]
        out[:] = x[self.tree.place]

    @one_blas_thread()
    @np.errstate(all="ignore")
    def each_sandwich_piece(
        self, index: IntArray, _run: object, receive: Callable[[IntArray, FloatArray], None], _workspaces: object
    ) -> None:
        """Compute the columns `index` (k,) of G A G, in one piece: receive(vertices (n,), values (n, k)).

        The sweeps of a solve, with their derivatives: they turn unit vectors x into columns of G, and y = 0 into those
        of G A G.
        """
        x, y = np.zeros((2, self.tree.n, len(index)))
        x[self.tree.place[index], np.arange(len(index))] = 1
        fronts = list(zip(self.tree.fronts, self._blocks, strict=True))
        for front, (_, N, _, N1) in fronts:
            y[front.boundary] += N.T @ y[front.pivots] + N1.T @ x[front.pivots]
            x[front.boundary] += N.T @ x[front.pivots]
        for front, (K, N, K1, N1) in reversed(fronts):
            p, b = front.pivots, front.boundary
            y[p] = K @ y[p] + K1 @ x[p] + N @ y[b] + N1 @ x[b]
            x[p] = K @ x[p] + N @ x[b]
        receive(self.tree.vertices, y)


def _add_children(block: FloatArray, front: Front, complements: dict[int, FloatArray]) -> None:
    """Add the Schur complements of a front's children to its block (s, s); they are taken out of `complements`."""
    for child, up in front.children:
        block[np.ix_(up, up)] += complements.pop(child)
