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


def test_exponent_and_smoothness_are_those_of_the_formula():
    distance = BiharmonicDistance(bumpy(150))
    field = ShepardInterpolant(distance, ANCHORS, VALUES, exponent=2.5, smoothness=0.2).evaluate()
    columns = distance.from_sources(ANCHORS)
    for p in (0, 50, 149):
        rounded = columns[p] ** 2 / (columns[p] + 0.2 * columns.max(axis=0))
        weights = rounded**-2.5
        assert field[p] == pytest.approx(np.dot(weights, VALUES) / weights.sum(), rel=1e-9)
    assert field[ANCHORS].tolist() == VALUES


def test_smoothness_rounds_the_cones_at_anchors():
    """At its neighbours the interpolant is less than half as far from an anchor's value."""
    surface = bumpy(2000)
    distance = BiharmonicDistance(surface)
    anchors, values = [3, 900, 1800], [1.0, 0.0, 0.0]
    plain, smooth = (ShepardInterpolant(distance, anchors, values, smoothness=s).evaluate() for s in (0.0, 0.3))
    beside = surface.edges[(surface.edges == 3).any(axis=1)].ravel()
    beside = beside[beside != 3]
    assert (1 - smooth[beside] < 0.5 * (1 - plain[beside])).all()
    assert smooth.min() >= 0
    assert smooth.max() <= 1


def test_other_values_cost_no_column_and_a_new_anchor_one():
    distance = BiharmonicDistance(bumpy(150))
    asked = []
    solve = distance.from_sources
    distance.from_sources = lambda sources, progress=None: asked.extend(sources) or solve(sources, progress)
    now = ShepardInterpolant(distance, ANCHORS, VALUES)
    now.evaluate()
    assert asked == ANCHORS
    for change in (
        {"values": [1.0, 5.0, 2.0]},
        {"anchors": [*ANCHORS, 20], "values": [1.0, 5.0, 2.0, 3.0], "exponent": 2},
        {"anchors": [77, 20], "values": [5.0, 3.0], "exponent": 1, "smoothness": 0.5},
    ):
        now = now.changed(**change)
        alone = ShepardInterpolant(
            BiharmonicDistance(bumpy(150)), now.anchors, now.values, now.exponent, now.smoothness
        )
        assert now.evaluate() == pytest.approx(alone.evaluate(), rel=1e-12)
    assert asked == [*ANCHORS, 20]


def test_the_sum_of_weights_is_a_logarithm_over_its_least_value():
    distance = BiharmonicDistance(bumpy(150))
    found = ShepardInterpolant(distance, ANCHORS, VALUES, exponent=1.5).sum_of_weights()
    with np.errstate(divide="ignore"):
        total = (distance.from_sources(ANCHORS) ** -1.5).sum(axis=1)
    assert np.isposinf(found[ANCHORS]).all()
    rest = np.setdiff1d(np.arange(150), ANCHORS)
    assert found[rest] == pytest.approx(np.log10(total[rest] / total.min()), abs=1e-9)


@pytest.mark.parametrize(
    ("exponent", "smoothness", "words"), [(0, 0, "exponent"), (1, 1.5, "smoothness"), (np.nan, 0, "exponent")]
)
def test_parameters_out_of_range_are_refused(exponent, smoothness, words):
    with pytest.raises(ParameterError, match=words):
        ShepardInterpolant(BiharmonicDistance(bumpy(150)), ANCHORS, VALUES, exponent, smoothness)
