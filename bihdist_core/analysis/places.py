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
    """k places on a surface: faces (k,), the ids of their corners (k, 3), and weights (k, 3), at least 0, of sum 1.

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
        """Vertices and places in faces, or their words, checked.

        Raises VertexError for a bad vertex; ParameterError for other sources, and for a face that does not exist.

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
        """The surface divided so that each of the places is a vertex.

        >>> import bihdist
        >>> triangle = bihdist.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> split = bihdist.Places.of(triangle, ["f0:0.5,0.25"]).split(triangle)
        >>> split.surface.n_vertices, split.surface.n_faces
        (4, 3)
        """
        return split_at(Surface.of(surface), self.faces, self.weights, APART)

    def values(self, field: npt.ArrayLike) -> FloatArray:
        """(k,) or (k, d): values (n,) or (n, d) at the vertices, interpolated linearly.

        >>> import bihdist
        >>> triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        >>> bihdist.Places.of(triangle, ["f0:0.5,0.25"]).values([10, 20, 30]).tolist()
        [17.5]
        """
        return weighted(np.asarray(field), self.corners, self.weights)


def weighted(at: FloatArray, corners: IntArray, weights: FloatArray) -> FloatArray:
    """(k,) or (k, d): sums over corners (k, 3) of values `at` them; those of weight 0 do not count, finite or not."""
    w = weights.reshape(*weights.shape, *(1,) * (at.ndim - 1))
    sums: FloatArray = (w * np.where(w > 0, at[corners], 0)).sum(axis=1)
    return sums


def place_words(place: int | SurfacePoint | str) -> str:
    """How a sentence names a place."""
    return short_words_of(checked_source(place))


def component_of(surface: Surface, places: Sequence[int | SurfacePoint | str], found: Places) -> int:
    """The component that places are on, as they were given and as found; ParameterError if they are on several."""
    label = surface.component_of_vertex[found.corners[:, 0]]
    if (label != label[0]).any():
        first, other = place_words(places[0]), place_words(places[int((label != label[0]).argmax())])
        raise ParameterError(f"Nothing on {surface.name} joins {first} and {other}: they are on different components.")
    return int(label[0])
