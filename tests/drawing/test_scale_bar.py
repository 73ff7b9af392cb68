"""Scale bars: round lengths, as long on the page as such a length on the surface."""

import re

import numpy as np
import pytest

from app.drawing.scale_bar import LONGEST, round_length, scale_bar_shapes
from app.drawing.shapes import Box, Text
from app.figures.captions import scale_shapes
from app.figures.export import DEPTHS
from app.figures.layout import lay_out
from app.figures.page_layout import ComposedPage
from app.figures.picture import figure
from app.figures.shots import take_shots
from bihdist_core import ParameterError
from bihdist_core.progress import silent
from tests.shapes import sphere

BALL = sphere(300)
INK, GROUND = (0.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 0.7)


@pytest.mark.parametrize(("most", "length"), [(0.0051, 0.005), (1, 1), (1.99, 1), (2, 2), (49.9, 20), (700, 500)])
def test_a_length_is_1_2_or_5_times_a_power_of_ten_and_as_long_as_may_be(most, length):
    assert round_length(most) == pytest.approx(length)


def bars(**view):
    page = figure(BALL, ["biharmonic"], 5, view=view, layout={"size": "400x300"})._figure
    layout = lay_out(page)
    shots = take_shots(page, layout, silent)
    found = scale_shapes(ComposedPage(page, layout, shots))
    return page, shots, found


def length_of(shapes):
    """The length of the bar on the page, and its words."""
    (text,) = (shape.text for shape in shapes if isinstance(shape, Text))
    (path,) = shapes[1].subpaths
    return path.segments[0][0][0] - path.start[0], text


def test_in_parallel_projection_the_bar_is_as_long_as_the_surface_is_there():
    # Seen from the front, the sphere of radius 1 is as wide on the page as its diameter.
    _, (shot,), shapes = bars(cpos="front", parallel_projection=True, scale_bar=True, unit="mm")
    long, text = length_of(shapes)
    across = np.flatnonzero((shot.image[..., 3] > 127).any(axis=0))
    per_unit = (across[-1] - across[0] + 1) / shot.image.shape[1] * shot.box.width / np.ptp(BALL.vertices[:, 0])
    value = float(text.removesuffix(" mm"))
    assert long / value == pytest.approx(per_unit, rel=0.01)
    assert value == round_length(LONGEST * shot.box.width / per_unit)


def test_in_perspective_it_says_that_it_is_near():
    page, (shot,), shapes = bars(cpos="front", scale_bar=True)
    long, text = length_of(shapes)
    number = re.fullmatch(r"≈ ([\d.]+) mesh units", text)[1]
    assert long / float(number) == pytest.approx(shot.per_unit)
    assert DEPTHS in page.remarks
    assert not bars(cpos="front")[2]


def test_views_at_one_scale_have_one_bar_and_the_unit_is_that_of_the_colour_bar():
    page, _, shapes = bars(cpos=["front", "back"], parallel_projection=True, scale_bar=True, unit="mm")
    assert page.panels[0].unit == "mm"
    assert sum(isinstance(shape, Text) for shape in shapes) == 1
    with pytest.raises(ParameterError, match="word such as mm"):
        bars(unit="m" * 30)


def test_the_bar_leaves_a_corner_that_is_taken():
    box = Box(0, 0, 200, 100)
    for taken, is_right in (((), True), (("bottom right",), False)):
        shapes = scale_bar_shapes(box, 10.0, ("", "mm"), taken, 10.0, 1.0, INK, GROUND)
        (text,) = (shape for shape in shapes if isinstance(shape, Text))
        assert (text.x > 100) == is_right
