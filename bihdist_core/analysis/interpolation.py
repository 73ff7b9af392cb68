"""Shepard interpolation on a surface (paper, section 5.2): weighted averages, the weights inverse distances."""

import numpy as np
import numpy.typing as npt

from ..distances.distance import Distance
from ..errors import ParameterError, VertexError
from ..progress import Progress


class ShepardInterpolant:
    """f(p) = sum_i f_i / d(p, p_i)  /  sum_i 1 / d(p, p_i), with any distance d.

    anchors: (k,) vertices p_i, all different.  values: (k,) real numbers f_i.  Each connected component of the
    surface uses its own anchors only, since between components there is no distance.

    Raises VertexError for an anchor that does not exist, belongs to no face or is named twice; ParameterError for no
    anchors, and for values that are not k finite numbers.
    """

    def __init__(self, distance: Distance, anchors: npt.ArrayLike, values: npt.ArrayLike) -> None:
        self.distance = distance
        self.anchors = distance.surface.check_vertices(anchors)
        self.values = np.array(values, np.float64, ndmin=1)
        if not len(self.anchors):
            raise ParameterError("An interpolant needs at least one anchor.")
        if self.values.shape != self.anchors.shape or not np.isfinite(self.values).all():
            raise ParameterError(
                f"{len(self.anchors)} anchors need as many finite values, not an array of shape {self.values.shape} "
                f"with {np.count_nonzero(~np.isfinite(self.values))} that are not finite."
            )
        ids, count = np.unique(self.anchors, return_counts=True)
        if (count > 1).any():
            raise VertexError(f"Vertex {ids[count > 1][0]} is an anchor twice.")

    def evaluate(self, progress: Progress | None = None) -> np.ndarray:
        """(n,) the interpolant at every vertex: f_i exactly at anchor i, NaN on components without anchors.

        Never below the least f_i or above the greatest.  A vertex at distance 0 from anchors without being one (some
        distances cannot tell all vertices apart) gets the mean of their values.
        """
        distances = self.distance.from_sources(self.anchors, progress)
        # Divided by the nearest distance first, no weight overflows; where that is 0, only those at 0 count.
        nearest = np.fmin.reduce(distances, axis=1, keepdims=True)
        with np.errstate(divide="ignore", invalid="ignore"):
            weights = np.where(nearest > 0, nearest / distances, distances == 0)
        weights[~np.isfinite(distances)] = 0
        total = weights.sum(axis=1)
        with np.errstate(invalid="ignore"):
            result = weights @ self.values / total
        # Rounding must not make an extremum where the formula has none.
        result = np.clip(result, self.values.min(), self.values.max())
        result[self.anchors] = self.values
        return result
