"""Words of the paper as numbers: fields whose faults are known."""

import numpy as np
import pytest

from bihdist_core import (
    BiharmonicDistance,
    DiffusionDistance,
    GeodesicDistance,
    ParameterError,
    SourceSet,
    Surface,
    SurfacePoint,
    VertexError,
    apparent_source,
    difference_quality,
    extrema,
    gradient_jumps,
    isotropy_ratio,
    triangle_samples,
)
from bihdist_core.analysis.circles import geodesic_circles, small_radius
from bihdist_core.analysis.diagnostics import inner_jumps, kinks, triangle_violations
from bihdist_core.analysis.quality import field_quality
from bihdist_core.analysis.triangle_samples import triangle_sample
from bihdist_core.distances.difference import difference
from tests.shapes import bumpy, grid, sphere, torus, two_pieces


@pytest.fixture(scope="module")
def ball():
    return sphere(2000)


@pytest.fixture(scope="module")
def geodesic(ball):
    return GeodesicDistance(ball, "exact").from_source(3)


def test_circles_of_an_ellipse_are_twice_as_far_along_one_axis():
    plane = grid(60, 60)
    x, y = plane.vertices[:, 0] - 30, plane.vertices[:, 1] - 30
    source = int(np.flatnonzero((x == 0) & (y == 0))[0])
    (circle,) = geodesic_circles(plane, np.hypot(x, 2 * y), np.hypot(x, y), source, [20.5])
    (angles,), (values,) = circle.angles, circle.values
    assert circle.ratio == pytest.approx(2, rel=0.02)
    assert np.allclose(values, 20.5 * np.hypot(np.cos(angles), 2 * np.sin(angles)), 0, 0.05)
    # Once around, back to where it began.
    assert (angles[0], values[0]) == (angles[-1], values[-1])
    turned = np.unwrap(angles)
    assert abs(turned[-1] - turned[0]) == pytest.approx(2 * np.pi, rel=1e-9)


def test_ratios_are_those_of_the_isotropy_ratio(ball, geodesic):
    field = BiharmonicDistance(ball).from_source(3)
    found = geodesic_circles(ball, field, geodesic, 3)
    assert [c.radius for c in found] == pytest.approx(ball.mean_edge_length * np.arange(3, 13))
    assert [c.ratio for c in found] == [isotropy_ratio(ball, field, geodesic, c.radius) for c in found]
    assert all(c.ratio == pytest.approx(1) for c in geodesic_circles(ball, geodesic, geodesic, 3))
    twice = geodesic_circles(ball, field, geodesic, 3, [0.3, 0.3])
    assert [len(c.angles) for c in twice] == [1, 1]
    # Beyond the farthest vertex there is none.
    assert [c.radius for c in geodesic_circles(ball, field, geodesic, 3, [0.3, 9])] == [0.3]


def test_a_circle_that_meets_the_boundary_is_open():
    plane = grid(20, 20)
    field = np.hypot(plane.vertices[:, 0], plane.vertices[:, 1])
    (circle,) = geodesic_circles(plane, field, field, 0, [8.5])
    assert np.ptp(circle.angles[0]) == pytest.approx(np.pi / 2, abs=0.01)


def test_biharmonic_distance_is_good_where_the_paper_says(ball, geodesic):
    field = BiharmonicDistance(ball).from_source(3)
    smooth, sharp = field_quality(ball, field, geodesic, 3), field_quality(ball, geodesic, geodesic, 3)
    assert len(smooth.minima) == 0
    assert len(smooth.maxima) == 1
    assert smooth.maxima_height[0] == pytest.approx(1)
    assert smooth.isotropy == isotropy_ratio(ball, field, geodesic, small_radius(ball)) < 1.03
    assert len(smooth.circles) == 10
    assert smooth.kink < 0.5
    assert smooth.source == 3
    # The cut locus of a torus is a ridge.
    ring = torus(48, 24)
    near = GeodesicDistance(ring, "exact").from_source(0)
    ridge, none = (field_quality(ring, d, near, 0) for d in (near, BiharmonicDistance(ring).from_source(0)))
    assert ridge.kink > 1.9 > 0.5 > none.kink
    # Half around the tube, and once around the hole.
    assert ridge.kink_length > 6 / np.sqrt(8 * np.pi**2)
    assert none.kink_length == 0
    assert sharp.isotropy == pytest.approx(1)


