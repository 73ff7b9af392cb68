"""How far all vertices are from a source, or from each of many: answered per connected component."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError
from ..laplacian import Component, Laplacian, as_laplacian
from ..mesh_like import MeshLike, Rows
from ..progress import Progress, blocks, part, silent, steps
from ..sources.pieces import Pieces, pieces_of
from ..sources.source import BoundaryLoop, Curve, Source, SourceSet, SurfacePoint, checked_source
from .in_faces import groups_of_pieces, squares_from
from .squares import root

SOURCES_PER_BLOCK = 32
"""From so many sources at a time pairs are computed, which bounds the memory."""

BLOCK_VALUES = 1 << 22
"""Distances of fields held at a time beside the wanted ones."""

ROWS_PER_WRITE = 1 << 12
"""Vertices whose values are written at a time."""

OtherSource = SurfacePoint | BoundaryLoop | Curve | SourceSet
"""Sources that are no vertex."""


class SourceQuestions(ABC):
    """The questions that a distance answers by fields, one value at each vertex of the surface."""

    label: str
    is_quadratic = False
    """True if squares are a quadratic form of differences of unit vectors, which is defined anywhere in a face."""

    def __init__(self, laplacian: Laplacian | MeshLike | Rows, faces: npt.ArrayLike | None = None) -> None:
        self.laplacian = as_laplacian(laplacian, faces)
        self.surface = self.laplacian.surface
        self._asked: set[int] = set()

    @abstractmethod
    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Do the long work that questions about a component need, if it is not done.

        Parameters
        ----------
        component : Component
            A component of `laplacian`.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        """

    @abstractmethod
    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        """Compute fields within a component; what a distance of your own has to define.

        Parameters
        ----------
        component : Component
            A component with m vertices, prepared before.
        index : (k,) int64 ndarray
            Local numbers of the source vertices.
        progress : callable or None
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (m, k) float64 ndarray
            Distances of the component's vertices from each source, 0 at the source itself but for rounding.
        """

    def from_source(self, source: Source | str, progress: Progress | None = None) -> FloatArray:
        """Compute the distance from one source to every vertex.

        Parameters
        ----------
        source : int, str or Source
            A vertex id, another source, or its words: ``"12+40"``, ``"f311:0.2,0.5"``, ``"loop:0"``.  From several
            points the distance is that from the nearest; along a boundary loop or a curve from its nearest point, where
            the distance is defined anywhere in a face.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n,) float64 ndarray
            In the distance's unit; 0 at vertices that belong to the source, NaN where it does not reach.

        Raises
        ------
        VertexError, ParameterError
            For a source that is not on this surface, or that this distance cannot start from.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> field = distance.from_source(12)
        >>> field.shape, float(field[12]), float(distance.from_source("12+40")[40])
        ((642,), 0.0, 0.0)
        """
        (progress or silent)(0.0, self.label)
        if isinstance(source, str):
            source = checked_source(source)
        if not isinstance(source, OtherSource):
            return self._from_vertex(source, progress)
        return self.from_pieces(pieces_of(source, self.surface), progress)

    def _from_vertex(self, vertex: int, progress: Progress | None) -> FloatArray:
        component = self.laplacian.component_of(vertex)
        self._asked.add(component.index)
        progress = self._prepared(component, progress)
        field = self.compute_columns(component, component.local(np.array([vertex])), progress)[:, 0]
        if len(field) < len(self.surface.vertices):
            inside, field = field, np.full(len(self.surface.vertices), np.nan)
            field[component.vertices] = inside
        field[vertex] = 0
        return field

    def label_from(self, pieces: Pieces) -> str:
        """Return `label`, with what there is to say of fields from these pieces.

        Parameters
        ----------
        pieces : Pieces
            What the fields start from.

        Returns
        -------
        str
            For a heading.
        """
        return self.label

    def from_pieces(self, pieces: Pieces, progress: Progress | None = None) -> FloatArray:
        """Compute the distance of every vertex from the nearest of some pieces of this surface.

        Parameters
        ----------
        pieces : Pieces
            Points in faces and straight segments in faces.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        (n,) float64 ndarray
            In the distance's unit, NaN in components without a piece.

        Raises
        ------
        ParameterError
            If this distance is known between vertices only.
        """
        field = np.full(len(self.surface.vertices), np.nan)
        for component, mine, step in self._by_component(pieces.corners[:, 0], progress):
            step = self._prepared(component, step)
            some = pieces.select(mine)
            field[component.vertices] = self._from_pieces(component, some, step)
        for weights in (pieces.start, pieces.stop):
            field[pieces.corners[weights == 1]] = 0
        return field

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        """Return (m,) distances within a component, from pieces in the whole surface's numbers."""
        vertices = pieces.vertices
        if vertices is None and not self.is_quadratic:
            raise ParameterError(
                f"{self.label} is known between vertices only; start from vertices, such as 12 or 12+40+7."
            )
        least = np.full(len(component.vertices), np.inf)
        if vertices is not None:
            for step, start in steps(progress, range(0, len(vertices), SOURCES_PER_BLOCK)):
                index = component.local(vertices[start : start + SOURCES_PER_BLOCK])
                np.minimum(least, self.compute_columns(component, index, step).min(axis=1), out=least)
            return least
        size = 0.0
        for step, group in steps(progress, groups_of_pieces(pieces, SOURCES_PER_BLOCK)):
            step(0.0, self.label)
            some = pieces.select(group)
            index, local = np.unique(component.local(some.touched), return_inverse=True)
            squares = self.compute_columns(component, index, step) ** 2
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
        """Compute the distances from each of several sources to every vertex.

        Parameters
        ----------
        sources : (k,) array_like of int, or sequence of Source
            Vertex ids, or sources of any kind.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        dtype : dtype
            The type of the array that is made: float64 or float32.
        out : (n, k) ndarray, optional
            An array of either type that takes the fields, such as a memory map.  With it, or in float32, only some
            fields at a time are held in memory besides.

        Returns
        -------
        (n, k) float64 or float32 ndarray
            A field in each column, in the distance's unit; `out` if it was given.

        Raises
        ------
        VertexError, ParameterError
            For a source as in `from_source`, and for an `out` or a type that cannot take the fields.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> fields = distance.from_sources([0, 12, 40])
        >>> fields.shape
        (642, 3)
        >>> bool((fields.min(axis=1) == distance.from_source("0+12+40")).all())
        True
        """
        (progress or silent)(0.0, self.label)
        n, kind = len(self.surface.vertices), _checked_type(out, dtype)
        if isinstance(sources, Sequence) and any(isinstance(each, str | OtherSource) for each in sources):
            fields = _room(out, (n, len(sources)), kind)
            for k, (report, each) in enumerate(steps(progress, sources)):
                fields[:, k] = self.from_source(each, report)
            return fields
        ids = self.surface.check_vertices(sources)
        is_whole = self.surface.largest_component_size == n
        if is_whole and out is None and kind == np.float64 and len(ids):
            [(_, _, fields)] = self.columns_by_component(ids, progress)
            return fields
        fields, step = _room(out, (n, len(ids)), kind), block_size(n)
        for report, start, some in blocks(progress, ids, step):
            if not is_whole:
                fields[:, start : start + step] = np.nan
            done = 0
            for component, mine, columns in self.columns_by_component(some, report):
                done += len(mine)
                into = slice(start, start + len(some)) if len(mine) == len(some) else start + mine
                # Into new memory or a file, where it takes as long as to compute them.
                for first in range(0, len(columns), ROWS_PER_WRITE):
                    report(done / len(some), self.label)
                    some_rows = slice(first, first + ROWS_PER_WRITE)
                    rows = component.vertices[some_rows]
                    if is_whole:
                        fields[some_rows, into] = columns[some_rows]
                    else:
                        fields[(rows, into) if isinstance(into, slice) else np.ix_(rows, into)] = columns[some_rows]
        return fields

    def columns_by_component(
        self, sources: npt.ArrayLike, progress: Progress | None = None
    ) -> Iterator[tuple[Component, IntArray, FloatArray]]:
        """Compute the fields of source vertices, component by component.

        Parameters
        ----------
        sources : (k,) array_like of int
            Vertex ids.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Yields
        ------
        component : Component
            Each component that holds some of the sources.
        which : (c,) int64 ndarray
            The positions of these among the sources.
        fields : (m, c) float64 ndarray
            Their distances to the m vertices of the component.
        """
        ids = self.surface.check_vertices(sources)
        for component, mine, step in self._by_component(ids, progress):
            step = self._prepared(component, step)
            index = component.local(ids[mine])
            columns = self.compute_columns(component, index, step)
            columns[index, np.arange(len(index))] = 0
            yield component, mine, columns

    def _pairwise(self, component: Component, index: IntArray, progress: Progress | None = None) -> FloatArray:
        """Return (k, k) distances among local vertices `index` (k,)."""
        progress = self._prepared(component, progress)
        found, step = np.empty((len(index), len(index))), block_size(len(component.vertices))
        for report, start, some in blocks(progress, index, step):
            found[:, start : start + step] = self.compute_columns(component, some, report)[index]
        return found

    def _prepared(self, component: Component, progress: Progress | None) -> Progress:
        """Prepare a component; the progress of what follows, which is all of it where nothing was left to do."""
        begun = 0.0

        def first_half(fraction: float, text: str) -> None:
            nonlocal begun
            begun = 0.5
            report(fraction / 2, text)

        report = part(progress, 0, 1)
        self.prepare(component, silent if report is silent else first_half)
        return part(report, begun, 1)

    def _by_component(
        self, ids: IntArray, progress: Progress | None = None
    ) -> Iterator[tuple[Component, IntArray, Progress]]:
        """Yield each component with the positions of its vertices among ids (k,), and the progress of its share of
        them."""
        label, done = self.surface.component_of_vertex[ids], 0
        for index in np.unique(label):
            self._asked.add(int(index))
            mine = np.flatnonzero(label == index)
            step = part(progress, done / len(ids), (done + len(mine)) / len(ids))
            yield self.laplacian.components[index], mine, step
            done += len(mine)


