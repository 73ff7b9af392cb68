"""Geodesic distance: exact, by the heat method, or along edges (Dijkstra).  The label says which."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..kernel import library as kernel
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike
from ..progress import Progress, part, turn
from ..sources.pieces import Pieces
from ..surface import Surface
from .accuracy import ErrorEstimate
from .distance import Distance
from .edge_geodesic import EdgeGeodesic
from .exact_geodesic import ExactGeodesic, check_radius
from .exact_work import expected_windows
from .heat_accuracy import HeatErrors, below_straight_line, heat_errors
from .heat_times import HeatTimes
from .place_pairs import by_start, straight

METHODS = ("auto", "exact", "heat", "dijkstra")
MOST_WINDOWS = 30_000_000
"""The work, as is expected for a source, up to which `auto` takes the exact method: some 4 s, which smooth surfaces of
120,000 vertices take, and scanned ones of 300,000 and more."""

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
    edges: 4 to 6 % too long in the mean on most samples), or "auto": exact where a source is expected to take 5 s at
    most, else heat; heat also from the first source on for which the exact method gives up, as `label` then says.  On
    long, thin faces, such as those of the sample `part`, the means are 5 and 13 %.  radius: how far the exact method
    goes, in the mesh's length unit; distances beyond are inf.  With one "auto" is exact, however large the surface.

    Raises ParameterError for any other word, a radius that is no length, and one for another method; SolverError for
    "exact" without the compiled kernel, or where it gives up; "auto" is heat there.

    >>> import bihdist
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> bihdist.GeodesicDistance(square).from_source(1).round(3).tolist()
    [1.0, 0.0, 1.0, 1.414]
    >>> # along edges: 2 instead of 1.414
    >>> bihdist.GeodesicDistance(square, "dijkstra").from_source(1).tolist()
    [1.0, 0.0, 1.0, 2.0]
    """

    length_power = 1.0

    def __init__(
        self,
        laplacian: Laplacian | MeshLike,
        method: str = "auto",
        progress: Progress | None = None,
        *,
        radius: float = np.inf,
    ) -> None:
        if method not in METHODS:
            raise ParameterError(f"There is no geodesic method {method!r}; choose one of {', '.join(METHODS)}.")
        check_radius(radius)
        super().__init__(laplacian)
        self._solvers: Memo[int, ExactGeodesic | HeatTimes | EdgeGeodesic] = Memo()
        self._takes_long: bool | None = None
        self._is_auto = method == "auto" and radius == np.inf
        if method == "auto":
            is_short = radius < np.inf and kernel.library() is not None
            method = "exact" if is_short or self._is_exact_soon(part(progress, 0, 0.3)) else "heat"
        if radius < np.inf and method != "exact":
            raise ParameterError(f"Only the exact method has a radius, not {method}.")
        self.method = method
        self.radius = radius
        self.label = LABELS[method]
        self.is_symmetric = method != "heat"
        self._errors: Memo[int, HeatErrors | None] = Memo()
        self._below = 0.0
        self.prepare(self.laplacian.components[0], part(progress, 0.3, 1))

    def _is_exact_soon(self, progress: Progress) -> bool:
        """Whether the exact method can be had, and answers within some seconds."""
        if kernel.library() is None:
            return False
        component = self.laplacian.components[0]
        try:
            exact = ExactGeodesic(component.surface)
            self._takes_long = takes_long(exact, progress)
        except SolverError:
            return False
        if not self._takes_long:
            self._solvers[component.index] = exact
        return not self._takes_long

    def takes_long(self, progress: Progress | None = None) -> bool:
        """Whether a source is expected to take more than some 5 s, from a trial where the surface is large.

        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3), "exact").takes_long()
        False
        """
        if self.method != "exact":
            return False
        if self._takes_long is None:
            self.prepare(self.laplacian.components[0])
            solver = self._solvers[0]
            assert isinstance(solver, ExactGeodesic)
            self._takes_long = takes_long(solver, progress)
        return self._takes_long

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Make the solver of a component, if that is not done.

        >>> import bihdist, pyvista
        >>> both = pyvista.Icosphere(nsub=2) + pyvista.Icosphere(nsub=1, center=(3, 0, 0))
        >>> distance = bihdist.GeodesicDistance(both)
        >>> distance.prepare(distance.laplacian.components[1])
        >>> round(distance.between(162, 163), 3)
        1.966
        """
        if component.index not in self._solvers:
            if self.method == "exact":
                self._solvers[component.index] = exact = ExactGeodesic(component.surface)
                if self.radius == np.inf:
                    takes_long(exact, progress)  # whose trial tells how long a field will take
            elif self.method == "heat":
                self._solvers[component.index] = HeatTimes(component, progress)
            else:
                self._solvers[component.index] = EdgeGeodesic(component.surface)

    def error_estimate(
        self, components: Sequence[int] | None = None, progress: Progress | None = None
    ) -> ErrorEstimate:
        """How far the method is off, with a warning; nothing for the exact one.

        The heat method is compared with exact distances on each component once; by less than it is known to have fallen
        below a straight line it is not off.

        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> bihdist.GeodesicDistance(sphere, "heat").error_estimate().text
        'accurate to 0.56 % of the maximum in the mean and 1.4 % at the worst, as measured from 8 vertices'
        """
        if self.method == "heat":
            with turn(self._errors.lock, progress, "waiting for the accuracy"):
                found = [
                    self._errors_on(self.laplacian.components[index], progress) for index in self._those(components)
                ]
            measured = [errors for errors in found if errors is not None]
            if len(measured) == len(found):
                return max(measured, key=lambda errors: errors.largest).estimate(self._below)
        return TYPICALLY[self.method]

    def _errors_on(self, component: Component, progress: Progress | None) -> HeatErrors | None:
        if component.index not in self._errors:
            self.prepare(component, progress)
            solver = self._solvers[component.index]
            assert isinstance(solver, HeatTimes)
            self._errors[component.index] = heat_errors(component.surface, solver, progress)
        return self._errors[component.index]

    def is_judged(self, component: int) -> bool:
        """Whether the heat method's errors on a component are known.

        >>> import bihdist, pyvista
        >>> heat = bihdist.GeodesicDistance(pyvista.Icosphere(nsub=2), "heat")
        >>> before, estimate = heat.is_judged(0), heat.error_estimate()
        >>> before, heat.is_judged(0)
        (False, True)
        """
        return self.method != "heat" or component in self._errors

    def _or_by_heat(self, found: Callable[[], FloatArray], progress: Progress | None) -> FloatArray:
        """What is found, by the heat method from now on where the exact method of "auto" gives up."""
        method = self.method
        try:
            return found()
        except SolverError:
            if not self._is_auto or method == "heat":
                raise
        with self._solvers.lock:
            if self.method == "exact":
                solvers = {index: HeatTimes(self.laplacian.components[index], progress) for index in self._solvers}
                self.method, self.label, self.is_symmetric = "heat", LABELS["heat"], False
                self._solvers.update(solvers)
        return found()

    def _columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        return self._or_by_heat(lambda: self._columns_now(component, index, progress), progress)

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        return self._or_by_heat(lambda: self._from_pieces_now(component, pieces, progress), progress)

    def _of_places(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        return self._or_by_heat(lambda: self._of_places_now(u, v, progress), progress)

    def _columns_now(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        solver = self._solvers[component.index]
        if isinstance(solver, ExactGeodesic):
            return solver.columns(index, progress, radius=self.radius)
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

    def _one_way(
        self, component: Component, sources: IntArray, targets: IntArray, progress: Progress | None
    ) -> FloatArray:
        def found() -> FloatArray:
            solver = self._solvers[component.index]
            if isinstance(solver, ExactGeodesic):
                return solver.of_pairs(sources, targets, progress, radius=self.radius)
            return super(GeodesicDistance, self)._one_way(component, sources, targets, progress)

        return self._or_by_heat(found, progress)

    def _from_pieces_now(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        solver, vertices = self._solvers[component.index], pieces.vertices
        if isinstance(solver, ExactGeodesic):
            sources = self._local(component, pieces) if vertices is None else component.local(vertices)
            return solver.distances(sources, progress, radius=self.radius)
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

    def _of_places_now(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        labels = self.surface.component_of_vertex
        found = np.full(len(u), np.nan)
        for component, mine, step in self._by_component(u.corners[:, 0], progress):
            mine = mine[labels[v.corners[mine, 0]] == component.index]
            if len(mine):
                step = self._prepared(component, step)
                one, other = u.some(mine), v.some(mine)
                if self.method == "exact":
                    found[mine] = self._exactly(component, one, other, step)
                elif self.method == "dijkstra":
                    found[mine] = self._along_edges(component, one, other, step)
                else:
                    there = self._by_heat(one, other, part(step, 0, 0.5))
                    found[mine] = (there + self._by_heat(other, one, part(step, 0.5, 1))) / 2
        # Within a face nothing is shorter.
        lengths = straight(u, v, self.surface)
        return np.where(np.isfinite(lengths) & (lengths <= self.radius), lengths, found)

    def _exactly(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """(k,) of the windows that reach one of both."""
        solver = self._solvers[component.index]
        assert isinstance(solver, ExactGeodesic)
        ends = self._local(component, u), self._local(component, v)
        return solver.between(*ends, progress, radius=self.radius)

    def _local(self, component: Component, pieces: Pieces) -> Pieces:
        """Pieces in the component's numbers."""
        own = np.flatnonzero(self.surface.component_of_vertex[self.surface.faces[:, 0]] == component.index)
        return replace(pieces, faces=np.searchsorted(own, pieces.faces), corners=component.local(pieces.corners))

    def _along_edges(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """(k,) from corner to corner, and straight to both."""
        solver, found = self._solvers[component.index], np.empty(len(u))
        assert isinstance(solver, EdgeGeodesic)
        starts = list(by_start(u))
        for number, (start, mine) in enumerate(starts):
            progress(number / len(starts), self.label)
            used = start.start[0] > 0
            offsets = _spread(start, self.surface)[1][0]
            lengths = solver.distances_with(component.local(start.corners[0][used]), offsets[used])
            some = v.some(mine)
            ways = lengths[component.local(some.corners)] + _spread(some, self.surface)[1]
            found[mine] = np.where(some.start > 0, ways, np.inf).min(axis=1)
        return found

    def _by_heat(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        """(k,) of fields from u what they are at v, linear in faces."""
        found = np.empty(len(u))
        starts = list(by_start(u))
        for number, (start, mine) in enumerate(starts):
            progress(number / len(starts), self.label)
            field = self.from_pieces(start, part(progress, number / len(starts), (number + 1) / len(starts)))
            found[mine] = (v.start[mine] * field[v.corners[mine]]).sum(axis=1)
        return found


def takes_long(exact: ExactGeodesic, progress: Progress | None = None) -> bool:
    """Whether a field is expected to take more than MOST_WINDOWS."""
    # More than on any but long tubes: no trial is needed.
    if len(exact.surface.vertices) ** 1.5 <= MOST_WINDOWS:
        return False
    return expected_windows(exact, progress) > MOST_WINDOWS


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
