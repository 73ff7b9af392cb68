"""Every shared mesh opens and answers a click, whatever is wrong with it; exact geodesics obey their laws on it."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    GeodesicDistance,
    Laplacian,
    read_surface,
)
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from tests.shapes import MESHES, divided, needs_meshes

FILES = sorted(p.name for p in MESHES.glob("*.*") if p.suffix in (".off", ".obj")) if MESHES.is_dir() else ["none"]
MOST_BYTES = 700_000
"""Of files: of meshes up to some 10,000 vertices."""
SLACK = 1e-9


@needs_meshes
@pytest.mark.parametrize("name", FILES)
def test_one_click(name):
    surface = read_surface(MESHES / name)
    rng = np.random.default_rng(0)
    ours = np.flatnonzero(surface.component_of_vertex == 0)
    source, *others = (int(v) for v in rng.choice(ours, 41))
    laplacian = Laplacian(surface)
    for distance in (
        BiharmonicDistance(laplacian),
        CommuteTimeDistance(laplacian),
        DiffusionDistance(laplacian),
        # The exact method would take half of the time; it has a test of its own.
        GeodesicDistance(laplacian, "heat"),
    ):
        field = distance.from_source(source)
        assert field[source] == 0
        assert np.isfinite(field[ours]).all()
        assert (field[ours] >= 0).all()
        assert np.isnan(field[surface.component_of_vertex != 0]).all()
        if isinstance(distance, (BiharmonicDistance, CommuteTimeDistance)):
            assert (np.delete(field, source)[ours[ours != source] - (ours[ours != source] > source)] > 0).all()
            check_metric(distance, np.array(others), rng)


SMALL = [name for name in FILES if not MESHES.is_dir() or (MESHES / name).stat().st_size < MOST_BYTES]


@needs_meshes
@pytest.mark.parametrize("name", SMALL)
def test_exact_geodesics_are_no_longer_than_edges_and_those_of_smaller_faces(name):
    surface = read_surface(MESHES / name)
    x, ours = surface.vertices, np.flatnonzero(surface.component_of_vertex == 0)
    source = int(ours[len(ours) // 3])
    d = ExactGeodesic(surface).distances(source)
    assert np.array_equal(np.isfinite(d), surface.component_of_vertex == 0)
    slack = 1e-12 * np.nanmax(d)  # some hundred roundings along a path
    assert (np.linalg.norm(x - x[source], axis=1) <= d + slack)[ours].all()
    assert (d <= EdgeGeodesic(surface).distances(source) + slack)[ours].all()
    i, j = surface.edges.T
    assert np.nanmax(np.abs(d[i] - d[j]) - np.linalg.norm(x[i] - x[j], axis=1)) <= slack
    fine, weights = divided(x, surface.faces, 2)
    small, at, which = np.nonzero(weights == 2)
    of_old = np.zeros(len(x), int)
    of_old[surface.faces[small // 4, which]] = fine.faces[small, at]
    assert np.abs(ExactGeodesic(fine).distances(of_old[source])[of_old] - d)[ours].max() <= slack


def check_metric(distance, vertices, rng):
    fields = distance.from_sources(vertices)
    top = np.nanmax(fields)
    among = fields[vertices]
    i, j = rng.integers(len(vertices), size=(2, 20))
    assert np.abs(among[i, j] - among[j, i]).max() <= SLACK * top
    i, j, k = rng.integers(len(vertices), size=(3, 50))
    assert (among[i, j] <= among[i, k] + among[k, j] + SLACK * top).all()