def test_the_kink_is_the_largest_of_all_edges_and_has_no_scale(ball, geodesic):
    found = field_quality(ball, geodesic, geodesic, 3)
    every = gradient_jumps(ball, geodesic)
    away = (geodesic > small_radius(ball))[every.edges].all(axis=1)
    kinks = (every.jumps / np.maximum(every.lengths, every.slope))[away]
    assert found.kink == kinks.max()
    assert found.kink_edge.tolist() == every.edges[away][kinks.argmax()].tolist()
    assert field_quality(ball, 7 * geodesic, geodesic, 3).kink == pytest.approx(found.kink, rel=1e-9)
    assert len(inner_jumps(ball, geodesic, geodesic, 99.0).edges) == 0


def test_other_minima_are_found_with_their_depth():
    plane = grid(40, 40)
    x, y = plane.vertices[:, 0], plane.vertices[:, 1]
    near = np.hypot(x - 10, y - 20)
    other = int(np.flatnonzero((x == 30) & (y == 20))[0])
    source = int(np.flatnonzero((x == 10) & (y == 20))[0])
    field = np.minimum(near, 4 + np.hypot(x - 30, y - 20))
    found = field_quality(plane, field, near, source)
    assert found.minima.tolist() == [other]
    # Between the two the field rises to 12.
    assert found.minima_depth[0] == pytest.approx(8 / field.max(), rel=1e-9)


def test_small_components_and_bad_input(ball, geodesic):
    both = two_pieces()
    distance = BiharmonicDistance(both)
    near = GeodesicDistance(both, "dijkstra").from_source(62)
    found = field_quality(both, distance.from_source(62), near, 62)
    assert (found.kink, found.kink_edge.tolist()) == (0, [-1, -1])
    with pytest.raises(VertexError, match="vertex 60"):
        field_quality(both, near, near, 60)
    with pytest.raises(ParameterError, match="positive value"):
        field_quality(ball, 0 * geodesic, geodesic, 3)
    with pytest.raises(ParameterError, match="positive numbers"):
        geodesic_circles(ball, geodesic, geodesic, 3, [0])


def test_the_triangle_inequality_on_samples():
    surface = bumpy(300)
    for distance in (BiharmonicDistance(surface), DiffusionDistance(surface)):
        found = triangle_sample(distance)
        assert (found.triples, found.violations, found.worst) == (100_000, 0, 0)

    class Squared(BiharmonicDistance):
        def of_pairs(self, pairs, progress=None, **options):
            return super().of_pairs(pairs, progress, **options) ** 2

    broken = triangle_sample(Squared(surface), points=40, count=20_000)
    assert broken.violations > 500
    assert 0.05 < broken.worst < 1
    both = BiharmonicDistance(two_pieces())
    assert triangle_sample(both, component=1).violations == 0
    for points, component in ((2, 0), (5, 2), (5, -1)):
        with pytest.raises(ParameterError, match="three points"):
            triangle_sample(both, points, component)


@pytest.mark.parametrize("kind", [GeodesicDistance, BiharmonicDistance, DiffusionDistance])
def test_a_sample_grows_into_that_of_all_points(kind):
    surface = bumpy(200)
    distance = kind(surface, "dijkstra") if kind is GeodesicDistance else kind(surface)
    told = []
    grown = list(triangle_samples(distance, 21, count=5000, seed=4, progress=lambda share, _: told.append(share)))
    assert [points for points, _ in grown] == [8, 16, 21]
    some = np.random.default_rng(4).choice(200, 21, replace=False)
    for points, sample in grown:
        wanted = triangle_violations(distance.pairwise(some[:points]), 5000, 4)
        assert sample.violations == wanted.violations
        # Pairs may be summed in another order.
        assert (sample.worst, sample.tightest) == pytest.approx((wanted.worst, wanted.tightest), abs=1e-9)
    assert triangle_sample(distance, 21, count=5000, seed=4) == grown[-1][1]
    assert told == sorted(told)
    # Never a step too small for triangles.
    assert [points for points, _ in triangle_samples(distance, 18)] == [8, 18]


