"""What exact geodesic distance is expected to take, and what follows from it."""

import numpy as np
import pytest

from bihdist_core import Cancelled, GeodesicDistance, Surface
from bihdist_core.distances import geodesic
from bihdist_core.distances.exact_geodesic import ExactGeodesic
from bihdist_core.distances.exact_work import TRIED, expected_windows
from bihdist_core.kernel.library import library
from tests.shapes import sphere

pytestmark = pytest.mark.skipif(library() is None, reason="exact geodesics need the compiled kernel")


@pytest.fixture(scope="module")
def smooth():
    return sphere(2 * TRIED)


@pytest.fixture(scope="module")
def rough(smooth):
    noise = np.random.default_rng(0).standard_normal(smooth.vertices.shape)
    return Surface(smooth.vertices + 0.1 * smooth.mean_edge_length * noise, smooth.faces, "rough")


def test_work_is_expected_from_a_part_of_the_surface(smooth, rough):
    """Within a factor of three of what it is, on the sphere of the worst place, where all ways meet again."""
    found = {}
    for surface in (smooth, rough):
        exact = ExactGeodesic(surface)
        found[surface.name] = expected_windows(exact)
        assert 1 / 3 < found[surface.name] / exact.field(0).windows < 3
    assert found[smooth.name] > 2 * found["rough"]


def test_auto_is_exact_where_the_surface_is_rough(smooth, rough, monkeypatch):
    limit = np.sqrt(expected_windows(ExactGeodesic(smooth)) * expected_windows(ExactGeodesic(rough)))
    monkeypatch.setattr(geodesic, "MOST_WINDOWS", limit)
    assert GeodesicDistance(rough).label == "geodesic, exact"
    assert not GeodesicDistance(rough).takes_long()
    heat = GeodesicDistance(smooth)
    assert (heat.label, heat.takes_long()) == ("geodesic, heat method", False)
    assert GeodesicDistance(smooth, "exact").takes_long()


def test_the_trial_can_be_cancelled(smooth):
    def cancel(_fraction, _text):
        raise Cancelled("enough")

    with pytest.raises(Cancelled):
        expected_windows(ExactGeodesic(smooth), cancel)


def test_small_surfaces_are_not_tried():
    assert expected_windows(ExactGeodesic(sphere(400))) == 400**1.5
