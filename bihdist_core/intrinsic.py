"""Operators of other triangulations of a surface: intrinsic Delaunay ones, and the tufted cover.

On a surface every edge of two faces can be flipped to the other diagonal, straight along the surface, until all
triangles are Delaunay: then no weight of the stiffness matrix is negative, however thin the faces were (Bobenko and
Springborn 2007; Fisher et al. 2006).  Edges on a boundary, and those of more than two faces, stay.  The tufted cover
has two sides of each face, glued about every edge in pairs, so that also these can be flipped (Sharp and Crane 2020).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.sparse as sp

from .arrays import FloatArray, IntArray
from .errors import MeshError, ParameterError
from .kernel.library import library, why_plain
from .surface import Surface

COTAN, INTRINSIC, TUFTED = OPERATORS = ("cotan", "intrinsic-delaunay", "tufted")
"""The paper's operator, by cotangents of the faces, and others."""
MOLLIFIED = 1e-5
"""By this share of the mean edge any two sides of a triangle are longer than the third, as Sharp and Crane have it."""

Corners = tuple[FloatArray, FloatArray, FloatArray]
"""(3, m) cotangent of each corner, (3, m) squared length of the side opposite to it, (m,) face areas."""


def checked_operator(operator: str, areas: str) -> str:
    """Return the name of an operator; ParameterError for another, and for areas that it has not."""
    if operator not in OPERATORS:
        raise ParameterError(f"There is no operator {operator!r}; choose one of {', '.join(OPERATORS)}.")
    if operator == TUFTED and areas != "voronoi":
        raise ParameterError(f"The operator tufted has areas of its own, and no {areas} ones.")
    return operator


def tufted(surface: Surface) -> tuple[sp.csr_matrix, FloatArray]:
    """Return the stiffness matrix (n, n) and the areas (n,) of the tufted cover."""
    n, (faces, lengths) = len(surface.vertices), delaunay(surface, is_cover=True)
    cotangents, _, area = corners_of(lengths)
    # Each face is there twice.
    areas = np.bincount(faces.T.ravel(), np.tile(area / 6, 3), n).astype(float, copy=False)
    return stiffness_of(n, faces, cotangents / 4), areas


def delaunay(surface: Surface, is_cover: bool = False) -> tuple[IntArray, FloatArray]:
    """Return the triangles (m, 3) of an intrinsic Delaunay triangulation with the surface's vertices, or of its tufted
    cover, and the lengths (m, 3) of their sides, as of `flip`."""
    edge, (i, j) = surface.edge_of_side.reshape(3, -1)[[1, 2, 0]].T, surface.edges.T
    of_edge = np.linalg.norm(surface.vertices[i] - surface.vertices[j], axis=1)
    if not of_edge.any():
        raise MeshError(f"{surface.name}: all edges have length 0; there is no Delaunay triangulation.")
    lengths = of_edge[edge]
    short = (2 * lengths.max(axis=1) - lengths.sum(axis=1)).max() + MOLLIFIED * of_edge.mean()
    # All sides by as much, so that triangles that share one still do.
    lengths += max(0.0, short)
    return flip(surface.faces, lengths, edge, surface.name, surface.vertices if is_cover else None)


def flip(
    faces: IntArray, lengths: FloatArray, edge: IntArray, name: str, x: FloatArray | None = None
) -> tuple[IntArray, FloatArray]:
    """Return an intrinsic Delaunay triangulation of faces (m, 3), or with their vertices x (n, 3) its tufted cover.

    Sides (m, 3), with their lengths and the numbers of their edges, are each opposite to a corner; a vertex may be more
    than one corner of a triangle.  MeshError without the compiled kernel.
    """
    kernel = kernel_for(name)
    m, count = len(faces), int(edge.max()) + 1
    if x is not None:
        faces, lengths = (np.concatenate([each, each[:, [0, 2, 1]]]) for each in (faces, lengths))
    corner, sides = np.array(faces, np.int32, order="C"), np.array(lengths, order="C")
    twin, work = np.empty_like(corner), np.empty(count + 1 + corner.size, np.int32)
    marks, angles = np.zeros(corner.size, np.uint8), np.empty(3 * m)
    kernel.bih_make_delaunay(m, count, np.ascontiguousarray(edge), x, corner, sides, twin, work, marks, angles)
    return corner.astype(np.int64), sides


def kernel_for(name: str) -> Any:
    """Return the compiled kernel; MeshError, which begins with `name`, without one."""
    kernel = library()
    if kernel is None:
        raise MeshError(f"{name}: Delaunay triangulations need the compiled kernel ({why_plain()}).")
    return kernel


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


def stiffness_of(n: int, faces: IntArray, weights: FloatArray) -> sp.csr_matrix:
    """Return the stiffness matrix (n, n) of triangles (m, 3) by what they add to the weights of their sides (3, m),
    each opposite to a corner; the rows of other vertices are empty."""
    rows, f, weights = n, np.ascontiguousarray(faces, np.int64), np.ascontiguousarray(weights)
    for k in range(3):
        loops = np.flatnonzero(f[:, k - 2] == f[:, k - 1])
        if len(loops):
            # A side from a vertex to itself joins nothing; of the other two, which are between the same vertices, one
            # gets both weights, and one leads to a row that is left out.
            rows, f, weights = n + 3, f.copy(), weights.copy()
            weights[k - 1, loops] += weights[k - 2, loops]
            weights[k, loops] = weights[k - 2, loops] = 0
            f[loops, k - 1] = n + k
    if lib := library():
        room = rows + 9 * len(f)
        start, index, value = np.empty(rows + 1, np.int32), np.empty(room, np.int32), np.empty(room)
        count = lib.bih_stiffness(rows, len(f), f, weights, start, index, value, np.empty(3 * rows + 1, np.int32))
        matrix = sp.csr_matrix((value[:count].copy(), index[:count].copy(), start), shape=(rows, rows))
        matrix.has_canonical_format = True
        return matrix if rows == n else matrix[:n, :n]
    i, j = (np.concatenate([f[:, (k + s) % 3] for k in range(3)]) for s in (1, 2))
    half = sp.coo_matrix((weights.ravel(), (i, j)), shape=(n, n)).tocsr()
    whole = half + half.T
    return (sp.diags_array(np.asarray(whole.sum(axis=1)).ravel()) - whole).tocsr()