def test_a_difference_is_no_distance_but_has_extrema_and_kinks(ball, geodesic):
    field = BiharmonicDistance(ball).from_source(3)
    apart = difference(field, geodesic)
    with pytest.raises(ParameterError, match="positive value"):
        field_quality(ball, -np.abs(apart), geodesic, 3)
    found = difference_quality(ball, apart, geodesic, 3)
    every = extrema(ball, apart)
    assert found.minima.tolist() == [v for v in every.minima.tolist() if v != 3]
    assert found.maxima.tolist() == [v for v in every.maxima.tolist() if v != 3]
    assert found.maxima_height == pytest.approx(
        [p / np.ptp(apart) for v, p in zip(every.maxima, every.maxima_persistence, strict=True) if v != 3]
    )
    assert (found.circles, np.isnan(found.isotropy)) == ((), True)
    assert found.kink == kinks(ball, apart, geodesic).largest
    turned = difference_quality(ball, -apart, geodesic, 3)
    assert (turned.minima.tolist(), turned.kink) == (found.maxima.tolist(), found.kink)
    with pytest.raises(ParameterError, match="values that differ"):
        difference_quality(ball, 0 * apart, geodesic, 3)


def test_a_field_that_starts_nowhere_is_judged_everywhere(ball):
    height = ball.vertices[:, 2]
    found = difference_quality(ball, height, None, None)
    assert found.source is None
    assert found.minima.tolist() == [height.argmin()]
    assert found.maxima.tolist() == [height.argmax()]
    assert (found.minima_depth[0], found.maxima_height[0]) == pytest.approx((1, 1))
    # A fold along the equator.
    folded = difference_quality(ball, np.abs(height), None, None)
    assert folded.kink > 1.9 > 0.5 > found.kink
    assert folded.kink_length > 0.9 * 2 * np.pi / np.sqrt(4 * np.pi)


def test_where_a_field_seems_to_start(ball, geodesic):
    assert apparent_source(geodesic) == 3
    assert apparent_source(np.where(np.arange(2000) < 9, geodesic, np.nan)) == 3
    # Rounding is 0 too, and two zeros are no start.
    assert apparent_source(geodesic - 1e-9) == 3
    two = geodesic.copy()
    two[50] = 0
    for nowhere in (two, geodesic - 0.1, geodesic + 0.1, -geodesic, 0 * geodesic, geodesic[3:4], geodesic * np.nan):
        assert apparent_source(nowhere) is None


def test_angles_go_once_around_also_on_a_tip():
    # A cone as sharp as a needle, with its tip bent over: from above its circles are folded.
    rows, around = 24, 20
    up = np.repeat(np.arange(1, rows), around) / rows
    turn = np.tile(np.arange(around), rows - 1) * 2 * np.pi / around
    points = np.stack([0.1 * np.cos(turn) + up**2, 0.1 * np.sin(turn), 3 * up], 1)
    vertices = np.vstack([[0, 0, 0], points])
    first = 1 + np.arange(around * (rows - 2))
    right = np.where((first - 1) % around == around - 1, first + 1 - around, first + 1)
    tip = np.stack([np.zeros(around, int), 1 + (np.arange(around) + 1) % around, 1 + np.arange(around)], 1)
    faces = np.vstack(
        [np.stack([first, right, first + around], 1), np.stack([right, right + around, first + around], 1)]
    )
    surface = Surface(vertices, np.vstack([tip, faces]))
    near = GeodesicDistance(surface, "dijkstra").from_source(0)
    for circle in geodesic_circles(surface, near, near, 0, [0.5, 1.0]):
        (angles,) = circle.angles
        turned = np.unwrap(angles)
        assert abs(turned[-1] - turned[0]) == pytest.approx(2 * np.pi, rel=1e-9)
        assert (np.diff(turned) >= -1e-12).all() or (np.diff(turned) <= 1e-12).all()


def test_sources_of_several_places_have_no_circles(ball, geodesic):
    pair = SourceSet((3, 300))
    near = GeodesicDistance(ball, "heat").from_source(pair)
    field = BiharmonicDistance(ball).from_source(pair)
    found = field_quality(ball, field, near, pair)
    assert found.circles == ()
    assert np.isnan(found.isotropy)
    assert len(found.minima) == 0
    # The centre of a face is as round as a vertex.
    place = SurfacePoint(40, (1 / 3, 1 / 3, 1 / 3))
    near = GeodesicDistance(ball, "heat").from_source(place)
    found = field_quality(ball, BiharmonicDistance(ball).from_source(place), near, place)
    assert len(found.circles) == 10
    assert found.isotropy < 1.1
    assert len(found.minima) == 0
