"""Isolines as curves: where the analytic ones are, visible parts and no others."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial import cKDTree
from scipy.special import eval_legendre

from app.document.looks import Isolines
from app.figures.canvas import simplified_line
from app.figures.hidden_lines import Curve, HiddenLineRemoval
from app.figures.outlines import outlines
from app.scene.camera import Camera, Projection, standard_camera
from app.scene.drawable import drawable, outward_faces
from app.scene.levels import levels
from bihdist_core import Surface
from bihdist_core.analysis.isoline_tracing import isolines
from tests.shapes import grid, sphere, torus

PIXELS = 600
"""The side of a usual panel."""


def sight_of(surface, camera=None):
    camera = camera or standard_camera(surface.vertices, 1.0, "home")
    return HiddenLineRemoval(surface, Projection(camera, 1.0, surface.vertices), (PIXELS, PIXELS))


def seen(surface, field, values, camera=None):
    """For each isoline its value and visible parts."""
    found = isolines(surface, field, values)
    parts = sight_of(surface, camera).visible(Curve(line.points, line.edges, line.closed) for line in found)
    return [(line.value, p) for line, p in zip(found, parts, strict=True)]


def sampled(parts, step=0.05):
    """(k, 2) points along the parts of a curve and the length (k,) each stands for."""
    points, lengths = [np.empty((0, 2))], [np.empty(0)]
    for p, closed in parts:
        ring = np.concatenate([p, p[:1]]) if closed else p
        for a, b in pairwise(ring):
            length = np.linalg.norm(b - a)
            count = max(int(length / step), 1)
            t = (np.arange(count) + 0.5)[:, None] / count
            points.append(a + t * (b - a))
            lengths.append(np.full(count, length / count))
    return np.concatenate(points), np.concatenate(lengths)


def test_isolines_on_a_sphere_are_the_visible_parts_of_analytic_circles():
    ball = sphere(10_000)
    axis = ball.vertices[ball.vertices[:, 1].argmax()]
    # Biharmonic distance from the pole by its series, at the vertices: what is left is the drawing's error.
    angles, degree = np.linspace(0, np.pi, 2001), np.arange(1, 400)
    weight = (2 * degree + 1) / (2 * np.pi * (degree * (degree + 1.0)) ** 2)
    series = np.sqrt(weight @ (1 - eval_legendre(degree[:, None], np.cos(angles))))
    distance = np.interp(np.arccos(np.clip(ball.vertices @ axis, -1, 1)), angles, series)
    values = levels(Isolines(20), distance.max(), distance.max()).values
    camera = standard_camera(ball.vertices, 1.0, "home")
    sight = sight_of(ball, camera)
    right = np.cross(axis, [1.0, 0, 0])
    right /= np.linalg.norm(right)
    frame = np.stack([right, np.cross(axis, right), axis], 1)
    turn = np.linspace(0, 2 * np.pi, 20_001)
    visible = missing = wrong = worst = 0.0
    for value, parts in seen(ball, distance, values, camera):
        angle = np.interp(value, series, angles)
        circle = np.stack(
            [np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.full(turn.shape, np.cos(angle))], 1
        )
        circle = circle @ frame.T
        at = sight.pixels(circle)[:, :2]
        in_sight = circle @ np.array(camera.position) >= 1  # the tangent cone touches the sphere where this is 1
        middles, steps = (at[1:] + at[:-1]) / 2, np.linalg.norm(np.diff(at, axis=0), axis=1)
        shown = in_sight[1:] & in_sight[:-1]
        visible += steps[shown].sum()
        drawn, lengths = sampled(parts)
        if not len(drawn):
            missing += steps[shown].sum()
            continue
        worst = max(worst, cKDTree(at).query(drawn)[0].max())
        missing += steps[shown][cKDTree(drawn).query(middles[shown])[0] > 0.5].sum()
        near = cKDTree(at[in_sight]).query(drawn)[0] if in_sight.any() else np.full(len(drawn), np.inf)
        wrong += lengths[near > 0.5].sum()
    assert visible > 5000
    assert worst < 0.5
    assert missing < 0.005 * visible
    assert wrong < 0.005 * visible


def test_what_stands_behind_is_hidden_up_to_the_edge_of_what_stands_before():
    # A small square before a large one, both across the line of sight.
    square = grid(20, 20)
    near, far = (square.vertices - [10, 10, 0]) * 0.1 + [0, 0, 5.0], square.vertices - [10, 10, 0]
    both = Surface(np.concatenate([far, near]), np.concatenate([square.faces, square.faces + len(far)]), "two squares")
    camera = Camera((0, 0, 30), (0, 0, 0), (0, 1, 0), (0.5, 0.5))
    field = np.concatenate([square.vertices[:, 0], np.full(len(near), np.nan)])
    ((value, parts),) = seen(both, field, [9.7], camera)
    assert value == 9.7
    assert [closed for _, closed in parts] == [False, False]
    # The line x = -0.3 of the far square, 30 before the eye; the near square's edge y = ±1 at 25.
    pixel = PIXELS / 2 / (0.5 * 30)
    edges = sorted(p[k, 1] for p, _ in parts for k in (0, -1))
    expected = PIXELS / 2 + pixel * np.array([-10, -1 * 30 / 25, 1 * 30 / 25, 10])
    assert np.abs(edges - expected).max() < 1e-6


def test_the_far_side_is_hidden_and_the_inside_of_an_open_surface_is_not():
    ball = sphere(2000)
    height = ball.vertices[:, 1] + 1
    closed = sampled(seen(ball, height, [0.8])[0][1])[1].sum()
    open_ball = Surface(ball.vertices, ball.faces[(ball.vertices[ball.faces][..., 2] < 0.3).all(axis=1)], "bowl")
    front = Camera((0, 0, 6), (0, 0, 0), (0, 1, 0), (0.25, 0.25))
    inside = sampled(seen(open_ball, height, [0.8], front)[0][1])[1].sum()
    whole = sampled(seen(ball, height, [0.8], front)[0][1])[1].sum()
    assert closed > 100
    assert inside > 0.5 * whole


def test_insides_that_have_a_colour_of_their_own_show_no_isolines():
    ball = sphere(2000)
    bowl = Surface(ball.vertices, ball.faces[(ball.vertices[ball.faces][..., 2] < 0.3).all(axis=1)], "bowl")
    outward = outward_faces(drawable(bowl))
    assert outward is not None
    lines = isolines(bowl, bowl.vertices[:, 1] + 1, [0.8])
    for z in (6, -6):
        camera = Camera((0, 0, z), (0, 0, 0), (0, 1, 0), (0.25, 0.25))
        projection = Projection(camera, 1.0, bowl.vertices)
        curves = [Curve(line.points, line.edges, line.closed) for line in lines]
        both = [
            HiddenLineRemoval(bowl, projection, (PIXELS, PIXELS), faces).visible(curves) for faces in (None, outward)
        ]
        whole, rest = (sum(sampled(parts)[1].sum() for parts in found) for found in both)
        assert whole > 100
        assert rest == pytest.approx(whole if z < 0 else 0.0, abs=0.01 * whole)
    assert outward_faces(drawable(ball)) is None


def test_a_surface_that_passes_through_itself_hides_what_is_inside():
    one, other = sphere(1500, seed=1), sphere(1500, seed=2)
    both = Surface(
        np.concatenate([one.vertices, other.vertices + np.array([0.9, 0, 0])]),
        np.concatenate([one.faces, other.faces + 1500]),
    )
    camera = Camera((0, 0, 8), (0.45, 0, 0), (0, 1, 0), (0.25, 0.25))
    field = np.concatenate([one.vertices[:, 1] + 1, np.full(1500, np.nan)])
    parts = seen(both, field, [1.0], camera)[0][1]
    # The equator of the first ball is seen up to where the second begins: the plane x = 0.45.
    pixels = sight_of(both, camera).pixels(np.array([[0.45, 0, np.sqrt(1 - 0.45**2)]]))[0]
    right = max(p[:, 0].max() for p, _ in parts)
    assert right == pytest.approx(pixels[0], abs=2.5)  # balls of 1500 vertices are a pixel or two from round


def test_outlines_of_a_ring_are_its_rim_and_its_hole():
    ring = torus(120, 60)
    above = Camera((0, 0, 30), (0, 0, 0), (0, 1, 0), (0.11, 0.11))
    found = outlines(sight_of(ring, above))
    radii = np.concatenate([np.linalg.norm(p - PIXELS / 2, axis=1) for p, _ in found])
    per_unit = PIXELS / 2 / (0.11 * 30)
    assert ((np.abs(radii - 3 * per_unit) < 3) | (np.abs(radii - per_unit) < 3)).all()
    assert sum(sampled([part])[1].sum() for part in found) == pytest.approx(2 * np.pi * 4 * per_unit, rel=0.02)


def test_simplified_lines_stay_within_their_tolerance():
    t = np.linspace(0, 6, 800)
    line = np.stack([20 * t, 10 * np.sin(t)], 1)
    short = simplified_line(line, 0.05)
    assert len(short) < 80
    dense, _ = sampled([(short, False)], 0.01)
    assert cKDTree(dense).query(line)[0].max() < 0.051
