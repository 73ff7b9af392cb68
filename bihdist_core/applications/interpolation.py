"""Shepard interpolation on a surface (paper, section 5.2): weighted averages, the weights inverse distances."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, real_numbers
from ..distances.distance import Distance
from ..errors import ParameterError, VertexError
from ..progress import Progress
from .weights import Weights


class ShepardInterpolant:
    """Values between anchors by Shepard's interpolation, with any distance.

    Parameters
    ----------
    distance : Distance
        The distance.
    anchors : (k,) array_like
        Vertices p_i, all different. Each component of the surface uses its own anchors only.
    values : (k,) array_like
        Finite numbers f_i.
    exponent : float
        From 0.1 to 20. A larger exponent makes the interpolant flatter at the anchors and steeper between them.
    smoothness : float
        The fraction s from 0 to 1, which rounds the cones at the anchors.

    Raises
    ------
    VertexError
        If an anchor is not on the surface, belongs to no face, or is named twice.
    ParameterError
        For no anchors, for values that are not k finite numbers, and for an exponent or a smoothness out of range.

    Notes
    -----
    Section 5.2 of the paper: f(p) = sum_i w_i f_i / sum_i w_i, where w_i = r(d(p, p_i)) ** -exponent. The paper has
    exponent 1 and smoothness 0, where r(d) = d and f has a cone at each anchor. With smoothness s, r(d) = d^2 / (d + s
    D), D the largest distance of the anchor: the weights are those of twice the exponent within about s D, and of the
    exponent beyond.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> # two opposite corners of a square
    >>> f = bihdist.ShepardInterpolant(distance, [0, 80], [0.0, 1.0]).evaluate()
    >>> f[[0, 40, 80]].round(6).tolist()
    [0.0, 0.5, 1.0]
    """

    def __init__(
        self,
        distance: Distance,
        anchors: npt.ArrayLike,
        values: npt.ArrayLike,
        exponent: float = 1.0,
        smoothness: float = 0.0,
    ) -> None:
        self.distance = distance
        self.anchors = distance.surface.check_vertices(anchors)
        weights = Weights(exponent, smoothness)
        self.exponent, self.smoothness = weights.exponent, weights.smoothness
        if not len(self.anchors):
            raise ParameterError("An interpolant needs at least one anchor.")
        ids, count = np.unique(self.anchors, return_counts=True)
        if (count > 1).any():
            raise VertexError(f"Vertex {ids[count > 1][0]} is an anchor twice.")
        self.values = self._checked(values)
        self._columns: dict[int, FloatArray] = {}
        self._weights: FloatArray | None = None
        self._total: FloatArray | None = None

    def changed(
        self,
        anchors: npt.ArrayLike | None = None,
        values: npt.ArrayLike | None = None,
        exponent: float | None = None,
        smoothness: float | None = None,
    ) -> ShepardInterpolant:
        """Return this interpolant with other anchors, values or parameters; known distances are kept.

        Parameters
        ----------
        anchors : (k,) array_like, optional
            Vertices; a new one costs a field.
        values : (k,) array_like, optional
            Finite numbers; other values cost one product of matrices.
        exponent : float, optional
            From 0.1 to 20.
        smoothness : float, optional
            From 0 to 1.

        Returns
        -------
        ShepardInterpolant
            The other interpolant.

        Raises
        ------
        VertexError
            For a bad anchor, or one named twice.
        ParameterError
            For no anchors, for values that are not k finite numbers, and for an exponent or a smoothness out of range.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> f = bihdist.ShepardInterpolant(distance, [0, 80], [0.0, 1.0])
        >>> # no distance is computed again
        >>> f.changed(values=[0.0, 3.0]).evaluate()[40].round(6).item()
        1.5
        """
        other = ShepardInterpolant(
            self.distance,
            self.anchors if anchors is None else anchors,
            self.values if values is None else values,
            self.exponent if exponent is None else exponent,
            self.smoothness if smoothness is None else smoothness,
        )
        # Not of all anchors there ever were: one that is dragged has many.
        wanted = {*self.anchors.tolist(), *other.anchors.tolist()}
        other._columns = {vertex: column for vertex, column in self._columns.items() if vertex in wanted}
        same = np.array_equal(other.anchors, self.anchors)
        if same and (other.exponent, other.smoothness) == (self.exponent, self.smoothness):
            other._weights, other._total = self._weights, self._total
        return other

    @property
    def missing(self) -> list[int]:
        """Anchors whose distances have still to be computed.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> f = bihdist.ShepardInterpolant(distance, [0, 80], [0.0, 1.0])
        >>> before, _ = f.missing, f.evaluate()
        >>> before, f.missing, f.changed(anchors=[0, 8], values=[0, 1]).missing
        ([0, 80], [], [8])
        """
        return [vertex for vertex in self.anchors.tolist() if vertex not in self._columns]

    def evaluate(self, progress: Progress | None = None) -> FloatArray:
        """Evaluate the interpolant at every vertex.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n,) float64 ndarray
            Exactly f_i at anchor i, between the least and the greatest f_i elsewhere, and NaN on components without
            anchors. A vertex at distance 0 from anchors without being one gets the mean of their values: some distances
            cannot tell all vertices apart.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> f = bihdist.ShepardInterpolant(distance, [0, 8, 80], [2.0, 2.0, 5.0]).evaluate()
        >>> f.min().item(), f.max().item()
        (2.0, 5.0)
        """
        with np.errstate(invalid="ignore"):
            result = self._fractions(progress) @ self.values
        # Rounding must not make an extremum where the formula has none.
        result = np.clip(result, self.values.min(), self.values.max())
        result[self.anchors] = self.values
        return result

    def sum_of_weights(self, progress: Progress | None = None) -> FloatArray:
        """Compute the logarithm of the sum of weights, which shows how far the anchors' influence reaches.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n,) float64 ndarray
            The log10 of sum_i w_i over its least value on the surface; infinite at the anchors, NaN on components
            without one.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> f = bihdist.ShepardInterpolant(distance, [0, 80], [0.0, 1.0])
        >>> weights = f.sum_of_weights()
        >>> weights[0].item(), weights.min().item()
        (inf, 0.0)
        """
        self._fractions(progress)
        assert self._total is not None
        return self._total - np.nanmin(self._total)

    def _fractions(self, progress: Progress | None) -> FloatArray:
        """Return (n, k) w_i / sum_j w_j; NaN where there is no anchor."""
        if self._weights is None:
            if missing := self.missing:
                columns = self.distance.from_sources(missing, progress)
                self._columns.update(zip(missing, np.ascontiguousarray(columns.T), strict=True))
            distances = np.stack([self._columns[vertex] for vertex in self.anchors.tolist()], axis=1)
            if self.smoothness:
                reach = self.smoothness * np.nanmax(distances, axis=0)
                with np.errstate(invalid="ignore"):
                    distances = np.where(distances > 0, distances**2 / (distances + reach), distances)
            # Divided by the nearest distance first, no weight overflows; where that is 0, only those at 0 count.
            nearest = np.fmin.reduce(distances, axis=1, keepdims=True)
            with np.errstate(divide="ignore", invalid="ignore"):
                weights = np.where(nearest > 0, (nearest / distances) ** self.exponent, distances == 0)
                weights[~np.isfinite(distances)] = 0
                total = weights.sum(axis=1)
                self._weights = weights / total[:, None]
                self._total = np.log10(total) - self.exponent * np.log10(nearest[:, 0])
        return self._weights

    def _checked(self, values: npt.ArrayLike) -> FloatArray:
        found = np.array(real_numbers(values, "Values at anchors"), ndmin=1)
        if found.shape != self.anchors.shape or not np.isfinite(found).all():
            raise ParameterError(
                f"{len(self.anchors)} anchors need as many finite values, not an array of shape {found.shape} "
                f"with {np.count_nonzero(~np.isfinite(found))} that are not finite."
            )
        return found
