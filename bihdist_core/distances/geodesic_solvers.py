"""Methods of geodesic distance: exact, virtual sources, heat, along edges, and exact with another to fall back on."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Generic, TypeVar

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import SolverError
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..progress import Progress, part, steps, turn
from ..sources.pieces import Pieces
from ..surface import Surface
from .accuracy import ErrorEstimate
from .edge_geodesic import EdgeGeodesic
from .exact_geodesic import QUICK_WINDOWS, ExactGeodesic, expected_windows
from .geodesic_accuracy import MeasuredErrors, below_straight_line, sampled_errors
from .geodesic_fronts import GeodesicFront
from .heat_times import HeatTimes
from .pair_questions import pairs_by_columns
from .place_pairs import by_start
from .virtual_sources import VirtualSources

Answer = TypeVar("Answer")
Made = TypeVar("Made")
Front = TypeVar("Front", bound=GeodesicFront[Any])


class GeodesicSolver(ABC, Generic[Made]):
    """A method of geodesic distance; what it answers is within one component of the surface.

    Vertices are local numbers of the component; pieces have the numbers of the whole surface.
    """

    method: str
    label: str
    is_symmetric = True
    typically = ErrorEstimate()
    """The error estimate where nothing is measured."""

    def __init__(self, laplacian: Laplacian) -> None:
        self._laplacian = laplacian
        self._made: Memo[int, Made] = Memo()

    @property
    def current(self) -> GeodesicSolver[Any]:
        """The method in use, which is this one but for a `FallBack`."""
        return self

    def answer(self, question: Callable[[GeodesicSolver[Any]], Answer], progress: Progress | None) -> Answer:
        """Answer a question by the method in use."""
        return question(self)

    @abstractmethod
    def make(self, component: Component, progress: Progress | None) -> Made:
        """Do the long work for a component."""

    def solver(self, component: Component, progress: Progress | None = None) -> Made:
        """Return the solver of a component, made when first asked for."""
        if component.index not in self._made:
            self._made[component.index] = self.make(component, progress)
        return self._made[component.index]

    def prepare(self, component: Component, progress: Progress | None) -> None:
        """Do the long work for a component, if it is not done."""
        self.solver(component, progress)

    def is_slow(self, progress: Progress | None) -> bool:
        """Return whether a source takes more than some 5 s."""
        return False

    @abstractmethod
    def columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        """Return (m, k) distances from vertices (k,)."""

    def of_pairs(
        self, component: Component, sources: IntArray, targets: IntArray, progress: Progress | None
    ) -> FloatArray:
        """Return (k,) distances from vertices (k,) to vertices (k,)."""
        return pairs_by_columns(partial(self.columns, component), len(component.vertices), sources, targets, progress)

    @abstractmethod
    def from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        """Return (m,) distances from the nearest of some pieces."""

    @abstractmethod
    def between(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """Return (k,) distances of k pairs of points in faces."""

    def error_estimate(self, components: Sequence[int], progress: Progress | None) -> ErrorEstimate:
        """Estimate the error of fields from vertices of components."""
        return self.typically

    def has_error_estimate(self, component: int) -> bool:
        """Return whether the error estimate of a component is known."""
        return True


class FrontSolver(GeodesicSolver[Front]):
    """A method whose front spreads from its sources; distances beyond the radius are inf."""

    def __init__(self, laplacian: Laplacian, radius: float = np.inf) -> None:
        super().__init__(laplacian)
        self._radius = radius

    def columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        return self.solver(component).columns(index, progress, radius=self._radius)

    def of_pairs(
        self, component: Component, sources: IntArray, targets: IntArray, progress: Progress | None
    ) -> FloatArray:
        return self.solver(component).of_pairs(sources, targets, progress, radius=self._radius)

    def from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        vertices = pieces.vertices
        sources = self._local(component, pieces) if vertices is None else component.local(vertices)
        return self.solver(component).distances(sources, progress, radius=self._radius)

    def between(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        ends = self._local(component, u), self._local(component, v)
        return self.solver(component).between(*ends, progress, radius=self._radius)

    def _local(self, component: Component, pieces: Pieces) -> Pieces:
        """Return pieces in the component's numbers."""
        surface = self._laplacian.surface
        own = np.flatnonzero(surface.component_of_vertex[surface.faces[:, 0]] == component.index)
        return replace(pieces, faces=np.searchsorted(own, pieces.faces), corners=component.local(pieces.corners))


