"""Connected components and edges, against SciPy and sets of Python."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from bihdist_core import Surface
from bihdist_core.surface import connected
from tests.shapes import bumpy, fin, slivers, torus, two_pieces


def _path(n):
    return np.stack([np.arange(n - 1), np.arange(1, n)])


def _star(n):
    """The last vertex joined to all others, which come in pairs: faces around one point."""
    return np.stack([np.r_[np.arange(0, n - 1, 2), np.arange(1, n - 1, 2)], np.full(n - 1, n - 1)])


@pytest.mark.parametrize("seed", range(5))
def test_components_are_those_of_scipy(seed):
    rng = np.random.default_rng(seed)
    n = 3000
    # From nearly no edges to nearly one component.
    for count in (0, 5, n // 4, n // 2, n, 4 * n):
        edges = rng.integers(0, n, (2, count))
        graph = sp.coo_array((np.ones(count), edges), shape=(n, n))
        assert np.array_equal(connected(edges, n), connected_components(graph, directed=False)[1])


@pytest.mark.parametrize("kernel", ["compiled", "plain"])
def test_faces_connect_as_their_sides_do(kernel, monkeypatch):
    if kernel == "plain":
        monkeypatch.setattr("bihdist_core.surface.library", lambda: None)
    for count in (0, 100, 600, 3000):
        faces = np.random.default_rng(count).integers(0, 2000, (3, count))
        assert np.array_equal(connected(faces, 2000), connected(np.hstack([faces[:2], faces[1:]]), 2000))


@pytest.mark.parametrize("edges", [_path(100_001), _star(100_001)], ids=["path", "star"])
@pytest.mark.parametrize("order", ["ascending", "descending", "random"])
def test_long_ways_and_large_stars_take_a_few_rounds(edges, order):
    n = 100_001
    number = {"ascending": np.arange(n), "descending": np.arange(n)[::-1]}.get(order)
    if number is None:
        number = np.random.default_rng(0).permutation(n)
    # One vertex a round would take minutes.
    assert not connected(number[edges], n).any()


def test_components_are_ranked_by_size_then_by_their_first_vertex():
    triangles = np.array([[9, 8, 7], [2, 1, 11], [4, 5, 6], [6, 5, 3]])
    s = Surface(np.random.default_rng(0).standard_normal((13, 3)), triangles)
    assert s.component_of_vertex.tolist() == [-1, 1, 1, 0, 0, 0, 0, 2, 2, 2, -1, 1, -1]


@pytest.mark.parametrize("surface", [bumpy(300), torus(), fin(), two_pieces(), slivers()], ids=str)
def test_each_edge_is_there_once_with_its_faces(surface):
    faces = surface.faces.tolist()
    sides = [tuple(sorted((face[k], face[(k + 1) % 3]))) for k in range(3) for face in faces]
    assert [tuple(edge) for edge in surface.edges.tolist()] == sorted(set(sides))
    assert surface.faces_per_edge.tolist() == [sides.count(edge) for edge in sorted(set(sides))]
    edges, of_side = surface._sides
    assert [tuple(edge) for edge in edges[of_side].tolist()] == sides
