"""Fields in numbers: means, quantiles and histograms by area, extremes and where, and how two fields go together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..point_cloud import PointCloud
from ..surface import Surface, with_faces
from ..tetrahedra import TetrahedralMesh
from .field_scatter import field_scatter
from .linear_field import LinearField


@dataclass(frozen=True, eq=False)
class FieldStatistics:
    """Statistics of a field over the area of its surface, in the field's unit.

    All but the extremes are over the faces on which the field is finite. They are exact for a field that is linear on
    each face.

    Attributes
    ----------
    count : int
        How many vertices have a value.
    mean : float
        Mean by area.
    mean_size : float
        Mean absolute value by area; of a difference, the mean deviation.
    deviation : float
        Standard deviation by area.
    least : float
        Least value at a vertex.
    least_at : int
        The vertex of it; of several, the smallest id.
    greatest : float
        Greatest value at a vertex.
    greatest_at : int
        The vertex of it.
    largest : float
        Largest absolute value at a vertex.
    largest_at : int
        The vertex of it.
    fractions, quantiles : (q,) float64 ndarray
        The field is at most ``quantiles[i]`` on ``fractions[i]`` of the area.
    bins : (b + 1,) float64 ndarray
        Ends of the bins of the histogram, ascending.
    areas : (b,) float64 ndarray
        The area of each bin, in the mesh's unit squared.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> statistics = bihdist.field_statistics(plane, plane.points[:, 0])
    >>> # deviation: the root of 1/12
    >>> round(statistics.deviation, 4), statistics.greatest, statistics.greatest_at
    (0.2887, 0.5, 8)
    """

    count: int
    mean: float
    mean_size: float
    deviation: float
    least: float
    least_at: int
    greatest: float
    greatest_at: int
    largest: float
    largest_at: int
    fractions: FloatArray
    quantiles: FloatArray
    bins: FloatArray
    areas: FloatArray


def corner_areas(surface: Surface) -> FloatArray:
    """Return (n,) a third of the area of each vertex's faces: the weights that integrate a linear field exactly."""
    thirds = np.repeat(surface.face_areas / 3, 3)
    return np.bincount(surface.faces.ravel(), thirds, minlength=len(surface.vertices)).astype(float, copy=False)


def field_statistics(
    surface: MeshLike,
    field: npt.ArrayLike,
    bins: int | npt.ArrayLike = 50,
    fractions: Sequence[float] = (0.05, 0.25, 0.5, 0.75, 0.95),
) -> FieldStatistics:
    """Compute the statistics of a field, such as a distance or the difference of two.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    field : (n,) array_like
        Real numbers at the vertices.
    bins : int or (b + 1,) array_like
        How many bins of equal width the histogram has from the least to the greatest value, or their ends, ascending.
        Faces on which the field equals an end count above it; those on the last end count below it.
    fractions : (q,) sequence of float
        Of the area, from 0 to 1: where the quantiles are taken.

    Returns
    -------
    FieldStatistics
        The statistics.

    Raises
    ------
    ParameterError
        For a field of another shape or that is finite on no face, and for bad bins or fractions.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> x = plane.points[:, 0]
    >>> statistics = bihdist.field_statistics(plane, x, bins=4, fractions=[0.25, 0.5])
    >>> statistics.areas.round(6).tolist(), statistics.quantiles.round(6).tolist()
    ([0.25, 0.25, 0.25, 0.25], [-0.25, 0.0])
    """
    surface = with_faces(surface, "statistics")
    f, ids, faces = _chosen(surface, field)
    fraction = real_numbers(fractions, "Fractions of the area")
    if fraction.ndim != 1 or not ((fraction >= 0) & (fraction <= 1)).all():
        raise ParameterError(f"Fractions of the area are numbers from 0 to 1, not {fractions!r}.")
    mean = faces.mean()
    edges = _edges(bins, float(f.min()), float(f.max()))
    low, high, largest = int(f.argmin()), int(f.argmax()), int(np.abs(f).argmax())
    return FieldStatistics(
        count=len(f),
        mean=mean,
        mean_size=faces.mean_size(),
        deviation=faces.deviation(mean),
        least=float(f[low]),
        least_at=int(ids[low]),
        greatest=float(f[high]),
        greatest_at=int(ids[high]),
        largest=float(abs(f[largest])),
        largest_at=int(ids[largest]),
        fractions=fraction,
        quantiles=faces.quantiles(fraction),
        bins=edges,
        areas=faces.histogram(edges),
    )


@dataclass(frozen=True)
class Agreement:
    """The agreement of two fields over the vertices at which both are finite.

    Attributes
    ----------
    count : int
        How many vertices these are.
    spearman : float
        Rank correlation, from -1 to 1; NaN where a field is constant.
    by_area : float
        Rank correlation with vertices weighted by area, or by volume in tetrahedra.
    mean, largest : float
        Mean by area and largest value of the absolute difference; normalised fields were divided by their largest size
        first.
    largest_at : int
        The vertex of the largest.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> one = bihdist.BiharmonicDistance(sphere).from_source(0)
    >>> other = bihdist.GeodesicDistance(sphere).from_source(0)
    >>> agreement = bihdist.field_agreement(sphere, one, other, normalised=True)
    >>> # ordered alike, while values differ
    >>> round(agreement.spearman, 2), round(agreement.mean, 2)
    (1.0, 0.26)
    """

    count: int
    spearman: float
    by_area: float
    mean: float
    largest: float
    largest_at: int


