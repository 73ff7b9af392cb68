"""Strokes of the pointer on a surface as a source: curves, cut where the pointer left the surface."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from bihdist_core import Surface
from bihdist_core.sources.plane_walk import PlaneWalk
from bihdist_core.sources.source import Curve, Member, Source, SurfacePoint

from ...document.source_edits import place_at, source_from

MAX_DETOUR = 3.0
"""A way on the surface between two places drawn one after another is at most so many times as long as the straight
line; otherwise the pointer has come from one part of the surface to another behind it."""
MAX_LEAP, MAX_LEAP_DETOUR = 6.0, 1.2
"""Steps so many times as long as most are cut as well: the surface is seen from the side there, or another part of
it behind."""


def source_from_strokes(strokes: Sequence[Sequence[SurfacePoint]], surface: Surface, is_closed: bool = False) -> Source:
    """Return the source of strokes on a surface: curves, and points for strokes of one place, or on points.

    Places that no path on the surface joins are cut apart. With `is_closed` the only stroke returns to where it
    began.
    """
    if not len(surface.faces):
        places = [place for stroke in strokes for place in stroke]
        return source_from(list(dict.fromkeys(_member([place], surface.shape, False) for place in places)))
    joins = _Joins(strokes, surface)
    runs: list[list[SurfacePoint]] = []
    for stroke in strokes:
        runs.append([stroke[0]])
        for start, stop in pairwise(stroke):
            if joins.has(start, stop):
                runs[-1].append(stop)
            else:
                runs.append([stop])
    is_ring = is_closed and len(runs) == 1 and len(runs[0]) > 2 and joins.has(runs[0][-1], runs[0][0])
    return source_from([_member(run, surface, is_ring) for run in runs])


def _member(run: Sequence[SurfacePoint], surface: Surface, is_ring: bool) -> Member:
    if len(run) == 1:
        return place_at(surface.faces[run[0].face], run[0].face, run[0].weights)
    return Curve(tuple(run), is_ring)


class _Joins:
    """Which places of strokes a way on the surface joins."""

    def __init__(self, strokes: Sequence[Sequence[SurfacePoint]], surface: Surface) -> None:
        self._surface, self._walk = surface, PlaneWalk(surface)
        steps = [self._straight(*pair) for stroke in strokes for pair in pairwise(stroke)]
        self._usual = float(np.median(steps)) if steps else 0.0

    def has(self, start: SurfacePoint, stop: SurfacePoint) -> bool:
        way = self._walk.between(start, stop)
        if way is None:
            return False
        corners = self._surface.vertices[self._surface.faces[[face for face, _, _ in way]]]
        steps = np.einsum("kc,kcx->kx", np.array([there - here for _, here, there in way]), corners)
        straight = self._straight(start, stop)
        most = MAX_LEAP_DETOUR if straight > MAX_LEAP * self._usual else MAX_DETOUR
        return float(np.linalg.norm(steps, axis=1).sum()) <= most * max(straight, 1e-300)

    def _straight(self, start: SurfacePoint, stop: SurfacePoint) -> float:
        p, q = (np.array(x.weights) @ self._surface.vertices[self._surface.faces[x.face]] for x in (start, stop))
        return float(np.linalg.norm(q - p))
