"""What every distance has in common: the same four questions, answered per connected component."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..laplacian import Component, Laplacian, as_laplacian
from ..memo import Memo
from ..progress import Progress, part, silent
from ..sources.pieces import Pieces, pieces_of, points_on
from ..sources.source import BoundaryLoop, Curve, Source, SourceSet, SurfacePoint, checked_source
from ..sources.words import short_words_of
from ..surface import MeshLike
from .accuracy import POOR, ErrorEstimate, accurate_to, rounded_up
from .in_faces import blocks, squares_from
from .place_pairs import Pair, are_of_places, are_same, has_places, squares_of_pairs

ROUNDING = 1e-7
"""Squared distances below zero by less than this share of their terms are rounding; more is a broken operator."""

SOURCES = 32
"""From so many sources at a time pairs are computed, which bounds the memory."""

BLOCK = 1 << 23
"""How many distances of fields are held at a time besides those that are wanted."""

DIGITS = ("field", "all")
"""How many digits distances of pairs may have (`Distance.of_pairs`)."""

ELSEWHERE = SurfacePoint | BoundaryLoop | Curve | SourceSet
"""Sources that are no vertex."""


class Distance(ABC):
    """A distance between the vertices of a surface.

    `identity` is the spec it was made from, in full, if any.  `label` says what it is and how it was computed;
    `length_power` how it scales: a surface s times as large has distances s ** length_power times as large.  Distances
    between components, and of vertices that belong to no face, are NaN.  A vertex asked for that does not exist or
    belongs to no face is a VertexError.

    It is constructed from a Laplacian, whose work distances share, or from any mesh that `Surface.of` takes.
    Constructing a distance does its long work on the largest component; on another, the first question does.  Pickled,
    it is what it was constructed from, and the first question there does the work again; `Laplacian.pickles_factors`
    lets factors and eigenpairs travel with it.
    """

    label: str
    length_power: float
    identity = ""
    is_symmetric = True
    is_quadratic = False
    """Whether squares are a quadratic form of differences of unit vectors, which is defined anywhere in a face."""

    def __init__(self, laplacian: Laplacian | MeshLike, faces: npt.ArrayLike | None = None) -> None:
        self.laplacian = as_laplacian(laplacian, faces)
        self.surface = self.laplacian.surface
        self._asked: set[int] = set()
        self._accuracies: Memo[int, float | None] = Memo()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.label}, on {self.surface!r})"

    @property
    def unit(self) -> str:
        """The unit of the values, in words: how they scale with the surface."""
        known = {1.0: "mesh units", 0.0: "no unit", -1.0: "1 / mesh units"}
        return known.get(self.length_power, f"mesh units^{self.length_power:g}")

    @property
    def accuracy(self) -> float | None:
        """How far a field may be from what `label` says, as a fraction of its maximum: an estimate on the safe side.

        It holds for the components that were asked about (the largest, if none was) and is made when first wanted,
        in less than a tenth of the time the distance took to construct.  None for geodesic distances.
        """
        return self._accuracy_of(self._those(None))

    def _those(self, components: Sequence[int] | None) -> Sequence[int]:
        """Numbers of components: these, or those that were asked about, or else the largest."""
        return (sorted(self._asked) or [0]) if components is None else components

    def _accuracy_of(self, components: Sequence[int]) -> float | None:
        known = [self._accuracy_on(self.laplacian.components[index]) for index in components]
        return None if None in known else max(a for a in known if a is not None)

    def takes_long(self, progress: Progress | None = None) -> bool:
        """Whether a source takes more than some 5 s, so that something quicker is worth showing meanwhile."""
        return False

    def error_estimate(self, components: Sequence[int] | None = None) -> ErrorEstimate:
        """The accuracy in words, on components with these numbers, or on those that were asked about.

        SolverError if it is worse than a thousandth: then answers there should not be used.
        """
        components = self._those(components)
        accuracy = self._accuracy_of(components)
        if accuracy is None:
            return ErrorEstimate()
        if accuracy > POOR:
            off = "by any amount" if accuracy == np.inf else f"by {rounded_up(accuracy)} of its maximum"
            raise SolverError(
                f"{self.label} on {self.surface.name} may be off {off}, so it is not given. {self._remedy(components)}"
            )
        return ErrorEstimate.of(accuracy, self._said_of(accuracy, components))

    def _said_of(self, accuracy: float, components: Sequence[int]) -> str:
        """The accuracy in words, with what it is the accuracy of where that is not the distance itself."""
        return accurate_to(accuracy)

    def is_judged(self, component: int) -> bool:
        """Whether the accuracy on a component is known, so that `error_estimate` costs nothing."""
        return component in self._accuracies

    def _remedy(self, components: Sequence[int]) -> str:
        """What would help where the accuracy on these components is too poor: a sentence."""
        mine = np.isin(self.surface.component_of_vertex[self.surface.faces[:, 0]], components)
        heights = np.where(mine, self.surface.face_heights, np.inf)
        flattest = int(heights.argmin())
        return (
            f"Its faces are too thin, or differ too much in size (face {flattest} is {heights[flattest]:.0e} of its "
            "longest side high); remeshing would help."
        )

    def _accuracy_on(self, component: Component) -> float | None:
        if component.index not in self._accuracies:
            self.prepare(component)
            # Where numbers end, the estimate is infinite.
            with np.errstate(all="ignore"):
                accuracy = self._estimated_accuracy(component)
            self._accuracies[component.index] = np.inf if accuracy is not None and np.isnan(accuracy) else accuracy
        return self._accuracies[component.index]

    def _estimated_accuracy(self, component: Component) -> float | None:
        """`accuracy` on one component."""
        return None

    def from_source(self, source: Source | str, progress: Progress | None = None) -> FloatArray:
        """(n,) distance of every vertex from a source; 0 at vertices that belong to it, NaN where it does not reach.

        A vertex or any other source, or its words (`sources`).  From several the distance is that from the nearest;
        along a boundary loop or a curve, from its nearest point where the distance can be had anywhere in a face.
        Raises VertexError or ParameterError for a source that is not on this surface, and ParameterError for one that
        this distance cannot start from.
        """
        if isinstance(source, str):
            source = checked_source(source)
        if not isinstance(source, ELSEWHERE):
            return self._from_vertex(source, progress)
        return self.from_pieces(pieces_of(source, self.surface), progress)

    def _from_vertex(self, vertex: int, progress: Progress | None) -> FloatArray:
        component = self.laplacian.component_of(vertex)
        self._asked.add(component.index)
        self.prepare(component, progress)
        field = self._columns(component, component.local(np.array([vertex])), progress)[:, 0]
        if len(field) < len(self.surface.vertices):
            inside, field = field, np.full(len(self.surface.vertices), np.nan)
            field[component.vertices] = inside
        field[vertex] = 0
        return field

    def label_from(self, pieces: Pieces) -> str:
        """`label`, with what there is to say of fields that start from some pieces of the surface."""
        return self.label

    def from_pieces(self, pieces: Pieces, progress: Progress | None = None) -> FloatArray:
        """(n,) distances of every vertex from the nearest of some pieces of this surface."""
        field = np.full(len(self.surface.vertices), np.nan)
        for component, mine in self._by_component(pieces.corners[:, 0]):
            self.prepare(component, progress)
            some = pieces.some(mine)
            field[component.vertices] = self._from_pieces(component, some, progress)
        for weights in (pieces.start, pieces.stop):
            field[pieces.corners[weights == 1]] = 0
        return field

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        """(m,) distances within a component, from pieces in the whole surface's numbers."""
        vertices = pieces.vertices
        if vertices is None and not self.is_quadratic:
            raise ParameterError(
                f"{self.label} is known between vertices only; let it start from some, such as 12 or 12+40+7."
            )
        least = np.full(len(component.vertices), np.inf)
        if vertices is not None:
            starts = range(0, len(vertices), SOURCES)
            for number, start in enumerate(starts):
                step = part(progress, number / len(starts), (number + 1) / len(starts))
                index = component.local(vertices[start : start + SOURCES])
                np.minimum(least, self._columns(component, index, step).min(axis=1), out=least)
            return least
        groups, size = blocks(pieces, SOURCES), 0.0
        for number, group in enumerate(groups):
            (progress or silent)(number / len(groups), self.label)
            some = pieces.some(group)
            index, local = np.unique(component.local(some.touched), return_inverse=True)
            squares = self._columns(component, index, None) ** 2
            size = max(size, float(squares.max()))
            among = self._pairwise(component, index) ** 2
            each = squares_from(squares, (among + among.T) / 2, index, local.reshape(-1, 3), some)
            for one in each:
                np.minimum(least, one, out=least)
        # What is nearest may be at no distance everywhere.
        return root(least, size)

    def from_sources(
        self,
        sources: npt.ArrayLike | Sequence[Source | str],
        progress: Progress | None = None,
        *,
        dtype: npt.DTypeLike = np.float64,
        out: AnyArray | None = None,
    ) -> AnyArray:
        """(n, k) distances of every vertex from each of k vertices, or sources of any kind.

        dtype: float64 or float32, of the array that is made.  out: an array (n, k) of either that takes them, such as a
        memory map, and is returned; then and in float32 only some fields at a time are in memory besides.  Raises
        VertexError or ParameterError for a source as `from_source` does, ParameterError for another shape or type.
        """
        (progress or silent)(0.0, self.label)
        n = len(self.surface.vertices)
        if isinstance(sources, Sequence) and any(isinstance(each, str | ELSEWHERE) for each in sources):
            fields = _room(out, (n, len(sources)), dtype)
            for k, each in enumerate(sources):
                fields[:, k] = self.from_source(each, part(progress, k / len(sources), (k + 1) / len(sources)))
            return fields
        ids = self.surface.check_vertices(np.asarray(sources))
        is_whole = self.surface.largest_component_size == n
        if is_whole and out is None and np.dtype(dtype) == np.float64 and len(ids):
            [(_, _, fields)] = self.columns_by_component(ids, progress)
            return fields
        fields, step = _room(out, (n, len(ids)), dtype), max(SOURCES, BLOCK // n)
        for start in range(0, len(ids), step):
            some = ids[start : start + step]
            if not is_whole:
                fields[:, start : start + step] = np.nan
            report = part(progress, start / len(ids), (start + len(some)) / len(ids))
            for component, mine, columns in self.columns_by_component(some, report):
                fields[np.ix_(component.vertices, start + mine)] = columns
        return fields

    def columns_by_component(
        self, sources: npt.ArrayLike, progress: Progress | None = None
    ) -> Iterator[tuple[Component, IntArray, FloatArray]]:
        """For each component with some of the source vertices (k,): itself, which of them (c,), and their fields.

        Fields are (m, c), for the m vertices of the component only.
        """
        ids = self.surface.check_vertices(np.asarray(sources))
        for component, mine in self._by_component(ids):
            self.prepare(component, progress)
            index = component.local(ids[mine])
            columns = self._columns(component, index, progress)
            columns[index, np.arange(len(index))] = 0
            yield component, mine, columns

    def between(self, u: Source | str, v: Source | str) -> float:
        """The distance of two vertices, or places in faces; NaN between components.

        One of them may be any source if the other is a vertex.  ParameterError for what this distance does not know.
        """
        u, v = (checked_source(each) if isinstance(each, str) else each for each in (u, v))
        are_single = [isinstance(each, SurfacePoint) or not isinstance(each, ELSEWHERE) for each in (u, v)]
        if all(are_single):
            return float(self.pairwise([u, v])[0, 1])
        if not isinstance(v, ELSEWHERE):
            return float(self.from_source(u)[self.surface.check_vertex(v)])
        if not isinstance(u, ELSEWHERE):
            return float(self.from_source(v)[self.surface.check_vertex(u)])
        raise ParameterError(
            f"{self.label} is not known between {short_words_of(u)} and {short_words_of(v)}; let one be a vertex."
        )

    def pairwise(
        self, vertices: npt.ArrayLike | Sequence[Source | str], progress: Progress | None = None
    ) -> FloatArray:
        """(k, k) distances among k vertices, or places in faces: symmetric, zero diagonal."""
        (progress or silent)(0.0, self.label)
        if has_places(vertices):
            points = list(vertices)
            i, j = np.triu_indices(len(points), 1)
            among = points_on(self.surface, points)
            found = np.zeros((len(points), len(points)))
            found[i, j] = found[j, i] = self._of_points(among.some(i), among.some(j), progress)
            return found
        ids = self.surface.check_vertices(np.asarray(vertices))
        distances = np.full((len(ids), len(ids)), np.nan)
        for component, mine in self._by_component(ids):
            block = self._pairwise(component, component.local(ids[mine]), progress)
            distances[np.ix_(mine, mine)] = (block + block.T) / 2
        distances[ids[:, None] == ids] = 0
        return distances

    def of_pairs(
        self, pairs: npt.ArrayLike | Sequence[Pair], progress: Progress | None = None, *, digits: str = "field"
    ) -> FloatArray:
        """(k,) the distances of k pairs of vertices (k, 2), or places in faces; NaN between components.

        digits: "field", as exact as fields are, by one field for all pairs of a vertex where that is less work than a
        solve for each pair; "all": free of cancellation, so that the smallest have all digits, too, by a solve for
        each, where a distance has such a form.  The mean of both ways where a distance is not symmetric.
        ParameterError for another shape, other digits, and for places in faces if this distance knows vertices only.
        """
        if digits not in DIGITS:
            raise ParameterError(f"Digits of pairs are {' or '.join(map(repr, DIGITS))}, not {digits!r}.")
        (progress or silent)(0.0, self.label)
        if are_of_places(pairs):
            u, v = (points_on(self.surface, [pair[side] for pair in pairs]) for side in (0, 1))
            return self._of_points(u, v, progress)
        table = np.asarray(pairs)
        if table.ndim != 2 or table.shape[1] != 2:
            raise ParameterError(f"Pairs of vertices must have shape (k, 2), not {table.shape}.")
        i, j = self.surface.check_vertices(table.ravel()).reshape(-1, 2).T
        distances = np.full(len(i), np.nan)
        label = self.surface.component_of_vertex
        for component, mine in self._by_component(i):
            mine = mine[label[i[mine]] == label[j[mine]]]
            if len(mine):
                self.prepare(component, progress)
                ends = component.local(i[mine]), component.local(j[mine])
                distances[mine] = self._of_pairs(component, *ends, digits, progress)
        distances[i == j] = 0
        return distances

    def _of_points(self, u: Pieces, v: Pieces, progress: Progress | None) -> FloatArray:
        """(k,) distances of pairs of vertices and places in faces."""
        distances = np.zeros(len(u))
        are_vertices = (u.start.max(axis=1) == 1) & (v.start.max(axis=1) == 1)
        others = np.flatnonzero(~are_vertices & ~are_same(u, v))
        share = float(are_vertices.mean()) if len(others) else 1.0
        if are_vertices.any():
            ends = (each.some(are_vertices) for each in (u, v))
            pairs = np.column_stack([each.corners[each.start == 1] for each in ends])
            distances[are_vertices] = self.of_pairs(pairs, part(progress, 0, share), digits="all")
        if len(others):
            distances[others] = self._of_places(u.some(others), v.some(others), part(progress, share, 1))
        return distances

    def _of_places(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """(k,) the same of pairs that are apart, and of which one is no vertex."""
        if not self.is_quadratic:
            raise ParameterError(f"{self.label} is known between vertices only, not at places in faces.")
        squares = squares_of_pairs(u, v, lambda pairs: self.of_pairs(pairs, progress, digits="all"))
        return np.sqrt(np.maximum(squares, 0))

    def _of_pairs(
        self, component: Component, i: IntArray, j: IntArray, digits: str, progress: Progress | None
    ) -> FloatArray:
        """(k,) distances of local vertices i and j (k,)."""
        if not self.is_symmetric:
            there = self._one_way(component, i, j, part(progress, 0, 0.5))
            return (there + self._one_way(component, j, i, part(progress, 0.5, 1))) / 2
        return self._one_way(component, *by_source(i, j), progress)

    def _one_way(
        self, component: Component, sources: IntArray, targets: IntArray, progress: Progress | None
    ) -> FloatArray:
        among, place = np.unique(sources, return_inverse=True)
        order = np.argsort(place, kind="stable")
        distances, step = np.empty(len(sources)), max(SOURCES, BLOCK // len(component.vertices))
        for start in range(0, len(among), step):
            some = among[start : start + step]
            report = part(progress, start / len(among), (start + len(some)) / len(among))
            columns = self._columns(component, some, report)
            mine = order[slice(*np.searchsorted(place, [start, start + step], sorter=order))]
            distances[mine] = columns[targets[mine], place[mine] - start]
        return distances

    @abstractmethod
    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Do the long work that questions about a component need; nothing if it is done."""

    @abstractmethod
    def _columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        """(m, k) distances within a component from its local vertices `index` (k,)."""

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        """(k, k) distances among local vertices `index` (k,)."""
        self.prepare(component, progress)
        found, step = np.empty((len(index), len(index))), max(SOURCES, BLOCK // len(component.vertices))
        for start in range(0, len(index), step):
            some = index[start : start + step]
            report = part(progress, start / len(index), (start + len(some)) / len(index))
            found[:, start : start + step] = self._columns(component, some, report)[index]
        return found

    def _by_component(self, ids: IntArray) -> Iterable[tuple[Component, IntArray]]:
        """Each component with the positions of its vertices among ids (k,)."""
        label = self.surface.component_of_vertex[ids]
        for index in np.unique(label):
            self._asked.add(int(index))
            yield self.laplacian.components[index], np.flatnonzero(label == index)


def by_source(i: IntArray, j: IntArray) -> tuple[IntArray, IntArray]:
    """(k,), (k,): of each pair of vertices first the one that more pairs have, so that few fields have all pairs."""
    count = np.bincount(np.concatenate([i, j]))
    swap = (count[j] > count[i]) | ((count[j] == count[i]) & (j < i))
    return np.where(swap, j, i), np.where(swap, i, j)


def _room(out: AnyArray | None, shape: tuple[int, int], dtype: npt.DTypeLike) -> AnyArray:
    """An array for fields: the one given, if it fits, or a new one."""
    kind = np.dtype(dtype if out is None else out.dtype)
    if kind not in (np.float32, np.float64):
        raise ParameterError(f"Distances are float32 or float64, not {kind}.")
    if out is not None and out.shape != shape:
        raise ParameterError(f"The fields have the shape {shape}, and `out` has {out.shape}.")
    return np.empty(shape, kind) if out is None else out


def root(squares: FloatArray, terms: FloatArray | float) -> FloatArray:
    """Square root of squared distances, computed as sums of `terms` (their size; broadcasts).

    Values below zero by rounding become 0; SolverError if one is further below, or not a number.
    """
    if squares.size and not squares.min() >= -ROUNDING * (terms.max() if isinstance(terms, np.ndarray) else terms):
        worst = float(np.nanmin(squares)) if not np.isnan(squares).all() else float("nan")
        raise SolverError(f"A squared distance came out as {worst:g}: the mesh is too badly shaped for its operator.")
    distances = np.maximum(squares, 0)
    return np.sqrt(distances, out=distances)
