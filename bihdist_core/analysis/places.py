"""Places on a surface: vertices, or points in faces given by barycentric weights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..sources.pieces import points_on
from ..sources.source import SurfacePoint, checked_source
from ..sources.splitting import Split, split_at
from ..sources.words import short_words_of
from ..surface import Surface

ON_SIDE = 1e-12
"""A weight below this is 0: the place is on a side of its face, or in a corner."""

APART = 1e-9
"""Where a surface is split, weights below this are 0, and so places this near to each other are one."""


@dataclass(frozen=True, eq=False)
class Places:
    """Places on a surface: vertices, or points in faces.

    Attributes
    ----------
    faces : (k,) int64 ndarray
        A face that holds each place.
    corners : (k, 3) int64 ndarray
        The vertices of these faces.
    weights : (k, 3) float64 ndarray
        Barycentric weights of the corners, at least 0, of sum 1.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> places = bihdist.Places.of(plane, [40, "f0:0.25,0.25"])
    >>> places.corners[1].tolist()
    [0, 1, 10]
    >>> places.weights[1].tolist()
    [0.25, 0.25, 0.5]
    >>> places.values(plane.points[:, 0]).tolist()
    [0.0, -0.40625]
    """

    faces: IntArray
    corners: IntArray
    weights: FloatArray

    @classmethod
    def of(cls, surface: MeshLike, places: Sequence[int | SurfacePoint | str]) -> Places:
        """Make places of vertices, points in faces, or their words.

        Parameters
        ----------
        surface : MeshLike
            The mesh.
        places : sequence of int, SurfacePoint or str
            At least one.

        Returns
        -------
        Places
            The places in their order.

        Raises
        ------
        VertexError
            If a vertex is not on the surface.
        ParameterError
            For other sources, for a face that does not exist, and if there are no places.

        Examples
        --------
        >>> import bihdist
        >>> triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        >>> middle = bihdist.SurfacePoint(0, (0.5, 0.25, 0.25))
        >>> places = bihdist.Places.of(triangle, [2, middle])
        >>> places.weights.tolist()
        [[0.0, 0.0, 1.0], [0.5, 0.25, 0.25]]
        """
        surface = Surface.of(surface)
        if not len(places):
            raise ParameterError("No places were given; at least one is needed.")
        found = points_on(surface, places)
        weights = np.where(found.start <= ON_SIDE, 0, found.start)
        return cls(found.faces, found.corners, weights / weights.sum(axis=1, keepdims=True))

    def __len__(self) -> int:
        return len(self.faces)

    def split(self, surface: MeshLike) -> Split:
        """Divide the surface so that each place is a vertex.

        Parameters
        ----------
        surface : MeshLike
            The mesh that the places are on.

        Returns
        -------
        Split
            The divided surface, with the vertices that the places are.

        Examples
        --------
        >>> import bihdist
        >>> triangle = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> split = bihdist.Places.of(triangle, ["f0:0.5,0.25"]).split(triangle)
        >>> split.surface.n_vertices, split.surface.n_faces
        (4, 3)
        """
        return split_at(Surface.of(surface), self.faces, self.weights, APART)

    def values(self, field: npt.ArrayLike) -> FloatArray:
        """Interpolate a field, linear on each face, at the places.

        Parameters
        ----------
        field : (n,) or (n, d) array_like
            Values at the vertices of the surface.

        Returns
        -------
        (k,) or (k, d) ndarray
            Values at the places.

        Examples
        --------
        >>> import bihdist
        >>> triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        >>> bihdist.Places.of(triangle, ["f0:0.5,0.25"]).values([10, 20, 30]).tolist()
        [17.5]
        """
        return weighted(np.asarray(field), self.corners, self.weights)


def weighted(at: FloatArray, corners: IntArray, weights: FloatArray) -> FloatArray:
    """Return (k,) or (k, d) sums of values `at` corners (k, 3); corners of weight 0 do not count, even if NaN."""
    w = weights.reshape(*weights.shape, *(1,) * (at.ndim - 1))
    sums: FloatArray = (w * np.where(w > 0, at[corners], 0)).sum(axis=1)
    return sums


def place_words(place: int | SurfacePoint | str) -> str:
    """Name a place, for a sentence."""
    return short_words_of(checked_source(place))


def component_of(surface: Surface, places: Sequence[int | SurfacePoint | str], found: Places) -> int:
    """Return the component that all places are on; ParameterError if they are on several."""
    label = surface.component_of_vertex[found.corners[:, 0]]
    if (label != label[0]).any():
        first, other = place_words(places[0]), place_words(places[int((label != label[0]).argmax())])
        raise ParameterError(f"Nothing on {surface.name} joins {first} and {other}: they are on different components.")
    return int(label[0])
