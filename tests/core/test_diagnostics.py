"""Diagnostics on fields whose answers are known."""

import tracemalloc

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    DiffusionDistance,
    GeodesicDistance,
    ParameterError,
    Surface,
    field_change,
    gradient_jumps,
    isotropy_ratio,
    smallest_distance,
    triangle_violations,
)
from bihdist_core.analysis import diagnostics
from tests.shapes import bumpy, components_apart, fin, grid, slivers, sphere, two_pieces


def around(s, x, y):
    return s.vertices[:, 0] - x, s.vertices[:, 1] - y


def test_isotropy_of_circles_and_of_ellipses():
    s = grid(60, 60)
    x, y = around(s, 30, 30)
    round_, long = np.hypot(x, y), np.hypot(x, 3 * y)
    # Linear on each face, a circle of radius 20 unit edges is off by up to 1 / (8 * 20).
    assert isotropy_ratio(s, round_, round_, 20.5) == pytest.approx(1, abs=0.01)
    assert isotropy_ratio(s, long, round_, 20.5) == pytest.approx(3, rel=0.02)
    assert isotropy_ratio(s, 7 * long, round_, 20.5) == pytest.approx(isotropy_ratio(s, long, round_, 20.5))


def test_isotropy_of_a_field_against_itself_is_1_and_of_one_that_vanishes_infinite():
    s = bumpy(400)
    geodesic = GeodesicDistance(s, "exact").from_source(3)
    assert isotropy_ratio(s, geodesic, geodesic, 0.4) == pytest.approx(1, abs=1e-12)
    assert isotropy_ratio(s, np.zeros(400), geodesic, 0.4) == np.inf
    with pytest.raises(ParameterError, match="no geodesic circle of radius 9"):
        isotropy_ratio(s, geodesic, geodesic, 9)


def test_on_a_sphere_biharmonic_distance_is_isotropic():
    s = sphere(2000)
    geodesic = GeodesicDistance(s, "exact").from_source(3)
    assert isotropy_ratio(s, BiharmonicDistance(s).from_source(3), geodesic, 0.3) < 1.03


def test_a_linear_field_has_no_jumps_and_a_roof_has_the_right_one():
    s = grid(10, 10)
    x, y = around(s, 5, 5)
    plane = gradient_jumps(s, 2 * x - 3 * y)
    assert plane.jumps == pytest.approx(0, abs=1e-12)
    assert plane.slope == pytest.approx(np.sqrt(13))
    roof = gradient_jumps(s, -2 * np.abs(x))
    ridge = (s.vertices[roof.edges, 0] == 5).all(axis=1)
    assert roof.jumps[ridge] == pytest.approx(4)
    assert roof.jumps[~ridge] == pytest.approx(0, abs=1e-12)
    assert roof.relative[ridge] == pytest.approx(2)
    # Every inner edge once: 10 x 10 squares, three edges a square, less the outer ones.
    assert len(roof.edges) == len(s.edges) - 40


def test_jumps_are_intrinsic_bending_the_sheet_changes_nothing():
    s = grid(10, 10)
    field = np.random.default_rng(0).standard_normal(121)
    x, y = s.vertices[:, 0], s.vertices[:, 1]
    # Folded upright along x = 4, where edges run.
    folded = Surface(np.stack([np.minimum(x, 4), y, np.maximum(x - 4, 0)], 1), s.faces)
    assert gradient_jumps(folded, field).jumps == pytest.approx(gradient_jumps(s, field).jumps)


def test_jumps_of_a_smooth_field_shrink_with_the_edges_and_a_kink_stays():
    smooth, kinked = [], []
    for n in (20, 40):
        s = Surface(grid(n, n).vertices / n, grid(n, n).faces)
        x, y = around(s, 0.47, 0.5)
        smooth.append(np.nanmax(gradient_jumps(s, np.cos(3 * x) + y).jumps))
        kinked.append(np.nanmax(gradient_jumps(s, np.abs(x) + y).relative))
    assert smooth[1] == pytest.approx(smooth[0] / 2, rel=0.1)
    assert kinked[1] > 0.9 * kinked[0] > 0.5


