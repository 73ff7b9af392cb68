"""The prediction function of section 5.2."""

import tracemalloc

import numpy as np
import pytest

import bihdist_core.applications.correspondence as correspondence
from bihdist_core import (
    BiharmonicDistance,
    Correspondence,
    GeodesicDistance,
    ParameterError,
    Surface,
    VertexError,
    correspondence_prediction as prediction,
)
from tests.shapes import bumpy, components_apart, two_pieces

PAIRS = np.array([[3, 3], [77, 77], [140, 140]])


def test_equals_the_formula_written_out():
    m, n = BiharmonicDistance(bumpy(150)), BiharmonicDistance(bumpy(120, seed=1))
    pairs, weights, x = [[3, 5], [77, 90], [140, 11]], [1.0, 0.25, 3.0], 20
    c = prediction(m, n, pairs, x, weights)
    from_x = np.array([m.between(x, i) for i, _ in pairs])
    for y in (0, 5, 60):
        from_y = np.array([n.between(y, j) for _, j in pairs])
        terms = weights * (from_x / from_x.max() - from_y / from_y.max()) ** 2
        assert c[y] == pytest.approx(terms.sum() ** 0.5, rel=1e-6)


def test_finds_the_same_point_on_a_moved_and_scaled_copy():
    s = bumpy(150)
    turn = np.linalg.qr(np.random.default_rng(1).standard_normal((3, 3)))[0]
    order = np.random.default_rng(2).permutation(150)
    copy = Surface(40 * s.vertices[order] @ turn, np.argsort(order)[s.faces])
    image = np.argsort(order)
    pairs = np.stack([PAIRS[:, 0], image[PAIRS[:, 0]]], 1)
    c = prediction(BiharmonicDistance(s), BiharmonicDistance(copy), pairs, np.arange(150))
    assert c.shape == (150, 150)
    assert (c.argmin(axis=0) == image).all()
    assert c[image, np.arange(150)].max() < 1e-7


def test_many_points_equal_single_ones():
    m, n = BiharmonicDistance(bumpy(150)), GeodesicDistance(bumpy(120), "dijkstra")
    pairs = [[3, 5], [77, 90]]
    many = prediction(m, n, pairs, [9, 3, 9])
    assert many.shape == (120, 3)
    for k, x in enumerate([9, 3, 9]):
        assert np.array_equal(many[:, k], prediction(m, n, pairs, x))


def test_a_vector_whose_maximum_is_0_is_0():
    m, n = BiharmonicDistance(bumpy(150)), BiharmonicDistance(bumpy(120))
    # With one known point every other vector is (1), and that of the known point itself (0).
    c = prediction(m, n, [[3, 5]], [3, 20])
    assert c[5].tolist() == [0, 1]
    assert (np.delete(c, 5, axis=0) == [1, 0]).all()


def test_weights_of_0_leave_pairs_out():
    d = BiharmonicDistance(bumpy(150))
    c = prediction(d, d, PAIRS, 20, [1, 0, 0])
    assert c[20] == 0
    assert (prediction(d, d, PAIRS, 20, [0, 0, 0]) == 0).all()


def test_other_components_have_no_prediction():
    s = two_pieces()
    large, small = components_apart(s)
    d = BiharmonicDistance(s)
    pairs = np.stack([large[:3], large[:3]], 1)
    c = prediction(d, d, pairs, [large[9], small[0]])
    assert np.isfinite(c[large, 0]).all()
    assert np.isnan(c[small, 0]).all()
    assert np.isnan(c[:, 1]).all()


@pytest.mark.parametrize(
    ("pairs", "x", "weights", "error", "words"),
    [
        ([3, 77], 1, None, ParameterError, r"shape \(k, 2\), k at least 1, not \(2,\)"),
        (np.empty((0, 2), int), 1, None, ParameterError, r"not \(0, 2\)"),
        (PAIRS, 1, [1, 2], ParameterError, "3 correspondences need as many finite weights"),
        (PAIRS, 1, [1, 2, -1], ParameterError, "at least 0"),
        (PAIRS, 150, None, VertexError, "no vertex 150"),
        ([[3, 150]], 1, None, VertexError, "no vertex 150"),
    ],
)
def test_refused(pairs, x, weights, error, words):
    d = BiharmonicDistance(bumpy(150))
    with pytest.raises(error, match=words):
        prediction(d, d, pairs, x, weights)


def test_the_map_is_the_least_misfit_of_each_vertex_whatever_the_block(monkeypatch):
    m, n = BiharmonicDistance(bumpy(150)), BiharmonicDistance(bumpy(220, seed=1))
    found = Correspondence(m, n, [[3, 5], [77, 90], [140, 11], [20, 200]], [1.0, 0.25, 3.0, 1.0])
    misfit = found.misfit(np.arange(150))
    for block in (7, 4096):
        monkeypatch.setattr(correspondence, "BLOCK", block)
        chosen = found.map()
        assert misfit[chosen, np.arange(150)] == pytest.approx(misfit.min(axis=0), rel=1e-12)
    assert found.map([9, 3]).tolist() == chosen[[9, 3]].tolist()
    assert found.best(9) == (chosen[9], misfit[:, 9].min())


def test_vertices_that_cannot_be_compared_are_mapped_nowhere():
    s = two_pieces()
    large, small = components_apart(s)
    distance = BiharmonicDistance(s)
    found = Correspondence(distance, distance, [[large[0], large[0]], [large[5], large[5]], [large[9], large[9]]])
    chosen = found.map()
    assert (chosen[small] == -1).all()
    assert np.isin(chosen[large], large).all()
    assert found.best(int(small[0]))[0] == -1


def test_another_pair_costs_one_column_on_each_surface():
    m, n = BiharmonicDistance(bumpy(150)), BiharmonicDistance(bumpy(120, seed=1))
    asked = []
    for distance in (m, n):
        solve = distance.from_sources
        distance.from_sources = lambda sources, progress=None, solve=solve: (
            asked.append(sources) or solve(sources, progress)
        )
    first = Correspondence(m, n, [[3, 5], [77, 90]])
    more = first.changed([[3, 5], [77, 90], [140, 11]])
    more.changed([[140, 11], [3, 5]], [2.0, 1.0])
    assert asked == [[3, 77], [5, 90], [140], [11]]
    assert more.misfit(20) == pytest.approx(prediction(m, n, [[3, 5], [77, 90], [140, 11]], 20))


def test_the_memory_of_a_full_map_is_that_of_the_vectors_and_a_block(monkeypatch):
    import scipy.spatial

    n, k = 3000, 6
    m = BiharmonicDistance(bumpy(n))
    found = Correspondence(m, m, [[v, v] for v in range(0, n, n // k)][:k])
    asked = []

    class Counting(scipy.spatial.cKDTree):
        def query(self, points, *arguments, **options):
            asked.append(len(points))
            return super().query(points, *arguments, **options)

    monkeypatch.setattr(scipy.spatial, "cKDTree", Counting)
    peaks = {}
    for block in (50, 1500):
        monkeypatch.setattr(correspondence, "BLOCK", block)
        asked.clear()
        tracemalloc.start()
        chosen = found.map()
        peaks[block] = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert asked == [block] * (n // block)
        assert len(chosen) == n
    # The vectors of the surface once more, without those that cannot be compared, and ids; then what each block needs.
    kept = 8 * n * (k + 6)
    for block, peak in peaks.items():
        assert peak < kept + 8 * block * (2 * k + 8)
    assert peaks[1500] < 8 * n * n / 20
