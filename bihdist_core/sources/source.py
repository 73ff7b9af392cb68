"""Sources of distances, as frozen values that know no surface; no numpy is imported here.

A source is a vertex id, a `SurfacePoint` in a face, a `BoundaryLoop`, a `Curve`, or a `SourceSet` of these, whose
distance is the least of its members'.
"""

import math
from dataclasses import dataclass, field
from typing import Any

from ..errors import ParameterError
from ..scalars import whole_number

ROUNDING = 1e-9
"""Weights may miss their sum, or be below 0, by this much."""
MOST_PARTS = 100_000
"""Points of a curve and members of a set: more are a mistake."""


@dataclass(frozen=True)
class SurfacePoint:
    """A place in a face.

    Parameters
    ----------
    face : int
        The number of the face.
    weights : tuple of float
        The barycentric coordinates at its three corners, at least 0 and of sum 1.

    Raises
    ------
    ParameterError
        For other weights, or a face below 0.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> distance = bihdist.BiharmonicDistance(pyvista.Icosphere(nsub=3))
    >>> middle = bihdist.SurfacePoint(0, (1 / 3, 1 / 3, 1 / 3))
    >>> field = distance.from_source(middle)
    >>> bool(0 < field.min() < 0.1)  # no vertex is there
    True
    """

    face: int
    weights: tuple[float, float, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "face", whole_number(self.face, "A face"))
        try:
            weights = tuple(float(w) for w in self.weights)
        except (TypeError, ValueError):
            weights = ()
        if self.face < 0:
            raise ParameterError(f"Faces are numbered from 0, so {self.face} is not one.")
        # isclose is false for what is no number.
        if len(weights) != 3 or not all(w >= 0 for w in weights) or not math.isclose(sum(weights), 1):
            raise ParameterError(
                f"A place in a face has three weights of at least 0 that add up to 1, not {self.weights}."
            )
        object.__setattr__(self, "weights", weights)

    @staticmethod
    def of(face: int, first: float, second: float) -> "SurfacePoint":
        """Make a place from the weights of the first two corners.

        Parameters
        ----------
        face : int
            The number of the face.
        first, second : float
            The weights, at least 0; the third corner gets the rest.

        Returns
        -------
        SurfacePoint
            The place.

        Raises
        ------
        ParameterError
            If a weight is below 0, or both are more than 1 together.

        Examples
        --------
        >>> import bihdist
        >>> bihdist.SurfacePoint.of(311, 0.2, 0.5)
        SurfacePoint(face=311, weights=(0.2, 0.5, 0.3))
        """
        # 0.2 and 0.2 leave 0.6, not 0.6000000000000001.
        rest = round(1 - first - second, 15)
        if not (first >= 0 and second >= 0 and rest >= -ROUNDING):
            raise ParameterError(
                f"The weights of a place in a face are at least 0 and add up to 1; {first:g} and {second:g} leave "
                f"{rest:g} for the third corner."
            )
        third = max(rest, 0.0)
        if max(first, second, third) > 1 - 1e-15:
            # What differs from a corner by rounding alone is the corner.
            first, second, third = (float(weight > 0.5) for weight in (first, second, third))
        return SurfacePoint(face, (first, second, third))


@dataclass(frozen=True)
class BoundaryLoop:
    """A connected piece of the boundary as a source, all along its edges.

    Parameters
    ----------
    number : int
        The position by length, 0 for the longest; loops of equal length (to nine digits) come by their least vertex.

    Raises
    ------
    ParameterError
        For a number below 0.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> from_rim = bihdist.GeodesicDistance(plane).from_source(bihdist.BoundaryLoop(0))
    >>> round(float(from_rim[40]), 6)  # vertex 40 is the middle of the unit square
    0.5
    """

    number: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "number", whole_number(self.number, "The number of a boundary loop"))
        if self.number < 0:
            raise ParameterError(f"Boundary loops are numbered from 0, the longest, so {self.number} is not one.")


