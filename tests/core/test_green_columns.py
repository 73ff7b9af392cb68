"""Distances from columns of G A G: compiled and plain agree, count what is near, and refuse squares below zero."""

import numpy as np
import pytest

from bihdist_core.distances import squares
from bihdist_core.errors import SolverError

RNG = np.random.default_rng(3)


def written(values, rows, diagonal, u, index, limit, is_compiled, monkeypatch):
    if not is_compiled:
        monkeypatch.setattr(squares, "library", lambda: None)
    out = np.full((len(diagonal), 5), np.nan)
    write = squares.writer_of_distances(diagonal, u, 2.0, index, limit, out)
    near = write(rows, slice(1, 4), values)
    return out, near


@pytest.mark.parametrize("is_compiled", [True, False])
def test_distances_and_how_many_are_near(is_compiled, monkeypatch):
    n, index, rows = 9, np.array([8, 2, 5, 0, 1]), np.array([4, 0, 7])
    diagonal, u = 1 + RNG.random(n), RNG.random(n)
    wide = RNG.random((3, 8))
    values = wide[:, 2:5]
    # C = G A G - u u^T / area, and d^2 = C_ii + C_jj - 2 C_ij.
    c = values - u[rows][:, None] * u[index[1:4]] / 2.0
    squares = diagonal[rows][:, None] + diagonal[index[1:4]] - 2 * c
    limit = float(np.median(squares))
    out, near = written(
        values.copy() if not is_compiled else values, rows, diagonal, u, index, limit, is_compiled, monkeypatch
    )
    assert np.abs(out[rows, 1:4] - np.sqrt(squares)).max() < 1e-14
    assert near.tolist() == (squares < limit).sum(axis=0).tolist()
    assert np.isnan(np.delete(out, rows, axis=0)).all()
    assert np.isnan(out[:, [0, 4]]).all()


@pytest.mark.parametrize("is_compiled", [True, False])
def test_squares_below_zero_are_refused_beyond_rounding(is_compiled, monkeypatch):
    diagonal, u, index, rows = np.ones(4), np.zeros(4), np.arange(5) % 4, np.array([3])
    out, _ = written(np.array([[1 + 1e-9, 0, 0]]), rows, diagonal, u, index, 0.0, is_compiled, monkeypatch)
    assert out[3, 1:4].tolist() == [0, np.sqrt(2), np.sqrt(2)]
    for bad in (1.5, np.nan):
        with pytest.raises(SolverError, match="squared distance"):
            written(np.array([[bad, 0, 0]]), rows, diagonal, u, index, 0.0, is_compiled, monkeypatch)
