"""What the eigenpairs that a sum leaves out can add to it, known without them.

The sum of all phi_k(x)^2 / lambda_k^2 is C_xx, centred, that of all phi_k(x)^2 / lambda_k is G_xx, centred; both come
with the factor.  So what is left of them after some terms bounds every sum over the others.
"""

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import FloatArray
from ..laplacian import Component
from ..locked_cached_property import locked_cached_property
from ..solver.tall import over_rows, point_distances

LANDMARKS = 3
"""Along so many coordinates the two ends are looked at, to find how large fields are."""
TOLD_APART_BY = 15
"""Coordinates that are looked at to find how near points are; with more of them searching takes longer."""
TINY = 1e-300
"""Nothing is divided by less."""


def biharmonic_squares(component: Component) -> FloatArray:
    """(m,) sum_k phi_k(x)^2 / lambda_k^2 over all eigenpairs: C_xx, centred; unit length squared."""
    # The mean of the squared distances from a point is its own squared length plus the mean of those of all.
    squares = component.biharmonic_eccentricity**2
    means: FloatArray = squares - float(component.areas @ squares / component.areas.sum()) / 2
    return means


def commute_time_squares(component: Component) -> FloatArray:
    """(m,) sum_k phi_k(x)^2 / lambda_k over all eigenpairs: G_xx, centred; no unit."""
    areas = component.areas
    u, total = component.solve(areas), areas.sum()
    diagonal: FloatArray = component.green_diagonal() - 2 * u / total + float(areas @ u) / total**2
    return diagonal


def tail_lengths(squares: FloatArray, vectors: FloatArray, factors: FloatArray | float = 1.0) -> FloatArray:
    """(m,) the lengths of what coordinates vectors * factors (m, k) leave out where all have squared lengths (m,)."""
    known = over_rows(lambda rows: ((vectors[rows] * factors) ** 2).sum(axis=1), len(vectors))
    # What rounding leaves of a difference counts as a tail.
    tails: FloatArray = np.sqrt(np.maximum(squares - np.concatenate(known), 0))
    return tails


class Cloud:
    """Points (m, k) that stand for a component's vertices, and what is known of all pairs of them without trying each.

    maxima: (m,) what the largest distance from each is at least: no less than the root of the mean square by area, nor
    than the distance from any of some points far apart.  nearest: (m,) what the distance from any other is at least.
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
        """(m,) a lower bound on the distance of each point from the nearest other one, by its first coordinates."""
        # Distances near 1, as squares of small ones would be 0.
        scale = float(np.abs(self._first).max())
        if not 0 < scale < np.inf:
            return np.zeros(len(self._first))
        nearest: FloatArray = cKDTree(self._first / scale).query(self._first / scale, k=2)[0][:, 1] * scale
        return nearest

    def worst(self, left_out: FloatArray, errors: FloatArray | float = 0.0) -> float:
        """The largest share of a field's maximum by which any distance of two points may be off.

        left_out (m,): at most the length of the coordinates that each point lacks; errors (m,): by how much each may be
        displaced.
        """
        displaced = errors + np.max(errors)
        lacking = left_out + left_out.max()
        if lacking.any():
            nearest = np.maximum(self.nearest - displaced, 0)
            lacking = missing(lacking, nearest)
        return float(((lacking + displaced) / self.maxima).max())


def missing(lengths: FloatArray, distances: FloatArray) -> FloatArray:
    """(m,) sqrt(d^2 + l^2) - d: by how much distances d are too small where coordinates of lengths l are left out."""
    # It falls as d grows.
    return lengths / np.maximum(np.hypot(distances, lengths) + distances, TINY) * lengths
