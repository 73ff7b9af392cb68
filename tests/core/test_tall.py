"""Products of tall arrays against NumPy's own, over several chunks of rows."""

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.spatial.distance import cdist

from bihdist_core.solver import tall

RANDOM = np.random.default_rng(0)
X, Y, C, W = (RANDOM.standard_normal(shape) for shape in [(250, 7), (250, 5), (7, 5), 250])


@pytest.fixture(autouse=True)
def small_chunks(monkeypatch):
    monkeypatch.setattr(tall, "ROWS", 64)


def test_products():
    blocks = [X[:, :3], X[:, 3:6], X[:, 6:]]
    assert np.allclose(tall.gram(blocks, Y, W), X.T @ np.diag(W) @ Y)
    assert np.allclose(tall.own_gram(X, abs(W)), X.T @ np.diag(abs(W)) @ X)
    assert np.allclose(tall.multiply(blocks, C), X @ C)
    y = Y.copy()
    tall.subtract(y, blocks, C)
    assert np.allclose(y, Y - X @ C)


@pytest.mark.parametrize("columns", [1, 3, 5])
def test_recombined_blocks(columns):
    blocks = [X[:, :3].copy(), X[:, 3:6].copy(), X[:, 6:].copy()]
    mixed = tall.recombine(blocks, C[:, :columns])
    assert np.allclose(np.hstack(mixed), X @ C[:, :columns])
    assert all(x.flags.c_contiguous for x in mixed)
    assert np.shares_memory(mixed[0], blocks[0]) == (columns >= 3)


def test_rows_of_a_sparse_matrix():
    matrix = sp.random(250, 250, 0.05, random_state=0, format="csr")
    assert np.array_equal(tall.sparse_rows(matrix, slice(60, 130)).toarray(), matrix[60:130].toarray())


def test_distances_of_points_near_and_far():
    assert np.allclose(tall.point_distances(X, X[:9]), cdist(X, X[:9]), rtol=1e-13)
    assert (np.diag(tall.point_distances(X, X)) == 0).all()
    close = X[:1] + 1e8
    assert tall.point_distances(close + 1e-7, close)[0, 0] == pytest.approx(
        np.linalg.norm(close + 1e-7 - close), rel=1e-12
    )
    assert tall.point_distances(X, X[:0]).shape == (250, 0)
