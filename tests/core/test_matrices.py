"""Laplacians of any matrices, and entries of sparse inverses, against dense spectra and inverses."""

import pickle

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.spatial import Delaunay
from scipy.spatial.distance import cdist

import bihdist_core as bihdist
from bihdist_core import Laplacian, ParameterError, SparseFactor
from bihdist_core.kernel.library import PLAIN, library
from bihdist_core.solver.elimination_tree import EliminationTree
from tests.core.graphs import laplacian as graph_laplacian
from tests.shapes import bumpy

CLOSE = 1e-9


def random_graph(n=400):
    rng = np.random.default_rng(0)
    i, j = np.r_[rng.integers(n, size=n), np.arange(n - 1)], np.r_[rng.integers(n, size=n), np.arange(1, n)]
    return graph_laplacian(n, i[i != j], j[i != j], rng.uniform(0.1, 1, (i != j).sum())), np.ones(n), None


def tetrahedra(n=500):
    points = np.random.default_rng(1).random((n, 3))
    corners = Delaunay(points).simplices
    sides = points[corners[:, 1:]] - points[corners[:, :1]]
    volume = np.abs(np.linalg.det(sides)) / 6
    corners, sides, volume = corners[volume > 1e-9], sides[volume > 1e-9], volume[volume > 1e-9]
    slopes = np.linalg.inv(sides).transpose(0, 2, 1)
    slopes = np.concatenate([-slopes.sum(axis=1, keepdims=True), slopes], axis=1)
    entries = np.einsum("tia,tja,t->tij", slopes, slopes, volume)
    rows, columns = np.repeat(corners, 4, axis=1).ravel(), np.tile(corners, (1, 4)).ravel()
    stiffness = sp.coo_matrix((entries.ravel(), (rows, columns)), shape=(n, n)).tocsr()
    return stiffness, np.bincount(corners.ravel(), np.repeat(volume / 4, 4), n), points


def surface_matrices():
    known = Laplacian(bumpy(400))
    return known.stiffness, known.areas, known.surface.vertices


MATRICES = {"graph": random_graph, "tetrahedra": tetrahedra, "surface": surface_matrices}


@pytest.fixture(params=["compiled", "plain"])
def solver(request, monkeypatch):
    if request.param == "plain":
        monkeypatch.setenv(PLAIN, "1")
        library.cache_clear()
    yield
    library.cache_clear()


@pytest.mark.usefixtures("solver")
@pytest.mark.parametrize("make", MATRICES.values(), ids=MATRICES)
def test_distances_are_those_of_the_dense_spectrum(make):
    stiffness, masses, positions = make()
    given, half = Laplacian.from_matrices(stiffness, masses, positions), np.sqrt(masses)
    values, vectors = np.linalg.eigh(stiffness.toarray() / np.outer(half, half))
    values, vectors = values[1:], vectors[:, 1:] / half[:, None]
    for distance, weights, close in [
        (bihdist.BiharmonicDistance(given), values**-2, CLOSE),
        (bihdist.CommuteTimeDistance(given), 1 / values, CLOSE),
        (bihdist.PowerDistance(given, 3), values**-3, 1e-8),
        (bihdist.DiffusionDistance(given, 0.5), np.exp(-0.5 * values / values[0]), 1e-8),
        (bihdist.TruncatedBiharmonicDistance(given, 20), np.where(np.arange(len(values)) < 20, values**-2, 0), 1e-7),
    ]:
        points = vectors * np.sqrt(weights)
        expected = cdist(points, points[[1, 7, 100]])
        fields = distance.from_sources([1, 7, 100])
        off = np.abs(fields - expected).max() / expected.max()
        assert off < close, distance.label
        assert off <= distance.accuracy, distance.label
        assert np.allclose(distance.from_source("1+7"), expected[:, :2].min(axis=1), atol=close * expected.max())
        if distance.label.endswith("exact") and not isinstance(distance, bihdist.PowerDistance):
            edges, at_edges = distance.edge_distances()
            there = cdist(points, points)[tuple(edges.T)]
            assert len(edges) == (sp.triu(stiffness, 1) != 0).nnz
            assert np.abs(at_edges - there).max() < close * expected.max()


