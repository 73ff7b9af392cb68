"""Sections of a surface by planes, from place to place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from ..arrays import FloatArray, IntArray, real_numbers
from ..errors import ParameterError
from ..mesh_like import MeshLike
from ..sources.source import SurfacePoint
from ..sources.splitting import Split
from ..surface import with_faces
from .isoline_tracing import Isoline, isolines
from .places import Places, component_of, place_words
from .surface_paths import Crossings, Stars, SurfacePath, assembled

PARTS = {
    "shorter": "section by a plane",
    "longer": "section by a plane, the longer way",
    "whole": "the whole section by a plane",
}
"""The parts of a section by name, with the words for them."""


def plane_section(
    surface: MeshLike, places: Sequence[int | SurfacePoint | str], direction: npt.ArrayLike, part: str = "shorter"
) -> SurfacePath:
    """Follow plane sections of a surface from place to place.

    Parameters
    ----------
    surface : MeshLike
        The mesh.
    places : sequence of int, SurfacePoint or str
        Two or more vertices or places in faces, in order. Each two define a plane, with the direction.
    direction : (3,) array_like
        A direction in the planes.
    part : {"shorter", "longer", "whole"}
        Which way along the section the path goes. "whole", for two places, is the whole curve on which both lie: from
        the first by the shorter way to the second and back to the first, or from end to end where it is open.

    Returns
    -------
    SurfacePath
        The path.

    Raises
    ------
    VertexError
        If a vertex is not on the surface.
    ParameterError
        For another part, fewer than two places, more than two for "whole", the same place twice in a row, places on
        different components, a direction that is not three finite numbers or leads from one place to the next, and
        where the section does not join the places, or does so in one way only and the longer is asked for.

    Examples
    --------
    >>> import bihdist, pyvista
    >>> sphere = pyvista.Icosphere(nsub=3)
    >>> path = bihdist.plane_section(sphere, [0, 1], sphere.points[0], part="whole")
    >>> round(path.length, 2)  # once round the unit sphere
    6.27
    """
    surface = with_faces(surface, "plane sections")
    d = real_numbers(direction, "The three numbers of a direction")
    if d.shape != (3,) or not np.isfinite(d).all():
        raise ParameterError(f"A direction is three finite numbers, not {direction!r}.")
    if part not in PARTS:
        raise ParameterError(f"A section has no part {part!r}; choose one of {', '.join(PARTS)}.")
    if len(places) < 2:
        raise ParameterError(f"A section joins two places or more; {len(places)} were given.")
    if part == "whole" and len(places) > 2:
        raise ParameterError(f"The whole section is that through two places; {len(places)} were given.")
    at = Places.of(surface, places)
    component_of(surface, places, at)
    split = at.split(surface)
    stars, parts, knots = Stars(split.surface), [], slice(None)
    for k, (start, stop) in enumerate(pairwise(split.vertices.tolist())):
        if start == stop:
            same = place_words(places[k])
            raise ParameterError(f"The places {k} and {k + 1} of a section are the same, {same}; leave one out.")
        found = _ways(split, start, stop, d)
        ends = f"{place_words(places[k])} and {place_words(places[k + 1])}"
        if not found:
            raise ParameterError(
                f"The section of {surface.name} by this plane does not join {ends}; turn the direction."
            )
        if part == "whole":
            pieces, knots = found[0].whole()
        elif part == "longer" and len(found) < 2:
            raise ParameterError(
                f"The section of {surface.name} joins {ends} in one way only; "
                "take the shorter part, or turn the direction."
            )
        else:
            pieces = [found[0 if part == "shorter" else -1].curve]
        parts += [Crossings(ends, t, stars.common(ends)) for ends, t in pieces]
    path = assembled(split, parts, "section", PARTS[part])
    return replace(path, knots=path.knots[knots])


IN_PLANE = 1e-12
"""Vertices nearer to a plane than this fraction of the surface's extent lie in it."""

TINY = float(np.finfo(float).tiny)
"""The height that vertices in the plane are given, so that they count as above it."""

Curve = tuple[IntArray, FloatArray]
"""Ends (k, 2) and parameters (k,) of its points, as in `Crossings`."""


@dataclass(frozen=True, eq=False)
class _Way:
    """A part of a line that leads from one vertex to another, by the numbers (k,) of its points."""

    line: Isoline
    index: IntArray

    @property
    def curve(self) -> Curve:
        return self._at(self.index)

    def _at(self, index: IntArray) -> Curve:
        ends, t = self.line.edges[index], self.line.parameters[index]
        at_vertex = t == 1
        return np.where(at_vertex[:, None], ends[:, 1:], ends), np.where(at_vertex, 0.0, t)

    def whole(self) -> tuple[list[Curve], slice]:
        """Return the pieces of the whole line, and which of their ends are the two vertices."""
        count, step = len(self.line.points), int(self.index[1] - self.index[0])
        if self.line.closed:
            step = step if abs(step) == 1 else -np.sign(step)  # across the last point
            back = (self.index[-1] + step * np.arange(count - len(self.index) + 2)) % count
            return [self.curve, self._at(back)], slice(None)
        before = np.arange(0 if step == 1 else count - 1, self.index[0] + step, step)
        after = np.arange(self.index[-1], count if step == 1 else -1, step)
        pieces = [self._at(before), self.curve, self._at(after)]
        knots = slice(int(len(before) > 1), -1 if len(after) > 1 else None)
        return [piece for piece in pieces if len(piece[1]) > 1], knots


def _ways(split: Split, start: int, stop: int, d: FloatArray) -> list[_Way]:
    """Return the ways along the section from one vertex to another, the shortest first; none where it does not lead."""
    x = split.surface.vertices
    normal = np.cross(x[stop] - x[start], d)
    size = np.linalg.norm(normal)
    if not size > 1e-12 * np.linalg.norm(x[stop] - x[start]) * np.linalg.norm(d):
        raise ParameterError("Two places and the direction between them make no plane; take another direction.")
    height = (x - x[start]) @ (normal / size)
    # Vertices that rounding keeps from the plane would be passed on either side.
    height[np.abs(height) <= IN_PLANE * np.linalg.norm(np.ptp(x, axis=0))] = 0
    height[[start, stop]] = 0
    # A vertex in the plane counts as above it, from either side: a place that is the highest one near it is met from
    # the other.
    for side in (height, -height):
        field = np.where(side == 0, TINY, side)
        found = [way for line in isolines(split.surface, field, [0.0]) for way in _between(line, start, stop)]
        if found:
            return sorted(found, key=lambda way: _length(way.line.points[way.index]))
    return []


def _between(line: Isoline, start: int, stop: int) -> list[_Way]:
    """Return the parts of a line that join two vertices, without passing one of them."""
    at_vertex = line.parameters == 1
    met = np.flatnonzero(at_vertex & ((line.edges[:, 1] == start) | (line.edges[:, 1] == stop)))
    turns = list(pairwise(met))
    if line.closed and len(met) > 1:
        turns.append((met[-1], met[0] + len(at_vertex)))
    found = []
    for low, high in turns:
        index = np.arange(low, high + 1) % len(at_vertex)
        first, last = line.edges[index[[0, -1]], 1]
        if first != last:
            found.append(_Way(line, index if first == start else index[::-1]))
    return found


def _length(points: FloatArray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
