"""One field against another, a point for each vertex: how many lie where, and which lie inside a polygon."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..surface import Surface


@dataclass(frozen=True, eq=False)
class FieldScatter:
    """Two fields over the k vertices of faces at which both are finite.

    Attributes
    ----------
    ids : (k,) int64 ndarray
        These vertices, ascending.
    x, y : (k,) float64 ndarray
        The first and the second field there, in their units, or as fractions of each field's largest size.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
    >>> scatter = bihdist.field_scatter(plane, plane.points[:, 0], plane.points[:, 1])
    >>> len(scatter.ids), scatter.ends
    (25, ((-0.5, 0.5), (-0.5, 0.5)))
    >>> scatter.inside([(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]).tolist()
    [12]
    """

    ids: IntArray
    x: FloatArray
    y: FloatArray

    @property
    def ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and greatest value of x, and of y; 0 always lies between them.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> bihdist.field_scatter(plane, plane.points[:, 0], plane.points[:, 1] + 1).ends
        ((-0.5, 0.5), (0.0, 1.5))
        """
        across, up = ((min(float(v.min()), 0.0), max(float(v.max()), 0.0)) for v in (self.x, self.y))
        return across, up

    def density(self, columns: int, rows: int, across: tuple[float, float], up: tuple[float, float]) -> IntArray:
        """Count the points in each cell of a grid.

        Parameters
        ----------
        columns, rows : int
            How many cells across and up.
        across, up : tuple of float and float
            Where the grid begins and ends; points on its ends are in it, points beyond are not counted.

        Returns
        -------
        (rows, columns) int64 ndarray
            The counts; the first row is the lowest.

        Raises
        ------
        ParameterError
            For a grid without cells, or ends that are not in order.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=3, j_resolution=3)
        >>> scatter = bihdist.field_scatter(plane, plane.points[:, 0], plane.points[:, 0])
        >>> # equal fields lie on the diagonal
        >>> scatter.density(2, 2, (-0.5, 0.5), (-0.5, 0.5)).tolist()
        [[8, 0], [0, 8]]
        """
        if min(columns, rows) < 1 or not (across[0] < across[1] and up[0] < up[1]):
            raise ParameterError(
                f"A grid has cells, and ends that ascend, not {columns} by {rows} cells in {across}, {up}."
            )
        cell, _ = self.cells(columns, rows, across, up)
        return np.bincount(cell, minlength=columns * rows).reshape(rows, columns)

    def cells(
        self, columns: int, rows: int, across: tuple[float, float], up: tuple[float, float]
    ) -> tuple[IntArray, IntArray]:
        """Find the cell of a grid that each point is in.

        Parameters
        ----------
        columns, rows : int
            How many cells across and up.
        across, up : tuple of float and float
            Where the grid begins and ends.

        Returns
        -------
        cells : (p,) int64 ndarray
            The cells, numbered row by row from the lowest.
        points : (p,) int64 ndarray
            The points inside the grid, as places in `ids`.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=1, j_resolution=1)
        >>> scatter = bihdist.field_scatter(plane, plane.points[:, 0], plane.points[:, 1])
        >>> cells, points = scatter.cells(2, 2, (-0.5, 0.5), (-0.5, 0.5))
        >>> cells.tolist(), points.tolist()
        ([0, 1, 2, 3], [0, 1, 2, 3])
        """
        places = []
        for values, count, (low, high) in ((self.x, columns, across), (self.y, rows, up)):
            place = np.floor((values - low) * (count / (high - low)))
            places.append(np.where(values == high, count - 1, place))
        inside = np.flatnonzero((places[0] >= 0) & (places[0] < columns) & (places[1] >= 0) & (places[1] < rows))
        return (places[1][inside] * columns + places[0][inside]).astype(np.intp), inside

    def inside(self, polygon: npt.ArrayLike) -> IntArray:
        """Return the vertices whose points lie inside a closed polygon.

        Parameters
        ----------
        polygon : (m, 2) array_like
            At least three corners. A point is inside if the polygon goes round it an odd number of times.

        Returns
        -------
        (q,) int64 ndarray
            Vertex ids, ascending.

        Raises
        ------
        ParameterError
            For anything but three or more finite corners.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> scatter = bihdist.field_scatter(plane, plane.points[:, 0], plane.points[:, 1])
        >>> scatter.inside([(0.3, -1), (1, -1), (1, 1), (0.3, 1)]).tolist()  # x above 0.3
        [4, 9, 14, 19, 24]
        """
        corner = np.asarray(polygon, np.float64)
        if corner.ndim != 2 or corner.shape[1] != 2 or len(corner) < 3 or not np.isfinite(corner).all():
            raise ParameterError(f"A polygon has at least three corners (m, 2), not {corner.shape}.")
        order, y = self._upwards
        x = self.x[order]
        is_in = np.zeros(len(y), bool)
        for (x0, y0), (x1, y1) in zip(corner, np.roll(corner, -1, axis=0), strict=True):
            if y0 == y1:
                continue
            # Only points at the height of an edge can lie to the left of it.
            some = slice(*np.searchsorted(y, sorted((y0, y1))))
            is_in[some] ^= x[some] < x0 + (y[some] - y0) * ((x1 - x0) / (y1 - y0))
        return np.sort(self.ids[order[is_in]])

    def sort(self) -> None:
        """Sort the points now, so that the first call of `inside` need not.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=4, j_resolution=4)
        >>> scatter = bihdist.field_scatter(plane, plane.points[:, 0], plane.points[:, 1])
        >>> scatter.sort()
        >>> len(scatter.inside([(-1, -1), (1, -1), (1, 1), (-1, 1)]))
        25
        """
        _ = self._upwards

    @cached_property
    def _upwards(self) -> tuple[IntArray, FloatArray]:
        order = np.argsort(self.y, kind="stable")
        return order, self.y[order]


def field_scatter(surface: MeshLike, a: npt.ArrayLike, b: npt.ArrayLike, normalised: bool = False) -> FieldScatter:
    """Put one field against another, a point for each vertex.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    a, b : (n,) array_like
        The field across and the field up.
    normalised : bool
        Divide each field by its largest size first.

    Returns
    -------
    FieldScatter
        The points at vertices where both fields are finite.

    Raises
    ------
    ParameterError
        For fields of another shape or without common vertices, or if a field to be normalised is 0 throughout.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> one = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> other = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> scatter = bihdist.field_scatter(sphere, one, other, normalised=True)
    >>> scatter.x.max().item(), scatter.y.max().item(), len(scatter.ids)
    (1.0, 1.0, 642)
    """
    surface = Surface.of(surface)
    f, g = surface.check_field(a), surface.check_field(b)
    ids = np.flatnonzero(np.isfinite(f) & np.isfinite(g) & (surface.component_of_vertex >= 0))
    if not len(ids):
        raise ParameterError("To compare two fields, both need finite values at common vertices.")
    x, y = f[ids], g[ids]
    if normalised:
        sizes = np.abs(x).max(), np.abs(y).max()
        if not min(sizes) > 0:
            which = "first" if sizes[0] == 0 else "second"
            raise ParameterError(f"The {which} field is 0 throughout, so it has no fractions of its maximum.")
        x, y = x / sizes[0], y / sizes[1]
    return FieldScatter(ids, x, y)
