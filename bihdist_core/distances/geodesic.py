"""Geodesic distance: exact, by the heat method, or along edges (Dijkstra).  The label says which."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..kernel import library as kernel
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..progress import Progress, part
from ..sources.pieces import Pieces
from ..surface import MeshLike, Surface
from .accuracy import ErrorEstimate
from .distance import Distance
from .edge_geodesic import EdgeGeodesic
from .exact_geodesic import ExactGeodesic
from .heat_accuracy import HeatErrors, below_straight_line, heat_errors
from .heat_times import HeatTimes
from .place_pairs import by_start, straight

METHODS = ("auto", "exact", "heat", "dijkstra")
EXACT_UP_TO = 300_000
"""Vertices up to which `auto` takes the exact method: one source then takes some 5 s where the surface is smooth, and
less than 2 s where it is scanned."""

TINY = 1e-9
"""The share of an edge length that a part of a line counts as at least, where all of it is in one place."""

TYPICALLY = {
    "heat": ErrorEstimate("accurate to 4 % of the maximum typically, and worse on coarse meshes and thin faces", True),
    "dijkstra": ErrorEstimate(
        "accurate to 10 % of the maximum typically, and worse on thin faces, however fine the mesh", True
    ),
    "exact": ErrorEstimate(),
}
"""How accurate methods are typically; what the heat method does on a mesh is measured where that can be done."""

LABELS = {"exact": "geodesic, exact", "heat": "geodesic, heat method", "dijkstra": "geodesic, Dijkstra along edges"}


class GeodesicDistance(Distance):
    """Length of the shortest path; unit length.

    method: "exact" (any surface; from lines, too), "heat" (1 to 3 % off in the mean on most samples), "dijkstra" (along
    edges: 4 to 6 % too long in the mean on most samples), or "auto": exact up to 300,000 vertices, else heat.  On long,
    thin faces, such as those of the sample `part`, the means are 5 and 13 %.  Raises ParameterError for any other word,
    and SolverError for "exact" without the compiled kernel, where "auto" is heat.

    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> GeodesicDistance(square).from_source(1).round(3).tolist()
    [1.0, 0.0, 1.0, 1.414]
    """

    length_power = 1.0

    def __init__(self, laplacian: Laplacian | MeshLike, method: str = "auto", progress: Progress | None = None) -> None:
        if method not in METHODS:
            raise ParameterError(f"There is no geodesic method {method!r}; choose one of {', '.join(METHODS)}.")
        super().__init__(laplacian)
        if method == "auto":
            exact = len(self.surface.vertices) <= EXACT_UP_TO and kernel.library() is not None
            method = "exact" if exact else "heat"
        self.method = method
        self.label = LABELS[method]
        self.is_symmetric = method != "heat"
        self._solvers: Memo[int, ExactGeodesic | HeatTimes | EdgeGeodesic] = Memo()
        self._errors: Memo[int, HeatErrors | None] = Memo()
        self._below = 0.0
        self.prepare(self.laplacian.components[0], progress)

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Make the solver of a component, if that is not done."""
        if component.index not in self._solvers:
            if self.method == "exact":
                self._solvers[component.index] = ExactGeodesic(component.surface)
            elif self.method == "heat":
                self._solvers[component.index] = HeatTimes(component, progress)
            else:
                self._solvers[component.index] = EdgeGeodesic(component.surface)

    def error_estimate(self, components: Sequence[int] | None = None) -> ErrorEstimate:
        """How far the method is off, with a warning; nothing for the exact one.

        The heat method is compared with exact distances on each component once; by less than it is known to have fallen
        below a straight line it is not off.
        """
        if self.method == "heat":
            with self._errors.lock:
                found = [self._errors_on(self.laplacian.components[index]) for index in self._those(components)]
            measured = [errors for errors in found if errors is not None]
            if len(measured) == len(found):
                return max(measured, key=lambda errors: errors.largest).estimate(self._below)
        return TYPICALLY[self.method]

    def _errors_on(self, component: Component) -> HeatErrors | None:
        if component.index not in self._errors:
            self.prepare(component)
            solver = self._solvers[component.index]
            assert isinstance(solver, HeatTimes)
            self._errors[component.index] = heat_errors(component.surface, solver)
        return self._errors[component.index]

    def is_judged(self, component: int) -> bool:
        """Whether the heat method's errors on a component are known."""
        return self.method != "heat" or component in self._errors

    def _columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        solver = self._solvers[component.index]
        if isinstance(solver, ExactGeodesic):
            return solver.columns(index, progress)
        share, fields = 1 / len(index), np.empty((len(component.vertices), len(index)))
        for k, source in enumerate(index.tolist()):
            step = part(progress, k * share, (k + 1) * share)
            if isinstance(solver, EdgeGeodesic):
                step(0.0, self.label)
                fields[:, k] = solver.distances(source)
            else:
                fields[:, k] = solver.distances(source, step)
                self._below = max(self._below, below_straight_line(component.surface, source, fields[:, k]))
        return fields

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        solver, vertices = self._solvers[component.index], pieces.vertices
        if isinstance(solver, ExactGeodesic):
            if vertices is not None:
                return solver.distances(component.local(vertices), progress)
            return solver.distances(self._local(component, pieces), progress)
        loads, offsets = _spread(pieces, self.surface)
        corners = component.local(pieces.corners)
        if isinstance(solver, EdgeGeodesic):
            touched = (pieces.start > 0) | (pieces.stop > 0)
            return solver.distances_with(corners[touched], offsets[touched])
        # A set is the nearest of its points also where a flow from all of them would be a little different.
        rows = [*np.flatnonzero(~pieces.along)[:, None]]
        if pieces.along.any():
            rows.append(np.flatnonzero(pieces.along))
        least = np.full(len(component.vertices), np.inf)
        for number, row in enumerate(rows):
            step = part(progress, number / len(rows), (number + 1) / len(rows))
            some = loads[row] > 0
            found = solver.distances_with(corners[row][some], loads[row][some], offsets[row][some], step)
            np.minimum(least, found, out=least)
        return least

    def _of_places(self, u: Pieces, v: Pieces) -> FloatArray:
        labels = self.surface.component_of_vertex
        found = np.full(len(u), np.nan)
        for component, mine in self._by_component(u.corners[:, 0]):
            mine = mine[labels[v.corners[mine, 0]] == component.index]
            if len(mine):
                self.prepare(component)
                one, other = u.some(mine), v.some(mine)
                if self.method == "exact":
                    found[mine] = self._exactly(component, one, other)
                elif self.method == "dijkstra":
                    found[mine] = self._along_edges(component, one, other)
                else:
                    found[mine] = (self._by_heat(one, other) + self._by_heat(other, one)) / 2
        # Within a face nothing is shorter.
        lengths = straight(u, v, self.surface)
        return np.where(np.isfinite(lengths), lengths, found)

    def _exactly(self, component: Component, u: Pieces, v: Pieces) -> FloatArray:
        """(k,) of the windows that reach one of both."""
        solver = self._solvers[component.index]
        assert isinstance(solver, ExactGeodesic)
        return solver.between(self._local(component, u), self._local(component, v))

    def _local(self, component: Component, pieces: Pieces) -> Pieces:
        """Pieces in the component's numbers."""
        own = np.flatnonzero(self.surface.component_of_vertex[self.surface.faces[:, 0]] == component.index)
        return replace(pieces, faces=np.searchsorted(own, pieces.faces), corners=component.local(pieces.corners))

    def _along_edges(self, component: Component, u: Pieces, v: Pieces) -> FloatArray:
        """(k,) from corner to corner, and straight to both."""
        solver, found = self._solvers[component.index], np.empty(len(u))
        assert isinstance(solver, EdgeGeodesic)
        for start, mine in by_start(u):
            used = start.start[0] > 0
            offsets = _spread(start, self.surface)[1][0]
            lengths = solver.distances_with(component.local(start.corners[0][used]), offsets[used])
            some = v.some(mine)
            ways = lengths[component.local(some.corners)] + _spread(some, self.surface)[1]
            found[mine] = np.where(some.start > 0, ways, np.inf).min(axis=1)
        return found

    def _by_heat(self, u: Pieces, v: Pieces) -> FloatArray:
        """(k,) of fields from u what they are at v, linear in faces."""
        found = np.empty(len(u))
        for start, mine in by_start(u):
            field = self.from_pieces(start)
            found[mine] = (v.start[mine] * field[v.corners[mine]]).sum(axis=1)
        return found


def _spread(pieces: Pieces, surface: Surface) -> tuple[FloatArray, FloatArray]:
    """(k, 3) what the corners have of each piece, as a length, and (k, 3) how far they are from it.

    A point counts as much as an edge.
    """
    start, stop = pieces.positions(surface.vertices)
    way = stop - start
    length = np.linalg.norm(way, axis=1)
    edge = surface.mean_edge_length
    load = np.where(pieces.along, np.maximum(length, TINY * edge), edge)
    loads = load[:, None] * (pieces.start + pieces.stop) / 2
    to = surface.vertices[pieces.corners] - start[:, None]
    share = np.einsum("kcx,kx->kc", to, way) / np.where(length > 0, length, 1)[:, None] ** 2
    return loads, np.linalg.norm(to - np.clip(share, 0, 1)[..., None] * way[:, None], axis=2)
