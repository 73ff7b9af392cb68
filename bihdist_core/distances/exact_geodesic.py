"""Exact geodesic distance on any surface, by windows that unfold from face to face (`kernel/geodesic.h`)."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from queue import Empty, SimpleQueue
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..expected_time import Expected
from ..kernel import library as kernel
from ..progress import Progress, part
from ..scalars import real_number
from ..solver.worker_threads import WORKERS, Job
from ..sources.pieces import Pieces
from ..surface import Surface
from .path_search import PathSearch
from .place_pairs import by_start
from .unfolding_mesh import Places, UnfoldingMesh

MOST_WINDOWS_PER_VERTEX, MOST_WINDOWS_AT_LEAST = 2_000, 200_000
"""Windows that a run may take: usually there are 20 to 200 for a vertex, and 5 to 8 million a second."""

USUAL_WINDOWS_PER_VERTEX = 40
"""Windows for a vertex that progress expects before the first run."""

FEW_TARGETS = 20
"""Targets of a source up to which windows go only as far as these; more of them cost more than the whole field."""

FIRST_WINDOWS = 4_096
"""Windows for which there is room at first; it doubles when they are more."""

LENGTH_TOLERANCE = 1e-12
"""Of the largest distance: a path is as long as its distance up to this."""


@dataclass(frozen=True, eq=False)
class FacePath:
    """A path in p pieces, each straight in its face, from the place it was asked for back to the source.

    Attributes
    ----------
    faces : (p,) ndarray
        The faces of the pieces.
    begins, ends : (p, 3) ndarray
        The weights of both ends of each piece at the corners of its face.
    """

    faces: IntArray
    begins: FloatArray
    ends: FloatArray

    def reversed(self) -> FacePath:
        """Return the path from the source."""
        return FacePath(self.faces[::-1], self.ends[::-1], self.begins[::-1])


class _Kept(NamedTuple):
    """The arrays that a run has read and written.

    `offsets` (k,) are those of the sources, `reached` (vertices + places,) is of `REACHED`, and `rest` holds the other
    arrays that the run points to.
    """

    starts: Places
    goals: Places | None
    offsets: FloatArray
    reached: AnyArray
    rest: list[Any]


class GeodesicField:
    """Exact geodesic distances from one source, and the ways they take.

    `distances` (n,) are those of all vertices, `at_places` (k,) those of the places asked for, in the mesh's length
    unit; NaN where no way leads, inf beyond the radius. `windows` counts the windows that were taken up.
    """

    def __init__(self, mesh: UnfoldingMesh, run: kernel.Run, kept: _Kept, distances: FloatArray) -> None:
        n = len(mesh.number)
        self._mesh, self._run, self._kept = mesh, run, kept
        self.windows = run.taken
        self.distances, self.at_places = distances[:n], distances[n:]

    def path(self, vertex: int) -> FacePath:
        """Return the shortest path from a vertex back to the source; without pieces at the source itself.

        Raises VertexError for a bad vertex, ParameterError where the source does not reach.
        """
        vertex = self._mesh.surface.check_vertex(vertex)
        return self._path(int(self._mesh.number[vertex]), f"vertex {vertex}")

    def path_to_place(self, number: int) -> FacePath:
        """Return the shortest path from the place with this number among those asked for."""
        if not 0 <= number < len(self.at_places):
            raise ParameterError(f"There is no place {number}; {len(self.at_places)} were asked for.")
        return self._path(self._mesh.vertices + number, f"place {number}")

    def _path(self, target: int, words: str) -> FacePath:
        lib, room = kernel.library(), 64
        while True:
            faces, begins, ends = np.empty(room, np.int32), np.empty((room, 3)), np.empty((room, 3))
            count = lib.bih_geodesic_path(ctypes.byref(self._run), target, room, faces, begins, ends)
            if count != kernel.NO_ROOM:
                break
            room *= 4
        if count == kernel.OUTSIDE:
            raise ParameterError(f"No path from the source to {words} of {self._mesh.surface.name} is known.")
        found = None if count < 0 else (faces[:count], begins[:count], ends[:count])
        if found is None or not self._is_as_long(target, *found):
            found = self._searched(target)
        if found is None:
            raise SolverError(f"The path to {words} of {self._mesh.surface.name} was lost.")
        return FacePath(*self._mesh.outside(*found))

    @cached_property
    def _largest(self) -> float:
        lengths = self._kept.reached["distance"]
        return float(lengths[np.isfinite(lengths)].max())

    def _is_as_long(self, target: int, faces: AnyArray, begins: FloatArray, ends: FloatArray) -> bool:
        """Return whether a path in the kernel's faces is as long as the distance says, less the offset of a source."""
        side, way = self._mesh.sides[3 * faces], ends - begins
        x, y = way[:, 1] * side["length"] + way[:, 2] * side["x"], way[:, 2] * side["y"]
        excess = np.hypot(x, y).sum() - (self._kept.reached["distance"][target] - self._kept.offsets)
        return bool(np.abs(excess).min() <= LENGTH_TOLERANCE * self._largest)

    def _searched(self, target: int) -> tuple[AnyArray, FloatArray, FloatArray] | None:
        """Search for the path in the kernel's faces; None if none is found that is as long as the distance says."""
        mesh, (starts, goals, offsets, reached, _) = self._mesh, self._kept
        lengths, is_start = reached["distance"], reached["rest"][:, 0] < 0
        sources: dict[int, list[int]] = {}
        for number, face in enumerate(starts.faces.tolist()):
            sources.setdefault(face, []).append(number)
        search = PathSearch(
            sides=mesh.sides, first=mesh.first, corner=mesh.corner, distances=lengths, is_start=is_start,
            sources=sources, begins=starts.begin, ends=starts.end, offsets=offsets,
            rounding=LENGTH_TOLERANCE * self._largest / 4,
        )  # fmt: skip
        if target < mesh.vertices:
            pieces = search.from_vertex(target)
        else:
            assert goals is not None
            number = target - mesh.vertices
            place = int(goals.faces[number]), goals.begin[number].tolist()
            pieces = search.from_place(*place, float(lengths[target]))
        if not pieces:
            return None
        numbers, begins, ends = zip(*pieces, strict=True)
        found = np.array(numbers, np.int32), np.array(begins, np.float64), np.array(ends, np.float64)
        return found if self._is_as_long(target, *found) else None


