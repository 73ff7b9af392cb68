"""What the pointer has drawn on a surface, as a source: curves, parted where the pointer left the surface."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from bihdist_core import Surface
from bihdist_core.sources.plane_walk import PlaneWalk
from bihdist_core.sources.source import Curve, Member, Place, Source

from ..document.sourcing import place_at, source_from

FARTHEST = 3.0
"""A way on the surface between two points drawn one after another is at most so many times as long as the straight
line; otherwise the pointer has come from one part of the surface to another behind it."""


def drawn_source(strokes: Sequence[Sequence[Place]], surface: Surface, is_closed: bool = False) -> Source:
    """The source that strokes on a surface mean, each of one place or more: curves, and places where there is but one.

    Places that no way on the surface joins are parted.  is_closed: the only stroke comes back to where it began.
    """
    walk = PlaneWalk(surface)
    runs: list[list[Place]] = []
    for stroke in strokes:
        runs.append([stroke[0]])
        for start, stop in pairwise(stroke):
            if _are_joined(walk, start, stop, surface):
                runs[-1].append(stop)
            else:
                runs.append([stop])
    is_ring = is_closed and len(runs) == 1 and len(runs[0]) > 2
    is_ring = is_ring and _are_joined(walk, runs[0][-1], runs[0][0], surface)
    return source_from([_member(run, surface, is_ring) for run in runs])


def _member(run: Sequence[Place], surface: Surface, is_ring: bool) -> Member:
    if len(run) == 1:
        return place_at(surface.faces[run[0].face], run[0].face, run[0].weights)
    return Curve(tuple(run), is_ring)


def _are_joined(walk: PlaneWalk, start: Place, stop: Place, surface: Surface) -> bool:
    way = walk.between(start, stop)
    if way is None:
        return False
    ends = [(there - here) @ surface.vertices[surface.faces[face]] for face, here, there in way]
    p, q = (np.array(place.weights) @ surface.vertices[surface.faces[place.face]] for place in (start, stop))
    return float(np.linalg.norm(ends, axis=1).sum()) <= FARTHEST * max(float(np.linalg.norm(q - p)), 1e-300)
