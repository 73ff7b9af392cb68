"""Shepard interpolation: what the formula promises, with every distance."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    Cancelled,
    DiffusionDistance,
    GeodesicDistance,
    ParameterError,
    ShepardInterpolant,
    Surface,
    VertexError,
)
from tests.shapes import bumpy, components_apart, grid, two_pieces

DISTANCES = {
    "biharmonic": BiharmonicDistance,
    "diffusion": DiffusionDistance,
    "dijkstra": lambda s: GeodesicDistance(s, "dijkstra"),
}
every_distance = pytest.mark.parametrize("make", DISTANCES.values(), ids=DISTANCES)
ANCHORS, VALUES = [3, 77, 140], [2.0, -1.0, 0.25]


@every_distance
def test_equals_the_formula_of_the_paper(make):
    distance = make(bumpy(150))
    field = ShepardInterpolant(distance, ANCHORS, VALUES).evaluate()
    for p in (0, 50, 149):
        weights = [1 / distance.between(p, a) for a in ANCHORS]
        # The two ways to a distance agree to about 1e-8 of itself.
        assert field[p] == pytest.approx(np.dot(weights, VALUES) / np.sum(weights), rel=1e-6)


@every_distance
def test_anchors_are_met_exactly_constants_are_kept_and_nothing_overshoots(make):
    distance = make(bumpy(150))
    field = ShepardInterpolant(distance, ANCHORS, VALUES).evaluate()
    assert field[ANCHORS].tolist() == VALUES
    assert field.min() == -1
    assert field.max() == 2
    assert (ShepardInterpolant(distance, ANCHORS, [0.1, 0.1, 0.1]).evaluate() == 0.1).all()


def test_scaling_the_surface_changes_nothing():
    s = bumpy(150)
    large = Surface(1e6 * s.vertices, s.faces)
    one, other = (ShepardInterpolant(BiharmonicDistance(t), ANCHORS, VALUES).evaluate() for t in (s, large))
    assert one == pytest.approx(other, abs=1e-9)


def test_each_component_uses_its_own_anchors():
    s = two_pieces()
    large, small = components_apart(s)
    distance = BiharmonicDistance(s)
    alone = ShepardInterpolant(distance, large[:2], [1.0, 2.0]).evaluate()
    assert np.isfinite(alone[large]).all()
    assert np.isnan(alone[small]).all()
    assert np.isnan(alone[60])
    both = ShepardInterpolant(distance, [*large[:2], small[1]], [1.0, 2.0, 7.0]).evaluate()
    assert np.array_equal(both[large], alone[large])
    assert (both[small] == 7).all()


def test_points_that_a_distance_cannot_tell_from_anchors():
    # Two coincident vertices, joined by an edge of no length: distance 0 along edges.
    g = grid(2, 2)
    s = Surface(np.concatenate([g.vertices, g.vertices[:1]]), np.concatenate([g.faces, [[0, 9, 1]]]))
    distance = GeodesicDistance(s, "dijkstra")
    assert ShepardInterpolant(distance, [0, 8], [5.0, 1.0]).evaluate()[9] == 5
    field = ShepardInterpolant(distance, [0, 9, 8], [5.0, 3.0, 1.0]).evaluate()
    assert field[[0, 9]].tolist() == [5, 3]
    assert np.isfinite(field).all()


def test_progress_is_passed_on_and_can_stop_the_work():
    def stop(fraction, text):
        raise Cancelled("enough")

    # On the smaller piece the long work is left to the first question.
    interpolant = ShepardInterpolant(BiharmonicDistance(two_pieces()), [61], [1.0])
    with pytest.raises(Cancelled, match="enough"):
        interpolant.evaluate(stop)
    assert interpolant.evaluate()[61] == 1


@pytest.mark.parametrize(
    ("anchors", "values", "error", "words"),
    [
        ([3, 4, 3], [1, 2, 1], VertexError, "Vertex 3 is an anchor twice"),
        ([3, 60], [1, 2], VertexError, "vertex 60 belongs to no face"),
        ([3, 99], [1, 2], VertexError, "no vertex 99"),
        ([], [], ParameterError, "at least one anchor"),
        ([3, 4], [1], ParameterError, r"2 anchors need as many finite values, not an array of shape \(1,\)"),
        ([3, 4], [1, np.nan], ParameterError, "with 1 that are not finite"),
    ],
)
def test_refused(anchors, values, error, words):
    distance = BiharmonicDistance(two_pieces())
    with pytest.raises(error, match=words):
        ShepardInterpolant(distance, np.array(anchors, int), values)
