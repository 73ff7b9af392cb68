"""The heat method with the shortest flow that comes out positive, source by source."""

import threading
from collections.abc import Callable
from concurrent.futures import Future, TimeoutError as NotYet

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import SolverError
from ..laplacian import Component
from ..progress import Progress, part, silent
from ..solver.factor import Factor
from .heat_geodesic import MOST_NEGATIVE, TIME_FACTORS, HeatGeodesic, NegativeHeatError, heat_matrix, heat_time

PROBES = 4
"""From how many vertices, which are always the same ones, the first time is chosen."""
REPORT_EVERY = 0.03
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
        n = len(component.vertices)
        probes = np.unique(np.linspace(0, n - 1, PROBES).astype(int))
        heat = np.zeros((n, len(probes)))
        heat[probes, np.arange(len(probes))] = 1
        self._times = list(TIME_FACTORS)
        for factor in TIME_FACTORS:
            solver = self._flow(factor, part(progress, 0.7, 1))
            if factor == TIME_FACTORS[-1] or (solver.flow(heat) < 0).mean() <= MOST_NEGATIVE:
                break
            self._times.remove(factor)
        self._made[factor] = Future()
        self._made[factor].set_result(solver)

    def distances(self, source: int, progress: Progress | None = None) -> FloatArray:
        """(n,) distances from one vertex.  Raises SolverError where no time serves."""
        return self._first_good(lambda solver: solver.distances(source, progress), progress)

    def distances_with(
        self, vertices: IntArray, loads: FloatArray, offsets: FloatArray, progress: Progress | None = None
    ) -> FloatArray:
        """(n,) distances from a spread source, as of HeatGeodesic.  Raises SolverError where no time serves."""
        return self._first_good(lambda solver: solver.distances_with(vertices, loads, offsets, progress), progress)

    def _first_good(self, found: Callable[[HeatGeodesic], FloatArray], progress: Progress | None) -> FloatArray:
        for factor in self._times:
            try:
                return found(self._solver(factor, progress or silent))
            except NegativeHeatError as error:
                last = error
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
                made.exception(REPORT_EVERY)
            except NotYet:
                progress(self._shares.get(factor, 0.0), "heat method, a longer flow")
        return made.result()

    def _make(self, factor: float, made: "Future[HeatGeodesic]") -> None:
        def note(share: float, _text: str) -> None:
            self._shares[factor] = share

        try:
            made.set_result(self._flow(factor, note))
        except BaseException as error:
            made.set_exception(error)

    def _flow(self, factor: float, progress: Progress | None) -> HeatGeodesic:
        """The heat method with one time."""
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