@dataclass(frozen=True)
class Curve:
    """A curve on the surface as a source, all along it.

    Parameters
    ----------
    places : tuple of SurfacePoint
        The points it leads through.
    closed : bool
        Whether it leads from the last back to the first.

    Raises
    ------
    ParameterError
        For too few or too many places, or what is not a SurfacePoint.

    Notes
    -----
    Places in one face are joined straight, others where a plane through both cuts the surface: upright on it, or turned
    where that does not lead from one to the other.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> left = bihdist.SurfacePoint(0, (1, 0, 0))
    >>> right = bihdist.SurfacePoint(14, (0, 1, 0))
    >>> along_an_edge = bihdist.Curve((left, right))
    >>> field = bihdist.GeodesicDistance(plane).from_source(along_an_edge)
    >>> # the middle of the square, and the side opposite
    >>> field[[40, 80]].round(3).tolist()
    [0.5, 1.0]
    """

    places: tuple[SurfacePoint, ...]
    closed: bool = False

    def __post_init__(self) -> None:
        for place in self.places:
            if not isinstance(place, SurfacePoint):
                raise ParameterError(f"A curve goes through places in faces, not through {place!r}.")
        # The third weight is the rest to the last bit, as in what is written.
        object.__setattr__(
            self, "places", tuple(SurfacePoint.of(place.face, *place.weights[:2]) for place in self.places)
        )
        if not 2 <= len(self.places) <= MOST_PARTS:
            raise ParameterError(f"A curve has from 2 to {MOST_PARTS:,} points, not {len(self.places)}.")


Member = int | SurfacePoint | BoundaryLoop | Curve


@dataclass(frozen=True)
class SourceSet:
    """Several vertices, places, loops or curves as one source; the distance is from the nearest.

    Parameters
    ----------
    members : tuple
        Vertex ids, SurfacePoint, BoundaryLoop and Curve objects; each is kept once.

    Raises
    ------
    ParameterError
        For a set without members or with too many, and for a member that cannot be a source.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> plane = pyvista.Plane(i_resolution=8, j_resolution=8)
    >>> distance = bihdist.GeodesicDistance(plane)
    >>> corners = bihdist.SourceSet((0, 8, 72, 80))
    >>> distance.from_source(corners).max().round(3).item()
    0.707
    >>> distance.from_source(0).max().round(3).item()
    1.414
    """

    members: tuple[Member, ...] = field(default=())

    def __post_init__(self) -> None:
        members = dict.fromkeys(_member(each) for each in self.members)
        object.__setattr__(self, "members", tuple(members))
        if not 1 <= len(members) <= MOST_PARTS:
            raise ParameterError(f"A set of sources has from 1 to {MOST_PARTS:,} members, not {len(members)}.")


Source = int | SurfacePoint | BoundaryLoop | Curve | SourceSet
"""The start of a distance; an int is a vertex id."""


def checked_source(value: Any) -> Source:
    """Return a source as it is, or read from a whole number or words; ParameterError for anything else."""
    if isinstance(value, str):
        from .words import source_from_words

        return source_from_words(value)
    return value if isinstance(value, SourceSet) else _member(value)


def _member(value: Any) -> Member:
    if isinstance(value, SurfacePoint | BoundaryLoop | Curve):
        return value
    if isinstance(value, SourceSet):
        raise ParameterError("A set of sources has no sets among its members; name all of them in one.")
    try:
        vertex = whole_number(value, "A vertex id")
    except ParameterError:
        raise ParameterError(
            f"A source is a vertex id, a SurfacePoint, a BoundaryLoop, a Curve, a SourceSet, or words such as '12+40', "
            f"not "
            f"{value!r}."
        ) from None
    if vertex < 0:
        raise ParameterError(f"Vertex ids start at 0, so {vertex} is not one.")
    return vertex
