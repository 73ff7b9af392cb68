"""Geodesic distance: exact, approximate, by the heat method, or along edges (Dijkstra).  The label says which."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..kernel import library as kernel
from ..laplacian import Component, Laplacian, as_laplacian
from ..memo import locked_cached_property
from ..mesh_like import MeshLike
from ..progress import Progress, part
from ..sources.pieces import Pieces
from .accuracy import ErrorEstimate
from .distance import Distance
from .exact_geodesic import QUICK_WINDOWS, expected_windows
from .geodesic_accuracy import ERROR_SOURCES, FROM_LINES, MeasuredErrors
from .geodesic_fronts import check_radius
from .geodesic_solvers import (
    ApproximateSolver,
    EdgeSolver,
    ExactSolver,
    FallBack,
    GeodesicSolver,
    HeatSolver,
    VirtualSolver,
)
from .place_pairs import straight

OTHERS: dict[str, type[GeodesicSolver[Any]]] = {each.method: each for each in (VirtualSolver, HeatSolver, EdgeSolver)}
METHODS = ("auto", "exact", *OTHERS)


class GeodesicDistance(Distance):
    """Length of the shortest path; unit length.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, which distances share by being given it.
    method : {"auto", "exact", "virtual-sources", "heat", "dijkstra"}
        ``"exact"`` is right to rounding on any surface.  ``"virtual-sources"`` [1]_ needs no set-up, some 0.6 s for a
        million vertices, and is 0.1 to 0.3 % off in the mean on most samples; ``"heat"`` [2]_ 1 to 3 %, and
        ``"dijkstra"`` (along edges) 4 to 6 % too long.  On long, thin faces, such as those of the sample ``part``, the
        means are 0.7, 5 and 13 %.  ``"auto"`` is exact where a source is expected to take 5 s at most, else
        approximate by virtual sources, and so from the first source on for which the exact method gives up, as `label`
        then says.
    progress : callable, optional
        Called as ``progress(fraction, text)``.
    radius : float
        How far the exact method goes, in the mesh's length unit; distances beyond are inf.  With one, ``"auto"`` is
        exact however large the surface.

    Raises
    ------
    ParameterError
        For another method, a radius that is not a length, or a radius for a method that is not exact.
    SolverError
        For ``"exact"`` without the compiled kernel; questions raise it where the exact method gives up.

    References
    ----------
    .. [1] P. Trettner, D. Bommes, L. Kobbelt. Geodesic Distance Computation via Virtual Source Propagation. Computer
       Graphics Forum 40(5), 2021.
    .. [2] K. Crane, C. Weischedel, M. Wardetzky. Geodesics in Heat. ACM Transactions on Graphics 32(5), 2013.

    Examples
    --------
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
        # The heat method needs gradients in faces.
        super().__init__(as_laplacian(laplacian).of_faces())
        if not len(self.surface.faces):
            raise ParameterError(f"{self.surface.name}: geodesic distance needs faces, and there are none.")
        self.radius = radius
        self._solver = _solver(self.laplacian, method, radius, part(progress, 0, 0.3))
        if radius < np.inf and self.method != "exact":
            raise ParameterError(f"Only the exact method has a radius, not {self.method}.")
        self.prepare(self.laplacian.components[0], part(progress, 0.3, 1))

    @property
    def method(self) -> str:
        """The method in use, one of those that `method` may be but ``"auto"``.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3)).method
        'exact'
        """
        return self._solver.current.method

    @property
    def label(self) -> str:  # type: ignore[override]
        """The name of the distance with its method.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3)).label
        'geodesic, exact'
        """
        return self._solver.current.label

    @property
    def is_symmetric(self) -> bool:  # type: ignore[override]
        """Whether both ways of a pair have the same distance, which those of approximate methods do not.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3), "heat").is_symmetric
        False
        """
        return self._solver.current.is_symmetric

    def is_slow(self, progress: Progress | None = None) -> bool:
        """Return whether a source is expected to take more than some 5 s, from a trial where the surface is large.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        bool
            False for all methods but the exact one.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3), "exact").is_slow()
        False
        """
        return self._solver.current.is_slow(progress)

    def prepare(self, component: Component, progress: Progress | None = None) -> None:
        """Make the solver of a component, if it is not made.

        Parameters
        ----------
        component : Component
            A component of `laplacian`.
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> both = pyvista.Icosphere(nsub=2) + pyvista.Icosphere(nsub=1, center=(3, 0, 0))
        >>> distance = bihdist.GeodesicDistance(both)
        >>> distance.prepare(distance.laplacian.components[1])
        >>> round(distance.between(162, 163), 3)
        1.966
        """
        self._solver.current.prepare(component, progress)

    def error_estimate(
        self,
        components: Sequence[int] | None = None,
        progress: Progress | None = None,
        pieces: Sequence[Pieces] = (),
    ) -> ErrorEstimate:
        """Estimate how far the method is off.

        Parameters
        ----------
        components : sequence of int, optional
            The components that the fields are on; those that were asked about if None.
        progress : callable, optional
            Called as ``progress(fraction, text)``.
        pieces : sequence of Pieces
            What the fields start from, where they do not all start from vertices.

        Returns
        -------
        ErrorEstimate
            Empty for the exact method, a warning for the others.

        Notes
        -----
        Virtual sources and the heat method are compared with the exact field from `pieces`, as far as that goes in some
        seconds; without pieces, with exact fields from 8 vertices of each component once.  An amount by which a field
        of the heat method fell below a straight line counts, too.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> print(bihdist.GeodesicDistance(sphere, "heat").error_estimate().text.partition(";")[0])
        accurate to 0.55 % of the maximum in the mean and 1.3 % at the worst from 8 vertices
        """
        if not (pieces and self.is_measured_for_each_source):
            return self._solver.current.error_estimate(self._asked_components(components), progress)
        found = [self._estimate_from(each, progress) for each in pieces[:ERROR_SOURCES]]
        return max(found, key=lambda estimate: np.inf if estimate.share is None else estimate.share)

    @property
    def is_measured_for_each_source(self) -> bool:
        return isinstance(self._solver.current, ApproximateSolver)

    @locked_cached_property
    def _exact(self) -> ExactSolver:
        """What approximate fields are measured against."""
        return ExactSolver(self.laplacian)

    def _estimate_from(self, pieces: Pieces, progress: Progress | None) -> ErrorEstimate:
        """Compare the field from some pieces with the exact one, as far as that goes in some seconds."""
        field = self.from_pieces(pieces)
        try:
            windows = expected_windows(self._exact.solver(self.laplacian.components[0]), part(progress, 0, 0))
            radius = np.inf
            if windows > QUICK_WINDOWS:
                known = np.sort(field[np.isfinite(field)])
                radius = known[int(len(known) * (QUICK_WINDOWS / windows) ** (2 / 3)) - 1]
            true = GeodesicDistance(self.laplacian, "exact", radius=radius).from_pieces(pieces, progress)
            return MeasuredErrors.of(field, true).of_this_field()
        except SolverError:
            is_line = self.method == "heat" and bool(pieces.along.any())
            return FROM_LINES if is_line else self._solver.current.typically

    def has_error_estimate(self, component: int, pieces: Sequence[Pieces] = ()) -> bool:
        """Return whether the error estimate of fields on a component is known, so that it costs nothing.

        Parameters
        ----------
        component : int
            The number of a component.
        pieces : sequence of Pieces
            What the fields start from, where they do not all start from vertices.

        Returns
        -------
        bool
            False for approximate fields from `pieces`, whose errors are measured each time.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> heat = bihdist.GeodesicDistance(pyvista.Icosphere(nsub=2), "heat")
        >>> before, estimate = heat.has_error_estimate(0), heat.error_estimate()
        >>> before, heat.has_error_estimate(0)
        (False, True)
        """
        is_measured = bool(pieces) and self.is_measured_for_each_source
        return not is_measured and self._solver.current.has_error_estimate(component)

    def compute_columns(self, component: Component, index: IntArray, progress: Progress | None) -> FloatArray:
        return self._solver.answer(lambda solver: solver.columns(component, index, progress), progress)

    def _one_way(
        self, component: Component, sources: IntArray, targets: IntArray, progress: Progress | None
    ) -> FloatArray:
        return self._solver.answer(lambda solver: solver.of_pairs(component, sources, targets, progress), progress)

    def _from_pieces(self, component: Component, pieces: Pieces, progress: Progress | None) -> FloatArray:
        return self._solver.answer(lambda solver: solver.from_pieces(component, pieces, progress), progress)

    def _of_places(self, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        labels = self.surface.component_of_vertex
        found = np.full(len(u), np.nan)
        for component, mine, step in self._by_component(u.corners[:, 0], progress):
            mine = mine[labels[v.corners[mine, 0]] == component.index]
            if len(mine):
                found[mine] = self._between(component, u.select(mine), v.select(mine), self._prepared(component, step))
        # Within a face nothing is shorter.
        lengths = straight(u, v, self.surface)
        return np.where(np.isfinite(lengths) & (lengths <= self.radius), lengths, found)

    def _between(self, component: Component, u: Pieces, v: Pieces, progress: Progress) -> FloatArray:
        return self._solver.answer(lambda solver: solver.between(component, u, v, progress), progress)


def _solver(laplacian: Laplacian, method: str, radius: float, progress: Progress) -> GeodesicSolver[Any] | FallBack:
    """Return the solver of a method; "auto" chooses by a trial, unless a radius keeps the exact method short."""
    if method in OTHERS:
        return OTHERS[method](laplacian)
    exact = ExactSolver(laplacian, radius)
    if method == "exact" or (radius < np.inf and kernel.library() is not None):
        return exact
    try:
        is_slow = exact.is_slow(progress)
    except SolverError:
        is_slow = True
    other = VirtualSolver(laplacian) if kernel.library() is not None else HeatSolver(laplacian)
    return other if is_slow else FallBack(exact, other)
