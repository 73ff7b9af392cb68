"""Diagnostics of distances: isotropy, kinks, change, and the axioms of a metric, as numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..distances.distance import Distance
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..progress import Progress, blocks, silent
from ..scalars import real_number, whole_number
from ..surface import Surface, with_faces
from .circles import small_radius
from .isoline_tracing import isolines


def isotropy_ratio(surface: MeshLike, field: npt.ArrayLike, geodesic: npt.ArrayLike, radius: float) -> float:
    """Measure how round a distance field is on the geodesic circle of one radius around its source.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Distances from the source.
    geodesic : (n,) array_like
        Geodesic distances from the same source.
    radius : float
        In the unit of `geodesic`. A circle of few edges measures the triangulation: take three or four edges at least.

    Returns
    -------
    float
        The greatest over the least value where the circle crosses the mesh's edges, at least 1; infinite if the field
        is 0 there.

    Raises
    ------
    ParameterError
        If no vertex is as far as the radius, or for fields of another shape.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=16, j_resolution=16)
    >>> field = bihdist.BiharmonicDistance(plane).from_source(144)
    >>> geodesic = bihdist.GeodesicDistance(plane).from_source(144)
    >>> for radius in (0.25, 0.45):  # the second comes near the boundary
    ...     print(f"{bihdist.isotropy_ratio(plane, field, geodesic, radius):.2f}")
    1.04
    1.17
    """
    surface = Surface.of(surface)
    f = surface.check_field(field)
    circle = isolines(surface, geodesic, real_number(radius, "A radius"))
    if not circle:
        raise ParameterError(f"There is no geodesic circle of radius {radius:g} around the source.")
    values = np.concatenate([line.along(f) for line in circle])
    return float(values.max() / values.min()) if values.min() > 0 else float("inf")


@dataclass(frozen=True, eq=False)
class GradientJumps:
    """Jumps of the gradient of a field, linear on each face, across the inner edges.

    Attributes
    ----------
    edges : (k, 2) int64 ndarray
        Vertices of the edges.
    jumps : (k,) float64 ndarray
        The jumps, at least 0, in the field's unit per length.
    lengths : (k,) float64 ndarray
        Mean length of the gradient on both sides, in the same unit.
    slope : float
        Median length of the gradient over the surface, by area.

    Examples
    --------
    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> # a ridge along x = 0
    >>> jumps = bihdist.gradient_jumps(plane, np.abs(plane.points[:, 0]))
    >>> jumps.jumps.max().round(6).item()
    2.0
    >>> jumps.relative.max().round(6).item()
    2.0
    >>> int((jumps.jumps > 1).sum())
    8
    """

    edges: IntArray
    jumps: FloatArray
    lengths: FloatArray
    slope: float

    @property
    def relative(self) -> FloatArray:
        """Jumps over the gradient's length there, (k,) without a unit.

        Where the gradient is shorter than a quarter of its median, that quarter is taken instead. The jumps of a smooth
        field shrink with the edges, away from corners of the boundary; across a ridge the gradient turns round, and
        they stay near 2.

        Examples
        --------
        >>> import bihdist, numpy as np, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> x = plane.points[:, 0]
        >>> for field in (np.abs(x), x, (x + 2) ** 2):
        ...     print(bihdist.gradient_jumps(plane, field).relative.max().round(2))
        2.0
        0.0
        0.08
        """
        return self.jumps / np.maximum(self.lengths, self.slope / 4)


def gradient_jumps(surface: MeshLike, field: npt.ArrayLike) -> GradientJumps:
    """Measure how far the gradient of a field jumps across each edge of two faces.

    Parameters
    ----------
    surface : MeshLike
        The mesh. Degenerate faces, and edges of one face or of more than two, are left out.
    field : (n,) array_like
        Real numbers at the vertices, linear on each face.

    Returns
    -------
    GradientJumps
        The jumps, NaN next to values that are not finite.

    Notes
    -----
    The gradient of a continuous field can jump only across an edge: by the sum of the slopes, each away from the inside
    of its face.

    Examples
    --------
    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> field = 5 * np.abs(plane.points[:, 0])  # the slope turns from -5 to 5
    >>> bihdist.gradient_jumps(plane, field).jumps.max().round(6).item()
    10.0
    """
    surface = with_faces(surface, "jumps of gradients")
    f, faces, x = surface.check_field(field), surface.faces, surface.vertices
    proper = np.ones(len(faces), bool)
    proper[surface.degenerate_faces] = False
    faces, area = faces[proper], surface.face_areas[proper]
    sides, slopes, lengths = [], [], np.zeros(len(faces))
    for k in range(3):
        a, b, c = (faces[:, (k + s) % 3] for s in range(3))
        side, arm = x[b] - x[a], x[c] - x[a]
        length_square = np.einsum("ij,ij->i", side, side)
        foot = f[a] + np.einsum("ij,ij->i", arm, side) / length_square * (f[b] - f[a])
        outward = (foot - f[c]) * np.sqrt(length_square) / (2 * area)
        sides.append(np.sort(np.stack([a, b], 1), axis=1))
        slopes.append(outward)
        if k == 0:
            lengths = np.sqrt(outward**2 + (f[b] - f[a]) ** 2 / length_square)
    side, slope, length = np.concatenate(sides), np.concatenate(slopes), np.tile(lengths, 3)
    order = np.lexsort((side[:, 1], side[:, 0]))
    side, slope, length = side[order], slope[order], length[order]
    first = np.flatnonzero(np.append(True, (side[1:] != side[:-1]).any(axis=1)))
    pairs = first[np.diff(np.append(first, len(side))) == 2]
    jumps = np.abs(slope[pairs] + slope[pairs + 1])
    return GradientJumps(side[pairs], jumps, (length[pairs] + length[pairs + 1]) / 2, _median(lengths, area))


def _median(values: FloatArray, weights: FloatArray) -> float:
    order = np.argsort(np.where(np.isfinite(values), values, np.inf))
    weights = np.where(np.isfinite(values), weights, 0.0)[order]
    middle = np.searchsorted(np.cumsum(weights), weights.sum() / 2)
    return float(values[order[min(middle, len(order) - 1)]])


@dataclass(frozen=True)
class FieldChange:
    """The absolute change of a field, without a unit.

    Attributes
    ----------
    mean, largest : float
        Mean and largest change, over max d.
    normalised_mean, normalised_largest : float
        Mean and largest change after each field was divided by its own maximum.

    Examples
    --------
    >>> import bihdist
    >>> change = bihdist.field_change([0, 1, 2], [0, 1.5, 3])
    >>> # over the first maximum; and each over its own
    >>> change.largest, change.normalised_largest
    (0.5, 0.0)
    """

    mean: float
    largest: float
    normalised_mean: float
    normalised_largest: float


def field_change(before: npt.ArrayLike, after: npt.ArrayLike) -> FieldChange:
    """Measure how much a field changed, at the points where both states are finite.

    Parameters
    ----------
    before, after : (k,) array_like
        The field at the same points.

    Returns
    -------
    FieldChange
        Mean and largest change; the maxima are over the common points.

    Raises
    ------
    ParameterError
        For fields of different shape, without common points, or whose maximum is not positive.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = bihdist.Surface.of(pyvista.Icosphere(nsub=3))
    >>> before = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> after = bihdist.BiharmonicDistance(bihdist.noisy(sphere, 0.2)).from_source(0)
    >>> round(bihdist.field_change(before, after).mean, 3)
    0.028
    """
    d, e = (real_numbers(each, "Values of a field") for each in (before, after))
    if d.shape != e.shape:
        raise ParameterError(f"Fields of shape {d.shape} and {e.shape} cannot be compared.")
    both = np.isfinite(d) & np.isfinite(e)
    if not both.any() or not (d[both].max() > 0 and e[both].max() > 0):
        raise ParameterError("To compare two fields, both need finite values at common points and a positive maximum.")
    d, e = d[both], e[both]
    raw = np.abs(e - d) / d.max()
    normalised = np.abs(e / e.max() - d / d.max())
    return FieldChange(*(float(v) for v in (raw.mean(), raw.max(), normalised.mean(), normalised.max())))


TRIPLES = 1 << 20
"""Triples that are looked at together, which bounds the memory."""


@dataclass(frozen=True)
class TriangleSample:
    """Random triples of points held against the triangle inequality, d(i, k) <= d(i, j) + d(j, k).

    Attributes
    ----------
    triples : int
        How many were looked at.
    violations : int
        How many break it by more than rounding, 1e-9 of the largest distance.
    worst : float
        The most by which one breaks it, over the largest distance; 0 if none does.
    tightest : float
        The least d(i, j) + d(j, k) - d(i, k) over d(i, j) + d(j, k), for three different points: how close one comes.

    Examples
    --------
    >>> import bihdist
    >>> distances = [[0, 1, 5], [1, 0, 2], [5, 2, 0]]
    >>> sample = bihdist.triangle_violations(distances, count=100)
    >>> sample.violations > 0, sample.worst  # 5 is more than 1 + 2, by 2 of 5
    (True, 0.4)
    """

    triples: int
    violations: int
    worst: float
    tightest: float


def triangle_violations(distances: npt.ArrayLike, count: int = 1_000_000, seed: int = 0) -> TriangleSample:
    """Hold random triples of points against the triangle inequality.

    Parameters
    ----------
    distances : (k, k) array_like
        Distances among k points.
    count : int
        How many triples.
    seed : int
        Seed of the random numbers.

    Returns
    -------
    TriangleSample
        How many triples break it, and by how much.

    Raises
    ------
    ParameterError
        For fewer than three points, an array that is not square, or a count below 1.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> d = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3)).pairwise(range(20))
    >>> bihdist.triangle_violations(d).violations
    0
    >>> bihdist.triangle_violations(d**2).violations > 0
    True
    """
    d = real_numbers(distances, "Distances")
    if d.ndim != 2 or d.shape[0] != d.shape[1] or len(d) < 3:
        raise ParameterError(f"Distances among at least 3 points are a square array, not one of shape {d.shape}.")
    if whole_number(count, "count") < 1:
        raise ParameterError(f"count is {count}; at least one triple is needed.")
    rng, largest = np.random.default_rng(seed), np.nanmax(d)
    violations, least, tightest = 0, np.inf, np.inf
    for start in range(0, count, TRIPLES):
        around, slack = _detours(d, min(TRIPLES, count - start), rng)
        violations += int((slack < -1e-9 * largest).sum())
        least = np.minimum(least, slack.min())
        ratio = np.divide(slack, around, out=np.full(len(slack), np.inf), where=around > 0)
        tightest = np.minimum(tightest, ratio.min())
    return TriangleSample(count, violations, float(max(0.0, -least) / largest), float(tightest))


def _detours(d: FloatArray, count: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Return (count,) d(i, j) + d(j, k), and by how much it is longer than d(i, k), of random triples."""
    k = len(d)
    i = rng.integers(k, size=count)
    # Offsets that are different and not 0 give three different points.
    step = rng.integers(1, k, size=count)
    other = rng.integers(1, k - 1, size=count)
    j, m = (i + step) % k, (i + other + (other >= step)) % k
    around = d[i, j] + d[j, m]
    return around, around - d[i, m]


