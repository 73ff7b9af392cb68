"""A map between two surfaces as the field's papers draw it: in colours, equal where one vertex is mapped to another.

A map gives each vertex of A one of B.  B is coloured by position, and each vertex of A has the colour of the vertex
that it is mapped to (as in functional maps, Ovsjanikov and others 2012, and what followed).  That needs no inverse,
which such a map does not have: a colouring of A carried over to B would leave out the vertices of B that nothing is
mapped to, and would have to choose where several are mapped to one.  Where the map is smooth A is as smooth as B, tears
and folds of it show as such, and two parts of A in the same colours are mapped to one of B.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray
from ..errors import ParameterError
from ..surface import Surface
from .correspondence import NOWHERE

DARKEST, LIGHTEST = 0.08, 0.95
"""Of each of red, green and blue: neither black nor white, which marks and lines have."""


def position_colours(surface: Surface) -> FloatArray:
    """(n, 3) red, green and blue, from x, y and z, each from the least to the largest of the surface's vertices.

    A flat surface has the middle of the colour that tells nothing.
    """
    used = surface.component_of_vertex >= 0
    x = surface.vertices[used] if used.any() else surface.vertices
    low, span = x.min(axis=0), np.ptp(x, axis=0)
    is_flat = span <= 1e-9 * max(float(span.max()), np.finfo(float).tiny)
    shares = (surface.vertices - low) / np.where(is_flat, 1.0, span)
    shares[:, is_flat] = 0.5
    colours: FloatArray = DARKEST + (LIGHTEST - DARKEST) * np.clip(shares, 0, 1)
    return colours


def carried_back(colours: npt.ArrayLike, found: npt.ArrayLike) -> FloatArray:
    """(n, 3) the colours of the vertices that a map (n,) leads to, from colours (m, 3) there; NaN where that is none.

    Raises ParameterError for a map to vertices that have no colours.
    """
    there, ids = np.asarray(colours, np.float64), np.asarray(found)
    if ids.ndim != 1 or ids.dtype.kind not in "iu":
        raise ParameterError(f"A map is one whole number for each vertex, not {ids.dtype} of the shape {ids.shape}.")
    wrong = np.flatnonzero((ids < NOWHERE) | (ids >= len(there)))
    if len(wrong):
        raise ParameterError(f"Vertex {wrong[0]} is mapped to {ids[wrong[0]]}, and there are {len(there):,} vertices.")
    return np.where((ids == NOWHERE)[:, None], np.nan, there[ids])
