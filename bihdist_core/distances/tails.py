"""Bounds on what the eigenpairs that a sum leaves out can add to it, known without them.

The sum of all phi_k(x)^2 / lambda_k^2 is C_xx, centred, that of all phi_k(x)^2 / lambda_k is G_xx, centred; both come
with the factor.  So what is left of them after some terms bounds every sum over the others.
"""

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import FloatArray, IntArray
from ..laplacian import Component
from ..memo import locked_cached_property
from ..solver.tall import over_rows, point_distances
from ..sources.pieces import Pieces

LANDMARKS = 3
"""Along so many coordinates the two ends are looked at, to find how large fields are."""
TOLD_APART_BY = 15
"""Coordinates that are looked at to find how near points are; with more of them searching takes longer."""
PIECES = 256
"""Pieces of a source at a time, which bounds the memory."""
TINY = 1e-300
"""Nothing is divided by less."""


def biharmonic_squares(component: Component) -> FloatArray:
    """Return (m,) sum_k phi_k(x)^2 / lambda_k^2 over all eigenpairs: C_xx, centred; unit length squared."""
    # The mean of the squared distances from a point is its own squared length plus the mean of those of all.
    squares = component.biharmonic_eccentricity**2
    means: FloatArray = squares - float(component.areas @ squares / component.areas.sum()) / 2
    return means


def tail_lengths(squares: FloatArray, vectors: FloatArray, factors: FloatArray | float = 1.0) -> FloatArray:
    """Return (m,) the lengths of what coordinates vectors * factors (m, k) leave out where all have squared lengths
    (m,)."""
    known = over_rows(lambda rows: ((vectors[rows] * factors) ** 2).sum(axis=1), len(vectors))
    # What rounding leaves of a difference counts as a tail.
    tails: FloatArray = np.sqrt(np.maximum(squares - np.concatenate(known), 0))
    return tails


class Cloud:
    """Points (m, k) that stand for a component's vertices, and what is known of all pairs of them without trying each.

    Attributes
    ----------
    maxima : (m,) ndarray
        Lower bounds on the largest distance from each point: no less than the root of the mean square by area, nor than
        the distance from any of some points far apart.
    nearest : (m,) ndarray
        Lower bounds on the distance of each point from any other.
    """

    def __init__(self, component: Component, points: FloatArray) -> None:
        squares = np.concatenate(over_rows(lambda rows: (points[rows] ** 2).sum(axis=1), len(points)))
        mean = float(component.areas @ squares / component.areas.sum())
        first = points[:, :LANDMARKS]
        far = np.unique([first.argmin(axis=0), first.argmax(axis=0)])
        self.maxima = np.maximum(np.sqrt(squares + mean), point_distances(points, points[far]).max(axis=1))
        self._first = points[:, :TOLD_APART_BY]

    @locked_cached_property
    def nearest(self) -> FloatArray:
        """Lower bounds (m,) on the distance of each point from the nearest other one, by its first coordinates."""
        # Distances near 1, as squares of small ones would be 0.
        scale = float(np.abs(self._first).max())
        if not 0 < scale < np.inf:
            return np.zeros(len(self._first))
        nearest: FloatArray = cKDTree(self._first / scale).query(self._first / scale, k=2)[0][:, 1] * scale
        return nearest

    def worst(self, left_out: FloatArray, errors: FloatArray | float = 0.0) -> float:
        """Return the largest share of a field's maximum by which any distance of two points may be off.

        `left_out` (m,) bounds the lengths of the coordinates that each point lacks, `errors` (m,) by how much each may
        be displaced.
        """
        displaced = errors + np.max(errors)
        lacking = left_out + left_out.max()
        if lacking.any():
            nearest = np.maximum(self.nearest - displaced, 0)
            lacking = missing(lacking, nearest)
        return float(((lacking + displaced) / self.maxima).max())


