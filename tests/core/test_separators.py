"""Separators separate, are never longer than the cover of the cut, and as short as can be where that is known."""

import numpy as np
import pytest

from bihdist_core.solver import ordering, separators
from bihdist_core.solver.ordering import nested_dissection
from bihdist_core.solver.separators import separate

from .test_ordering import GRAPHS, grid


def separated(i, j, side, region, move):
    """The new sides; checks that the halves do not touch."""
    side = side.astype(np.int8)
    separate(side, i, j, region, move)
    assert set(side) <= {0, 1, 2}
    assert (side[i] + side[j] != 1).all()
    return side


@pytest.mark.parametrize("move", [False, True])
@pytest.mark.parametrize("name", GRAPHS)
def test_no_edge_joins_the_halves(name, move):
    i, j, x = GRAPHS[name]
    random = np.random.default_rng(0)
    for side in (x[:, 0] > np.median(x[:, 0]) if len(x) else np.zeros(0), random.integers(2, size=len(x))):
        separated(i, j, np.asarray(side), np.zeros(len(x), np.int64), move)


@pytest.mark.parametrize("name", GRAPHS)
def test_dissections_with_moved_separators_are_dissections(name, monkeypatch):
    monkeypatch.setattr(ordering, "LARGE", 0)
    i, j, x = GRAPHS[name]
    node = nested_dissection(i, j, x, depth=3)
    low, high = np.minimum(node[i], node[j]), np.maximum(node[i], node[j])
    for _ in range(4):
        high = np.where(high > low, high >> 1, high)
    assert (low == high).all()


def jagged(rows, columns, teeth):
    """A grid and a cut down its middle with teeth of this length."""
    i, j, x = grid(rows, columns)
    middle = columns // 2 + teeth * (x[:, 1] // 4 % 2)
    return i, j, (x[:, 0] >= middle).astype(np.int8)


def test_a_jagged_cut_becomes_straight():
    i, j, side = jagged(20, 30, teeth=3)
    region = np.zeros(600, np.int64)
    assert (separated(i, j, side, region, move=True) == 2).sum() == 20  # a column: nothing shorter parts the sides
    assert (separated(i, j, side, region, move=False) == 2).sum() > 20


def test_regions_are_each_separated_as_if_alone(monkeypatch):
    i, j, side = jagged(20, 30, teeth=3)
    copies = 5
    many_i, many_j = (np.concatenate([k + 600 * c for c in range(copies)]) for k in (i, j))
    sides, region = np.tile(side, copies), np.repeat(np.arange(copies), 600)
    for band in (1, 300, 10**6):
        monkeypatch.setattr(separators, "BAND", band)
        together = separated(many_i, many_j, sides, region, move=True)
        assert (together.reshape(copies, 600) == 2).sum(axis=1).tolist() == [20] * copies


def test_a_separator_does_not_run_away_from_the_middle():
    """A bottle with its neck next to the cut: the neck is shorter, but leaves nearly all on one side."""
    i, j, _ = grid(40, 4)
    tip = np.arange(160, 163)
    i, j = np.r_[i, 0, tip[:-1]], np.r_[j, 160, tip[1:]]
    side = np.r_[np.zeros(8, np.int8), np.ones(152, np.int8), np.zeros(3, np.int8)]
    region = np.zeros(163, np.int64)
    count = np.bincount(separated(i, j, side, region, move=True), minlength=3)
    cover = np.bincount(separated(i, j, side, region, move=False), minlength=3)
    assert count.tolist() == cover.tolist()


def test_a_hub_that_reaches_everything_is_cut_out():
    i, j, _ = GRAPHS["star"]
    side = np.arange(1000) % 2
    result = separated(i, j, side, np.zeros(1000, np.int64), move=True)
    assert np.flatnonzero(result == 2).tolist() == [0]
    assert np.bincount(result)[:2].min() > 400
