"""Fields known at a few points, and points that a few functions confuse: against slow, obvious references."""

import numpy as np
import pytest

from bihdist_core import Laplacian, ParameterError
from bihdist_core.distances.edge_geodesic import EdgeGeodesic
from bihdist_core.experiments._claims_growth import icosphere
from bihdist_core.experiments._claims_metric import double_point
from bihdist_core.experiments.sampled_fields import PiecewiseLinear, Smoothest, nearest_in_triangles
from bihdist_core.experiments.shapes import spread_points
from tests.shapes import bumpy, grid, torus, two_pieces


def least_bending(laplacian, points, values):
    """The minimiser of sum (L f)^2 / A under f(points) = values, dense, by its normal equations."""
    stiffness, n, m = laplacian.stiffness.toarray(), len(laplacian.areas), len(points)
    energy = stiffness @ np.diag(1 / laplacian.areas) @ stiffness
    pick = np.zeros((m, n))
    pick[np.arange(m), points] = 1
    system = np.block([[energy, pick.T], [pick, np.zeros((m, m))]])
    return np.linalg.solve(system, np.concatenate([np.zeros(n), values]))[:n]


@pytest.mark.parametrize("surface", [bumpy(220), grid(12, 9), torus(16, 9)])
def test_the_smoothest_interpolant_is_the_minimiser(surface):
    laplacian = Laplacian(surface)
    points = np.random.default_rng(0).choice(len(surface.vertices), 17, replace=False)
    values = np.random.default_rng(1).standard_normal(17)
    found = Smoothest(laplacian.components[0], points)(values)
    # The reference has the squared condition number: 1e-9 of these values, which are about 1.
    np.testing.assert_allclose(found, least_bending(laplacian, points, values), atol=1e-8)
    np.testing.assert_allclose(found[points], values, atol=1e-10)


def test_the_smoothest_interpolant_keeps_constants_and_takes_several_fields():
    surface = bumpy(150)
    points = spread_points(surface, 9)
    smoothest = Smoothest(Laplacian(surface).components[0], points)
    np.testing.assert_allclose(smoothest(np.full(9, 3.5)), 3.5, atol=1e-10)
    both = np.random.default_rng(0).standard_normal((9, 2))
    np.testing.assert_allclose(smoothest(both)[:, 1], smoothest(both[:, 1]), atol=1e-12)
    np.testing.assert_allclose(Smoothest(Laplacian(surface).components[0], points[:1])(np.array([2.0])), 2)


@pytest.mark.parametrize("points", [[], [3, 3]])
def test_an_interpolant_needs_points_that_differ(points):
    with pytest.raises(ParameterError, match="at least one point"):
        Smoothest(Laplacian(bumpy(60)).components[0], np.array(points, int))


def test_the_piecewise_linear_interpolant_is_exact_for_linear_fields_on_a_flat_sheet():
    sheet = grid(12, 12)
    # Farthest points and the rim, so that every vertex is in a triangle between points.
    x, y, _ = sheet.vertices.T
    rim = np.flatnonzero((x == x.min()) | (x == x.max()) | (y == y.min()) | (y == y.max()))
    points = np.unique(np.concatenate([rim, spread_points(sheet, 40)]))
    field = 2 * x - 3 * y + 1
    filled = PiecewiseLinear(sheet, points)
    np.testing.assert_allclose(filled(field[points]), field, atol=1e-9)
    np.testing.assert_allclose(filled(np.stack([field, x], 1)[points])[:, 1], x, atol=1e-9)
    # And not for others: it lies between the samples.
    curved = filled(x[points] ** 2)
    assert (curved >= x**2 - 1e-9).all()
    assert curved.max() <= (x**2).max()


def test_the_piecewise_linear_interpolant_gives_back_samples_on_any_surface():
    for surface in (bumpy(300), torus(24, 5)):
        points = spread_points(surface, 12)
        filled = PiecewiseLinear(surface, points)
        values = np.random.default_rng(0).standard_normal(12)
        found = filled(values)
        np.testing.assert_allclose(found[points], values, atol=1e-12)
        assert (filled.weights >= 0).all()
        np.testing.assert_allclose(filled.weights.sum(axis=1), 1)
        assert values.min() <= found.min() <= found.max() <= values.max()


def test_the_piecewise_linear_interpolant_has_no_value_out_of_reach():
    pieces = two_pieces()
    found = PiecewiseLinear(pieces, np.array([0, 5, 17, 33]))(np.arange(4.0))
    assert np.isfinite(found[:60]).all()
    assert np.isnan(found[60:]).all()


def test_the_nearest_place_of_a_triangle_is_nearer_than_all_others():
    rng = np.random.default_rng(0)
    triangles = rng.standard_normal((60, 3, 3))
    triangles[:10, 2] = triangles[:10, 1]  # lines
    triangles[10:15] = triangles[10:15, :1]  # points
    points = rng.standard_normal((60, 3))
    weights, away = nearest_in_triangles(points, triangles)
    assert (weights >= 0).all()
    np.testing.assert_allclose(weights.sum(axis=1), 1)
    places = np.einsum("kc,kcx->kx", weights, triangles)
    np.testing.assert_allclose(np.linalg.norm(places - points, axis=1), away)
    steps = 60
    i, j = np.indices((steps + 1, steps + 1)).reshape(2, -1)
    shares = np.stack([i, j, steps - i - j], 1)[i + j <= steps] / steps
    for point, triangle, found in zip(points, triangles, away, strict=True):
        tried = np.linalg.norm(shares @ triangle - point, axis=1).min()
        # The lattice is at most a step of the longest side from any place.
        assert tried - 5 / steps < found <= tried + 1e-12


def test_a_double_point_has_equal_values():
    surface = bumpy(400)
    along = EdgeGeodesic(surface).distances(np.arange(400))
    # No symmetry: the values are equal because the weights are right.
    images = surface.vertices @ np.random.default_rng(0).standard_normal((3, 2))
    found = double_point(surface, images, along, 0.5)
    one, two = found.values(surface, images)
    np.testing.assert_allclose(one, two, atol=1e-14)
    assert found.gap == pytest.approx(np.linalg.norm(one - two))
    assert (found.weights >= 0).all()
    one, two = found.values(surface, surface.vertices)
    assert np.linalg.norm(one - two) > 0.25


def test_a_closed_surface_falls_on_itself_in_the_plane_and_not_in_space():
    sphere = icosphere(3)
    along = EdgeGeodesic(sphere).distances(np.arange(len(sphere.vertices)))
    flat = double_point(sphere, sphere.vertices[:, :2], along, 0.5)
    assert flat.gap < 1e-15
    one, two = flat.values(sphere, sphere.vertices)
    # Two points above each other, on the sphere's two halves.
    np.testing.assert_allclose(one[:2], two[:2], atol=1e-15)
    assert abs(one[2] - two[2]) > 0.25
    assert (flat.weights >= 0).all()
    np.testing.assert_allclose(flat.weights.sum(axis=1), 1)
    # As itself it has none: the nearest points so far apart along edges are far apart in space.
    space = double_point(sphere, sphere.vertices, along, 0.5)
    assert space is None or space.gap > 0.25
    assert double_point(sphere, sphere.vertices, along, 10.0) is None
