"""The tips of a shape, where functions without needless extrema have some nevertheless."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..analysis.persistence import extrema
from ..arrays import BoolArray, IntArray
from ..laplacian import Laplacian, as_laplacian
from ..mesh_like import MeshLike
from ..surface import Surface

PROMINENT = 0.05
"""A tip is a maximum of the eccentricity that persists over this fraction of its range."""
NEAR = 0.1
"""An extremum is at a tip if it is within this fraction of the root of the surface's area of it, in a straight line."""


def tips(laplacian: Laplacian | MeshLike, fraction: float = PROMINENT) -> IntArray:
    """Find the vertices at the tips of a shape: the ends of its limbs.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface.
    fraction : float
        The least persistence, as a fraction of the range.

    Returns
    -------
    (t,) int64 ndarray
        Vertices, the most prominent first on each component.

    Notes
    -----
    They are the persistent maxima of the mean squared biharmonic distance to all points. A function with few extrema
    has one at each tip that has none of these, too: along a limb it must go up or down.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> long = pyvista.Icosphere(nsub=3).scale((3, 1, 1))
    >>> sorted(long.points[bihdist.tips(long)].round(2).tolist())
    [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]]
    """
    found = []
    for component in as_laplacian(laplacian).components:
        if len(component.vertices) > 1:
            ends = extrema(component.surface, component.biharmonic_eccentricity, fraction).maxima
            found.append(component.vertices[ends])
    return np.concatenate(found) if found else np.zeros(0, int)


def at_tips(surface: MeshLike, vertices: npt.ArrayLike, ends: npt.ArrayLike) -> BoolArray:
    """Tell which vertices are at one of the tips of a shape.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    vertices : (k,) array_like
        Vertices in question.
    ends : (t,) array_like
        Vertices at the tips, as of `tips`.

    Returns
    -------
    (k,) bool ndarray
        True where a tip is within a tenth of the root of the surface's area, in a straight line.

    Raises
    ------
    VertexError
        If a vertex is not on the surface.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> long = pyvista.Icosphere(nsub=3).scale((3, 1, 1))
    >>> ends = bihdist.tips(long)
    >>> bihdist.at_tips(long, [ends[0], 0], ends).tolist()
    [True, False]
    """
    surface = Surface.of(surface)
    x = surface.vertices
    ids, tip_ids = surface.check_vertices(vertices), surface.check_vertices(ends)
    away = np.linalg.norm(x[ids][:, None] - x[tip_ids], axis=2)
    is_near: BoolArray = away.min(axis=1, initial=np.inf) <= NEAR * float(np.sqrt(surface.face_areas.sum()))
    return is_near