class ExactSolver(FrontSolver[ExactGeodesic]):
    """The exact method."""

    method, label = "exact", "geodesic, exact"

    def make(self, component: Component, progress: Progress | None) -> ExactGeodesic:
        exact = ExactGeodesic(component.surface)
        if self._radius == np.inf:
            is_slow(exact, progress)  # whose trial tells how long a field will take
        return exact

    def is_slow(self, progress: Progress | None) -> bool:
        return is_slow(self.solver(self._laplacian.components[0], progress), progress)

    def release(self) -> Iterator[Component]:
        """Yield the components that were prepared, and then drop what was made for them."""
        yield from [self._laplacian.components[index] for index in self._made]
        self._made.clear()


class ApproximateSolver(GeodesicSolver[Any]):
    """A method that is not exact, with its errors from a few vertices where they can be measured."""

    is_symmetric = False
    below = 0.0
    """The fraction of the maximum by which some field fell below a straight line."""

    def __init__(self, laplacian: Laplacian) -> None:
        super().__init__(laplacian)
        self._errors: Memo[int, MeasuredErrors | None] = Memo()

    def between(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        there = self.one_way(component, u, v, part(progress, 0, 0.5))
        return (there + self.one_way(component, v, u, part(progress, 0.5, 1))) / 2

    @abstractmethod
    def one_way(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """Return (k,) values of fields from u at v."""

    def error_estimate(self, components: Sequence[int], progress: Progress | None) -> ErrorEstimate:
        with turn(self._errors.lock, progress, "waiting for the accuracy"):
            found = [self._errors_on(self._laplacian.components[index], progress) for index in components]
        measured = [errors for errors in found if errors is not None]
        if len(measured) < len(found):
            return self.typically
        return max(measured, key=lambda errors: errors.largest).estimate(self.below)

    def _errors_on(self, component: Component, progress: Progress | None) -> MeasuredErrors | None:
        if component.index not in self._errors:
            solver = self.solver(component, progress)
            self._errors[component.index] = sampled_errors(component.surface, solver, progress)
        return self._errors[component.index]

    def has_error_estimate(self, component: int) -> bool:
        return component in self._errors


class VirtualSolver(ApproximateSolver, FrontSolver[VirtualSources]):
    """Virtual sources."""

    method, label = "virtual-sources", "geodesic, approximate"
    typically = ErrorEstimate(
        "accurate to 0.3 % of the maximum in the mean typically and 1 % at the worst, and less on thin faces", True
    )

    def make(self, component: Component, progress: Progress | None) -> VirtualSources:
        return VirtualSources(component.surface)

    def one_way(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        ends = self._local(component, u), self._local(component, v)
        found: FloatArray = self.solver(component).from_starts(*ends, progress)
        return found


class HeatSolver(ApproximateSolver):
    """The heat method."""

    method, label = "heat", "geodesic, heat method"
    typically = ErrorEstimate(
        "accurate to 4 % of the maximum typically, and worse on coarse meshes and thin faces", True
    )

    def make(self, component: Component, progress: Progress | None) -> HeatTimes:
        return HeatTimes(component, progress)

    def columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        solver, fields = self.solver(component), np.empty((len(component.vertices), len(index)))
        for k, source in enumerate(index.tolist()):
            fields[:, k] = solver.distances(source, part(progress, k / len(index), (k + 1) / len(index)))
            self.below = max(self.below, below_straight_line(component.surface, source, fields[:, k]))
        return fields

    def from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        solver, corners = self.solver(component), component.local(pieces.corners)
        loads, offsets = pieces.start + pieces.stop, offsets_of(pieces, self._laplacian.surface)
        # Each piece by itself: along one flow from all of them distances would not be 0.
        least = np.full(len(component.vertices), np.inf)
        for step, row in steps(progress, range(len(pieces))):
            some = loads[row] > 0
            found = solver.distances_with(corners[row][some], loads[row][some], offsets[row][some], step)
            np.minimum(least, found, out=least)
        return least

    def one_way(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """Return (k,) values of fields from u at v, linear in faces."""
        found, starts = np.empty(len(u)), list(by_start(u))
        for number, (start, mine) in enumerate(starts):
            progress(number / len(starts), self.label)
            step = part(progress, number / len(starts), (number + 1) / len(starts))
            field = self.from_pieces(component, start, step)
            field[component.local(start.corners[start.start == 1])] = 0
            found[mine] = (v.start[mine] * field[component.local(v.corners[mine])]).sum(axis=1)
        return found


class EdgeSolver(GeodesicSolver[EdgeGeodesic]):
    """Shortest paths along edges, by Dijkstra's algorithm."""

    method, label = "dijkstra", "geodesic, Dijkstra along edges"
    typically = ErrorEstimate(
        "accurate to 10 % of the maximum typically, and worse on thin faces, however fine the mesh", True
    )

    def make(self, component: Component, progress: Progress | None) -> EdgeGeodesic:
        return EdgeGeodesic(component.surface)

    def columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        solver, fields = self.solver(component), np.empty((len(component.vertices), len(index)))
        for k, source in enumerate(index.tolist()):
            part(progress, 0, 1)(k / len(index), self.label)
            fields[:, k] = solver.distances(source)
        return fields

    def from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        offsets = offsets_of(pieces, self._laplacian.surface)
        touched = (pieces.start > 0) | (pieces.stop > 0)
        return self.solver(component).distances_with(component.local(pieces.corners)[touched], offsets[touched])

    def between(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """Return (k,) lengths from corner to corner, and straight to both points."""
        found, starts = np.empty(len(u)), list(by_start(u))
        for number, (start, mine) in enumerate(starts):
            progress(number / len(starts), self.label)
            lengths, some = self.from_pieces(component, start, progress), v.select(mine)
            ways = lengths[component.local(some.corners)] + offsets_of(some, self._laplacian.surface)
            found[mine] = np.where(some.start > 0, ways, np.inf).min(axis=1)
        return found


class FallBack:
    """The exact method, and another one from the first source on for which that gives up."""

    def __init__(self, exact: ExactSolver, other: ApproximateSolver) -> None:
        self._exact, self._other = exact, other
        self._has_given_up = False
        self._turn: Memo[None, None] = Memo()  # whose lock pickles leave behind

    @property
    def current(self) -> GeodesicSolver[Any]:
        """The method in use."""
        return self._other if self._has_given_up else self._exact

    def answer(self, question: Callable[[GeodesicSolver[Any]], Answer], progress: Progress | None) -> Answer:
        """Answer a question by the method in use, or else by the other."""
        solver = self.current
        try:
            return question(solver)
        except SolverError:
            if solver is self._other:
                raise
        with self._turn.lock:
            if not self._has_given_up:
                for component in self._exact.release():
                    self._other.prepare(component, progress)
                self._has_given_up = True
        return question(self._other)


def is_slow(exact: ExactGeodesic, progress: Progress | None = None) -> bool:
    """Return whether a field is expected to take more than QUICK_WINDOWS, from a trial where the surface is large."""
    # More than on any but long tubes: no trial is needed.
    if len(exact.surface.vertices) ** 1.5 <= QUICK_WINDOWS:
        return False
    return expected_windows(exact, progress) > QUICK_WINDOWS


def offsets_of(pieces: Pieces, surface: Surface) -> FloatArray:
    """Return (k, 3) how far the corners of each piece's face are from it."""
    start, stop = pieces.positions(surface.vertices)
    way = stop - start
    to = surface.vertices[pieces.corners] - start[:, None]
    square = np.einsum("kx,kx->k", way, way)
    share = np.einsum("kcx,kx->kc", to, way) / np.where(square > 0, square, 1)[:, None]
    offsets: FloatArray = np.linalg.norm(to - np.clip(share, 0, 1)[..., None] * way[:, None], axis=2)
    return offsets
