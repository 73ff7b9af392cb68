"""Exact geodesic distance on any surface, by windows that unfold from face to face (`kernel/geodesic.h`)."""

from __future__ import annotations

import ctypes
import math
from dataclasses import dataclass
from functools import cached_property
from queue import Empty, SimpleQueue
from typing import Any, NamedTuple

import numpy as np

from ..arrays import AnyArray, FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..kernel import library as kernel
from ..progress import Progress, part
from ..solver.worker_threads import WORKERS, is_alone, side_by_side
from ..sources.pieces import Pieces
from ..surface import Surface
from .geodesic_fronts import GeodesicFront
from .path_search import PathSearch
from .unfolding_mesh import Places, UnfoldingMesh
from .virtual_sources import VirtualSources

MOST_WINDOWS_PER_VERTEX, MOST_WINDOWS_AT_LEAST = 2_000, 200_000
"""Windows that a run may take: usually there are 20 to 200 for a vertex, and 5 to 8 million a second."""

USUAL_WINDOWS_PER_VERTEX = 40
"""Windows for a vertex that progress expects before the first run."""

QUICK_WINDOWS = 30_000_000
"""Windows for a source up to which the exact method is not slow: some 4 s, as smooth surfaces of 120,000 vertices and
scanned ones of 300,000 and more take."""

FIRST_WINDOWS = 4_096
"""Windows for which there is room at first; it doubles when they are more."""

DIVIDED_FROM, PART, ONE_PART, BAND = 50_000, 11, 31, 4.0
"""Faces from which a mesh is divided into parts; the binary logarithm of the faces of a part, and of all that there may
be; and how far a round goes, in mean edge lengths.

The windows of a part stay in a core's cache. In a longer round more of them are taken up that others beat later.
"""

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

    def __init__(
        self, surface: Surface, mesh: UnfoldingMesh, run: kernel.Run, kept: _Kept, distances: FloatArray, windows: int
    ) -> None:
        n = len(mesh.number)
        self._surface, self._mesh, self._run, self._kept = surface, mesh, run, kept
        self.windows = windows
        self.distances, self.at_places = distances[:n], distances[n:]

    def path(self, vertex: int) -> FacePath:
        """Return the shortest path from a vertex back to the source; without pieces at the source itself.

        Raises VertexError for a bad vertex, ParameterError where the source does not reach.
        """
        vertex = self._surface.check_vertex(vertex)
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
            raise ParameterError(f"No path from the source to {words} of {self._surface.name} is known.")
        found = None if count < 0 else (faces[:count], begins[:count], ends[:count])
        if found is None or not self._is_as_long(target, *found):
            found = self._searched(target)
        if found is None:
            raise SolverError(f"The path to {words} of {self._surface.name} was lost.")
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


class ExactGeodesic(GeodesicFront[GeodesicField]):
    """Exact geodesic distances on one surface of any kind; paths lead through vertices and edges that faces share.

    Made once and used by any number of threads; a field of a large surface is computed on all cores, to the same last
    digit on any number of them.  It takes some 0.3 kB a vertex, and a run 0.3 to 0.8 kB more.

    Edges and heights shorter than 2e-13 of the longest edge of their face count as 0.  Against a
    reference in 70 digits it is right to rounding, and to 1e-12 of the maximum where there are such faces.

    Questions raise SolverError where more windows than 2,000 a vertex and 200,000 would be needed.
    """

    name, work, work_per_vertex = "exact geodesic", "windows", USUAL_WINDOWS_PER_VERTEX

    def __init__(self, surface: Surface) -> None:
        super().__init__(surface)
        self._free: SimpleQueue[_Workspace] = SimpleQueue()

    def path(self, start: Pieces, stop: Pieces, progress: Progress | None = None) -> FacePath:
        """Return the shortest path between two points, one piece each; see `field` for errors."""
        starts, goals = self._mesh.at_pieces(stop), self._mesh.at_pieces(start)
        fields: list[GeodesicField] = []

        def one(_: int, watch: kernel.Watch) -> None:
            fields.append(self._field(starts, goals, watch, targets_only=True))

        self._in_workers(one, 1, progress)
        return fields[0].path_to_place(0)

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
            taken, crossing = work.complete(run, watch, self.surface.name)
            rest.append(crossing)
        finally:
            self._free.put(work)
        if radius == np.inf and not targets_only:
            self.expected = max(float(taken), 1.0)
        found = self._lengths(reached["distance"], radius)
        return GeodesicField(self.surface, mesh, run, _Kept(starts, goals, shifts, reached, rest), found, taken)


