"""All distances from sources of all kinds, for tests of what holds for each of them."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    Curve,
    DiffusionDistance,
    GeodesicDistance,
    PowerDistance,
    SurfacePoint,
    TruncatedBiharmonicDistance,
)
from tests import dense_reference
from tests.shapes import bumpy

SMALL = 1e-9  # rounding of sums of squares, against the largest distance

QUADRATIC = {
    "biharmonic": BiharmonicDistance,
    "commute-time": CommuteTimeDistance,
    "diffusion": lambda s: DiffusionDistance(s, t=0.5),
    "truncated": lambda s: TruncatedBiharmonicDistance(s, k=30),
    "power": lambda s: PowerDistance(s, alpha=1.5),
}
GEODESIC = {method: lambda s, m=method: GeodesicDistance(s, m) for method in ("exact", "heat", "dijkstra")}
every_quadratic = pytest.mark.parametrize("make", QUADRATIC.values(), ids=QUADRATIC)
every_geodesic = pytest.mark.parametrize("make", GEODESIC.values(), ids=GEODESIC)
every_distance = pytest.mark.parametrize("make", {**QUADRATIC, **GEODESIC}.values(), ids={**QUADRATIC, **GEODESIC})

BUMPY = bumpy(200)
INSIDE, ON_EDGE, CORNER = SurfacePoint.of(17, 0.2, 0.5), SurfacePoint.of(17, 0.3, 0.7), SurfacePoint.of(17, 0, 1)
CURVE = Curve((SurfacePoint.of(3, 0.2, 0.3), SurfacePoint.of(40, 0.3, 0.3), SurfacePoint.of(77, 0.1, 0.2)))


def points(make, surface):
    """(n, k) points whose distances are the distance: all eigenvectors, weighted."""
    values, vectors = dense_reference.full_spectrum(surface)
    if make is QUADRATIC["diffusion"]:
        weights = np.exp(-0.5 * values / values[0])
    else:
        power, count = {
            QUADRATIC["biharmonic"]: (2, None),
            QUADRATIC["commute-time"]: (1, None),
            QUADRATIC["truncated"]: (2, 30),
            QUADRATIC["power"]: (1.5, None),
        }[make]
        weights = values**-power * (np.arange(len(values)) < (count or len(values)))
    return vectors * np.sqrt(weights)


SLACK = {QUADRATIC["diffusion"]: 2e-6, QUADRATIC["truncated"]: 1e-7, QUADRATIC["power"]: 1e-7}
"""Eigenpairs are found to a tolerance, diffusion leaves out the last, and rational functions have errors."""


def from_points(of_vertices, samples):
    return np.linalg.norm(of_vertices[:, None] - samples, axis=2).min(axis=1)
