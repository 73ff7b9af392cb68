"""Distance fields along geodesic circles around their source: how round they are there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, real_numbers
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..sources.pieces import pieces_of
from ..sources.source import Source
from ..surface import Surface
from .isoline_tracing import isolines

CIRCLES = tuple(range(3, 13))
"""Radii of geodesic circles, in mean edge lengths, unless others are given; fewer edges measure the triangulation."""


def small_radius(surface: Surface) -> float:
    """Return the radius at which isotropy is measured: 4 % of the root of the area, but at least four mean edges."""
    return max(0.04 * float(np.sqrt(surface.face_areas.sum())), 4 * surface.mean_edge_length)


@dataclass(frozen=True, eq=False)
class Circle:
    """A distance field along the geodesic circle of one radius around its source.

    Attributes
    ----------
    radius : float
        Radius in the mesh's unit.
    angles : tuple of (k,) float64 ndarray
        For each curve of the circle, the angles of its points in the tangent plane of the source, from -pi to pi. There
        is one curve where the radius is small and no boundary is near; a closed one ends with its first point. Where a
        curve is folded when seen from above, as on the tip of a finger, the angles are fractions of its length instead.
    values : tuple of (k,) float64 ndarray
        The field at these points.
    ratio : float
        The greatest over the least value; 1 where the field is isotropic, infinite if it is 0 somewhere.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> geodesic = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> circle, = bihdist.geodesic_circles(sphere, field, geodesic, 0, radii=[0.6])
    >>> # one curve, and nearly one value on it
    >>> len(circle.values), round(circle.ratio, 2)
    (1, 1.0)
    """

    radius: float
    angles: tuple[FloatArray, ...]
    values: tuple[FloatArray, ...]
    ratio: float


def geodesic_circles(
    surface: MeshLike, field: npt.ArrayLike, geodesic: npt.ArrayLike, source: Source, radii: npt.ArrayLike | None = None
) -> list[Circle]:
    """Read a field along geodesic circles around its source.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        The field.
    geodesic : (n,) array_like
        Geodesic distances from the source.
    source : Source
        A vertex or a place in a face; around other sources there are no circles.
    radii : (q,) array_like, optional
        In the mesh's unit; 3 to 12 mean edge lengths by default. Radii that no vertex is as far as are left out.

    Returns
    -------
    list of Circle
        In the order of the radii.

    Raises
    ------
    VertexError
        If a source vertex is not on the surface.
    ParameterError
        For another bad source, for radii that are not positive, or for fields of another shape.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> geodesic = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> circles = bihdist.geodesic_circles(sphere, field, geodesic, 0, radii=[0.6, 1.2, 2.4])
    >>> [(circle.radius, round(circle.ratio, 2)) for circle in circles]
    [(0.6, 1.0), (1.2, 1.0), (2.4, 1.0)]
    """
    surface = Surface.of(surface)
    f, usual = surface.check_field(field), surface.mean_edge_length * np.array(CIRCLES)
    r = usual if radii is None else np.atleast_1d(real_numbers(radii, "Radii of circles"))
    if r.ndim != 1 or not (np.isfinite(r) & (r > 0)).all():
        raise ParameterError(f"Radii of circles are positive numbers, not {radii!r}.")
    around = _tangent_plane(surface, source)
    if around is None:
        return []
    centre, axes = around
    lines = isolines(surface, geodesic, np.unique(r))
    found = []
    for radius in r.tolist():
        angles, values = [], []
        for line in (each for each in lines if each.value == radius):
            order = np.arange(len(line.points) + line.closed) % len(line.points)
            across, along = axes @ (line.points[order] - centre).T
            angles.append(_around(np.arctan2(along, across), line.points[order], line.closed))
            values.append(line.along(f)[order])
        if values:
            every = np.concatenate(values)
            least, greatest = float(every.min()), float(every.max())
            found.append(Circle(radius, tuple(angles), tuple(values), greatest / least if least > 0 else float("inf")))
    return found


def _around(angles: FloatArray, points: FloatArray, closed: bool) -> FloatArray:
    """Return angles (k,) along a curve through points (k, 3).

    If the curve is closed and does not go straight round, they are the fractions of its length that fit the angles
    best.
    """
    turned = np.unwrap(angles)
    steps = np.diff(turned)
    is_once = abs(abs(turned[-1] - turned[0]) - 2 * np.pi) < 1e-6
    if not closed or (is_once and ((steps >= 0).all() or (steps <= 0).all())):
        return angles
    length = np.append(0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    fractions = 2 * np.pi * length / length[-1]
    ways = [np.exp(1j * (angles - way * fractions))[:-1].mean() for way in (1, -1)]
    way, fit = max(zip((1, -1), ways, strict=True), key=lambda each: abs(each[1]))
    fitted: FloatArray = np.angle(np.exp(1j * (way * fractions + np.angle(fit))))
    return fitted


def _tangent_plane(surface: Surface, source: Source) -> tuple[FloatArray, FloatArray] | None:
    """Return the place (3,) of a source, and (2, 3) two directions at right angles in the plane across the mean normal
    of the faces there, by area; None if it is no single place.

    The first direction is as near as can be to the coordinate axis that the plane is least inclined to.
    """
    pieces = pieces_of(source, surface)
    if len(pieces) != 1 or pieces.along.any():
        return None
    # A vertex is in all its faces, and a place in an edge in both.
    touched = np.unique(pieces.touched)
    near = np.isin(surface.faces, touched).sum(axis=1) == len(touched)
    a, b, c = (surface.vertices[surface.faces[near, k]] for k in range(3))
    normal = np.cross(b - a, c - a).sum(axis=0)
    size = np.linalg.norm(normal)
    normal = normal / size if size > 0 else np.array([0.0, 0, 1])
    axis = np.eye(3)[np.abs(normal).argmin()]
    first = axis - (axis @ normal) * normal
    first /= np.linalg.norm(first)
    return pieces.positions(surface.vertices)[0][0], np.stack([first, np.cross(normal, first)])
