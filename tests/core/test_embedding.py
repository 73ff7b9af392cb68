"""Points whose distances are the biharmonic ones within a bound."""

import numpy as np
import pytest
from scipy.spatial import KDTree

from bihdist_core import BiharmonicDistance, Laplacian, ParameterError, Surface
from bihdist_core.distances.embedding import biharmonic_embedding
from tests.shapes import bumpy, grid, two_pieces

SURFACE = bumpy(400)


@pytest.fixture(scope="module")
def distance():
    return BiharmonicDistance(SURFACE)


@pytest.fixture(scope="module")
def exact(distance):
    return distance.pairwise(np.arange(len(SURFACE.vertices)))


def all_pairs(count):
    return np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), axis=-1).reshape(-1, 2)


@pytest.mark.parametrize("k", [1, 10, 60])
def test_true_distances_lie_between_the_bounds(distance, exact, k):
    embedding = distance.embedding(k)
    assert embedding.points.shape == (len(SURFACE.vertices), k)
    least, most = embedding.between(all_pairs(len(exact)))
    rounding = 1e-9 * exact.max()
    assert (least <= exact.ravel() + rounding).all()
    assert (exact.ravel() <= most + rounding).all()
    lost = exact.ravel() - least
    assert lost.max() <= embedding.bound + rounding
    # It is no bound that anything would meet.
    assert lost.max() > 0.2 * embedding.bound


def test_bounds_hold_with_vectors_that_are_no_eigenvectors(exact):
    laplacian = Laplacian(SURFACE)
    component = laplacian.components[0]
    spectrum = component.spectrum(20)
    areas = np.sqrt(component.areas)[:, None]
    turned = np.random.default_rng(0).normal(0, 0.02, spectrum.eigenvectors.shape) + spectrum.eigenvectors
    turned = component.centred(turned)
    spectrum.eigenvectors[:] = np.linalg.qr(areas * turned)[0] / areas
    embedding = biharmonic_embedding(laplacian, 20)
    least, most = embedding.between(all_pairs(len(exact)))
    assert (least <= exact.ravel() + 1e-9).all()
    assert (exact.ravel() <= most + 1e-9).all()


def test_all_coordinates_are_the_distance(distance, exact):
    embedding = distance.embedding(k=10**6)
    assert embedding.points.shape[1] == len(exact) - 1
    assert embedding.bound < 1e-5 * exact.max()
    least, _ = embedding.between(all_pairs(len(exact)))
    np.testing.assert_allclose(least.reshape(exact.shape), exact, atol=1e-9 * exact.max())


def test_a_tolerance_has_no_more_coordinates_than_it_needs(distance, exact):
    tolerance = 0.1 * exact.max()
    embedding = distance.embedding(tolerance=tolerance)
    k = embedding.points.shape[1]
    assert embedding.bound <= tolerance
    assert distance.embedding(k).bound == pytest.approx(embedding.bound, rel=1e-9)
    assert distance.embedding(k - 1).bound > tolerance


def test_a_tree_of_the_points_finds_the_nearest_within_the_bound(distance, exact):
    embedding = distance.embedding(60)
    _, found = KDTree(embedding.points).query(embedding.points, 6)
    for vertex in range(0, len(exact), 37):
        others = np.sort(exact[vertex])[5]
        assert exact[vertex, found[vertex]].max() <= others + embedding.bound


def test_the_exact_nearest_are_found_by_the_bounds(distance, exact):
    """As a user would: candidates by the tree, asked exactly until no other can be nearer."""
    embedding, vertex, wanted = distance.embedding(60), 5, 4
    order = np.argsort(np.linalg.norm(embedding.points - embedding.points[vertex], axis=1))
    true = np.argsort(exact[vertex], kind="stable")[:wanted]
    least, _ = embedding.between(np.column_stack([np.full(len(order), vertex), order]))
    reach = exact[vertex, order[:wanted]].max()
    candidates = order[least <= reach]
    assert set(true) <= set(candidates.tolist())
    assert len(candidates) < len(exact) / 4


def test_components_have_points_of_their_own():
    surface = two_pieces()
    embedding = biharmonic_embedding(surface, 8)
    component = surface.component_of_vertex
    here, there = np.flatnonzero(component == 0)[:2], np.flatnonzero(component == 1)[:1]
    least, most = embedding.between([here, [here[0], there[0]]])
    assert 0 < least[0] <= BiharmonicDistance(surface).between(*here.tolist()) <= most[0]
    assert np.isnan(least[1])
    assert np.isnan(most[1])


def test_vertices_of_no_face_have_no_points():
    flat = grid(4, 4)
    surface = Surface(np.vstack([flat.vertices, [9.0, 9.0, 9.0]]), flat.faces)
    embedding = biharmonic_embedding(surface, 3)
    assert np.isnan(embedding.points[-1]).all()
    assert np.isfinite(embedding.points[:-1]).all()
    assert np.isnan(embedding.between([[0, len(flat.vertices)]])[0]).all()


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({}, "give one of the two"),
        ({"k": 3, "tolerance": 0.1}, "give one of the two"),
        ({"k": 0}, "whole number of at least 1"),
        ({"tolerance": 0.0}, "a length above 0"),
        ({"tolerance": "much"}, "is a number, not"),
    ],
)
def test_what_cannot_be_is_refused(distance, asked, words):
    with pytest.raises(ParameterError, match=words):
        distance.embedding(**asked)


@pytest.mark.parametrize("pairs", [[0, 1], [[0, 10**6]], [[-1, 0]], [[0.5, 1]]])
def test_pairs_that_are_none_are_refused(distance, pairs):
    with pytest.raises(ParameterError):
        distance.embedding(3).between(pairs)
