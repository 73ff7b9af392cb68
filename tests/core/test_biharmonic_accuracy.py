"""Errors of biharmonic fields next to their sources, where distances lose digits, and what is said of them."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, CommuteTimeDistance, Laplacian, Surface
from bihdist_core.distances import biharmonic_accuracy
from tests.extended_reference import ExtendedReference, needs_digits
from tests.shapes import bumpy, caps, graded, grid, needles, plate, torus


def squashed() -> Surface:
    """A torus pressed flat, on which vertices are closer across than along any edge."""
    s = torus(14, 9)
    return Surface(s.vertices * (1, 1e-3, 0.1), s.faces, "squashed")


HARD = {
    "graded": lambda: graded(8, 0.3006774570588279),
    "more graded": lambda: graded(9, 0.35),
    "plate": lambda: plate(8, 8, 1e-3),
    "thinner plate": lambda: plate(8, 8, 1e-5),
    "long plate": lambda: plate(12, 7, 1e-4),
    "needles": lambda: needles(bumpy(60), 1e-5, every=4),
    "caps": lambda: caps(bumpy(60), 1e-6, every=4),
    "squashed": squashed,
}
every_hard = pytest.mark.parametrize("name", HARD)


def worst(fields: np.ndarray, exact: np.ndarray) -> float:
    """The largest error of fields (n, k), each as a fraction of its maximum."""
    return float((np.abs(fields - exact).max(axis=0) / exact.max(axis=0)).max())


def every_pair(distance: BiharmonicDistance) -> np.ndarray:
    """(n, n) distances of all pairs of vertices, free of cancellation."""
    i, j = np.indices(2 * [distance.surface.n_vertices])
    return distance.of_pairs(np.stack([i.ravel(), j.ravel()], 1), digits="all").reshape(i.shape)


@every_hard
def test_fields_differ_from_pairs_by_no_more_than_is_said(name):
    distance = BiharmonicDistance(HARD[name]())
    pairs = every_pair(distance)
    assert worst(distance.from_sources(np.arange(len(pairs))), pairs) <= distance.accuracy <= 1e-5


@needs_digits
@every_hard
def test_fields_are_as_accurate_as_they_say(name):
    surface = HARD[name]()
    laplacian, reference = Laplacian(surface), ExtendedReference(surface)
    for make, exact in ((BiharmonicDistance, reference.biharmonic()), (CommuteTimeDistance, reference.commute_time())):
        distance = make(laplacian)
        assert worst(distance.from_sources(np.arange(len(exact))), exact) <= distance.accuracy


@every_hard
def test_no_vertex_is_closer_than_the_least_distance(name):
    distance = BiharmonicDistance(HARD[name]())
    pairs, least = every_pair(distance), biharmonic_accuracy._least_distances(distance.laplacian.components[0])
    np.fill_diagonal(pairs, np.inf)
    assert (pairs.min(axis=0) >= least * (1 - 1e-6)).all()


def test_the_least_distance_is_not_far_from_that_of_neighbours_on_an_even_mesh():
    distance = BiharmonicDistance(grid(9, 9))
    fields, least = distance.from_sources(np.arange(100)), biharmonic_accuracy._least_distances
    np.fill_diagonal(fields, np.inf)
    assert (fields.min(axis=0) < 4 * least(distance.laplacian.components[0])).all()


def test_what_is_said_of_an_even_mesh_stays_near_its_errors():
    """Within a thousand times: the smallest distance is met by the largest rounding, and both have some to spare."""
    distance = BiharmonicDistance(bumpy(300))
    error = worst(distance.from_sources(np.arange(300)), every_pair(distance))
    assert 1e-15 < error <= distance.accuracy < 1000 * error


def test_a_solver_that_loses_digits_is_noticed(monkeypatch):
    """Columns that differ from two solves by more than usual raise the estimate."""
    distance = BiharmonicDistance(bumpy(200))
    usual, component = distance.accuracy, distance.laplacian.components[0]
    factor, rng = component.factor(diagonals=True), np.random.default_rng(0)
    right = factor.sandwich_columns
    monkeypatch.setattr(factor, "sandwich_columns", lambda ids: right(ids) * (1 + 1e-9 * rng.random((200, len(ids)))))
    assert biharmonic_accuracy.accuracy_of_fields(component) > 1e-9 > 10 * usual


def test_more_vertices_close_by_than_are_computed_again():
    """What cancellation leaves of the others is said."""
    distance = BiharmonicDistance(graded(14, 0.35))
    fields, pairs = distance.from_sources(np.arange(15**2)), every_pair(distance)
    limit = biharmonic_accuracy.recomputed_below(distance.laplacian.components[0])
    assert ((pairs < limit).sum(axis=0) > biharmonic_accuracy.MOST_NEAR + 1).any()
    assert worst(fields, pairs) <= distance.accuracy
    assert biharmonic_accuracy.TARGET < distance.accuracy < 1e-6
