"""Operators of other triangulations of a surface: intrinsic Delaunay ones, and the tufted cover.

On a surface every edge of two faces can be flipped to the other diagonal, straight along the surface, until all
triangles are Delaunay: then no weight of the stiffness matrix is negative, however thin the faces were (Bobenko and
Springborn 2007; Fisher et al. 2006).  Edges on a boundary, and those of more than two faces, stay.  The tufted cover
has two sides of each face, glued about every edge in pairs, so that also these can be flipped (Sharp and Crane 2020).
"""

from __future__ import annotations

import math
from collections import deque

import numpy as np
import scipy.sparse as sp

from .arrays import AnyArray, FloatArray, IntArray
from .errors import MeshError, ParameterError
from .progress import Progress
from .solver.aside import aside
from .surface import Surface

COTAN, INTRINSIC, TUFTED = OPERATORS = ("cotan", "intrinsic-delaunay", "tufted")
"""The paper's operator, by cotangents of the faces, and others."""
MOLLIFIED = 1e-5
"""By this share of the mean edge any two sides of a triangle are longer than the third, as Sharp and Crane have it."""
SLACK = 1e-12
"""By how much, for rounding, cotangents may add up to less than nothing."""
LONG = 5_000
"""From so many vertices on the tufted cover is made in a process of its own, which lets other threads run."""

Corners = tuple[FloatArray, FloatArray, FloatArray]
"""(3, m) cotangent of each corner, (3, m) squared length of the side opposite to it, (m,) face areas."""


def checked_operator(operator: str, areas: str) -> str:
    """Return the name of an operator; ParameterError for another, and for areas that it has not."""
    if operator not in OPERATORS:
        raise ParameterError(f"There is no operator {operator!r}; choose one of {', '.join(OPERATORS)}.")
    if operator == TUFTED and areas != "voronoi":
        raise ParameterError(f"The operator tufted has areas of its own, and no {areas} ones.")
    return operator


# ---------------------------------------------------------------------- the tufted cover
def tufted(surface: Surface) -> tuple[sp.csr_matrix, FloatArray]:
    """Return the stiffness matrix (n, n) and the areas (n,) of the tufted cover.

    MeshError if the package robust_laplacian is not installed, or finds none.
    """
    used = surface.component_of_vertex >= 0
    new, x = np.cumsum(used) - 1, surface.vertices[used]
    # In units of their extent, for what is large or small.
    scale = float(np.ptp(x, axis=0).max())
    work = aside if len(x) >= LONG else lambda do, *arguments: do(*arguments)
    try:
        found, masses = work(_tufted, (x - x[0]) / scale, new[surface.faces])
    except ImportError:
        raise MeshError(
            "The operator tufted needs the package robust_laplacian; `pip install 'bihdist[points]'` brings it."
        ) from None
    except RuntimeError as error:
        raise MeshError(f"{surface.name} has no tufted cover: {error}.") from None
    there = sp.csr_matrix((np.ones(len(x)), (np.flatnonzero(used), np.arange(len(x)))), shape=(len(used), len(x)))
    matrix = sp.csr_matrix(there @ ((found + found.T) / 2) @ there.T)
    matrix.sort_indices()
    return matrix, there @ masses * scale**2


def _tufted(
    vertices: FloatArray, faces: IntArray, progress: Progress | None = None
) -> tuple[sp.csr_matrix, FloatArray]:
    from robust_laplacian import mesh_laplacian

    stiffness, masses = mesh_laplacian(vertices, faces, mollify_factor=MOLLIFIED)
    return sp.csr_matrix(stiffness), masses.diagonal()


# ---------------------------------------------------------------------- flips
def delaunay(surface: Surface) -> tuple[IntArray, Corners]:
    """Return the triangles (m, 3) of an intrinsic Delaunay triangulation with the surface's vertices, and their
    corners; a vertex may be a corner of one more than once."""
    lengths = np.stack([np.linalg.norm(side, axis=0) for side in surface.sides()], axis=1)
    short = (2 * lengths.max(axis=1) - lengths.sum(axis=1)).max()
    least = MOLLIFIED * surface.mean_edge_length
    if short > -least:
        # All sides by as much, so that triangles that share one still do.
        lengths += short + least
    faces = np.array(surface.faces)
    flip(faces, lengths)
    return faces, corners_of(lengths)


def corners_of(lengths: FloatArray) -> Corners:
    """Return the corners of triangles with sides (m, 3), each opposite to a corner."""
    squares, area = lengths.T**2, areas_of(lengths)
    cotangents = (squares.sum(axis=0) - 2 * squares) / (4 * area)
    return cotangents, squares, area


def areas_of(lengths: FloatArray) -> FloatArray:
    """Return (m,) areas of triangles with sides (m, 3), to all digits (Kahan 1986)."""
    c, b, a = np.sort(lengths, axis=1).T
    areas: FloatArray = np.sqrt(np.maximum((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)), 0)) / 4
    return areas


