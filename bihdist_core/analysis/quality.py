"""How good a distance field is, in the paper's words as numbers: extrema away from the source, isotropy near it, kinks,
the triangle inequality."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..number_arrays import real_numbers
from ..progress import Progress, part
from ..scalars import whole_number
from ..sources.pieces import pieces_of
from ..sources.source import Source
from ..surface import Surface
from .diagnostics import GradientJumps, TriangleSample, gradient_jumps, triangle_violations
from .isoline_tracing import isolines
from .persistence import extrema

TRIANGLE_POINTS, TRIANGLE_STEP = 40, 8
"""Points of a sample of triangles, and how many at a time become part of it."""

ZERO = 1e-6
"""Of a field's maximum."""

CIRCLES = tuple(range(3, 13))
"""Radii of geodesic circles, in mean edge lengths, unless others are given; fewer edges measure the triangulation."""


def small_radius(surface: Surface) -> float:
    """The radius at which isotropy is measured: 4 % of the root of the area, but at least four mean edges."""
    return max(0.04 * float(np.sqrt(surface.face_areas.sum())), 4 * surface.mean_edge_length)


@dataclass(frozen=True, eq=False)
class Circle:
    """A distance field along the geodesic circle of a radius around its source: what a polar chart shows.

    Of each of the circle's curves (one, where the radius is small and no boundary is near), in order along it: angles
    (k,) in the tangent plane of the source, from -pi to pi, and values (k,).  A closed curve comes back to its first.
    Where it is folded as seen from above, as on a finger's tip, the angles are shares of its length instead.
    ratio: the greatest over the least value, 1 where the field is isotropic; infinite if it is 0 somewhere.

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
    """A field (n,) along geodesic circles around its source; geodesic: (n,) geodesic distances from it.

    source: a vertex or a place in a face; around others there are no circles.  radii: (q,) in the mesh's unit, in
    order; by default 3 to 12 mean edge lengths.  Those that no vertex is as far as are left out.  Raises
    VertexError or ParameterError for a bad source, ParameterError for bad radii or fields.

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
    """Angles (k,) along a curve through points (k, 3), or, if it is closed and does not go straight round, shares of
    its length that fit them best."""
    turned = np.unwrap(angles)
    steps = np.diff(turned)
    is_once = abs(abs(turned[-1] - turned[0]) - 2 * np.pi) < 1e-6
    if not closed or (is_once and ((steps >= 0).all() or (steps <= 0).all())):
        return angles
    length = np.append(0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
    shares = 2 * np.pi * length / length[-1]
    ways = [np.exp(1j * (angles - way * shares))[:-1].mean() for way in (1, -1)]
    way, fit = max(zip((1, -1), ways, strict=True), key=lambda each: abs(each[1]))
    fitted: FloatArray = np.angle(np.exp(1j * (way * shares + np.angle(fit))))
    return fitted


def _tangent_plane(surface: Surface, source: Source) -> tuple[FloatArray, FloatArray] | None:
    """The place (3,) of a source, and (2, 3) two directions at right angles in the plane across the mean normal of the
    faces there, by area; None if it is no single place.

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


def inner_jumps(
    surface: Surface, field: npt.ArrayLike, near: npt.ArrayLike, radius: float | None = None
) -> GradientJumps:
    """The jumps of a field's gradient across edges where `near` (n,), a distance, exceeds a radius at both ends, the
    small one by default.

    Every distance has a kink at its source, and at corners of the boundary the gradient of smooth fields is singular:
    so also a band along the boundary is left out.
    """
    # Not at the top: it would double what `import bihdist_core.analysis.quality` takes.
    from scipy.spatial import cKDTree

    jumps = gradient_jumps(surface, field)
    radius = small_radius(surface) if radius is None else radius
    away = np.asarray(near) > radius
    rim = np.unique(surface.boundary_edges)
    if len(rim):
        away &= cKDTree(surface.vertices[rim]).query(surface.vertices)[0] > radius
    inner = away[jumps.edges].all(axis=1) & np.isfinite(jumps.jumps)
    return GradientJumps(jumps.edges[inner], jumps.jumps[inner], jumps.lengths[inner], jumps.slope)


@dataclass(frozen=True, eq=False)
class Kink:
    """The kinks of a field away from its source: see `FieldQuality`."""

    largest: float
    edge: IntArray
    length: float


def kinks(surface: Surface, field: npt.ArrayLike, near: npt.ArrayLike, radius: float | None = None) -> Kink:
    """How sharp a field (n,) is folded where `near` (n,), a distance from its source, exceeds a radius, the small one
    by default."""
    jumps = inner_jumps(surface, field, near, radius)
    # Around smooth extrema the gradient is short, and any jump long beside it.
    folds = jumps.jumps / np.maximum(jumps.lengths, jumps.slope) if jumps.slope > 0 else 0 * jumps.jumps
    ends = surface.vertices[jumps.edges]
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    length = float(lengths[folds >= 1].sum() / np.sqrt(surface.face_areas.sum()))
    if not len(folds):
        return Kink(0.0, np.array([-1, -1]), length)
    worst = int(folds.argmax())
    return Kink(float(folds[worst]), jumps.edges[worst], length)


@dataclass(frozen=True, eq=False)
class OtherExtrema:
    """The extrema of a field away from its source, the most persistent first.

    minima, maxima: (k,) vertices.  minima_depth, maxima_height: (k,) their persistence over the field's range; no unit.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> found = bihdist.other_extrema(sphere, field, 0)
    >>> found.minima.tolist(), found.maxima.tolist(), found.maxima_height.tolist()
    ([], [2], [1.0])
    """

    minima: IntArray
    minima_depth: FloatArray
    maxima: IntArray
    maxima_height: FloatArray

    @property
    def vertices(self) -> IntArray:
        """(k,) vertices of all minima, then of all maxima.

        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> field = bihdist.BiharmonicDistance(sphere).from_source(0)
        >>> bihdist.other_extrema(sphere, field, 0).vertices.tolist()
        [2]
        """
        return np.concatenate([self.minima, self.maxima])


def other_extrema(surface: MeshLike, field: npt.ArrayLike, source: Source | None, share: float = 1e-3) -> OtherExtrema:
    """The extrema of a field (n,) away from its source that persist over at least `share` of its range.

    source: None for a field that starts nowhere, all extrema of which count.  Raises VertexError or ParameterError for
    a bad source, ParameterError for a field of another shape or with nothing but one value.

    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> # a height, with a bump at the side
    >>> field = sphere.points[:, 2] + 0.3 * (sphere.points[:, 0] > 0.9)
    >>> found = bihdist.other_extrema(sphere, field, None)
    >>> len(found.minima), len(found.maxima)
    (1, 2)
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    touched = np.empty(0, np.int64) if source is None else pieces_of(source, surface).touched
    found = extrema(surface, f, share)
    finite = f[np.isfinite(f)]
    if not len(finite) or not np.ptp(finite) > 0:
        raise ParameterError("The quality of a field needs values that differ.")
    span = float(np.ptp(finite))
    low, high = (~np.isin(ids, touched) for ids in (found.minima, found.maxima))
    return OtherExtrema(
        found.minima[low],
        found.minima_persistence[low] / span,
        found.maxima[high],
        found.maxima_persistence[high] / span,
    )


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


def triangle_sample(
    distance: Distance,
    points: int = TRIANGLE_POINTS,
    component: int = 0,
    count: int = 100_000,
    seed: int = 0,
    progress: Progress | None = None,
) -> TriangleSample:
    """Random triples of random vertices of a component against the triangle inequality: how many of `count` break it by
    more than rounding, and by how much of the largest distance at most.

    The distance is asked for all pairs of `points` vertices, or all there are.  Raises ParameterError for a component
    that does not exist or has fewer than three vertices, and for fewer points than three.

    >>> import bihdist, pyvista
    >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
    >>> sample = bihdist.triangle_sample(distance, points=20, count=1000)
    >>> sample.triples, sample.violations, sample.tightest > 0
    (1000, 0, True)
    """
    *_, (_, last) = triangle_samples(distance, points, component, count, seed, progress)
    return last


def triangle_samples(
    distance: Distance,
    points: int = TRIANGLE_POINTS,
    component: int = 0,
    count: int = 100_000,
    seed: int = 0,
    progress: Progress | None = None,
) -> Iterator[tuple[int, TriangleSample]]:
    """For ever more vertices, 8 at a time up to `points`: how many, and what `triangle_sample` finds among them.

    For distances that take a second for each point: early results can be shown.  When the first is asked for, raises
    ParameterError for a component that does not exist or has fewer than three vertices, and for fewer points than
    three.

    >>> import bihdist, pyvista
    >>> distance = bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3))
    >>> for points, sample in bihdist.triangle_samples(distance, points=20, count=1000):
    ...     print(points, sample.violations)
    8 0
    16 0
    20 0
    """
    ids = (
        np.flatnonzero(distance.surface.component_of_vertex == component)
        if whole_number(component, "A component") >= 0
        else np.empty(0, np.int64)
    )
    if min(whole_number(points, "The number of points"), len(ids)) < 3:
        raise ParameterError(
            f"Triangles need three points; {points:,} were asked for, and component {component} has {len(ids):,} "
            "vertices."
        )
    some = np.random.default_rng(seed).choice(ids, min(points, len(ids)), replace=False)
    among = np.zeros((len(some), len(some)))
    # No step of one or two points.
    ends = [*range(TRIANGLE_STEP, len(some) - 2, TRIANGLE_STEP), len(some)]
    for start, stop in zip([0, *ends], ends, strict=False):
        rows, columns = np.tril_indices(stop, -1)
        new = rows >= start
        rows, columns = rows[new], columns[new]
        step = part(progress, start / len(some), stop / len(some))
        pairs = np.stack([some[rows], some[columns]], 1)
        among[rows, columns] = among[columns, rows] = distance.of_pairs(pairs, step)
        yield stop, triangle_violations(among[:stop, :stop], count, seed)
