"""How much work an exact geodesic field is: windows, of which a core takes 5 to 9 million a second."""

import math

import numpy as np

from ..progress import Progress, part
from .exact_geodesic import ExactGeodesic

TRIED = 20_000
"""Vertices, about, that a trial reaches; surfaces of no more are not tried."""

POWERS = (1.0, 2.0)
"""Windows grow like the number of vertices where a surface is rough, like its power 1.5 where it is smooth, and like
its square along smooth tubes."""


def expected_windows(exact: ExactGeodesic, progress: Progress | None = None) -> float:
    """Windows that a field from one vertex of a connected surface will take.

    Found by two fields that end at a radius, in less than half a second: a half to twice what it is, mostly.  For small
    surfaces n^1.5, which is more than it is but on long tubes.  Raises SolverError where there are too many windows.
    """
    if exact.expected is None:
        exact.expected = _tried(exact, progress)
    return exact.expected


def _tried(exact: ExactGeodesic, progress: Progress | None) -> float:
    surface = exact.surface
    count = len(surface.vertices)
    if count <= TRIED:
        return math.pow(count, 1.5)
    radius = math.sqrt(TRIED / count * surface.face_areas.sum() / math.pi)
    fields = [
        exact.field(0, progress=part(progress, k / 2, (k + 1) / 2), radius=share * radius)
        for k, share in enumerate((0.5, 1))
    ]
    reached = [int(np.isfinite(field.distances).sum()) for field in fields]
    near, far = (float(field.windows) for field in fields)
    if reached[1] == reached[0]:  # far from all others
        return math.pow(count, 1.5)
    power = min(max(math.log(far / max(near, 1)) / math.log(reached[1] / reached[0]), POWERS[0]), POWERS[1])
    return far * math.pow(count / reached[1], power)
