"""How good a distance field is, in the paper's words as numbers: extrema elsewhere, isotropy, kinks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..sources.source import Source
from ..surface import Surface
from .circles import CIRCLES, Circle, geodesic_circles, small_radius
from .diagnostics import Kink, kinks
from .persistence import OtherExtrema, other_extrema

ZERO = 1e-6
"""A fraction of a field's maximum."""


def apparent_source(field: npt.ArrayLike) -> int | None:
    """Find the vertex that a field seems to be the distance from.

    Parameters
    ----------
    field : (n,) array_like
        Values at the vertices, which may be NaN.

    Returns
    -------
    int or None
        The only vertex with less than 1e-6 of the maximum, if all other finite values are positive; else None.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(12)
    >>> bihdist.apparent_source(field), bihdist.apparent_source(field + 1)
    (12, None)
    """
    f = real_numbers(field, "Values of a field")
    ids = np.flatnonzero(np.isfinite(f))
    if len(ids) < 2:
        return None
    first, second = ids[np.argpartition(f[ids], 1)[:2]]
    zero = ZERO * f[ids].max()
    return int(first) if abs(f[first]) <= zero < f[second] else None


@dataclass(frozen=True, eq=False)
class FieldQuality:
    """The shortcomings of a field as a distance: extrema away from its source, anisotropy, and kinks.

    Attributes
    ----------
    source : Source or None
        Where the field starts.
    minima : (k,) int64 ndarray
        Vertices at minima away from the source, the most persistent first.
    minima_depth : (k,) float64 ndarray
        Their persistence over the field's range, which is a distance's maximum.
    maxima : (q,) int64 ndarray
        Vertices at maxima away from the source, the most persistent first.
    maxima_height : (q,) float64 ndarray
        Their persistence over the field's range.
    circles : tuple of Circle
        Geodesic circles of growing radius around the source.
    isotropy : float
        The greatest over the least value on the circle whose radius is 4 % of the root of the area, but at least four
        mean edges, or on the largest circle if that is smaller. NaN where there is none: around a source of several
        places, and for a field that is no distance.
    kink : float
        The largest jump of the gradient across an edge away from the source, over the gradient's mean length on both
        sides, or over its median length on the surface if that is more. About 2 on a ridge, where the gradient turns
        round; that of a smooth field shrinks with the edges.
    kink_edge : (2,) int64 ndarray
        The ends of that edge; -1 where there is none away from the source.
    kink_length : float
        The length of all edges away from the source whose kink is at least 1, over the root of the area: long where
        there is a ridge, next to nothing where a few edges are too long for the field.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> geodesic = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> quality = bihdist.field_quality(sphere, field, geodesic, 0)
    >>> len(quality.minima)
    0
    >>> len(quality.maxima)
    1
    >>> round(quality.isotropy, 2)
    1.0
    >>> round(quality.kink, 1)
    0.2
    """

    source: Source | None
    minima: IntArray
    minima_depth: FloatArray
    maxima: IntArray
    maxima_height: FloatArray
    circles: tuple[Circle, ...]
    isotropy: float
    kink: float
    kink_edge: IntArray
    kink_length: float


def field_quality(
    surface: MeshLike, field: npt.ArrayLike, geodesic: npt.ArrayLike, source: Source, fraction: float = 1e-3
) -> FieldQuality:
    """Measure the quality of a distance field.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Distances from the source.
    geodesic : (n,) array_like
        Geodesic distances from the same source.
    source : Source
        Where the field starts.
    fraction : float
        The least persistence of extrema, as a fraction of the field's range.

    Returns
    -------
    FieldQuality
        Extrema elsewhere, isotropy and kinks.

    Raises
    ------
    VertexError
        If a source vertex is not on the surface.
    ParameterError
        For another bad source, and for fields of another shape or without a positive value.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> diffusion = bihdist.DiffusionDistance(sphere).from_source(0)
    >>> geodesic = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> # 1 is round
    >>> round(bihdist.field_quality(sphere, diffusion, geodesic, 0).isotropy, 2)
    1.0
    """
    surface = Surface.of(surface)
    f, near = surface.check_field(field), surface.check_field(geodesic)
    if not np.nanmax(f, initial=0.0) > 0:
        raise ParameterError("The quality of a distance needs a field with a positive value.")
    found = other_extrema(surface, f, source, fraction)
    small = small_radius(surface)
    every = geodesic_circles(surface, f, near, source, [small, *surface.mean_edge_length * np.array(CIRCLES)])
    rings = every[1:] if every and every[0].radius == small else every
    chosen = every[:1] if len(rings) < len(every) else rings[-1:]
    isotropy = chosen[0].ratio if chosen else float("nan")
    return _quality(source, found, tuple(rings), isotropy, kinks(surface, f, near))


def difference_quality(
    surface: MeshLike, field: npt.ArrayLike, near: npt.ArrayLike | None, source: Source | None, fraction: float = 1e-3
) -> FieldQuality:
    """Measure extrema and kinks of a field that is no distance, such as the difference of two.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Real numbers at the vertices.
    near : (n,) array_like or None
        Geodesic distances from the source; None for a field that starts nowhere, where only edges along the boundary
        are left out.
    source : Source or None
        Where the distances start that the field is made of; None for a field that starts nowhere, all extrema of which
        count.
    fraction : float
        The least persistence of extrema, as a fraction of the field's range.

    Returns
    -------
    FieldQuality
        Extrema and kinks; no circles, and NaN as isotropy.

    Raises
    ------
    VertexError
        If a source vertex is not on the surface.
    ParameterError
        For another bad source, and for fields of another shape or a constant one.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> biharmonic = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> geodesic = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> field = bihdist.difference(biharmonic, geodesic)
    >>> quality = bihdist.difference_quality(sphere, field, geodesic, 0)
    >>> quality.circles, round(quality.kink, 1)
    ((), 1.2)
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    found = other_extrema(surface, f, source, fraction)
    away = np.full(len(f), np.inf) if near is None else surface.check_field(near)
    return _quality(source, found, (), float("nan"), kinks(surface, f, away))


def _quality(
    source: Source | None, found: OtherExtrema, circles: tuple[Circle, ...], isotropy: float, folded: Kink
) -> FieldQuality:
    return FieldQuality(
        source=source,
        minima=found.minima,
        minima_depth=found.minima_depth,
        maxima=found.maxima,
        maxima_height=found.maxima_height,
        circles=circles,
        isotropy=isotropy,
        kink=folded.largest,
        kink_edge=folded.edge,
        kink_length=folded.length,
    )
