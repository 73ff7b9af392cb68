"""Every shared mesh opens and answers a click, whatever is wrong with it."""

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
from tests.shapes import MESHES, needs_meshes

FILES = sorted(p.name for p in MESHES.glob("*.*") if p.suffix in (".off", ".obj")) if MESHES.is_dir() else ["none"]
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
        # The exact method would take half of the time; its own tests have it.
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


def check_metric(distance, vertices, rng):
    fields = distance.from_sources(vertices)
    top = np.nanmax(fields)
    among = fields[vertices]
    i, j = rng.integers(len(vertices), size=(2, 20))
    assert np.abs(among[i, j] - among[j, i]).max() <= SLACK * top
    i, j, k = rng.integers(len(vertices), size=(3, 50))
    assert (among[i, j] <= among[i, k] + among[k, j] + SLACK * top).all()
