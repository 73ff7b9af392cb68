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
from ..sources.pieces import Pieces
from ..surface import Surface
from .geodesic_fronts import GeodesicFront
from .path_search import PathSearch
from .unfolding_mesh import Places, UnfoldingMesh

MOST_WINDOWS_PER_VERTEX, MOST_WINDOWS_AT_LEAST = 2_000, 200_000
"""Windows that a run may take: usually there are 20 to 200 for a vertex, and 5 to 8 million a second."""

USUAL_WINDOWS_PER_VERTEX = 40
"""Windows for a vertex that progress expects before the first run."""

QUICK_WINDOWS = 30_000_000
"""Windows for a source up to which the exact method is not slow: some 4 s, as smooth surfaces of 120,000 vertices and
scanned ones of 300,000 and more take."""

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

    def __init__(
        self, surface: Surface, mesh: UnfoldingMesh, run: kernel.Run, kept: _Kept, distances: FloatArray
    ) -> None:
        n = len(mesh.number)
        self._surface, self._mesh, self._run, self._kept = surface, mesh, run, kept
        self.windows = run.taken
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

    Made once and used by any number of threads.  It takes some 0.3 kB a vertex, and a run 0.3 kB more.  Edges and
    heights shorter than 2e-13 of the longest edge of their face count as 0.  Held to a reference in 70 digits: right to
    rounding, and to 1e-12 of the maximum where there are such faces.

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
            rest.append(work.complete(run, watch, self.surface.name))
        finally:
            self._free.put(work)
        if radius == np.inf and not targets_only:
            self.expected = max(float(run.taken), 1.0)
        found = self._lengths(reached["distance"], radius)
        return GeodesicField(self.surface, mesh, run, _Kept(starts, goals, shifts, reached, rest), found)


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
                f"Exact geodesic distance on {name} was given up after {run.taken:,} windows; use virtual sources."
            )
        return crossing


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
