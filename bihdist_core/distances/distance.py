"""The base of all distances: the questions that each answers, its names, and its accuracy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError, SolverError
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike, Rows
from ..point_cloud import PointCloud
from ..progress import Progress, silent, steps
from ..sources.pieces import Pieces
from ..surface import Surface
from ..tetrahedra import TetrahedralMesh
from .accuracy import FINEST_ACCURACY, POOR_ACCURACY, ErrorEstimate, accurate_to, rounded_up
from .pair_questions import PairQuestions


def unit_of(length_power: float, surface: Surface | None = None) -> str:
    """Return the unit of values that scale with this power of lengths, on a mesh or this surface, in words."""
    if surface is not None and not (len(surface.faces) or isinstance(surface, PointCloud | TetrahedralMesh)):
        return "the unit of the matrices"
    known = {1.0: "mesh units", 0.0: "no unit", -1.0: "1 / mesh units", -2.0: "1 / mesh units^2"}
    return known.get(length_power, f"mesh units^{length_power:g}")


class Distance(PairQuestions):
    """A distance between the vertices of a surface; the base of all distances.

    Parameters
    ----------
    laplacian : Laplacian or MeshLike
        The surface, or its Laplacian, whose work distances share; or vertices (n, 3).
    faces : (m, 3) array_like of int, optional
        The faces, if `laplacian` is vertices.

    Attributes
    ----------
    label : str
        What the distance is and how it was computed.
    length_power : float
        A surface s times as large has distances s ** length_power times as large.
    identity : str
        The canonical text of the spec it was made from; empty if there is none.

    Notes
    -----
    Distances between components, and of vertices that belong to no face, are NaN.  The constructor does the long work
    on the largest component; on another, the first question does.  A pickle holds what the distance was constructed
    from, and the first question does the work again; `Laplacian.pickles_factors` lets factors and eigenpairs travel
    with it.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> for kind in (bihdist.BiharmonicDistance, bihdist.DiffusionDistance):
    ...     distance = kind(sphere)
    ...     print(f"{distance.label}: scales by power {distance.length_power:g}")
    biharmonic, exact: scales by power 1
    diffusion, t = 1: scales by power -1
    """

    label: str
    length_power: float
    identity = ""

    def __init__(self, laplacian: Laplacian | MeshLike | Rows, faces: npt.ArrayLike | None = None) -> None:
        super().__init__(laplacian, faces)
        self._accuracies: Memo[int, float | None] = Memo()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.label}, on {self.surface!r})"

    @property
    def unit(self) -> str:
        """The unit of the values in words, which says how they scale with the surface.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=2)
        >>> bihdist.BiharmonicDistance(sphere).unit
        'mesh units'
        >>> bihdist.CommuteTimeDistance(sphere).unit
        'no unit'
        """
        # Eigenfunctions are normalised by area, or by volume.
        return unit_of(self.length_power - (self.surface.dimension - 2) / 2, self.surface)

    @property
    def accuracy(self) -> float | None:
        """How far a field may be from what `label` says, as a fraction of its maximum, estimated on the safe side.

        It holds for the components that were asked about (the largest, if none was), from any vertex; that of a
        distance by eigenpairs also for the places, curves and sets that were asked about.  It is made when first
        wanted, for the biharmonic distance in about a fifth of the time it took to construct.  None for geodesic
        distances.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> distance.accuracy < 1e-10
        True
        """
        return self._accuracy_of(self._asked_components(None))

    def _asked_components(self, components: Sequence[int] | None) -> Sequence[int]:
        """Return the components given, or those that were asked about, or else the largest, by number."""
        return (sorted(self._asked) or [0]) if components is None else components

    def _accuracy_of(
        self, components: Sequence[int], pieces: Sequence[Pieces] = (), progress: Progress | None = None
    ) -> float | None:
        """Return the accuracy on components of fields from vertices, and from some pieces of the surface."""
        known = [self._accuracy_on(self.laplacian.components[index], progress) for index in components]
        return None if None in known else max(a for a in known if a is not None)

    def is_slow(self, progress: Progress | None = None) -> bool:
        """Return whether a source takes more than some 5 s, so that something quicker is worth showing meanwhile.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        bool
            False, but for exact geodesic distance on large surfaces.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3), "exact").is_slow()
        False
        """
        return False

    @property
    def is_measured_for_each_source(self) -> bool:
        """Whether the error of each field is measured, so that `error_estimate` has to be told what it starts from.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=2)).is_measured_for_each_source
        False
        """
        return False

    def error_estimate(
        self,
        components: Sequence[int] | None = None,
        progress: Progress | None = None,
        pieces: Sequence[Pieces] = (),
    ) -> ErrorEstimate:
        """Say in words how accurate fields are.

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
            Empty for an exact geodesic distance.

        Raises
        ------
        SolverError
            If it is worse than a thousandth: then answers there should not be used.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> bihdist.GeodesicDistance(sphere, "dijkstra").error_estimate().text
        'accurate to 10 % of the maximum typically, and worse on thin faces, however fine the mesh'
        """
        components = self._asked_components(components)
        accuracy = self._accuracy_of(components, pieces, progress)
        if accuracy is None:
            return ErrorEstimate()
        if accuracy > POOR_ACCURACY:
            off = "by any amount" if accuracy == np.inf else f"by {rounded_up(accuracy)} of its maximum"
            raise SolverError(
                f"{self.label} on {self.surface.name} may be off {off}, so it is not given. {self._advice(components)}"
            )
        return ErrorEstimate.of(accuracy, self._accuracy_text(accuracy, components, pieces))

    def _accuracy_text(self, accuracy: float, components: Sequence[int], pieces: Sequence[Pieces] = ()) -> str:
        """Return the accuracy in words."""
        return accurate_to(accuracy)

    def has_error_estimate(self, component: int, pieces: Sequence[Pieces] = ()) -> bool:
        """Return whether the accuracy on a component is known, so that `error_estimate` costs nothing.

        Parameters
        ----------
        component : int
            The number of a component.
        pieces : sequence of Pieces
            What the fields start from, where they do not all start from vertices.

        Returns
        -------
        bool
            True once it was estimated.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=2))
        >>> before = distance.has_error_estimate(0)
        >>> _ = distance.accuracy
        >>> before, distance.has_error_estimate(0)
        (False, True)
        """
        return component in self._accuracies

    def _advice(self, components: Sequence[int]) -> str:
        """Return a sentence on what would help where the accuracy on these components is too poor."""
        if not len(self.surface.faces):
            return "Its entries differ too much in size."
        mine = np.isin(self.surface.component_of_vertex[self.surface.faces[:, 0]], components)
        heights = np.where(mine, self.surface.face_heights, np.inf)
        flattest = int(heights.argmin())
        return (
            f"Its faces are too thin, or differ too much in size (face {flattest} is {heights[flattest]:.0e} of its "
            "longest side high); remeshing would help."
        )

    def _accuracy_on(self, component: Component, progress: Progress | None) -> float | None:
        if component.index not in self._accuracies:
            self.prepare(component)
            # Where numbers end, the estimate is infinite.
            with np.errstate(all="ignore"):
                accuracy = self._estimated_accuracy(component, progress or silent)
            if accuracy is not None:
                accuracy = np.inf if np.isnan(accuracy) else max(accuracy, FINEST_ACCURACY)
            self._accuracies[component.index] = accuracy
        return self._accuracies[component.index]

    def _estimated_accuracy(self, component: Component, progress: Progress) -> float | None:
        """Return `accuracy` on one component."""
        return None


class FactoredDistance(Distance):
    """A distance by the factor of the Laplacian.

    It is made of a Laplacian, or of a mesh of any kind that `Surface.of` takes; vertices (n, 3) may be followed by
    their faces (m, 3).
    """

    is_quadratic = True

    def __init__(
        self,
        laplacian: Laplacian | MeshLike | Rows,
        faces: npt.ArrayLike | None = None,
        progress: Progress | None = None,
    ) -> None:
        super().__init__(laplacian, faces)
        self.prepare(self.laplacian.components[0], progress)

    def edge_distances(self, progress: Progress | None = None) -> tuple[IntArray, FloatArray]:
        """Compute the distance between the ends of every edge, by one selected inversion.

        Parameters
        ----------
        progress : callable, optional
            Called as ``progress(fraction, text)``.

        Returns
        -------
        edges : (e, 2) int64 ndarray
            The vertex ids, smaller first, where the stiffness matrix has an entry.
        distances : (e,) float64 ndarray
            In the distance's unit.

        Raises
        ------
        ParameterError
            Unless this is the biharmonic or the commute-time distance.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> edges, distances = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3)).edge_distances()
        >>> edges.shape, round(float(distances.max()), 3)
        ((1920, 2), 0.091)
        """
        edges, distances = [], []
        for step, component in steps(progress, self.laplacian.components):
            step = self._prepared(component, step)
            step(0.0, self.label)
            edges.append(component.vertices[np.stack(component.edges, axis=1)])
            distances.append(self._at_edges(component, step))
        return np.concatenate(edges), np.concatenate(distances)

    def _at_edges(self, component: Component, progress: Progress) -> FloatArray:
        """Return (e,) distances at the edges of a component."""
        raise ParameterError(f"{self.label} is not known at edges alone; ask of_pairs for some of them.")
