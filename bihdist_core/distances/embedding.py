"""Points of a Euclidean space whose distances are the biharmonic ones within a bound, for whatever knows such points.

The distance is |G (e_i - e_j)| in the norm of the areas (paper, Eq. 4), so its components along vectors that are
orthonormal by area are coordinates: along the first k eigenvectors they are those of Eq. 11.  What is left of vertex i
has the squared length C_ii - |p_i|^2, and C_ii is known.  So the bound holds whether or not the eigenvectors have
converged, and no distance of points is larger than the true one.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, array_of
from ..errors import ParameterError
from ..laplacian import Component, Laplacian, as_laplacian
from ..mesh_like import MeshLike
from ..progress import Progress, part, silent
from ..scalars import real_number
from ..solver.tall import pair_distances
from .spectral import checked_count
from .tails import biharmonic_squares, tail_lengths

FIRST_EIGENPAIRS = 50
"""Eigenpairs that are tried first for a tolerance, and twice as many then."""
COLUMNS_PER_SOLVE = 32
"""Eigenvectors at a time, which bounds the memory."""


@dataclass(frozen=True, eq=False)
class Embedding:
    """Points of a Euclidean space that stand for the vertices, with a bound on the error of their distances.

    Attributes
    ----------
    points : (n, k) float64 ndarray
        In mesh units; NaN at vertices that belong to no face.
    tails : (n,) float64 ndarray
        The length of what the point leaves out of each vertex, in mesh units.
    components : (n,) int64 ndarray
        The component of each vertex, -1 for none.

    Notes
    -----
    Let p be the distance of two points of a component, and t the sum of their tails.  The biharmonic distance of the
    vertices is between p and sqrt(p^2 + t^2), but for rounding.  Distances between points of different components mean
    nothing: make an index for each.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
    >>> embedding = distance.embedding(k=50)
    >>> least, most = embedding.between([(0, 1)])
    >>> bool(least[0] <= distance.between(0, 1) <= most[0])
    True
    """

    points: FloatArray
    tails: FloatArray
    components: IntArray

    @property
    def bound(self) -> float:
        """How far the distance of two points may be below the biharmonic one, at worst; mesh units.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> [round(distance.embedding(k).bound, 3) for k in (10, 40, 160)]
        [0.2, 0.109, 0.063]
        """
        pairs = [np.sort(self.tails[mine])[-2:] for mine in self._each() if len(mine) > 1]
        return max((float(two.sum()) for two in pairs), default=0.0)

    def between(self, pairs: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the least and the most that pairs of vertices can be apart.

        Parameters
        ----------
        pairs : (q, 2) array_like of int
            Vertex ids.

        Returns
        -------
        least : (q,) float64 ndarray
            In mesh units; NaN between components.
        most : (q,) float64 ndarray
            In mesh units; NaN between components.

        Raises
        ------
        ParameterError
            For another shape, or a vertex that is not there.

        Examples
        --------
        >>> import bihdist, pyvista
        >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
        >>> least, most = distance.embedding(k=50).between([(0, 1), (0, 400)])
        >>> least.round(3).tolist()
        [0.462, 0.353]
        >>> most.round(3).tolist()
        [0.471, 0.364]
        >>> distance.of_pairs([(0, 1), (0, 400)]).round(3).tolist()
        [0.466, 0.359]
        """
        table = array_of(pairs, "Pairs of vertices")
        if table.ndim != 2 or table.shape[1] != 2 or table.dtype.kind not in "iu":
            raise ParameterError(f"Pairs of vertices are (q, 2) whole numbers, not {table.shape} of {table.dtype}.")
        if table.size and not (table.min() >= 0 and table.max() < len(self.points)):
            raise ParameterError(f"The vertices are 0 to {len(self.points) - 1}.")
        i, j = table.T
        least = pair_distances(self.points, i, j)
        most = np.sqrt(least**2 + np.where(i == j, 0, self.tails[i] + self.tails[j]) ** 2)
        is_apart = (self.components[i] != self.components[j]) | (self.components[i] < 0)
        least[is_apart] = most[is_apart] = np.nan
        return least, most

    def _each(self) -> Iterator[IntArray]:
        """Yield the vertices of each component."""
        for index in np.unique(self.components[self.components >= 0]):
            yield np.flatnonzero(self.components == index)


