"""What every distance has in common: the questions it answers, what it is called, and how exact it is."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..errors import SolverError
from ..laplacian import Component, Laplacian
from ..memo import Memo
from ..mesh_like import MeshLike, Rows
from ..progress import Progress
from .accuracy import POOR, ErrorEstimate, accurate_to, rounded_up
from .pair_questions import PairQuestions

FINEST = 1e-12
"""The least an accuracy is said to be: estimates look at some pairs, and others may be rounded worse."""


class Distance(PairQuestions):
    """A distance between the vertices of a surface.

    `identity` is the spec it was made from, in full, if any.  `label` says what it is and how it was computed;
    `length_power` how it scales: a surface s times as large has distances s ** length_power times as large.  Distances
    between components, and of vertices that belong to no face, are NaN.  A vertex asked for that does not exist or
    belongs to no face is a VertexError.

    It is constructed from a Laplacian, whose work distances share, or from any mesh that `Surface.of` takes.
    Constructing a distance does its long work on the largest component; on another, the first question does.  Pickled,
    it is what it was constructed from, and the first question there does the work again; `Laplacian.pickles_factors`
    lets factors and eigenpairs travel with it.

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
        """The unit of the values, in words: how they scale with the surface.

        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=2)
        >>> bihdist.BiharmonicDistance(sphere).unit
        'mesh units'
        >>> bihdist.CommuteTimeDistance(sphere).unit
        'no unit'
        """
        known = {1.0: "mesh units", 0.0: "no unit", -1.0: "1 / mesh units"}
        return known.get(self.length_power, f"mesh units^{self.length_power:g}")

    @property
    def accuracy(self) -> float | None:
        """How far a field may be from what `label` says, as a fraction of its maximum: an estimate on the safe side.

        It holds for the components that were asked about (the largest, if none was) and is made when first wanted,
        in less than a tenth of the time the distance took to construct.  None for geodesic distances.

        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> distance.accuracy < 1e-10
        True
        """
        return self._accuracy_of(self._those(None))

    def _those(self, components: Sequence[int] | None) -> Sequence[int]:
        """Numbers of components: these, or those that were asked about, or else the largest."""
        return (sorted(self._asked) or [0]) if components is None else components

    def _accuracy_of(self, components: Sequence[int]) -> float | None:
        known = [self._accuracy_on(self.laplacian.components[index]) for index in components]
        return None if None in known else max(a for a in known if a is not None)

    def takes_long(self, progress: Progress | None = None) -> bool:
        """Whether a source takes more than some 5 s, so that something quicker is worth showing meanwhile.

        >>> import bihdist, pyvista
        >>> bihdist.GeodesicDistance(pyvista.Icosphere(nsub=3), "exact").takes_long()
        False
        """
        return False

    def error_estimate(
        self, components: Sequence[int] | None = None, progress: Progress | None = None
    ) -> ErrorEstimate:
        """The accuracy in words, on components with these numbers, or on those that were asked about.

        SolverError if it is worse than a thousandth: then answers there should not be used.

        >>> import bihdist, pyvista
        >>> sphere = pyvista.Icosphere(nsub=3)
        >>> bihdist.GeodesicDistance(sphere, "dijkstra").error_estimate().text
        'accurate to 10 % of the maximum typically, and worse on thin faces, however fine the mesh'
        """
        components = self._those(components)
        accuracy = self._accuracy_of(components)
        if accuracy is None:
            return ErrorEstimate()
        if accuracy > POOR:
            off = "by any amount" if accuracy == np.inf else f"by {rounded_up(accuracy)} of its maximum"
            raise SolverError(
                f"{self.label} on {self.surface.name} may be off {off}, so it is not given. {self._remedy(components)}"
            )
        return ErrorEstimate.of(accuracy, self._said_of(accuracy, components))

    def _said_of(self, accuracy: float, components: Sequence[int]) -> str:
        """The accuracy in words, with what it is the accuracy of where that is not the distance itself."""
        return accurate_to(accuracy)

    def is_judged(self, component: int) -> bool:
        """Whether the accuracy on a component is known, so that `error_estimate` costs nothing.

        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=2))
        >>> before = distance.is_judged(0)
        >>> _ = distance.accuracy
        >>> before, distance.is_judged(0)
        (False, True)
        """
        return component in self._accuracies

    def _remedy(self, components: Sequence[int]) -> str:
        """What would help where the accuracy on these components is too poor: a sentence."""
        mine = np.isin(self.surface.component_of_vertex[self.surface.faces[:, 0]], components)
        heights = np.where(mine, self.surface.face_heights, np.inf)
        flattest = int(heights.argmin())
        return (
            f"Its faces are too thin, or differ too much in size (face {flattest} is {heights[flattest]:.0e} of its "
            "longest side high); remeshing would help."
        )

    def _accuracy_on(self, component: Component) -> float | None:
        if component.index not in self._accuracies:
            self.prepare(component)
            # Where numbers end, the estimate is infinite.
            with np.errstate(all="ignore"):
                accuracy = self._estimated_accuracy(component)
            if accuracy is not None:
                accuracy = np.inf if np.isnan(accuracy) else max(accuracy, FINEST)
            self._accuracies[component.index] = accuracy
        return self._accuracies[component.index]

    def _estimated_accuracy(self, component: Component) -> float | None:
        """`accuracy` on one component."""
        return None
