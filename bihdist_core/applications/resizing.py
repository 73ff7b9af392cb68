"""A surface with more or fewer vertices, for experiments that compare tessellations or sizes.

Simplification collapses edges by the quadric error (Garland, Heckbert 1997), always onto one of the two ends: every
vertex that is left is one of the given surface, at its place, so that fields can be compared at the same points.
Many collapses far from each other are done at once, in rounds.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..progress import Progress, silent
from ..scalars import whole_number
from ..surface import Surface

KEEP_NORMAL = 0.3
"""Least cosine between the normals of a face before and after a collapse."""
KEEP_SHAPE = 0.45
"""Least quality of a new face: 4 sqrt(3) area / sum of squared sides, 1 if equilateral."""
EVENNESS = 0.05
"""Weight of (edge length)^4 beside the quadric error, of the same unit: keeps triangles even where all is flat."""
MOST_NEIGHBOURS = 9
CHEAPEST = 0.5
"""A round considers this fraction of the vertices, those cheapest to remove."""


def refined(surface: Surface) -> Surface:
    """Cut each face into four at the middles of its edges; the old vertices keep their ids and come first."""
    f, n, x = surface.faces, len(surface.vertices), surface.vertices
    edges = surface.edges
    key = edges[:, 0] * n + edges[:, 1]

    def middle(a: IntArray, b: IntArray) -> IntArray:
        return n + np.searchsorted(key, np.minimum(a, b) * n + np.maximum(a, b))

    a, b, c = f.T
    ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
    faces = np.concatenate([np.stack(t, 1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return Surface(np.concatenate([x, x[edges].mean(axis=1)]), faces, surface.name)


def resized(surface: Surface, count: int, progress: Progress | None = None) -> Surface:
    """Return the surface with exactly `count` vertices: refined until it has as many, then simplified.

    Raises ParameterError as `simplified`.
    """
    if count > 2 * len(surface.vertices):
        # A refined coarse mesh is more even than a fine one with vertices taken out, and quicker to make.
        times = int(np.ceil(np.log(count / len(surface.vertices)) / np.log(4)))
        spare = 3 * surface.n_components + len(surface.boundary_edges)
        surface = simplified(surface, min(len(surface.vertices), count // 4**times + spare))[0]
    while len(surface.vertices) < count:
        surface = refined(surface)
    return simplified(surface, count, progress)[0]


def simplified(surface: MeshLike, count: int, progress: Progress | None = None) -> tuple[Surface, IntArray]:
    """Simplify a surface to a number of its vertices.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    count : int
        How many vertices, at least 4.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    surface : Surface
        The simplified surface. Its topology, components and boundary loops are the same.
    ids : (count,) int64 ndarray
        The vertices of the given surface that are left, ascending; they have not moved.

    Raises
    ------
    ParameterError
        If more than `count` vertices have to stay, or if there are not so many to begin with.

    Notes
    -----
    Edges are collapsed by the quadric error (Garland, Heckbert 1997), always onto one of their ends. Vertices of edges
    with more than two faces stay; those of no face are left out.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> fewer, ids = bihdist.simplified(pyvista.Icosphere(nsub=3), 100)
    >>> fewer.n_vertices, fewer.genus, ids.shape
    (100, 0, (100,))
    """
    surface = Surface.of(surface)
    small, ids = _collapsed(surface, whole_number(count, "The number of vertices"), progress)
    if len(ids) > count:
        raise ParameterError(f"{surface.name} cannot be simplified below {len(ids):,} vertices without damage.")
    return small, ids


def at_most(surface: Surface, count: int, progress: Progress | None = None) -> Surface:
    """Return the surface with at most `count` vertices, simplified as far as that is possible."""
    used = len(surface.vertices) - surface.unreferenced_count
    if len(surface.vertices) <= count:
        return surface
    return _collapsed(surface, min(count, used), progress)[0]


def _collapsed(surface: Surface, count: int, progress: Progress | None) -> tuple[Surface, IntArray]:
    """Simplify like `simplified`, with more vertices where it goes no further."""
    n, used = len(surface.vertices), surface.component_of_vertex >= 0
    left, idle, relaxed = int(used.sum()), 0, False
    if not 4 <= count <= left:
        raise ParameterError(f"{surface.name} has {left:,} vertices and cannot be simplified to {count:,}.")
    x, faces = surface.vertices, surface.faces
    quadrics = _quadrics(surface)
    alive = used.copy()
    rng = np.random.default_rng(0)
    report, start = progress or silent, left
    while left > count:
        gone, onto = _round(x, faces, quadrics, left - count, rng, 1.0 if idle else CHEAPEST, relaxed)
        idle = 0 if len(gone) else idle + 1
        if idle > 10 and relaxed:
            break
        if idle > 10:
            # What is in the way are slivers, which are no reason to keep a vertex.
            relaxed, idle = True, 0
        follow = np.arange(n)
        follow[gone] = onto
        np.add.at(quadrics, onto, quadrics[gone])
        faces = follow[faces]
        faces = faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]
        alive[gone] = False
        left -= len(gone)
        report((start - left) / (start - count), "simplifying")
    ids = np.flatnonzero(alive)
    return Surface(x[ids], np.searchsorted(ids, faces), surface.name), ids


def _round(
    x: FloatArray,
    faces: IntArray,
    quadrics: FloatArray,
    most: int,
    rng: np.random.Generator,
    fraction: float,
    relaxed: bool,
) -> tuple[IntArray, IntArray]:
    """Return at most `most` vertices to remove, no two with a common neighbour, and the neighbours they move onto."""
    n = len(x)
    sides = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    key, count = np.unique(sides[:, 0] * n + sides[:, 1], return_counts=True)
    edges = np.stack([key // n, key % n], 1)
    valence = np.bincount(edges.ravel(), minlength=n)
    rim = np.bincount(edges[count == 1].ravel(), minlength=n) > 0
    fixed = np.bincount(edges[count > 2].ravel(), minlength=n) > 0
    both = np.concatenate([edges, edges[:, ::-1]])
    on_rim = np.tile(count == 1, 2)
    u, v = both.T
    allowed = (
        ~fixed[u]
        & ~np.tile(_needed(faces, edges, count, n), 2)
        & (~rim[u] | on_rim)
        & (valence[u] + valence[v] - 4 <= MOST_NEIGHBOURS)
    )
    u, v, on_rim = u[allowed], v[allowed], on_rim[allowed]
    length = np.linalg.norm(x[u] - x[v], axis=1)
    at = np.concatenate([x[v], np.ones((len(v), 1))], axis=1)
    cost = np.maximum(np.einsum("ki,kij,kj->k", at, quadrics[u], at), 0) + EVENNESS * length**4
    # A little chance, so that the choice does not follow the order of the triangles.
    cost *= rng.uniform(0.7, 1.4, len(cost))
    best = np.lexsort((cost, u))
    best = best[np.append(True, np.diff(u[best]) > 0)] if len(best) else best
    best = best[np.argsort(cost[best])]
    best = best[: max(1, int(np.ceil(fraction * len(best))))]
    u, v, cost, on_rim = u[best], v[best], cost[best], on_rim[best]

    neighbours = sp.csr_array((np.ones(len(both), np.int8), both.T), shape=(n, n))
    common = np.asarray(neighbours[u].multiply(neighbours[v]).sum(axis=1)).ravel()
    good = common == np.where(on_rim, 1, 2)
    good[good] = _harmless(x, faces, u[good], v[good], relaxed)
    u, v, cost = u[good], v[good], cost[good]

    rank = np.full(n, n)
    rank[u] = np.arange(len(u))
    nearest = rank
    for _ in range(2):
        spread = nearest.copy()
        np.minimum.at(spread, both[:, 0], nearest[both[:, 1]])
        nearest = spread
    chosen = np.flatnonzero(nearest[u] == rank[u])[:most]
    return u[chosen], v[chosen]


def _needed(faces: IntArray, edges: IntArray, count: IntArray, n: int) -> BoolArray:
    """Return (e,) whether collapsing edges (e, 2), of so many faces each, would leave a vertex without a face."""
    size = np.bincount(faces.ravel(), minlength=n)
    # The corner opposite to the edge may have that face alone, or both of its ends no other.
    face, corner = np.nonzero(size[faces] == 1)
    a, b = faces[face, (corner + 1) % 3], faces[face, (corner + 2) % 3]
    opposite = np.isin(edges[:, 0] * n + edges[:, 1], np.minimum(a, b) * n + np.maximum(a, b))
    refused: BoolArray = opposite | (size[edges].sum(axis=1) <= 2 * count)
    return refused


def _harmless(x: FloatArray, faces: IntArray, u: IntArray, v: IntArray, relaxed: bool = False) -> BoolArray:
    """Return (k,) whether moving u onto v turns no face over and makes none too thin.

    If `relaxed`, thin faces are allowed where those at u are thinner already.
    """
    corner = faces.T.ravel()
    order = np.argsort(corner, kind="stable")
    start = np.searchsorted(corner[order], np.arange(len(x) + 1))
    size = start[u + 1] - start[u]
    which = np.repeat(np.arange(len(u)), size)
    place = np.arange(size.sum()) - np.repeat(np.cumsum(size) - size, size)
    side = order[start[u][which] + place]
    m = len(faces)
    face, k = side % m, side // m
    a, b = faces[face, (k + 1) % 3], faces[face, (k + 2) % 3]
    least = np.full(len(u), KEEP_SHAPE)
    if relaxed:
        np.minimum.at(least, which, _shapes(x[u[which]], x[a], x[b]))
    stays = (a != v[which]) & (b != v[which])
    which, a, b = which[stays], a[stays], b[stays]
    old = np.cross(x[a] - x[u[which]], x[b] - x[u[which]])
    new = np.cross(x[a] - x[v[which]], x[b] - x[v[which]])
    bad = np.einsum("ij,ij->i", old, new) <= KEEP_NORMAL * np.linalg.norm(old, axis=1) * np.linalg.norm(new, axis=1)
    bad |= _shapes(x[v[which]], x[a], x[b]) <= least[which]
    is_allowed: BoolArray = np.bincount(which[bad], minlength=len(u)) == 0
    return is_allowed


def _shapes(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Return (k,) the quality of triangles with corners (k, 3)."""
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    sides = sum(((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a)))
    quality: FloatArray = 2 * np.sqrt(3) * area / np.maximum(sides, 1e-300)
    return quality


