"""Isolines in pixels and in PDF: on a sphere they are circles, to a fraction of a pixel, without gaps."""

import re
import zlib
from itertools import pairwise

import numpy as np
import pytest
from scipy.ndimage import map_coordinates
from scipy.spatial import cKDTree

from app.document.camera import Camera
from app.document.looks import Isolines
from app.figures.description import Figure, FigurePanel
from app.figures.draw import VECTOR_DPI, draw_figure, save_figure
from app.figures.layout import lay_out
from app.figures.shots import take_shots
from app.scene.camera import Projection
from app.scene.style import STYLES
from bihdist_core.progress import silent
from tests.shapes import sphere

AXIS = np.array([0.2, 0.9, 0.4]) / np.linalg.norm([0.2, 0.9, 0.4])

HEIGHTS = np.array([-0.4, 0.1, 0.5])

CAMERA = Camera((0, 0, 6.0), (0, 0, 0), (0, 1, 0), (0.18, 0.18))


@pytest.fixture(scope="module")
def ball():
    return sphere(20_000)


def figure_of(ball, style):
    field, values = ball.vertices @ AXIS + 2, tuple(HEIGHTS + 2)
    return Figure((FigurePanel(ball, field, isolines=Isolines(values=values), views=(CAMERA,)),), style=STYLES[style])


def circles(ball, figure, layout):
    """Of each height the pixels (k, 2) where its circle is well before the rim, and the directions across."""
    (shot,) = take_shots(figure, layout, silent)
    # From space to pixels by what is known of the picture: the ball's outline is where the tangents from the eye are.
    rows, columns = np.nonzero(shot.image[..., 3] > 127)
    middle = np.array([columns.min() + columns.max() + 1, rows.min() + rows.max() + 1]) / 2
    radius = (columns.max() + 1 - columns.min()) / 2
    unit = Projection(CAMERA, 1.0, ball.vertices)
    rim = unit(np.array([[np.sqrt(1 - 1 / 36), 0, 1 / 6]]))[0, 0]
    left, top, _, _ = shot.box.pixels(layout.scale)
    turn = np.linspace(0, 2 * np.pi, 4001)
    one = np.cross(AXIS, [1.0, 0, 0])
    one /= np.linalg.norm(one)
    other = np.cross(AXIS, one)
    for height in HEIGHTS:
        wide = np.sqrt(1 - height**2)
        points = height * AXIS + wide * (np.cos(turn)[:, None] * one + np.sin(turn)[:, None] * other)
        seen = points[:, 2] > 1 / 6 + 0.25
        at = unit(points)[:, :2] * [1, -1] / rim * radius + middle + [left, top]
        way = np.gradient(at, axis=0)
        across = np.stack([-way[:, 1], way[:, 0]], 1) / np.linalg.norm(way, axis=1)[:, None]
        yield at[seen], across[seen]


def test_circles_of_a_sphere_are_drawn_to_a_quarter_of_a_pixel(ball):
    figure = figure_of(ball, "lines")
    ink = 1 - draw_figure(figure).astype(float).mean(axis=2) / 255
    offsets, weights = [], []
    for at, across in circles(ball, figure, lay_out(figure)):
        steps = np.linspace(-3, 3, 61)
        places = at[:, None] + steps[None, :, None] * across[:, None]
        # A pixel's middle is half a pixel from its corner.
        profile = map_coordinates(ink, [places[..., 1] - 0.5, places[..., 0] - 0.5], order=1)
        weights.append(profile.sum(axis=1))
        offsets.append((profile * steps).sum(axis=1) / np.maximum(profile.sum(axis=1), 1e-9))
    weight, offset = np.concatenate(weights), np.concatenate(offsets)
    # Nothing is missing: there is as much ink at every place.
    assert (weight < 0.7 * np.median(weight)).mean() <= 0.001
    assert np.abs(offset).max() < 0.25


def long_curves(path):
    """The stroked paths of a PDF of one page that have 20 points or more: (k, 2) points of 1/72 inch, y up."""
    drawn = ""
    for stream in re.findall(rb"/FlateDecode.*?stream\r?\n(.*?)\r?\nendstream", path.read_bytes(), re.S):
        text = zlib.decompress(stream).decode("latin-1")
        drawn += text if " l\n" in text else ""
    # What is filled, or cuts off other things, ends in another letter.
    number = r"-?[\d.]+ "
    for curve in re.findall(rf"((?:{number}){{2}}m\n(?:(?:{number}){{2}}l\n){{19,}})\n?S\n", drawn):
        yield np.array([line.split()[:2] for line in curve.splitlines()], float)


def test_circles_in_a_pdf_are_as_exact(ball, tmp_path):
    figure = figure_of(ball, "paper")
    save_figure(figure, tmp_path / "f.pdf")
    layout = lay_out(figure, VECTOR_DPI / 96)
    steps = np.linspace(0, 1, 200)[:, None]
    dense = []
    for points in long_curves(tmp_path / "f.pdf"):
        units = np.stack([points[:, 0] / 0.75, layout.height - points[:, 1] / 0.75], 1)
        dense += [a + steps * (b - a) for a, b in pairwise(units)]
    drawn = np.concatenate(dense)
    wanted = np.concatenate([at for at, _ in circles(ball, figure, layout)]) / layout.scale
    # From the circles to what is drawn, so that gaps count, too.
    off = cKDTree(drawn).query(wanted)[0]
    assert (off > 0.25).mean() <= 0.001
    # All else that is drawn is the rest of the circles, at the rim.
    others = drawn[cKDTree(wanted).query(drawn)[0] > 0.5]
    (view,) = layout.cells[0].views
    assert np.hypot(*(others - view.middle).T).min() > 0.8 * view.width / 2
