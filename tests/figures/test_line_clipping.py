"""Lines in a box: all that is inside, nothing else, and no more pieces than there are."""

import numpy as np
import pytest

from app.drawing.shapes import Box
from app.figures.hidden_lines import Curve, HiddenLineRemoval
from app.scene.camera import Camera, Projection
from app.scene.line_clipping import clipped
from bihdist_core.analysis.isoline_tracing import isolines
from tests.shapes import sphere

BOX = Box(0.0, -1.0, 3.0, 2.0)


def ring(points, closed):
    return np.concatenate([points, points[:1]]) if closed else points


def length(lines):
    return sum(np.linalg.norm(np.diff(ring(*line), axis=0), axis=1).sum() for line in lines)


def length_inside(line, count=4000):
    """By many points of each piece."""
    points = ring(*line)
    a, step = points[:-1], np.diff(points, axis=0)
    at = a + ((np.arange(count) + 0.5) / count)[:, None, None] * step
    is_inside = ((at > (BOX.x, BOX.y)) & (at < (BOX.right, BOX.bottom))).all(axis=-1)
    return (is_inside.mean(axis=0) * np.linalg.norm(step, axis=1)).sum()


@pytest.mark.parametrize("closed", [False, True])
def test_all_that_is_inside_is_left_and_nothing_else(closed):
    rng = np.random.default_rng(3)
    for _ in range(50):
        line = rng.uniform((-1, -2), (4, 2), (12, 2)), closed
        parts = clipped(line, BOX)
        assert length(parts) == pytest.approx(length_inside(line), abs=0.01)
        points = np.concatenate([np.empty((0, 2)), *(points for points, _ in parts)])
        assert ((points >= (0, -1)) & (points <= (3, 1))).all()


def test_a_line_is_cut_where_it_leaves_and_nowhere_else():
    inside = np.array([[1.0, 0], [2, 0], [2, 0.5]])
    for closed in (False, True):
        assert clipped((inside, closed), BOX) == [(inside, closed)]
    # Out at the right and back, through the box at once, beside it, along its side.
    assert pieces([[1, 0], [4, 0], [4, 0.5], [2, 0.5]]) == [[[1, 0], [3, 0]], [[3, 0.5], [2, 0.5]]]
    assert pieces([[-1, 0], [4, 0]]) == [[[0, 0], [3, 0]]]
    assert pieces([[-1, 0], [-1, 5], [9, 5]]) == []
    assert pieces([[-1, 1], [4, 1]]) == [[[0, 1], [3, 1]]]
    # Closed, and outside in the midst only: one piece, though it was joined inside.
    assert pieces([[1, 0], [1, 0.5], [5, 0.5], [5, 0]], closed=True) == [[[3, 0], [1, 0], [1, 0.5], [3, 0.5]]]


def test_what_is_no_place_is_nowhere():
    assert pieces([[1, 0], [np.inf, 0], [np.nan, 0], [2, 0.5], [2, 1]]) == [[[2, 0.5], [2, 1]]]
    assert pieces([[1, 0], [1e300, 1e290]]) == [[[1, 0], [3, pytest.approx(2e-10)]]]


def pieces(points, closed=False):
    return [part.tolist() for part, _ in clipped((np.array(points, float), closed), BOX)]


def test_lines_that_pass_beside_the_eye_end_about_the_picture():
    ball = sphere(2000)
    (line,) = isolines(ball, ball.vertices[:, 0] + 2, [2.0])
    beside = line.points[np.abs(line.points[:, 2]).argmin()]
    camera = Camera((0, 0, beside[2] + 1e-7), (0, 0, -1), (0, 1, 0), (0.25, 0.25))
    sight = HiddenLineRemoval(ball, Projection(camera, 1.0, ball.vertices), (600, 600))
    assert np.nanmax(np.abs(sight.pixels(line.points))) > 1e8
    curve = Curve(line.points, line.edges, line.closed)
    for parts in (*sight.visible([curve]), sight.outlined([curve])):
        assert 600 <= length(parts) < 4000
        assert np.abs(np.concatenate([points for points, _ in parts])).max() <= 1200