def block_size(n: int) -> int:
    """Return from how many sources fields of n vertices are held at a time."""
    return max(SOURCES_PER_BLOCK, BLOCK_VALUES // n)


def _room(out: AnyArray | None, shape: tuple[int, int], dtype: np.dtype[Any]) -> AnyArray:
    """Return an array for fields: the one given, if it fits, or a new one."""
    if out is not None and out.shape != shape:
        raise ParameterError(f"The fields have the shape {shape}, and `out` has {out.shape}.")
    return np.empty(shape, dtype) if out is None else out


def _checked_type(out: AnyArray | None, dtype: npt.DTypeLike) -> np.dtype[Any]:
    """Return the type of fields; ParameterError for an array or a type that cannot hold distances."""
    if not (out is None or isinstance(out, np.ndarray)):
        raise ParameterError(f"Fields are written into an array, not into {type(out).__name__}.")
    if out is not None and not out.flags.writeable:
        raise ParameterError("Fields cannot be written into `out`, which is read-only.")
    try:
        kind = np.dtype(dtype if out is None else out.dtype)
    except TypeError:
        raise ParameterError(f"Distances are float32 or float64, not {dtype!r}.") from None
    if kind not in (np.float32, np.float64):
        raise ParameterError(f"Distances are float32 or float64, not {kind}.")
    return kind