def field_agreement(surface: MeshLike, a: npt.ArrayLike, b: npt.ArrayLike, normalised: bool = False) -> Agreement:
    """Measure how well two fields agree.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    a, b : (n,) array_like
        The two fields.
    normalised : bool
        Divide each field by its largest size first, as fields of different unit need.

    Returns
    -------
    Agreement
        Rank correlations and differences.

    Raises
    ------
    ParameterError
        For fields of another shape or without common vertices, or if a field to be normalised is 0 throughout.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> x, y = plane.points[:, 0], plane.points[:, 1]
    >>> for other in (3 * x + 1, y, -x):
    ...     print(bihdist.field_agreement(plane, x, other).spearman)
    1.0
    0.0
    -1.0
    """
    surface = Surface.of(surface)
    both = field_scatter(surface, a, b, normalised)
    f, g, ids = both.x, both.y, both.ids
    apart = np.abs(f - g)
    worst, orders = int(apart.argmax()), (_order(f), _order(g))
    if isinstance(surface, PointCloud | TetrahedralMesh):
        weights = surface.matrices[1][ids]
        mean = float(np.average(apart, weights=weights))
    else:
        weights, difference = corner_areas(surface)[ids], np.full(len(surface.vertices), np.nan)
        difference[ids] = f - g
        faces = LinearField.on(surface, difference)
        mean = faces.mean_size() if faces.area > 0 else float("nan")
    return Agreement(
        count=len(ids),
        spearman=_correlation(*orders, np.ones(len(ids))),
        by_area=_correlation(*orders, weights) if weights.sum() > 0 else float("nan"),
        mean=mean,
        largest=float(apart[worst]),
        largest_at=int(ids[worst]),
    )


def rank_correlation(a: npt.ArrayLike, b: npt.ArrayLike, weights: npt.ArrayLike | None = None) -> float:
    """Compute Spearman's rank correlation, which may be weighted.

    Parameters
    ----------
    a, b : (k,) array_like
        Finite values. Equal ones have the mean of their ranks.
    weights : (k,) array_like, optional
        At least 0; a weight counts as so many points in one place. 1 each by default.

    Returns
    -------
    float
        From -1 to 1; NaN if `a` or `b` is constant.

    Raises
    ------
    ParameterError
        For arrays of different shape, values that are not finite, or bad weights.

    Examples
    --------
    >>> import bihdist
    >>> bihdist.rank_correlation([1, 2, 3, 4], [10, 20, 25, 900])
    1.0
    >>> bihdist.rank_correlation([1, 2, 3, 4], [1, 2, 4, 3])
    0.8
    """
    f, g = (real_numbers(each, "Ranked values") for each in (a, b))
    w = np.ones(f.shape) if weights is None else real_numbers(weights, "Weights")
    if f.ndim != 1 or f.shape != g.shape or f.shape != w.shape or not len(f):
        raise ParameterError(f"Ranks of shape {f.shape} and {g.shape}, weights {w.shape}, cannot be correlated.")
    if not (np.isfinite(f).all() and np.isfinite(g).all() and np.isfinite(w).all() and (w >= 0).all() and w.sum() > 0):
        raise ParameterError("Rank correlation needs finite values, and weights of at least 0 that are not all 0.")
    return _correlation(_order(f), _order(g), w)


Order = tuple[IntArray, IntArray]
"""(k,) the order of values, and (g + 1,) the bounds in it of each group of equal ones."""


def _order(f: FloatArray) -> Order:
    order = np.argsort(f, kind="stable")
    value = f[order]
    return order, np.append(np.flatnonzero(np.append(True, value[1:] != value[:-1])), len(f))


def _correlation(one: Order, other: Order, w: FloatArray) -> float:
    # SciPy's has no weights.
    x, y = _ranks(one, w), _ranks(other, w)
    # Those of two values or more reach over half of all weight.
    if min(np.ptp(ranks[w > 0]) for ranks in (x, y)) < w.sum() / 4:
        return float("nan")
    x, y = x - w @ x / w.sum(), y - w @ y / w.sum()
    return float(np.clip(w @ (x * y) / np.sqrt((w @ x**2) * (w @ y**2)), -1, 1))


def _ranks(of: Order, w: FloatArray) -> FloatArray:
    """Return (k,) the weight of what is less, and half of that of what is equal."""
    order, groups = of
    bounds = np.append(0, np.cumsum(w[order]))[groups]
    ranks = np.empty(len(order))
    ranks[order] = np.repeat((bounds[:-1] + bounds[1:]) / 2, np.diff(groups))
    return ranks


def _chosen(surface: Surface, field: npt.ArrayLike) -> tuple[FloatArray, IntArray, LinearField]:
    """Return values and ids of the vertices that have a value, and the faces that have one everywhere."""
    f = surface.check_field(field)
    faces = LinearField.on(surface, f)
    if not faces.area > 0:
        raise ParameterError(f"The field is not finite on any face of {surface.name}.")
    ids = np.flatnonzero(np.isfinite(f) & (surface.component_of_vertex >= 0))
    return f[ids], ids, faces


def _edges(bins: int | npt.ArrayLike, least: float, greatest: float) -> FloatArray:
    if np.ndim(bins) == 0:
        if isinstance(bins, (bool, np.bool_)) or not isinstance(bins, (int, np.integer)) or bins < 1:
            raise ParameterError(f"bins is {bins!r}; a histogram has a whole number of them, at least 1.")
        finest = np.spacing(max(abs(least), abs(greatest)))
        if greatest - least < 4 * bins * finest:
            # One value, but for rounding.
            half = max(0.5, 4 * bins * finest)
            least, greatest = least - half, greatest + half
        return np.linspace(least, greatest, int(bins) + 1)
    edges = real_numbers(bins, "The ends of bins")
    if edges.ndim != 1 or len(edges) < 2 or not (np.diff(edges) > 0).all() or not np.isfinite(edges).all():
        raise ParameterError(f"The ends of bins are at least two finite numbers, ascending, not {bins!r}.")
    return edges
