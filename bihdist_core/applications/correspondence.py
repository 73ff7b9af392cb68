"""Which vertex of one surface corresponds to a vertex of another (paper, section 5.2, surface matching)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, array_of, real_numbers
from ..distances.distance import Distance
from ..errors import ParameterError
from ..progress import Progress, part, silent
from ..surface import Surface

BLOCK = 4096
"""Vertices of M at a time for which the map is found."""

Columns = tuple[dict[int, FloatArray], dict[int, FloatArray]]
"""Distances from vertices on both surfaces, by vertex."""

NOWHERE = -1
"""In a map: no vertex."""


class Correspondence:
    """Predict corresponding vertices of two surfaces from known pairs, by distances.

    Parameters
    ----------
    distance_m, distance_n : Distance
        Distances on the surfaces M and N.
    pairs : (k, 2) array_like
        Known corresponding vertices x_i of M and y_i of N.
    weights : (k,) array_like, optional
        Weights w_i of the pairs, at least 0; 1 each by default, as in the paper.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    known_columns : tuple of dict, optional
        Fields that another correspondence of these distances has computed.

    Raises
    ------
    VertexError
        If a vertex is not on its surface.
    ParameterError
        For pairs or weights of another form.

    Notes
    -----
    Section 5.2 of the paper. A vertex x of M has the vector x~_i = d_M(x, x_i) / max_j d_M(x, x_j), a vertex y of N the
    vector y~_i likewise, and c(x, y) = (sum_i w_i (x~_i - y~_i)^2)^(1/2) tells how badly y fits x. If a maximum is 0
    the vector is 0. (The paper normalises where it defines the vectors, but prints distances that are not normalised in
    its last formula. Here they are normalised, as its text explains, so that the scale of N does not matter.)

    Examples
    --------
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
        """Return this correspondence with other pairs; known fields are kept.

        Parameters
        ----------
        pairs : (k, 2) array_like
            Known corresponding vertices. A new pair costs a field on each surface.
        weights : (k,) array_like, optional
            Weights of the pairs; 1 each by default.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        Correspondence
            The other correspondence.

        Raises
        ------
        VertexError
            If a vertex is not on its surface.
        ParameterError
            For pairs or weights of another form.

        Examples
        --------
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
        """Compute the vectors of all vertices times the roots of the weights, (n, k) for each surface."""
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
        """Compute how badly each vertex of N fits vertices of M.

        Parameters
        ----------
        x : int or (m,) array_like
            Vertices of M.

        Returns
        -------
        (n,) or (n, m) float64 ndarray
            The misfit c(x, y) of every vertex y of N. NaN where y or x is on another component than one of the known
            points.

        Raises
        ------
        VertexError
            If a vertex is not on M.

        Examples
        --------
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
        """Find the vertex of N that fits a vertex of M best.

        Parameters
        ----------
        x : int
            A vertex of M.

        Returns
        -------
        vertex : int
            The vertex of N; -1 where none can be compared.
        misfit : float
            Its misfit; NaN where none can be compared.

        Raises
        ------
        VertexError
            If the vertex is not on M.

        Examples
        --------
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
        """Find the vertex of N that fits best for all vertices of M, or for some.

        Parameters
        ----------
        vertices : (m,) array_like, optional
            Vertices of M; all by default.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (m,) int64 ndarray
            Vertices of N; -1 where none can be compared.

        Raises
        ------
        VertexError
            If a vertex is not on M.

        Notes
        -----
        They are nearest neighbours among the vectors. Beside these, (n, k), the memory is that of a block of vertices.

        Examples
        --------
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
    """Compute how badly each vertex of a surface N fits vertices of a surface M.

    Parameters
    ----------
    distance_m, distance_n : Distance
        Distances on M and N.
    pairs : (k, 2) array_like
        Known corresponding vertices of M and N.
    x : int or (m,) array_like
        Vertices of M.
    weights : (k,) array_like, optional
        Weights of the pairs, at least 0; 1 each by default.

    Returns
    -------
    (n,) or (n, m) float64 ndarray
        The misfit of every vertex of N, as of `Correspondence.misfit`.

    Raises
    ------
    VertexError
        If a vertex is not on its surface.
    ParameterError
        For pairs or weights of another form.

    Examples
    --------
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
    """Return (m, k) rows divided by their maximum; rows of zeros stay."""
    largest = distances.max(axis=1, keepdims=True)
    scaled: FloatArray = np.divide(
        distances, largest, out=np.where(np.isnan(largest), np.nan, distances), where=largest > 0
    )
    return scaled


# ---------------------------------------------------------------------- in colours
DARKEST, LIGHTEST = 0.08, 0.95
"""The range of red, green and blue: neither black nor white, which marks and lines have."""


def position_colours(surface: Surface) -> FloatArray:
    """Return red, green and blue (n, 3) from x, y and z, each from the least to the largest of the surface's vertices.

    A flat surface has the middle value of the colour of its missing dimension.
    """
    used = surface.component_of_vertex >= 0
    x = surface.vertices[used] if used.any() else surface.vertices
    low, span = x.min(axis=0), np.ptp(x, axis=0)
    is_flat = span <= 1e-9 * max(float(span.max()), np.finfo(float).tiny)
    fractions = (surface.vertices - low) / np.where(is_flat, 1.0, span)
    fractions[:, is_flat] = 0.5
    colours: FloatArray = DARKEST + (LIGHTEST - DARKEST) * np.clip(fractions, 0, 1)
    return colours


def carried_back(colours: npt.ArrayLike, found: npt.ArrayLike) -> FloatArray:
    """Return the colours (n, 3) of the vertices that a map (n,) leads to, from colours (m, 3) there; NaN for no vertex.

    Raises ParameterError for a map to vertices that have no colours.
    """
    there, ids = np.asarray(colours, np.float64), np.asarray(found)
    if ids.ndim != 1 or ids.dtype.kind not in "iu":
        raise ParameterError(f"A map is one whole number for each vertex, not {ids.dtype} of the shape {ids.shape}.")
    wrong = np.flatnonzero((ids < NOWHERE) | (ids >= len(there)))
    if len(wrong):
        raise ParameterError(f"Vertex {wrong[0]} is mapped to {ids[wrong[0]]}, and there are {len(there):,} vertices.")
    return np.where((ids == NOWHERE)[:, None], np.nan, there[ids])
