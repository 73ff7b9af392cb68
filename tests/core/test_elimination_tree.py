"""The elimination trees of both kernels: what makes an order a nested dissection, on graphs of all kinds."""

import numpy as np
import pytest
import scipy.sparse as sp

from bihdist_core.errors import Cancelled
from bihdist_core.kernel.library import library
from bihdist_core.solver import compiled_tree, elimination_tree
from bihdist_core.solver.compiled_tree import CompiledTree
from bihdist_core.solver.elimination_tree import EliminationTree
from bihdist_core.solver.worker_threads import without_workers
from tests.core.graphs import SHAPES, grid, laplacian, moved, path, star

compiled = pytest.mark.skipif(library() is None, reason="there is no compiled kernel")
FILL = 5.5
"""Entries of the factor over n log2 n, at most, on planar graphs; George's dissection of a square grid has 31 / 8."""


@pytest.fixture(params=[pytest.param("compiled", marks=compiled), "plain"], autouse=True)
def kernel(request, monkeypatch):
    if request.param == "plain":
        monkeypatch.setattr(elimination_tree, "library", lambda: None)


class Front:
    """A front of either tree: places of its pivots (c,) and its boundary (m,), and where its children's are in it."""

    def __init__(self, pivots, boundary, children):
        self.pivots, self.boundary, self.children = pivots, boundary, children
        self.rows = np.r_[pivots, boundary]


def fronts_of(tree):
    """All fronts, in postorder."""
    t = tree.layout
    if not isinstance(t, CompiledTree):
        return [Front(front.pivots, front.boundary, front.children) for front in t.fronts]
    part = [slice(*t.bound[q : q + 2]) for q in range(len(t.parent))]
    return [
        Front(
            np.arange(*t.first[q : q + 2]),
            t.rows[part[q]],
            [(child, t.up[part[child]]) for child in t.children[q].tolist() if child >= 0],
        )
        for q in range(len(t.parent))
    ]


def fill(tree):
    """How many entries the factor has."""
    c, m = tree.sizes
    return int((c * (c + m)).sum())


def root_separator(tree):
    """The vertices of the last front."""
    return tree.layout.vertices[fronts_of(tree)[-1].pivots]


def halves(tree):
    """How many vertices are below each child of the root."""
    fronts = fronts_of(tree)

    def below(q):
        return len(fronts[q].pivots) + sum(below(child) for child, _ in fronts[q].children)

    return [below(child) for child, _ in fronts[-1].children]


def renumbered(shape, seed=0):
    matrix, x = shape
    order = np.random.default_rng(seed).permutation(len(x))
    return matrix[order][:, order], x[order]


def rolled_up(columns):
    """A tight roll: straight cuts through space would cross every layer."""
    matrix, x = grid(10, columns)
    angle = x[:, 0] / 10
    return matrix, np.c_[(5 + angle / 50) * np.cos(angle), (5 + angle / 50) * np.sin(angle), x[:, 1]]


# ---------------------------------------------------------------------- laws
@pytest.fixture(params=SHAPES)
def shape(request):
    return SHAPES[request.param]


def test_each_vertex_is_a_pivot_once(shape):
    matrix, x = shape
    tree = EliminationTree(matrix, x)
    n = len(x)
    assert tree.n == n
    assert np.array_equal(np.sort(tree.layout.vertices), np.arange(n))
    assert np.array_equal(tree.layout.vertices[tree.layout.place], np.arange(n))
    fronts = fronts_of(tree)
    assert np.array_equal(np.concatenate([front.pivots for front in fronts]), np.arange(n))
    c, m = tree.sizes
    assert c.tolist() == [len(front.pivots) for front in fronts]
    assert m.tolist() == [len(front.boundary) for front in fronts]
    assert tree.nbytes >= n


def test_fronts_are_a_tree_in_postorder(shape):
    fronts = fronts_of(EliminationTree(*shape))
    children = [child for front in fronts for child, _ in front.children]
    assert sorted(children) == list(range(len(fronts) - 1))
    assert all(child < q for q, front in enumerate(fronts) for child, _ in front.children)
    assert not len(fronts[-1].boundary)


def test_every_entry_of_the_pattern_lies_in_the_front_of_its_earlier_vertex(shape):
    matrix, x = shape
    tree = EliminationTree(matrix, x)
    entries = matrix.tocoo()
    i, j = tree.layout.place[entries.row], tree.layout.place[entries.col]
    for front in fronts_of(tree):
        assert np.isin(j[np.isin(i, front.pivots) & (j > i)], front.rows).all()


def test_a_boundary_is_what_edges_and_children_reach_and_lies_in_the_parent(shape):
    matrix, x = shape
    tree = EliminationTree(matrix, x)
    vertices = tree.layout.vertices
    ordered = matrix[vertices][:, vertices]
    fronts = fronts_of(tree)
    for front in fronts:
        reached = [ordered[front.pivots].indices, *(fronts[child].boundary for child, _ in front.children)]
        above = np.setdiff1d(np.concatenate(reached), front.pivots)
        above = above[above >= front.pivots[-1]] if len(front.pivots) else above
        assert np.array_equal(front.boundary, above)
        for child, up in front.children:
            assert np.array_equal(front.rows[up], fronts[child].boundary)


def test_equal_input_gives_equal_order(shape):
    matrix, x = shape
    one, two = EliminationTree(matrix, x), EliminationTree(matrix.copy(), x.copy())
    assert np.array_equal(one.layout.vertices, two.layout.vertices)
    assert all(np.array_equal(*sizes) for sizes in zip(one.sizes, two.sizes, strict=True))


