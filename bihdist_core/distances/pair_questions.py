"""How far the two ends of pairs are apart: by fields from few of them, or in a distance's own way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, FloatArray, IntArray, array_of
from ..errors import ParameterError
from ..laplacian import Component
from ..progress import Progress, blocks, part, silent
from ..sources.pieces import Pieces, points_on
from ..sources.source import Source, SurfacePoint, checked_source
from ..sources.words import short_words_of
from .place_pairs import Pair, are_many, are_of_places, are_same, has_places, paired, squares_of_pairs
from .source_questions import OtherSource, SourceQuestions, block_size

DIGITS = ("field", "all")
"""The precision of distances of pairs (`PairQuestions.of_pairs`)."""

Ends: TypeAlias = AnyArray | Sequence[Source]
"""(k,) vertices, or places in faces."""


class PairQuestions(SourceQuestions):
    """The questions about pairs of vertices, and of places in faces, that a distance answers."""

    is_symmetric = True

    @overload
    def between(self, u: Source | str, v: Source | str, progress: Progress | None = None) -> float: ...

    @overload
    def between(self, u: Ends, v: Ends, progress: Progress | None = None) -> FloatArray: ...

    def between(self, u: Any, v: Any, progress: Progress | None = None) -> float | FloatArray:
        """Compute the distance of two vertices or places in faces, or of as many pairs of them.

        Parameters
        ----------
        u, v : int, str, Source, or (k,) array_like or sequence
            Vertices or places in faces; of two single ones, one may be any source if the other is a vertex.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        float or (k,) float64 ndarray
            In the distance's unit, NaN between components; of several pairs as `of_pairs` computes them.

        Raises
        ------
        ParameterError
            For ends that this distance does not know, and for sequences of different lengths.
        VertexError
            If a vertex is not on the surface.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3))
        >>> round(distance.between(0, 1), 3)
        2.03
        >>> distance.between([0, 0], [1, 2]).round(3).tolist()
        [2.03, 3.134]
        """
        if are_many(u) or are_many(v):
            return self.of_pairs(paired(u, v), progress)
        u, v = (checked_source(each) if isinstance(each, str) else each for each in (u, v))
        are_single = [isinstance(each, SurfacePoint) or not isinstance(each, OtherSource) for each in (u, v)]
        if all(are_single):
            return float(self.pairwise([u, v], progress)[0, 1])
        if not isinstance(v, OtherSource):
            return float(self.from_source(u, progress)[self.surface.check_vertex(v)])
        if not isinstance(u, OtherSource):
            return float(self.from_source(v, progress)[self.surface.check_vertex(u)])
        raise ParameterError(
            f"{self.label} is not known between {short_words_of(u)} and {short_words_of(v)}; one must be a vertex."
        )

    def pairwise(
        self, vertices: npt.ArrayLike | Sequence[Source | str], progress: Progress | None = None
    ) -> FloatArray:
        """Compute the distances among vertices, or places in faces.

        Parameters
        ----------
        vertices : (k,) array_like of int, or sequence of Source
            Vertex ids, or points of the surface.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (k, k) float64 ndarray
            Symmetric, with a zero diagonal; in the distance's unit, NaN between components.

        Raises
        ------
        VertexError, ParameterError
            For points that are not on the surface, or that this distance does not know.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> distance.pairwise([0, 12, 40]).round(3).tolist()
        [[0.0, 0.216, 0.474], [0.216, 0.0, 0.452], [0.474, 0.452, 0.0]]
        """
        (progress or silent)(0.0, self.label)
        if has_places(vertices):
            points = list(vertices)
            i, j = np.triu_indices(len(points), 1)
            among = points_on(self.surface, points)
            found = np.zeros((len(points), len(points)))
            found[i, j] = found[j, i] = self._of_points(among.select(i), among.select(j), progress)
            return found
        ids = self.surface.check_vertices(vertices)
        distances = np.full((len(ids), len(ids)), np.nan)
        for component, mine, step in self._by_component(ids, progress):
            block = self._pairwise(component, component.local(ids[mine]), step)
            distances[np.ix_(mine, mine)] = (block + block.T) / 2
        distances[ids[:, None] == ids] = 0
        return distances

    def of_pairs(
        self, pairs: npt.ArrayLike | Sequence[Pair], progress: Progress | None = None, *, digits: str = "field"
    ) -> FloatArray:
        """Compute the distances of pairs of vertices, or of places in faces.

        Parameters
        ----------
        pairs : (k, 2) array_like of int, or sequence of pairs
            Vertex ids, or points of the surface.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        digits : {"field", "all"}
            ``"field"``: as exact as fields are, by one field for all pairs of a vertex where that is less work than a
            solve for each pair.  ``"all"``: free of cancellation, by a solve for each pair where a distance has such a
            form, so that the smallest distances have all digits, too.

        Returns
        -------
        (k,) float64 ndarray
            In the distance's unit, NaN between components; the mean of both ways where a distance is not symmetric.

        Raises
        ------
        ParameterError
            For another shape or other digits, and for places in faces if this distance knows vertices only.
        VertexError
            If a vertex is not on the surface.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> distance.of_pairs([(0, 12), (0, 40), (12, 40)]).round(3).tolist()
        [0.216, 0.474, 0.452]
        """
        if digits not in DIGITS:
            raise ParameterError(f"Digits of pairs are {' or '.join(map(repr, DIGITS))}, not {digits!r}.")
        (progress or silent)(0.0, self.label)
        if are_of_places(pairs):
            u, v = (points_on(self.surface, [pair[side] for pair in pairs]) for side in (0, 1))
            return self._of_points(u, v, progress)
        table = array_of(pairs, "Pairs of vertices")
        if table.ndim != 2 or table.shape[1] != 2:
            raise ParameterError(f"Pairs of vertices must have shape (k, 2), not {table.shape}.")
        i, j = self.surface.check_vertices(table.ravel()).reshape(-1, 2).T
        distances = np.full(len(i), np.nan)
        label = self.surface.component_of_vertex
        for component, mine, step in self._by_component(i, progress):
            mine = mine[label[i[mine]] == label[j[mine]]]
            if len(mine):
                step = self._prepared(component, step)
                ends = component.local(i[mine]), component.local(j[mine])
                distances[mine] = self._of_pairs(component, *ends, digits, step)
        distances[i == j] = 0
        return distances

    def _of_points(self, u: Pieces, v: Pieces, progress: Progress | None) -> FloatArray:
        """Return (k,) distances of pairs of vertices and places in faces."""
        distances = np.zeros(len(u))
        are_vertices = (u.start.max(axis=1) == 1) & (v.start.max(axis=1) == 1)
        others = np.flatnonzero(~are_vertices & ~are_same(u, v))
        share = float(are_vertices.mean()) if len(others) else 1.0
        if are_vertices.any():
            ends = (each.select(are_vertices) for each in (u, v))
            pairs = np.column_stack([each.corners[each.start == 1] for each in ends])
            distances[are_vertices] = self.of_pairs(pairs, part(progress, 0, share), digits="all")
        if len(others):
            distances[others] = self._of_places(u.select(others), v.select(others), part(progress, share, 1))
        return distances

    def _of_places(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """Return (k,) distances of pairs that are apart, and of which one is not a vertex."""
        if not self.is_quadratic:
            raise ParameterError(f"{self.label} is known between vertices only, not at places in faces.")
        squares = squares_of_pairs(u, v, lambda pairs: self.of_pairs(pairs, progress, digits="all"))
        return np.sqrt(np.maximum(squares, 0))

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        """Return (k,) distances of local vertices i and j (k,)."""
        if not self.is_symmetric:
            there = self._one_way(component, i, j, part(progress, 0, 0.5))
            return (there + self._one_way(component, j, i, part(progress, 0.5, 1))) / 2
        return self._one_way(component, *by_source(i, j), progress)

    def _one_way(
        self, component: Component, sources: IntArray, targets: IntArray, progress: Progress | None
    ) -> FloatArray:
        columns = partial(self.compute_columns, component)
        return pairs_by_columns(columns, len(component.vertices), sources, targets, progress)


def pairs_by_columns(
    columns: Callable[[IntArray, Progress | None], FloatArray],
    n: int,
    sources: IntArray,
    targets: IntArray,
    progress: Progress | None,
) -> FloatArray:
    """Return (k,) distances from sources (k,) to targets (k,) out of fields of n vertices, some at a time.

    `columns(index, progress)` returns the fields (n, c) from the sources `index` (c,).
    """
    among, place = np.unique(sources, return_inverse=True)
    order = np.argsort(place, kind="stable")
    distances, step = np.empty(len(sources)), block_size(n)
    for report, start, some in blocks(progress, among, step):
        fields = columns(some, report)
        mine = order[slice(*np.searchsorted(place, [start, start + step], sorter=order))]
        distances[mine] = fields[targets[mine], place[mine] - start]
    return distances


def by_source(i: IntArray, j: IntArray) -> tuple[IntArray, IntArray]:
    """Return the pairs (k,), (k,) with the vertex first that more pairs have, so that few fields have all pairs."""
    count = np.bincount(np.concatenate([i, j]))
    swap = (count[j] > count[i]) | ((count[j] == count[i]) & (j < i))
    return np.where(swap, j, i), np.where(swap, i, j)
