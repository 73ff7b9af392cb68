"""Farthest-point sampling with any distance."""

import numpy as np

from ..distances.distance import Distance
from ..errors import ParameterError


def farthest_points(distance: Distance, start: int = 0, count: int = 10) -> np.ndarray:
    """(count,) vertex ids: `start`, then each time the vertex farthest from those so far (the smallest id on ties).

    Stays on the component of `start`.  Raises ParameterError if that has fewer different points than `count`.
    """
    if count < 1:
        raise ParameterError(f"count is {count}; at least one point is needed.")
    points = [distance.surface.check_vertex(start)]
    nearest = distance.from_source(start)
    while len(points) < count:
        farthest = int(np.nanargmax(nearest))
        if not nearest[farthest] > 0:
            raise ParameterError(f"{count} points asked for; the component of vertex {start} has {len(points)}.")
        points.append(farthest)
        nearest = np.fmin(nearest, distance.from_source(farthest))
    return np.array(points)
