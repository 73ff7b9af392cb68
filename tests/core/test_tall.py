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
    assert np.allclose(tall.gram(X, Y, W), X.T @ np.diag(W) @ Y)
    assert np.allclose(tall.multiply(X, C), X @ C)
    y = Y.copy()
    tall.subtract(y, X, C)
    assert np.allclose(y, Y - X @ C)
    x = X.copy()
    tall.recombine(x, C)
    assert np.allclose(x[:, :5], X @ C)


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
