"""Mean curvature is that of spheres and tori, with the sign of the outside."""

import numpy as np
import pytest

from bihdist_core import Laplacian, Surface
from bihdist_core.analysis.curvature import mean_curvature
from tests.shapes import grid, sphere, torus


def test_a_sphere_has_one_over_its_radius():
    ball = sphere(4000)
    for radius in (0.5, 3.0):
        found = mean_curvature(Laplacian(Surface(radius * ball.vertices, ball.faces)))
        # Areas of obtuse faces make single vertices of an irregular mesh inexact.
        assert np.abs(radius * found - 1).mean() < 0.01
        assert np.median(found) == pytest.approx(1 / radius, rel=1e-3)


def test_on_a_torus_the_error_falls_with_the_square_of_the_edges():
    errors = []
    for across in (16, 32):
        ring = torus(3 * across, across)
        out = np.hypot(*ring.vertices[:, :2].T)  # 2 + cos v, with radii 2 and 1
        exact = (out + (out - 2)) / (2 * out)
        errors.append(np.abs(mean_curvature(Laplacian(ring)) - exact).max())
    assert errors[1] < errors[0] / 3.5
    assert errors[1] < 0.01


def test_faces_wound_inwards_change_nothing_and_a_plane_has_none():
    ring = torus()
    turned = Surface(ring.vertices, ring.faces[:, ::-1])
    assert mean_curvature(Laplacian(turned)) == pytest.approx(mean_curvature(Laplacian(ring)), abs=1e-12)
    assert np.abs(mean_curvature(Laplacian(grid(5, 4)))).max() < 1e-12


def test_a_vertex_of_no_face_has_none():
    ball = sphere(60)
    found = mean_curvature(Laplacian(Surface(np.vstack([ball.vertices, [[9.0, 9, 9]]]), ball.faces)))
    assert np.isnan(found[-1])
    assert np.isfinite(found[:-1]).all()