def _quadrics(surface: Surface) -> FloatArray:
    """Return (n, 4, 4): at (x, 1), the sum over the faces at a vertex of area times squared distance to the face's
    plane.

    At a boundary also to the plane through the edge that is upright on the face, so that the rim stays in place.
    """
    x, faces = surface.vertices, surface.faces
    a, b, c = (x[faces[:, k]] for k in range(3))
    area = surface.face_areas
    with np.errstate(invalid="ignore", divide="ignore"):
        normal = np.nan_to_num(np.cross(b - a, c - a) / (2 * area[:, None]))
    quadrics = np.zeros((len(x), 4, 4))
    plane = np.concatenate([normal, -np.einsum("ij,ij->i", normal, a)[:, None]], axis=1)
    for k in range(3):
        np.add.at(quadrics, faces[:, k], area[:, None, None] / 3 * plane[:, :, None] * plane[:, None, :])
    n = len(x)
    rim = np.sort(surface.boundary_edges, axis=1)
    rim_keys = rim[:, 0] * n + rim[:, 1]
    for k in range(3):
        i, j = faces[:, k], faces[:, (k + 1) % 3]
        mine = np.isin(np.minimum(i, j) * n + np.maximum(i, j), rim_keys)
        i, j, side = i[mine], j[mine], x[j[mine]] - x[i[mine]]
        upright = np.cross(side, normal[mine])
        upright /= np.maximum(np.linalg.norm(upright, axis=1, keepdims=True), 1e-300)
        plane = np.concatenate([upright, -np.einsum("ij,ij->i", upright, x[i])[:, None]], axis=1)
        term = (side**2).sum(axis=1)[:, None, None] * plane[:, :, None] * plane[:, None, :]
        np.add.at(quadrics, i, term)
        np.add.at(quadrics, j, term)
    return quadrics
