"""How far a map between two surfaces is from the truth: geodesic errors and their cumulative curve.

As the field measures it (Kim, Lipman, Funkhouser 2011): the error of a vertex is the geodesic distance, on the surface
that is mapped to, between where it is mapped and where it belongs, over the root of that surface's area.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, array_of, real_numbers
from ..distances.distance import Distance
from ..distances.geodesic import GeodesicDistance
from ..errors import ParameterError
from ..laplacian import Laplacian
from ..progress import Progress, part, silent
from ..surface import Surface
from .correspondence import NOWHERE

BLOCK = 32
"""So many right answers at a time, from which fields are computed where a distance is not symmetric."""

LIMIT = 0.25
"""The end of error curves, up to which the area under them is taken."""

EXACT_WORK = 40_000_000
"""Vertices times right answers up to which errors are exact geodesic distances: some minutes at most."""


def error_distance(
    laplacian: Laplacian, count: int, method: str = "auto", progress: Progress | None = None
) -> GeodesicDistance:
    """Return the geodesic distance that measures the errors of a map to a surface, from so many right answers.

    `method` is one of `GeodesicDistance`; "auto" is exact where that takes minutes at most, else approximate.
    """
    return GeodesicDistance(laplacian, error_method(laplacian.surface, count) if method == "auto" else method, progress)


def error_method(surface: Surface, count: int) -> str:
    """Return the method that "auto" stands for."""
    return "exact" if count * len(surface.vertices) <= EXACT_WORK else "virtual-sources"


def sampled_vertices(count: int, samples: int | None) -> IntArray:
    """Return (k,) so many of the vertices 0 to count - 1, evenly by id; all of them if `samples` is None."""
    if samples is None or samples >= count:
        return np.arange(count)
    return np.unique(np.linspace(0, count - 1, samples).astype(int))


def map_errors(
    distance: Distance,
    found: npt.ArrayLike,
    truth: npt.ArrayLike,
    partners: npt.ArrayLike | None = None,
    progress: Progress | None = None,
) -> FloatArray:
    """Compute the geodesic errors of a map between two surfaces.

    Parameters
    ----------
    distance : Distance
        A geodesic distance on the surface mapped to.
    found : (m,) or (m, q) array_like
        Vertices that m vertices are mapped to, by one or by q maps; -1 for none. Several maps cost as much as one: a
        field for each different right answer.
    truth : (m,) array_like
        Vertices that they should be mapped to; -1 where that is not known.
    partners : (n,) array_like, optional
        The symmetric partner of each vertex of the surface mapped to, which then counts as right, too; -1 for none.
    progress : callable, optional
        Called as ``progress(fraction, text)``.

    Returns
    -------
    (m,) or (m, q) float64 ndarray
        Distances between found and true vertices over the root of the surface's area. Infinite where nothing was found
        or the truth is on another component, NaN where the truth is not known.

    Raises
    ------
    VertexError
        If a vertex is not on the surface.
    ParameterError
        For arrays of another form or that are not whole numbers.

    Notes
    -----
    The measure of Kim, Lipman and Funkhouser, 2011.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> errors = bihdist.map_errors(distance, found=[0, 9, -1], truth=[0, 10, 20])
    >>> errors.round(3).tolist()
    [0.0, 0.125, inf]
    """
    surface = distance.surface
    to, right = _checked(found, surface, 2), _checked(truth, surface)
    if to.ndim not in (1, 2) or len(to) != len(right):
        raise ParameterError(f"The map has {len(to):,} values, and the truth {len(right):,}; they need as many.")
    errors = _errors(distance, to, right, part(progress, 0, 1 if partners is None else 0.5))
    if partners is not None:
        others = _checked(partners, surface)
        if len(others) != len(surface.vertices):
            raise ParameterError(
                f"Symmetric partners are needed for each of the {len(surface.vertices):,} vertices of {surface.name}, "
                f"not for {len(others):,}."
            )
        known = right >= 0
        mirrored = np.full(len(right), NOWHERE)
        mirrored[known] = others[right[known]]
        errors = np.fmin(errors, _errors(distance, to, mirrored, part(progress, 0.5, 1)))
    return errors


def _checked(vertices: npt.ArrayLike, surface: Surface, axes: int = 1) -> IntArray:
    ids = array_of(vertices, "Vertices of a map")
    if not 1 <= ids.ndim <= axes or ids.dtype.kind not in "iu":
        raise ParameterError(f"A map is (m,) whole numbers, not {ids.shape} of {ids.dtype}.")
    inside = ids[ids != NOWHERE]
    if len(inside):
        low, high = int(inside.min()), int(inside.max())
        if low < 0 or high >= len(surface.vertices):
            surface.check_vertex(low if low < 0 else high)
    return ids.astype(int)


def _errors(distance: Distance, to: IntArray, right: IntArray, progress: Progress | None) -> FloatArray:
    surface, report = distance.surface, progress or silent
    unit = float(np.sqrt(surface.face_areas.sum()))
    errors = np.full(to.shape, np.nan)
    referenced = surface.component_of_vertex >= 0
    rows = np.flatnonzero((right != NOWHERE) & referenced[right])
    errors[rows] = np.inf
    if distance.is_symmetric:
        every, truth = to.reshape(len(to), -1), right[:, None]
        row, column = np.nonzero((every != NOWHERE) & referenced[every] & (truth != NOWHERE) & referenced[truth])
        away = distance.of_pairs(np.column_stack([right[row], every[row, column]]), progress)
        errors.reshape(every.shape)[row, column] = np.where(np.isfinite(away), away / unit, np.inf)
        return errors
    rows = rows[np.argsort(right[rows], kind="stable")]
    answers, first = np.unique(right[rows], return_index=True)
    for start in range(0, len(answers), BLOCK):
        report(start / len(answers), f"errors at {start:,} of {len(answers):,} vertices")
        stop = min(start + BLOCK, len(answers))
        some = rows[first[start] : first[stop] if stop < len(answers) else len(rows)]
        columns = distance.from_sources(answers[start:stop])
        column = np.searchsorted(answers, right[some]) - start
        away = columns[to[some], column if to.ndim == 1 else column[:, None]]
        errors[some] = np.where(np.isfinite(away) & (to[some] != NOWHERE), away / unit, np.inf)
    return errors


@dataclass(frozen=True, eq=False)
class ErrorCurve:
    """The fraction of vertices whose error is at most each threshold.

    Attributes
    ----------
    errors : (m,) float64 ndarray
        The known errors, ascending.
    mean : float
        Their mean; infinite if a vertex was mapped nowhere.
    median : float
        Their median.
    area : float
        The area under the curve from 0 to 0.25, over 0.25; 1 for a perfect map.

    Examples
    --------
    >>> import bihdist
    >>> curve = bihdist.error_curve([0.0, 0.0, 0.02, 0.1])
    >>> round(curve.mean, 3), round(curve.median, 3), round(curve.area, 3)
    (0.03, 0.01, 0.88)
    >>> curve.fractions([0, 0.05, 0.2]).tolist()
    [0.5, 0.75, 1.0]
    """

    errors: FloatArray
    mean: float
    median: float
    area: float

    def fractions(self, thresholds: npt.ArrayLike) -> FloatArray:
        """Return the fraction of errors that are at most each threshold.

        Parameters
        ----------
        thresholds : (t,) array_like
            Errors.

        Returns
        -------
        (t,) float64 ndarray
            Fractions from 0 to 1.

        Examples
        --------
        >>> import bihdist
        >>> bihdist.error_curve([0.0, 0.0, 0.02, 0.1]).fractions([0, 0.05, 0.2]).tolist()
        [0.5, 0.75, 1.0]
        """
        return np.searchsorted(self.errors, np.asarray(thresholds, np.float64), side="right") / len(self.errors)


@dataclass(frozen=True, eq=False)
class MeanCurve:
    """The mean of the error curves of at least one map; each counts alike, however many vertices it has."""

    curves: tuple[ErrorCurve, ...]

    @property
    def mean(self) -> float:
        """Mean over the maps of their mean errors, in the unit of the errors."""
        return float(np.mean([curve.mean for curve in self.curves]))

    @property
    def median(self) -> float:
        """The smallest error at which the mean curve has reached one half; infinite if it does not."""
        errors = np.concatenate([curve.errors for curve in self.curves])
        weights = np.concatenate([np.full(len(c.errors), 1 / len(c.errors)) for c in self.curves]) / len(self.curves)
        order = np.argsort(errors, kind="stable")
        reached = int(np.searchsorted(np.cumsum(weights[order]), 0.5 - 1e-12))
        return float(errors[order[min(reached, len(errors) - 1)]])

    @property
    def area(self) -> float:
        """Mean over the maps of the areas under their curves, from 0 to 1."""
        return float(np.mean([curve.area for curve in self.curves]))

    def fractions(self, thresholds: npt.ArrayLike) -> FloatArray:
        """Return (t,) the mean of the maps' fractions of errors that are at most each of thresholds (t,)."""
        mean: FloatArray = np.mean([curve.fractions(thresholds) for curve in self.curves], axis=0)
        return mean


def error_curve(errors: npt.ArrayLike) -> ErrorCurve:
    """Make the cumulative curve of errors.

    Parameters
    ----------
    errors : (m,) array_like
        Errors, as of `map_errors`; NaN is left out.

    Returns
    -------
    ErrorCurve
        The curve, with mean, median and area.

    Raises
    ------
    ParameterError
        If no error is known.

    Examples
    --------
    >>> import bihdist
    >>> # NaN: no truth is known
    >>> curve = bihdist.error_curve([0.0, 0.1, float("nan"), 0.02])
    >>> curve.errors.tolist(), round(curve.mean, 3)
    ([0.0, 0.02, 0.1], 0.04)
    """
    known = np.sort(real_numbers(errors, "Errors").ravel())
    known = known[~np.isnan(known)]
    if not len(known):
        raise ParameterError("No vertex has a known true place, so there is no error.")
    area = 1 - float(np.minimum(known, LIMIT).mean()) / LIMIT
    return ErrorCurve(known, float(known.mean()), float(np.median(known)), area)
