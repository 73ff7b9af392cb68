"""The boundary of a surface in loops, in the order they are numbered in."""

import numpy as np

from ..arrays import IntArray
from ..surface import Surface, connected

DIGITS = 9
"""Lengths that agree to so many digits are equal: rounding decides nothing."""


def boundary_loops(surface: Surface) -> list[IntArray]:
    """Return the edges of each connected piece of the boundary, as indices (k,) into rows of `Surface.boundary_edges`.

    The longest first; those of equal length by their least vertex.
    """
    edges = surface.boundary_edges
    if not len(edges):
        return []
    ends, local = np.unique(edges, return_inverse=True)
    piece = connected(local.reshape(-1, 2).T, len(ends))[local.reshape(-1, 2)[:, 0]]
    lengths = np.linalg.norm(surface.vertices[edges[:, 0]] - surface.vertices[edges[:, 1]], axis=1)
    total = np.bincount(piece, lengths)
    # Pieces are numbered by their least vertices, which a stable order keeps among equals.
    unit = 10.0 ** (np.floor(np.log10(max(total.max(), 1e-300))) - DIGITS)
    order = np.argsort(-np.round(total / unit), kind="stable")
    return [np.flatnonzero(piece == number) for number in order]