def test_a_laplacian_of_a_surfaces_matrices_is_that_of_the_surface():
    surface = bumpy(300)
    known = Laplacian(surface)
    given = Laplacian.from_matrices(known.stiffness, known.areas, surface.vertices)
    one, other = bihdist.BiharmonicDistance(known), bihdist.BiharmonicDistance(given)
    assert np.allclose(one.from_source(3), other.from_source(3), rtol=1e-12)
    assert bihdist.farthest_points(one, 5).tolist() == bihdist.farthest_points(other, 5).tolist()
    assert np.allclose(one.embedding(10).tails, other.embedding(10).tails, rtol=1e-6)
    assert bihdist.nearest(one, [5], 4)[0].tolist() == bihdist.nearest(other, [5], 4)[0].tolist()
    again = pickle.loads(pickle.dumps(other))
    assert np.array_equal(again.from_source(3), other.from_source(3))


def test_components_have_no_distance_between_them_and_single_rows_have_none():
    blocks = [graph_laplacian(3, [0, 1], [1, 2]), sp.csr_matrix((1, 1)), graph_laplacian(2, [0], [1])]
    given = Laplacian.from_matrices(sp.block_diag(blocks), np.ones(6), name="roads")
    field = bihdist.CommuteTimeDistance(given).from_source(0)
    assert np.allclose(field**2, [0, 1, 2, np.nan, np.nan, np.nan], equal_nan=True)
    with pytest.raises(bihdist.VertexError, match="roads: node 3 is joined to no other"):
        bihdist.BiharmonicDistance(given).from_source(3)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda s, m: (s[:-1], m), "is to be square, and its shape is"),
        (lambda s, m: (s + sp.csr_matrix(([1.0], ([2], [5])), s.shape), m), r"to be symmetric, and its entry \(2, 5\)"),
        (lambda s, m: (s + sp.identity(len(m)), m), "have the sum 0, .* row "),
        (lambda s, m: (-s, m), "positive semi-definite, and the diagonal entry of row "),
        (lambda s, m: (s * np.nan, m), "not finite"),
        (lambda s, m: (s, m[:-1]), "as many masses"),
        (lambda s, m: (s, np.where(np.arange(len(m)) == 4, 0, m)), "masses are positive, and that of row 4 is 0"),
        (lambda s, m: (s, np.where(np.arange(len(m)) == 4, np.inf, m)), "that of row 4 is inf"),
        (lambda s, m: (0 * s, m), "no entry joins two rows"),
        (lambda s, m: ("L", m), "sparse .* matrix, not str"),
    ],
)
def test_matrices_that_make_no_laplacian_are_refused_by_name(change, message):
    stiffness, masses, _ = random_graph(30)
    with pytest.raises(ParameterError, match=message):
        Laplacian.from_matrices(*change(stiffness, masses), name="roads")


def test_a_geodesic_distance_needs_faces():
    stiffness, masses, positions = tetrahedra(50)
    with pytest.raises(ParameterError, match="faces"):
        bihdist.GeodesicDistance(Laplacian.from_matrices(stiffness, masses, positions))


@pytest.mark.usefixtures("solver")
@pytest.mark.parametrize("make", MATRICES.values(), ids=MATRICES)
def test_entries_of_the_inverse_are_those_of_the_dense_one(make):
    stiffness, masses, positions = make()
    matrix = sp.csr_matrix(stiffness + sp.diags(masses))
    inverse, factor = np.linalg.inv(matrix.toarray()), SparseFactor(matrix, positions)
    diagonal, entries = factor.diagonal_of_inverse(), factor.inverse_on_pattern().tocoo()
    off = np.abs(diagonal / inverse.diagonal() - 1).max()
    assert off <= factor.error_of(diagonal) < 1e-9
    assert entries.nnz == matrix.nnz
    assert np.abs(entries.data - inverse[entries.row, entries.col]).max() < 1e-10 * np.abs(inverse).max()
    b = np.random.default_rng(0).normal(size=(len(masses), 3))
    assert np.allclose(factor.solve(b), inverse @ b, rtol=1e-9, atol=1e-12 * np.abs(inverse).max())


def test_a_matrix_that_is_not_definite_is_refused():
    with pytest.raises(bihdist.SolverError, match="not positive definite"):
        bihdist.diagonal_of_inverse(sp.csr_matrix([[1.0, 2.0], [2.0, 1.0]]))


@pytest.mark.skipif(library() is None, reason="the order is the compiled kernel's")
def test_without_positions_an_order_fills_in_about_as_little():
    surface = bumpy(4000)
    stiffness = Laplacian(surface).stiffness
    filled = [EliminationTree(stiffness, x).layout.work for x in (surface.vertices, np.zeros_like(surface.vertices))]
    assert filled[1] < 1.5 * filled[0]