def test_jumps_leave_flat_faces_boundaries_and_missing_values_out():
    assert np.isfinite(gradient_jumps(slivers(), np.arange(18.0)).jumps).all()
    found = gradient_jumps(fin(), np.arange(8.0))
    # Three faces meet at 0-1; only 1-2 has two.
    assert found.edges.tolist() == [[1, 2]]
    field = np.arange(49.0)
    field[24] = np.nan
    jumps = gradient_jumps(grid(6, 6), field)
    touched = np.isnan(jumps.jumps)
    assert 0 < touched.sum() < len(jumps.jumps)
    assert np.isfinite(jumps.slope)
    with pytest.raises(ParameterError, match=r"each of 49 vertices, not an array of shape \(3,\)"):
        gradient_jumps(grid(6, 6), np.zeros(3))


def test_change_of_a_field_raw_and_after_division_by_its_maximum():
    change = field_change([0, 1, 4], [0, 1, 2])
    assert (change.mean, change.largest) == pytest.approx((1 / 6, 0.5))
    assert (change.normalised_mean, change.normalised_largest) == pytest.approx((0.25 / 3, 0.25))
    scaled = field_change([0, 1, 4], [0, 3, 12])
    assert scaled.normalised_largest == 0
    assert scaled.largest == 2


def test_change_looks_only_where_both_fields_have_values():
    # The maxima, too, are over the common points.
    assert field_change([0, 1, 4, np.nan], [0, 1, np.nan, 9]).largest == 0
    for before, after in [([0, np.nan], [np.nan, 1]), ([0, 0], [0, 1])]:
        with pytest.raises(ParameterError, match="positive maximum"):
            field_change(before, after)
    with pytest.raises(ParameterError, match=r"shape \(2,\) and \(3,\)"):
        field_change([0, 1], [0, 1, 2])


def test_triangle_inequality_of_metrics_holds_and_a_broken_one_is_found():
    d = BiharmonicDistance(bumpy(150)).pairwise(np.arange(60))
    sample = triangle_violations(d, 20_000)
    assert (sample.triples, sample.violations) == (20_000, 0)
    assert sample.worst < 1e-9
    assert 0 <= sample.tightest < 0.2
    squared = triangle_violations(d**2, 20_000)
    assert squared.violations > 100
    assert 0 < squared.worst < 1


def test_triples_are_of_three_different_points():
    # Among three points with one long side, a third of the triples break the inequality, and by 3 of 5.
    d = np.array([[0.0, 1, 5], [1, 0, 1], [5, 1, 0]])
    sample = triangle_violations(d, 6000)
    assert sample.violations == pytest.approx(2000, rel=0.1)
    assert sample.worst == pytest.approx(0.6)
    # With two points named twice there would be slack 0.
    assert triangle_violations(1 - np.eye(4), 1000).tightest == 0.5


def test_any_number_of_triples_takes_the_memory_of_a_block(monkeypatch):
    monkeypatch.setattr(diagnostics, "TRIPLES", 1000)
    d = np.array([[0.0, 1, 5], [1, 0, 1], [5, 1, 0]])
    tracemalloc.start()
    sample = triangle_violations(d, 100_500)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most < 500_000
    assert (sample.triples, sample.violations) == (100_500, pytest.approx(33_500, rel=0.02))
    assert sample.worst == pytest.approx(0.6)


def test_triples_refused():
    with pytest.raises(ParameterError, match=r"not one of shape \(2, 2\)"):
        triangle_violations(np.zeros((2, 2)))
    with pytest.raises(ParameterError, match=r"not one of shape \(4, 3\)"):
        triangle_violations(np.zeros((4, 3)))
    with pytest.raises(ParameterError, match="count is 0"):
        triangle_violations(np.zeros((3, 3)), 0)


@pytest.mark.parametrize("make", [BiharmonicDistance, DiffusionDistance], ids=["biharmonic", "diffusion"])
def test_smallest_distance_is_that_of_all_pairs(make):
    distance = make(bumpy(150))
    all_pairs = distance.pairwise(np.arange(150))
    all_pairs[np.arange(150), np.arange(150)] = np.inf
    said = []
    least, i, j = smallest_distance(distance, lambda share, text: said.append(share), block=40)
    assert least == pytest.approx(all_pairs.min(), rel=1e-6)
    assert all_pairs[i, j] == all_pairs.min()
    assert said[-1] == 1


def test_smallest_distance_stays_within_components():
    s = two_pieces()
    least, i, j = smallest_distance(BiharmonicDistance(s))
    large = components_apart(s)[0]
    assert (i in large) == (j in large)
    assert least > 0
