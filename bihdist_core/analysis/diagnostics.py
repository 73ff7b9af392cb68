"""What is said of distances in words, as numbers: isotropy, kinks, change, and the axioms of a metric."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..number_arrays import real_numbers
from ..progress import Progress, part, silent
from ..scalars import real_number, whole_number
from ..surface import Surface
from .isoline_tracing import isolines


def isotropy_ratio(surface: MeshLike, field: npt.ArrayLike, geodesic: npt.ArrayLike, radius: float) -> float:
    """Greatest over least value of a distance field on the geodesic circle of a radius around its source; 1 is best.

    field, geodesic: (n,) distances from the same source, the latter geodesic (of which `radius` is a value).  Both are
    interpolated where the circle crosses the mesh's edges.  A circle of few edges measures the triangulation: take
    a radius of at least three or four.  Infinite if the field is 0 on the circle.  Raises ParameterError if no vertex
    is as far as that.

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
    """Jumps of the gradient of a field, linear on each face, across the inner edges; unit of the field per length.

    edges: (k, 2) vertex ids.  jumps: (k,), at least 0.  lengths: (k,) mean length of the gradient on both sides.
    slope: median length of the gradient over the surface, by area.

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
        """(k,) jumps over the gradient's length there, or over a quarter of its median if that is more; no unit.

        A smooth field's shrink with the edges, away from boundary corners; across a ridge the gradient turns round,
        and they stay near 2.

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
    """How far the gradient jumps across each edge of two faces; NaN next to values that are not finite.

    A continuous field's gradient can only jump across an edge, by the sum of the two slopes away from the faces'
    insides.  Degenerate faces and edges of another number of faces are left out.

    >>> import bihdist, numpy as np, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> field = 5 * np.abs(plane.points[:, 0])  # the slope turns from -5 to 5
    >>> bihdist.gradient_jumps(plane, field).jumps.max().round(6).item()
    10.0
    """
    surface = Surface.of(surface)
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
    """The change |d' - d| of a field, mean and largest; no unit.

    mean, largest: over max d.  normalised_mean, normalised_largest: with each field divided by its own maximum first.

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
    """How much a field (k,) changed, at points where both are finite; the maxima are over these points.

    Raises ParameterError for fields of different shape, without common points, or whose maximum is not positive.

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
    """Random triples of points held against d(i, k) <= d(i, j) + d(j, k).

    violations: triples that break it by more than rounding (1e-9 of the largest distance).  worst: the most by which
    one breaks it, over the largest distance; 0 if none does.  tightest: the least d(i, j) + d(j, k) - d(i, k) over
    that sum, for three different points: how close some triple comes.

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
    """Hold `count` random triples among k points, whose distances are (k, k), against the triangle inequality.

    Raises ParameterError for fewer than three points, an array that is not square, or a count below 1.

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
    """(count,) d(i, j) + d(j, k), and by how much it is longer than d(i, k), of random triples."""
    k = len(d)
    i = rng.integers(k, size=count)
    # Offsets that are different and not 0 give three different points.
    step = rng.integers(1, k, size=count)
    other = rng.integers(1, k - 1, size=count)
    j, m = (i + step) % k, (i + other + (other >= step)) % k
    around = d[i, j] + d[j, m]
    return around, around - d[i, m]


def smallest_distance(distance: Distance, progress: Progress | None = None, block: int = 256) -> tuple[float, int, int]:
    """The least distance of two different vertices of one component, and the two: over all pairs, n / block blocks.

    Raises ParameterError on a surface where no two vertices are connected by a distance.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> bihdist.smallest_distance(distance)
    (0.125, 1, 0)
    """
    ids = np.flatnonzero(distance.surface.component_of_vertex >= 0)
    best: tuple[float, int, int] = (np.inf, -1, -1)
    for start in range(0, len(ids), block):
        chosen = ids[start : start + block]
        fields = distance.from_sources(chosen, part(progress, start / len(ids), (start + len(chosen)) / len(ids)))
        fields[chosen, np.arange(len(chosen))] = np.nan
        least = np.fmin.reduce(fields, axis=0)
        k = int(np.nanargmin(least))
        if least[k] < best[0]:
            best = (float(least[k]), int(np.nanargmin(fields[:, k])), int(chosen[k]))
        (progress or silent)((start + len(chosen)) / len(ids), "all pairs")
    if best[1] < 0:
        raise ParameterError(f"{distance.surface.name} has no two points with a distance.")
    return best