@pytest.mark.parametrize("cut_alone", [0, 10**9])
def test_the_order_is_that_of_one_thread(cut_alone, monkeypatch):
    matrix, x = grid(60, 80)
    monkeypatch.setattr(compiled_tree, "CUT_ALONE", cut_alone)
    several = EliminationTree(matrix, x, progress=lambda *_: None)
    monkeypatch.setattr("bihdist_core.solver.worker_threads._pool", None)  # nobody may ask for it
    with without_workers():
        assert np.array_equal(EliminationTree(matrix, x).layout.vertices, several.layout.vertices)


def test_inputs_stay_as_they_are():
    matrix, x = grid(20, 30)
    copies = matrix.copy(), x.copy()
    EliminationTree(matrix, x)
    assert np.array_equal(copies[1], x)
    for name in ("data", "indices", "indptr"):
        assert np.array_equal(getattr(matrix, name), getattr(copies[0], name))


def test_values_and_the_diagonal_do_not_matter():
    matrix, x = grid(20, 30)
    expected = EliminationTree(matrix, x).layout.vertices
    for other in (matrix * 0, matrix - sp.diags(matrix.diagonal()), abs(matrix)):
        assert np.array_equal(EliminationTree(other, x).layout.vertices, expected)


def test_progress_can_stop_it():
    def stop(*_):
        raise Cancelled("enough")

    with pytest.raises(Cancelled, match="enough"):
        EliminationTree(*grid(40, 50), stop)


# ---------------------------------------------------------------------- how good it is
@pytest.mark.parametrize(
    ("graph", "largest"),
    [(grid(40, 50), 45), (grid(3, 700), 4), (path(1000), 1), (star(1000), 1), (SHAPES["isolated"], 0)],
    ids=["grid", "long grid", "path", "star", "isolated"],
)
def test_the_first_separator_is_small(graph, largest):
    # A straight cut of the 40 x 50 grid has 40 vertices; a cut along hop counts may be slightly slanted.
    assert len(root_separator(EliminationTree(*graph))) <= largest


@pytest.mark.parametrize("size", [(40, 50), (60, 80)])
def test_halves_are_balanced(size):
    # In regions of more than 3,000 vertices a separator may move, to where a quarter is left.
    n = size[0] * size[1]
    assert min(halves(EliminationTree(*grid(*size)))) >= (0.35 if n < 3000 else 0.25) * n


PLANAR = {
    "grid": grid(40, 50),
    "large grid": grid(80, 90),
    "strip": grid(3, 700),
    "path": path(1000),
    "star": star(1000),
    "rolled up": rolled_up(400),
    "one place": moved(grid(20, 30), lambda x: 0 * x),
    "two places": moved(grid(20, 30), lambda x: np.round(x / 30)),
    "huge": moved(grid(20, 30), lambda x: x * 1e300),
    "tiny": moved(grid(20, 30), lambda x: x * 1e-300),
    "random numbers": renumbered(grid(40, 50)),
}


@pytest.mark.parametrize("name", PLANAR)
def test_fill_of_planar_graphs(name):
    matrix, x = PLANAR[name]
    assert fill(EliminationTree(matrix, x)) <= FILL * len(x) * np.log2(len(x))


def test_how_vertices_are_numbered_hardly_matters():
    whole = grid(40, 50)
    expected = fill(EliminationTree(*whole))
    for seed in range(3):
        # Cuts move by a vertex where coordinates are equal.
        assert abs(fill(EliminationTree(*renumbered(whole, seed))) / expected - 1) < 0.15


def test_a_rolled_up_sheet_is_cut_along_its_surface():
    assert len(root_separator(EliminationTree(*rolled_up(1000)))) <= 20


@compiled
@pytest.mark.parametrize("kernel", ["compiled"], indirect=True)
@pytest.mark.parametrize("columns", [30, 80])
def test_a_neck_near_the_middle_is_found(columns):
    """Two sheets, one above the other, joined by one edge: the cut leaves the middle for it."""
    one, x = grid(50, columns)
    two, y = grid(45, columns, seed=1)
    n = len(x) + len(y)
    join = sp.coo_matrix((np.ones(1), ([n // 4], [len(x) + len(y) // 2])), shape=(n, n))
    matrix = sp.block_diag([one, two]) + join + join.T
    assert len(root_separator(EliminationTree(matrix, np.concatenate([x, y + 60 * np.eye(3)[2]])))) == 1


def test_components_are_parted_by_nothing_even_in_one_place():
    matrix, x = grid(20, 30)
    tree = EliminationTree(sp.block_diag([matrix, matrix], format="csr"), np.concatenate([x, x]))
    assert len(root_separator(tree)) == 0
    assert halves(tree) == [600, 600]


@pytest.mark.parametrize("far", [1e36, 1e40, 1e44, 1e300])
def test_a_vertex_much_farther_away_than_others_are_from_each_other_is_no_matter(far):
    graph, x = grid(9, 12)
    x[50] = far
    order = EliminationTree(graph, x).layout.vertices
    assert sorted(order) == list(range(108))


def test_a_hub_that_reaches_everything_is_cut_out():
    n = 1000
    matrix = laplacian(n, np.full(n - 1, 7), np.delete(np.arange(n), 7))
    tree = EliminationTree(matrix, np.random.default_rng(0).normal(size=(n, 3)))
    assert root_separator(tree).tolist() == [7]
    assert min(halves(tree)) > 350
