"""Which vertex of one surface corresponds to a vertex of another (paper, section 5.2, surface matching)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..distances.distance import Distance
from ..errors import ParameterError
from ..number_arrays import array_of, real_numbers
from ..progress import Progress, part, silent

BLOCK = 4096
"""Vertices of M at a time for which the map is found."""

Columns = tuple[dict[int, FloatArray], dict[int, FloatArray]]
"""Of both surfaces: distances from vertices, by vertex."""

NOWHERE = -1
"""In a map: no vertex."""


class Correspondence:
    """What distances from known pairs of corresponding vertices say of all others (paper, section 5.2).

    A vertex x of M has the vector x~_i = d_M(x, x_i) / max_j d_M(x, x_j) of its distances from the known points, a
    vertex y of N the vector y~_i likewise.  c(x, y) = (sum_i w_i (x~_i - y~_i)^2)^(1/2) tells how badly y fits x; the
    least marks the best candidate.  If a maximum is 0 the vector is 0.  (The paper normalises where it defines the
    vectors, and prints distances that are not normalised in its last formula; here they are, as its text explains: so
    that a scaled surface N changes nothing.)

    pairs: (k, 2) known corresponding vertices (x_i of M, y_i of N).  weights: (k,), at least 0; 1 each by default,
    as in the paper.  known_columns: fields of another
    correspondence of these distances.

    Raises VertexError for bad vertices, ParameterError for pairs or weights of another form.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> one = bihdist.BiharmonicDistance(plane)
    >>> twice = bihdist.BiharmonicDistance(plane.scale(2))
    >>> # three corners of two squares
    >>> found = bihdist.Correspondence(one, twice, [(0, 0), (8, 8), (72, 72)])
    >>> found.best(40)[0], (found.map() == range(81)).all().item()
    (40, True)
    """

    def __init__(
        self,
        distance_m: Distance,
        distance_n: Distance,
        pairs: npt.ArrayLike,
        weights: npt.ArrayLike | None = None,
        progress: Progress | None = None,
        known_columns: Columns | None = None,
    ) -> None:
        known = array_of(pairs, "Known correspondences")
        if known.ndim != 2 or known.shape[1] != 2 or not len(known):
            raise ParameterError(
                f"Known correspondences are an array of shape (k, 2), k at least 1, not {known.shape}."
            )
        w = np.ones(len(known)) if weights is None else real_numbers(weights, "Weights")
        if w.shape != (len(known),) or not (np.isfinite(w) & (w >= 0)).all():
            raise ParameterError(
                f"{len(known)} correspondences need as many finite weights of at least 0, not {weights!r}."
            )
        self.distance_m, self.distance_n = distance_m, distance_n
        self.pairs = np.stack(
            [distance_m.surface.check_vertices(known[:, 0]), distance_n.surface.check_vertices(known[:, 1])], axis=1
        )
        self.weights = w
        self._columns: Columns = ({}, {}) if known_columns is None else known_columns
        self._find(progress)

    def changed(
        self, pairs: npt.ArrayLike, weights: npt.ArrayLike | None = None, progress: Progress | None = None
    ) -> Correspondence:
        """This correspondence with other pairs (k, 2) and weights (k,).

        A new pair costs a field on each surface, pairs that are known cost none.  Raises VertexError for bad vertices,
        ParameterError for pairs or weights of another form.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> found = bihdist.Correspondence(distance, distance, [(0, 0), (8, 8)])
        >>> # a third pair costs one field on each surface
        >>> better = found.changed([(0, 0), (8, 8), (72, 72)])
        >>> better.best(30)[0]
        30
        """
        return Correspondence(self.distance_m, self.distance_n, pairs, weights, progress, self._columns)

    def _find(self, progress: Progress | None) -> None:
        """The vectors of all vertices, times the roots of the weights: (n, k) each."""
        root, found = np.sqrt(self.weights), []
        for side, distance in enumerate((self.distance_m, self.distance_n)):
            known, points = self._columns[side], self.pairs[:, side].tolist()
            missing = [vertex for vertex in dict.fromkeys(points) if vertex not in known]
            if missing:
                columns = distance.from_sources(missing, part(progress, side / 2, side / 2 + 0.5))
                known.update(zip(missing, np.ascontiguousarray(columns.T), strict=True))
            found.append(_normalised(np.stack([known[vertex] for vertex in points], axis=1)) * root)
        self._of_m, self._of_n = found

    def misfit(self, x: npt.ArrayLike) -> FloatArray:
        """c(x, y) for every vertex y of N: (n,) for one vertex x of M, (n, m) for (m,).

        NaN where y or x is on another component than one of the known points.  Raises VertexError for a bad vertex.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> found = bihdist.Correspondence(distance, distance, [(0, 0), (8, 8), (72, 72)])
        >>> misfit = found.misfit(40)
        >>> misfit.shape, int(misfit.argmin()), bool(misfit[40] < 1e-9)
        ((81,), 40, True)
        """
        ids = self.distance_m.surface.check_vertices(x)
        squares = np.zeros((len(self._of_n), len(ids)))
        for there, here in zip(self._of_n.T, self._of_m[ids].T, strict=True):
            squares += (there[:, None] - here) ** 2
        misfit = np.sqrt(squares)
        return misfit[:, 0] if np.ndim(x) == 0 else misfit

    def best(self, x: int) -> tuple[int, float]:
        """The vertex of N that fits x best, and its misfit; (-1, NaN) where none can be compared.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> found = bihdist.Correspondence(distance, distance, [(0, 0), (8, 8), (72, 72)])
        >>> vertex, misfit = found.best(30)
        >>> vertex, round(misfit, 9)
        (30, 0.0)
        """
        misfit = self.misfit(self.distance_m.surface.check_vertex(x))
        if np.isnan(misfit).all():
            return NOWHERE, float("nan")
        y = int(np.nanargmin(misfit))
        return y, float(misfit[y])

    def map(self, vertices: npt.ArrayLike | None = None, progress: Progress | None = None) -> IntArray:
        """(n,) for all vertices of M, or (m,) for some, the vertex of N that fits best; -1 where none can be compared.

        Found as nearest neighbours among the vectors; beside these (n, k) the memory is that of a block of vertices.
        Raises VertexError for a bad vertex.

        >>> import bihdist, pyvista
        >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
        >>> distance = bihdist.BiharmonicDistance(plane)
        >>> found = bihdist.Correspondence(distance, distance, [(0, 0), (8, 8), (72, 72)])
        >>> found.map([30, 40, 50]).tolist()
        [30, 40, 50]
        """
        from scipy.spatial import cKDTree

        report = progress or silent
        n = len(self._of_m)
        ids = np.arange(n) if vertices is None else self.distance_m.surface.check_vertices(vertices)
        found = np.full(len(ids), NOWHERE)
        there = np.flatnonzero(np.isfinite(self._of_n).all(axis=1))
        if not len(there):
            return found
        tree = cKDTree(self._of_n[there])
        for start in range(0, len(ids), BLOCK):
            some = ids[start : start + BLOCK]
            report(start / max(1, len(ids)), f"{start:,} of {len(ids):,} vertices")
            here = np.isfinite(self._of_m[some]).all(axis=1)
            found[start : start + BLOCK][here] = there[tree.query(self._of_m[some[here]])[1]]
        return found


def correspondence_prediction(
    distance_m: Distance,
    distance_n: Distance,
    pairs: npt.ArrayLike,
    x: npt.ArrayLike,
    weights: npt.ArrayLike | None = None,
) -> FloatArray:
    """How badly each vertex of N fits a vertex x of M: (n,) for one x, (n, m) for several (m,); see `Correspondence`.

    Raises VertexError for bad vertices, ParameterError for pairs or weights of another form.

    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.BiharmonicDistance(plane)
    >>> pairs = [(0, 0), (8, 8), (72, 72)]
    >>> misfit = bihdist.correspondence_prediction(distance, distance, pairs, 40)
    >>> int(misfit.argmin())
    40
    """
    return Correspondence(distance_m, distance_n, pairs, weights).misfit(x)


def _normalised(distances: FloatArray) -> FloatArray:
    """(m, k) rows divided by their maximum; rows of zeros stay."""
    largest = distances.max(axis=1, keepdims=True)
    scaled: FloatArray = np.divide(
        distances, largest, out=np.where(np.isnan(largest), np.nan, distances), where=largest > 0
    )
    return scaled
