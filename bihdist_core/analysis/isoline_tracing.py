"""Isolines of a field on a surface, as ordered polylines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import BoolArray, FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..number_arrays import real_numbers
from ..surface import Surface
from .chains import chains


@dataclass(frozen=True, eq=False)
class Isoline:
    """One curve on which a field has one value.

    points: (k, 3), in order along the curve; a closed curve does not repeat its first point at the end.
    edges: (k, 2) vertices a, b of the mesh edge each point lies on; parameters: (k,) t of x = (1 - t) x_a + t x_b.
    With these any other field or projection can be followed along the curve (`along`).

    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=16, j_resolution=16)
    >>> circle, = bihdist.isolines(plane, np.hypot(*plane.points[:, :2].T), [0.4])
    >>> circle.closed, round(circle.length, 2)  # 2 pi 0.4 = 2.51
    (True, 2.51)
    """

    value: float
    points: FloatArray
    edges: IntArray
    parameters: FloatArray
    closed: bool

    def along(self, field: npt.ArrayLike) -> FloatArray:
        """(k,) or (k, d): values (n,) or (n, d) at the vertices, interpolated at the points of this curve.

        >>> import bihdist, numpy as np, pyvista
        >>> plane = pyvista.Plane(i_resolution=16, j_resolution=16)
        >>> line, = bihdist.isolines(plane, plane.points[:, 0], [0.1])
        >>> heights = line.along(plane.points[:, 1])
        >>> line.closed, heights.min().item(), heights.max().item()
        (False, -0.5, 0.5)
        """
        at = np.asarray(field)
        t = self.parameters.reshape(-1, *(1,) * (at.ndim - 1))
        values: FloatArray = (1 - t) * at[self.edges[:, 0]] + t * at[self.edges[:, 1]]
        return values

    @property
    def length(self) -> float:
        """Length of the curve, unit length.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> lines = bihdist.isolines(plane, plane.points[:, 0], [0.1, 0.2])
        >>> [round(line.length, 6) for line in lines]
        [1.0, 1.0]
        """
        points = np.concatenate([self.points, self.points[:1]]) if self.closed else self.points
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def isolines(surface: MeshLike, field: npt.ArrayLike, values: npt.ArrayLike) -> list[Isoline]:
    """The curves where a field, linear on each face, has the given values; in the order of `values`.

    field: (n,) real numbers.  Faces with a corner that is not finite are left out, and curves end there, as at
    boundaries and at edges of more than two faces.  A vertex whose value is exactly an isoline's counts as greater:
    a curve then passes through the vertex, and a plateau of that value is surrounded, not filled.  Curves that shrink
    to a point are left out.

    Raises ParameterError for a field that is not (n,) numbers, or values that are not finite.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> lines = bihdist.isolines(sphere, field, [0.1, 0.3, 0.5])
    >>> [(line.value, line.closed, round(line.length, 2)) for line in lines]
    [(0.1, True, 1.21), (0.3, True, 4.91), (0.5, True, 3.62)]
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    levels = np.atleast_1d(real_numbers(values, "The values of isolines"))
    if levels.ndim != 1 or not np.isfinite(levels).all():
        raise ParameterError("The values of isolines are finite numbers.")
    faces = surface.faces[np.isfinite(f[surface.faces]).all(axis=1)]
    corner = f[faces]
    low, high = corner.min(axis=1), corner.max(axis=1)
    found: list[Isoline] = []
    for level in levels:
        crossed = np.flatnonzero((low < level) & (high >= level))
        if len(crossed):
            found += _joined(surface, f, float(level), *_segments(faces[crossed], corner[crossed] >= level))
    return found


def _segments(faces: IntArray, above: BoolArray) -> tuple[IntArray, IntArray]:
    """(e, 2) crossed edges, the vertex below the level first, and (m, 2) the two that each crossed face joins."""
    # One corner is on the other side than the two others; the curve cuts the two edges that meet there.
    lone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
    rows = np.arange(len(faces))
    tip, left, right = (faces[rows, (lone + k) % 3] for k in range(3))
    up = above[rows, lone]
    ends = np.concatenate([np.where(up, (left, tip), (tip, left)).T, np.where(up, (right, tip), (tip, right)).T])
    size = int(faces.max()) + 1
    key, index = np.unique(ends[:, 0] * size + ends[:, 1], return_inverse=True)
    return np.stack([key // size, key % size], 1), index.reshape(2, -1).T


def _joined(surface: Surface, f: FloatArray, level: float, edges: IntArray, segments: IntArray) -> list[Isoline]:
    below, top = f[edges[:, 0]], f[edges[:, 1]]
    # Halved first, so that the difference of two huge values of opposite sign is finite.
    t = np.clip((level / 2 - below / 2) / (top / 2 - below / 2), 0, 1)
    x = surface.vertices
    points = (1 - t)[:, None] * x[edges[:, 0]] + t[:, None] * x[edges[:, 1]]
    lines = []
    for chosen, closed in chains(segments):
        here = points[chosen]
        # A curve through a vertex meets several of its edges there, all in the same point.
        new = np.ones(len(chosen), bool)
        new[1:] = (here[1:] != here[:-1]).any(axis=1)
        if closed and (here[0] == here[-1]).all():
            new[0] = False
        if new.sum() >= 2:
            chosen = chosen[new]
            lines.append(Isoline(level, points[chosen], edges[chosen], t[chosen], closed and len(chosen) > 2))
    return lines
