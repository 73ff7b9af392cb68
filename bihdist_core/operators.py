"""The discrete Laplace-Beltrami operator (paper, Eq. 7): Delta = A^-1 L.

L is the stiffness matrix: the cotangent Laplacian with weight (cot alpha + cot beta) / 2 on each edge, positive
semi-definite, zero row sums; no unit.  A is the diagonal of vertex areas; unit length squared.  The paper's Eq. 7
leaves the 1/2 out, which scales every biharmonic distance by 1/2 and changes nothing else; with it the discrete
distance converges to the continuous one.  At a boundary the same formula gives Neumann conditions (section 3.2).

Faces of (nearly) no area have no cotangents that could be used; what they get instead, `degenerate_faces` tells.  All
other faces stay exactly as they are.
"""

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from .arrays import FloatArray, IntArray, real_numbers
from .degenerate_faces import DegenerateFaces
from .errors import ParameterError
from .intrinsic import COTAN, INTRINSIC, TUFTED, Corners, corners_of, delaunay, flip, stiffness_of, tufted
from .kernel.library import library
from .mesh_arrays import checked_faces
from .point_cloud import PointCloud
from .surface import FLAT_RATIO, Surface
from .tetrahedra import TetrahedralMesh

AREAS = ("voronoi", "barycentric")
ALIKE = 1e-9
"""The lengths of an edge in its faces may differ by this share, for rounding."""


def checked_areas(kind: str) -> str:
    """Return the name of vertex areas; ParameterError for another."""
    if kind not in AREAS:
        raise ParameterError(f"There are no {kind!r} vertex areas; choose one of {', '.join(AREAS)}.")
    return kind


def operators(surface: Surface, areas: str = "voronoi", operator: str = COTAN) -> tuple[sp.csr_matrix, FloatArray]:
    """Return `stiffness` (n, n) and `vertex_areas` (n,), for which the faces are measured once, or another operator's.

    Those of points and tetrahedra are their own.  ParameterError for other areas and operators of these.
    """
    if isinstance(surface, PointCloud | TetrahedralMesh):
        if areas != AREAS[0]:
            raise ParameterError(f"{surface.name}: {areas} areas need faces, and there are none.")
        if operator != COTAN:
            raise ParameterError(f"{surface.name}: the operator {operator} needs faces, and there are none.")
        return surface.matrices
    if operator == TUFTED:
        return tufted(surface)
    if operator == INTRINSIC:
        return _of_lengths(len(surface.vertices), *delaunay(surface), areas)
    corners = _corners(surface)
    return _stiffness(surface, corners), _areas(surface, areas, corners)


def operators_by_lengths(
    faces: npt.ArrayLike, lengths: npt.ArrayLike, areas: str, operator: str, name: str
) -> tuple[sp.csr_matrix, FloatArray]:
    """Return the matrices of `operators` of triangles (m, 3) with sides of lengths (m, 3), each opposite to a corner.

    MeshError for faces that do not fit, and ParameterError for lengths that do not, which are named.
    """
    if operator == TUFTED:
        raise ParameterError(f"{name}: the operator tufted needs positions, and there are lengths alone.")
    sides = real_numbers(lengths, "Lengths").copy()
    n = int(np.max(faces, initial=-1)) + 1
    triangles, repairs = checked_faces(faces, n, name)
    if repairs or sides.shape != triangles.shape:
        raise ParameterError(f"{name}: faces have three vertices each, no other face has, and three lengths.")
    short = np.flatnonzero(~((sides > 0).all(axis=1) & (2 * sides.max(axis=1) < sides.sum(axis=1))))
    if len(short):
        raise ParameterError(f"{name}: the sides of face {short[0]}, {sides[short[0]].tolist()}, make no triangle.")
    if len(unused := np.setdiff1d(np.arange(n), triangles)):
        raise ParameterError(f"{name}: vertex {unused[0]} belongs to no face.")
    pairs = np.sort(triangles[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2), axis=1)
    edges, number = np.unique(pairs, axis=0, return_inverse=True)
    most, least = np.zeros(len(edges)), np.full(len(edges), np.inf)
    np.maximum.at(most, number.ravel(), sides.ravel())
    np.minimum.at(least, number.ravel(), sides.ravel())
    wrong = np.flatnonzero(most - least > ALIKE * most)
    if len(wrong):
        i, j = edges[wrong[0]]
        raise ParameterError(f"{name}: edge {i}, {j} is {least[wrong[0]]:g} long in a face, and {most[wrong[0]]:g}.")
    if operator == INTRINSIC:
        triangles, sides = flip(triangles, sides, number.reshape(-1, 3), name)
    return _of_lengths(n, triangles, sides, areas)


def _of_lengths(n: int, faces: IntArray, lengths: FloatArray, areas: str) -> tuple[sp.csr_matrix, FloatArray]:
    corners = corners_of(lengths)
    shares = _shares(areas, corners)
    return stiffness_of(n, faces, corners[0] / 2), np.bincount(faces.T.ravel(), shares.ravel(), n).astype(float)


