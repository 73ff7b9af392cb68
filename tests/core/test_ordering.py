"""Nested dissection: what makes an order a dissection, on graphs of all kinds."""

import numpy as np
import pytest
import scipy.sparse as sp

from bihdist_core.errors import Cancelled
from bihdist_core.solver.ordering import _along_a_curve, _unit_box, nested_dissection


def grid(rows, columns):
    """Edges and positions of a rows x columns grid."""
    ids = np.arange(rows * columns).reshape(rows, columns)
    i = np.r_[ids[:, :-1].ravel(), ids[:-1].ravel()]
    j = np.r_[ids[:, 1:].ravel(), ids[1:].ravel()]
    y, x = np.divmod(np.arange(rows * columns), columns)
    return i, j, np.stack([x, y, 0 * x], 1).astype(float)


def path(n):
    return np.arange(n - 1), np.arange(1, n), np.c_[np.arange(n), np.zeros((n, 2))]


def star(n):
    return np.zeros(n - 1, int), np.arange(1, n), np.random.default_rng(0).normal(size=(n, 3))


def nothing(n):
    return np.zeros(0, int), np.zeros(0, int), np.random.default_rng(0).normal(size=(n, 3))


def random_graph(n, edges=3):
    rng = np.random.default_rng(1)
    low = sp.tril(sp.coo_matrix((np.ones(edges * n), rng.integers(n, size=(2, edges * n))), shape=(n, n)).tocsr(), -1)
    low = low.tocoo()
    return low.row, low.col, rng.normal(size=(n, 3))


def same_place(n):
    i, j, x = grid(n // 10, 10)
    return i, j, 0 * x


GRAPHS = {
    "grid": grid(40, 50),
    "long grid": grid(3, 700),
    "path": path(1000),
    "star": star(1000),
    "isolated": nothing(300),
    "random": random_graph(500),
    "one place": same_place(1000),
    "one vertex": nothing(1),
    "no vertex": nothing(0),
}


@pytest.mark.parametrize("name", GRAPHS)
@pytest.mark.parametrize("split", [0, 1])
def test_an_edge_joins_a_node_with_itself_or_an_ancestor(name, split):
    i, j, x = GRAPHS[name]
    depth = 5
    node = nested_dissection(i, j, x, depth, split)
    assert node.shape == (len(x),)
    assert ((node >= 1) & (node < 2 << depth)).all()
    deep, shallow = np.maximum(node[i], node[j]), np.minimum(node[i], node[j])
    levels_between = np.floor(np.log2(deep)).astype(int) - np.floor(np.log2(shallow)).astype(int)
    assert np.array_equal(deep >> levels_between, shallow)


@pytest.mark.parametrize("name", GRAPHS)
def test_equal_input_gives_equal_order(name):
    i, j, x = GRAPHS[name]
    assert np.array_equal(nested_dissection(i, j, x, 5, 1), nested_dissection(i.copy(), j.copy(), x.copy(), 5, 1))


def test_no_split_is_the_same_order_as_a_split():
    i, j, x = grid(40, 50)
    # Axes are found on a sample per region, so that only the sides may swap names; sizes must agree.
    one, two = (np.bincount(nested_dissection(i, j, x, 4, split), minlength=32) for split in (0, 1))
    assert one[1] == two[1]


@pytest.mark.parametrize(
    ("name", "largest"), [("grid", 45), ("long grid", 4), ("path", 1), ("star", 1), ("isolated", 0)]
)
def test_the_first_separator_is_small(name, largest):
    # A straight cut of the 40 x 50 grid has 40 vertices; a cut along hop counts may be slightly slanted.
    i, j, x = GRAPHS[name]
    assert (nested_dissection(i, j, x, 5) == 1).sum() <= largest


def test_halves_have_at_least_two_fifths():
    i, j, x = grid(40, 50)
    node = nested_dissection(i, j, x, 1)
    # The separator is taken from the halves after the cut.
    assert np.bincount(node, minlength=4)[2:].min() >= 0.4 * len(x) - (node == 1).sum()


def test_a_rolled_up_sheet_is_cut_along_its_surface():
    # A tight roll: straight cuts through space would cross every layer.
    i, j, x = grid(10, 1000)
    angle = x[:, 0] / 10
    rolled = np.c_[(5 + angle / 50) * np.cos(angle), (5 + angle / 50) * np.sin(angle), x[:, 1]]
    assert (nested_dissection(i, j, rolled, 3) == 1).sum() <= 20


def test_how_vertices_are_numbered_does_not_matter():
    i, j, x = grid(40, 50)
    new = np.random.default_rng(0).permutation(len(x))
    order, box = _along_a_curve(_unit_box(x[np.argsort(new)]))
    place = np.empty(len(x), int)
    place[order] = np.arange(len(x))
    assert np.allclose(np.stack(box, 1), np.stack(_unit_box(x[np.argsort(new)]), 1)[order])
    # Numbers of neighbours are 600 to 700 apart in a random numbering.
    assert np.median(abs(place[new[i]] - place[new[j]])) < 20
    assert (nested_dissection(new[i], new[j], x[np.argsort(new)], 5) == 1).sum() <= 45


@pytest.mark.parametrize("scale", [1e150, 1e-150, 1e300])
def test_extreme_coordinates(scale):
    i, j, x = grid(20, 30)
    assert np.array_equal(nested_dissection(i, j, x * scale, 4), nested_dissection(i, j, x * scale, 4))
    assert (nested_dissection(i, j, x * scale, 4) == 1).sum() <= 25


def test_inputs_stay_as_they_are():
    i, j, x = grid(20, 30)
    copies = i.copy(), j.copy(), x.copy()
    nested_dissection(i, j, x, 4, 1)
    for before, after in zip(copies, (i, j, x), strict=True):
        assert np.array_equal(before, after)


def test_progress_can_stop_it():
    def stop(*_):
        raise Cancelled("enough")

    with pytest.raises(Cancelled, match="enough"):
        nested_dissection(*grid(40, 50), 5, 1, stop)
