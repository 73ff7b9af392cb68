"""The heat method with the shortest flow that comes out positive, source by source."""

from collections.abc import Callable

import numpy as np

from ..errors import SolverError
from ..laplacian import Component
from ..progress import Progress, part
from ..solver.factor import Factor
from .heat_geodesic import MOST_NEGATIVE, TIME_FACTORS, HeatGeodesic, NegativeHeatError, heat_matrix, heat_time

PROBES = 4
"""From how many vertices, which are always the same ones, the first time is chosen."""


class HeatTimes:
    """The heat method on one component, with one elimination order for the matrices of all its times.

    A source starts from the first of TIME_FACTORS that serves the probes; where its own flow is negative nevertheless,
    the next is taken.  So a field depends on its source alone, not on those before.  Longer times are factored when
    they are needed.
    """

    def __init__(self, component: Component, progress: Progress | None = None) -> None:
        component.factor(part(progress, 0, 0.7))
        self._component = component
        self._solvers: dict[float, HeatGeodesic] = {}
        n = len(component.vertices)
        probes = np.unique(np.linspace(0, n - 1, PROBES).astype(int))
        heat = np.zeros((n, len(probes)))
        heat[probes, np.arange(len(probes))] = 1
        self._times = list(TIME_FACTORS)
        while (self._flow(self._times[0], part(progress, 0.7, 1))(heat) < 0).mean() > MOST_NEGATIVE:
            if len(self._times) == 1:
                break
            del self._solvers[self._times.pop(0)]

    def distances(self, source: int, progress: Progress | None = None) -> np.ndarray:
        """(n,) distances from one vertex.  Raises SolverError where no time serves."""
        return self._first_good(lambda solver: solver.distances(source, progress))

    def distances_with(
        self, vertices: np.ndarray, loads: np.ndarray, offsets: np.ndarray, progress: Progress | None = None
    ) -> np.ndarray:
        """(n,) distances from a spread source, as of HeatGeodesic.  Raises SolverError where no time serves."""
        return self._first_good(lambda solver: solver.distances_with(vertices, loads, offsets, progress))

    def _first_good(self, found: Callable[[HeatGeodesic], np.ndarray]) -> np.ndarray:
        for factor in self._times:
            if factor not in self._solvers:
                self._flow(factor, None)
            try:
                return found(self._solvers[factor])
            except NegativeHeatError as error:
                last = error
        raise SolverError(
            f"The heat method has no distances from this source: the faces of {self._component.surface.name} are too "
            f"thin there. The methods exact and dijkstra have. ({last})"
        )

    def _flow(self, factor: float, progress: Progress | None) -> Callable[[np.ndarray], np.ndarray]:
        """The solve of step I at one time, whose solver is kept."""
        component = self._component
        matrix = heat_matrix(component.stiffness, component.areas, heat_time(component.surface, factor))
        try:
            flow = Factor(component.tree(), matrix, progress=progress)
        except SolverError as error:
            raise SolverError(
                f"The heat flow on {component.surface.name} cannot be computed: its faces are too thin, or differ too "
                f"much in size. Remeshing would help. ({error})"
            ) from None
        self._solvers[factor] = HeatGeodesic(component.surface, matrix, flow.solve, component.solve)
        return flow.solve
