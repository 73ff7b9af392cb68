"""The heat method with the shortest flow that comes out positive, source by source."""

import threading
from collections.abc import Callable
from concurrent.futures import Future, TimeoutError as NotYet
from copy import copy

import numpy as np

from ..arrays import FloatArray, IntArray, unit_columns
from ..errors import SolverError
from ..laplacian import Component
from ..progress import Progress, part, silent
from ..solver.factor import Factor
from ..unexpected import note_unexpected
from .heat_geodesic import MOST_NEGATIVE, TIME_FACTORS, HeatGeodesic, NegativeHeatError, heat_matrix, heat_time

PROBES = 4
"""From how many vertices the first time is chosen: always the same places, however vertices are numbered."""
REPORT_EVERY_S = 0.03
"""Seconds between two progress reports while a longer time is factored, hence until a cancellation acts."""


class HeatTimes:
    """The heat method on one component, with one elimination order for the matrices of all its times.

    A source starts from the first of TIME_FACTORS that serves the probes; where its own flow is negative nevertheless,
    the next is taken.  So a field depends on its source alone, not on those before.  Longer times are factored when
    they are needed, each once, on a thread of its own: that goes on when a question that waits for it is cancelled, and
    other sources are answered meanwhile.  Usable from several threads.
    """

    def __init__(self, component: Component, progress: Progress | None = None) -> None:
        component.factor(part(progress, 0, 0.7))
        self._component = component
        self._made: dict[float, Future[HeatGeodesic]] = {}
        self._shares: dict[float, float] = {}
        self._lock = threading.Lock()
        probes = spread_vertices(component.surface.vertices, PROBES)
        heat = unit_columns(len(component.vertices), probes)
        self._times = list(TIME_FACTORS)
        for factor in TIME_FACTORS:
            solver = self._flow(factor, part(progress, 0.7, 1))
            if factor == TIME_FACTORS[-1] or (solver.flow(heat) < 0).mean() <= MOST_NEGATIVE:
                break
            self._times.remove(factor)
        self._made[factor] = Future()
        self._made[factor].set_result(solver)

    def distances(self, source: int, progress: Progress | None = None) -> FloatArray:
        """Return (n,) distances from one vertex.  Raises SolverError where no time serves."""
        return self._first_good(lambda solver: solver.distances(source, progress), progress)

    def distances_with(
        self, vertices: IntArray, loads: FloatArray, offsets: FloatArray, progress: Progress | None = None
    ) -> FloatArray:
        """Return (n,) distances from a spread source, as of HeatGeodesic.  Raises SolverError where no time serves."""
        return self._first_good(lambda solver: solver.distances_with(vertices, loads, offsets, progress), progress)

    def _first_good(self, found: Callable[[HeatGeodesic], FloatArray], progress: Progress | None) -> FloatArray:
        for factor in self._times:
            try:
                return found(self._solver(factor, progress or silent))
            except NegativeHeatError as error:
                last = str(error)
        raise SolverError(
            f"The heat method has no distances from this source: the faces of {self._component.surface.name} are too "
            f"thin there. The methods exact and dijkstra have. ({last})"
        )

    def _solver(self, factor: float, progress: Progress) -> HeatGeodesic:
        """That of one time, waited for."""
        with self._lock:
            made = self._made.get(factor)
            if made is None:
                made = self._made[factor] = Future()
                threading.Thread(target=self._make, args=(factor, made), name="heat times", daemon=True).start()
        while not made.done():
            try:
                made.exception(REPORT_EVERY_S)
            except NotYet:
                progress(self._shares.get(factor, 0.0), "heat method, a longer flow")
        error = made.exception()
        if error is not None:
            # A copy: the traceback of what is raised refers to this object, which keeps the future with its error.
            raise copy(error)
        return made.result()

    def _make(self, factor: float, made: "Future[HeatGeodesic]") -> None:
        def note(share: float, _text: str) -> None:
            self._shares[factor] = share

        try:
            made.set_result(self._flow(factor, note))
        except BaseException as error:
            note_unexpected(error)
            made.set_exception(error.with_traceback(None))

    def _flow(self, factor: float, progress: Progress | None) -> HeatGeodesic:
        """Return the heat method with one time."""
        component = self._component
        matrix = heat_matrix(component.stiffness, component.areas, heat_time(component.surface, factor))
        try:
            flow = Factor(component.tree(), matrix, progress=progress)
        except SolverError as error:
            raise SolverError(
                f"The heat flow on {component.surface.name} cannot be computed: its faces are too thin, or differ too "
                f"much in size. Remeshing would help. ({error})"
            ) from None
        return HeatGeodesic(component.surface, matrix, flow.solve, component.solve)


def spread_vertices(vertices: FloatArray, count: int) -> IntArray:
    """Choose up to `count` vertices far apart in space, the same ones however they are numbered.

    The first is the farthest from the middle of the bounding box, each other the farthest from those before it.
    """
    apart, chosen = _squared_distances(vertices, (vertices.min(axis=0) + vertices.max(axis=0)) / 2), list[int]()
    while len(chosen) < count and apart.max() > 0:
        chosen.append(farthest(apart, vertices))
        squares = _squared_distances(vertices, vertices[chosen[-1]])
        apart = squares if len(chosen) == 1 else np.minimum(apart, squares)
    return np.array(chosen or [0])


def farthest(values: FloatArray, vertices: FloatArray, tolerance: float = 0.0) -> int:
    """Return the vertex with the largest of the values (n,), at least 0, and of several the last by coordinates.

    `tolerance` is the fraction of the largest value by which rounding may have made equal values differ.
    """
    tied = np.flatnonzero(values >= values.max() * (1 - tolerance))
    return int(tied[np.lexsort(vertices[tied].T)[-1]])


def _squared_distances(vertices: FloatArray, point: FloatArray) -> FloatArray:
    # Added up coordinate by coordinate: then rounding does not depend on where in the array a vertex is.
    x, y, z = (vertices - point).T
    squares: FloatArray = x * x + y * y + z * z
    return squares
