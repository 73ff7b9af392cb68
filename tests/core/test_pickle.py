"""Distances where they are sent to: in other processes, in copies."""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, CommuteTimeDistance, Laplacian, Surface, eigenpairs
from tests.core.every_distance import GEODESIC, QUADRATIC
from tests.shapes import bumpy


def field_of(distance, source):
    return distance.from_source(source)


@pytest.mark.parametrize("with_factors", [False, True])
@pytest.mark.parametrize("make", {**QUADRATIC, **GEODESIC}.values(), ids={**QUADRATIC, **GEODESIC})
def test_a_pickled_distance_is_the_same(make, with_factors):
    distance = make(Laplacian(bumpy(60)))
    distance.laplacian.pickles_factors = with_factors
    before, estimate = distance.from_source(3), distance.error_estimate()
    for again in (pickle.loads(pickle.dumps(distance)), copy.copy(distance), copy.deepcopy(distance)):
        assert again.label == distance.label
        assert np.allclose(again.from_source(3), before, rtol=1e-9)
        assert again.error_estimate().text == estimate.text


def test_factors_travel_on_request_only():
    laplacian = Laplacian(bumpy(300))
    distance = BiharmonicDistance(laplacian)
    alone = pickle.dumps(distance)
    laplacian.pickles_factors = True
    assert len(alone) < 2 * len(pickle.dumps(laplacian.surface)) < len(pickle.dumps(distance))
    there = pickle.loads(pickle.dumps(distance)).laplacian.components[0]
    assert there._factor is not None
    assert pickle.loads(alone).laplacian.components[0]._factor is None


def test_what_is_shared_stays_shared():
    laplacian = Laplacian(bumpy(60))
    one, other = pickle.loads(pickle.dumps((BiharmonicDistance(laplacian), CommuteTimeDistance(laplacian))))
    assert one.laplacian is other.laplacian
    component = pickle.loads(pickle.dumps(laplacian.components[0]))
    assert np.array_equal(component.areas, laplacian.components[0].areas)


def test_surfaces_spectra_and_embeddings():
    surface = bumpy(60)
    assert surface.faces_per_edge.max() == 2  # what has been computed of it stays behind
    again = pickle.loads(pickle.dumps(surface))
    assert isinstance(again, Surface)
    assert not again.vertices.flags.writeable
    assert len(pickle.dumps(again)) == len(pickle.dumps(bumpy(60)))
    spectrum = eigenpairs(surface, 5)
    assert np.array_equal(pickle.loads(pickle.dumps(spectrum)).eigenvectors, spectrum.eigenvectors)
    embedding = BiharmonicDistance(surface).embedding(5)
    assert np.array_equal(pickle.loads(pickle.dumps(embedding)).points, embedding.points)


def test_in_processes_started_anew():
    distance = BiharmonicDistance(bumpy(60))
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        [found] = pool.map(field_of, [distance], [3])
    assert np.array_equal(found, distance.from_source(3))


def test_with_joblib():
    joblib = pytest.importorskip("joblib")
    distance = BiharmonicDistance(bumpy(60))
    found = joblib.Parallel(2)(joblib.delayed(field_of)(distance, source) for source in (3, 5))
    assert np.allclose(np.column_stack(found), distance.from_sources([3, 5]), rtol=1e-12)


def test_with_dask():
    distributed = pytest.importorskip("distributed")
    distance = BiharmonicDistance(bumpy(60))
    with distributed.Client(processes=False, dashboard_address=None, n_workers=1, threads_per_worker=1) as client:
        found = client.submit(field_of, distance, 3).result()
    assert np.array_equal(found, distance.from_source(3))