def smallest_distance(distance: Distance, progress: Progress | None = None, block: int = 256) -> tuple[float, int, int]:
    """Find the least distance between two different vertices of one component.

    Parameters
    ----------
    distance : Distance
        The distance; it is computed between all pairs.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    block : int
        From how many vertices fields are held at a time.

    Returns
    -------
    tuple of float, int and int
        The distance and the two vertices.

    Raises
    ------
    ParameterError
        If no two vertices are connected by a distance.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> bihdist.smallest_distance(distance)
    (0.125, 1, 0)
    """
    ids = np.flatnonzero(distance.surface.component_of_vertex >= 0)
    best: tuple[float, int, int] = (np.inf, -1, -1)
    for report, start, chosen in blocks(progress, ids, block):
        fields = distance.from_sources(chosen, report)
        fields[chosen, np.arange(len(chosen))] = np.nan
        least = np.fmin.reduce(fields, axis=0)
        k = int(np.nanargmin(least))
        if least[k] < best[0]:
            best = (float(least[k]), int(np.nanargmin(fields[:, k])), int(chosen[k]))
        (progress or silent)((start + len(chosen)) / len(ids), "all pairs")
    if best[1] < 0:
        raise ParameterError(f"{distance.surface.name} has no two points with a distance.")
    return best


# ---------------------------------------------------------------------- kinks
def inner_jumps(
    surface: Surface, field: npt.ArrayLike, near: npt.ArrayLike, radius: float | None = None
) -> GradientJumps:
    """Return the jumps of a field's gradient across edges where `near` (n,), a distance, exceeds a radius at both ends.

    By default it is the small radius (`small_radius`). Every distance has a kink at its source, and at corners of the
    boundary the gradient of smooth fields is singular: so also a band along the boundary is left out.
    """
    # Not at the top: it would double what `import bihdist_core.analysis.diagnostics` takes.
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
    """Return the sharpest fold of a field (n,) where `near` (n,), a distance from its source, exceeds a radius.

    By default it is the small radius (`small_radius`).
    """
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