def missing(lengths: FloatArray, distances: FloatArray) -> FloatArray:
    """Return (m,) sqrt(d^2 + l^2) - d: by how much distances d are too small where coordinates of lengths l are left
    out."""
    # It falls as d grows.
    return lengths / np.maximum(np.hypot(distances, lengths) + distances, TINY) * lengths


def bound_from_pieces(
    points: FloatArray, field: FloatArray, local: IntArray, pieces: Pieces, left_out: FloatArray, errors: FloatArray
) -> FloatArray:
    """Bound how far distances from places in faces, curves and sets of these may be off.

    Parameters
    ----------
    points : (m, k) ndarray
        The points x_i that stand for a component's vertices.
    field : (m,) ndarray
        The distances from the nearest of the pieces.
    local : (p, 3) ndarray
        The corners of each piece, as rows of `points`.
    pieces : Pieces
        Where the distances start.
    left_out : (m,) ndarray
        At most the lengths of the coordinates o_i that each point lacks.
    errors : (m,) ndarray
        At most the lengths by which each point is displaced.

    Returns
    -------
    (m,) ndarray
        In the unit of the distances.

    Notes
    -----
    All functions being linear in a face, the place p with the weights b has the coordinates sum b_i x_i and lacks
    sum b_i o_i.  Seen from a vertex y it lacks sum b_i (o_i - o_y), which is no longer than

        l = sum_{i != y} b_i (s_i + s_y)

    with the lengths s in `left_out`, and it is displaced by no more than the same sum of `errors`, e.  So d(p, y) is
    between d - e and sqrt(d^2 + l^2) + e, where what l adds is greatest for the least d there can be, d - e.

    The distance from the nearest place q is no larger than that from the place p that is nearest by what is computed,
    and d(q, y) - e is no smaller than d(p, y) - e; hence the bound for p, with the largest s and e that places have,
    is one for all pieces.  At a corner y of a piece, where d is small, so is l: there each place of the piece bounds
    d(y) from above, and that which is nearest to y is taken.
    """
    ends = np.stack([pieces.start, pieces.stop])
    lengths, displaced = (each + float((ends * each[local]).sum(axis=2).max()) for each in (left_out, errors))
    added = missing(lengths, np.maximum(field - displaced, 0))
    for first in range(0, len(local), PIECES):
        some = slice(first, first + PIECES)
        at, start, stop = local[some], pieces.start[some], pieces.stop[some]
        corners = points[at]
        way = np.einsum("pc,pck->pk", stop - start, corners)
        for c in range(3):
            y = at[:, c]
            there = np.einsum("pc,pck->pk", start, corners) - corners[:, c]
            along = np.einsum("pk,pk->p", there, way) / np.maximum(np.einsum("pk,pk->p", way, way), TINY)
            weights = start + np.clip(-along, 0, 1)[:, None] * (stop - start)
            apart = np.linalg.norm(np.einsum("pc,pck->pk", weights, corners) - corners[:, c], axis=1)
            weights[:, c] = 0
            length = (weights * (left_out[at] + left_out[y][:, None])).sum(axis=1)
            more = apart - field[y] + missing(length, np.maximum(apart - displaced[y], 0))
            np.minimum.at(added, y, np.maximum(more, 0))
    bound: FloatArray = added + displaced
    return bound


def bound_of_pairs(
    corners: IntArray, weights: FloatArray, distances: FloatArray, left_out: FloatArray, errors: FloatArray
) -> FloatArray:
    """Bound how far distances (k,) of pairs of places may be off.

    `corners` (k, 6) are those of both places, `weights` (k, 6) those of the one place, and of the other with a minus
    sign. As in `bound_from_pieces`, with l and e the sums of |w_i| s_i and |w_i| e_i over corners, weights of one
    corner added up.
    """
    same = corners[:, :, None] == corners[:, None]
    of_corner = np.abs(np.einsum("kij,kj->ki", same, weights)) / same.sum(axis=2)
    lengths, displaced = ((of_corner * each[corners]).sum(axis=1) for each in (left_out, errors))
    bound: FloatArray = missing(lengths, np.maximum(distances - displaced, 0)) + displaced
    return bound
