"""The discrete Laplace-Beltrami operator (paper, Eq. 7): Delta = A^-1 L.

L is the stiffness matrix: the cotangent Laplacian with weight (cot alpha + cot beta) / 2 on each edge, positive
semi-definite, zero row sums; no unit.  A is the diagonal of vertex areas; unit length squared.  The paper's Eq. 7
leaves the 1/2 out, which scales every biharmonic distance by 1/2 and changes nothing else; with it the discrete
distance converges to the continuous one.  At a boundary the same formula gives Neumann conditions (section 3.2).

A face of no area has no cotangents.  Its three edge lengths are made longer by a millionth of the longest, which
makes it a proper, thin triangle; the other faces stay exactly as they are.
"""

import numpy as np
import scipy.sparse as sp

from .errors import ParameterError
from .surface import Surface, dots

AREAS = ("voronoi", "barycentric")
THICKEN = 1e-6


def stiffness(surface: Surface) -> sp.csr_matrix:
    """(n, n) cotangent stiffness matrix; the rows of unreferenced vertices are empty."""
    n, f = len(surface.vertices), surface.faces
    cotangents, _, _ = _corners(surface)
    i, j = (np.concatenate([f[:, (k + s) % 3] for k in range(3)]) for s in (1, 2))
    half = sp.coo_matrix((cotangents.ravel() / 2, (i, j)), shape=(n, n)).tocsr()
    weights = half + half.T
    return (sp.diags_array(np.asarray(weights.sum(axis=1)).ravel()) - weights).tocsr()


def vertex_areas(surface: Surface, kind: str = "voronoi") -> np.ndarray:
    """(n,) areas, unit length squared, that sum to the surface's area; 0 for unreferenced vertices.

    "voronoi": mixed Voronoi areas (Meyer et al. 2002), as the paper's text; "barycentric": a third of each face's
    area to each of its vertices, as its authors' program.  Raises ParameterError for any other word.
    """
    if kind not in AREAS:
        raise ParameterError(f"There are no {kind!r} vertex areas; choose one of {', '.join(AREAS)}.")
    cotangents, squares, area = _corners(surface)
    if kind == "barycentric":
        share = np.broadcast_to(area / 3, (3, len(area)))
    else:
        # Of an acute triangle, corner k gets the part nearer to it than to the others.
        part = cotangents * squares
        share = (part.sum(axis=0) - part) / 8
        obtuse = cotangents < 0
        share = np.where(obtuse.any(axis=0), np.where(obtuse, area / 2, area / 4), share)
    return np.bincount(surface.faces.T.ravel(), share.ravel(), len(surface.vertices))


def _corners(surface: Surface) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(3, m) cotangent of each corner, (3, m) squared length of the side opposite to it, (m,) face areas."""
    side = surface.sides()
    squares = np.stack([dots(s, s) for s in side])
    products = np.stack([-dots(side[(k + 1) % 3], side[(k + 2) % 3]) for k in range(3)])
    area = surface.face_areas.copy()
    flat = surface.flat_faces
    if len(flat):
        lengths = np.sqrt(squares[:, flat])
        longest = lengths.max(axis=0)
        lengths += THICKEN * np.where(longest > 0, longest, surface.mean_edge_length)
        a, b, c = np.sort(lengths, axis=0)[::-1]
        # Kahan's form of Heron's formula keeps its digits on thin triangles.
        area[flat] = np.sqrt((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))) / 4
        squares[:, flat] = lengths**2
        products[:, flat] = squares[:, flat].sum(axis=0) / 2 - squares[:, flat]
    return products / (2 * area), squares, area