def biharmonic_embedding(
    laplacian: Laplacian | MeshLike,
    k: int | None = None,
    tolerance: float | None = None,
    progress: Progress | None = None,
) -> Embedding:
    """Return points with k coordinates, or with as many as bring `bound` below a tolerance in mesh units.

    A component with no more than k vertices uses all its eigenpairs.  The bound falls like 1 / sqrt(k): half of it
    takes four times as many.  Raises ParameterError unless one of the two is given, and for a bad number.
    """
    laplacian = as_laplacian(laplacian)
    if (k is None) == (tolerance is None):
        raise ParameterError("An embedding has k coordinates, or as many as a tolerance needs; give one of the two.")
    if tolerance is not None and not 0 < real_number(tolerance, "tolerance") < np.inf:
        raise ParameterError(f"tolerance is {tolerance:g}; it must be a length above 0.")
    count = checked_count(k) if k is not None else FIRST_EIGENPAIRS
    most = max(component.most_eigenpairs for component in laplacian.components)
    tried = 0
    while True:
        begin = 1 - 0.5**tried
        found = _embedding(laplacian, min(count, most), part(progress, begin, 1 if k else 1 - 0.5 ** (tried + 1)))
        if tolerance is None or found.bound <= tolerance or count >= most:
            (progress or silent)(1.0, "coordinates")
            return found if k is not None or tolerance is None else _fewest(found, tolerance)
        # The bound falls like the root of the count.
        count = int(count * np.clip(1.1 * (found.bound / tolerance) ** 2, 1.5, 4))
        tried += 1


def _embedding(laplacian: Laplacian, count: int, progress: Progress | None) -> Embedding:
    surface = laplacian.surface
    points = np.full((len(surface.vertices), count), np.nan)
    tails = np.full(len(surface.vertices), np.nan)
    total = len(laplacian.components)
    for number, component in enumerate(laplacian.components):
        step = part(progress, number / total, (number + 1) / total)
        mine = _coordinates(component, min(count, component.most_eigenpairs), step)
        padded = np.zeros((len(mine), count))
        padded[:, : mine.shape[1]] = mine
        points[component.vertices] = padded
        tails[component.vertices] = tail_lengths(biharmonic_squares(component), mine)
    return Embedding(points, tails, surface.component_of_vertex)


def _coordinates(component: Component, count: int, progress: Progress | None) -> FloatArray:
    """Return (m, count) G A phi, centred, which is phi / lambda for exact eigenvectors."""
    if count < 1:
        return np.zeros((len(component.vertices), 0))
    vectors = component.spectrum(count, part(progress, 0, 0.8)).eigenvectors[:, :count]
    found = np.empty(vectors.shape)
    for start in range(0, count, COLUMNS_PER_SOLVE):
        some = slice(start, start + COLUMNS_PER_SOLVE)
        found[:, some] = component.centred(component.solve(component.areas[:, None] * vectors[:, some]))
        (progress or silent)(0.8 + 0.2 * min(start + COLUMNS_PER_SOLVE, count) / count, "coordinates")
    return found


def _fewest(found: Embedding, tolerance: float) -> Embedding:
    """Return the embedding with no more coordinates than the tolerance needs."""
    # What the later coordinates hold goes into the tails.
    squares = found.tails[:, None] ** 2 + np.cumsum(found.points[:, ::-1] ** 2, axis=1)[:, ::-1]

    def first(count: int) -> Embedding:
        return replace(found, points=found.points[:, :count], tails=np.sqrt(squares[:, count]))

    counts = range(1, found.points.shape[1])
    enough = bisect_left(counts, True, key=lambda count: first(count).bound <= tolerance)
    return first(counts[enough]) if enough < len(counts) else found
