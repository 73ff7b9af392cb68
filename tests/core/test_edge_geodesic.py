"""Dijkstra along edges: path lengths, bounds and reference values."""

import numpy as np
import pytest

from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.errors import VertexError
from bihdist_core.surface import Surface
from tests.shapes import ORACLE, ORACLE_NAMES, needs_oracle, oracle_surface

ROUNDING = 1e-12
"""Relative: sums of at most some hundred lengths."""


def strip(k):
    """Two rows of k + 1 vertices, side 1, diagonals from lower left to upper right."""
    x = np.repeat(np.arange(k + 1.0), 2)
    a = 2 * np.arange(k)
    faces = np.concatenate([np.stack([a, a + 2, a + 3], 1), np.stack([a, a + 3, a + 1], 1)])
    return Surface(np.stack([x, np.tile([0.0, 1.0], k + 1), 0 * x], 1), faces)


def test_path_lengths_on_a_strip():
    d = EdgeGeodesic(strip(20)).distances(0)
    np.testing.assert_allclose(d[::2], np.arange(21), rtol=ROUNDING)
    np.testing.assert_allclose(d[3::2], np.arange(20) + np.sqrt(2), rtol=ROUNDING)
    assert d[1] == 1


def test_block_equals_single_and_is_symmetric():
    solver = EdgeGeodesic(strip(9))
    block = solver.distances([3, 0, 11])
    assert block.shape == (20, 3)
    for column, source in enumerate([3, 0, 11]):
        assert np.array_equal(block[:, column], solver.distances(source))
    everything = solver.distances(np.arange(20))
    np.testing.assert_allclose(everything, everything.T, rtol=ROUNDING)
    assert not np.diag(everything).any()


def test_scales_like_length_and_is_no_shorter_than_a_straight_line():
    surface = strip(7)
    d = EdgeGeodesic(surface).distances(4)
    scaled = EdgeGeodesic(Surface(surface.vertices * 3, surface.faces)).distances(4)
    np.testing.assert_allclose(scaled, 3 * d, rtol=ROUNDING)
    assert (d >= np.linalg.norm(surface.vertices - surface.vertices[4], axis=1) * (1 - ROUNDING)).all()


def test_nonmanifold_edge_and_coincident_vertices():
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 1, 0]]
    surface = Surface(vertices, [[0, 1, 2], [0, 1, 3], [0, 1, 4], [0, 2, 5]])
    np.testing.assert_allclose(EdgeGeodesic(surface).distances(2), [1, np.sqrt(2), 0, 2, 2, 0], rtol=ROUNDING)


def test_refuses_ids_that_do_not_exist():
    with pytest.raises(VertexError):
        EdgeGeodesic(strip(2)).distances(6)
    with pytest.raises(VertexError):
        EdgeGeodesic(strip(2)).distances([0, -1])


@needs_oracle
@pytest.mark.parametrize("name", ORACLE_NAMES)
def test_reference_values(name):
    expected = np.load(ORACLE / f"{name}_dijkstra_scipy.npy")
    sources = np.loadtxt(ORACLE / f"{name}_sources0.txt", dtype=int)
    got = EdgeGeodesic(oracle_surface(name)).distances(sources)
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12 * expected.max())


def test_from_vertices_with_offsets():
    edges = EdgeGeodesic(strip(20))
    expected = np.minimum(edges.distances(3) + 1, edges.distances(30) + 2)
    found = edges.distances_with(np.array([3, 30, 3, 30]), np.array([5.0, 2, 1, 7]))
    np.testing.assert_allclose(found, expected, rtol=ROUNDING)
