"""A field known at a few hundred points of a surface, and what two interpolants make of it everywhere else.

Both give back the samples.  The smoothest one favours smooth fields, and above all biharmonic distance, whose Green's
function is its own; the piecewise linear one favours nothing, so that both stand side by side.
"""

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, unit_columns
from ..distances.edge_geodesic import EdgeGeodesic
from ..errors import ParameterError
from ..laplacian import Component
from ..surface import Surface

BLOCK = 64


class Smoothest:
    """The function with given values at some points and the least bending energy, sum_i (L f)_i^2 / A_i.

    The points are local vertices (m,) of one component; ParameterError for none, and for one given twice.

    This is biharmonic interpolation over the mesh; L is the stiffness matrix, A the vertex areas. The function is a
    constant and a sum of columns C_p of the Green's function at the points p, with weights of sum 0: L A^-1 L C_p is
    the unit mass at p less a term that is the same for all p.
    """

    def __init__(self, component: Component, points: IntArray) -> None:
        points, m = np.asarray(points, int), len(points)
        if not m or len(np.unique(points)) < m:
            raise ParameterError(f"An interpolant needs at least one point, and no point twice, not {points.tolist()}.")
        green = np.empty((len(component.vertices), m))
        for start in range(0, m, BLOCK):
            some = points[start : start + BLOCK]
            b = unit_columns(len(green), some)
            half = component.centred(component.solve(b))
            green[:, start : start + BLOCK] = component.solve(component.areas[:, None] * half)
        system = np.ones((m + 1, m + 1))
        system[:m, :m] = (green[points] + green[points].T) / 2
        system[m, m] = 0
        self._green, self._system = green, system

    def __call__(self, values: FloatArray) -> FloatArray:
        """Return (n,) or (n, k) everywhere on the component, from values (m,) or (m, k) at the points."""
        values = np.asarray(values, float)
        known = np.concatenate([values, np.zeros((1, *values.shape[1:]))])
        weights = np.linalg.solve(self._system, known)
        field: FloatArray = self._green @ weights[:-1] + weights[-1]
        return field


class PiecewiseLinear:
    """An interpolant that is linear on the flat triangles between points whose Voronoi cells meet three at a time.

    The points are vertices (m,); cells are by distance along edges. A vertex takes its value at the nearest place of
    the triangles of its own cell, so never from a part of the surface that is near in space only. Where two cells meet
    and no third one does, as round a thin limb, there is a straight line instead. A vertex that no point can be reached
    from has no value.
    """

    def __init__(self, surface: Surface, points: IntArray) -> None:
        self.points = np.asarray(points, int)
        lengths = EdgeGeodesic(surface).distances(self.points)
        self.cell = np.where(np.isfinite(lengths).any(axis=1), lengths.argmin(axis=1), -1)
        pieces = _meeting(self.cell, surface, len(self.points))
        x = surface.vertices
        vertex, piece = _pairs(self.cell, pieces, len(self.points))
        weights, away = nearest_in_triangles(x[vertex], x[self.points[pieces[piece]]])
        # For each vertex the nearest of its pieces.
        order = np.lexsort((away, vertex))
        first = order[np.append(True, np.diff(vertex[order]) > 0)] if len(order) else order
        self.corners, self.weights = np.zeros((len(x), 3), int), np.full((len(x), 3), np.nan)
        self.corners[vertex[first]], self.weights[vertex[first]] = pieces[piece[first]], weights[first]

    def __call__(self, values: FloatArray) -> FloatArray:
        """Return (n,) or (n, k) everywhere, from values (m,) or (m, k) at the points; NaN out of reach of them."""
        field: FloatArray = np.einsum("ic,ic...->i...", self.weights, np.asarray(values, float)[self.corners])
        return field


def _meeting(cell: IntArray, surface: Surface, count: int) -> IntArray:
    """Return (t, 3) the cells that meet: three in a face, or, repeated, two along an edge or one alone."""
    corners = np.sort(cell[surface.faces], axis=1)
    triangles = np.unique(corners[(np.diff(corners, axis=1) > 0).all(axis=1) & (corners[:, 0] >= 0)], axis=0)
    lines = np.sort(cell[surface.edges], axis=1)
    lines = np.unique(lines[(lines[:, 0] < lines[:, 1]) & (lines[:, 0] >= 0)], axis=0)
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [0, 2]], triangles[:, [1, 2]]])
    lines = lines[~np.isin(lines @ [count, 1], sides @ [count, 1])]
    alone = np.setdiff1d(cell[cell >= 0], np.concatenate([triangles.ravel(), lines.ravel()]))
    return np.concatenate([triangles, lines[:, [0, 1, 1]], np.repeat(alone[:, None], 3, axis=1)])


def _pairs(cell: IntArray, pieces: IntArray, count: int) -> tuple[IntArray, IntArray]:
    """Return (k,) vertices and (k,) pieces of their cells, each pair once."""
    owner, number = pieces.ravel(), np.repeat(np.arange(len(pieces)), 3)
    owner, number = np.unique(np.stack([owner, number]), axis=1)
    start = np.searchsorted(owner, np.arange(count + 1))
    vertex = np.flatnonzero(cell >= 0)
    size = np.diff(start)[cell[vertex]]
    which = np.repeat(vertex, size)
    place = np.arange(size.sum()) - np.repeat(np.cumsum(size) - size, size)
    return which, number[start[cell[which]] + place]


def nearest_in_triangles(points: FloatArray, triangles: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return (k, 3) barycentric weights of the place of each triangle (k, 3, 3) nearest to each point (k, 3).

    (k,) how far. Triangles may be lines or points.
    """
    k = np.arange(len(points))
    best, away = np.zeros((len(points), 3)), np.full(len(points), np.inf)

    def offer(weights: FloatArray, allowed: BoolArray) -> None:
        off = np.linalg.norm(np.einsum("kc,kcx->kx", weights, triangles) - points, axis=1)
        nearer = allowed & (off < away)
        best[nearer], away[nearer] = weights[nearer], off[nearer]

    a = triangles[:, 0]
    u, v, p = triangles[:, 1] - a, triangles[:, 2] - a, points - a
    uu, uv, vv, pu, pv = (np.einsum("kx,kx->k", *pair) for pair in ((u, u), (u, v), (v, v), (p, u), (p, v)))
    area = uu * vv - uv**2
    with np.errstate(divide="ignore", invalid="ignore"):
        second, third = (vv * pu - uv * pv) / area, (uu * pv - uv * pu) / area
    # Above the triangle, and not so thin that the weights are rounding.
    inside = (area > 1e-12 * uu * vv) & (second >= 0) & (third >= 0) & (second + third <= 1)
    offer(np.nan_to_num(np.stack([1 - second - third, second, third], 1), posinf=0, neginf=0), inside)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        side = triangles[:, j] - triangles[:, i]
        length = np.einsum("kx,kx->k", side, side)
        along = np.einsum("kx,kx->k", points - triangles[:, i], side) / np.maximum(length, 1e-300)
        weights = np.zeros((len(points), 3))
        weights[k, j] = np.clip(along, 0, 1)
        weights[k, i] = 1 - weights[k, j]
        offer(weights, np.ones(len(points), bool))
    return best, away
