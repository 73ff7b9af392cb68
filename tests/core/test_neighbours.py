"""The nearest vertices by any distance."""

import numpy as np
import pytest

from bihdist_core import BiharmonicDistance, GeodesicDistance, ParameterError, Surface, VertexError, nearest
from bihdist_core.analysis.neighbours import least
from tests.core.every_distance import BUMPY, every_distance
from tests.shapes import grid, two_pieces


def slow_nearest(rows, source, k):
    """One after the other, from the whole row."""
    order = sorted((float(d), j) for j, d in enumerate(rows[source]) if j != source and np.isfinite(d))[:k]
    return [j for _, j in order], [d for d, _ in order]


@every_distance
def test_they_are_those_of_the_whole_matrix(make):
    distance = make(BUMPY)
    rows = distance.from_sources(np.arange(len(BUMPY.vertices))).T
    indices, values = nearest(distance, k=7)
    assert indices.shape == values.shape == (len(BUMPY.vertices), 7)
    for source in range(len(BUMPY.vertices)):
        found, away = slow_nearest(rows, source, 7)
        np.testing.assert_allclose(values[source], away, atol=1e-9 * np.nanmax(rows))
        assert indices[source].tolist() == found


@pytest.mark.parametrize("memory", [1.0, 24 * 200 * 7, 1e9])
def test_blocks_change_nothing(memory):
    distance, sources = BiharmonicDistance(BUMPY), [5, 199, 0, 5]
    indices, values = nearest(distance, sources, 12, memory=memory)
    whole = nearest(distance, k=12)
    np.testing.assert_array_equal(indices, whole[0][sources])
    np.testing.assert_allclose(values, whole[1][sources], rtol=1e-9)


def test_a_source_is_no_neighbour_of_itself_even_where_another_is_as_near():
    field = np.array([2.0, 1.0, 1.0, np.nan, 0.0, np.inf, 1.0, 2.0])
    assert least(field, 3).tolist() == [4, 1, 2]
    assert least(field, 5).tolist() == [4, 1, 2, 6, 0]
    assert least(field, 100).tolist() == [4, 1, 2, 6, 0, 7]
    # On a square grid the neighbours along the edges are at the same distance.
    indices, values = nearest(GeodesicDistance(grid(4, 4), "dijkstra"), [12], 4)
    assert indices.tolist() == [[7, 11, 13, 17]]
    assert values.tolist() == [[1, 1, 1, 1]]


def test_other_components_have_no_neighbours_here():
    pieces = two_pieces()
    surface = Surface(np.vstack([pieces.vertices, [9.0, 9.0, 9.0]]), pieces.faces)
    n = len(surface.vertices)
    indices, values = nearest(BiharmonicDistance(surface), k=n)
    component = surface.component_of_vertex
    for vertex in range(n):
        others = np.flatnonzero((component == component[vertex]) & (np.arange(n) != vertex) & (component >= 0))
        assert sorted(indices[vertex][indices[vertex] >= 0].tolist()) == others.tolist()
        assert np.isnan(values[vertex]).sum() == n - len(others)
    assert (indices[-1] == -1).all()


def test_a_mask_says_which_may_be_neighbours():
    mask = np.arange(len(BUMPY.vertices)) % 3 == 0
    distance = BiharmonicDistance(BUMPY)
    indices, _ = nearest(distance, [4], 5, mask=mask)
    row = np.where(mask, distance.from_source(4), np.nan)
    assert indices[0].tolist() == slow_nearest({4: row}, 4, 5)[0]


@pytest.mark.parametrize(
    ("asked", "error", "words"),
    [
        ({"k": 0}, ParameterError, "k is 0"),
        ({"k": 2.5}, ParameterError, "k is 2.5"),
        ({"sources": [200]}, VertexError, "200"),
        ({"memory": 0}, ParameterError, "must be positive"),
        ({"mask": [1, 0]}, ParameterError, "A mask has 0 or 1"),
    ],
)
def test_what_cannot_be_is_refused(asked, error, words):
    with pytest.raises(error, match=words):
        nearest(BiharmonicDistance(BUMPY), **asked)
