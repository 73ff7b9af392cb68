"""Isolines in pixels: on a sphere they are circles, to a fraction of a pixel, without gaps."""

import numpy as np
from scipy.ndimage import map_coordinates

from app.document.camera import Camera
from app.document.looks import Isolines
from app.drawing.camera import Projection
from app.drawing.style import STYLES
from app.figures.description import Figure, FigurePanel
from app.figures.draw import draw_figure
from app.figures.layout import lay_out
from app.figures.shots import take_shots
from bihdist_core.progress import silent
from tests.shapes import sphere

AXIS = np.array([0.2, 0.9, 0.4]) / np.linalg.norm([0.2, 0.9, 0.4])


def test_circles_of_a_sphere_are_drawn_to_a_quarter_of_a_pixel():
    ball = sphere(20_000)
    heights = np.array([-0.4, 0.1, 0.5])
    camera = Camera((0, 0, 6.0), (0, 0, 0), (0, 1, 0), (0.18, 0.18))
    panel = FigurePanel(ball, ball.vertices @ AXIS + 2, isolines=Isolines(values=tuple(heights + 2)), views=(camera,))
    figure = Figure((panel,), style=STYLES["lines"])
    layout = lay_out(figure)
    ink = 1 - draw_figure(figure).astype(float).mean(axis=2) / 255
    (shot,) = take_shots(figure, layout, silent)
    # From space to pixels by what is known of the picture: the ball's outline is where the tangents from the eye are.
    rows, columns = np.nonzero(shot.image[..., 3] > 127)
    middle = np.array([columns.min() + columns.max() + 1, rows.min() + rows.max() + 1]) / 2
    radius = (columns.max() + 1 - columns.min()) / 2
    unit = Projection(camera, 1.0, ball.vertices)
    rim = unit(np.array([[np.sqrt(1 - 1 / 36), 0, 1 / 6]]))[0, 0]
    left, top, _, _ = shot.box.pixels(layout.scale)
    turn = np.linspace(0, 2 * np.pi, 4001)
    one = np.cross(AXIS, [1.0, 0, 0])
    one /= np.linalg.norm(one)
    other = np.cross(AXIS, one)
    offsets, weights = [], []
    for height in heights:
        wide = np.sqrt(1 - height**2)
        points = height * AXIS + wide * (np.cos(turn)[:, None] * one + np.sin(turn)[:, None] * other)
        seen = points[:, 2] > 1 / 6 + 0.25  # well before the rim
        at = unit(points)[:, :2] * [1, -1] / rim * radius + middle + [left, top]
        way = np.gradient(at, axis=0)
        across = np.stack([-way[:, 1], way[:, 0]], 1) / np.linalg.norm(way, axis=1)[:, None]
        steps = np.linspace(-3, 3, 61)
        places = at[seen, None] + steps[None, :, None] * across[seen, None]
        # A pixel's middle is half a pixel from its corner.
        profile = map_coordinates(ink, [places[..., 1] - 0.5, places[..., 0] - 0.5], order=1)
        weights.append(profile.sum(axis=1))
        offsets.append((profile * steps).sum(axis=1) / np.maximum(profile.sum(axis=1), 1e-9))
    weight, offset = np.concatenate(weights), np.concatenate(offsets)
    # Nothing is missing: there is as much ink at every place.
    assert (weight < 0.7 * np.median(weight)).mean() <= 0.001
    assert np.abs(offset).max() < 0.25