class _Workspace:
    """Arrays that one run after another writes on."""

    def __init__(self, mesh: UnfoldingMesh) -> None:
        is_divided = mesh.faces >= DIVIDED_FROM and mesh.has_two_faces_at_edges
        shift = PART if is_divided else ONE_PART
        parts = -(-mesh.faces >> shift)
        self._queue = np.empty((3 * mesh.faces, kernel.QUEUE), np.uint8)
        self._heap = np.empty((6 * mesh.faces, kernel.WAITING), np.uint8)
        self._part, self._busy = np.empty((parts, kernel.PART), np.uint8), np.empty(parts, np.int32)
        self._round = kernel.Round(kernel.at(self._part), kernel.at(self._busy), parts=parts, shift=shift)
        self._step = BAND * float(mesh.sides["length"].mean())
        self._message = np.empty((0, kernel.MESSAGE), np.uint8)
        self._window = np.empty((FIRST_WINDOWS, kernel.WINDOW), np.uint8)
        self._orders: list[AnyArray] = []

    def complete(self, run: kernel.Run, watch: kernel.Watch, name: str) -> tuple[int, AnyArray]:
        """Let a run reach all there is.

        Returns the windows that were taken up, and the crossings of edges with three or more faces, which paths need.
        """
        lib, shared = kernel.library(), self._round
        self._crossing = np.empty((0, kernel.CROSSING), np.uint8)
        run.queue, run.heap, run.round = kernel.at(self._queue), kernel.at(self._heap), ctypes.pointer(shared)
        shared.band = self._step if shared.parts > 1 or run.targets_only else np.inf
        runs = [run]
        self._assign(runs)
        while lib.bih_geodesic_begin(ctypes.byref(run)) == kernel.NO_ROOM:
            self._make_room(runs)
        shared.threads = 1 if shared.parts == 1 or is_alone() else WORKERS
        for thread in range(1, shared.threads):
            other = kernel.Run.from_buffer_copy(run)
            other.thread, other.free, other.unused = thread, kernel.NONE, 0
            runs.append(other)
        self._assign(runs)

        def work(one: kernel.Run) -> int:
            return int(lib.bih_geodesic_round(ctypes.byref(one), ctypes.byref(watch)))

        while (status := lib.bih_geodesic_next(ctypes.byref(run))) == kernel.MORE:
            while kernel.NO_ROOM in (found := side_by_side(work, runs)):
                self._make_room(runs)
            if any(found):
                status = min(found)
                break
        taken, crossing = shared.taken, self._crossing
        del self._crossing
        run.window = run.order = run.spare = run.queue = run.heap = run.round = None
        kernel.check_stopped(status)
        if status == kernel.TOO_MUCH:
            raise SolverError(
                f"Exact geodesic distance on {name} was given up after {taken:,} windows; use virtual sources."
            )
        return taken, crossing

    def _make_room(self, runs: list[kernel.Run]) -> None:
        """Make the room that some thread of a round needs to go on."""
        if needed := sum(run.needed for run in runs):
            room = max(2 * len(self._window), len(self._window) + needed)
            if room >= 2**31:
                raise SolverError(f"{room:,} windows at a time are more than exact geodesic distance can hold.")
            self._window = _longer(self._window, room)
        if needed := sum(run.messages_needed for run in runs):
            self._message = _longer(self._message, 2 * (len(self._message) + needed))
        first = runs[0]  # alone where there are crossings
        if first.crossings_needed > first.crossings - first.crossings_used:
            self._crossing = _longer(self._crossing, 2 * (first.crossings_used + first.crossings_needed))
        self._assign(runs)

    def _assign(self, runs: list[kernel.Run]) -> None:
        """Tell the threads of a run where the arrays are."""
        room = len(self._window)
        self._round.message, self._round.messages = kernel.at(self._message), len(self._message)
        if not self._orders or self._orders[0].shape[1] < room:
            self._orders = []
        for number, run in enumerate(runs):
            if number == len(self._orders):
                self._orders.append(np.empty((2, room), np.int32))
            run.window, run.windows = kernel.at(self._window), room
            run.order, run.spare = kernel.at(self._orders[number][0]), kernel.at(self._orders[number][1])
            run.crossing, run.crossings = kernel.at(self._crossing), len(self._crossing)


def _longer(array: AnyArray, room: int) -> AnyArray:
    """Return a copy (room, k) of an array (n, k), with any values at its end."""
    more = np.empty((room, array.shape[1]), array.dtype)
    more[: len(array)] = array
    return more


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

    Found by two fields that end at a radius, in some half a second: 0.8 to 1.5 times what it is, on 13 meshes.  For
    small surfaces n^1.5, which is more than it is but on long tubes.  Raises SolverError where there are too many
    windows.
    """
    if exact.expected is None:
        exact.expected = _windows_by_trial(exact, progress)
    return exact.expected


def _windows_by_trial(exact: ExactGeodesic, progress: Progress | None) -> float:
    surface = exact.surface
    count = len(surface.vertices)
    if count <= TRIAL_VERTICES:
        return math.pow(count, 1.5)
    approximate = VirtualSources(surface)
    radius = math.sqrt(TRIAL_VERTICES / count * surface.face_areas.sum() / math.pi)
    for reach in (radius, 4 * radius, np.inf):  # on a long surface few vertices are near
        field = approximate.distances(0, radius=reach)
        known = np.sort(field[np.isfinite(field)])[:TRIAL_VERTICES]
        if len(known) == TRIAL_VERTICES:
            break
    fields = [
        exact.field(0, progress=part(progress, k / 2, (k + 1) / 2), radius=known[-1 - skipped])
        for k, skipped in enumerate((len(known) * 3 // 4, 0))
    ]
    reached = [int(np.isfinite(field.distances).sum()) for field in fields]
    near, far = (float(field.windows) for field in fields)
    if reached[1] == reached[0]:  # far from all others
        return math.pow(count, 1.5)
    power = min(
        max(math.log(far / max(near, 1)) / math.log(reached[1] / reached[0]), GROWTH_POWERS[0]), GROWTH_POWERS[1]
    )
    return far * math.pow(count / reached[1], power)
