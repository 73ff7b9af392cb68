"""The section of a surface by a plane, between two places."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from ..errors import ParameterError
from ..surface import Surface
from .isoline_tracing import Isoline, isolines
from .places import Place, Places, split_at
from .surface_paths import Crossings, Stars, SurfacePath, assembled

IN_PLANE = 1e-12
"""Vertices nearer to a plane than this share of the surface's extent lie in it."""


def plane_section(surface: Surface, places: Sequence[Place], direction: npt.ArrayLike) -> SurfacePath:
    """The shortest part of the surface's section that joins two places; the plane holds both and a direction (3,).

    Raises ParameterError for another number of places, for a direction that is not three finite numbers or is that
    from one place to the other, and where the section does not join them; VertexError for a bad vertex.
    """
    d = np.asarray(direction, np.float64)
    if d.shape != (3,) or not np.isfinite(d).all():
        raise ParameterError(f"A direction is three finite numbers, not {direction!r}.")
    if len(places) != 2:
        raise ParameterError(f"A section joins two places; {len(places)} were given.")
    split = split_at(surface, Places.of(surface, places))
    start, stop = (int(v) for v in split.vertices)
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
    for field in (height, -height):
        parts = [part for line in isolines(split.surface, field, [0.0]) for part in _between(line, start, stop)]
        if parts:
            best = min(parts, key=lambda part: _length(x, *part))
            crossings = Crossings(*best, Stars(split.surface).common(best[0]))
            return assembled(split, [crossings], "section", "section by a plane")
    raise ParameterError(
        f"The section of {surface.name} by this plane does not join the two places; turn the direction."
    )


def _between(line: Isoline, start: int, stop: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Ends (k, 2) and parameters (k,) of the parts of a curve that join two vertices, without passing one of them."""
    at_vertex = line.parameters == 1
    ends = np.where(at_vertex[:, None], line.edges[:, 1:], line.edges)
    t = np.where(at_vertex, 0.0, line.parameters)
    met = np.flatnonzero(at_vertex & ((ends[:, 1] == start) | (ends[:, 1] == stop)))
    turns = list(pairwise(met))
    if line.closed and len(met) > 1:
        turns.append((met[-1], met[0] + len(t)))
    found = []
    for low, high in turns:
        index = np.arange(low, high + 1) % len(t)
        if ends[index[0], 0] != ends[index[-1], 0]:
            index = index if ends[index[0], 0] == start else index[::-1]
            found.append((ends[index], t[index]))
    return found


def _length(x: np.ndarray, ends: np.ndarray, t: np.ndarray) -> float:
    points = Crossings(ends, t, ends[:-1, 0]).points(x)
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
