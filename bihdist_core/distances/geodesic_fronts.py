"""Fronts that spread over a surface from their sources by the compiled kernel, exact or not."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import nullcontext
from typing import ClassVar, Generic, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..expected_time import Expected
from ..kernel import library as kernel
from ..progress import Progress
from ..scalars import real_number
from ..solver.worker_threads import WORKERS, Job, without_workers
from ..sources.pieces import Pieces
from ..surface import Surface
from .place_pairs import by_start
from .unfolding_mesh import Places, unfolding_mesh

FEW_TARGETS = 20
"""Targets of a source up to which a front goes only as far as these; more of them cost more than the whole field."""


class Reached(Protocol):
    """What a front has reached: distances (n,) of all vertices, and at_places (k,) of the places asked for."""

    @property
    def distances(self) -> FloatArray: ...
    @property
    def at_places(self) -> FloatArray: ...


Field = TypeVar("Field", bound=Reached)


class GeodesicFront(ABC, Generic[Field]):
    """Distances on one surface of any kind by a front that spreads from sources; used by any number of threads.

    `expected` is the work of a whole field, as much as the last one took or a trial has it; None before.

    Raises SolverError without the compiled kernel.
    """

    name: ClassVar[str]
    work: ClassVar[str]
    work_per_vertex: ClassVar[float]
    """What progress counts, and how much of it there usually is for a vertex."""

    def __init__(self, surface: Surface) -> None:
        if kernel.library() is None:
            why = kernel.why_plain()
            words = f"needs the compiled kernel{f' ({why})' if why else ''}; use the heat method."
            raise SolverError(f"{self.name.capitalize()} distance {words}")
        self.surface = surface
        self.expected: float | None = None
        self._mesh = unfolding_mesh(surface)

    def distances(
        self,
        sources: npt.ArrayLike | Pieces,
        progress: Progress | None = None,
        *,
        radius: float = np.inf,
        offsets: npt.ArrayLike | None = None,
    ) -> FloatArray:
        """Return (n,) distances from a vertex, the nearest of several (k,), or of pieces of faces, in the mesh's length
        unit.

        NaN where no way leads, inf beyond the radius; see `field` for the rest.
        """
        return self.field(sources, None, progress, radius=radius, offsets=offsets).distances

    def places(
        self,
        sources: npt.ArrayLike | Pieces,
        places: Pieces,
        progress: Progress | None = None,
        *,
        radius: float = np.inf,
        offsets: npt.ArrayLike | None = None,
    ) -> FloatArray:
        """Return (k,) distances of places in faces; see `field`."""
        return self.field(sources, places, progress, radius=radius, offsets=offsets).at_places

    def between(self, u: Pieces, v: Pieces, progress: Progress | None = None, *, radius: float = np.inf) -> FloatArray:
        """Return (k,) distances of k pairs of points, several sources at a time; NaN where no way leads.

        Beyond the radius they are inf.  Raises ParameterError for a radius that is no length; Cancelled if the progress
        raises it, within 0.1 s.
        """
        is_fewer = len(list(by_start(u))) <= len(list(by_start(v)))
        ends = (u, v) if is_fewer else (v, u)
        return self.from_starts(*ends, progress, radius=radius)

    def from_starts(
        self, u: Pieces, v: Pieces, progress: Progress | None = None, *, radius: float = np.inf
    ) -> FloatArray:
        """Return (k,) distances of k pairs of points as `between`, by a front from each different u."""
        check_radius(radius)
        groups, found = list(by_start(u)), np.empty(len(u))

        def one(number: int, watch: kernel.Watch) -> None:
            start, mine = groups[number]
            goals = self._mesh.at_pieces(v.select(mine))
            field = self._field(self._mesh.at_pieces(start), goals, watch, radius=radius, targets_only=True)
            found[mine] = field.at_places

        self._in_workers(one, len(groups), progress)
        return found

    def of_pairs(
        self, sources: IntArray, targets: IntArray, progress: Progress | None = None, *, radius: float = np.inf
    ) -> FloatArray:
        """Return (k,) distances from vertices (k,) to vertices (k,), NaN where no way leads, inf beyond the radius;
        several sources at a time.

        Windows go only as far as the targets of a source, where these are few: near ones take little time.
        """
        among, place = np.unique(sources, return_inverse=True)
        groups = np.split(np.argsort(place, kind="stable"), np.cumsum(np.bincount(place))[:-1])
        found = np.empty(len(sources))

        def one(number: int, watch: kernel.Watch) -> None:
            start = self._mesh.at_vertices(among[number : number + 1])
            there = targets[groups[number]]
            if len(there) > FEW_TARGETS:
                found[groups[number]] = self._field(start, None, watch, radius=radius).distances[there]
            else:
                goals = self._mesh.at_vertices(there)
                found[groups[number]] = self._field(start, goals, watch, radius=radius, targets_only=True).at_places

        self._in_workers(one, len(among), progress)
        return found

    def columns(
        self, vertices: npt.ArrayLike, progress: Progress | None = None, *, radius: float = np.inf
    ) -> FloatArray:
        """Return (n, k) distances from each of k vertices, several at a time; see `field` for the radius and errors."""
        check_radius(radius)
        ids = self.surface.check_vertices(vertices)
        found = np.empty((len(self.surface.vertices), len(ids)))

        def one(column: int, watch: kernel.Watch) -> None:
            start = self._mesh.at_vertices(ids[column : column + 1])
            found[:, column] = self._field(start, None, watch, radius=radius).distances

        self._in_workers(one, len(ids), progress, radius == np.inf)
        return found

    def _in_workers(
        self, one: Callable[[int, kernel.Watch], None], count: int, progress: Progress | None, is_whole: bool = False
    ) -> None:
        """Run the work in the workers; with `is_whole` each item is a whole field, whose duration is known."""
        expected = count * (self.expected or self.work_per_vertex * len(self.surface.vertices))
        with Expected(self.work, expected, min(count, WORKERS), progress) as it:
            job = Job(it.progress if is_whole else progress, self.name, expected)

            def by_itself(number: int) -> None:
                with nullcontext() if count == 1 else without_workers():
                    one(number, job.watch)

            job.run(by_itself, range(count))
            job.finish()
            it.done = job.watch.done if is_whole else 0  # of less, most is beginnings and ends

    def field(
        self,
        sources: npt.ArrayLike | Pieces,
        places: Pieces | None = None,
        progress: Progress | None = None,
        *,
        radius: float = np.inf,
        offsets: npt.ArrayLike | None = None,
        **how: bool,
    ) -> Field:
        """Return distances from vertices or pieces of faces, also at places in faces.

        Parameters
        ----------
        sources : int, (k,) array_like or Pieces
            Vertices, or pieces of faces. The distance is that from the nearest.
        places : Pieces, optional
            Points whose distances are wanted, too.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        radius : float
            How far to go, in the mesh's length unit.
        offsets : (k,) array_like, optional
            The distance at each source, 0 by default.
        **how : bool
            What only some fronts know: ``everything`` of the exact one leaves nothing out, for tests on small meshes.

        Returns
        -------
        Reached
            The distances, and the paths to all if the front knows them.

        Raises
        ------
        VertexError
            For a bad id.
        ParameterError
            For a radius or offsets that are no numbers.
        SolverError
            If the front gives up.
        Cancelled
            If the progress raises it, within 0.1 s.
        """
        check_radius(radius)
        if isinstance(sources, Pieces):
            count, starts = len(sources), self._mesh.at_pieces(sources)
        else:
            ids = self.surface.check_vertices(sources)
            count, starts = len(ids), self._mesh.at_vertices(ids)
        shifts = np.zeros(count) if offsets is None else np.asarray(offsets, np.float64)
        if shifts.shape != (count,) or not np.isfinite(shifts).all():
            raise ParameterError(f"Offsets are {count} finite numbers, one for each source.")
        shifts = shifts[starts.rows]
        goals = None if places is None else self._mesh.at_pieces(places)
        fields: list[Field] = []

        def one(_: int, watch: kernel.Watch) -> None:
            fields.append(self._field(starts, goals, watch, shifts, radius, **how))

        self._in_workers(one, 1, progress, radius == np.inf and not how)
        return fields[0]

    @abstractmethod
    def _field(
        self,
        starts: Places,
        goals: Places | None,
        watch: kernel.Watch,
        offsets: FloatArray | None = None,
        radius: float = np.inf,
        *,
        targets_only: bool = False,
    ) -> Field:
        """Return what is reached from places in the kernel's mesh."""

    def _lengths(self, reached: FloatArray, radius: float) -> FloatArray:
        """Return (n + k,) distances for those of the kernel's vertices and of k places, in its unit."""
        mesh = self._mesh
        found: FloatArray = np.concatenate([reached[mesh.number], reached[mesh.vertices :]])
        found[found > radius / mesh.unit] = np.inf
        if radius == np.inf:
            found[np.isinf(found)] = np.nan
        found *= mesh.unit
        return found


def check_radius(radius: float) -> None:
    """Raises ParameterError for a radius that is no length, 0 or more, in any unit."""
    if not real_number(radius, "A radius") >= 0:
        raise ParameterError(f"A radius is a length of at least 0, not {radius}.")