class ExactGeodesic:
    """Exact geodesic distances on one surface of any kind; paths lead through vertices and edges that faces share.

    Made once and used by any number of threads.  It takes some 0.3 kB a vertex, and a run 0.3 kB more.  Edges and
    heights shorter than 2e-13 of the longest edge of their face count as 0.  Held to a reference in 70 digits: right to
    rounding, and to 1e-12 of the maximum where there are such faces.

    Raises SolverError without the compiled kernel.
    """

    def __init__(self, surface: Surface) -> None:
        if kernel.library() is None:
            why = kernel.why_plain()
            words = f"needs the compiled kernel{f' ({why})' if why else ''}; use the heat method."
            raise SolverError(f"Exact geodesic distance {words}")
        self.surface = surface
        self._mesh = UnfoldingMesh(surface)
        self._free: SimpleQueue[_Workspace] = SimpleQueue()
        self.expected: float | None = None
        """Windows of a whole field: as many as the last one took, or as a trial has it."""

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
        check_radius(radius)
        rows = [list(by_start(each)) for each in (u, v)]
        here, there = (u, v) if len(rows[0]) <= len(rows[1]) else (v, u)
        groups = rows[here is v]
        found = np.empty(len(u))

        def one(number: int, watch: kernel.Watch) -> None:
            start, mine = groups[number]
            goals = self._mesh.at_pieces(there.select(mine))
            found[mine] = self._field(
                self._mesh.at_pieces(start), goals, watch, radius=radius, targets_only=True
            ).at_places

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

    def path(self, start: Pieces, stop: Pieces, progress: Progress | None = None) -> FacePath:
        """Return the shortest path between two points, one piece each; see `field` for errors."""
        starts, goals = self._mesh.at_pieces(stop), self._mesh.at_pieces(start)
        fields: list[GeodesicField] = []

        def one(_: int, watch: kernel.Watch) -> None:
            fields.append(self._field(starts, goals, watch, targets_only=True))

        self._in_workers(one, 1, progress)
        return fields[0].path_to_place(0)

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

    def field(
        self,
        sources: npt.ArrayLike | Pieces,
        places: Pieces | None = None,
        progress: Progress | None = None,
        *,
        radius: float = np.inf,
        offsets: npt.ArrayLike | None = None,
        everything: bool = False,
    ) -> GeodesicField:
        """Return distances from vertices or pieces of faces, also at places in faces, and the paths to all of them.

        Parameters
        ----------
        sources : int, (k,) array_like or Pieces
            Vertices, or pieces of faces. The distance is that from the nearest, exact also from all along a piece.
        places : Pieces, optional
            Points whose distances are wanted, too.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        radius : float
            How far to go, in the mesh's length unit.
        offsets : (k,) array_like, optional
            The distance at each source, 0 by default.
        everything : bool
            Leave nothing out that cannot be shorter: slow, for tests on small meshes.

        Returns
        -------
        GeodesicField
            The distances and the paths.

        Raises
        ------
        VertexError
            For a bad id.
        ParameterError
            For a radius or offsets that are no numbers.
        SolverError
            If more windows than 2,000 a vertex and 200,000 would be needed.
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
        fields: list[GeodesicField] = []

        def one(_: int, watch: kernel.Watch) -> None:
            fields.append(self._field(starts, goals, watch, shifts, radius, everything))

        self._in_workers(one, 1, progress, radius == np.inf and not everything)
        return fields[0]

    def _in_workers(
        self, one: Callable[[int, kernel.Watch], None], count: int, progress: Progress | None, is_whole: bool = False
    ) -> None:
        """Run the work in the workers; with `is_whole` each item is a whole field, whose duration is known."""
        windows = count * (self.expected or USUAL_WINDOWS_PER_VERTEX * len(self.surface.vertices))
        with Expected("windows", windows, min(count, WORKERS), progress) as it:
            job = Job(it.progress if is_whole else progress, "exact geodesic", windows)
            job.run(lambda number: one(number, job.watch), range(count))
            job.finish()
            it.done = job.watch.done if is_whole else 0  # of less, most is beginnings and ends

    def _field(
        self,
        starts: Places,
        goals: Places | None,
        watch: kernel.Watch,
        offsets: FloatArray | None = None,
        radius: float = np.inf,
        everything: bool = False,
        targets_only: bool = False,
    ) -> GeodesicField:
        mesh, unit = self._mesh, self._mesh.unit
        shifts = np.zeros(len(starts.rows)) if offsets is None else offsets / unit
        rest: list[Any] = [mesh.arrays]
        run = kernel.Run(mesh=ctypes.pointer(mesh.structure), offset=kernel.at(shifts), radius=radius / unit)
        run.source = kernel.Places(len(starts.rows), *map(kernel.at, starts[1:]))
        run.most_taken = MOST_WINDOWS_PER_VERTEX * mesh.vertices + MOST_WINDOWS_AT_LEAST
        run.everything, run.targets_only = 3 * everything, targets_only
        count = 0
        if goals is not None:
            count = len(goals.rows)
            lists = _lists(goals.faces, mesh.faces)
            rest.append(lists)
            run.target = kernel.Places(count, *map(kernel.at, goals[1:]))
            run.first_target, run.next_target = map(kernel.at, lists)
        reached = np.empty(mesh.vertices + count, kernel.REACHED)
        run.reached = kernel.at(reached)
        try:
            work = self._free.get_nowait()
        except Empty:
            work = _Workspace(mesh)
        try:
            rest.append(work.complete(run, watch, self.surface.name))
        finally:
            self._free.put(work)
        if radius == np.inf and not targets_only:
            self.expected = max(float(run.taken), 1.0)
        lengths = reached["distance"]
        found = np.concatenate([lengths[mesh.number], lengths[mesh.vertices :]])
        found[found > run.radius] = np.inf
        if radius == np.inf:
            found[np.isinf(found)] = np.nan
        return GeodesicField(mesh, run, _Kept(starts, goals, shifts, reached, rest), found * unit)


class _Workspace:
    """Arrays that one run after another writes on."""

    def __init__(self, mesh: UnfoldingMesh) -> None:
        self._queue = np.empty((3 * mesh.faces, kernel.QUEUE), np.uint8)
        self._heap = np.empty((3 * mesh.faces + mesh.vertices, kernel.WAITING), np.uint8)
        self._resize(FIRST_WINDOWS)

    def _resize(self, room: int) -> None:
        if room >= 2**31:
            raise SolverError(f"{room:,} windows at a time are more than exact geodesic distance can hold.")
        self._window = np.empty((room, kernel.WINDOW), np.uint8)
        self._order, self._spare = np.empty((2, room), np.int32)

    def complete(self, run: kernel.Run, watch: kernel.Watch, name: str) -> AnyArray:
        """Let a run reach all there is; returns its crossings of edges with three or more faces, which paths need."""
        lib, crossing = kernel.library(), np.empty((0, kernel.CROSSING), np.uint8)
        has_begun = False
        run.queue, run.heap = kernel.at(self._queue), kernel.at(self._heap)
        while True:
            run.window, run.windows = kernel.at(self._window), len(self._window)
            run.order, run.spare = kernel.at(self._order), kernel.at(self._spare)
            run.crossing, run.crossings = kernel.at(crossing), len(crossing)
            status = lib.bih_geodesic_begin(ctypes.byref(run)) if not has_begun else kernel.DONE
            if status == kernel.DONE:
                has_begun = True
                status = lib.bih_geodesic_run(ctypes.byref(run), ctypes.byref(watch))
            if status != kernel.NO_ROOM:
                break
            if run.needed > run.windows - run.live:
                before = self._window
                self._resize(max(2 * len(before), run.live + run.needed))
                self._window[: len(before)] = before
            if run.crossings_needed > run.crossings - run.crossings_used:
                more = np.empty((2 * (run.crossings_used + run.crossings_needed), kernel.CROSSING), np.uint8)
                more[: len(crossing)] = crossing
                crossing = more
        run.window = run.order = run.spare = run.queue = run.heap = None
        kernel.check_stopped(status)
        if status == kernel.TOO_MUCH:
            raise SolverError(
                f"Exact geodesic distance on {name} was given up after {run.taken:,} windows; use the heat method."
            )
        return crossing


def check_radius(radius: float) -> None:
    """Raises ParameterError for a radius that is no length, 0 or more, in any unit."""
    if not real_number(radius, "A radius") >= 0:
        raise ParameterError(f"A radius is a length of at least 0, not {radius}.")


def _lists(faces: AnyArray, count: int) -> tuple[AnyArray, AnyArray]:
    """Return (count,) the first place in each face, or -1, and (k,) the next after each place in its face."""
    first, following = np.full(count, -1, np.int32), np.full(len(faces), -1, np.int32)
    order = np.argsort(faces, kind="stable")
    ranked = faces[order]
    begins = np.append(True, ranked[1:] != ranked[:-1])[: len(faces)]
    first[ranked[begins]] = order[begins]
    following[order[:-1][~begins[1:]]] = order[1:][~begins[1:]]
    return first, following


# ---------------------------------------------------------------------- expected work
TRIAL_VERTICES = 20_000
"""Vertices, about, that a trial reaches; surfaces of no more are not tried."""

GROWTH_POWERS = (1.0, 2.0)
"""Windows grow like the number of vertices where a surface is rough, like its power 1.5 where it is smooth, and like
its square along smooth tubes."""


def expected_windows(exact: ExactGeodesic, progress: Progress | None = None) -> float:
    """Estimate the windows that a field from one vertex of a connected surface will take.

    Found by two fields that end at a radius, in less than half a second: a half to twice what it is, mostly.  For small
    surfaces n^1.5, which is more than it is but on long tubes.  Raises SolverError where there are too many windows.
    """
    if exact.expected is None:
        exact.expected = _windows_by_trial(exact, progress)
    return exact.expected


def _windows_by_trial(exact: ExactGeodesic, progress: Progress | None) -> float:
    surface = exact.surface
    count = len(surface.vertices)
    if count <= TRIAL_VERTICES:
        return math.pow(count, 1.5)
    radius = math.sqrt(TRIAL_VERTICES / count * surface.face_areas.sum() / math.pi)
    fields = [
        exact.field(0, progress=part(progress, k / 2, (k + 1) / 2), radius=share * radius)
        for k, share in enumerate((0.5, 1))
    ]
    reached = [int(np.isfinite(field.distances).sum()) for field in fields]
    near, far = (float(field.windows) for field in fields)
    if reached[1] == reached[0]:  # far from all others
        return math.pow(count, 1.5)
    power = min(
        max(math.log(far / max(near, 1)) / math.log(reached[1] / reached[0]), GROWTH_POWERS[0]), GROWTH_POWERS[1]
    )
    return far * math.pow(count / reached[1], power)