def stiffness(surface: Surface) -> sp.csr_matrix:
    """Return (n, n) cotangent stiffness matrix; the rows of unreferenced vertices are empty."""
    return _stiffness(surface, _corners(surface))


def _stiffness(surface: Surface, corners: Corners) -> sp.csr_matrix:
    return stiffness_of(len(surface.vertices), surface.faces, _weights(surface, corners))


def face_weights(surface: Surface) -> FloatArray:
    """Return (3, m) half the cotangent of each corner: what a face adds to the weight of the side opposite to it."""
    return _weights(surface, _corners(surface))


def _weights(surface: Surface, corners: Corners) -> FloatArray:
    weights = corners[0] / 2
    if len(surface.degenerate_faces):
        weights[:, surface.degenerate_faces] = DegenerateFaces.of(surface).weights()
    return weights


def vertex_areas(surface: Surface, kind: str = "voronoi") -> FloatArray:
    """Return (n,) areas, unit length squared, that sum to the surface's area; 0 for vertices that have no face, or next
    to no area, unless their whole component has none.

    "voronoi": mixed Voronoi areas (Meyer et al. 2002), as the paper's text; "barycentric": a third of each face's
    area to each of its vertices, as its authors' program.  Raises ParameterError for any other word.
    """
    return _areas(surface, kind, _corners(surface))


def _areas(surface: Surface, kind: str, corners: Corners) -> FloatArray:
    checked_areas(kind)
    cotangents, squares, area = corners
    flat, n = surface.degenerate_faces, len(surface.vertices)
    if kind == "voronoi" and not len(flat) and (lib := library()):
        areas = np.zeros(n)
        lib.bih_voronoi_areas(len(area), surface.faces, cotangents, squares, area, areas)
        return areas
    share = _shares(kind, corners)
    if not len(flat):
        return np.bincount(surface.faces.T.ravel(), share.ravel(), n).astype(float, copy=False)
    share = share.copy()
    share[:, flat] *= surface.face_heights[flat] / FLAT_RATIO
    areas = np.bincount(surface.faces.T.ravel(), share.ravel(), n).astype(float, copy=False)
    # A vertex that has degenerate faces only may be a tip of much area.  Next to none is taken for none: what is
    # divided by such an area would be lost.  But a component needs some.
    proper, component = surface.in_proper_face, surface.component_of_vertex
    small = FLAT_RATIO * (np.median(areas[proper]) if proper.any() else surface.mean_edge_length**2 or 1.0)
    faint = (component >= 0) & ~proper & (areas < small)
    areas[faint] = 0
    bare = faint & (np.bincount(component + 1, areas)[component + 1] == 0)
    areas[bare] = small
    return areas


def _shares(kind: str, corners: Corners) -> FloatArray:
    """Return (3, m) the shares of the areas of faces that their corners get."""
    cotangents, squares, area = corners
    if kind == "barycentric":
        return np.broadcast_to(area / 3, (3, len(area)))
    # Of an acute triangle, corner k gets the part nearer to it than to the others.
    part = cotangents * squares
    share: FloatArray = (part.sum(axis=0) - part) / 8
    obtuse = np.flatnonzero(cotangents < 0)
    face = obtuse % len(area)
    share[:, face] = area[face] / 4
    np.put(share, obtuse, area[face] / 2)
    return share


def face_sides(surface: Surface, true: bool = False) -> list[FloatArray]:
    """Return three vectors along the sides of each face, (3, m) each, degenerate ones as in `DegenerateFaces.sides`.

    Those of a degenerate face lie in a plane of their own: what is made of them must not depend on where that is.
    """
    side = surface.sides()
    if len(surface.degenerate_faces):
        for all_faces, flat in zip(side, DegenerateFaces.of(surface).sides(true), strict=True):
            all_faces[:, surface.degenerate_faces] = flat
    return side


def _corners(surface: Surface) -> Corners:
    area, flat, m = surface.face_areas, surface.degenerate_faces, len(surface.faces)
    if lib := library():
        cotangents, squares = np.empty((2, 3, m))
        lib.bih_corners(m, *map(np.ascontiguousarray, (surface.vertices, surface.faces, area)), cotangents, squares)
    else:
        cotangents, squares = _cotangents(surface.sides(), area)
    if len(flat):
        side, area = DegenerateFaces.of(surface).sides(), area.copy()
        (ax, ay), (bx, by) = side[0][:2], side[1][:2]
        area[flat] = np.abs(ax * by - ay * bx) / 2
        cotangents[:, flat], squares[:, flat] = _cotangents(side, area[flat])
    return cotangents, squares, area


def _cotangents(side: list[FloatArray], area: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return (3, m) cotangents of corners and (3, m) squared lengths of the sides opposite to them."""
    products = [-_inner(side[(k + 1) % 3], side[(k + 2) % 3]) for k in range(3)]
    with np.errstate(divide="ignore", invalid="ignore"):  # of degenerate faces, which are overwritten
        return np.stack(products) / (2 * area), np.stack([_inner(s, s) for s in side])


def _inner(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return (m,) inner products of columns, (2, m) or (3, m)."""
    product: FloatArray = sum(x * y for x, y in zip(a, b, strict=True))
    return product