def stiffness_of(n: int, faces: IntArray, cotangents: FloatArray) -> sp.csr_matrix:
    """Return the stiffness matrix (n, n) of triangles (m, 3) by the cotangents (3, m) of their corners."""
    i, j = (np.concatenate([faces[:, (k + s) % 3] for k in range(3)]) for s in (1, 2))
    half = sp.coo_matrix((cotangents.ravel() / 2, (i, j)), shape=(n, n)).tocsr()
    weights = half + half.T
    # An edge from a vertex to itself joins nothing.
    weights.setdiag(0)
    weights.eliminate_zeros()
    matrix = (sp.diags_array(np.asarray(weights.sum(axis=1)).ravel()) - weights).tocsr()
    matrix.sort_indices()
    return matrix


def flip(faces: AnyArray, lengths: FloatArray) -> int:
    """Flip the sides of triangles (m, 3) with lengths (m, 3), in place, until all are Delaunay; return how many were.

    Side 3 f + k of triangle f is opposite to its corner k, and leads from corner k + 1 to corner k + 2.
    """
    twin, is_turned = _glued(faces)
    cotangents, _, _ = corners_of(lengths)
    cot = cotangents.T.ravel()
    glued = np.flatnonzero(twin >= 0)
    both = cot[glued] + cot[twin[glued]]
    waiting = deque(glued[both < -SLACK * (1 + np.abs(cot[glued]) + np.abs(cot[twin[glued]]))].tolist())
    if not waiting:
        return 0
    corner, length, cots = faces.ravel().tolist(), lengths.ravel().tolist(), cot.tolist()
    other, turned, count = twin.tolist(), is_turned.tolist(), 0
    while waiting:
        s = waiting.popleft()
        t = other[s]
        if t < 0 or cots[s] + cots[t] >= -SLACK * (1 + abs(cots[s]) + abs(cots[t])):
            continue
        f, g = s - s % 3, t - t % 3
        # Triangle f is p, i, j, and g is q, j, i, with the sides after s and t: ip is opposite to j.
        jp, pi = f + (s + 1) % 3, f + (s + 2) % 3
        iq, qj = g + (t + 1) % 3, g + (t + 2) % 3
        if turned[s]:
            # Triangle g is q, i, j: seen from the other side.
            iq, qj = qj, iq
        p, i, j, q = corner[s], corner[jp], corner[pi], corner[t]
        near, far = (length[pi], length[jp]), (length[iq], length[qj])
        base = length[s]
        x, y = _place(base, *near)
        u, v = _place(base, *far)
        across = math.hypot(x - u, y + v)
        sides = [(pi, f + 2, near[0], False), (iq, f, far[0], turned[s])]
        sides += [(qj, g, far[1], turned[s]), (jp, g + 1, near[1], False)]
        # Triangles p, i, q and p, q, j; sides keep their lengths and what they are glued to.
        moved = {old: new for old, new, _, _ in sides}
        is_changed = {old: change for old, _, _, change in sides}
        links = [(new, moved.get(other[old], other[old]), turned[old] ^ change ^ is_changed.get(other[old], False))
                 for old, new, _, change in sides]  # fmt: skip
        corner[f : f + 3], corner[g : g + 3] = [p, i, q], [p, q, j]
        for _, new, size, _ in sides:
            length[new] = size
        length[f + 1] = length[g + 2] = across
        for new, to, is_opposite in links:
            other[new], turned[new] = to, is_opposite
            if to >= 0:
                other[to], turned[to] = new, is_opposite
        other[f + 1], other[g + 2] = g + 2, f + 1
        turned[f + 1] = turned[g + 2] = False
        for face in (f, g):
            cots[face : face + 3] = _cotangents(*length[face : face + 3])
        waiting.extend(new for _, new, _, _ in sides if other[new] >= 0)
        count += 1
    faces[:], lengths[:] = np.reshape(corner, faces.shape), np.reshape(length, lengths.shape)
    return count


def _glued(faces: IntArray) -> tuple[IntArray, AnyArray]:
    """Return (3 m,) the other side of each edge of two triangles, -1 for other sides, and whether both lead the same
    way."""
    start, end = faces[:, [1, 2, 0]].ravel(), faces[:, [2, 0, 1]].ravel()
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.lexsort((high, low))
    same = (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
    before, after = np.append(False, same), np.append(same, False)
    first = np.flatnonzero(after & ~before)
    first = first[~np.append(after, False)[first + 1]]
    one, two = order[first], order[first + 1]
    twin, is_turned = np.full(len(start), -1), np.zeros(len(start), bool)
    twin[one], twin[two] = two, one
    is_turned[one] = is_turned[two] = start[one] == start[two]
    return twin, is_turned


def _place(base: float, one: float, other: float) -> tuple[float, float]:
    """Return where the point is whose distances from the ends (0, 0) and (base, 0) are `one` and `other`."""
    x = (base**2 + one**2 - other**2) / (2 * base)
    return x, 2 * _area(base, one, other) / base


def _area(a: float, b: float, c: float) -> float:
    c, b, a = sorted((a, b, c))
    return math.sqrt(max((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)), 0.0)) / 4


def _cotangents(a: float, b: float, c: float) -> list[float]:
    """Return the cotangents of the corners opposite to the sides."""
    total, area = a * a + b * b + c * c, 4 * _area(a, b, c) or 1e-300
    return [(total - 2 * side * side) / area for side in (a, b, c)]
