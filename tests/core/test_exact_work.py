"""What exact geodesic distance is expected to take, and what follows from it."""

import numpy as np
import pytest

from bihdist_core import Cancelled, GeodesicDistance, Surface
from bihdist_core.distances import geodesic_solvers
from bihdist_core.distances.exact_geodesic import TRIAL_VERTICES, ExactGeodesic, expected_windows
from bihdist_core.distances.geodesic_fronts import FEW_TARGETS
from bihdist_core.kernel.library import library
from tests.shapes import sphere, two_pieces

pytestmark = pytest.mark.skipif(library() is None, reason="exact geodesics need the compiled kernel")


@pytest.fixture(scope="module")
def smooth():
    return sphere(2 * TRIAL_VERTICES)


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
    monkeypatch.setattr(geodesic_solvers, "QUICK_WINDOWS", limit)
    assert GeodesicDistance(rough).label == "geodesic, exact"
    assert not GeodesicDistance(rough).is_slow()
    other = GeodesicDistance(smooth)
    assert (other.label, other.is_slow()) == ("geodesic, approximate", False)
    assert GeodesicDistance(smooth, "exact").is_slow()


def test_the_trial_can_be_cancelled(smooth):
    def cancel(_fraction, _text):
        raise Cancelled("enough")

    with pytest.raises(Cancelled):
        expected_windows(ExactGeodesic(smooth), cancel)


def test_pairs_are_of_fields_whether_a_source_has_few_targets_or_many():
    surface = two_pieces()
    distance = GeodesicDistance(surface, "exact")
    used = np.flatnonzero(surface.component_of_vertex >= 0)
    pairs = np.array([(used[0], v) for v in used] + [(u, used[5]) for u in used[1:9]] + [(used[3], used[3])])
    sources, place = np.unique(pairs[:, 0], return_inverse=True)
    assert np.bincount(place).max() > FEW_TARGETS >= np.bincount(place).min()
    fields = distance.from_sources(sources)
    np.testing.assert_allclose(distance.of_pairs(pairs), fields[pairs[:, 1], place], rtol=1e-12, atol=1e-14)


def test_small_surfaces_are_not_tried():
    assert expected_windows(ExactGeodesic(sphere(400))) == 400**1.5
