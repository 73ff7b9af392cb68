"""Numbering changes what rounding does to a factor: distances differ by no more than both say of their accuracy."""

from functools import partial

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    CommuteTimeDistance,
    DiffusionDistance,
    Laplacian,
    SolverError,
    Surface,
    TruncatedBiharmonicDistance,
)
from bihdist_core.distances.accuracy import SolveErrors
from tests.core.nasty_meshes import nasty_mesh
from tests.shapes import bumpy

ON_HARD_MESHES = [
    # Blocks of the factor that are nearly singular.
    (BiharmonicDistance, 990989, 1),
    (BiharmonicDistance, 892125, 1),
    (CommuteTimeDistance, 892125, 2),
    (CommuteTimeDistance, 410223, 3),
    # Eigenvalues that rounding changes by more than their residuals say.
    (partial(DiffusionDistance, t=0.25), 330767, 1),
    (partial(DiffusionDistance, t=0.25), 614000, 0),
    (partial(DiffusionDistance, t=0.25), 98562, 3),
]


def in_another_order(seed, turn):
    """A hard mesh, the same renumbered, and the ids of a component in both."""
    surface = Surface(*nasty_mesh(seed, 60))
    order = np.random.default_rng(turn).permutation(len(surface.vertices))
    number = np.argsort(order)
    ids = np.flatnonzero(surface.component_of_vertex == 0)
    return surface, Surface(surface.vertices[order], number[surface.faces]), ids, number[ids]


def test_fields_differ_by_no_more_than_is_said():
    largest = []
    for make, seed, turn in ON_HARD_MESHES:
        one, other, ids, numbers = in_another_order(seed, turn)
        a, b = make(Laplacian(one)), make(Laplacian(other))
        fields, again = a.from_sources(ids)[ids], b.from_sources(numbers)[numbers]
        largest.append((np.abs(fields - again).max(axis=0) / fields.max(axis=0)).max())
        assert largest[-1] < a.accuracy + b.accuracy < 1e-3
    # By how much is a matter of rounding, which no two machines have alike.
    assert sum(off > 1e-9 for off in largest) >= 2


@pytest.mark.parametrize(
    ("make", "seed"),
    [
        # A piece of little area hangs on one link of 1e-6, beside springs of 5e6.
        (BiharmonicDistance, 693149),
        # The values at a vertex without an area, which no residual measures.
        (partial(TruncatedBiharmonicDistance, k=13), 825224),
    ],
)
def test_what_may_be_far_off_is_refused(make, seed):
    """In one order at least."""
    surfaces = in_another_order(seed, 1)[:2]
    with pytest.raises(SolverError):
        [make(Laplacian(surface)).error_estimate([0]) for surface in surfaces]


def test_a_worse_solver_is_noticed(monkeypatch):
    """By so much as it is worse, and at the vertex whose row of the inverse is wrong."""
    component = Laplacian(bumpy(60)).components[0]
    right = component.solve
    assert np.abs(SolveErrors(component, 0.0).off(np.eye(60))).max() < 1e-13

    def wrong(b, progress=None):
        x = right(b, progress)
        x[7] *= 1 + 1e-6
        return x

    monkeypatch.setattr(component, "solve", wrong)
    errors = SolveErrors(component, 0.0)
    off = errors.off(np.eye(60))
    np.testing.assert_allclose(off[7], 1e-6 * right(np.eye(60))[7], rtol=1e-4, atol=1e-12)
    vertex, of_squares = errors.at_worst()
    assert vertex == 7
    assert of_squares.max() == pytest.approx(1e-6 * right(np.eye(60))[7, 7], rel=1e-3)
