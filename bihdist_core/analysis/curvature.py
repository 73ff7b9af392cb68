"""Mean curvature at the vertices of a surface, from its Laplacian."""

import numpy as np

from ..arrays import FloatArray
from ..laplacian import Laplacian
from ..surface import vertex_normals


def mean_curvature(laplacian: Laplacian) -> FloatArray:
    """Compute the mean curvature at the vertices, positive where the surface is convex.

    Parameters
    ----------
    laplacian : Laplacian
        That of the surface, whose outside is the side that sees its faces counter-clockwise, or the other one where the
        volume they enclose is negative.

    Returns
    -------
    (n,) float64 ndarray
        In 1 over the mesh's unit: 1/r on a sphere of radius r. NaN where a vertex has no area.

    Notes
    -----
    Δx = -2 H n, with Δ = A^-1 L as in Eq. 7: H is half the part of A^-1 L x along the normal, which at a boundary
    leaves out what points to the side.
    """
    surface, area = laplacian.surface, laplacian.areas
    x, normals = surface.vertices - surface.vertices.mean(axis=0), vertex_normals(surface)
    a, b, c = (x[surface.faces[:, k]] for k in range(3))
    inward = float(np.einsum("ij,ij->", a, np.cross(b, c))) < 0
    along = np.einsum("ij,ij->i", laplacian.stiffness @ x, normals)
    curvature: FloatArray = np.divide(along, 2 * area, out=np.full(len(x), np.nan), where=area > 0)
    return -curvature if inward else curvature
