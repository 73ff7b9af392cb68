"""How good a distance field is, in the paper's words as numbers: extrema elsewhere, isotropy, kinks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..number_arrays import real_numbers
from ..sources.source import Source
from ..surface import Surface
from .circles import CIRCLES, Circle, geodesic_circles, small_radius
from .kinks import Kink, kinks
from .other_extrema import OtherExtrema, other_extrema

ZERO = 1e-6
"""Of a field's maximum."""


def apparent_source(field: npt.ArrayLike) -> int | None:
    """The vertex that a field (n,) seems to be the distance from; None where there is none.

    It is the only one with less than 1e-6 of the maximum, while all others, where the field is finite, are positive.

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
    """A field's faults, as those of a distance.

    minima, maxima: (k,) vertices at extrema, the source left out, the most persistent first; minima_depth,
    maxima_height: (k,) their persistence over the field's range, which is a distance's maximum.
    circles: of growing radius around the source.  isotropy: the greatest over the least value on the circle whose
    radius is 4 % of the root of the area, but at least four mean edges, or the largest circle if that is smaller; NaN
    where there is none, as around a source of several places, and for what is no distance.
    kink: the largest jump of the gradient across an edge away from the source, over the gradient's mean length on both
    sides of it, or over its median length on the surface if that is more; no unit.  About 2 on a ridge where it turns
    round; that of a smooth field shrinks with the edges.  kink_edge: (2,) the ends of the edge, -1 where there is none
    away from the source.  kink_length: of all edges away from the source whose kink is at least 1, over the root of the
    surface's area: long where there is a ridge, next to nothing where a few edges are too long for the field.

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
    surface: MeshLike, field: npt.ArrayLike, geodesic: npt.ArrayLike, source: Source, share: float = 1e-3
) -> FieldQuality:
    """The quality of a distance field (n,) from a source; geodesic: (n,) geodesic distances from it.

    share: of the field's range, which extrema persist at least.  Raises VertexError or ParameterError for a bad source,
    ParameterError for fields of another shape or with nothing but one value.

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
    found = other_extrema(surface, f, source, share)
    small = small_radius(surface)
    every = geodesic_circles(surface, f, near, source, [small, *surface.mean_edge_length * np.array(CIRCLES)])
    rings = every[1:] if every and every[0].radius == small else every
    chosen = every[:1] if len(rings) < len(every) else rings[-1:]
    isotropy = chosen[0].ratio if chosen else float("nan")
    return _quality(source, found, tuple(rings), isotropy, kinks(surface, f, near))


def difference_quality(
    surface: MeshLike, field: npt.ArrayLike, near: npt.ArrayLike | None, source: Source | None, share: float = 1e-3
) -> FieldQuality:
    """The quality of a field (n,) that is no distance, such as the difference of two: extrema and kinks, no circles.

    source: where the distances start that the field is made of; near: (n,) geodesic distances from it.  Both are None
    for a field that starts nowhere: then no extremum is left out, and no edge but those along the boundary.  share: of
    the field's range, which extrema persist at least.  Raises VertexError or ParameterError for a bad source,
    ParameterError for fields of another shape or with nothing but one value.

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
    found = other_extrema(surface, f, source, share)
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
